# SPDX-License-Identifier: LGPL-3.0-or-later
"""What happens to memory that is freed."""

from . import _core


def keep_freed_memory() -> None:
    """Keep memory that is freed in this process, where the next call can use it at once.

    By default glibc gives large arrays back to the system, and each call asks for them anew: where that is slow, as in
    many virtual machines, it takes more time than the geometry. A script that makes many calls, or works on large models,
    calls this once, before it starts threads. It changes settings of the whole process (one arena, and no memory is given
    back before the end), so that the package never does it by itself. Without glibc it does nothing.

    Examples
    --------
    >>> import terrane
    >>> terrane.keep_freed_memory()
    """
    _core.keep_freed_memory()
