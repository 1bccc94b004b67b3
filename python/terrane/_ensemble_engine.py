# SPDX-License-Identifier: LGPL-3.0-or-later
"""Who computes the realisations of an ensemble: processes of this machine, MPI, this process, or a Dask scheduler's workers.

An engine takes the numbers of realisations and yields an `Outcome` for each, in any order. What it yields does not depend
on how many workers it has, nor on what happened to them.
"""

from __future__ import annotations

import concurrent.futures
import contextlib
import importlib
import itertools
import warnings
from typing import Any, Generator, Iterator, List, NamedTuple, Optional, Sequence

from . import _core
from ._arrays import as_count
from ._ensemble_work import Outcome, Task, outcome_of, reason_of
from ._ensemble_workers import Workers
from ._errors import Error, bad_option
from ._run import cores

ENGINES = ("processes", "mpi", "serial")
#: Realisations per worker of a scheduler that are sent before one comes back.
_AHEAD = 4


class Engine(NamedTuple):
    """How an ensemble is computed; nothing of it changes a result."""

    name: str  #: of ENGINES, or "dask"
    workers: int
    scheduler: Optional[str]
    retries: int


def engine_of(name: Optional[str], workers: Optional[int], scheduler: Optional[str], retries: int) -> Engine:
    """Return the engine that a caller asks for; an error for what would be ignored."""
    if name is not None and name not in ENGINES:
        raise bad_option(f"{name!r} is none of {', '.join(ENGINES)}", "engine")
    if scheduler is not None:
        if not isinstance(scheduler, str):
            raise TypeError(f"scheduler is an address, not {type(scheduler).__name__}")
        if name is not None:
            raise bad_option(f"goes with no scheduler, whose workers compute: {name!r}", "engine")
    chosen = "dask" if scheduler is not None else name or "processes"
    if workers is not None and chosen != "processes":
        raise bad_option(f"is for the engine processes, not {chosen}", "workers")
    count = cores() if workers is None else as_count(workers, "workers", 1, 4096)
    return Engine(chosen, count if chosen == "processes" else 1, scheduler, as_count(retries, "retries", 0, 1000))


def _module(name: str, package: str, option: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError:
        raise Error("unsupported", f"the Python module {name.split('.')[0]} is missing: install {package}, or choose "
                    "the engine processes", option) from None


def outcomes(engine: Engine, pool: Any, task: Task, numbers: Sequence[int]) -> Generator[Outcome, None, None]:
    """Compute realisations, and yield each as soon as it is there. `pool` is that of `pool_of`."""
    if not numbers:
        return
    if engine.name == "mpi":
        yield from _by_mpi(pool, engine, task, numbers)
    elif engine.name == "processes":
        yield from Workers(task, engine.workers, engine.retries).outcomes(numbers)
    elif engine.name == "dask":
        yield from _by_dask(engine, task, numbers)
    else:
        for number in numbers:
            yield outcome_of(task, number, engine.retries)


def _by_mpi(pool: Any, engine: Engine, task: Task, numbers: Sequence[int]) -> Generator[Outcome, None, None]:
    for future in concurrent.futures.as_completed([pool.submit(outcome_of, task, n, engine.retries) for n in numbers]):
        yield future.result()


def _by_dask(engine: Engine, task: Task, numbers: Sequence[int]) -> Generator[Outcome, None, None]:
    assert engine.scheduler is not None
    distributed = _module("distributed", "python3-distributed", "scheduler")
    with contextlib.ExitStack() as stack:
        client = stack.enter_context(_client(distributed, engine.scheduler))
        _check_workers(client, engine.scheduler)
        waiting = iter(numbers)

        def sent(count: int) -> List[Any]:
            return [client.submit(outcome_of, task, number, engine.retries, key=f"terrane-{task.key[:16]}-{number}",
                                  pure=False) for number in itertools.islice(waiting, count)]

        done = distributed.as_completed(sent(_AHEAD * max(1, len(client.scheduler_info()["workers"]))), loop=client.loop)
        for future in done:
            number = int(future.key.rpartition("-")[2])
            try:
                # A result that is lost with its worker is computed again; exception() waits for that.
                error = future.exception() if future.status in ("error", "lost") else None
                if future.status == "cancelled":
                    raise ConnectionError
                outcome = future.result() if error is None else Outcome(number, None, 0.0, reason_of(error))
            except (OSError, concurrent.futures.CancelledError):  # of the connection: tasks' own errors are in outcomes
                raise _scheduler_is_gone(engine.scheduler) from None
            future.release()
            for other in sent(1):
                done.add(other)
            yield outcome


def _client(distributed: Any, scheduler: str) -> Any:
    """Connect to a scheduler."""
    if not scheduler.startswith("tls://"):
        warnings.warn(f"{scheduler}: whoever reaches this scheduler runs programs as you and as its workers' user; tls:// "
                      "asks for a key", RuntimeWarning, stacklevel=2)
    try:
        return distributed.Client(scheduler, timeout=10, set_as_default=False)
    except (OSError, TimeoutError, ValueError, TypeError) as error:
        raise Error("cannot_open", f"no scheduler answers: {error}", scheduler) from None


def _scheduler_is_gone(scheduler: str) -> Error:
    return Error("cannot_open", "the scheduler is gone, or has cancelled realisations", scheduler)
def _check_workers(client: Any, scheduler: str) -> None:
    """See that the workers of a scheduler have this version of the package: else each realisation would fail."""

    def version() -> str:  # Dask sends this function itself, as workers may not have this module
        import terrane
        return terrane.__version__

    try:
        found = client.run(version, on_error="return")
    except (OSError, concurrent.futures.CancelledError):
        raise _scheduler_is_gone(scheduler) from None
    if not found:  # it may start some when there is work
        warnings.warn(f"{scheduler}: the scheduler has no workers yet; realisations wait for them", RuntimeWarning,
                      stacklevel=2)
    for worker, answer in sorted(found.items()):
        if isinstance(answer, ImportError):
            raise Error("unsupported", f"the worker {worker} cannot import the Python package terrane: {answer}", scheduler)
        if isinstance(answer, str) and answer != str(_core.version):
            raise Error("unsupported", f"the worker {worker} has terrane {answer}, this is {_core.version}; all need the "
                        "same version", scheduler)
        # Other answers are of workers that are gone.


@contextlib.contextmanager
def pool_of(engine: Engine) -> Iterator[Any]:
    """Enter what other processes have to enter at the same time: the executor of MPI; None for other engines.

    Ranks other than 0 compute until rank 0 has all, and then end.
    """
    if engine.name != "mpi":
        yield None
        return
    executors = _module("mpi4py.futures", "python3-mpi4py", "engine")
    with executors.MPICommExecutor() as executor:
        if executor is not None:
            yield executor
            return
    raise SystemExit(0)
