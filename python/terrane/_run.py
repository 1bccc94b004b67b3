# SPDX-License-Identifier: LGPL-3.0-or-later
"""The keyword arguments of stages: ``threads`` and ``progress``, which all have, and described options."""

from __future__ import annotations

import os
from typing import Any, Callable, Dict, Optional, Sequence, TypeVar

from . import _core
from ._arrays import as_count

Progress = Callable[[str, float], Any]
Function = TypeVar("Function", bound=Callable[..., Any])

_TYPES = {"double": "float", "other value": "float", "uint32_t": "int", "bool": "bool"}
_WORDS = {"false": "False", "true": "True"}


def cores() -> int:
    """Return how many cores this process may use."""
    try:
        return max(1, len(os.sched_getaffinity(0)))
    except AttributeError:  # not on every system
        return os.cpu_count() or 1


class _Bar:
    """Feeds a progress bar such as tqdm's: ``n``, ``total``, ``update`` and ``set_description``."""

    def __init__(self, bar: Any) -> None:
        self._bar = bar
        self._bar.total = self._bar.total or 100

    def __call__(self, stage: str, share: float) -> None:
        describe = getattr(self._bar, "set_description", None)
        if describe is not None:
            describe(stage, refresh=False)
        self._bar.update(self._bar.total * share - self._bar.n)


def how(threads: Optional[int], progress: Any) -> _core.HowToRun:
    """Return what a stage needs to know about how it runs."""
    count = cores() if threads is None else as_count(threads, "threads", 1, 1024)
    if progress is None or callable(progress) and not hasattr(progress, "update"):
        return _core.HowToRun(count, progress)
    if hasattr(progress, "update") and hasattr(progress, "n"):
        return _core.HowToRun(count, _Bar(progress))
    raise TypeError("progress is a function of (stage, share), or a bar with update(), such as tqdm's")


def describing(fields: Sequence[Dict[str, Any]]) -> Callable[[Function], Function]:
    """Return a decorator that lists described options, if a docstring lacks them, where it says OPTIONS."""
    def describe(function: Function) -> Function:
        doc = function.__doc__ or ""
        lines = []
        for field in fields:
            name, default = field["name"], _WORDS.get(field["default"], field["default"])
            if field["type"] in _TYPES and f"\n    {name} :" not in doc:
                lines.append(f"    {name} : {_TYPES[field['type']]}, optional\n"
                             f"        {field['text']}; default: {default}.\n")
        function.__doc__ = doc.replace("    OPTIONS\n", "".join(lines))
        return function
    return describe
