# SPDX-License-Identifier: LGPL-3.0-or-later
"""Arrays that people pass, checked and in the library's types; and lists of lists."""

from __future__ import annotations

from typing import Any, Iterator, NamedTuple, Optional, Tuple

import numpy as np
import numpy.typing as npt

from ._errors import Error, bad_option

Float64Array = npt.NDArray[np.float64]
UInt32Array = npt.NDArray[np.uint32]
Int32Array = npt.NDArray[np.int32]
Point = Tuple[float, float, float]

_LARGEST = 2**32 - 1


def read_only(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return a view that cannot be written to."""
    view = array.view()
    view.flags.writeable = False
    return view


def as_points(value: Any, place: str, columns: int = 3) -> Float64Array:
    """Return an (n, columns) array of float64, in C order: the same memory if it is one already."""
    try:
        array = np.asarray(value)
    except ValueError:
        raise bad_option(f"rows must have {columns} numbers each", place) from None
    if array.size == 0 and array.ndim < 2:
        array = np.zeros((0, columns))
    if array.dtype.kind not in "fiub":
        raise bad_option(f"must be numbers, not {array.dtype}", place)
    if array.ndim != 2 or array.shape[1] != columns:
        raise bad_option(f"must have the shape (n, {columns}), not {array.shape}", place)
    if array.dtype.kind == "f" and array.dtype.itemsize > 8:
        if np.any(array != array.astype(np.float64)):
            raise bad_option(f"{array.dtype} holds numbers that float64 does not", place)
    return read_only(np.ascontiguousarray(array, dtype=np.float64))


def as_triangles(value: Any, vertices: int, place: str) -> UInt32Array:
    """Return an (m, 3) array of uint32, in C order: the same memory for uint32 and int32."""
    try:
        array = np.asarray(value)
    except ValueError:
        raise bad_option("rows must have 3 indices each", place) from None
    if array.size == 0 and array.ndim < 2:
        array = np.zeros((0, 3), dtype=np.uint32)
    if array.dtype.kind not in "iu" and array.size > 0:
        raise bad_option(f"must be integers, not {array.dtype}", place)
    if array.ndim != 2 or array.shape[1] != 3:
        raise bad_option(f"must have the shape (m, 3), not {array.shape}", place)
    if array.size > 0:
        low, high = int(array.min()), int(array.max())
        if low < 0 or high >= vertices:
            row = int(np.argmax(np.any((array < 0) | (array >= vertices), axis=1)))
            raise Error("bad_index", f"names a vertex that does not exist: {array[row].tolist()}, "
                        f"of {vertices} vertices", f"{place}[{row}]")
    array = np.ascontiguousarray(array)
    if array.dtype == np.int32:
        return read_only(array.view(np.uint32))
    return read_only(array.astype(np.uint32, copy=False))


def as_number(value: Any, place: str, *, positive: bool = False, least: Optional[float] = None) -> float:
    """Return a float of any real number, NumPy's among them."""
    if isinstance(value, (str, bytes, bool, np.bool_)):
        raise TypeError(f"{place} is a number, not {type(value).__name__}")
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{place} is a number, not {type(value).__name__}") from None
    if not np.isfinite(number):
        raise bad_option(f"{number} is not finite", place)
    if positive and not number > 0:
        raise bad_option(f"{number:g} is not positive", place)
    if least is not None and number < least:
        raise bad_option(f"{number:g} is less than {least:g}", place)
    return number


def as_count(value: Any, place: str, least: int = 0, most: int = _LARGEST) -> int:
    """Return an int of any whole number, NumPy's among them."""
    if isinstance(value, (bool, np.bool_)) or not hasattr(value, "__index__"):
        raise TypeError(f"{place} is a whole number, not {type(value).__name__}")
    number = int(value.__index__())
    if not least <= number <= most:
        raise bad_option(f"{number} is not from {least} to {most}", place)
    return number


def as_point(value: Any, place: str) -> Point:
    """Return (x, y, z) of three finite numbers."""
    array = np.asarray(value, dtype=np.float64)
    if array.shape != (3,):
        raise bad_option(f"must be three numbers, not {array.shape}", place)
    if not np.all(np.isfinite(array)):
        raise bad_option("is not finite", place)
    return float(array[0]), float(array[1]), float(array[2])


class IndexLists:
    """Many short lists of indices in two flat arrays.

    List ``i`` is ``values[offsets[i]:offsets[i + 1]]``; ``lists[i]`` returns it.

    Attributes
    ----------
    offsets : ndarray, shape (n + 1,), uint32
        Ascending from 0.
    values : ndarray, uint32
        All lists, one after the other.

    Examples
    --------
    >>> import numpy as np, terrane
    >>> lists = terrane.IndexLists(np.array([0, 2, 3]), np.array([5, 7, 6]))
    >>> len(lists), lists[0].tolist(), lists[1].tolist()
    (2, [5, 7], [6])
    """

    __slots__ = ("offsets", "values")

    def __init__(self, offsets: Any, values: Any) -> None:
        self.offsets: UInt32Array = read_only(np.ascontiguousarray(offsets, dtype=np.uint32))
        self.values: UInt32Array = read_only(np.ascontiguousarray(values, dtype=np.uint32))

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, i: int) -> UInt32Array:
        n = len(self)
        i = i.__index__()
        if not -n <= i < n:
            raise IndexError(f"list {i} of {n}")
        i %= n
        return self.values[self.offsets[i]:self.offsets[i + 1]]

    def __iter__(self) -> Iterator[UInt32Array]:
        return (self[i] for i in range(len(self)))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, IndexLists):
            return NotImplemented
        return bool(np.array_equal(self.offsets, other.offsets)
                    and np.array_equal(self.values, other.values))

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"<IndexLists: {len(self)} lists, {len(self.values)} indices>"

    def __reduce__(self) -> Tuple[Any, ...]:
        return IndexLists, (np.array(self.offsets), np.array(self.values))

    @property
    def first(self) -> UInt32Array:
        """The first index of each list; 2**32 - 1 where a list is empty."""
        lengths = np.diff(self.offsets.astype(np.int64))
        out = np.full(len(self), _LARGEST, dtype=np.uint32)
        full = lengths > 0
        out[full] = self.values[self.offsets[:-1][full]]
        return out

    def contain(self, index: int) -> npt.NDArray[np.bool_]:
        """Return, per list, whether it has this index.

        Examples
        --------
        >>> import terrane
        >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], [[0, 1, 2],
        ...     [0, 2, 3]], "flat", "horizon")
        >>> wall = terrane.Surface([[1, -1, -1], [1, 5, -1], [1, 2, 3]], [[0, 1, 2]], "wall", "fault")
        >>> exact = terrane.arrange([flat, wall])
        >>> int(exact.surfaces_of.contain(1).sum())
        7
        """
        hits = np.concatenate([[0], np.cumsum(self.values == index)])
        counts = hits[self.offsets[1:]] - hits[self.offsets[:-1]]
        return np.asarray(counts > 0)


class SurfaceInfo(NamedTuple):
    """The name and the role of a surface of a mesh.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], [[0, 1, 2],
    ...     [0, 2, 3]], "flat", "horizon")
    >>> wall = terrane.Surface([[1, -1, -1], [1, 5, -1], [1, 2, 3]], [[0, 1, 2]], "wall", "fault")
    >>> terrane.mesh([flat, wall]).surfaces
    [SurfaceInfo(name='flat', role='horizon'), SurfaceInfo(name='wall', role='fault')]
    """

    name: str
    role: str
