# SPDX-License-Identifier: LGPL-3.0-or-later
"""Closing gaps between surfaces."""

from __future__ import annotations

from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Tuple

from . import _core
from ._arrangement import Arrangement
from ._arrays import Point, as_mapping, as_number, as_pair
from ._results import Result, counted
from ._run import how
from ._surface import Surface, as_surfaces, parts_of_surfaces, surface_of_parts
from ._volume_of_interest import as_boundary


class SealChange(NamedTuple):
    """A border that was "extended" or "trimmed"; lengths in the unit of the input.

    Examples
    --------
    >>> wall, short = ...
    >>> change = terrane.seal([wall, short], 0.2).changes[0]
    >>> change.kind, change.surface, change.length
    ('extended', 1, 2.0)
    """

    kind: str
    surface: int
    length: float
    largest: float
    place: Point
    triangles: int


class ClosedGap(NamedTuple):
    """The free part of a border edge that was extended to another surface.

    Examples
    --------
    >>> wall, short = ...
    >>> gap = terrane.seal([wall, short], 0.2).closed[0]
    >>> gap.from_surface, gap.to_surface, round(gap.width, 3)
    (1, 0, 0.1)
    """

    from_surface: int
    to_surface: int
    length: float
    width: float
    place: Point


class OpenGap(NamedTuple):
    """Border edges that stay open, and why.

    Examples
    --------
    >>> wall, short = ...
    >>> gaps = terrane.seal([wall, short], 0.2).open
    >>> [gap.reason for gap in gaps]
    []
    """

    from_surface: int
    to_surface: int
    reason: str
    edges: int
    length: float
    width: float
    place: Point


class Sealed(Result):
    """Surfaces whose gaps are closed, and their arrangement.

    Attributes
    ----------
    arrangement : Arrangement
    surfaces : list of Surface
        The input with the triangles by which gaps were closed, which come last in each.
    changes : list of SealChange
    closed : list of ClosedGap
    open : list of OpenGap
    left : float
        Length of the free borders that remain this near to another surface.

    Examples
    --------
    >>> sealed = ...
    >>> sealed
    <Sealed: 1 change, 0 open gaps, 12 triangles>
    >>> len(sealed.closed), len(sealed.open)
    (1, 0)
    """

    __slots__ = ("arrangement", "surfaces", "changes", "closed", "open", "left")

    def __init__(self, arrangement: Arrangement, surfaces: List[Surface], changes: List[SealChange],
                 closed: List[ClosedGap], open: List[OpenGap], left: float) -> None:
        self.arrangement = arrangement
        self.surfaces = surfaces
        self.changes = changes
        self.closed = closed
        self.open = open
        self.left = left

    def _line(self) -> str:
        return (f"{counted(len(self.changes), 'change')}, {counted(len(self.open), 'open gap')}, "
                f"{counted(len(self.arrangement.triangles), 'triangle')}")

    def _numbers(self) -> Dict[str, Any]:
        return {"changes": len(self.changes), "open gaps": len(self.open), **self.arrangement._numbers()}

    def _shape(self) -> Tuple[Any, Any]:
        return self.arrangement._shape()


def seal(surfaces: Any, distance: float, *,
         distance_of: Optional[Mapping[Any, float]] = None,
         threads: Optional[int] = None, progress: Any = None) -> Sealed:
    """Close gaps of at most `distance` between surfaces: extend borders that end short, trim those that reach beyond.

    Parameters
    ----------
    surfaces : as in `arrange`
    distance : float
        Unit of the input; 0 with `distance_of`: only those.
    distance_of : dict, optional
        Other distances: by surface ``"F1"``, or pair ``("F1", "F2")`` or ``"F1/F2"``; 0: never close these.

    Examples
    --------
    >>> import terrane
    >>> wall = terrane.Surface([[0, 0, 0], [0, 9, 0], [0, 9, 9], [0, 0, 9]], [[0, 1, 2], [0, 2, 3]], "F1")
    >>> flat = terrane.Surface([[0.1, 1, 4], [5, 1, 4], [5, 8, 4], [0.1, 8, 4]], [[0, 1, 2], [0, 2, 3]], "top")
    >>> sealed = terrane.seal([wall, flat], 0.5)
    >>> [(c.kind, sealed.surfaces[c.surface].name) for c in sealed.changes]
    [('extended', 'top')]
    """
    given = as_surfaces(surfaces)
    of = {as_pair(k, "distance_of"): as_number(v, f"distance_of[{k!r}]", least=0)
          for k, v in as_mapping(distance_of, "distance_of").items()}
    width = as_number(distance, "distance", least=0)
    core, made, report = _core.seal(parts_of_surfaces(given), width, of, how(threads, progress))
    changed = [surface_of_parts(p) for p in made]
    return Sealed(Arrangement(core, ("seal", given, width, of, changed)), changed,
                  [SealChange(*c) for c in report["changes"]], [ClosedGap(*c) for c in report["closed"]],
                  [OpenGap(*c) for c in report["open"]], report["left"])


class SealTrial(NamedTuple):
    """The model that results from one distance.

    Examples
    --------
    >>> wall, short = ...
    >>> [trial.blocks for trial in terrane.suggest_seal([wall, short]).trials]
    [0, 0]
    """

    distance: float
    blocks: int
    small: int
    changes: int
    triangles: int
    length: float
    left: float


class SealAdvice(NamedTuple):
    """The distance that the widths of gaps suggest, and the models that others give.

    Examples
    --------
    >>> wall, short = ...
    >>> advice = terrane.suggest_seal([wall, short])
    >>> advice.distance, len(advice.trials)
    (0.2, 2)
    """

    distance: float
    trials: List[SealTrial]


def suggest_seal(surfaces: Any, box: Any = None, *, threads: Optional[int] = None,
                 progress: Any = None) -> SealAdvice:
    """List the distances of sealing at natural breaks in the widths of gaps, and the blocks that each gives.

    Examples
    --------
    >>> import terrane
    >>> terrane.suggest_seal(terrane.box((0, 0, 0), (1, 1, 1))).trials[0].blocks
    1
    """
    report = _core.suggest_seal(parts_of_surfaces(as_surfaces(surfaces)),
                                parts_of_surfaces(as_boundary(box)), how(threads, progress))
    return SealAdvice(report["distance"], [SealTrial(*t) for t in report["trials"]])
