# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which records of realisations have the form of one: all keys and no others, finite numbers, and maps of the right size."""

from __future__ import annotations

import io
import json
import math
import zipfile
from typing import Any, Callable, Tuple

import numpy as np

from ._ensemble_work import Record, Task
from ._errors import ERROR_CODES

Form = Callable[[Any], bool]

#: A record's text has at most this many bytes, so that a small file cannot fill the memory.
_LONGEST = 1 << 28


def _text(value: Any) -> bool:
    return isinstance(value, str)


def _count(value: Any) -> bool:
    return type(value) is int and value >= 0


def _number(value: Any) -> bool:
    return type(value) in (int, float) and math.isfinite(value)


def _size(value: Any) -> bool:
    return _number(value) and value >= 0


def _side(value: Any) -> bool:
    return _text(value) and value[-1:] in ("+", "-")


def _or_none(form: Form) -> Form:
    return lambda value: value is None or form(value)


def _list(form: Form) -> Form:
    return lambda value: isinstance(value, list) and all(map(form, value))


def _row(*forms: Form) -> Form:
    return lambda value: isinstance(value, list) and len(value) == len(forms) and all(f(v) for f, v in zip(forms, value))


def _table(key: Form, form: Form) -> Form:
    return lambda value: isinstance(value, dict) and all(key(k) and form(v) for k, v in value.items())


def _object(**forms: Form) -> Form:
    return lambda value: isinstance(value, dict) and value.keys() == forms.keys() and all(
        f(value[k]) for k, f in forms.items())


def _block(contacts: int) -> Form:
    each = [_number] * contacts
    return _object(name=_text, key=_text, volume=_size, area=_size, sides=_table(_side, _size), middle=_row(*[_number] * 3),
                   low=_number, high=_number, thickness=_or_none(_row(_size, _size, _size)), above=_row(*each),
                   height=_row(*each))


def _done(task: Task, blocks: int) -> Form:
    def index(value: Any) -> bool:
        return type(value) is int and -1 <= value < blocks

    return _object(
        status="done".__eq__, number=_count, surfaces=_list(_text), boundaries=_list(_text), faults=_list(_text),
        areas=_table(_text, _size), blocks=_list(_block(len(task.contacts))),
        interfaces=_list(_row(_text, index, index, _size)),
        quality=_object(triangles=_count, least_angle=_size, mean_angle=_size),
        verdict=_object(leaks=_count, lost=_count, made=_count, max_move=_or_none(_size)))


_FAILED = _object(status="failed".__eq__, number=_count, code=ERROR_CODES.__contains__, reason=_text, blocks=[].__eq__,
                  interfaces=[].__eq__, surfaces=[].__eq__, boundaries=[].__eq__)


def checked(data: bytes, task: Task, number: int) -> Record:
    """Return the record of a file; ValueError if it is not that of this realisation, or not of this form."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as file:
            values = json.loads(_array(file, "values", np.uint8, (-1,), _LONGEST).tobytes())
            failed = values["status"] == "failed"
            surfaces, blocks = len(values["surfaces"]), len(values["blocks"])
            if values["number"] != number or not (_FAILED if failed else _done(task, blocks))(values):
                raise ValueError("its values are not those of this realisation")
            rows, columns = (1, 1) if failed else (task.cells[1], task.cells[0])
            heights = _array(file, "heights", np.float64, (surfaces, rows, columns))
            packed = _array(file, "present", np.uint8, (blocks, rows, (columns + 7) // 8))
        if np.isinf(heights).any():
            raise ValueError("a height is infinite")
        return Record(values, heights, np.unpackbits(packed, axis=-1, count=columns).astype(bool))
    except Exception as error:
        raise ValueError(f"is no realisation: {error}") from None


def _array(file: zipfile.ZipFile, name: str, kind: Any, shape: Tuple[int, ...], most: int = 0) -> Any:
    """Read an array of a known size; its header has fewer than 4096 bytes."""
    wanted = abs(math.prod(shape)) * np.dtype(kind).itemsize
    if file.getinfo(name + ".npy").file_size > max(most, wanted) + 4096:
        raise ValueError(f"{name} is too large")
    with file.open(name + ".npy") as member:
        read: Any = np.lib.format.read_array
        array = read(member, allow_pickle=False)
    if array.dtype != kind or array.ndim != len(shape) or (most == 0 and array.shape != shape):
        raise ValueError(f"{name} has the shape {array.shape}")
    return array
