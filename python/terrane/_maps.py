# SPDX-License-Identifier: LGPL-3.0-or-later
"""Maps: numbers of surfaces and blocks at the nodes of a regular grid."""

from __future__ import annotations

from typing import Any, Dict, Optional, Tuple

import numpy as np

from . import _core
from ._arrays import Float64Array, Path, as_format, as_number, as_word, read_only
from ._errors import bad_option
from ._results import Result, counted
from ._run import how
from ._surface import as_surfaces, parts_of_surfaces, warn_of_doubts

Nodes = Tuple[str, float, float, float, float, float, int, int]


class Map(Result):
    """Numbers at the nodes of a regular grid.

    Attributes
    ----------
    values : ndarray, shape (ny, nx), float64
        Per node; NaN: no value.
    sheets : int
        Nodes whose vertical meets the surface more than once; the highest point counts there.

    Examples
    --------
    >>> flat = ...
    >>> terrane.map_surface(flat, "depth", step=1)
    <Map: 5 x 5 nodes, 25 values>
    """

    __slots__ = ("_nodes", "values", "sheets")

    def __init__(self, nodes: Nodes, values: Float64Array, sheets: int = 0) -> None:
        self._nodes = nodes
        self.values: Float64Array = read_only(np.asarray(values).reshape(nodes[7], nodes[6]))
        self.sheets = sheets

    @property
    def name(self) -> str:
        """The name of the surface, or of the blocks."""
        return self._nodes[0]

    @property
    def points(self) -> Float64Array:
        """The positions x, y of the nodes, shape (ny, nx, 2)."""
        _, x, y, dx, dy, rotation, nx, ny = self._nodes
        turn = np.radians(rotation)
        i, j = np.meshgrid(np.arange(nx) * dx, np.arange(ny) * dy)
        made: Float64Array = np.stack((x + i * np.cos(turn) - j * np.sin(turn),
                                       y + i * np.sin(turn) + j * np.cos(turn)), axis=-1)
        return made

    def save(self, path: Path, *, format: Optional[str] = None) -> None:
        """Write a grid: .asc, .zmap, .irap, .grd or .vti; only .irap and .vti can be rotated.

        Parameters
        ----------
        path : str or os.PathLike
            An existing file is replaced, also at a crash only as a whole.
        format : str, optional
            Name of the format instead of the extension.

        Raises
        ------
        terrane.Error
            ``cannot_open``, ``write_failed``, ``unknown_format``, ``unsupported``.

        Examples
        --------
        >>> flat = ...
        >>> terrane.map_surface(flat, "depth", step=1).save("depth.asc")
        """
        values = np.array(self.values, dtype=np.float64).reshape(-1)
        _core.write_grid(self._nodes, values, path, as_format(format), how(None, None))

    def _line(self) -> str:
        ny, nx = self.values.shape
        return f"{nx} x {ny} nodes, {counted(int(np.count_nonzero(~np.isnan(self.values))), 'value')}"

    def _shape(self) -> Tuple[Any, Any]:
        there = ~np.isnan(self.values)
        if not there.any():
            return super()._shape()
        points = self.points
        low, high = self.values[there].min(), self.values[there].max()
        width = np.ptp(points, axis=(0, 1)).max()
        heights = np.where(there, (self.values - low) * (width / 5 / (high - low) if high > low else 0), 0)
        corner = np.arange(there.size, dtype=np.uint32).reshape(there.shape)
        a, b, c, d = corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]
        whole = there[:-1, :-1] & there[:-1, 1:] & there[1:, 1:] & there[1:, :-1]
        triangles = np.concatenate([np.stack((a, b, c), -1)[whole], np.stack((a, c, d), -1)[whole]])
        return np.concatenate([points, heights[..., None]], axis=-1).reshape(-1, 3), triangles

    def _numbers(self) -> Dict[str, Any]:
        there = self.values[~np.isnan(self.values)]
        numbers: Dict[str, Any] = {"nodes": self.values.size, "values": there.size}
        if there.size:
            numbers.update(least=float(there.min()), greatest=float(there.max()), mean=float(there.mean()))
        return numbers


def nodes_of(surfaces: Any, name: str, step: Optional[float], like: Any) -> Nodes:
    """Return the nodes at multiples of a step over surfaces, or those of a map or a grid file."""
    if (step is None) == (like is None):
        raise bad_option("give either step or like, for the nodes of the map", "step")
    if step is not None:
        nodes = _core.nodes_over(surfaces, as_number(step, "step", positive=True))
    else:
        nodes = like._nodes if isinstance(like, Map) else _core.nodes_in(like, how(None, None))
    made: Nodes = (name, *nodes[1:])
    return made


def map_surface(surfaces: Any, number: str, *, to: Any = None, step: Optional[float] = None, like: Any = None,
                threads: Optional[int] = None, progress: Any = None) -> Map:
    """Map surfaces at the nodes of a grid, along the vertical through each node.

    Parameters
    ----------
    surfaces : as in `arrange`
        They count as one. Which triangles a vertical meets is decided exactly.
    number : {"height", "depth", "dip", "azimuth", "thickness", "distance"}
        z; -z; the angle to the horizontal, in degrees; the direction in which the surface dips, in degrees clockwise
        from y; the height above `to` along the vertical, < 0 below it; the distance to the nearest point of `to`.
    to : as in `arrange`, optional
        The other surface of thickness and distance.
    step : float, optional
        Distance of the nodes, which are at its multiples; unit of the input. This or `like` is needed.
    like : Map, str or os.PathLike, optional
        A map, or a file with a grid, that has the nodes.

    Warns
    -----
    terrane.Doubt
        For each likely mistake in the surfaces, such as different units.

    Raises
    ------
    terrane.Error
        ``bad_option`` for more than 10^9 nodes, and for `to` where it is missing or has no use; ``nothing_to_do`` if no
        node is within the map; those of reading a grid.

    Examples
    --------
    >>> flat, wall = ...
    >>> terrane.map_surface(flat, "distance", to=wall, step=4).values
    array([[1., 3.],
           [1., 3.]])
    """
    mapped, others = as_surfaces(surfaces), [] if to is None else as_surfaces(to)
    warn_of_doubts(mapped + others, ["duplicate_surface"])
    given, other = parts_of_surfaces(mapped), parts_of_surfaces(others)
    word = as_word(number, "number")
    nodes = nodes_of(given, mapped[0].name if mapped else "", step, like)
    return Map(nodes, *_core.map(given, word, nodes, other, how(threads, progress)))
