# SPDX-License-Identifier: LGPL-3.0-or-later
"""Describes in report pages the call that made a result."""

from __future__ import annotations

import math
from typing import Any, Dict, List, Sequence, Tuple

from . import _core

#: Whether this build can write report pages: it was made with npm.
HAS_REPORTS: bool = _core.has_reports()

Facts = Tuple[str, str, List[Tuple[str, str]]]


def facts(command: str, names: Sequence[str], options: Dict[str, Any]) -> Facts:
    """Return what a page says of its making: the call, a title of the surfaces' names, and the options.

    Options that are off are left out.
    """
    others = len(names) - 1
    title = "" if not names else names[0] or "surface"
    given = [(name, str(value)) for name, value in options.items() if _is_on(value)]
    return command, title if others < 1 else f"{title} and {others} more", given


def _is_on(value: Any) -> bool:
    return not (value is None or value is False or value == "" or value == math.inf
                or isinstance(value, (list, tuple, dict)) and not value
                or isinstance(value, (int, float)) and value == 0)
