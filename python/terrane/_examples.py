# SPDX-License-Identifier: LGPL-3.0-or-later
"""The lines that several examples in docstrings begin with.

A docstring says ``>>> m = ...``. `complete` replaces that by the lines that make ``m``, so that each example runs alone,
as one pastes it from ``help()``.
"""

from __future__ import annotations

import inspect
import re
from typing import Any, Dict, Iterable, Match, Tuple

#: The lines that make a value, by its name, and the values that they need.
_LINES: Dict[str, Tuple[Tuple[str, ...], str]] = {
    "flat": ((), '''\
>>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], [[0, 1, 2],
...     [0, 2, 3]], "flat", "horizon")'''),
    "wall": ((), '>>> wall = terrane.Surface([[1, -1, -1], [1, 5, -1], [1, 2, 3]], [[0, 1, 2]], "wall", "fault")'),
    "exact": (("flat", "wall"), ">>> exact = terrane.arrange([flat, wall])"),
    "rounded": (("flat", "wall"), ">>> rounded = terrane.round(terrane.arrange([flat, wall]))"),
    "m": (("flat",), ">>> m = terrane.model([flat], box=((0, 0, -1), (4, 4, 2)))"),
    "cells": (("m",), ">>> cells = m.tetrahedra(edge_length=2)"),
    "better": (("m",), ">>> better = terrane.improve(m.mesh, 1.0)"),
    "short": ((), '''\
>>> short = terrane.Surface([[1.1, 1, 1], [3, 1, 1], [3, 3, 1], [1.1, 3, 1]], [[0, 1, 2],
...     [0, 2, 3]], "short", "horizon")'''),
    "sealed": (("wall", "short"), ">>> sealed = terrane.seal([wall, short], 0.2)"),
    "a": ((), '''\
>>> corners = [(x, y, z) for x in (0, 2) for y in (0, 2) for z in (0, 2)]
>>> sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
>>> triangles = [t for p, q, r, s in sides for t in ((p, q, r), (p, r, s))]
>>> a = terrane.Surface(corners, triangles, "a")'''),
    "b": ((), '''>>> b = terrane.Surface([(x + 1, y + 1, z + 1) for x, y, z in corners], triangles, "b")'''),
    "stack": ((), '''\
>>> top = terrane.Surface([[0, 0, 1], [4, 0, 1], [4, 4, -1], [0, 4, -1]], [[0, 1, 2], [0, 2, 3]], "top")
>>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]], "flat")
>>> stack = terrane.layers([top, flat], {"top": 1, "flat": 2})'''),
    "holed": ((), '''\
>>> from itertools import product
>>> v = [(x, y, x * y % 3 / 4) for x, y in product(range(5), repeat=2)]
>>> q = [5 * x + y for x, y in product(range(4), repeat=2) if (x, y) != (2, 2)]
>>> holed = terrane.Surface(v, [t for a in q for t in ((a, a + 5, a + 6), (a, a + 6, a + 1))], "holed")'''),
    "built": ((), '''\
>>> terrane.save(terrane.box((0, 0, 0), (1, 1, 1)), "box.ts")
>>> built = terrane.build({"format": "terrane-project 1", "surfaces": [{"file": "box.ts"}],
...     "outputs": {"surfaces": ["obj"]}})'''),
    "made": ((), '''\
>>> flat = terrane.Surface([[-1, -1, 0], [9, -1, 0], [-1, 9, 0]], [[0, 1, 2]], "top", "horizon")
>>> flat.save("top.ts")
>>> project = {"format": "terrane-project 1", "surfaces": [{"file": "top.ts"}],
...     "volume_of_interest": {"box": {"low": [0, 0, -1], "high": [2, 2, 1]}}, "outputs": {"blocks": "vtp"},
...     "uncertainty": [{"surface": "top", "shift": 0.1}]}
>>> made = terrane.ensemble(project, realisations=3, engine="serial")'''),
}


def _lines_of(name: str) -> str:
    needed, lines = _LINES[name]
    return "\n".join([*map(_lines_of, needed), lines])


def _begin(found: Match[str]) -> str:
    """Return the lines that a line such as ``>>> flat, wall = ...`` stands for."""
    lines = "\n".join([">>> import terrane", *map(_lines_of, found[2].split(", "))])
    return found[1] + lines.replace("\n", "\n" + found[1])


def complete(values: Iterable[Any]) -> None:
    """Complete the docstrings of functions and classes, and of the members of these."""
    for value in values:
        classes = [c for c in value.__mro__ if c.__module__.startswith("terrane.")] if inspect.isclass(value) else []
        for documented in (value, *(member for c in classes for member in vars(c).values())):
            text = getattr(documented, "__doc__", None)
            if isinstance(text, str) and " = ...\n" in text:
                documented.__doc__ = re.sub(r"^( *)>>> ([\w, ]+) = \.\.\.$", _begin, text, flags=re.MULTILINE)
