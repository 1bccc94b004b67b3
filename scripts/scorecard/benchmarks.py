#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Times what engines take for Booleans and arrangements of generated solids, and has `terrane judge` judge each result.

    scripts/scorecard/setup.sh
    scripts/scorecard/benchmarks.py --terrane PROGRAM -o table.md

An engine is a command line in engines.json, as for the score card. Engines take turns within each repeat, on one
core. The table has medians of processor seconds of the whole process, files included, and of the operation alone where
the engine tells it, the largest memory of a call, wall-clock seconds on all cores, and what `terrane judge` says of the
result.
"""
import argparse
import json
import math
import os
import pathlib
import platform
import re
import shutil
import signal
import statistics
import subprocess
import tempfile
import time

from scorecard import judged, limited


def ball(divisions, centre, radius, bumps=0.0):
    """A sphere of 20 * 4**divisions triangles; bumps are of so much of the radius."""
    g = (1 + math.sqrt(5)) / 2
    points = [(s * 1.0, t * g, 0.0) for s in (-1, 1) for t in (-1, 1)]
    points += [(0.0, x, y) for x, y, _ in points] + [(y, 0.0, x) for x, y, _ in points]
    near = {(i, j) for i in range(12) for j in range(12) if i != j and math.dist(points[i], points[j]) < 2.1}
    triangles = []
    for i in range(12):
        for j in range(i + 1, 12):
            for k in range(j + 1, 12):
                if {(i, j), (j, k), (i, k)} <= near:
                    a, b, c = points[i], points[j], points[k]
                    u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
                    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
                    triangles.append((i, j, k) if sum(x * y for x, y in zip(n, a)) > 0 else (i, k, j))
    for _ in range(divisions):
        middles, finer = {}, []

        def middle(i, j):
            key = (min(i, j), max(i, j))
            if key not in middles:
                middles[key] = len(points)
                points.append(tuple((x + y) / 2 for x, y in zip(points[i], points[j])))
            return middles[key]
        for i, j, k in triangles:
            a, b, c = middle(i, j), middle(j, k), middle(k, i)
            finer += [(i, a, c), (a, j, b), (c, b, k), (a, b, c)]
        triangles = finer
    placed = []
    for p in points:
        size = math.hypot(*p)
        x, y, z = (q / size for q in p)
        r = radius * (1 + bumps * math.sin(9 * x + 1) * math.sin(8 * y + 2) * math.sin(7 * z + 3))
        placed.append(tuple(single(c + r * q) for c, q in zip(centre, (x, y, z))))
    return placed, triangles


def cylinder(facets, axis, half, radius):
    """A cylinder through the origin along an axis, with long facets and fans for ends."""
    points, triangles = [], []
    for end in (-half, half):
        for k in range(facets):
            a = 2 * math.pi * k / facets
            points.append([radius * math.cos(a), radius * math.sin(a), end])
    points += [[0.0, 0.0, -half], [0.0, 0.0, half]]
    for k in range(facets):
        m = (k + 1) % facets
        triangles += [(k, m, facets + m), (k, facets + m, facets + k), (2 * facets, m, k),
                      (2 * facets + 1, facets + k, facets + m)]
    turned = [[p[(i - axis - 1) % 3] for i in range(3)] for p in points]
    return [tuple(map(single, p)) for p in turned], triangles


def torus(along, around, centre, turn):
    """A torus of 2 * along * around triangles, turned about x."""
    points, triangles = [], []
    c, s = math.cos(turn), math.sin(turn)
    for i in range(along):
        u = 2 * math.pi * i / along
        for j in range(around):
            v = 2 * math.pi * j / around
            x, y, z = (3 + math.cos(v)) * math.cos(u), (3 + math.cos(v)) * math.sin(u), math.sin(v)
            points.append(tuple(single(q) for q in (centre[0] + x, centre[1] + c * y - s * z, centre[2] + s * y + c * z)))
            a, b = i * around + j, i * around + (j + 1) % around
            d, e = (i + 1) % along * around + j, (i + 1) % along * around + (j + 1) % around
            triangles += [(a, d, e), (a, e, b)]
    return points, triangles


def single(x):
    """A number that single precision holds, as some engines have no other."""
    return round(x * 2**18) / 2**18 if abs(x) < 32 else float(round(x))


def rows():
    """The inputs: a name, solids, and operations."""
    both = ("arrangement", "union", "difference")
    yield "two balls of 20 480 triangles", [ball(5, (0, 0, 0), 1), ball(5, (0.5, 0.25, 0.125), 1)], both
    yield "two bumpy bodies of 81 920 triangles", [ball(6, (0, 0, 0), 1, 0.2), ball(6, (0.5, 0.25, 0.125), 1, 0.2)], both
    yield "two cylinders of 800 facets", [cylinder(800, 2, 4, 1), cylinder(800, 0, 4, 0.875)], both
    yield ("ten tori of 1 600 triangles",
           [torus(40, 20, (0.37 * k, 0.21 * k, 0.13 * k), 0.3 * k) for k in range(10)], ("arrangement", "union"))


def write(path, solid):
    points, triangles = solid
    lines = [f"OFF\n{len(points)} {len(triangles)} 0", *(" ".join(map(repr, p)) for p in points),
             *(f"3 {a} {b} {c}" for a, b, c in triangles)]
    path.write_text("\n".join(lines) + "\n")


def measured(command, seconds, environment, cores):
    """Status (None: too slow), what it printed, processor seconds, wall-clock seconds and MB of a call."""
    with tempfile.TemporaryFile("w+", errors="replace") as said:
        begin = time.monotonic()
        process = subprocess.Popen(command, stdout=said, stderr=subprocess.STDOUT, start_new_session=True, env=environment,
                                   preexec_fn=lambda: os.sched_setaffinity(0, cores))
        status = None
        while True:
            pid, code, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                status = process.returncode = os.waitstatus_to_exitcode(code)
                break
            if time.monotonic() - begin > seconds:
                os.killpg(process.pid, signal.SIGKILL)
                _, _, usage = os.wait4(process.pid, 0)
                process.returncode = -signal.SIGKILL
                break
            time.sleep(0.002)
        wall = time.monotonic() - begin
        said.seek(0)
        return status, said.read(), usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss / 1024


class Benchmark:
    def __init__(self, arguments):
        self.arguments = arguments
        self.here = arguments.engines.resolve().parent
        engines = json.loads(arguments.engines.read_text())
        self.engines = [e for e in engines if not arguments.only or e["name"] in arguments.only]
        for engine in self.engines[:]:
            program = engine["command"][0].replace("{here}", str(self.here)).replace("{terrane}", arguments.terrane)
            if not shutil.which(program):
                print(f"{engine['name']} is left out: {program} was not found")
                self.engines.remove(engine)

    def command(self, engine, operation, output, inputs):
        values = {"{here}": str(self.here), "{operation}": operation, "{output}": str(output), "{terrane}": self.arguments.terrane}
        made = []
        for word in engine["command"]:
            for key, value in values.items():
                word = word.replace(key, value)
            made += inputs if word == "{inputs}" else [word]
        return made, os.environ | {"SCORECARD": "\n".join([operation, str(output), *inputs])}

    def verdict(self, engine, operation, output, inputs):
        words = [] if operation == "arrangement" else ["--operation", operation]
        status, text = limited([self.arguments.terrane, "judge", str(output), *inputs, *words, "--json",
                                "--spacings", str(engine.get("spacings", 16))], 1200, 0)
        found = judged([json.loads(line) for line in text.splitlines() if line.startswith("{")])
        return "not judged in time" if status is None else found["end"] + (": " + ", ".join(found["fails"]) if found["fails"] else "")

    def row(self, name, solids, operation):
        """Lines of a table, fastest first."""
        engines = [e for e in self.engines if operation in e["operations"]]
        with tempfile.TemporaryDirectory() as folder:
            work = pathlib.Path(folder)
            inputs = []
            for k, solid in enumerate(solids):
                write(work / f"solid{k}.off", solid)
                inputs.append(str(work / f"solid{k}.off"))
            calls = {e["name"]: [] for e in engines}
            walls = {e["name"]: [] for e in engines}
            ends = {}
            first, every = {min(os.sched_getaffinity(0))}, os.sched_getaffinity(0)
            for repeat in range(self.arguments.repeats):
                for engine in engines:
                    if engine["name"] in ends:
                        continue
                    output = work / f"{engines.index(engine)}.off"
                    command, environment = self.command(engine, operation, output, inputs)
                    status, said, cpu, _, megabytes = measured(command, self.arguments.seconds, environment, first)
                    if status != 0 or not output.exists():
                        ends[engine["name"]] = "too slow" if status is None else "crashed" if status < 0 or status >= 128 else "refused"
                        continue
                    alone = re.search(r"^operation: ([0-9.e-]+) s$", said, re.M)
                    calls[engine["name"]].append((cpu, float(alone[1]) if alone else math.nan, megabytes))
                    walls[engine["name"]].append(measured(command, self.arguments.seconds, environment, every)[3])
            lines = []
            for engine in engines:
                called = engine["name"]
                if called in ends:
                    lines.append((math.inf, [called, "", "", "", "", ends[called]]))
                    continue
                cpu, alone, megabytes = map(statistics.median, zip(*calls[called]))
                verdict = self.verdict(engine, operation, work / f"{engines.index(engine)}.off", inputs)
                lines.append((cpu, [called, f"{cpu:.2f}", "" if math.isnan(alone) else f"{alone:.2f}",
                                    f"{statistics.median(walls[called]):.2f}", f"{megabytes:.0f}", verdict]))
            return [line for _, line in sorted(lines, key=lambda line: line[0])]

    def run(self):
        text = []
        for name, solids, operations in rows():
            for operation in operations:
                head = ["Engine", "Processor s", "of the operation", "All cores, wall-clock s", "MB", "Judged"]
                lines = [head, ["---"] * len(head), *self.row(name, solids, operation)]
                text += [f"### {operation.capitalize()} of {name}", "", *("| " + " | ".join(line) + " |" for line in lines), ""]
                print("\n".join(text[-len(lines) - 3:]), flush=True)
        return "\n".join(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--engines", type=pathlib.Path, default=pathlib.Path(__file__).with_name("engines.json"))
    parser.add_argument("--terrane", default="terrane", help="the program that is timed, and that judges")
    parser.add_argument("--only", action="append", metavar="ENGINE", help="this engine alone; may be repeated")
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--seconds", type=float, default=60, help="limit of time of a call")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help="file for the tables, in Markdown")
    arguments = parser.parse_args()
    arguments.terrane = os.path.abspath(arguments.terrane) if os.path.sep in arguments.terrane else arguments.terrane
    machine = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), "")
    print(f"{platform.platform()}, {machine}, {len(os.sched_getaffinity(0))} cores\n")
    arguments.output.write_text(Benchmark(arguments).run())


if __name__ == "__main__":
    main()
