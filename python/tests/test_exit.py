# SPDX-License-Identifier: LGPL-3.0-or-later
"""Interpreters that end while threads are in stages."""

import pathlib

import pytest

from conftest import run_python

START = """
import atexit, sys, threading, time
sys.path.insert(0, sys.argv[1])
import terrane
from conftest import sheet
surfaces = [sheet(250, 250, wave=0.3, slope=(0.01, 0)), sheet(250, 250, wave=0.3, slope=(0, 0.02))]
inside = threading.Event()
def told(stage, share):
    inside.set()
"""
ENDS = {
    "a stage": """
def work():
    terrane.arrange(surfaces, threads=1, progress=told)
""",
    "stage after stage": """
def work():
    while True:
        try:
            terrane.arrange(surfaces[0], threads=1, progress=told)
            terrane.check(surfaces[0], threads=2)
        except terrane.Error:
            pass
""",
    "the callback of the progress": """
def told(stage, share):
    inside.set()
    while True:  # Python code, which has to take the lock of the interpreter again
        sum(range(1000))
def work():
    terrane.arrange(surfaces, threads=1, progress=told)
""",
    "a callback that sleeps": """
def told(stage, share):
    inside.set()
    time.sleep(0.3)
def work():
    terrane.arrange(surfaces, threads=1, progress=told)
""",
    "the verifier": """
made = terrane.arrange(surfaces[0])
def work():
    inside.set()
    terrane.verify(made, threads=1)
""",
}
END = """
atexit.register(lambda: len(terrane.arrange(surfaces[0].replace(triangles=surfaces[0].triangles[:4])).triangles))
for _ in range(int(sys.argv[2])):
    threading.Thread(target=work, daemon=True).start()
inside.wait()
print("main is done", flush=True)
"""


@pytest.mark.parametrize("threads", [1, 4])
@pytest.mark.parametrize("where", ENDS)
def test_a_daemon_thread_may_be_anywhere_when_the_interpreter_ends(where, threads):
    done = run_python(START + ENDS[where] + END, str(pathlib.Path(__file__).parent), threads)
    assert (done.stdout, done.stderr) == ("main is done\n", "")


def test_the_main_thread_runs_stages_until_the_end():
    """Functions that atexit calls after ours, and finalizers of modules, still get results."""
    done = run_python("""
import atexit
atexit.register(lambda: print(len(terrane.arrange(terrane.box((0, 0, 0), (1, 1, 1))).triangles), flush=True))
import terrane
""")
    assert (done.stdout, done.stderr) == ("12\n", "")
