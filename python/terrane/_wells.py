# SPDX-License-Identifier: LGPL-3.0-or-later
"""Logs of wells: the blocks and surfaces along their paths."""

from __future__ import annotations

from typing import Any, Dict, List, NamedTuple, Optional, Tuple

import numpy as np

from . import _core
from ._arrays import Path, Point, as_list, as_mapping, as_number, as_point, as_points, as_text
from ._model import Model
from ._results import Result, counted
from ._run import how


class WellPath(NamedTuple):
    """The path of a well.

    Attributes
    ----------
    name : str
    points : ndarray, shape (n, 3)
        Vertices of a polyline, from the head on.
    depths : ndarray, shape (n,), or None
        Their measured depths. None: the length along the path.

    Examples
    --------
    >>> import terrane
    >>> terrane.WellPath("A-1", [(1, 1, 9), (1, 1, 0)], None).name
    'A-1'
    """

    name: str
    points: Any
    depths: Any = None


class WellInterval(NamedTuple):
    """A part of a path in one block, or in surfaces.

    Attributes
    ----------
    top, base : float
        Measured depths.
    entry, exit : tuple of float
        Points of the path at these depths.
    blocks : list of str
        The block; of a part in surfaces all blocks around it.
    units : list of str
        Of the blocks; may be empty texts.
    surfaces : list of str
        In which it runs; mostly none.

    Examples
    --------
    >>> m = ...
    >>> terrane.log_well(m, [(1, 1, 1), (1, 1, 0.5)]).intervals[-1].blocks
    ['above flat']
    """

    top: float
    base: float
    entry: Point
    exit: Point
    blocks: List[str]
    units: List[str]
    surfaces: List[str]


class WellMarker(NamedTuple):
    """A point in which a path meets a surface.

    Attributes
    ----------
    depth : float
        Measured.
    point : tuple of float
    surface : str
    before, after : int
        Indices of the intervals above and below; the same one if the block does not change.

    Examples
    --------
    >>> m = ...
    >>> [marker.surface for marker in terrane.log_well(m, [(1, 1, 1), (1, 1, -0.5)]).markers]
    ['flat']
    """

    depth: float
    point: Point
    surface: str
    before: int
    after: int


class WellLog(Result):
    """What a well meets on its way.

    Attributes
    ----------
    name : str
    intervals : list of WellInterval
        By depth, without gaps.
    markers : list of WellMarker
        By depth.

    Examples
    --------
    >>> m = ...
    >>> terrane.log_well(m, [(1, 1, 1), (1, 1, -0.5)], name="A-1")
    <WellLog: A-1, 2 intervals, 1 marker>
    """

    __slots__ = ("name", "intervals", "markers", "_values")

    def __init__(self, values: Dict[str, Any]) -> None:
        self._values = values
        self.name: str = values["name"]
        blocks, units, surfaces = values["blocks"], values["units"], values["surfaces"]
        self.intervals = [WellInterval(top, base, entry, exit, [blocks[b] for b in inside], [units[b] for b in inside],
                                       [surfaces[s] for s in upon])
                          for top, base, entry, exit, inside, upon in values["intervals"]]
        self.markers = [WellMarker(depth, point, surfaces[surface], before, after)
                        for depth, point, surface, before, after in values["markers"]]

    def save(self, path: Path, *, step: Optional[float] = None) -> None:
        """Write a table (.csv) or LAS 2.0 (.las).

        Parameters
        ----------
        path : path
            The extension is the format.
        step : float, optional
            Distance of the depths in LAS; None: depths at which the block changes.

        Examples
        --------
        >>> import os
        >>> m = ...
        >>> terrane.log_well(m, [(1, 1, 1), (1, 1, -0.5)], name="A-1").save("A-1.las")
        >>> os.path.exists("A-1.las")
        True
        """
        _core.save_log(self._values, path, 0 if step is None else as_number(step, "step", positive=True))

    def _state(self) -> Tuple[Any, ...]:
        return (self._values,)

    def _line(self) -> str:
        return f"{self.name}, {counted(len(self.intervals), 'interval')}, {counted(len(self.markers), 'marker')}"

    def _numbers(self) -> Dict[str, Any]:
        return {"intervals": len(self.intervals), "markers": len(self.markers)}


def log_well(model: Model, points: Any, *, depths: Any = None, name: str = "well", threads: Optional[int] = None,
             progress: Any = None) -> WellLog:
    """Log a well exactly: where its path enters and leaves blocks, and where it meets surfaces.

    Parameters
    ----------
    model : Model
    points : WellPath, or array_like, shape (n, 3)
        Vertices of the path, a polyline, from the head on. A WellPath has depths and a name.
    depths : array_like, shape (n,), optional
        Measured depths of the vertices, ascending. By default the length along the path.
    name : str, optional

    Raises
    ------
    terrane.Error
        ``bad_option`` for fewer than two different points, and for depths that do not fit to them.

    Notes
    -----
    A part that runs in a surface is an interval of its own, with all blocks around it.

    Examples
    --------
    >>> m = ...
    >>> [(i.blocks[0], i.top, i.base) for i in terrane.log_well(m, [(1, 1, 1), (1, 1, -0.5)]).intervals]
    [('above flat', 0.0, 1.0), ('below flat', 1.0, 1.5)]
    """
    if not isinstance(model, Model):
        raise TypeError(f"model is a terrane.Model, not {type(model).__name__}")
    if isinstance(points, WellPath):
        name, points, depths = points.name, points.points, points.depths if depths is None else depths
    along = [] if depths is None else [as_number(depth, "depths") for depth in as_list(depths, "depths")]
    return WellLog(_core.log_well(model._core, as_text(name, "name"), as_points(points, "points"),
                                  np.array(along, dtype=np.float64), how(threads, progress)))


def read_wells(path: Path, *, heads: Any = None) -> List[WellPath]:
    """Read paths of wells: a table with x, y, z, a deviation survey, or LAS 2.0.

    Parameters
    ----------
    path : path
    heads : point, or mapping from names of wells to points, optional
        Where wells with a deviation survey begin, at depth 0.

    Raises
    ------
    terrane.Error
        ``bad_syntax`` and ``bad_number`` with the line; ``bad_option`` for a survey without a head.

    Examples
    --------
    >>> import terrane
    >>> with open("survey.csv", "w") as file:
    ...     _ = file.write("md,inclination,azimuth\\n0,0,0\\n4,0,0\\n")
    >>> terrane.read_wells("survey.csv", heads=(1, 1, 3))[0].points[-1].tolist()
    [1.0, 1.0, -1.0]
    """
    if heads is None:
        stated: List[Tuple[str, Point]] = []
    elif hasattr(heads, "keys"):
        stated = [(as_text(name, "heads"), as_point(place, "heads"))
                  for name, place in as_mapping(heads, "heads").items()]
    else:
        stated = [("", as_point(heads, "heads"))]
    return [WellPath(*well) for well in _core.read_wells(path, stated)]
