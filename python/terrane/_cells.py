# SPDX-License-Identifier: LGPL-3.0-or-later
"""Grids of cells, and the blocks in them."""

from __future__ import annotations

from typing import Any, Dict, List, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import Float64Array, Path, UInt32Array, as_count, as_list, as_number
from ._errors import bad_option
from ._results import Result
from ._run import how


class BlocksInCells(Result):
    """A rectilinear grid of cells, and the blocks in them.

    Attributes
    ----------
    x, y, z : ndarray
        The planes between cells, ascending.
    block_of : ndarray, shape (nz, ny, nx), uint32
        The number of the block that contains the centre of each cell; 0: the outside.
    cells : ndarray, shape (n,), int64
        Cells, ascending, each as often as it has blocks: indices into ``block_of.ravel()``.
    blocks : ndarray, shape (n,), uint32
        Which block has volume in that cell; 0: the outside.
    fractions : ndarray, shape (n,), float64
        The part of the cell that this block fills: the double nearest to the exact one.

    Examples
    --------
    >>> m = ...
    >>> m.grid(step=1)
    <BlocksInCells: 4 x 4 x 3 cells, 48 in blocks>
    """

    __slots__ = ("_values", "x", "y", "z", "block_of", "cells", "blocks", "fractions")

    def __init__(self, values: Dict[str, Any]) -> None:
        self._values = values
        self.x: Float64Array = values["x"]
        self.y: Float64Array = values["y"]
        self.z: Float64Array = values["z"]
        self.block_of: UInt32Array = values["centres"].reshape(len(self.z) - 1, len(self.y) - 1, len(self.x) - 1)
        self.cells: npt.NDArray[np.int64] = values["cells"]
        self.blocks: UInt32Array = values["blocks"]
        self.fractions: Float64Array = values["fractions"]

    def fraction(self, block: int) -> Float64Array:
        """Return the part of each cell that a block fills, shape (nz, ny, nx).

        Examples
        --------
        >>> m = ...
        >>> m.grid(cells=(1, 1, 2)).fraction(1).ravel()
        array([0.66666667, 0.        ])
        """
        made = np.zeros(self.block_of.size)
        chosen = self.blocks == as_count(block, "block")
        made[self.cells[chosen]] = self.fractions[chosen]
        return made.reshape(self.block_of.shape)

    def save(self, path: Path) -> None:
        """Write a grid: .vti (equally large cells), .vtr, .grdecl or .csv.

        Raises
        ------
        terrane.Error
            ``cannot_open``, ``write_failed``, ``unknown_format``, ``unsupported``.

        Examples
        --------
        >>> m = ...
        >>> m.grid(step=1).save("grid.vti")
        """
        _core.save_cells(self._values, path, how(None, None))

    def _state(self) -> Tuple[Any, ...]:
        return (self._values,)

    def _line(self) -> str:
        nz, ny, nx = self.block_of.shape
        return f"{nx} x {ny} x {nz} cells, {int(np.count_nonzero(self.block_of))} in blocks"

    def _numbers(self) -> Dict[str, Any]:
        return {"cells": self.block_of.size, "in blocks": int(np.count_nonzero(self.block_of)),
                "shares": len(self.cells)}

    def _shape(self) -> Tuple[Any, Any]:
        ends = np.array([[self.x[i], self.y[j], self.z[k]] for k in (0, -1) for j in (0, -1) for i in (0, -1)])
        sides = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
        return ends, np.array([t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))], dtype=np.uint32)


def cells_wanted(step: Any, cells: Any, planes: Tuple[Any, Any, Any]) -> Dict[str, Any]:
    """Return what the core takes: steps, counts and planes."""
    wanted: Dict[str, Any] = {"steps": [], "counts": [], "planes": [[], [], []]}
    has_all = all(p is not None for p in planes)
    if (step is not None) + (cells is not None) + has_all != 1:
        raise bad_option("give either step or cells, or x, y and z", "step")
    if step is not None:
        steps = as_list(step, "step") if np.ndim(step) else [step] * 3
        if len(steps) != 3:
            raise bad_option("needs one number, or three", "step")
        wanted["steps"] = [as_number(s, "step", positive=True) for s in steps]
    if cells is not None:
        counts = as_list(cells, "cells")
        if len(counts) != 3:
            raise bad_option("needs three numbers", "cells")
        wanted["counts"] = [as_count(n, "cells", 1) for n in counts]
    for number, (name, given) in enumerate(zip("xyz", planes)):
        if given is not None:
            wanted["planes"][number] = _planes(given, name)
    return wanted


def _planes(given: Any, name: str) -> List[float]:
    made = [as_number(p, name) for p in as_list(given, name)]
    if len(made) < 2:
        raise bad_option("needs at least two planes", name)
    return made


def grid_of(model: Any, wanted: Dict[str, Any], threads: Optional[int], progress: Any) -> BlocksInCells:
    """Return the grid of a model's handle."""
    return BlocksInCells(_core.cells(model, wanted, how(threads, progress)))
