# SPDX-License-Identifier: LGPL-3.0-or-later
"""The lines that several examples in docstrings begin with."""

from __future__ import annotations

import re
import textwrap
from typing import Any, TypeVar

_Documented = TypeVar("_Documented", bound=Any)

_ENSEMBLE = '''\
>>> import terrane
>>> flat = terrane.Surface([[-1, -1, 0], [9, -1, 0], [-1, 9, 0]], [[0, 1, 2]], "top", "horizon")
>>> flat.save("top.ts")
>>> project = {"format": "terrane-project 1", "surfaces": [{"file": "top.ts"}],
...     "volume_of_interest": {"box": {"low": [0, 0, -1], "high": [2, 2, 1]}}, "outputs": {"blocks": "vtp"},
...     "uncertainty": [{"surface": "top", "shift": 0.1}]}
>>> made = terrane.ensemble(project, realisations=3, engine="serial")'''


def with_ensemble(documented: _Documented) -> _Documented:
    """Replace ">>> made = ..." in a docstring by the lines that make an ensemble, so that the example runs alone."""
    documented.__doc__ = re.sub(r"^( *)>>> made = \.\.\.$", lambda line: textwrap.indent(_ENSEMBLE, line[1]),
                                documented.__doc__ or "", flags=re.MULTILINE)
    return documented
