#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Models of very many surfaces and blocks, of which the blocks and their volumes are known in closed form.

Each model is made at two sizes, n and 4 n. The program must find the blocks and their volume, and write at most so much
more as there is more to write. Once it does so with `volume` for each model, and with `arrange` and `report` in turn. With
--seconds it does this for so long with all, and judges the processor time as well: it may grow as n log n. With --bench it prints a table of processor seconds for 10 000 and 100 000 surfaces, and fails where
the exponent between them is above 1.1.
"""
import argparse
import json
import math
import os
import pathlib
import random
import resource
import subprocess
import sys
import tempfile
import time

LARGEST_EXPONENT = 1.1
MOST_BYTES = 5.5  # times as much is written for 4 n as for n
MOST_SECONDS = 7  # times as much processor time for 4 n as for n
WORTH_JUDGING = 1  # processor seconds: less is noise


class Model:
    """A file of surfaces, and what must be found in it."""

    def __init__(self):
        self.vertices, self.surfaces = [], []
        self.blocks, self.volume = 0, 0

    def add(self, name, corners, triangles):
        """Adds a surface; triangles count its own corners from 0."""
        self.surfaces.append((name, len(self.vertices), triangles))
        self.vertices += corners

    def write(self, folder, rng):
        """Writes the file, with axes in any order, sizes times a power of two, and surfaces in any order; returns its name."""
        axes = rng.sample(range(3), 3)
        scale = 2.0 ** rng.randint(-8, 8)
        self.volume *= scale**3
        self.surfaces = rng.sample(self.surfaces, len(self.surfaces))
        places = [" ".join(repr(v[a] * scale) for a in axes) for v in self.vertices]
        names = {name for name, _, _ in self.surfaces}
        is_obj = len(names) == len(self.surfaces) and rng.random() < 0.5  # OBJ makes one surface of equal names
        name, lines = ("in.obj", self.obj(places)) if is_obj else ("in.ts", self.gocad(places))
        (folder / name).write_text("\n".join(lines) + "\n")
        return name

    def obj(self, places):
        lines = ["v " + place for place in places]
        for name, first, triangles in self.surfaces:
            lines.append("o " + name)
            lines += ["f " + " ".join(str(first + c + 1) for c in t) for t in triangles]
        return lines

    def gocad(self, places):
        lines = []
        for name, first, triangles in self.surfaces:
            lines += ["GOCAD TSurf 1", "HEADER {", "name:" + name, "}", "TFACE"]
            corners = sorted({c for t in triangles for c in t})
            lines += [f"VRTX {c + 1} {places[first + c]}" for c in corners]
            lines += ["TRGL " + " ".join(str(c + 1) for c in t) for t in triangles] + ["END"]
        return lines


def square(model, name, corners):
    model.add(name, corners, [(0, 1, 2), (0, 2, 3)])


def box(model, name, low, high, lid=True):
    corners = [tuple((low, high)[k >> a & 1][a] for a in range(3)) for k in range(8)]
    faces = [(0, 1, 3, 2), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)] + [(4, 5, 7, 6)] * lid
    model.add(name, corners, [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))])


def apart(n, rng, name="s{}", step=None):
    """Surfaces of one triangle that do not meet, in a plane."""
    model, side, step = Model(), math.isqrt(n) + 1, step or rng.choice((2, 3, 50))
    for i in range(n):
        x, y = step * (i % side), step * (i // side)
        model.add(name.format(i), [(x, y, 0), (x + 1, y, 0), (x, y + 1, 1)], [(0, 1, 2)])
    return model


def in_a_row(n, rng):
    model = Model()
    for i in range(n):
        model.add(f"s{i}", [(2 * i, 0, 0), (2 * i, 1, 0), (2 * i + 1, 0, 1)], [(0, 1, 2)])
    return model


def names_alike(n, rng):
    return apart(n, rng, "same name")


def long_names(n, rng):
    return apart(n // 8 + 1, rng, "long" * rng.choice((100, 300)) + " {}")


def solids(n, rng):
    """Boxes that do not meet."""
    model, side = Model(), round(n ** (1 / 3)) + 1
    for i in range(n):
        low = [9 * c for c in (i % side, i // side % side, i // side**2)]
        size = [rng.randint(1, 8) for _ in range(3)]
        box(model, rng.choice((f"b{i}", "b")), low, [a + b for a, b in zip(low, size)])
        model.blocks += 1
        model.volume += math.prod(size)
    return model


def nested(n, rng):
    """Boxes in boxes."""
    model = Model()
    for i in range(n):
        box(model, f"shell {i}", [-i - 1] * 3, [i + 1] * 3)
    model.blocks, model.volume = n, (2 * n) ** 3
    return model


def shells_in_shells(n, rng):
    """Groups of boxes in boxes, side by side, all in one."""
    model, depth = Model(), 8
    groups = n // depth + 1
    for g in range(groups):
        for i in range(depth):
            box(model, "shell", [2 * depth * g - i, -i, -i], [2 * depth * g + i + 1, i + 1, i + 1])
    size = [2 * depth * (groups + 1), 4 * depth, 4 * depth]
    box(model, "all", [-depth - 8, -2 * depth, -2 * depth], [size[0] - depth - 8, 2 * depth, 2 * depth])
    model.blocks, model.volume = groups * depth + 1, math.prod(size)
    return model


def open_bowls(n, rng):
    """Boxes without lid, each in the next."""
    model = Model()
    for i in range(n // 4 + 1):
        box(model, f"bowl {i}", [-i - 1, -i - 1, -i - 1], [i + 1, i + 1, 0], lid=False)
    return model


def stacked(n, rng):
    """Horizons that divide a box into layers."""
    model = Model()
    box(model, "box", (0, 0, 0), (n + 1, n + 1, n + 1))
    for i in range(1, n + 1):
        square(model, f"horizon {i}", [(0, 0, i), (n + 1, 0, i), (n + 1, n + 1, i), (0, n + 1, i)])
    model.blocks, model.volume = n + 1, (n + 1) ** 3
    return model


def planes(n, rng):
    """Planes that divide a cube into about n boxes."""
    model, k = Model(), max(1, round(n ** (1 / 3)))
    for axis in range(3):
        for i in range(k + 1):
            square(model, f"p{axis} {i}", [tuple([*(p[:axis]), i, *(p[axis:])]) for p in ((0, 0), (k, 0), (k, k), (0, k))])
    model.blocks, model.volume = k**3, k**3
    return model


def fan(n, rng):
    """Triangles round a common corner."""
    model = Model()
    for i in range(n):
        model.add(f"s{i}", [(0, 0, 0), (4 * i + 1, n, 4), (4 * i + 3, n, 4)], [(0, 1, 2)])
    return model


# The trees of the search for pairs take more than n log n where very many boxes are each in the next. Judging leaks tries
# to close the gap between each two borders that meet in a point.
FEWER = {nested: 8, open_bowls: 8, fan: 16}
NOT_TIMED = {nested, open_bowls, fan}
FAMILIES = [apart, in_a_row, names_alike, long_names, solids, nested, shells_in_shells, open_bowls, stacked, planes, fan]


def run(terrane, folder, command):
    """Runs a command; returns its processor seconds, its statistics and the bytes that it wrote."""
    for old in folder.glob("out*"):
        subprocess.run(["rm", "-r", old], check=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([terrane, *command, "--threads", "1", "--stats", "s.json"], cwd=folder, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(command)} in {folder}: status {done.returncode}\n{done.stderr[-3000:]}")
    written = sum(f.stat().st_size for out in folder.glob("out*") for f in [out, *out.rglob("*")] if f.is_file())
    statistics = json.loads((folder / "s.json").read_text())
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, statistics, written + len(done.stderr) + len(done.stdout)


COMMANDS = {"arrange": "out.vtp", "volume": "out", "report": "out.html"}


def judge_result(name, model, statistics, folder):
    wanted = {"surfaces": len(model.surfaces)}
    found = {"surfaces": statistics["input"]["surfaces"]}
    if name != "arrange":
        wanted |= {"blocks": model.blocks, "volume": model.volume}
        found |= {"blocks": len(statistics["volumes"]["blocks"]), "volume": statistics["volumes"]["all"]}
        blocks = math.fsum(statistics["volumes"]["blocks"])
        if not math.isclose(blocks, model.volume, rel_tol=1e-12):
            return f"the blocks together have the volume {blocks}, not {model.volume}"
    if name == "volume":
        listed = json.loads((folder / "out/model.json").read_text())
        wanted["listed"], found["listed"] = model.blocks, len(listed["blocks"]) - 1
        parts = model.blocks + len(listed["interfaces"])
        wanted["files"] = 5 if parts > 1000 else 3 + parts
        found["files"] = sum(f.is_file() for f in (folder / "out").rglob("*"))
    return "" if wanted == found else f"{found}, not {wanted}"


def measure(terrane, family, n, seed, name):
    rng = random.Random(f"{family.__name__} {seed}")
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        model = family(n, rng)
        seconds, statistics, written = run(terrane, folder, [name, model.write(folder, rng), "-o", COMMANDS[name]])
        if flaw := judge_result(name, model, statistics, folder):
            raise SystemExit(f"{family.__name__} {n} {seed}, {name}: {flaw}")
        return seconds, written


def judge_growth(terrane, family, n, seed, name, timed):
    small, large = (measure(terrane, family, k, seed, name) for k in (n, 4 * n))
    where = f"{family.__name__} {n} {seed}, {name}"
    if large[1] > MOST_BYTES * small[1] + 100_000:
        raise SystemExit(f"{where}: {small[1]} bytes, and {large[1]} for four times as many")
    tries = 0
    timed = timed and family not in NOT_TIMED
    while timed and large[0] > WORTH_JUDGING and large[0] > MOST_SECONDS * small[0]:
        tries += 1
        if tries == 3:
            raise SystemExit(f"{where}: {small[0]:.2f} processor seconds, and {large[0]:.2f} for four times as many")
        small, large = (measure(terrane, family, k, seed, name) for k in (n, 4 * n))
    return f"{where}: {small[0]:.2f} s, {large[0]:.2f} s; {small[1]} bytes, {large[1]}"


def bench(terrane):
    """Prints the table, and returns whether all exponents are small enough."""
    good = True
    print(f"{'surfaces':12}{'command':10}{'10 000':>10}{'100 000':>10}  exponent")
    for family in (in_a_row, solids):
        for name in COMMANDS:
            small, large = (min(measure(terrane, family, n, 1, name)[0] for _ in range(2)) for n in (10_000, 100_000))
            exponent = math.log10(large / small)
            good = good and exponent <= LARGEST_EXPONENT
            print(f"{family.__name__:12}{name:10}{small:8.2f} s{large:8.2f} s  {exponent:.2f}", flush=True)
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--terrane", required=True, type=os.path.abspath)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=0, help="go on for so long, with larger models, and judge times")
    parser.add_argument("--bench", action="store_true")
    arguments = parser.parse_args()
    if arguments.bench:
        return 0 if bench(arguments.terrane) else 1
    end, seed = time.monotonic() + arguments.seconds, arguments.seed
    while True:
        for number, family in enumerate(FAMILIES):
            least, most = (500, 8000 // FEWER.get(family, 1)) if arguments.seconds else (60, 300)
            n = random.Random(f"{family.__name__} {seed} n").randint(least, most)
            for name in COMMANDS if arguments.seconds else ("volume", ("arrange", "report")[number % 2]):
                said = judge_growth(arguments.terrane, family, n, seed, name, arguments.seconds > 0)
                if arguments.seconds:
                    print(said, flush=True)
        seed += 1
        if time.monotonic() >= end:
            return 0


if __name__ == "__main__":
    sys.exit(main())
