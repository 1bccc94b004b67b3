# SPDX-License-Identifier: LGPL-3.0-or-later
"""The report of rounding."""

from __future__ import annotations

from typing import Any, Dict, List, NamedTuple, Tuple

from ._arrays import UInt32Array
from ._mesh import Contact
from ._results import by_value


@by_value
class RoundingReport(NamedTuple):
    """The moves, contacts and losses of rounding; distances in the unit of the input.

    Attributes
    ----------
    clean : bool
        Whether the doubles are a conforming mesh, by exact check.
    contacts : list of Contact
        Pairs of triangles of the mesh that still meet improperly; if they are more than 100 000, there may be more.
    surface_deviation : float
        No point of the mesh is farther from the triangles of the input that it is part of, and no point of these is
        farther from their parts, except for what vanished; at most `max_allowed`.
    vanished_length : float
        Points of slivers that became narrower than doubles, and vanished, are at most so much farther from the rest.
    max_move : float
        No vertex is farther from its exact point.
    arranged_again : bool
        Whether exact points are those in which surfaces cross after they were moved, by at most `surface_deviation`.
    deviation : float
        What a certificate states of all points, vanished slivers included.

    Examples
    --------
    >>> rounded = ...
    >>> rounded.report.clean, rounded.report.max_move
    (True, 0.0)
    """

    clean: bool
    rounds: int
    naive_contacts: int
    contacts: List[Contact]
    surface_deviation: float
    max_allowed: float
    sufficient_limit: float
    vanished_length: float
    max_move: float
    arranged_again: bool
    deviation: float
    moved_input_vertices: int
    merged_vertices: int
    collapsed_triangles: int
    vanished_regions: List[Tuple[int, int, int]]
    vanished: UInt32Array


def rounding_report(values: Dict[str, Any]) -> RoundingReport:
    """Return the report of the extension module with names."""
    named: Dict[str, Any] = {**values, "contacts": [Contact(*c) for c in values["contacts"]]}
    return RoundingReport(**{name: named[name] for name in RoundingReport._fields})
