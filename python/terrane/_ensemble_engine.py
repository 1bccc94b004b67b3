# SPDX-License-Identifier: LGPL-3.0-or-later
"""Who computes the realisations of an ensemble: Dask, MPI, or this process.

An engine takes the numbers of realisations and yields (number, file, seconds of processor, error) in any order. What
it yields does not depend on how many workers it has, nor on what happened to them.
"""

from __future__ import annotations

import concurrent.futures
import contextlib
import importlib
import itertools
import multiprocessing
import shutil
import signal
import tempfile
import warnings
from typing import Any, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple

from . import _core
from ._ensemble_work import Task, run_one
from ._errors import Error

Outcome = Tuple[int, Optional[bytes], float, Optional[BaseException]]

ENGINES = ("dask", "mpi", "serial")
#: Realisations per worker that are sent before one comes back.
_AHEAD = 4
#: Dask's workers look at themselves a hundred times per second, which nobody asked for and costs a fifth of the time.
_QUIET_WORKERS = {"distributed.worker.profile.enabled": False, "distributed.worker.profile.interval": "10s",
                  "distributed.admin.tick.interval": "1s", "distributed.admin.system-monitor.interval": "2s"}
#: The settings of `keep_freed_memory`, as environment variables of workers. By default Dask lets workers return freed memory
#: to the system at once, and requesting it again took half of the time of an ensemble.
_MEMORY_KEPT: Dict[str, Any] = {f"distributed.nanny.pre-spawn-environ.{name}": value for name, value in
                (("MALLOC_TRIM_THRESHOLD_", 1 << 30), ("MALLOC_MMAP_THRESHOLD_", 1 << 30), ("MALLOC_ARENA_MAX", 1))}


#: Folders of workers that this process has started.
_folders: List[str] = []


class Engine(NamedTuple):
    """How an ensemble is computed; nothing of it changes a result."""

    name: str
    workers: int
    scheduler: Optional[str]
    dashboard: Optional[str]
    retries: int


def _module(name: str, package: str, option: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError:
        raise Error("unsupported", f"the Python module {name.split('.')[0]} is missing: install {package}, or choose "
                    "the engine serial", option) from None


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


def outcomes(engine: Engine, pool: Any, task: Task, numbers: Sequence[int]) -> Iterator[Outcome]:
    """Compute realisations, and yield each as soon as it is there. `pool` is that of `pool_of`."""
    if not numbers:
        return iter(())
    if engine.name == "mpi":
        return _by_mpi(pool, task, list(numbers))
    return (_by_dask if engine.name == "dask" else _by_this_process)(engine, task, list(numbers))


def _by_this_process(engine: Engine, task: Task, numbers: List[int]) -> Iterator[Outcome]:
    for number in numbers:
        error: Optional[BaseException] = None
        for _ in range(engine.retries + 1):
            try:
                data, seconds = run_one(task, number)
            except Error as failed:
                if failed.code == "interrupted":
                    raise
                error = failed
                continue
            yield number, data, seconds, None
            break
        else:
            yield number, None, 0.0, error


def _by_dask(engine: Engine, task: Task, numbers: List[int]) -> Iterator[Outcome]:
    distributed = _module("distributed", "python3-distributed", "engine")
    with contextlib.ExitStack() as stack:
        client = _client(distributed, engine, task, stack)
        if engine.scheduler:
            _check_workers(client, engine.scheduler)
        workers = max(1, len(client.scheduler_info()["workers"]), engine.workers if not engine.scheduler else 1)
        waiting = iter(numbers)

        def submit(number: int) -> Any:
            return client.submit(run_one, task, number, key=f"terrane-{task.key[:16]}-{number}",
                                 pure=False, retries=engine.retries)

        numbered: Dict[Any, int] = {}

        def sent(count: int) -> List[Any]:
            futures = []
            for number in itertools.islice(waiting, count):
                future = submit(number)
                numbered[future.key] = number
                futures.append(future)
            return futures

        done = distributed.as_completed(sent(_AHEAD * workers), loop=client.loop)
        for future in done:
            number = numbered.pop(future.key)
            try:
                # A result that is lost with its worker is computed again; exception() waits for that.
                error = future.exception() if future.status in ("error", "lost") else None
                if future.status == "cancelled":
                    raise ConnectionError
                data, seconds = future.result() if error is None else (None, 0.0)
            except (OSError, concurrent.futures.CancelledError):  # of the connection: tasks' own errors are not raised here
                raise _scheduler_is_gone(engine.scheduler or "") from None
            future.release()
            for other in sent(1):
                done.add(other)
            yield number, data, seconds, error


def _client(distributed: Any, engine: Engine, task: Task, stack: contextlib.ExitStack) -> Any:
    """Connect to the scheduler, or start one with workers on this machine."""
    if engine.scheduler:
        try:
            return stack.enter_context(distributed.Client(engine.scheduler, timeout=10, set_as_default=False))
        except (OSError, TimeoutError, ValueError) as error:
            raise Error("cannot_open", f"no scheduler answers: {error}", engine.scheduler) from None
    folder = tempfile.mkdtemp(prefix="terrane-workers-")
    _folders.append(folder)
    stack.callback(shutil.rmtree, folder, ignore_errors=True)
    settings = {**_MEMORY_KEPT, **({} if engine.dashboard else _QUIET_WORKERS)}  # workers inherit them
    with _interrupts_blocked(), _module("dask.config", "python3-dask", "engine").set(settings):
        # Terrane itself reports lack of memory; a limit of Dask's would kill workers before.
        cluster = stack.enter_context(distributed.LocalCluster(
            n_workers=engine.workers, threads_per_worker=1, processes=True, memory_limit=0, local_directory=folder,
            dashboard_address=engine.dashboard or "127.0.0.1:0", silence_logs=50))
        return stack.enter_context(distributed.Client(cluster, set_as_default=False))


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


def abandon() -> None:
    """Kill the workers that this process has started, and remove their folders: the process is about to end."""
    for child in multiprocessing.active_children():
        child.kill()
    for folder in _folders:
        shutil.rmtree(folder, ignore_errors=True)


def _by_mpi(pool: Any, task: Task, numbers: List[int]) -> Iterator[Outcome]:
    futures = importlib.import_module("concurrent.futures")
    pending = {pool.submit(run_one, task, number): number for number in numbers}
    for future in futures.as_completed(list(pending)):
        error = future.exception()
        data, seconds = future.result() if error is None else (None, 0.0)
        yield pending.pop(future), data, seconds, error


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
