# SPDX-License-Identifier: LGPL-3.0-or-later
"""Stacks of hard and soft horizons."""

from __future__ import annotations

from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

from . import _core
from ._arrangement import as_move
from ._arrays import Path, Point, as_list, as_number
from ._errors import Error, bad_option
from ._mesh import Mesh, OnMesh
from ._results import counted
from ._rounding import RoundingReport, rounding_report
from ._run import how
from ._surface import Surface, as_surfaces, parts_of_surfaces


class LayerReport(NamedTuple):
    """The change of one horizon; areas in squared units.

    Examples
    --------
    >>> stack = ...
    >>> report = stack.reports[0]
    >>> report.surface, report.taken, round(report.taken_area, 3)
    (0, 4, 8.0)
    """

    surface: int
    dropped: int
    taken: int
    parts: int
    dropped_area: float
    taken_area: float
    largest_move: float
    step_length: float


class OutOfOrder(NamedTuple):
    """Two triangles over one place in the wrong order.

    Examples
    --------
    >>> stack = ...
    >>> stack.out_of_order
    []
    """

    upper: int
    lower: int
    triangles: Tuple[int, int]
    place: Point
    depth: float


class Layered(OnMesh):
    """Horizons put in order: none is anywhere above one that is higher in the order.

    Attributes
    ----------
    mesh : Mesh
        One surface per horizon, from the top down; triangles where they coincide belong to several.
    reports : list of LayerReport
    step_width : float
        Over strips of this width along steps the order is not claimed; unit of the input.
    is_stack : bool
        Whether exact checks have shown all that. Use the mesh only then.

    Examples
    --------
    >>> stack = ...
    >>> stack
    <Layered: 2 layers, in order, 12 triangles>
    >>> stack.is_stack
    True
    """

    __slots__ = ("mesh", "reports", "step_width", "is_stack", "out_of_order", "rounding", "_report")

    def __init__(self, mesh: Mesh, report: Dict[str, Any]) -> None:
        self._report = report
        self.mesh = mesh
        self.reports: List[LayerReport] = [LayerReport(*r) for r in report["layers"]]
        self.step_width = float(report["step_width"])
        self.is_stack = bool(report["is_stack"])
        self.out_of_order: List[OutOfOrder] = [OutOfOrder(*o) for o in report["out_of_order"]]
        self.rounding: RoundingReport = rounding_report(report["rounding"])

    def surfaces(self) -> List[Surface]:
        """Return the horizons as surfaces of their own.

        Examples
        --------
        >>> stack = ...
        >>> stack.surfaces()
        [<Surface 'top': unknown, 9 vertices, 8 triangles>, <Surface 'flat': unknown, 9 vertices, 8 triangles>]
        """
        return self.mesh.split()

    def save(self, path: Path, format: Optional[str] = None, **options: Any) -> None:
        """Write the mesh as ``terrane layer`` does: only if `is_stack`.

        Examples
        --------
        >>> stack = ...
        >>> stack.save("stack.vtp")
        >>> len(terrane.read("stack.vtp"))
        2
        """
        if not self.is_stack:
            raise Error("improper_contact", "the layers are not in order in doubles; nothing is written")
        self.mesh.save(path, format, **options)

    def _state(self) -> Tuple[Any, ...]:
        return self.mesh, self._report

    def _line(self) -> str:
        verdict = "in order" if self.is_stack else "not in order"
        return f"{counted(len(self.reports), 'layer')}, {verdict}, {counted(len(self.mesh.triangles), 'triangle')}"

    def _numbers(self) -> Dict[str, Any]:
        return {"layers": len(self.reports), "in order": "yes" if self.is_stack else "no",
                **self.mesh._numbers()}



def layers(surfaces: Any, order: Union[Mapping[str, float], Sequence[Tuple[str, float]]], *,
           min_thickness: float = 0, max_move: Optional[float] = None, threads: Optional[int] = None, progress: Any = None) -> Layered:
    """Make soft horizons give way to harder ones, so that layers never cross.

    Parameters
    ----------
    surfaces : as in `arrange`
    order : dict, or list of pairs
        Names of horizons from the top down, and their hardness; others are ignored.
    min_thickness : float, optional
        Along z, unit of the input.
    max_move : float, optional
        As in `round`.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "base")
    >>> tilted = terrane.Surface([[0, 0, -1], [4, 0, 1], [0, 4, 1]], [[0, 1, 2]], "top")
    >>> stack = terrane.layers([tilted, flat], {"top": 1, "base": 2})
    >>> stack.is_stack, [r.dropped > 0 for r in stack.reports]
    (True, [True, False])
    """
    given = as_surfaces(surfaces)
    pairs = list(order.items()) if isinstance(order, Mapping) else as_list(order, "order")
    numbers = []
    for i, pair in enumerate(pairs):
        if not isinstance(pair, tuple) or len(pair) != 2:
            raise TypeError(f"order[{i}] is a pair of a name and a hardness")
        name, hardness = pair
        found = [i for i, s in enumerate(given) if s.name == name]
        if len(found) != 1:
            names = ", ".join(s.name for s in given)
            raise bad_option(f"{len(found)} surfaces are called {name}; there are {names}", "order")
        numbers.append((found[0], as_number(hardness, f"order[{name!r}]")))
    core, report = _core.layers(parts_of_surfaces(given), numbers,
                                as_number(min_thickness, "min_thickness", least=0), as_move(max_move),
                                how(threads, progress))
    return Layered(Mesh(core), report)
