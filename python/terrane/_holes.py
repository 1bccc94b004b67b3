# SPDX-License-Identifier: LGPL-3.0-or-later
"""Holes of a surface, and filling them."""

from __future__ import annotations

import math
import os
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from ._arrays import Float64Array, Int32Array, Path, Point, UInt32Array, as_count, as_flag, as_list, as_number, as_word
from ._errors import Error, bad_option
from ._interop import meshio_mesh, polydata
from ._picture import card
from ._report import facts
from ._results import Result, by_value, counted
from ._run import describing, how
from ._surface import Surface, as_surface, parts_of_surfaces, surface_of_parts


@by_value
class BorderLoop(NamedTuple):
    """A closed border of a surface: "outer", "hole" or "fault gap". Lengths in the unit of the surface.

    ``vertices`` are those of the surface, in order; ``area`` is that of the largest projection; ``throw`` and ``width``
    tell holes from gaps torn by faults.

    Examples
    --------
    >>> holed = ...
    >>> loop = terrane.holes(holed)[0]
    >>> loop.kind, len(loop.vertices), round(loop.area, 3)
    ('hole', 4, 1.016)
    """

    kind: str
    vertices: UInt32Array
    length: float
    area: float
    centre: Point
    throw: float
    width: float


def holes(surface: Any, *, gap_slope: float = 0.25, outer: bool = False, threads: Optional[int] = None,
          progress: Any = None) -> List[BorderLoop]:
    """Find the holes of a surface, largest first, and with `outer` its outer borders as well.

    Examples
    --------
    >>> import terrane
    >>> x = [(i, j, 0) for j in range(4) for i in range(4)]
    >>> cells = [(i + 4 * j) for j in range(3) for i in range(3) if (i, j) != (1, 1)]
    >>> t = [t for c in cells for t in ((c, c + 1, c + 5), (c, c + 5, c + 4))]
    >>> [(h.kind, h.area) for h in terrane.holes(terrane.Surface(x, t))]
    [('hole', 1.0)]
    """
    slope, with_outer = as_number(gap_slope, "gap_slope", positive=True), as_flag(outer, "outer")
    loops = _core.border_loops(parts_of_surfaces([as_surface(surface)]), slope, how(threads, progress))
    found = [BorderLoop(*loop) for loop in loops]
    return found if with_outer else [loop for loop in found if loop.kind != "outer"]


@by_value
class FillReport(NamedTuple):
    """How a hole was filled, and how far that can be trusted; lengths in the unit of the surface.

    Examples
    --------
    >>> holed = ...
    >>> report = terrane.fill(holed).holes[0].report
    >>> report.interpolated, report.model.split(';')[0]
    (0, '12 models')
    """

    data: int
    interpolated: int
    area: float
    expected_error: float
    validated_error: float
    model: str


@by_value
class FilledHole(NamedTuple):
    """A hole, from 1; its report where it was filled, or the reason why not.

    Examples
    --------
    >>> holed = ...
    >>> hole = terrane.fill(holed).holes[0]
    >>> hole.number, hole.border.kind, hole.refused
    (1, 'hole', '')
    """

    number: int
    border: BorderLoop
    report: Optional[FillReport]
    refused: str


class Filled(Result):
    """A surface whose holes are filled. Given vertices and triangles come first, unchanged.

    Attributes
    ----------
    surface : Surface
    given_vertices, given_triangles : int
    expected_error : ndarray, shape (n,), float64
        Per vertex: 0 for what was given, NaN where the method foresees none; unit of the surface.
    hole_of : ndarray, shape (m,), int32
        Per triangle the number of its hole, or 0.
    holes : list of FilledHole

    Examples
    --------
    >>> holed = ...
    >>> terrane.fill(holed)
    <Filled: 1 of 1 hole, 2 new triangles>
    """

    __slots__ = ("surface", "given_vertices", "given_triangles", "expected_error", "hole_of", "holes", "_work", "_options")

    def __init__(self, surface: Surface, given_vertices: int, given_triangles: int,
                 expected_error: Float64Array, hole_of: Int32Array, found: List[FilledHole],
                 work: Optional[_core.FillWork] = None, options: Optional[Dict[str, Any]] = None) -> None:
        self._work = work  # for reports; a pickle has none
        self._options = options or {}
        self.surface = surface
        self.given_vertices = given_vertices
        self.given_triangles = given_triangles
        self.expected_error = expected_error
        self.hole_of = hole_of
        self.holes = found

    def save(self, path: Path, format: Optional[str] = None) -> None:
        """Write the surface.

        Examples
        --------
        >>> holed = ...
        >>> terrane.fill(holed).save("filled.ts")
        >>> len(terrane.read("filled.ts")[0].triangles)
        32
        """
        self.surface.save(path, format)

    def report(self, path: Path, *, threads: Optional[int] = None) -> None:
        """Write the report page of ``terrane fill --report``: one HTML file with the filled surface and its numbers.

        Raises
        ------
        terrane.Error
            ``unsupported`` in a build without report pages, and of what comes from a pickle, which does not hold how
            holes were filled; ``cannot_open`` and ``write_failed`` for the file.

        Examples
        --------
        >>> import os, terrane
        >>> x = [(i, j, 0.1 * i) for j in range(6) for i in range(6)]
        >>> cells = [(i + 6 * j) for j in range(5) for i in range(5) if (i, j) != (2, 2)]
        >>> t = [t for c in cells for t in ((c, c + 1, c + 7), (c, c + 7, c + 6))]
        >>> if terrane.HAS_REPORTS:
        ...     terrane.fill(terrane.Surface(x, t)).report("filled.html")
        >>> os.path.exists("filled.html") == terrane.HAS_REPORTS
        True
        """
        if self._work is None:
            raise Error("unsupported", "what comes from a pickle has no report; fill again", os.fsdecode(path))
        run = how(threads, None)
        _core.report_filled(self._work, parts_of_surfaces([self.surface]), path,
                            facts("Filled.report", [self.surface.name], self._options), run)

    def to_pyvista(self) -> Any:
        """Return a ``pyvista.PolyData`` with ``hole`` and ``expected_error``. Needs PyVista.

        Examples
        --------
        >>> holed = ...
        >>> terrane.fill(holed).to_pyvista().points.shape
        (25, 3)
        """
        made = polydata(self.surface.vertices, self.surface.triangles, {"hole": self.hole_of})
        made.point_data["expected_error"] = np.array(self.expected_error)
        return made

    def to_meshio(self) -> Any:
        """Return a ``meshio.Mesh`` with ``hole`` and ``expected_error``. Needs meshio.

        Examples
        --------
        >>> holed = ...
        >>> terrane.fill(holed).to_meshio().cells_dict["triangle"].shape
        (32, 3)
        """
        made = meshio_mesh(self.surface.vertices, {"triangle": self.surface.triangles},
                           {"hole": [np.array(self.hole_of)]})
        made.point_data["expected_error"] = np.array(self.expected_error)
        return made

    def plot(self, **options: Any) -> Any:
        """Show the expected error. Needs PyVista.

        Examples
        --------
        >>> holed = ...
        >>> shown = terrane.fill(holed).plot()
        """
        return self.to_pyvista().plot(**{"scalars": "expected_error", **options})

    def _state(self) -> Tuple[Any, ...]:
        return self.surface, self.given_vertices, self.given_triangles, self.expected_error, self.hole_of, self.holes

    def _line(self) -> str:
        done = sum(h.report is not None for h in self.holes)
        return (f"{done} of {counted(len(self.holes), 'hole')}, "
                f"{counted(len(self.surface.triangles) - self.given_triangles, 'new triangle')}")

    def _numbers(self) -> Dict[str, Any]:
        return {"holes": len(self.holes), "filled": sum(h.report is not None for h in self.holes),
                "triangles": len(self.surface.triangles)}

    def _repr_html_(self) -> str:
        return card("Filled", self._numbers(), self.surface.vertices, self.surface.triangles, self.hole_of)


def _holes_of(rows: Sequence[Tuple[Any, ...]]) -> List[FilledHole]:
    return [FilledHole(number, BorderLoop(*border), None if report is None else FillReport(*report), refused)
            for number, border, report, refused in rows]


@describing(_core.fill_fields)
def fill(surface: Any, *, method: str = "kriging", holes: Optional[Sequence[int]] = None, model: str = "auto",
         max_area: float = math.inf, mesh_size: float = 0, rings: int = 5, gap_slope: float = 0.25,
         isotropic: bool = False, bridge_faults: bool = False,
         smoothing: Union[None, float, str] = None, threads: Optional[int] = None,
         progress: Any = None) -> Filled:
    """Fill the holes of a surface, and say how sure that is.

    Parameters
    ----------
    surface : Surface, or what `as_surface` takes
    method : {"kriging", "rbf"}
        Kriging is for surfaces z = f(x, y); radial basis functions are for any.
    holes : list of int, optional
        Numbers of the holes, from 1, the largest first; all unless given.
    model : str, optional
        Of the variogram: "auto", "spherical", "exponential", "gaussian", "power", "matern".
    OPTIONS
    smoothing : float or "auto", optional
        Misfit of "rbf" to noisy data, unit of the surface.

    Examples
    --------
    >>> import terrane
    >>> x = [(i, j, 0.1 * i) for j in range(6) for i in range(6)]
    >>> cells = [(i + 6 * j) for j in range(5) for i in range(5) if (i, j) != (2, 2)]
    >>> t = [t for c in cells for t in ((c, c + 1, c + 7), (c, c + 7, c + 6))]
    >>> filled = terrane.fill(terrane.Surface(x, t))
    >>> len(filled.holes), filled.given_triangles, terrane.holes(filled.surface)
    (1, 48, [])
    """
    if as_word(method, "method") not in ("kriging", "rbf"):
        raise bad_option(f"{method!r} is neither kriging nor rbf", "method")
    if smoothing is not None and method != "rbf":
        raise bad_option("is for the method rbf", "smoothing")
    if isinstance(smoothing, str) and smoothing != "auto":
        raise bad_option(f"{smoothing!r} is neither a number nor 'auto'", "smoothing")
    smooth = None if smoothing is None else 0.0 if smoothing == "auto" \
        else as_number(smoothing, "smoothing", positive=True)
    options = {"method": method, "model": as_word(model, "model"),
               "max_area": math.inf if isinstance(max_area, float) and max_area == math.inf else as_number(max_area, "max_area", positive=True),
               "mesh_size": as_number(mesh_size, "mesh_size", least=0),
               "rings": as_count(rings, "rings", 1, 1000),
               "gap_slope": as_number(gap_slope, "gap_slope", positive=True),
               "isotropic": as_flag(isotropic, "isotropic"), "bridge_faults": as_flag(bridge_faults, "bridge_faults"),
               "smoothing": smooth}
    numbers = None if holes is None else [as_count(h, "holes") for h in as_list(holes, "holes")]
    made = _core.fill(parts_of_surfaces([as_surface(surface)]), options, numbers, how(threads, progress))
    return Filled(surface_of_parts(made[0]), made[1], made[2], made[3], made[4], _holes_of(made[5]),
                  made[6], options)
