# SPDX-License-Identifier: LGPL-3.0-or-later
"""Errors, lack of memory, interrupts, threads."""

import os
import pickle
import signal
import threading
import time

import numpy as np
import pytest

import terrane
from conftest import BOX, DATA, HAS_TETGEN, SANITIZED, run_program, run_python, sheet, stack, wall

BAD_FILES = {
    "syntax.ts": "GOCAD TSurf 1\nVRTX 1 0 0\nEND\n", "number.ts": "GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 abc\nEND\n",
    "index.obj": "v 0 0 0\nv 1 0 0\nf 1 2 3\n", "empty.obj": "", "format.xyzzy": "", "ply.ply": "ply\nformat\n",
    "nan.obj": "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "off.off": "OFF\n3 1 0\n0 0 0\n1 0 0\n",
    "stl.stl": "solid x\nfacet\n", "vtp.vtp": "<VTKFile", "msh.msh": "$MeshFormat\n4.1", "asc.asc": "ncols 2\n",
}


@pytest.mark.parametrize("name", BAD_FILES)
def test_errors_of_files_are_the_program_s(name):
    open(name, "w").write(BAD_FILES[name])
    status, _, text = run_program("check", name)
    assert status == 2
    with pytest.raises(terrane.Error) as raised:
        terrane.arrange(terrane.read(name))
    assert str(raised.value) in text, "the same sentence"
    assert raised.value.code in terrane.ERROR_CODES


@pytest.mark.parametrize("code, call", [
    ("cannot_open", lambda: terrane.read("missing.ts")),
    ("cannot_open", lambda: terrane.read("missing*.ts")),
    ("unknown_format", lambda: terrane.read("x.ts", format="xyzzy")),
    ("bad_index", lambda: terrane.Surface([[0, 0, 0]], [[0, 0, 1]])),
    ("bad_number", lambda: terrane.Surface([[0, 0, np.nan], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])),
    ("bad_option", lambda: terrane.seal(stack(), 0)),
    ("bad_option", lambda: terrane.box((0, 0, 0), (0, 0, 0))),
    ("nothing_to_do", lambda: terrane.closed([terrane.Surface([], [])])),
    ("not_closed", lambda: terrane.closed([sheet()])),
    ("improper_contact", lambda: terrane.volumes(terrane.mesh(stack()))),
    ("cannot_open", lambda: sheet().save("no/such/folder/x.ts")),
    ("unknown_format", lambda: sheet().save("x.xyzzy")),
    ("unsupported", lambda: sheet().save("x.irap")),
    ("cannot_open", lambda: terrane.build("missing.json")),
    ("bad_syntax", lambda: terrane.verify(str(DATA / "top.ts"))),
])
def test_codes(code, call):
    with pytest.raises(terrane.Error) as raised:
        call()
    assert raised.value.code == code
    assert raised.value.sentence and not raised.value.sentence.endswith(".")


def test_an_error_has_code_sentence_and_place():
    with pytest.raises(terrane.Error) as raised:
        terrane.read("missing.ts")
    e = raised.value
    assert (e.code, e.place) == ("cannot_open", "missing.ts") and str(e) == f"{e.place}: {e.sentence}"
    assert isinstance(e, Exception) and not isinstance(e, MemoryError)


def test_errors_are_pickled():
    with pytest.raises(terrane.Error) as raised:
        terrane.read("missing.ts")
    other = pickle.loads(pickle.dumps(raised.value))
    assert (other.code, other.sentence, other.place) == (raised.value.code, raised.value.sentence, raised.value.place)


def test_out_of_memory_is_both():
    e = terrane.OutOfMemory("out_of_memory", "not enough memory")
    assert isinstance(e, MemoryError) and isinstance(e, terrane.Error) and e.code == "out_of_memory"
    assert isinstance(pickle.loads(pickle.dumps(e)), MemoryError)


@pytest.mark.skipif(SANITIZED, reason="the sanitizer reserves all addresses")
@pytest.mark.parametrize("stage", ["arrange", "check", "seal"])
def test_lack_of_memory_is_a_memory_error(stage):
    code = """
import resource, sys
sys.path.insert(0, sys.argv[2])
import terrane
from conftest import sheet, wall
surfaces = [sheet(400, 400, wave=0.1), sheet(400, 400, wave=0.2), wall()]
call = {"arrange": lambda: terrane.arrange(surfaces, threads=1), "check": lambda: terrane.check(surfaces, threads=1),
        "seal": lambda: terrane.seal(surfaces, 0.5, threads=1)}[sys.argv[1]]
used = int(open("/proc/self/statm").read().split()[0]) * 4096
hits = 0
for more in (20, 40, 60, 90):
    resource.setrlimit(resource.RLIMIT_AS, (used + more * 2**20, resource.RLIM_INFINITY))
    try:
        call()
    except MemoryError:
        hits += 1
resource.setrlimit(resource.RLIMIT_AS, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
assert hits > 0
terrane.arrange(surfaces[2])
print("alive", hits)
"""
    done = run_python(code, stage, str(__import__("pathlib").Path(__file__).parent))
    assert done.stdout.startswith("alive")


def large():
    """Return surfaces that take seconds to arrange with one thread."""
    n = 150 if SANITIZED else 420
    return [sheet(n, n, wave=0.3, slope=(0.01, 0)), sheet(n, n, wave=0.3, slope=(0.0, 0.02)), wall()]


def holed(n):
    """Return a surface with a hole in its middle."""
    whole = sheet(n, n, wave=0.4)
    centres = whole.vertices[whole.triangles].mean(axis=1)
    return whole.replace(triangles=whole.triangles[np.any(np.abs(centres[:, :2] - 2.5) > 1.2, axis=1)])


def stacked(n):
    """Return two horizons, which cross, and a fault."""
    return [sheet(n, n, wave=0.3, slope=(0.01, 0), name="a", role="horizon"), sheet(n, n, slope=(0.0, 0.02), name="b"), wall()]


def moderate():
    """Return surfaces of which the arrangement is no long work."""
    return stacked(50 if SANITIZED else 150)


def rounded_mesh():
    return terrane.round(terrane.arrange(moderate()))


N = 40 if SANITIZED else 100  # edges along a side of what costs more
STAGES = {  # the stage, and what makes its argument
    "arrange": (terrane.arrange, large),
    "check": (terrane.check, large),
    "round": (terrane.round, lambda: terrane.arrange(large())),
    "regions": (terrane.regions, rounded_mesh),
    "volumes": (terrane.volumes, lambda: terrane.arrange(large())),
    "structure": (lambda m, threads: terrane.structure(m, terrane.volumes(m), threads=threads), rounded_mesh),
    "volume_of_interest": (lambda s, threads: terrane.volume_of_interest(s, BOX, threads=threads), moderate),
    "seal": (lambda s, threads: terrane.seal(s, 0.05, threads=threads), lambda: stacked(N)),
    "extend": (lambda s, threads: terrane.extend(s, terrane.box((-5, -5, -5), (9, 9, 5)), 3.0, threads=threads), moderate),
    "improve": (terrane.improve, lambda: terrane.round(terrane.arrange([sheet(40, 40, wave=0.3), wall()])).mesh),
    "distance": (lambda s, threads: terrane.distance(*s[:2], threads=threads), lambda: stacked(2 * N)),
    "kriging": (terrane.fill, lambda: holed(N)),
    "rbf": (lambda s, threads: terrane.fill(s, method="rbf", threads=threads), lambda: holed(60)),
    "layers": (lambda s, threads: terrane.layers(s, {"a": 1, "b": 2}, threads=threads), lambda: stacked(N)[:2]),
    "model": (lambda s, threads: terrane.model(s, box=BOX, threads=threads), moderate),
    "verify": (terrane.verify, lambda: terrane.arrange(stacked(N // 2))),
    "locate": (lambda m, threads: m.block_of(np.full((100_000 if SANITIZED else 1_000_000, 3), 1.01), threads=threads),
               lambda: terrane.model(stack(), box=BOX)),
    "tetrahedralize": (lambda m, threads: terrane.tetrahedralize(m, edge_length=None if SANITIZED else 1.5, threads=threads),
                       lambda: terrane.model(stack(), box=BOX)),
}


def processor_seconds():
    """Return those of this process and of all its children that have ended."""
    return sum(os.times()[:4])


@pytest.mark.parametrize("stage", STAGES)
def test_keyboard_interrupt_stops_a_stage_within_a_second(stage):
    if stage == "tetrahedralize" and not HAS_TETGEN:
        pytest.skip("no terrane-tetgen")
    call, make = STAGES[stage]
    argument = make()
    began, began_at = processor_seconds(), time.monotonic()
    call(argument, threads=1)
    whole, seconds = processor_seconds() - began, time.monotonic() - began_at

    def interrupt(*_):
        raise KeyboardInterrupt
    # The interrupt comes after a share of the work. What a helper program does, no timer of this process counts.
    is_here = stage != "tetrahedralize"
    number, timer = (signal.SIGPROF, signal.ITIMER_PROF) if is_here else (signal.SIGALRM, signal.ITIMER_REAL)
    before = signal.signal(number, interrupt)
    try:
        began = processor_seconds()
        with pytest.raises(KeyboardInterrupt):
            signal.setitimer(timer, max(0.01, 0.2 * (whole if is_here else seconds)))
            call(argument, threads=1)
            while True:  # where it was done sooner this time
                pass
        assert processor_seconds() - began < 0.2 * whole + 1.0
    finally:
        signal.setitimer(timer, 0)
        signal.signal(number, before)
    assert len(terrane.arrange(stack()).triangles) > 0


@pytest.mark.skipif(SANITIZED, reason="slow")
def test_control_c_ends_a_program():
    code = """
import os, signal, sys, threading, time
sys.path.insert(0, sys.argv[1])
import terrane, test_errors
surfaces = test_errors.large()
threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    while True:
        terrane.arrange(surfaces, threads=2)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""
    done = run_python(code, str(__import__("pathlib").Path(__file__).parent))
    assert done.stdout == "interrupted\n"


def test_an_exception_of_the_callback_stops_the_stage():
    class Enough(Exception):
        pass

    def progress(stage, share):
        raise Enough(stage)
    with pytest.raises(Enough):
        terrane.arrange(large(), threads=1, progress=progress)


def test_other_python_threads_run_meanwhile():
    """The GIL is released: a thread counts while a stage runs."""
    counted, over = [0], threading.Event()

    def count():
        while not over.is_set():
            counted[0] += 1
            time.sleep(0.001)
    counter = threading.Thread(target=count)
    surfaces = large()
    counter.start()
    before = counted[0]
    terrane.arrange(surfaces, threads=1)
    during = counted[0] - before
    over.set()
    counter.join()
    assert during > 20


def test_stages_of_several_threads_give_the_right_results(arrangement):
    results = [None] * 8

    def work(i):
        results[i] = terrane.arrange(stack(), threads=1 + i % 2)
    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(results))]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert all(r == arrangement for r in results)


def test_errors_in_several_threads():
    seen = []

    def work():
        try:
            terrane.read("missing.ts")
        except terrane.Error as error:
            seen.append(error.code)
    threads = [threading.Thread(target=work) for _ in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert seen == ["cannot_open"] * 4


def test_processes_that_are_forked(arrangement):
    """Stages work in a child, even if the parent has used threads before."""
    if SANITIZED:
        pytest.skip("slow")
    code = """
import multiprocessing, sys
sys.path.insert(0, sys.argv[1])
import terrane
from conftest import sheet, stack, wall
big = [sheet(120, 120, wave=0.1), wall()]
expected = len(terrane.arrange(big, threads=2).triangles)
def work(i):
    return len(terrane.arrange(big, threads=2).triangles), terrane.arrange(stack())
if __name__ == "__main__":
    with multiprocessing.get_context("fork").Pool(2) as pool:
        for count, result in pool.map(work, range(4), chunksize=1):
            assert count == expected and result == terrane.arrange(stack())
print("done")
"""
    assert run_python(code, str(__import__("pathlib").Path(__file__).parent)).stdout == "done\n"


@pytest.mark.skipif(SANITIZED, reason="the sanitizer keeps freed memory")
@pytest.mark.parametrize("call", ["arrange", "round", "check", "model", "error", "surface", "views"])
def test_a_thousand_calls_do_not_grow(call):
    code = """
import gc, sys
sys.path.insert(0, sys.argv[2])
import numpy as np, terrane
from conftest import BOX, sheet, stack
s, big = stack(), sheet(60, 60)
v, t = np.array(big.vertices), np.array(big.triangles)
a = terrane.arrange(s)
def error():
    try: terrane.arrange(terrane.Surface([[0, 0, np.nan]] * 3, [[0, 1, 2]]))
    except terrane.Error: pass
def views():
    m = terrane.round(a).mesh
    return m.vertices[3:], m.surfaces_of[2], m.triangles
calls = {"arrange": lambda: terrane.arrange(s, threads=2), "round": lambda: terrane.round(a),
         "check": lambda: terrane.check(s), "model": lambda: terrane.model(s, box=BOX).leaks, "error": error,
         "surface": lambda: terrane.arrange(terrane.Surface(v, t)), "views": views}
call = calls[sys.argv[1]]
def used():
    gc.collect()
    return int(open("/proc/self/statm").read().split()[1]) * 4
n = 100 if sys.argv[1] in ("model", "surface") else 1000
for _ in range(n // 4): call()
before = used()
for _ in range(n): call()
print(used() - before)
"""
    done = run_python(code, call, str(__import__("pathlib").Path(__file__).parent))
    assert int(done.stdout) < 2500, "kilobytes that a thousand calls left"
