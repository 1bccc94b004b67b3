#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Improves random and real models with `terrane improve`, and judges the results by what is promised.

    tests/oracles/improved.py --terrane build/release/cli/terrane [--count 300] [--seed 1] [--keep FOLDER] [--real FOLDER]

The models have two to five horizons (waves, domes, planes) with thin blocks between some of them, faults, and side walls that
close blocks. With --real, every third model is a triple of surface files found below FOLDER. Lengths, deviations and angles vary.

volume   No block changes by more than the program states, and by no more than the limit without a warning. The volumes
         that it states are those that `terrane volume` finds in the file that was written.
worst q  The least q = 2 r / R of the written triangles, computed here, is not below that of `terrane arrange`.
proof    With --verify, `terrane verify` accepts the certificate.
order    The files in another order, with reversed triangles, give the same triangles.

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


def write_obj(path, name, surface):
    vertices, triangles = surface
    lines = [f"g {name}"] + [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices]
    lines += ["f " + " ".join(str(i + 1) for i in t) for t in triangles]
    path.write_text("\n".join(lines) + "\n")


def read_obj(path):
    vertices, triangles = [], []
    for line in open(path, encoding="ascii"):
        if line.startswith("v "):
            vertices.append(tuple(float(x) for x in line.split()[1:4]))
        elif line.startswith("f "):
            triangles.append(tuple(int(w.split("/")[0]) - 1 for w in line.split()[1:4]))
    return [tuple(sorted(vertices[i] for i in t)) for t in triangles]


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
    paths = []
    for name, surface in files.items():
        path = folder / f"{name}.obj"
        write_obj(path, name, surface)
        paths.append(str(path))
    return paths, size


def reversed_files(paths, folder):
    """The files in another order, those of ours with their triangles reversed."""
    other = folder / "other"
    other.mkdir()
    out = []
    for path in reversed(paths):
        if pathlib.Path(path).parent != folder:
            out.append(path)
            continue
        lines = pathlib.Path(path).read_text().splitlines()
        faces = [line for line in lines if line.startswith("f ")]
        target = other / pathlib.Path(path).name
        target.write_text("\n".join([line for line in lines if not line.startswith("f ")] + faces[::-1]) + "\n")
        out.append(str(target))
    return out


def volumes_found(terrane, folder, name, files):
    """The volumes of the blocks that these files enclose, ascending, or None."""
    stats = folder / f"{name}.json"
    run(terrane, "volume", *files, "-o", folder / name, "--stats", stats)
    if not stats.exists():
        return None
    return sorted(json.loads(stats.read_text()).get("volumes", {}).get("blocks", []))


def volume_flaws(terrane, folder, stats, made, limit):
    blocks = stats["improve"]["blocks"]
    flaws = [f"volume of block {b['block']} changes by {b['change_percent']:.3g} % without a warning"
             for b in blocks if b["change_percent"] > limit and "the volume of a block changed" not in made.stderr]
    for file, key in ("plain.obj", "volume_before"), ("out.obj", "volume_after"):
        found, stated = volumes_found(terrane, folder, key, [folder / file]), sorted(b[key] for b in blocks)
        if found is None:
            continue
        if len(found) != len(stated) or any(abs(x - y) > 1e-9 * max(found) for x, y in zip(found, stated)):
            flaws.append(f"{key}: stated {stated[:5]}, the file has {found[:5]}")
    return flaws


def judge(terrane, seed, real, keep, verify):
    rng = random.Random(seed)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        paths, size = model_files(rng, folder, real)
        options = []
        if size:
            length = size * rng.choice([.05, .1, .2])
            options += ["--edge-length", repr(length)]
            if rng.random() < .4:
                options += ["--max-deviation", repr(length * rng.choice([.001, .02, .2]))]
            if rng.random() < .3:
                options += ["--turn", repr(rng.uniform(10, 30))]
        plain = run(terrane, "arrange", *paths, "-o", folder / "plain.obj")
        made = run(terrane, "improve", *paths, "-o", folder / "out.obj", "--stats", folder / "s.json",
                   "--certificate", folder / "c.json", *options)
        if made.returncode == 2 and "is too small for coordinates" in made.stderr + made.stdout:
            return "refused", []
        if made.returncode == 1:
            return "not written", []
        if made.returncode != 0 or plain.returncode != 0:
            return "failed", [f"status {made.returncode}: {made.stderr.strip()[-200:]}"]
        stats = json.loads((folder / "s.json").read_text())
        flaws = volume_flaws(terrane, folder, stats, made, 5.)
        # How far rounding moved vertices before is the arrangement's matter.
        verified = run(terrane, "verify", folder / "c.json", "--max-deviation", "1e9") if verify else None
        if verified and verified.returncode != 0:
            flaws.append(f"its certificate: status {verified.returncode}: {verified.stdout.strip()[-200:]}")
        now = read_obj(folder / "out.obj")
        first, last = min(map(quality, read_obj(folder / "plain.obj"))), min(map(quality, now))
        if last < first * (1 - 1e-9) - 1e-14:
            flaws.append(f"worst q {first:.3g} -> {last:.3g}")
        other = run(terrane, "improve", *reversed_files(paths, folder), "-o", folder / "other.obj", *options)
        if other.returncode != 0 or sorted(read_obj(folder / "other.obj")) != sorted(now):
            flaws.append("another order of files gives another geometry")
        if flaws and keep:
            target = pathlib.Path(keep) / f"model{seed}"
            target.mkdir(parents=True, exist_ok=True)
            for path in paths:
                (target / pathlib.Path(path).name).write_bytes(pathlib.Path(path).read_bytes())
            (target / "options.txt").write_text(" ".join(options) + "\n")
        largest = max([b["change_percent"] for b in stats["improve"]["blocks"]], default=0.)
        return f"largest change {largest:.3g} %", flaws


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--terrane", required=True, help="the program")
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1, help="of the first model; the others follow")
    parser.add_argument("--real", help="folder with surface files of 200 kB at most")
    parser.add_argument("--keep", help="folder for the models that break a promise")
    parser.add_argument("--verify", action="store_true", help="judge certificates as well, which takes minutes each")
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    real = sorted(p for p in pathlib.Path(options.real).rglob("*")
                  if p.suffix in FORMATS and p.stat().st_size < 200000) if options.real else []
    broken, outcomes = 0, {}
    for seed in range(options.seed, options.seed + options.count):
        outcome, flaws = judge(options.terrane, seed, real, options.keep, options.verify)
        kind = outcome.split(" %")[0].rsplit(" ", 1)[0] if "change" in outcome else outcome
        outcomes[kind] = outcomes.get(kind, 0) + 1
        broken += bool(flaws)
        if flaws or options.verbose:
            print(f"model {seed}: {outcome}; {'; '.join(flaws) or 'holds'}", flush=True)
    print(f"{options.count} models, {broken} break a promise; outcomes: {outcomes}")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
