# SPDX-License-Identifier: LGPL-3.0-or-later
"""Volumes of interest: closed boundaries, and the part of an arrangement inside one."""

from __future__ import annotations

from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from . import _core
from ._arrangement import Arrangement, _arranged
from ._arrays import Point, as_flag, as_list, as_number, as_point, as_points
from ._errors import bad_option
from ._results import Result, counted
from ._run import how
from ._surface import Surface, as_surfaces, parts_of_surfaces, surface_of_parts


class SurfaceCut(NamedTuple):
    """The change of one surface by a cut; areas in squared units, lengths in units of the input.

    Examples
    --------
    >>> flat, wall = ...
    >>> cut = terrane.volume_of_interest([flat], ((0, 0, -1), (2, 4, 1))).surfaces[0]
    >>> cut.area_inside, cut.area_outside
    (8.0, 8.0)
    """

    area_inside: float
    area_outside: float
    area_on_boundary: float
    pieces: int
    open_length: float
    open_borders: int


class OpenBorder(NamedTuple):
    """A border at which a surface ends inside the volume without meeting another one.

    Examples
    --------
    >>> import terrane
    >>> short = terrane.Surface([[1, 0.5, 0], [3, 0.5, 0], [3, 3, 0.5], [1, 3, 0.5]], [[0, 1, 2],
    ...     [0, 2, 3]], "short", "horizon")
    >>> voi = terrane.volume_of_interest([short], ((0, 0, -2), (4, 4, 2)))
    >>> voi.borders[0].surface, round(voi.borders[0].length, 3)
    (0, 9.099)
    """

    surface: int
    length: float
    place: Point


class VolumeOfInterest(Result):
    """The part of an arrangement inside a closed boundary, with the boundary.

    Attributes
    ----------
    arrangement : Arrangement
        Restricted to the inside and the boundary.
    surfaces : list of SurfaceCut
        Effects on each surface.
    borders : list of OpenBorder
        Where surfaces end inside.

    Examples
    --------
    >>> flat, wall = ...
    >>> terrane.volume_of_interest([flat, wall], ((0, 0, -1), (3, 3, 2)))
    <VolumeOfInterest: 68 triangles inside, 2 open borders>
    """

    __slots__ = ("arrangement", "surfaces", "borders")

    def __init__(self, arrangement: Arrangement, surfaces: List[SurfaceCut],
                 borders: List[OpenBorder]) -> None:
        self.arrangement = arrangement
        self.surfaces = surfaces
        self.borders = borders

    def _line(self) -> str:
        return (f"{counted(len(self.arrangement.triangles), 'triangle')} inside, "
                f"{counted(len(self.borders), 'open border')}")

    def _numbers(self) -> Dict[str, Any]:
        return {**self.arrangement._numbers(), "open borders": len(self.borders)}

    def _shape(self) -> Tuple[Any, Any]:
        return self.arrangement._shape()


def volume_of_interest(surfaces: Any, boundary: Any, *, threads: Optional[int] = None,
                       progress: Any = None) -> VolumeOfInterest:
    """Cut surfaces by a closed boundary and keep the inside, exactly.

    Parameters
    ----------
    surfaces : as in `arrange`
    boundary : list of Surface
        From `box`, `rotated_box`, `polygon` or `closed`; or a pair of corners (low, high) of a box.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "top")
    >>> inside = terrane.volume_of_interest([flat], terrane.box((0.5, 0.5, -1), (1, 1, 1)))
    >>> inside.surfaces[0].area_inside
    0.25
    """
    given, around = as_surfaces(surfaces), as_boundary(boundary)
    numbers = list(range(len(given), len(given) + len(around)))
    whole = _arranged(given + around, "auto", threads, progress)
    core, report = _core.cut(whole._core, numbers, how(threads, progress))
    return VolumeOfInterest(Arrangement(core, ("cut", whole, numbers)),
                            [SurfaceCut(*s) for s in report["surfaces"]],
                            [OpenBorder(*b) for b in report["borders"]])


def box(low: Sequence[float], high: Sequence[float]) -> List[Surface]:
    """Return the boundary of an axis-parallel box: surfaces "boundary top", "boundary side 1", ...

    Examples
    --------
    >>> import terrane
    >>> [s.name for s in terrane.box((0, 0, 0), (1, 1, 1))][:2]
    ['boundary top', 'boundary bottom']
    """
    return [surface_of_parts(p) for p in _core.box_boundary(as_point(low, "low"), as_point(high, "high"))]


def rotated_box(place: Sequence[float], lengths: Sequence[float], *, azimuth: float = 0,
                plunge: float = 0, roll: float = 0, is_corner: bool = False) -> List[Surface]:
    """Return the boundary of a box in any direction.

    Parameters
    ----------
    place : its centre, or with `is_corner` the corner that is lowest on all three edges
    lengths : three numbers
        Of its edges: across, along, up.
    azimuth, plunge, roll : float
        Degrees: of the edges along, clockwise from y; downwards; about these edges.

    Examples
    --------
    >>> import terrane
    >>> len(terrane.rotated_box((0, 0, 0), (1, 2, 3), azimuth=30))
    6
    """
    return [surface_of_parts(p) for p in _core.rotated_box_boundary(
        as_point(place, "place"), as_flag(is_corner, "is_corner"), list(as_point(lengths, "lengths")),
        as_number(azimuth, "azimuth"), as_number(plunge, "plunge"), as_number(roll, "roll"))]


def polygon(corners: Any, low: float, high: float) -> List[Surface]:
    """Return the boundary of a vertical prism over a simple polygon, between two heights.

    Parameters
    ----------
    corners : array_like, shape (n, 2)
        x, y in either order; the first may be repeated as the last.
    low, high : float
        Heights of its two ends.

    Examples
    --------
    >>> import terrane
    >>> len(terrane.polygon([[0, 0], [2, 0], [0, 2]], -1, 1))
    5
    """
    return [surface_of_parts(p) for p in _core.polygon_boundary(
        as_points(corners, "corners", 2), as_number(low, "low"), as_number(high, "high"))]


def closed(surfaces: Any, *, threads: Optional[int] = None, progress: Any = None) -> List[Surface]:
    """Check surfaces that are closed together, and return them with the role boundary.

    Examples
    --------
    >>> import terrane
    >>> sides = [s.replace(role="unknown") for s in terrane.box((0, 0, 0), (1, 1, 1))]
    >>> terrane.closed(sides)[0].role
    'boundary'
    """
    made = _core.closed_boundary(parts_of_surfaces(as_surfaces(surfaces)), how(threads, progress))
    return [surface_of_parts(p) for p in made]


def as_boundary(value: Any) -> List[Surface]:
    """Return the surfaces of a boundary: given as such, or as two corners of a box."""
    if value is None:
        return []
    if isinstance(value, Surface):
        return [value]
    if isinstance(value, np.ndarray) and value.size != 6:
        raise bad_option(f"must be six numbers, not an array of the shape {value.shape}", "box")
    items = as_list(value, "box")
    if items and all(isinstance(item, Surface) for item in items):
        return items
    if len(items) == 6:
        items = [items[:3], items[3:]]
    if len(items) == 2:
        return box(items[0], items[1])
    raise bad_option("is neither surfaces, nor two corners (x, y, z) of a box, nor six numbers", "box")


def extend(surfaces: Any, boundary: Any, limit: float, *, threads: Optional[int] = None,
           progress: Any = None) -> List[Surface]:
    """Extend horizons that end inside a boundary to it, by at most `limit` (unit of the input).

    Returns the surfaces without the boundary; new triangles come last in each.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[1, 1, 0], [4, 1, 0], [1, 4, 0]], [[0, 1, 2]], "top", "horizon")
    >>> longer, = terrane.extend([flat], terrane.box((0, 0, -1), (5, 5, 1)), 9)
    >>> len(longer.triangles) > 1
    True
    """
    given, around = as_surfaces(surfaces), as_boundary(boundary)
    numbers = list(range(len(given), len(given) + len(around)))
    made, _ = _core.extend(parts_of_surfaces(given + around), numbers,
                           as_number(limit, "limit", positive=True), how(threads, progress))
    return [surface_of_parts(p) for p in made][:len(given)]
