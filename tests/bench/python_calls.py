#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Measures what calls from Python cost beside the library's own work; --help lists what is to be given.

    python_calls.py --build build/release [--repeats N] FILE...

For each file of surfaces it prints, medians of runs in turn:
(1) `arrange` of NumPy arrays, beside the same call in C++ (the seconds of its steps, which the program states);
(2) two calls one after the other, and in two Python threads, with one thread of the library each.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path


STEPS = ("prepare", "search", "intersect", "triangulate", "stitch")


def in_cpp(program, file, folder):
    """Return the seconds of the steps that are `arrange`."""
    stats = folder / "stats.json"
    subprocess.run([program, "arrange", file, "--threads", "1", "-o", folder / "out.obj", "--stats", stats],
                   check=True, capture_output=True)
    seconds = json.loads(stats.read_text())["seconds"]
    return sum(seconds[step] for step in STEPS)


def timed(work):
    """Return the seconds that it takes."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def in_threads(work, count):
    """Run it in so many Python threads at a time."""
    threads = [threading.Thread(target=work) for _ in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def measure(terrane, program, file, repeats, folder):
    """Print the lines of one file."""
    given = terrane.read(file)
    arrays = [terrane.Surface(s.vertices.copy(), s.triangles.copy(), s.name) for s in given]
    size = sum(s.vertices.nbytes + s.triangles.nbytes for s in arrays) / 1e6

    def call():
        terrane.arrange(arrays, threads=1)

    cpp, python, one, two = [], [], [], []
    for _ in range(repeats):
        cpp.append(in_cpp(program, file, folder))
        python.append(timed(call))
        one.append(timed(lambda: (call(), call())))
        two.append(timed(lambda: in_threads(call, 2)))
    a, b = statistics.median(cpp), statistics.median(python)
    print(f"{file.name}: arrange in C++ {a:.3f} s, of NumPy arrays {b:.3f} s, {100 * (b / a - 1):+.1f} %; arrays of {size:.1f} MB")
    a, b = statistics.median(one), statistics.median(two)
    print(f"{file.name}: two calls one after the other {a:.3f} s, in two threads {b:.3f} s, {a / b:.2f} times as fast")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("files", type=Path, nargs="+")
    options = parser.parse_args()
    build = options.build.resolve()
    sys.path.insert(0, str(build / "python"))
    import terrane
    print(f"load: {' '.join(f'{x:.2f}' for x in os.getloadavg())} on {os.cpu_count()} cores")
    with tempfile.TemporaryDirectory() as folder:
        for file in options.files:
            measure(terrane, build / "cli/terrane", file.resolve(), options.repeats, Path(folder))


if __name__ == "__main__":
    main()
