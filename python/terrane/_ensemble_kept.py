# SPDX-License-Identifier: LGPL-3.0-or-later
"""Realisations on disk, so that an interrupted ensemble goes on where it was.

Each is a file of its own, ``FOLDER/HASH/000017.npz``, written next to its place first and then renamed. The hash is of all
that decides the realisation, so that a file of another project, seed or version is never taken.
"""

from __future__ import annotations

import os
import shutil
from typing import Iterator, Optional, Tuple

from ._arrays import Path
from ._ensemble_form import checked
from ._ensemble_work import Task
from ._errors import Error


class Kept:
    """The realisations of one task in a folder; without a folder nothing is kept."""

    def __init__(self, folder: Optional[Path], task: Task) -> None:
        self._task = task
        self._folder = None if folder is None else os.path.join(os.fspath(folder), task.key[:32])
        self.seconds = 0.0
        if self._folder is not None:
            try:
                os.makedirs(self._folder, exist_ok=True)
            except OSError as error:
                raise Error("cannot_open", f"cannot be made: {error.strerror}", self._folder) from None

    def _path(self, number: int) -> str:
        assert self._folder is not None
        return os.path.join(self._folder, f"{number:06d}.npz")

    def found(self, count: int) -> Iterator[Tuple[int, bytes]]:
        """Return (number, file) of those that are there and have the form of a realisation, up to a number."""
        for number in range(1, count + 1) if self._folder is not None else ():
            try:
                with open(self._path(number), "rb") as file:
                    data = file.read()
                checked(data, self._task, number)
                yield number, data
            except (OSError, ValueError):
                continue  # it is made again

    def add(self, number: int, data: bytes, seconds: float) -> None:
        """Keep a realisation, and add up the processor time of all."""
        self.seconds += seconds
        if self._folder is None:
            return
        path = self._path(number)
        try:
            with open(path + ".part", "wb") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
            os.replace(path + ".part", path)
        except OSError as error:
            raise Error("write_failed", f"cannot be written: {error.strerror}", path) from None


def remove(folder: Path) -> None:
    """Remove all that was kept in a folder."""
    shutil.rmtree(os.fspath(folder), ignore_errors=True)
