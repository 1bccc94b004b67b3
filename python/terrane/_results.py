# SPDX-License-Identifier: LGPL-3.0-or-later
"""The base of all results: representation, equality, pickling."""

from __future__ import annotations

from typing import Any, Callable, Dict, Generic, Optional, Tuple, Type, TypeVar, overload

import numpy as np

from ._picture import card

_PLURALS = {"vertex": "vertices", "leaks": "leaks", "tetrahedron": "tetrahedra"}


def counted(count: int, noun: str) -> str:
    """Return "1 triangle" or "2 triangles"."""
    return f"{count} {noun if count == 1 else _PLURALS.get(noun, noun + 's')}"


def same(a: Any, b: Any) -> bool:
    """Return whether two states are equal: arrays by their elements, NaN like NaN."""
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return a.dtype == b.dtype and np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(same(a[k], b[k]) for k in a)
    if isinstance(a, (tuple, list)) and isinstance(b, (tuple, list)):
        return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b))
    if isinstance(a, float) and isinstance(b, float):
        return a == b or (a != a and b != b)
    return bool(a == b)


Record = TypeVar("Record", bound=Type[Tuple[Any, ...]])


def by_value(record: Record) -> Record:
    """Make named tuples with arrays, or numbers that may be NaN, equal if their elements are; they have no hash then."""
    def equal(self: Any, other: object) -> bool:
        if not isinstance(other, tuple):
            return NotImplemented
        return same(tuple(self), tuple(other))
    record.__eq__ = equal  # type: ignore[assignment]
    record.__ne__ = object.__ne__  # type: ignore[assignment]
    record.__hash__ = None  # type: ignore[assignment]
    return record


def writable(state: Any) -> Any:
    """Return a state whose arrays own their memory, for pickling."""
    if isinstance(state, np.ndarray):
        return np.array(state)
    if isinstance(state, dict):
        return {k: writable(v) for k, v in state.items()}
    if type(state) in (tuple, list):
        return type(state)(writable(v) for v in state)
    if isinstance(state, tuple) and hasattr(state, "_fields"):
        return type(state)(*map(writable, state))
    return state


T = TypeVar("T")


class Part(Generic[T]):
    """A read-only attribute: what the handle of a result has under this name, or what `make` makes of that."""

    def __init__(self, doc: str, make: Optional[Callable[[Any], T]] = None) -> None:
        self.__doc__ = doc
        self._make = make

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def _source(self, result: Any) -> Any:
        return result._core

    @overload
    def __get__(self, result: None, owner: Any) -> "Part[T]": ...

    @overload
    def __get__(self, result: object, owner: Any) -> T: ...

    def __get__(self, result: Any, owner: Any) -> Any:
        if result is None:
            return self
        value = getattr(self._source(result), self._name)
        return value if self._make is None else self._make(value)

    def __set__(self, result: Any, value: Any) -> None:
        raise AttributeError(f"{self._name} cannot be changed")


class Result:
    """Base of all results: they are values that nobody changes."""

    __slots__: Tuple[str, ...]

    def _state(self) -> Tuple[Any, ...]:
        """Return all that decides the value, which `_from_state` takes: the arguments of the class, unless it differs."""
        return tuple(getattr(self, name) for name in self.__slots__)

    @classmethod
    def _from_state(cls, *state: Any) -> "Result":
        return cls(*state)

    def _line(self) -> str:
        """Return what `repr` says behind the name of the class."""
        raise NotImplementedError

    def _numbers(self) -> Dict[str, Any]:
        """Return what `_repr_html_` lists."""
        return {}

    def _shape(self) -> Tuple[Any, Any]:
        """Return vertices and triangles of the small picture."""
        return np.zeros((0, 3)), np.zeros((0, 3), dtype=np.uint32)

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self._line()}>"

    def _repr_html_(self) -> str:
        vertices, triangles = self._shape()
        return card(type(self).__name__, self._numbers(), vertices, triangles)

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        assert isinstance(other, Result)
        return same(self._state(), other._state())

    __hash__ = None  # type: ignore[assignment]

    def __copy__(self) -> "Result":
        return self

    def __deepcopy__(self, memo: Dict[int, Any]) -> "Result":
        return self  # nobody can change it

    def __reduce__(self) -> Tuple[Any, ...]:
        return _restored, (type(self), writable(self._state()))


def _restored(kind: Any, state: Tuple[Any, ...]) -> Any:
    return kind._from_state(*state)
