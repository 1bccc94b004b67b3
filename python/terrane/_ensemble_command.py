# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the program's command ``terrane ensemble``; the program has checked the options."""

from __future__ import annotations

import argparse
import json
import logging
import os
import re
import signal
import sys
import threading
import time
import warnings
from typing import Any, Callable, Dict, List, NoReturn, Optional, Tuple

from . import _core
from ._ensemble import Ensemble, ensemble, task_of
from ._ensemble_form import checked
from ._ensemble_kept import remove
from ._ensemble_output import discard, discard_all, new_folder, save, write_project
from ._ensemble_work import run_one
from ._ensemble_workers import abandon
from ._errors import Error
from ._results import counted

_NEGATIVE, _BAD_INPUT, _INTERNAL = 1, 2, 3
_STATUS = {"improper_contact": _NEGATIVE, "not_closed": _NEGATIVE, "internal": _INTERNAL,
           "out_of_memory": _INTERNAL}


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="terrane ensemble", allow_abbrev=False)
    parser.add_argument("project")
    parser.add_argument("--version-of-program", default=str(_core.version))
    parser.add_argument("--output", default="")
    parser.add_argument("--realisations", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--contact", type=float, action="append", default=[])
    parser.add_argument("--grid", type=int, default=50)
    parser.add_argument("--only", type=int)
    parser.add_argument("--engine")
    parser.add_argument("--workers", type=int)
    parser.add_argument("--scheduler")
    parser.add_argument("--retries", type=int, default=2)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--quiet", action="store_true")
    parser.add_argument("--colours", action="store_true")
    return parser


# Characters that move the cursor, choose a colour, or turn the text round, as in cli/session/styles.cpp.
_HARMFUL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")


def _visible(text: str) -> str:
    """Return a text with such characters as their codes: names come from files."""
    return _HARMFUL.sub(lambda found: f"\\u{ord(found.group()):04x}", text)


def _print(text: str) -> None:
    print(_visible(text))


class _Progress:
    """A line on the terminal, from the first second on."""

    def __init__(self, quiet: bool) -> None:
        self._shows = sys.stderr.isatty() and not quiet
        self._begin = self._drawn = time.monotonic()
        self._width = 0
        self.first: Optional[float] = None

    def __call__(self, stage: str, share: float) -> None:
        now = time.monotonic()
        if self.first is None:
            self.first, self._begin = share, now
        if not self._shows or now - self._begin < 1 or now - self._drawn < 0.1:
            return
        self._drawn = now
        done = share - self.first
        left = "" if done <= 0 else f", {(1 - share) * (now - self._begin) / done:.0f} s left"
        text = f"{stage}: {share:.0%}{left}"
        self._width = max(self._width, len(text))
        print("\r" + text.ljust(self._width), end="", file=sys.stderr, flush=True)

    def end(self) -> None:
        """Remove the line."""
        if self._width:
            print("\r" + " " * self._width + "\r", end="", file=sys.stderr, flush=True)
        self._width = 0


def _fail(arguments: Any, text: str) -> None:
    start = "\033[1;31mterrane:\033[0m" if arguments.colours else "terrane:"
    print(start, _visible(text), file=sys.stderr)


def _say_warnings() -> None:
    """Print warnings as the program does, without the lines of Python that gave them."""
    def show(message: Any, *_: Any) -> None:
        print("terrane: warning:", _visible(str(message)), file=sys.stderr)

    setattr(warnings, "showwarning", show)


def _folder_of(arguments: Any) -> str:
    if arguments.output:
        return str(arguments.output)
    try:
        with open(arguments.project, encoding="utf-8") as file:
            folder = str(json.load(file).get("folder", ""))
    except (OSError, ValueError, AttributeError):
        folder = "run"  # reading the project says what is wrong
    if not folder:
        raise Error("bad_option", "the key folder is missing, and there is no -o", arguments.project)
    return os.path.join(os.path.dirname(arguments.project), folder)


def _one(arguments: Any, folder: str, interrupts: "_Interrupts") -> int:
    """Make one realisation alone."""
    discard(new_folder(folder))  # before the work it is seen whether there can be one
    task = task_of(arguments.project, None, arguments.seed, arguments.contact, arguments.grid, arguments.threads)
    values: Dict[str, Any] = {}
    lacking = None
    try:
        values = checked(run_one(task, arguments.only)[0], task, arguments.only).values
    except Error as error:
        if error.code == "interrupted":
            raise
        lacking = error  # the folder is written all the same, so that the user can look into it
    write_project(task, arguments.only, folder, interrupts.close)
    if not arguments.quiet:
        _print(f"wrote {folder}: the surfaces of realisation {arguments.only}, and project.json, which builds them")
    if lacking is not None:
        raise lacking
    if values["status"] == "failed":
        _fail(arguments, f"realisation {arguments.only} can't be built: {values['reason']}")
        return _NEGATIVE
    for block in [] if arguments.quiet else values["blocks"]:
        _print(f"  {block['name']}: {_core.figure(block['volume'])}")
    return 0


def _text_of(made: Ensemble) -> str:
    failed = len(made.failures)
    lines = [f"{counted(made.count, 'realisation')}, seed {made.seed}: "
             + ("all built" if not failed else f"{made.count - failed} built, {failed} failed")]
    rows: List[Tuple[str, ...]] = [("block", "P90", "P50", "P10", "split", "gone", "merged")]
    for name, block in made.blocks.items():
        volume = block.measures["volume"]
        rows.append((_visible(name), *(_core.figure(volume[p]) for p in ("p90", "p50", "p10")),
                     *(str(block.states[s]) for s in ("split", "vanished", "merged"))))
    widths = [max(len(r[i]) for r in rows) for i in range(len(rows[0]))]
    for row in rows:
        cells = [cell.rjust(w) if i else cell.ljust(w) for i, (cell, w) in enumerate(zip(row, widths))]
        lines.append("  " + "  ".join(cells).rstrip())
    lines.append("P90 of a volume is exceeded with a probability of 90 %")
    if made.new:
        lines.append(f"blocks that the model has not: {counted(sum(made.new.values()), 'block')} in all")
    return "\n".join(lines)


def _all(arguments: Any, folder: str, interrupts: "_Interrupts") -> int:
    discard(new_folder(folder))  # before the work it is seen whether there can be one
    keep = interrupts.kept = os.path.normpath(folder) + ".realisations"
    progress = _Progress(arguments.quiet)
    begin = time.monotonic()
    try:
        made = ensemble(arguments.project, realisations=arguments.realisations, seed=arguments.seed,
                        contacts=arguments.contact, grid=arguments.grid, engine=arguments.engine,
                        workers=arguments.workers, scheduler=arguments.scheduler, retries=arguments.retries,
                        threads=arguments.threads, keep=keep, progress=progress)
    finally:
        progress.end()
    computed = round(arguments.realisations * (1 - (progress.first or 0)))
    seconds = time.monotonic() - begin
    names = save(made, folder, report=True, before_last_step=interrupts.close)
    remove(keep)
    if not arguments.quiet:
        _print(_text_of(made))
        print(f"computed {computed} of them in {seconds:.1f} s")
        _print(f"wrote {folder}:\n" + "\n".join("  " + n for n in names))
    if "ensemble.h5" not in names:
        warnings.warn("ensemble.h5 is left out: the Python module h5py is missing; install python3-h5py")
    for failure in made.failures:
        _fail(arguments, f"realisation {failure.number} can't be built: {failure.reason}")
    return _NEGATIVE if made.failures else 0


#: How long an engine may take, in seconds, to end its processes after an interrupt. Dask can take several.
_PATIENCE = 0.7


class _Interrupts:
    """SIGINT, SIGTERM and SIGHUP raise KeyboardInterrupt; the program ends soon after the first, at once at a second.

    The command calls `close` before the output gets its name, and before it reports an error. From then on it ignores
    signals.
    """

    def __init__(self, say: Callable[[Optional[str]], None]) -> None:
        self.kept: Optional[str] = None  #: the folder that has the finished realisations
        self._say = say
        self._lock = threading.Lock()
        self._patience: Optional[threading.Timer] = None
        # nohup ignores SIGHUP, and a shell's & SIGINT
        self._signals = [name for name in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
                         if signal.getsignal(name) != signal.SIG_IGN]
        for name in self._signals:
            signal.signal(name, self._hear)

    def _hear(self, number: int, frame: Any) -> NoReturn:
        if self._patience is not None:
            self._ignore()
            self._end_at_once()
        self._patience = threading.Timer(_PATIENCE, self._end_at_once)
        self._patience.daemon = True
        self._patience.start()
        raise KeyboardInterrupt

    def _end_at_once(self) -> NoReturn:
        self._lock.acquire()  # it is never released: the thread that holds it ends the program
        abandon()
        discard_all()
        self._say(self.kept)
        os._exit(_BAD_INPUT)

    def _ignore(self) -> None:
        # Python restores the default handlers when it ends. An ignored signal stays ignored.
        for name in self._signals:
            signal.signal(name, signal.SIG_IGN)

    def close(self) -> None:
        """Ignore signals from now on; raise KeyboardInterrupt if one came before."""
        self._ignore()
        if self._patience is not None:  # Python drops exceptions in some places, such as __del__
            raise KeyboardInterrupt

    def answer(self, at_once: bool) -> None:
        """Say that the program was interrupted; `at_once`, end it without what engines do and say at the end."""
        self._ignore()
        if at_once:
            self._end_at_once()
        self._lock.acquire()
        discard_all()
        self._say(self.kept)


def _run(arguments: Any, interrupts: _Interrupts) -> int:
    """Run the command; say what is wrong, but for an interrupt."""
    try:
        if arguments.version_of_program != str(_core.version):
            raise Error("unsupported", f"the Python package is terrane {_core.version}, the program "
                        f"{arguments.version_of_program}; both must be of one version", os.path.dirname(__file__))
        folder = _folder_of(arguments)
        return (_all if arguments.only is None else _one)(arguments, folder, interrupts)
    except Error as error:
        if error.code == "interrupted":
            raise KeyboardInterrupt from None
        interrupts.close()
        _fail(arguments, str(error))
        return _STATUS.get(error.code, _BAD_INPUT)
    except MemoryError:
        interrupts.close()
        _fail(arguments, "out of memory")
        return _INTERNAL
    except Exception as broken:  # of an engine, or of ours
        interrupts.close()
        _fail(arguments, f"internal error: {type(broken).__name__}: {broken}")
        return _INTERNAL


def main(given: List[str]) -> int:
    """Run the command; return its exit status."""
    arguments = _parser().parse_args(given)
    _core.keep_freed_memory()  # as the program terrane does
    _say_warnings()
    logging.disable(logging.CRITICAL)  # Dask logs tracebacks of errors that are also raised

    def say_interrupted(kept: Optional[str]) -> None:
        _fail(arguments, "interrupted, nothing written" if kept is None else
              f"interrupted, finished realisations are kept in {kept}; the same command goes on from there")
        sys.stderr.flush()

    interrupts = _Interrupts(say_interrupted)
    try:
        return _run(arguments, interrupts)
    except KeyboardInterrupt:
        interrupts.answer(arguments.scheduler is not None)
        return _BAD_INPUT
