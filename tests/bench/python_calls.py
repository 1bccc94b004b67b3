#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Measures what calls from Python cost beside the library's own work; --help lists what is to be given.

    python_calls.py --build build/release [--repeats N] [--wall] [--kept] [pair1_68k pair1_680k | FILE...]

For each input, a pair of the paper's surfaces or a file, it prints
(1) `arrange` of NumPy arrays, beside the call of the library itself, terrane_arrange of libterrane_c with surfaces that it has
    already: CPU seconds of the process, one thread, medians of runs in turn, and the medians of the ratios of neighbouring runs.
    The package runs each stage in a thread of its own, and glibc gives that thread another malloc arena than the main
    thread. Therefore the library is called in the main thread and in a new one;
(2) the memory that 1 000 calls of a small input leave behind;
(3) CPU seconds, and with --wall wall seconds, of two calls one after the other and in two Python threads at once.
With --kept the process keeps freed memory, as the program terrane does, so that page faults do not count.
CPU seconds count the same on a machine that others use, wall seconds do not: there (3) needs an idle machine.
"""
import argparse
import ctypes
import gc
import os
import resource
import statistics
import sys
import threading
import time
from pathlib import Path

import numpy as np

PAIRS = {"pair1_7k": (41, 58, 29), "pair1_68k": (130, 184, 92), "pair1_680k": (412, 582, 291)}
PAGE = resource.getpagesize()


def grid(m, n, u, v):
    """Return parameters and triangles of m x n cells, as the paper's models have them."""
    i, j = np.meshgrid(np.arange(m + 1), np.arange(n + 1))
    a = (np.arange(n)[:, None] * (m + 1) + np.arange(m)[None, :]).ravel()
    quads = np.stack([a, a + 1, a + m + 2, a, a + m + 2, a + m + 1], axis=1)
    return (u[0] + (u[1] - u[0]) * i / m).ravel(), (v[0] + (v[1] - v[0]) * j / n).ravel(), quads.reshape(-1, 3).astype(np.uint32)


def pair(terrane, name):
    """Return the pair of section 6 with a localised intersection: arrays of the library's types."""
    horizon, fault_x, fault_z = PAIRS[name]
    x, y, cells = grid(horizon, horizon, (0, 4), (0, 4))
    top = terrane.Surface(np.stack([x, y, 0.1 * np.sin(3 * x) * np.cos(2 * y)], axis=1), cells, "horizon", "horizon")
    x, z, cells = grid(fault_x, fault_z, (0.0123, 3.9871), (-1, 1))
    return [top, terrane.Surface(np.stack([x, 2 + 0.2 * np.sin(2 * x) + 0.3 * z, z], axis=1), cells, "fault", "fault")]


class Library:
    """libterrane_c with a list of surfaces."""

    def __init__(self, path, surfaces):
        self.c = ctypes.CDLL(str(path))
        self.surfaces = ctypes.c_void_p()
        assert self.c.terrane_surfaces_new(ctypes.byref(self.surfaces), None) == 0
        for s in surfaces:
            v, t = np.ascontiguousarray(s.vertices), np.ascontiguousarray(s.triangles, dtype=np.uint32)
            assert self.c.terrane_surfaces_add(
                self.surfaces, s.name.encode(), 0, v.ctypes.data_as(ctypes.c_void_p), ctypes.c_size_t(len(v)),
                t.ctypes.data_as(ctypes.c_void_p), ctypes.c_size_t(len(t)), None) == 0

    def arrange(self):
        """Arrange them with one thread."""
        made = ctypes.c_void_p()
        assert self.c.terrane_arrange(self.surfaces, None, None, ctypes.byref(made), None) == 0
        self.c.terrane_arrangement_free(made)


def timed(work):
    """Return CPU and wall seconds."""
    gc.collect()
    cpu, wall = time.process_time(), time.perf_counter()
    work()
    return time.process_time() - cpu, time.perf_counter() - wall


def in_threads(work, count):
    """Run it in so many Python threads at a time."""
    threads = [threading.Thread(target=work) for _ in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def resident():
    """Return the resident memory in bytes."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * PAGE


def measure(terrane, name, surfaces, library, options):
    """Print the lines of one input."""
    size = sum(s.vertices.nbytes + s.triangles.nbytes for s in surfaces) / 1e6

    def call():
        terrane.arrange(surfaces, threads=1)

    own, threaded, python, one, two = [], [], [], [], []
    for _ in range(options.repeats):
        own.append(timed(library.arrange)[0])
        threaded.append(timed(lambda: in_threads(library.arrange, 1))[0])
        python.append(timed(call)[0])
    print(f"{name}: arrange of NumPy arrays ({size:.1f} MB) {statistics.median(python):.3f} CPU s", flush=True)
    for where, times in (("the main thread", own), ("a new thread", threaded)):
        ratio = statistics.median(p / c for c, p in zip(times, python))
        print(f"{name}: arrange by the library in {where} {statistics.median(times):.3f} CPU s, ratio {ratio:.3f}", flush=True)
    if not options.threads:
        return
    for _ in range(options.repeats):
        one.append(timed(lambda: (call(), call())))
        two.append(timed(lambda: in_threads(call, 2)))
    for k, kind in ((0, "CPU"), (1, "wall"))[:2 if options.wall else 1]:
        a, b = statistics.median(t[k] for t in one), statistics.median(t[k] for t in two)
        print(f"{name}: two calls one after the other {a:.3f} {kind} s, in two threads {b:.3f}, ratio {a / b:.2f}", flush=True)


def growth(terrane, calls=1000):
    """Print how much memory calls leave behind."""
    flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]])
    wall = terrane.Surface([[1, -1, -1], [1, 5, -1], [1, 2, 3]], [[0, 1, 2]])
    for _ in range(calls):
        terrane.arrange([flat, wall], threads=1)
    before = resident()
    for _ in range(calls):
        terrane.arrange([flat, wall], threads=1)
    print(f"{calls} calls of arrange after {calls} others: {(resident() - before) / 1024:.0f} KiB more")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--wall", action="store_true", help="wall seconds of threads, too")
    parser.add_argument("--kept", action="store_true", help="keep freed memory in the process")
    parser.add_argument("--no-threads", dest="threads", action="store_false")
    parser.add_argument("inputs", nargs="*", default=["pair1_68k", "pair1_680k"])
    options = parser.parse_args()
    build = options.build.resolve()
    sys.path.insert(0, str(build / "python"))
    import terrane
    if options.kept:
        terrane.keep_freed_memory()
    print(f"load: {' '.join(f'{x:.2f}' for x in os.getloadavg())} on {os.cpu_count()} cores")
    growth(terrane)
    for name in options.inputs:
        surfaces = pair(terrane, name) if name in PAIRS else terrane.read(name)
        measure(terrane, name, surfaces, Library(build / "capi/libterrane_c.so", surfaces), options)


if __name__ == "__main__":
    main()
