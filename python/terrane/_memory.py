# SPDX-License-Identifier: LGPL-3.0-or-later
"""Settings of the process for freed memory."""

from . import _core


def keep_freed_memory() -> None:
    """Keep freed memory in the process, so that later calls reuse it.

    By default, glibc returns large arrays to the operating system, and the next call requests them again. In many virtual
    machines these page faults take longer than the geometry. Call this function once, before threads are started, in
    scripts that make many calls or work on large models. It changes settings of the whole process: all threads share one
    malloc arena, and the process never shrinks. Therefore the package does not call it by itself. It has no effect
    without glibc.

    Examples
    --------
    >>> import terrane
    >>> terrane.keep_freed_memory()
    """
    _core.keep_freed_memory()
