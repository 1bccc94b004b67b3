# SPDX-License-Identifier: LGPL-3.0-or-later
"""Sections of models: planes, fences, levels and surfaces."""

from __future__ import annotations

from typing import Any, Dict, List, NamedTuple, Optional, Tuple

import numpy as np

from . import _core
from ._arrays import Float64Array, Path, UInt32Array, as_list, as_number, as_point, as_points, as_text
from ._errors import Error, bad_option
from ._mesh import Mesh
from ._model import Model
from ._results import Result, by_value, counted
from ._run import how
from ._surface import as_surface, parts_of_surfaces


@by_value
class SectionPolygon(NamedTuple):
    """A part of a block in a section.

    Attributes
    ----------
    block : str
        The block in front of the section.
    behind : str
        The block behind it: another one only where the section lies upon surfaces.
    unit : str
        Of the stratigraphic column, of `block`; may be empty.
    area : float
        Squared unit.
    rings : list of ndarray, shape (n,), uint32
        Vertices of the section: the outer ring, counterclockwise, then holes, clockwise.

    Examples
    --------
    >>> m = ...
    >>> terrane.section(m, level=1.5).polygons[0].block
    'above flat'
    """

    block: str
    behind: str
    unit: str
    area: float
    rings: List[UInt32Array]


@by_value
class SectionLine(NamedTuple):
    """A line of a surface in a section.

    Attributes
    ----------
    surface : str
    vertices : ndarray, shape (n,), uint32
        Vertices of the section; the first is repeated if the line is closed.

    Examples
    --------
    >>> m = ...
    >>> sorted({line.surface for line in terrane.section(m, level=1.5).lines})[0]
    'boundary side 1'
    """

    surface: str
    vertices: UInt32Array


class Section(Result):
    """A section of a model.

    Attributes
    ----------
    vertices : ndarray, shape (n, 3)
        Of polygons, lines and triangles.
    flat : ndarray, shape (n, 2)
        Per vertex the distance along the section, and the height. In the map they are x and y.
    polygons : list of SectionPolygon
    lines : list of SectionLine
    triangles : ndarray, shape (m, 3), uint32
        That the polygons consist of.
    polygon_of : ndarray, shape (m,), uint32
        Per triangle the index of its polygon.

    Examples
    --------
    >>> m = ...
    >>> terrane.section(m, plane=((1, 1, 1), (0, -1, 0)))
    <Section: 2 polygons, 5 lines, area 12>
    """

    __slots__ = ("vertices", "flat", "polygons", "lines", "triangles", "polygon_of", "_values")

    def __init__(self, values: Dict[str, Any]) -> None:
        self._values = values
        self.vertices: Float64Array = values["vertices"]
        self.flat: Float64Array = values["flat"]
        self.triangles: UInt32Array = values["triangles"]
        self.polygon_of: UInt32Array = values["polygon_of"]
        blocks, surfaces = values["blocks"], values["surfaces"]
        self.polygons = [SectionPolygon(blocks[front][0], blocks[behind][0], blocks[front][1], area, list(rings))
                         for front, behind, rings, area in values["polygons"]]
        self.lines = [SectionLine(surfaces[surface][0], vertices) for surface, vertices in values["lines"]]

    @property
    def area(self) -> float:
        """Of all polygons, squared unit."""
        return float(sum(polygon.area for polygon in self.polygons))

    @property
    def mesh(self) -> Mesh:
        """The triangles, with a surface per block of the model."""
        return Mesh(_core.section_mesh(self._values))

    def save(self, path: Path, *, title: str = "", exaggeration: float = 1) -> None:
        """Write a drawing (.svg), a map or table (.geojson, .shp, .dxf, .csv), or the triangles in any format of `Mesh.save`.

        Parameters
        ----------
        path : path
            The extension is the format.
        title : str, optional
            Of a drawing.
        exaggeration : float, optional
            By which a drawing is stretched vertically.

        Raises
        ------
        terrane.Error
            ``nothing_to_do`` if the section does not meet the model; those of `Mesh.save`.

        Examples
        --------
        >>> import os
        >>> m = ...
        >>> terrane.section(m, fence=[(0, 0), (1, 2), (2, 2)]).save("fence.svg", title="From corner to corner")
        >>> os.path.exists("fence.svg")
        True
        """
        if not self.polygons and not self.lines:
            raise Error("nothing_to_do", "the section does not meet the model, so nothing is written", str(path))
        if not _core.save_section(self._values, path, as_text(title, "title"),
                                  as_number(exaggeration, "exaggeration", positive=True)):
            self.mesh.save(path)

    def _state(self) -> Tuple[Any, ...]:
        return (self._values,)

    def _line(self) -> str:
        return (f"{counted(len(self.polygons), 'polygon')}, {counted(len(self.lines), 'line')}, "
                f"area {_core.figure(self.area)}")

    def _numbers(self) -> Dict[str, Any]:
        return {"polygons": len(self.polygons), "lines": len(self.lines), "area": _core.figure(self.area)}

    def _shape(self) -> Tuple[Any, Any]:
        return self.vertices, self.triangles


def section(model: Model, *, plane: Any = None, fence: Any = None, level: Any = None, by: Any = None,
            threads: Optional[int] = None, progress: Any = None) -> Section:
    """Cut a model exactly along a plane, a fence, levels or a surface: polygons of blocks, lines of surfaces.

    Parameters
    ----------
    model : Model
    plane : pair of points, optional
        A point of the plane and its normal. The plane is seen from where the normal points.
    fence : array_like, shape (n, 2), optional
        A line in the map, along which vertical panels stand, seen from the right of its way.
    level : float or list of float, optional
        Heights of horizontal planes, seen from above.
    by : str or surface, optional
        The name of a surface of the model, or any surface that each line along x, or y, or z meets once only.

    Raises
    ------
    terrane.Error
        ``bad_option`` unless one of these is given, for a plane without a direction, a fence that crosses or touches itself,
        and a surface that folds over.

    Notes
    -----
    Where the section lies upon a surface, the block in front of it counts.

    Examples
    --------
    >>> m = ...
    >>> [(p.block, p.area) for p in terrane.section(m, plane=((1, 1, 1), (0, -1, 0))).polygons]
    [('below flat', 4.0), ('above flat', 8.0)]
    """
    if not isinstance(model, Model):
        raise TypeError(f"model is a terrane.Model, not {type(model).__name__}")
    where: Dict[str, Any] = {}
    if plane is not None:
        pair = as_list(plane, "plane")
        if len(pair) != 2:
            raise bad_option("must be a point and a normal", "plane")
        where["plane"] = [*as_point(pair[0], "plane[0]"), *as_point(pair[1], "plane[1]")]
    if fence is not None:
        where["fence"] = np.array(as_points(fence, "fence", 2))
    if level is not None:
        heights = as_list(level, "level") if np.ndim(level) else [level]
        where["levels"] = [as_number(z, "level") for z in heights]
    if isinstance(by, str):
        where["name"] = by
    elif by is not None:
        where["by"] = parts_of_surfaces([as_surface(by)])
    if len(where) != 1:
        raise bad_option("needs one of plane, fence, level and by", "section")
    return Section(_core.section(model._core, where, how(threads, progress)))
