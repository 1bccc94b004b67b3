# SPDX-License-Identifier: LGPL-3.0-or-later
"""How surfaces and blocks of a model are to each other."""

from __future__ import annotations

from typing import NamedTuple, Tuple

from ._arrays import Point


class Leak(NamedTuple):
    """Where a surface ends near another one without meeting it.

    ``from_surface`` ends, ``to_surface`` is the nearest one; ``length`` is that of the border, ``least`` and
    ``largest`` its distances, ``place`` where it is largest; unit of the input. ``verdict`` is "separates" (closing
    the gap would separate blocks), "harmless", "wide" (wider than gaps that were tried), or "" (not judged).

    Examples
    --------
    >>> wall, short = ...
    >>> m = terrane.model([wall, short], box=((0, -1, -1), (3, 3, 3)))
    >>> leak = m.leaks[0]
    >>> leak.from_surface, leak.to_surface, leak.verdict
    ('wall', 'short', 'wide')
    """

    from_surface: str
    to_surface: str
    length: float
    least: float
    largest: float
    place: Point
    verdict: str


class Relation(NamedTuple):
    """The relation of two surfaces where they meet or nearly meet: "stops at", "crosses", "meets", "overlaps", "ends near".

    Examples
    --------
    >>> flat, wall = ...
    >>> m = terrane.model([flat, wall], box=((0, 0, -1), (4, 4, 2)))
    >>> [(r.kind, r.to_surface) for r in m.relations if r.from_surface == 'wall'][-1]
    ('ends near', 'boundary side 3')
    """

    from_surface: str
    to_surface: str
    kind: str
    length: float
    least: float
    largest: float
    place: Point


class Juxtaposition(NamedTuple):
    """Two blocks that face each other across a surface, and the area.

    Examples
    --------
    >>> m = ...
    >>> m.juxtapositions[0].surface, m.juxtapositions[0].area
    ('flat', 16.0)
    """

    surface: str
    blocks: Tuple[str, str]
    area: float
