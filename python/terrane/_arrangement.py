# SPDX-License-Identifier: LGPL-3.0-or-later
"""The exact arrangement of surfaces, its part in a volume of interest, and its mesh of doubles."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Callable, Dict, List, Optional, Tuple

import numpy as np

from . import _core
from ._arrays import Float64Array, IndexLists, Path, SurfaceInfo, UInt32Array, as_count, as_flag, as_number, as_word
from ._interop import polydata
from ._mesh import CheckReport, Mesh, OnMesh, Region, Regions, mesh_of, require_conforming
from ._report import facts
from ._results import Part, Result, counted
from ._rounding import RoundingReport, rounding_report
from ._run import how
from ._surface import Surface, as_surfaces, parts_of_surfaces, surface_of_parts, warn_of_doubts


class Arrangement(Result):
    """The exact arrangement of surfaces.

    Two triangles share a vertex, an edge, or nothing; each input triangle with area is exactly the union of the
    triangles that name it as a parent. Coordinates are exact rational numbers: `vertices` has the nearest doubles,
    `coordinates` the numbers themselves, and `terrane.round` makes a mesh of doubles that is conforming.

    Input vertices and triangles are numbered through all surfaces. Pickling keeps the surfaces and makes the
    arrangement again, which gives the same one.

    Examples
    --------
    >>> flat, wall = ...
    >>> terrane.arrange([flat, wall])
    <Arrangement: 2 surfaces, 10 vertices, 13 triangles, 2 intersection edges>
    """

    __slots__ = ("_core", "_made_by", "_nearest")

    def __init__(self, core: _core.Arrangement, made_by: Tuple[Any, ...]) -> None:
        self._core = core
        self._made_by = made_by  # a function of this module by name, and its arguments
        self._nearest: Optional[Float64Array] = None

    surfaces = Part[List[SurfaceInfo]](
        "Names and roles of the surfaces, in the order of the input.", SurfaceInfo.all_of)

    @property
    def vertices(self) -> Float64Array:
        """The doubles nearest to the vertices: ndarray, shape (n, 3), float64."""
        if self._nearest is None:
            self._nearest = self._core.nearest()
        return self._nearest.view()  # whose shape people may change

    triangles = Part[UInt32Array]("Indices into `vertices`: ndarray, shape (m, 3), uint32.")
    parents_of = Part[IndexLists](
        "Per triangle all input triangles that contain it; several where surfaces overlap.", IndexLists._of)
    surfaces_of = Part[IndexLists]("Per triangle the surfaces of its parents.", IndexLists._of)
    intersection_edges = Part[UInt32Array]("Edges at which surfaces meet: ndarray, shape (k, 2), uint32.")
    degenerate = Part[UInt32Array]("Input triangles without area: ndarray, uint32.")
    duplicates = Part[UInt32Array]("Input triangles and the first with the same points: ndarray, shape (k, 2), uint32.")
    first_triangle = Part[UInt32Array]("Per surface its first input triangle, and their number at the end.")
    statistics = Part[Dict[str, Any]]("Counts of the steps.")

    def coordinates(self, vertex: int) -> Tuple[Fraction, Fraction, Fraction]:
        """Return the exact coordinates of a vertex.

        Examples
        --------
        >>> import terrane
        >>> flat = terrane.Surface([[0, 0, 0], [3, 0, 0], [0, 3, 0]], [[0, 1, 2]])
        >>> wall = terrane.Surface([[1, 1, -1], [1, 1, 2], [1, 9, 0]], [[0, 1, 2]])
        >>> a = terrane.arrange([flat, wall])
        >>> sorted(a.coordinates(v) for v in range(len(a.vertices)))[3]
        (Fraction(1, 1), Fraction(1, 1), Fraction(0, 1))
        """
        v = as_count(vertex, "vertex", 0, len(self._core.points) - 1)
        x, y, z = (Fraction(text) for text in self._core.coordinates(v))
        return x, y, z

    def construction(self, vertex: int) -> Tuple[str, Tuple[int, ...]]:
        """Return how a vertex is made of input vertices: its kind, and their numbers.

        Kinds are "input", "line_plane" (2 and 3 vertices), "three_planes" (3, 3 and 3) and "line_line" (2 and 2).

        Examples
        --------
        >>> exact = ...
        >>> exact.construction(0)
        ('input', (0,))
        >>> exact.construction(len(exact.vertices) - 1)
        ('line_plane', (2, 3, 4, 5, 6))
        """
        v = as_count(vertex, "vertex", 0, len(self._core.points) - 1)
        kind, numbers = self._core.construction(v)
        return kind, numbers

    def digest(self, *, threads: Optional[int] = None) -> str:
        """Return a hash of the geometry that depends on no numbering: "sha256:...".

        It is the one in certificates and of ``terrane arrange --stats``.

        Examples
        --------
        >>> import terrane
        >>> flat = terrane.Surface([[0, 0, 0], [3, 0, 0], [0, 3, 0]], [[0, 1, 2]], "top")
        >>> terrane.arrange([flat]).digest()[:16]
        'sha256:4dbe9ddec'
        """
        return _core.digest(parts_of_surfaces(_inputs(self)), self._core, how(threads, None))

    def report(self, path: Path, *, threads: Optional[int] = None) -> None:
        """Write the page of ``terrane arrange --report``: one HTML file with the mesh of doubles, as `round` makes it.

        A mesh that is not conforming is shown with its improper contacts.

        Raises
        ------
        terrane.Error
            ``unsupported`` in a build without report pages, which says why; those of `round`; ``cannot_open`` and
            ``write_failed`` for the file.

        Examples
        --------
        >>> import os, terrane
        >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "top")
        >>> if terrane.HAS_REPORTS:
        ...     terrane.arrange([flat]).report("top.html")
        >>> os.path.exists("top.html") == terrane.HAS_REPORTS
        True
        """
        surfaces = _inputs(self)
        _core.report_arrangement(self._core, parts_of_surfaces(surfaces), path,
                                 facts("Arrangement.report", [s.name for s in surfaces], {}), how(threads, None))

    def to_pyvista(self) -> Any:
        """Return a ``pyvista.PolyData`` of the nearest doubles. Needs PyVista.

        Examples
        --------
        >>> import terrane
        >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "flat")
        >>> terrane.arrange([flat]).to_pyvista().points.shape
        (3, 3)
        """
        return polydata(self.vertices, self.triangles, {"surface": self.surfaces_of.first})

    def _state(self) -> Tuple[Any, ...]:
        return self._made_by

    @classmethod
    def _from_state(cls, *state: Any) -> "Arrangement":
        makers: Dict[str, Callable[..., Arrangement]] = {"arrange": _arranged, "cut": _cut_again,
                                                         "seal": _sealed_again}
        return makers[state[0]](*state[1:])

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Arrangement):
            return NotImplemented
        a, b = self._core, other._core
        same_lists = all(np.array_equal(x, y) for n in ("parents_of", "surfaces_of")
                         for x, y in zip(getattr(a, n), getattr(b, n)))
        return bool(same_lists and list(a.surfaces) == list(b.surfaces)
                    and np.array_equal(a.triangles, b.triangles)
                    and np.array_equal(self.vertices, other.vertices)
                    and _inputs(self) == _inputs(other))

    __hash__ = None  # type: ignore[assignment]

    def _line(self) -> str:
        return (f"{counted(len(self._core.surfaces), 'surface')}, {counted(len(self._core.points), 'vertex')}, "
                f"{counted(len(self.triangles), 'triangle')}, "
                f"{counted(len(self.intersection_edges), 'intersection edge')}")

    def _numbers(self) -> Dict[str, Any]:
        return {"surfaces": len(self._core.surfaces), "vertices": len(self._core.points),
                "triangles": len(self.triangles), "intersection edges": len(self.intersection_edges)}

    def _shape(self) -> Tuple[Any, Any]:
        return self.vertices, self.triangles


def _inputs(a: Arrangement) -> List[Surface]:
    """Return the surfaces whose arrangement it is."""
    if a._made_by[0] == "cut":
        return _inputs(a._made_by[1])
    surfaces: List[Surface] = a._made_by[1] if a._made_by[0] == "arrange" else a._made_by[4]
    return surfaces


def _arranged(surfaces: List[Surface], search: str, threads: Optional[int] = None,
              progress: Any = None) -> Arrangement:
    core = _core.arrange(parts_of_surfaces(surfaces), search, how(threads, progress))
    return Arrangement(core, ("arrange", surfaces, search))


def _cut_again(whole: Arrangement, boundary: List[int]) -> Arrangement:
    core, _ = _core.cut(whole._core, boundary, how(None, None))
    return Arrangement(core, ("cut", whole, boundary))


def _sealed_again(surfaces: List[Surface], distance: float, distance_of: Dict[Any, float],
                  _: List[Surface]) -> Arrangement:
    # The surfaces that were changed are made again as well: those of a changed pickle need not be of this arrangement.
    core, made, _report = _core.seal(parts_of_surfaces(surfaces), distance, distance_of, how(None, None))
    return Arrangement(core, ("seal", surfaces, distance, distance_of, [surface_of_parts(p) for p in made]))


class RoundedMesh(OnMesh):
    """The mesh of doubles of an arrangement, its regions, and the report of rounding.

    Attributes
    ----------
    mesh : Mesh
        Conforming, by exact check of the doubles, if `clean`.
    regions : list of Region
        Regions of the mesh; ``mesh.regions_of`` refers to them.
    report : RoundingReport
        Moves, contacts and losses.

    Examples
    --------
    >>> rounded = ...
    >>> rounded
    <RoundedMesh: conforming, 13 triangles, 3 regions, moved by 0 at most>
    """

    __slots__ = ("mesh", "regions", "report")

    def __init__(self, mesh: Mesh, regions: List[Region], report: RoundingReport) -> None:
        self.mesh = mesh
        self.regions = regions
        self.report = report

    @property
    def clean(self) -> bool:
        """Whether exact predicates have shown that the doubles are a conforming mesh."""
        return self.report.clean

    def save(self, path: Path, format: Optional[str] = None, *, keep_unverified: bool = False, **options: Any) -> None:
        """Write the mesh as ``terrane arrange`` does: only if it is clean, or with `keep_unverified`.

        Examples
        --------
        >>> rounded = ...
        >>> rounded.save("model.obj")
        >>> len(terrane.read("model.obj"))
        2
        """
        if not as_flag(keep_unverified, "keep_unverified"):
            require_conforming(self.clean, len(self.report.contacts))
        super().save(path, format, **options)

    def _line(self) -> str:
        verdict = "conforming" if self.clean else f"{len(self.report.contacts)} improper contacts"
        return (f"{verdict}, {counted(len(self.mesh.triangles), 'triangle')}, "
                f"{counted(len(self.regions), 'region')}, moved by {_core.figure(self.report.max_move, 3)} at most")

    def _numbers(self) -> Dict[str, Any]:
        return {"conforming": "yes" if self.clean else "no", "regions": len(self.regions),
                "moved at most": _core.figure(self.report.max_move, 3), **self.mesh._numbers()}



def arrange(surfaces: Any, *, search: str = "auto", threads: Optional[int] = None,
            progress: Any = None) -> Arrangement:
    """Compute the exact arrangement of surfaces, which may also intersect themselves.

    Parameters
    ----------
    surfaces : Surface, list, or dict by name
        What `as_surfaces` takes.
    search : str, optional
        How triangles that may meet are found; the result is the same.
    threads : int, optional
        How many threads to use; all cores unless given. The result does not depend on it.
    progress : callable or bar, optional
        Called with the name of the stage and the share of it that is done, about 20 times a second; or a bar of
        tqdm. An exception that it raises stops the stage.

    Returns
    -------
    Arrangement

    Warns
    -----
    terrane.Doubt
        For each likely mistake in the surfaces.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "top")
    >>> wall = terrane.Surface([[1, 1, -1], [1, 1, 1], [1, 9, 0]], [[0, 1, 2]], "F1", "fault")
    >>> terrane.arrange([flat, wall])
    <Arrangement: 2 surfaces, 8 vertices, 8 triangles, 1 intersection edge>
    """
    given = as_surfaces(surfaces)
    made = _arranged(given, as_word(search, "search"), threads, progress)
    warn_of_doubts(given)
    return made


def round(arrangement: Any, *, max_rounds: int = 8, max_move: Optional[float] = None,
          threads: Optional[int] = None, progress: Any = None) -> RoundedMesh:
    """Round an arrangement to a mesh of doubles, and check it exactly.

    Parameters
    ----------
    arrangement : Arrangement, or a result that has one
    max_rounds : int, optional
        Limit on the rounds of snapping; 0: nearest doubles only.
    max_move : float, optional
        The farthest that a surface may move, unit of the input: a result beyond is not clean. By default 1024 times the
        spacing of doubles at the largest coordinate.
    threads, progress : optional
        As in `arrange`.

    Returns
    -------
    RoundedMesh
        Look at ``clean`` before you use the mesh.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "top")
    >>> wall = terrane.Surface([[1, 1, -1], [1, 1, 1], [1, 9, 0]], [[0, 1, 2]], "F1", "fault")
    >>> terrane.round(terrane.arrange([flat, wall]))
    <RoundedMesh: conforming, 8 triangles, 2 regions, moved by 0 at most>
    """
    a = arrangement_of(arrangement)
    rounds = as_count(max_rounds, "max_rounds", 0, 8)
    mesh, regions, report = _core.round(a._core, rounds, as_move(max_move), how(threads, progress))
    return RoundedMesh(Mesh(mesh), [Region(*r) for r in regions], rounding_report(report))


def as_move(max_move: Optional[float]) -> Optional[float]:
    """Return how far surfaces may move; None: as far as the library chooses."""
    return None if max_move is None else as_number(max_move, "max_move", positive=True)


def arrangement_of(value: Any) -> Arrangement:
    """Return the arrangement of a result that has one."""
    if isinstance(value, Arrangement):
        return value
    found = getattr(value, "arrangement", None)
    if isinstance(found, Arrangement):
        return found
    raise TypeError(f"that is an arrangement or a result with one, not {type(value).__name__}")


def check(surfaces: Any, *, threads: Optional[int] = None, progress: Any = None) -> CheckReport:
    """Diagnose surfaces, or a mesh, exactly. Nothing is repaired.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "top")
    >>> wall = terrane.Surface([[1, 1, -1], [1, 1, 1], [1, 9, 0]], [[0, 1, 2]], "F1", "fault")
    >>> report = terrane.check([flat, wall])
    >>> report
    <CheckReport: 1 improper contact, 0 without area, 0 repeated>
    >>> report.contacts[0].kind
    'crossing'
    """
    mesh = surfaces if isinstance(surfaces, Mesh) else getattr(surfaces, "mesh", None)
    parts = _whole(mesh) if isinstance(mesh, Mesh) else as_surfaces(surfaces)
    return CheckReport(_core.check(parts_of_surfaces(parts), how(threads, progress)))


def _whole(mesh: Mesh) -> List[Surface]:
    """Return a mesh as one surface, so that shared triangles are not repeated."""
    return [Surface(mesh.vertices, mesh.triangles, "mesh")]


def regions(mesh: Any, *, threads: Optional[int] = None, progress: Any = None) -> Regions:
    """Find the regions into which intersection edges divide each surface of a mesh.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "top")
    >>> wall = terrane.Surface([[1, -9, -9], [1, -9, 9], [1, 99, 0]], [[0, 1, 2]], "F1", "fault")
    >>> found = terrane.regions(terrane.round(terrane.arrange([flat, wall])))
    >>> [(r.surface, r.area) for r in found.regions]
    [(0, 3.5), (0, 4.5), (1, 972.0)]
    """
    offsets, values, found = _core.regions(mesh_of(mesh)._core, how(threads, progress))
    return Regions(IndexLists._of((offsets, values)), [Region(*r) for r in found])
