# SPDX-License-Identifier: LGPL-3.0-or-later
"""The engine "processes": interpreters of this machine that compute the realisations of an ensemble.

Each is a child of this process and connected with it by two unnamed pipes, which nobody else can open. It does not import
the program's main module, so that scripts need no guard for it.
"""

from __future__ import annotations

import collections
import contextlib
import multiprocessing.connection
import os
import signal
import subprocess
import sys
from typing import Any, Deque, Dict, Iterator, List, Optional, Sequence, Set

from . import _core
from ._ensemble_work import Outcome, Task, outcome_of
from ._errors import Error

#: The program of an interpreter: the path first, so that no module comes from the current folder.
_START = "import sys; sys.path[:] = {!r}; from terrane._ensemble_workers import serve; serve()"

#: The interpreters that run.
_running: Set["subprocess.Popen[bytes]"] = set()


def abandon() -> None:
    """Kill the workers that this process has started: it is about to end."""
    for process in list(_running):
        process.kill()


@contextlib.contextmanager
def _interrupts_blocked() -> Iterator[None]:
    """Block SIGINT: threads and processes that begin here never see it, and this thread sees it afterwards.

    An interrupt at the terminal goes to all processes; the one that was started ends the others.
    """
    try:
        old = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    except (AttributeError, ValueError):  # not on every system
        yield
        return
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, old)


class _Gone(Exception):
    """The worker has ended."""


class _Worker:
    """An interpreter that computes one realisation after the other."""

    def __init__(self, task: Task, retries: int) -> None:
        self.numbers: Deque[int] = collections.deque()  #: what it was asked for and has not answered, in order
        self.has_started = False
        questions, self._questions = multiprocessing.Pipe(duplex=False)
        self.answers, answers = multiprocessing.Pipe(duplex=False)
        with questions, answers, _interrupts_blocked():
            try:
                self._process = subprocess.Popen([sys.executable, "-c", _START.format(sys.path)],
                                                 stdin=questions.fileno(), stdout=answers.fileno())
            except OSError as error:
                raise Error("unsupported", f"the interpreter {sys.executable!r} cannot be run: {error.strerror}; choose the "
                            "engine serial", "engine") from None
            _running.add(self._process)
        self._send((task, retries))

    def _send(self, value: Any) -> None:
        with contextlib.suppress(BrokenPipeError):  # answer() says that it is gone
            self._questions.send(value)

    def ask(self, number: int) -> None:
        """Have a realisation computed."""
        self.numbers.append(number)
        self._send(number)

    def answer(self) -> Optional[Outcome]:
        """Return the next outcome; None once, when the interpreter has started."""
        try:
            outcome: Optional[Outcome] = self.answers.recv()
        except (EOFError, OSError):  # it was killed, perhaps while it wrote
            raise _Gone from None
        if outcome is not None:
            self.numbers.popleft()
        self.has_started = True
        return outcome

    def end(self) -> int:
        """End the interpreter; return its status, which is negative after a signal."""
        self._process.kill()
        status = self._process.wait()
        _running.discard(self._process)
        self._questions.close()
        self.answers.close()
        return status


class Workers:
    """Computes realisations by this number of workers; a worker that is lost is replaced, and loses nothing that others do."""

    def __init__(self, task: Task, count: int, retries: int) -> None:
        self._task, self._count, self._retries = task, count, retries
        self._waiting: Deque[int] = collections.deque()
        self._workers: List[_Worker] = []
        self._lost: Dict[Optional[int], int] = collections.Counter()  #: workers by the number that each computed then

    def outcomes(self, numbers: Sequence[int]) -> Iterator[Outcome]:
        """Compute realisations, and yield each as soon as it is there."""
        self._waiting.extend(numbers)
        try:
            while self._waiting or any(w.numbers for w in self._workers):
                self._occupy()
                there = multiprocessing.connection.wait([w.answers for w in self._workers])
                for worker in [w for w in self._workers if w.answers in there]:
                    try:
                        outcome = worker.answer()
                    except _Gone:
                        outcome = self._replace(worker)
                    if outcome is not None:
                        yield outcome
        finally:
            for worker in self._workers:
                worker.end()

    def _occupy(self) -> None:
        """Give each worker something to do, the idle ones first."""
        while len(self._workers) < min(self._count, len(self._waiting)):
            self._workers.append(_Worker(self._task, self._retries))
        for most, left in ((1, 0), (2, self._count)):  # a second one, so that none waits for the next, but the last ones
            for worker in self._workers:
                if len(worker.numbers) < most and len(self._waiting) > left:
                    worker.ask(self._waiting.popleft())

    def _replace(self, worker: _Worker) -> Optional[Outcome]:
        """Have what a lost worker had computed by others; return the failure of a realisation that has ended too many."""
        self._workers.remove(worker)
        status = worker.end()
        why = f"signal {-status}" if status < 0 else f"status {status}"
        guilty = worker.numbers[0] if worker.has_started and worker.numbers else None
        self._lost[guilty] += 1
        failed = self._lost[guilty] > self._retries
        if failed and not worker.has_started:
            raise Error("internal", f"no worker can start ({why})", "engine")
        if failed and guilty is not None:
            worker.numbers.popleft()
        self._waiting.extendleft(reversed(worker.numbers))
        if not failed or guilty is None:
            return None
        return Outcome(guilty, None, 0.0, ("internal", f"its worker was lost ({why})"))


def serve() -> None:
    """Compute what the parent asks for, until it is gone."""
    questions = multiprocessing.connection.Connection(os.dup(0), writable=False)
    answers = multiprocessing.connection.Connection(os.dup(1), readable=False)
    os.dup2(2, 1)  # what is printed must not come between answers
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    _core.keep_freed_memory()
    with contextlib.suppress(EOFError, BrokenPipeError):
        task, retries = questions.recv()
        answers.send(None)
        while True:
            answers.send(outcome_of(task, questions.recv(), retries))
