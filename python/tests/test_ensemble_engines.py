# SPDX-License-Identifier: LGPL-3.0-or-later
"""Who computes ensembles: processes without a port, and the workers of a scheduler that somebody else has started."""

import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import threading
import time

import pytest

import terrane
from conftest import PROGRAM, SANITIZED, SOURCE, environment_of_python, run_program
from terrane import _ensemble_workers
from test_ensemble import files_of, needs_own_interpreter, wait_for_realisations, write_stack


def has_dask():
    try:
        import distributed  # noqa: F401
    except ImportError:
        return False
    return not SANITIZED  # its processes would need the sanitizer's library first


needs_dask = pytest.mark.skipif(not has_dask(), reason="needs python3-distributed, and a library without sanitizer")


@needs_own_interpreter
def test_one_and_two_workers_and_a_killed_one_give_the_same():
    write_stack()
    wanted = files_of(terrane.ensemble("p.json", realisations=24, engine="serial"))
    assert files_of(terrane.ensemble("p.json", realisations=24, workers=1)) == wanted
    killed = []

    def kill_one(stage, share):
        if share > 0.2 and not killed:
            assert len(_ensemble_workers._running) == 2
            killed.append(min(_ensemble_workers._running, key=lambda p: p.pid))
            killed[0].kill()

    assert files_of(terrane.ensemble("p.json", realisations=24, workers=2, progress=kill_one)) == wanted
    assert killed and killed[0].returncode == -signal.SIGKILL and not _ensemble_workers._running


#: A package that is found before the library's worker, and ends the interpreter at some realisations.
DEADLY = """
from terrane import _ensemble_work, _ensemble_workers
real = _ensemble_work.run_one
def run_one(task, number):
    if number in {numbers}:
        os._exit(7)
    return real(task, number)
_ensemble_work.run_one = run_one
"""


@needs_own_interpreter
def test_a_realisation_that_ends_its_workers_fails_and_no_other_does(monkeypatch):
    write_stack()
    wanted = terrane.ensemble("p.json", realisations=9, engine="serial")
    monkeypatch.setattr(_ensemble_workers, "_START", "import os, sys; sys.path[:] = {!r}" + DEADLY.format(numbers="(2, 5)")
                        + "_ensemble_workers.serve()")
    for retries in (0, 2):
        made = terrane.ensemble("p.json", realisations=9, workers=2, retries=retries)
        assert made.failures == [terrane.Failure(n, "internal", "its worker was lost (status 7)") for n in (2, 5)]
        assert [r for i, r in enumerate(made._records, 1) if i not in (2, 5)] \
            == [r for i, r in enumerate(wanted._records, 1) if i not in (2, 5)]
    monkeypatch.setattr(_ensemble_workers, "_START", "import sys; {!r}; sys.exit(3)")
    with pytest.raises(terrane.Error, match=r"no worker can start \(status 3\)"):
        terrane.ensemble("p.json", realisations=9, workers=2)
    assert not _ensemble_workers._running


def sockets_of(root):
    """Return a line for each socket of a process and of its descendants that others could reach."""
    parents = {}
    for path in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            parents[int(path.parent.name)] = int(path.read_text().rpartition(")")[2].split()[1])
        except OSError:
            continue
    tree = {root}
    while True:
        more = {pid for pid, parent in parents.items() if parent in tree} - tree
        if not more:
            break
        tree |= more
    inodes = set()
    for pid in tree:
        for fd in pathlib.Path(f"/proc/{pid}/fd").glob("*"):
            try:
                inodes.update(re.findall(r"socket:\[(\d+)\]", os.readlink(fd)))
            except OSError:
                continue
    lines = []
    for table in ("tcp", "tcp6", "udp", "udp6", "raw", "raw6", "unix"):
        for line in pathlib.Path(f"/proc/net/{table}").read_text().splitlines()[1:]:
            words = line.split()
            if table == "unix":  # a pair has no name, and listens to nobody
                if words[6] in inodes and (len(words) > 7 or int(words[3], 16) & 0x10000):
                    lines.append(f"unix {line}")
            elif words[9] in inodes:
                lines.append(f"{table} {line}")
    return len(tree), lines


@needs_own_interpreter
@pytest.mark.skipif(not os.path.exists("/proc/net/unix"), reason="the system has no /proc")
def test_no_process_of_an_ensemble_has_a_socket_that_others_reach():
    write_stack()
    made = []
    largest = 0

    def look(stage, share):
        nonlocal largest
        count, lines = sockets_of(os.getpid())
        largest = max(largest, count)
        made.extend(lines)

    with socket.socket() as known:  # the test sees what there is
        known.bind(("127.0.0.1", 0))
        known.listen()
        assert [line.split()[0] for line in sockets_of(os.getpid())[1]] == ["tcp"]
    terrane.ensemble("p.json", realisations=30, workers=3, progress=look)
    assert made == [] and largest == 4


@needs_own_interpreter
def test_scripts_need_no_guard_and_workers_take_no_module_from_the_current_folder():
    write_stack()
    for name in ("json", "numpy", "terrane", "pickle", "signal", "argparse"):
        pathlib.Path(name + ".py").write_text(f'open("taken", "a").write("{name} ")\n')
    os.mkdir("scripts")
    pathlib.Path("scripts/plain.py").write_text(
        "import terrane\nprint(terrane.ensemble('p.json', realisations=4, workers=2))\n")
    done = subprocess.run([sys.executable, "scripts/plain.py"], capture_output=True, text=True, env=environment_of_python())
    assert (done.stdout, done.stderr) == ("<Ensemble: 4 realisations, 6 blocks, 0 failed>\n", "")
    status, out, err = run_program("ensemble", "p.json", "-o", "run", "--realisations", "4", "--workers", "2")
    assert (status, err) == (0, "")
    assert not os.path.exists("taken")


def start_of_cluster(command, *options, packages=None):
    """Start a scheduler or a worker as a cluster has them; `packages` is where it looks for Python packages."""
    return subprocess.Popen([sys.executable, "-m", f"distributed.cli.{command}", *options, "--no-dashboard",
                             "--scheduler-file", "scheduler.json"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                            env={**os.environ, **({"PYTHONPATH": packages} if packages else {})})


def start_worker(packages=None):
    return start_of_cluster("dask_worker", "--nthreads", "1", "--no-nanny", packages=packages)


def start_scheduler(workers, packages=None):
    """Return the processes, the scheduler first."""
    scheduler = start_of_cluster("dask_scheduler", "--host", "127.0.0.1", "--port", "0")
    return [scheduler] + [start_worker(packages) for _ in range(workers)]


def warning_of(address):
    """Return what the program says about a scheduler without TLS."""
    return (f"terrane: warning: {address}: whoever reaches this scheduler runs programs as you and as its workers' user; "
            "tls:// asks for a key\n")


def scheduler_s_address():
    while True:
        try:
            return json.loads(pathlib.Path("scheduler.json").read_text())["address"]
        except (OSError, ValueError):
            time.sleep(0.05)


def wait_for_worker(address):
    import distributed
    with distributed.Client(address, set_as_default=False) as client:
        client.wait_for_workers(1)


@needs_dask
def test_a_result_that_is_lost_with_its_worker_is_awaited(monkeypatch):
    import distributed
    write_stack()
    wanted = files_of(terrane.ensemble("p.json", realisations=3, engine="serial"))

    class Losing(distributed.as_completed):
        """Loses each result after it has come, as when its worker ends then, and has it back soon."""

        def __next__(self):
            future = super().__next__()
            future._state.lose()
            threading.Timer(0.2, future.client.loop.add_callback, [future._state.finish]).start()
            return future

    monkeypatch.setattr(distributed, "as_completed", Losing)
    processes = start_scheduler(1)
    try:
        with pytest.warns(RuntimeWarning, match="whoever reaches this scheduler"):
            assert files_of(terrane.ensemble("p.json", realisations=3, scheduler=scheduler_s_address())) == wanted
    finally:
        for p in processes:
            p.kill()


@needs_dask
def test_workers_of_another_s_scheduler_give_the_same_and_are_not_ended():
    write_stack()
    wanted = files_of(terrane.ensemble("p.json", realisations=12, engine="serial"))
    processes = start_scheduler(2)
    try:
        address = scheduler_s_address()
        assert files_of(terrane.ensemble("p.json", realisations=12, scheduler=address)) == wanted
        status, out, err = run_program("ensemble", "p.json", "-o", "run", "--realisations", "12", "--scheduler", address)
        assert (status, err) == (0, warning_of(address)) and out.startswith("12 realisations, seed 1: all built\n")
        killed = []

        def kill_one(stage, share):
            if share > 0.2 and not killed:
                killed.append(processes[1])
                processes[1].kill()

        assert files_of(terrane.ensemble("p.json", realisations=12, scheduler=address, progress=kill_one)) == wanted
        assert killed
        time.sleep(0.5)
        assert [p.poll() for p in (processes[0], processes[2])] == [None, None]
    finally:
        for p in processes:
            p.kill()


@needs_dask
def test_a_scheduler_that_does_not_answer_or_ends_is_an_error():
    write_stack()
    with pytest.raises(terrane.Error, match="no scheduler answers"):
        terrane.ensemble("p.json", realisations=2, scheduler="tcp://127.0.0.1:1")
    processes = start_scheduler(1)
    try:
        address = scheduler_s_address()
        options = ["--realisations", "60", "--scheduler", address]
        running = subprocess.Popen([PROGRAM, "ensemble", "p.json", "-o", "run", *options], stderr=subprocess.PIPE, text=True)
        wait_for_realisations("run", 5)
        processes[0].kill()
        err = running.communicate()[1]
    finally:
        for p in processes:
            p.kill()
    assert err == warning_of(address) + f"terrane: {address}: the scheduler is gone, or has cancelled realisations\n"
    assert running.returncode == 2 and not os.path.exists("run")
    kept = len(list(pathlib.Path(".").glob("run.realisations/*/*.npz")))
    status, out, err = run_program("ensemble", "p.json", "-o", "run", "--realisations", "60", "--engine", "serial")
    assert (status, err) == (0, "") and f"computed {60 - kept} of" in out


@needs_dask
def test_workers_without_this_version_are_an_error_before_the_first_realisation():
    write_stack()
    os.makedirs("empty")
    os.makedirs("other/terrane")
    pathlib.Path("other/terrane/__init__.py").write_text('__version__ = "0.0.1"\n')
    for packages, words in (("empty", "cannot import the Python package terrane: No module named 'terrane'"),
                            ("other", f"has terrane 0.0.1, this is {terrane.__version__}; all need the same version")):
        processes = start_scheduler(1, os.path.abspath(packages))
        try:
            address = scheduler_s_address()
            wait_for_worker(address)
            status, out, err = run_program("ensemble", "p.json", "-o", "run", "--realisations", "3", "--scheduler", address)
        finally:
            for p in processes:
                p.kill()
            os.remove("scheduler.json")
        assert (status, out) == (2, "")
        assert err.startswith(warning_of(address))
        assert re.fullmatch(rf"terrane: {address}: the worker tcp://\S+ {re.escape(words)}\n", err[len(warning_of(address)):])
        assert not os.path.exists("run")


@needs_dask
def test_a_scheduler_without_workers_is_waited_for_with_a_warning():
    write_stack()
    processes = start_scheduler(0)
    try:
        address = scheduler_s_address()
        running = subprocess.Popen([PROGRAM, "ensemble", "p.json", "-o", "run", "--realisations", "3", "--scheduler", address],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        assert running.stderr.readline() == warning_of(address)
        line = running.stderr.readline()
        assert line == f"terrane: warning: {address}: the scheduler has no workers yet; realisations wait for them\n"
        processes.append(start_worker())
        out, err = running.communicate()
    finally:
        for p in processes:
            p.kill()
    assert (running.returncode, err) == (0, "") and out.startswith("3 realisations, seed 1: all built\n")


@needs_dask
def test_a_scheduler_with_keys_lets_nobody_else_in():
    """The commands of docs/how-to/ensemble.md make the keys."""
    text = (SOURCE / "docs/how-to/ensemble.md").read_text()
    commands = re.search(r"```bash\n(umask.*?)```", text, re.S).group(1)
    write_stack()
    pathlib.Path("uncertain.json").write_bytes(pathlib.Path("p.json").read_bytes())
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    commands = commands.replace("8786", str(port)).replace("kill %1 %2", "")
    begin, run = commands.split("terrane ensemble", 1)
    environment = {**os.environ, "PATH": f"{os.path.dirname(PROGRAM)}:{os.environ['PATH']}"}
    script = begin.replace("dask scheduler", f"{sys.executable} -m distributed.cli.dask_scheduler").replace(
        "dask worker", f"{sys.executable} -m distributed.cli.dask_worker") + "wait"
    cluster = subprocess.Popen(["bash", "-c", script], env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               start_new_session=True)
    try:
        keys = begin[:begin.index("dask scheduler")].replace("openssl", ": openssl")
        while True:  # until the scheduler has begun
            done = subprocess.run(["bash", "-c", keys + "terrane ensemble" + run.rstrip() + " --realisations 4"], env=environment,
                                  capture_output=True, text=True)
            if done.returncode == 0:
                break
            assert "no scheduler answers" in done.stderr
        assert "whoever reaches" not in done.stderr and "4 realisations, seed 1: all built" in done.stdout
        stranger = subprocess.run([sys.executable, "-c", STRANGER, f"127.0.0.1:{port}"], capture_output=True, text=True)
        assert stranger.stdout == "refused refused ", stranger.stderr
    finally:
        os.killpg(cluster.pid, signal.SIGKILL)
        cluster.wait()


#: Tries to run code on a scheduler, without a key and without TLS.
STRANGER = """
import distributed, logging, sys
logging.disable(50)
for start in ("tls", "tcp"):
    try:
        client = distributed.Client(f"{start}://{sys.argv[1]}", timeout=5)
        print(client.run_on_scheduler(lambda: 1), end=" ")
    except (OSError, TypeError, ValueError, RuntimeError):
        print("refused", end=" ")
"""
