#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Improves random and real models with `terrane improve`, and judges the results by what is promised.

    tests/oracles/improved.py --terrane build/release/cli/terrane [--count 300] [--seed 1] [--keep FOLDER] [--real FOLDER]

The models have two to five horizons (waves, domes, planes) with thin blocks between some of them, faults, and side walls that
close blocks; some are far from the origin, some are horizons alone, of good triangles. With --real, every third model is a
triple of surface files found below FOLDER. Lengths, deviations and angles vary.

volume   The volumes that the program states before and after are those of the blocks that block_volumes.py finds in the files
         that `terrane arrange` and `terrane improve` wrote, exactly; blocks correspond by the regions around them. A block
         changes by more than the limit only with a warning, and there is none otherwise. With --strict, such a model has
         status 1 and no file.
worst q  The least q = 2 r / R of the written triangles, computed here, is not below that of `terrane arrange`.
distance No sampled point of a surface is farther from it as it was than the stated bound, or than the measured distance by
         more than 5 %, and the reverse.
cause    Where no operation is said to help the worst triangle, no collapse of an edge at it does.
proof    With --verify, `terrane verify` accepts the certificate.
order    The files in another order, with their triangles in another order and their vertices renumbered, give the same
         triangles.

Prints one line for each model that breaks a promise, and a summary. Status 1 if any does.
"""
import argparse
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

import numpy

import better_collapse
import block_volumes
import point_distances

FORMATS = {".ts", ".obj", ".off", ".ply", ".stl"}


def grid(columns, rows, at):
    vertices = [at(i / columns, j / rows) for i in range(columns + 1) for j in range(rows + 1)]
    triangles = []
    for i in range(columns):
        for j in range(rows):
            a = i * (rows + 1) + j
            b, c, d = a + rows + 1, a + rows + 2, a + 1
            triangles += [(a, b, c), (a, c, d)]
    return vertices, triangles


def random_model(rng):
    """Files of a model: name -> (vertices, triangles)."""
    size = rng.choice([1., 1000., 50000.])
    heights = []
    level = 0.
    waves = [(rng.uniform(1, 6), rng.uniform(0, 6), rng.uniform(1, 6), rng.uniform(0, 6)) for _ in range(3)]
    bend = rng.choice([0., .02, .1]) * size

    def shape(u, v):
        return sum(bend * math.sin(a * u + b) * math.cos(c * v + d) for a, b, c, d in waves)

    for _ in range(rng.randint(2, 5)):
        heights.append(level)
        level -= rng.choice([.0001, .001, .01, .1, .3]) * size
    files = {}
    n = rng.randint(3, 14)
    for k, z in enumerate(heights):
        own = rng.choice([0., 0., .05]) * size
        m = n if rng.random() < .5 else rng.randint(3, 14)  # other numbers make neighbours cross
        files[f"h{k}"] = grid(m, rng.randint(3, 14) if m != n else n,
                              lambda u, v, z=z, own=own: (u * size, v * size, z + shape(u, v) + own * math.sin(5 * u)))
    top, base = bend * 4 + .1 * size, heights[-1] - bend * 4 - .1 * size
    for k in range(rng.randint(0, 2)):
        x, lean = rng.uniform(.2, .8) * size, rng.uniform(-.4, .4) * size
        files[f"f{k}"] = grid(rng.randint(1, 4), rng.randint(1, 6), lambda u, v, x=x, lean=lean: (
            x + lean * (u - .5), v * size * 1.1 - .05 * size, base + u * (top - base)))
    if rng.random() < .7:
        low, high = .05 * size, .95 * size
        corners = [(low, low), (high, low), (high, high), (low, high)]
        for k in range(4):
            (x, y), (p, q) = corners[k], corners[(k + 1) % 4]
            files[f"w{k}"] = grid(1, 1, lambda u, v, x=x, y=y, p=p, q=q: (
                x + u * (p - x), y + u * (q - y), base + v * (top - base)))
    return files, size


def changed_model(rng, files, size):
    """Some of the models are only horizons that do not cross, whose triangles are all good; others are far from the origin."""
    kind = rng.random()
    if kind < .15:
        columns, rows = rng.randint(6, 20), rng.randint(6, 20)
        bend = rng.choice([0., .02, .1])
        return {f"h{k}": grid(columns, rows, lambda u, v, k=k: (u, v, bend * math.sin(5 * u + k) * math.cos(4 * v) - .3 * k))
                for k in range(rng.randint(1, 2))}, 1.
    if kind < .3:
        shift = (431000.25 * size, 1412000.5 * size, -1500. * size)
        return {name: ([tuple(x + y for x, y in zip(v, shift)) for v in vertices], triangles)
                for name, (vertices, triangles) in files.items()}, None
    return files, None


def write_obj(path, name, surface):
    vertices, triangles = surface
    lines = [f"g {name}"] + [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices]
    lines += ["f " + " ".join(str(i + 1) for i in t) for t in triangles]
    path.write_text("\n".join(lines) + "\n")


def read_obj(path):
    """Vertices, triangles, and per triangle the names of the surfaces that it is in."""
    vertices, triangles, names, now = [], [], [], ()
    for line in open(path, encoding="ascii"):
        words = line.split()
        if words and words[0] == "v":
            vertices.append(tuple(float(x) for x in words[1:4]))
        elif words and words[0] in "go":
            now = tuple(words[1:])
        elif words and words[0] == "f":
            triangles.append(tuple(int(w.split("/")[0]) - 1 for w in words[1:4]))
            names.append(now)
    return vertices, triangles, names


def places(mesh):
    return [tuple(sorted(mesh[0][i] for i in t)) for t in mesh[1]]


def quality(t):
    a, b, c = sorted(math.dist(t[i], t[(i + 1) % 3]) for i in range(3))
    u, v = ([t[k][i] - t[0][i] for i in range(3)] for k in (1, 2))
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    size = a * b * c * (a + b + c)
    return 4 * sum(x * x for x in n) / size if size > 0 else 0.


def run(*command):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)


def model_files(rng, folder, real):
    if real and rng.random() < 1 / 3:
        chosen = rng.sample(real, min(len(real), rng.randint(1, 3)))
        return [str(p) for p in chosen], None
    files, size = random_model(rng)
    files, other = changed_model(random.Random(rng.random()), files, size)
    size = other or size
    paths = []
    for name, surface in files.items():
        path = folder / f"{name}.obj"
        write_obj(path, name, surface)
        paths.append(str(path))
    return paths, size


def other_files(paths, folder, rng):
    """The files in another order, those of ours with vertices and triangles in another order."""
    other = folder / "other"
    other.mkdir()
    out = []
    for path in reversed(paths):
        if pathlib.Path(path).parent != folder:
            out.append(path)
            continue
        vertices, triangles, names = read_obj(path)
        order = list(range(len(vertices)))
        rng.shuffle(order)
        number = {v: i for i, v in enumerate(order)}
        rng.shuffle(triangles)
        turned = [tuple(number[v] for v in t[k:] + t[:k]) for t in triangles for k in [rng.randrange(3)]]
        target = other / pathlib.Path(path).name
        write_obj(target, names[0][0], ([vertices[v] for v in order], turned))
        out.append(str(target))
    return out


def lists(node):
    return [tuple(x) for x in node]


def labels_before(certificate):
    """Per triangle of the mesh before: its surfaces, each with its region."""
    surface_of = []
    for s, count in enumerate(s["triangles"] for f in certificate["inputs"] for s in f["surfaces"]):
        surface_of += [s] * count
    rounded = certificate["rounded"]
    return [tuple(zip(sorted({surface_of[p] for p in parents}), regions))
            for parents, regions in zip(rounded["parents"], rounded["regions"])]


def labels_after(certificate):
    return [tuple(zip(s, r)) for s, r in zip(certificate["improved"]["surfaces"], certificate["improved"]["regions"])]


def labelled_blocks(section, labels):
    """The exact volume of each block by what is around it: its labels, with the side on which it is if that is one."""
    vertices = [tuple(float(x) for x in v) for v in section["vertices"]]
    triangles = lists(section["triangles"])
    found = {}
    for volume, sides in block_volumes.blocks(vertices, triangles):
        around = frozenset((labels[s // 2], s % 2) for s in sides)
        found.setdefault(around, []).append(volume)
    return vertices, triangles, found


def volume_flaws(folder, stats, made, limit):
    """Judges the volumes; returns the flaws and the largest true change in percent."""
    certificate = json.loads((folder / "c.json").read_text())
    flaws, pairs = [], []
    sections = []
    for name, section, labels in (("plain.obj", "rounded", labels_before), ("out.obj", "improved", labels_after)):
        vertices, triangles, found = labelled_blocks(certificate[section], labels(certificate))
        if sorted(places((vertices, triangles))) != sorted(places(read_obj(folder / name))):
            flaws.append(f"{name} is not the mesh of the certificate")
        sections.append(found)
    before, after = sections
    if before.keys() != after.keys() or any(len(before[k]) != len(after[k]) for k in before):
        return flaws + ["blocks have other regions around them than before"], 0.
    for key, volumes in before.items():
        pairs += [(float(x), float(y)) for x, y in zip(sorted(volumes), sorted(after[key]))]
    stated = [(b["volume_before"], b["volume_after"]) for b in stats["improve"]["blocks"]]
    if len(pairs) != len(stated) or any(abs(x - y) > 1e-12 * abs(y) for p, q in zip(sorted(stated), sorted(pairs))
                                        for x, y in zip(p, q)):
        flaws.append(f"volumes stated {sorted(stated)[:3]}, found {sorted(pairs)[:3]}")
    for b in stats["improve"]["blocks"]:
        if abs(b["change_percent"] - 100 * abs(b["volume_after"] / b["volume_before"] - 1)) > 1e-9:
            flaws.append(f"block {b['block']} states a change of {b['change_percent']} %")
    largest = max([100 * abs(y / x - 1) for x, y in pairs], default=0.)
    if (largest > limit) != ("the volume of a block changed" in made.stderr):
        flaws.append(f"the largest change is {largest:.3g} %, and the program says: {made.stderr.strip()}")
    return flaws, largest


def cause_flaws(folder, stats):
    """Where no operation is said to help the worst triangle, no simple collapse does."""
    if stats["improve"]["worst_cause"] != "no operation helps":
        return []
    improved = json.loads((folder / "c.json").read_text())["improved"]
    vertices = [tuple(float(x) for x in v) for v in improved["vertices"]]
    triangles = lists(improved["triangles"])
    worst = min(range(len(triangles)), key=lambda t: quality([vertices[v] for v in triangles[t]]))
    labels = list(zip(map(tuple, improved["surfaces"]), map(tuple, improved["regions"])))
    found = better_collapse.find((vertices, triangles), labels, improved["intersection_edges"], worst, quality)
    return [f"no operation helps triangle {worst}, but a collapse of vertices {found} does"] if found else []


def spread(corners, count):
    """count * (count + 1) / 2 points of a triangle."""
    a, b, c = (numpy.array(p) for p in corners)
    n = count - 1
    return numpy.array([a + (b - a) * i / n + (c - a) * j / n for i in range(count) for j in range(count - i)])


def farthest(source, target, rng):
    """A lower bound of the largest distance of points of the triangles from the others: samples, then finer ones."""
    def distances(points):
        return numpy.concatenate([point_distances.to_triangles(points[i:i + 256], target)
                                  for i in range(0, len(points), 256)])
    some = source if len(source) <= 400 else rng.sample(source, 400)
    samples = numpy.concatenate([spread(t, 3) for t in some])
    largest = distances(samples).reshape(len(some), -1).max(axis=1)
    best = [some[i] for i in numpy.argsort(-largest)[:12]]
    return max(largest.max(), distances(numpy.concatenate([spread(t, 12) for t in best])).max())


def distance_flaws(folder, stats, rng):
    """Judges one surface in both directions."""
    before, after = (read_obj(folder / name) for name in ("plain.obj", "out.obj"))
    deviation = stats["deviation"]
    measured = deviation["measured_of_surfaces"]
    certificate = json.loads((folder / "c.json").read_text())
    names = [s["name"] for f in certificate["inputs"] for s in f["surfaces"]]
    at = max(range(len(names)), key=lambda s: measured[s] + deviation["measured_back"][s])
    if names.count(names[at]) > 1:
        return []
    old, new = ([[m[0][i] for i in t] for t, n in zip(m[1], m[2]) if names[at] in n] for m in (before, after))
    flaws = []
    rounding = 1e-13 * max(abs(x) for v in before[0] for x in v)
    for way, source, target, most in (("out", new, old, measured[at]), ("back", old, new, deviation["measured_back"][at])):
        true = farthest(source, target, rng)
        if true > deviation["bound_of_surfaces"][at] + rounding or .95 * true > most + rounding:
            flaws.append(f"{names[at]} is {true:.4g} away ({way}), measured {most:.4g}, "
                         f"bound {deviation['bound_of_surfaces'][at]:.4g}")
    return flaws


def model_options(rng, size):
    options = []
    if size:
        length = size * rng.choice([.05, .1, .2])
        options += ["--edge-length", repr(length)]
        if rng.random() < .4:
            options += ["--max-deviation", repr(length * rng.choice([.001, .02, .2]))]
        if rng.random() < .3:
            options += ["--turn", repr(rng.uniform(10, 30))]
    return options


def keep_model(target, paths, options):
    target.mkdir(parents=True, exist_ok=True)
    for path in paths:
        (target / pathlib.Path(path).name).write_bytes(pathlib.Path(path).read_bytes())
    (target / "options.txt").write_text(" ".join(options) + "\n")


def strict_flaws(terrane, paths, folder, options, changed):
    """With --strict, a change beyond the limit has status 1 and no file."""
    made = run(terrane, "improve", *paths, "-o", folder / "strict.obj", "--strict", *options)
    if made.returncode == 2 and "warning" in made.stderr:
        return []  # about the inputs
    if (made.returncode, (folder / "strict.obj").exists()) != ((1, False) if changed else (0, True)):
        return [f"--strict: status {made.returncode}"]
    return []


def judge(arguments, seed, real):
    terrane, limit = arguments.terrane, arguments.limit
    rng = random.Random(seed)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        paths, size = model_files(rng, folder, real)
        options = model_options(rng, size) + ["--max-volume-change", repr(limit)]
        plain = run(terrane, "arrange", *paths, "-o", folder / "plain.obj")
        made = run(terrane, "improve", *paths, "-o", folder / "out.obj", "--stats", folder / "s.json",
                   "--certificate", folder / "c.json", *options)
        if made.returncode == 2 and "is too small for coordinates" in made.stderr + made.stdout:
            return "refused", []
        if made.returncode == 1 and not (folder / "out.obj").exists():
            return "not written", []
        if made.returncode != 0 or plain.returncode != 0:
            return "failed", [f"status {made.returncode}: {made.stderr.strip()[-200:]}"]
        stats = json.loads((folder / "s.json").read_text())
        flaws, largest = volume_flaws(folder, stats, made, limit)
        flaws += distance_flaws(folder, stats, rng) + cause_flaws(folder, stats)
        if largest > limit or rng.random() < .1:
            flaws += strict_flaws(terrane, paths, folder, options, largest > limit)
        # How far rounding moved vertices before is the arrangement's matter.
        verified = run(terrane, "verify", folder / "c.json", "--max-deviation", "1e9") if arguments.verify else None
        if verified and verified.returncode != 0:
            flaws.append(f"its certificate: status {verified.returncode}: {verified.stdout.strip()[-200:]}")
        now = places(read_obj(folder / "out.obj"))
        first, last = min(map(quality, places(read_obj(folder / "plain.obj")))), min(map(quality, now))
        if last < first * (1 - 1e-9) - 1e-14:
            flaws.append(f"worst q {first:.3g} -> {last:.3g}")
        other = run(terrane, "improve", *other_files(paths, folder, rng), "-o", folder / "other.obj", *options)
        if other.returncode != 0 or sorted(places(read_obj(folder / "other.obj"))) != sorted(now):
            flaws.append("another order of files gives another geometry")
        if flaws and arguments.keep:
            keep_model(pathlib.Path(arguments.keep) / f"model{seed}", paths, options)
        return (f"{'beyond' if largest > limit else 'within'} the limit; largest change {largest:.3g} %, "
                f"q {first:.3g} -> {last:.3g}: {stats['improve']['worst_cause']}"), flaws


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--terrane", required=True, help="the program")
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1, help="of the first model; the others follow")
    parser.add_argument("--real", help="folder with surface files of 200 kB at most")
    parser.add_argument("--limit", type=float, default=5., help="largest change of a volume, in percent")
    parser.add_argument("--keep", help="folder for the models that break a promise")
    parser.add_argument("--verify", action="store_true", help="judge certificates as well, which takes minutes each")
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    real = sorted(p for p in pathlib.Path(options.real).rglob("*")
                  if p.suffix in FORMATS and p.stat().st_size < 200000) if options.real else []
    broken, outcomes = 0, {}
    for seed in range(options.seed, options.seed + options.count):
        outcome, flaws = judge(options, seed, real)
        kind = outcome.split(";")[0]
        outcomes[kind] = outcomes.get(kind, 0) + 1
        broken += bool(flaws)
        if flaws or options.verbose:
            print(f"model {seed}: {outcome}; {'; '.join(flaws) or 'holds'}", flush=True)
    print(f"{options.count} models, {broken} break a promise; outcomes: {outcomes}")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
