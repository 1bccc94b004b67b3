#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Arranges nearly coplanar soups with `terrane arrange --certificate`, and has `terrane verify` judge each certificate.

    tests/oracles/certified_soups.py --terrane build/release/cli/terrane [--count 5000] [--seed 1] [--family NAME] [--keep DIR] [FILE ...]

A soup has 4 to 60 triangles, more often few. The families take turns: see FAMILIES. FILEs are judged instead of soups. Each ends in one of three ways:

accepted  arrange has status 0 and warns of nothing; verify accepts the certificate.
warned    arrange has status 0, and names the --max-deviation without which verify refuses the certificate; verify refuses it without
          and accepts it with that option.
refused   arrange has status 1 and names pairs of triangles that are in the way, or has status 2 as nothing would be left; it writes no
          file.

Anything else is a failure: it is printed with its seed. Prints how many soups of each family ended how; status 1 if any failed.
"""
import argparse
import collections
import concurrent.futures
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile


def nudged(rng, p, most=1):
    """The point, with each coordinate up to `most` doubles away."""
    result = []
    for x in p:
        steps = rng.randint(-most, most)
        for _ in range(abs(steps)):
            x = math.nextafter(x, math.copysign(math.inf, steps))
        result.append(x)
    return tuple(result)


def lattice(rng, n):
    """Triangles of a 3 x 3 x 3 lattice, tilted by a double."""
    return [[nudged(rng, [float(rng.randint(0, 2)) for _ in range(3)]) for _ in range(3)] for _ in range(n)]


def flat(rng, n):
    """Triangles of a 4 x 4 lattice in one plane, at a place and of a size of their own, tilted by some doubles."""
    origin = [rng.choice((0.0, 1.0, 1e3, 123456.789)) for _ in range(3)]
    size, most = rng.choice((1.0, 0.1, 7.0)), rng.choice((1, 2, 5))
    u, v = ([rng.uniform(-1, 1) * size for _ in range(3)] for _ in range(2))

    def corner():
        i, j = rng.randint(0, 3), rng.randint(0, 3)
        return nudged(rng, [o + i * a + j * b for o, a, b in zip(origin, u, v)], most)

    return [[corner() for _ in range(3)] for _ in range(n)]


def sheets(rng, n):
    """Sheets of 2 x 2 squares that nearly coincide, each with diagonals of its own, and some triangles across."""
    origin = [rng.choice((0.0, 10.0, 5e5)) for _ in range(3)]
    slope, result = [rng.choice((0.0, 0.1, 0.3)) for _ in range(2)], []

    def at(i, j):
        return nudged(rng, [origin[0] + i, origin[1] + j, origin[2] + slope[0] * i + slope[1] * j])

    while len(result) < n:
        for i in range(2):
            for j in range(2):
                a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
                result += [[a, b, c], [a, c, d]] if rng.random() < 0.5 else [[a, b, d], [b, c, d]]
        if rng.random() < 0.5:
            i, j = rng.uniform(0, 2), rng.uniform(0, 2)
            result.append([at(i, j), at(rng.uniform(0, 2), rng.uniform(0, 2)), at(i + 0.1, j + rng.choice((-1, 1)))])
    return result[:n]


def slivers(rng, n):
    """Needles that are some doubles wide, between points of a lattice, among larger triangles."""
    result, scale = [], rng.choice((1.0, 1.0, 1 / 3, 1e-3, 1e4))
    for _ in range(n):
        p, q, r = ([rng.randint(0, 2) * scale for _ in range(3)] for _ in range(3))
        result.append([p, q, nudged(rng, rng.choice((p, q)), 3)] if rng.random() < 0.6 else [nudged(rng, x) for x in (p, q, r)])
    return [[tuple(x) for x in t] for t in result]


def fans(rng, n):
    """Fans of narrow triangles round a few points, nearly in one plane."""
    result, points = [], [[float(rng.randint(0, 3)), float(rng.randint(0, 3)), rng.choice((0.0, 1.0, 0.1))] for _ in range(3)]
    while len(result) < n:
        apex, radius = rng.choice(points), rng.choice((1.0, 2.0))
        step, angle = rng.choice((1e-15, 1e-9, 0.1, 0.8)), rng.choice((0, rng.uniform(0, 6)))
        tilt = rng.choice((0.0, 1e-16, 0.3))
        for k in range(rng.randint(2, 6)):
            ends = [[apex[0] + radius * math.cos(angle + a * step), apex[1] + radius * math.sin(angle + a * step), apex[2] + tilt * a]
                    for a in (k, k + 1)]
            result.append([tuple(apex)] + [nudged(rng, e) for e in ends])
    return result[:n]


def stacks(rng, n):
    """Triangles in planes that are some doubles apart, far from the origin."""
    far = rng.choice((1e6, 4e6, 2.0**40))
    gap = rng.choice((1, 2, 4, 64)) * math.ulp(far)

    def corner(z):
        return nudged(rng, [far + rng.randint(0, 3), far + rng.randint(0, 3), far + z * gap], rng.choice((0, 1)))

    return [[corner(z) for _ in range(3)] for z in (rng.randint(0, 3) for _ in range(n))]


def decimals(rng, n):
    """Triangles of a lattice of 0.1 or 0.3, far from the origin or not."""
    origin = rng.choice(((0, 0, 0), (500000, 4000000, -1000), (0.7, 1000.3, 12.9)))
    step, digits = rng.choice(((0.1, 1), (0.3, 1), (0.01, 2), (0.05, 2)))
    return [[tuple(round(o + step * rng.randint(0, 3), digits) for o in origin) for _ in range(3)] for _ in range(n)]


def turned(rng, n):
    """Triangles of a lattice that is rotated, some of them needles."""
    a, b = rng.uniform(0, 6), rng.uniform(0, 6)
    far = rng.choice((0.0, 0.0, 1e5))

    def corner():
        x, y, z = (rng.randint(0, 2) / 2 for _ in range(3))
        x, y = math.cos(a) * x - math.sin(a) * y, math.sin(a) * x + math.cos(a) * y
        y, z = math.cos(b) * y - math.sin(b) * z, math.sin(b) * y + math.cos(b) * z
        return x + far, y + far, z

    result = []
    for _ in range(n):
        p, q = corner(), corner()
        result.append([p, q, nudged(rng, q, 2) if rng.random() < 0.2 else corner()])
    return result


FAMILIES = [lattice, flat, sheets, slivers, fans, stacks, decimals, turned]


def soup(seed, family):
    rng = random.Random(seed)
    return (family or FAMILIES[seed % len(FAMILIES)])(rng, round(4 * 15 ** rng.random() ** 2))


def write(triangles, path):
    lines = ["v %r %r %r" % tuple(p) for t in triangles for p in t]
    for i in range(len(triangles)):
        lines += ["g t%d" % i, "f %d %d %d" % (3 * i + 1, 3 * i + 2, 3 * i + 3)]
    path.write_text("\n".join(lines) + "\n")


def judge(terrane, given, folder, options):
    """Returns how it ended, and what is wrong if anything is."""
    result, certificate = folder / (given.stem + ".out.obj"), folder / (given.stem + ".json")
    for path in (result, certificate):
        path.unlink(missing_ok=True)

    def run(*command):
        return subprocess.run([terrane, *map(str, command)], capture_output=True, text=True)

    made = run("arrange", given, "-o", result, "--certificate", certificate, "--threads", 1, *options)
    if made.returncode == 1 or "nothing would be left" in made.stderr:
        if result.exists() or certificate.exists():
            return "failed", "refused, but written"
        return ("refused", "") if re.search("meet improperly|nothing would be left", made.stderr) else ("failed", "refused without a reason: " + made.stderr)
    if made.returncode != 0:
        return "failed", "status %d: %s" % (made.returncode, made.stderr.strip())
    verdict = run("verify", certificate)
    needed = re.search(r"unless it is given --max-deviation (\S+)", made.stderr)
    if "terrane verify refuses" in made.stderr:
        return "failed", made.stderr
    if not needed:
        return ("accepted", "") if verdict.returncode == 0 else ("failed", verdict.stdout + verdict.stderr)
    if verdict.returncode != 1:
        return "failed", "warned of for nothing: " + made.stderr
    verdict = run("verify", certificate, "--max-deviation", needed[1])
    return ("warned", "") if verdict.returncode == 0 else ("failed", "with --max-deviation %s: %s" % (needed[1], verdict.stdout + verdict.stderr))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--terrane", required=True)
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--family", choices=[f.__name__ for f in FAMILIES])
    parser.add_argument("--options", default="", help="for terrane arrange")
    parser.add_argument("--keep", type=pathlib.Path, help="keep the soups that fail in this folder")
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    args = parser.parse_args()
    family = next((f for f in FAMILIES if f.__name__ == args.family), None)
    ends = collections.defaultdict(collections.Counter)

    def one(i, folder):
        seed = args.seed + i
        given = args.files[i] if args.files else folder / ("soup%d.obj" % seed)
        if not args.files:
            write(soup(seed, family), given)
        name = given.stem if args.files else (family or FAMILIES[seed % len(FAMILIES)]).__name__
        end, what = judge(args.terrane, given, folder, args.options.split())
        if end == "failed" and args.keep and not args.files:
            args.keep.mkdir(exist_ok=True)
            (args.keep / given.name).write_text(given.read_text())
        for path in folder.glob(given.stem + ".*"):
            path.unlink()
        return given.stem, name, end, what

    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for stem, name, end, what in pool.map(lambda i: one(i, pathlib.Path(folder)), range(len(args.files) or args.count)):
            ends[name][end] += 1
            if end == "failed":
                print("%s (%s): %s" % (stem, name, " / ".join(what.strip().splitlines()[:6])[:600]), flush=True)
    total = sum(ends.values(), collections.Counter())
    for name, counts in [*sorted(ends.items()), ("all", total)]:
        print("%-10s" % name, ", ".join("%d %s" % (counts[end], end) for end in ("accepted", "warned", "refused", "failed")))
    return 1 if total["failed"] else 0


if __name__ == "__main__":
    sys.exit(main())
