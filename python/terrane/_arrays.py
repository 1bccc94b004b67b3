# SPDX-License-Identifier: LGPL-3.0-or-later
"""Arrays that people pass, checked and in the library's types; and lists of lists."""

from __future__ import annotations

import operator
import os
from typing import Any, Iterable, Iterator, List, Mapping, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import Error, bad_option

Float64Array = npt.NDArray[np.float64]
UInt32Array = npt.NDArray[np.uint32]
Int32Array = npt.NDArray[np.int32]
Point = Tuple[float, float, float]
Path = Union[str, "os.PathLike[str]"]

_LARGEST = 2**32 - 1


def read_only(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return a view that cannot be written to."""
    view = array.view()
    view.flags.writeable = False
    return view


def _is_masked(value: Any) -> bool:
    """Return whether elements are masked, of an array or of one of a list of arrays."""
    if isinstance(value, (list, tuple)):
        return any(isinstance(row, np.ma.MaskedArray) and _is_masked(row) for row in value)
    return isinstance(value, np.ma.MaskedArray) and bool(np.any(np.ma.getmaskarray(value)))  # type: ignore[no-untyped-call]


def _as_array(value: Any, place: str, ragged: str) -> npt.NDArray[Any]:
    """Return a plain array."""
    if _is_masked(value):
        raise bad_option("has masked elements, which are no numbers", place)
    try:
        return np.asarray(value)
    except ValueError:
        raise bad_option(ragged, place) from None


def _as_doubles(value: Any, array: npt.NDArray[Any], place: str) -> Float64Array:
    """Return float64 in C order of the array of a value, and refuse numbers that lose bits by it."""
    if array.dtype.kind not in "fiub":
        raise bad_option(f"must be numbers, not {array.dtype}", place)
    doubles = np.ascontiguousarray(array, dtype=np.float64)
    if array.dtype.itemsize > 8 and np.any(array != doubles):
        raise bad_option(f"{array.dtype} holds numbers that float64 does not", place)
    large = np.abs(doubles) >= 2**53  # smaller whole numbers fit
    if np.any(large) and (array.dtype.kind in "iu" or not isinstance(value, np.ndarray)):
        given = array if array.dtype.kind in "iu" else np.asarray(value, dtype=object)
        for number, double in zip(given[large].tolist(), doubles[large].tolist()):
            if isinstance(number, (int, np.integer)) and int(number) != double:
                raise bad_option(f"{number} is a whole number that float64 does not hold", place)
    return doubles


def as_points(value: Any, place: str, columns: int = 3) -> Float64Array:
    """Return an (n, columns) array of float64, in C order: the same memory if it is one already."""
    array = _as_array(value, place, f"rows must have {columns} numbers each")
    if array.size == 0 and array.ndim < 2:
        array = np.zeros((0, columns))
    if array.dtype.kind in "fiub" and (array.ndim != 2 or array.shape[1] != columns):
        raise bad_option(f"must have the shape (n, {columns}), not {array.shape}", place)
    return _as_doubles(value, array, place)


def as_triangles(value: Any, place: str) -> npt.NDArray[Any]:
    """Return an (m, 3) array of integers with 4 or 8 bytes: the same memory if it is one already."""
    array = _as_array(value, place, "rows must have 3 indices each")
    if array.size == 0:
        array = np.zeros((0, 3) if array.ndim < 2 else array.shape, dtype=np.uint32)
    if array.dtype.kind not in "iu":
        raise bad_option(f"must be integers, not {array.dtype}", place)
    if array.ndim != 2 or array.shape[1] != 3:
        raise bad_option(f"must have the shape (m, 3), not {array.shape}", place)
    if array.dtype.isnative and array.dtype.itemsize >= 4:
        return array
    return array.astype(np.int64 if array.dtype.kind == "i" else np.uint64)


def as_text(value: Any, place: str) -> str:
    """Return a str."""
    if not isinstance(value, str):
        raise TypeError(f"{place} is a str, not {type(value).__name__}")
    return value


def as_word(value: Any, place: str) -> str:
    """Return a str that is no name of a user's, and therefore holds no surrogates."""
    try:
        as_text(value, place).encode()
    except UnicodeEncodeError:
        raise ValueError(f"{place} holds surrogates, which are no text") from None
    return str(value)


def as_format(value: Any) -> Optional[str]:
    """Return the name of a format; None: the extension tells."""
    return None if value is None else as_word(value, "format")


def as_pair(name: Any, place: str) -> str:
    """Return "F1" or "F1/F2" of a surface or a pair of surfaces by name."""
    return "/".join(as_text(n, place) for n in (name if isinstance(name, tuple) else (name,)))


def as_flag(value: Any, place: str) -> bool:
    """Return a bool, NumPy's among them."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{place} is True or False, not {type(value).__name__}")
    return bool(value)


def as_list(value: Any, place: str) -> List[Any]:
    """Return the elements of a sequence that is no text."""
    if isinstance(value, (str, bytes, memoryview, Mapping)) or not isinstance(value, Iterable):
        raise TypeError(f"{place} is a list, not {type(value).__name__}")
    return list(value)


def as_mapping(value: Any, place: str) -> Mapping[Any, Any]:
    """Return a mapping; None is an empty one."""
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        raise TypeError(f"{place} is a dict, not {type(value).__name__}")
    return value


def as_number(value: Any, place: str, *, positive: bool = False, least: Optional[float] = None) -> float:
    """Return a float of any real number, NumPy's among them."""
    if isinstance(value, (str, bytes, bool, np.bool_)):
        raise TypeError(f"{place} is a number, not {type(value).__name__}")
    try:
        number = float(value)
    except OverflowError:
        raise bad_option("is larger than float64 can be", place) from None
    except (TypeError, ValueError):
        raise TypeError(f"{place} is a number, not {type(value).__name__}") from None
    if isinstance(value, (int, np.integer)) and int(value) != number:
        raise bad_option(f"{value} is a whole number that float64 does not hold", place)
    if not np.isfinite(number):
        raise bad_option(f"{number} is not finite", place)
    if positive and not number > 0:
        raise bad_option(f"{_core.figure(number)} is not positive", place)
    if least is not None and number < least:
        raise bad_option(f"{_core.figure(number)} is less than {_core.figure(least)}", place)
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
    array = _as_array(value, place, "must be three numbers")
    if array.shape != (3,):
        raise bad_option(f"must be three numbers, not {array.shape}", place)
    x, y, z = _as_doubles(value, array, place).tolist()
    if not np.all(np.isfinite((x, y, z))):
        raise bad_option("is not finite", place)
    return x, y, z


def as_indices(value: Any, place: str) -> UInt32Array:
    """Return a copy as a list of indices."""
    array = np.array(_as_array(value, place, "must be a list of indices"))
    if array.size == 0:
        array = np.zeros(0, dtype=np.uint32)
    if array.dtype.kind not in "iu" or array.ndim != 1:
        raise bad_option(f"must be a list of integers, not {array.dtype} of the shape {array.shape}", place)
    if array.size > 0 and not 0 <= int(array.min()) <= int(array.max()) <= _LARGEST:
        raise Error("bad_index", f"are not from 0 to {_LARGEST}", place)
    return read_only(array.astype(np.uint32))


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
        self.offsets = as_indices(offsets, "offsets")
        self.values = as_indices(values, "values")
        o = self.offsets.astype(np.int64)
        if len(o) == 0 or o[0] != 0 or o[-1] != len(self.values) or np.any(np.diff(o) < 0):
            raise Error("bad_index", f"do not ascend from 0 to {len(self.values)}", "offsets")

    @classmethod
    def _of(cls, lists: Tuple[Any, ...]) -> "IndexLists":
        """Return lists of the library, whose arrays nobody can change."""
        made = cls.__new__(cls)
        made.offsets, made.values = lists
        return made

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, i: int) -> UInt32Array:
        n = len(self)
        i = operator.index(i)
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
        >>> exact = ...
        >>> int(exact.surfaces_of.contain(1).sum())
        7
        """
        wanted = as_count(index, "index")
        hits = np.concatenate([[0], np.cumsum(self.values == wanted)])
        counts = hits[self.offsets[1:]] - hits[self.offsets[:-1]]
        return np.asarray(counts > 0)


class SurfaceInfo(NamedTuple):
    """The name and the role of a surface of a mesh.

    Examples
    --------
    >>> flat, wall = ...
    >>> terrane.mesh([flat, wall]).surfaces
    [SurfaceInfo(name='flat', role='horizon'), SurfaceInfo(name='wall', role='fault')]
    """

    name: str
    role: str

    @classmethod
    def all_of(cls, pairs: Iterable[Tuple[str, str]]) -> "List[SurfaceInfo]":
        """Return what the library says of surfaces."""
        return [cls(*pair) for pair in pairs]
