# SPDX-License-Identifier: LGPL-3.0-or-later
"""Regions of space, and parts of surfaces, by expressions over surfaces."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

from . import _core
from ._arrangement import as_move
from ._arrays import Path, UInt32Array, as_flag, as_text, as_word
from ._errors import Error
from ._mesh import Mesh, OnMesh, require_conforming
from ._results import counted
from ._rounding import RoundingReport, rounding_report
from ._run import how
from ._surface import as_surfaces, parts_of_surfaces, warn_of_doubts


class SelectedPiece(NamedTuple):
    """A part of a region that is connected through more than edges and points.

    Attributes
    ----------
    volume : float
        The exact volume, rounded once; cubic unit of the input.
    exact_volume : Fraction or None
        Itself, with ``fractions=True``.
    triangles : int
        Triangles of the mesh that bound it; 0: it was too thin for doubles.

    Examples
    --------
    >>> a, b = ...
    >>> terrane.select([a, b], "a - b").pieces
    [SelectedPiece(volume=7.0, exact_volume=None, triangles=24)]
    """

    volume: float
    exact_volume: Optional[Fraction]
    triangles: int


class Selected(OnMesh):
    """A region of space, by its boundary, or a part of an open surface.

    Attributes
    ----------
    mesh : Mesh
        The boundary; triangles face outwards. Its surfaces and parents are those of the input. It is conforming if
        ``rounding.clean``.
    piece_of : ndarray, shape (m,), uint32
        Per triangle of the mesh: the index in `pieces` of the piece that it bounds; empty for a part of a surface.
    pieces : list of SelectedPiece
    cavities : int
        Bounded parts of space without the region.
    volume : float
        The exact volume, rounded once; cubic unit of the input.
    exact_volume : Fraction or None
        Itself, with ``fractions=True``.
    is_surface : bool
        Whether a part of an open surface is selected, which has no volume and no pieces. Its triangles face as they
        did.
    regions : int
        Regions of that part.
    rounding : RoundingReport

    Examples
    --------
    >>> a, b = ...
    >>> terrane.select([a, b], "a ^ b")
    <Selected: volume 14, 2 pieces, 1 cavity, 48 triangles>
    """

    __slots__ = ("mesh", "piece_of", "pieces", "cavities", "volume", "exact_volume", "is_surface", "regions",
                 "rounding", "_report")

    def __init__(self, mesh: Mesh, piece_of: UInt32Array, report: Dict[str, Any]) -> None:
        self._report = report
        self.mesh = mesh
        self.piece_of = piece_of
        self.pieces: List[SelectedPiece] = [SelectedPiece(v, _fraction(text), n) for v, text, n in report["pieces"]]
        self.cavities = int(report["cavities"])
        self.volume = float(report["volume"])
        self.exact_volume: Optional[Fraction] = _fraction(report["exact_volume"])
        self.is_surface = bool(report["is_surface"])
        self.regions = int(report["regions"])
        self.rounding: RoundingReport = rounding_report(report["rounding"])

    def save(self, path: Path, format: Optional[str] = None, **options: Any) -> None:
        """Write the mesh as ``terrane select`` does: only if it is conforming, and there is one; see `Mesh.save`.

        Raises
        ------
        terrane.Error
            ``improper_contact``; ``nothing_to_do`` if nothing is selected; those of `Mesh.save`.

        Examples
        --------
        >>> a, b = ...
        >>> terrane.select([a, b], "a & b").save("both.stl")
        """
        require_conforming(self.rounding.clean, len(self.rounding.contacts))
        if not len(self.mesh.triangles):
            raise Error("nothing_to_do", "nothing is selected, so nothing is written", str(path))
        self.mesh.save(path, format, **options)

    def _state(self) -> Tuple[Any, ...]:
        return self.mesh, self.piece_of, self._report

    def _line(self) -> str:
        if self.is_surface:
            return f"surface, {counted(self.regions, 'region')}, {counted(len(self.mesh.triangles), 'triangle')}"
        cavities = "1 cavity" if self.cavities == 1 else f"{self.cavities} cavities"
        return (f"volume {_core.figure(self.volume)}, {counted(len(self.pieces), 'piece')}, {cavities}, "
                f"{counted(len(self.mesh.triangles), 'triangle')}")

    def _numbers(self) -> Dict[str, Any]:
        if self.is_surface:
            return {"regions": self.regions, **self.mesh._numbers()}
        return {"volume": _core.figure(self.volume), "pieces": len(self.pieces), "cavities": self.cavities,
                **self.mesh._numbers()}


def _fraction(text: str) -> Optional[Fraction]:
    return Fraction(text) if text else None


def select(surfaces: Any, expression: str, *, rule: str = "nonzero", fractions: bool = False,
           max_move: Optional[float] = None, threads: Optional[int] = None, progress: Any = None) -> Selected:
    """Select a region of space by an expression over surfaces, such as ``"(a | b) - c"``, or a part of a surface.

    Parameters
    ----------
    surfaces : as in `arrange`
        They may cross, touch, overlap and contain themselves and each other. Surfaces with one name are one operand.
    expression : str
        Operators as in Python: ``a | b`` (union), ``a & b`` (intersection), ``a - b`` (difference), ``a ^ b``
        (symmetric difference), ``~a`` (complement), and brackets. Names with other characters than letters, digits,
        ``_`` and ``.`` stand in double quotes. A surface ``s`` that is not closed has sides: ``below(s)`` and
        ``above(s)``, ``west(s)`` and ``east(s)``, ``south(s)`` and ``north(s)``; ``hull(s)`` is all that it keeps from
        infinity. One name that stands alone, beside functions, may be an open surface, of which a part is selected:
        ``"fault & below(top)"``, ``"horizon & inside(body)"``.
    rule : {"nonzero", "positive", "odd"}, optional
        The winding numbers of points that are inside of a surface.
    fractions : bool, optional
        Whether to compute `exact_volume`, which is slow for many constructed corners.
    max_move : float, optional
        As in `round`.

    Warns
    -----
    terrane.Doubt
        For each likely mistake in the surfaces, such as different units.

    Raises
    ------
    terrane.Error
        ``bad_option`` for an expression with a mistake, with its column, for a name of no surface, and if the region
        has no end; ``not_closed``, with the place, for a closed operand that bounds no solid, and for an open one that
        ends inside a part; those of `arrange` and `round`.

    Notes
    -----
    ``a | b``, ``a & b``, ``a - b`` and ``a ^ b`` of two `Surface` do the same and return a `Surface`.

    Examples
    --------
    >>> a, b = ...
    >>> terrane.select([a, b], "b - a", fractions=True).exact_volume
    Fraction(7, 1)
    """
    given = as_surfaces(surfaces)
    warn_of_doubts(given, ["duplicate_surface"])
    mesh, piece_of, report = _core.select(
        parts_of_surfaces(given), as_text(expression, "expression"), as_word(rule, "rule"),
        as_flag(fractions, "fractions"), as_move(max_move), how(threads, progress))
    return Selected(Mesh(mesh), piece_of, report)
