#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Arranges soups on decimal lattices at map coordinates with `terrane arrange`, and judges how far surfaces moved.

    tests/oracles/rounded_soups.py --terrane build/release/cli/terrane [--count 100] [--seed 1] [--turned] [--box] [FILE ...]

A soup has 40 to 80 triangles with corners on a 3 x 3 x 3 lattice of 0.1 m at (500000, 4000000, -1000): coplanar to the eye, but on no
grid of binary numbers. With --turned it is rotated by angles of its own, so that no coordinate is a decimal. With --box a
volume of interest cuts through it. FILEs are judged instead of soups; each of their triangles must be a surface of its own.

All distances are of the doubles in the files, compared in rational numbers; only the last square root is a float.

parts    No corner of a part is farther from its input triangle, so neither is any point of the part: the distance from a
         triangle is a convex function.
parents  No point of an input triangle is farther from its parts. Edges with an odd number of parts are their border. Let all
         of it be within e of sides of the input triangle, as seen along the normal, and let the areas of the parts there add up to the
         area of the input triangle but for less than half of it. Then a line along the normal at any point farther than e from all
         sides meets the parts, since an odd number of them is the same for all such points. A point nearer than e to a side is
         within e of it, and sides are within e, and the longest piece along them that no border is near, of the border.
needles  Triangles that are thinner than 2 ulps, as their corners are in line in decimals, may vanish. The program says how many.
box      No coordinate is outside of the box, by the doubles.

What no bound below --most was shown for is a failure, unless the status is 1 and no file is there. Prints the distribution in ulps of the
largest coordinate, and what was broken; status 1 if anything was.
"""
import argparse
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile
from fractions import Fraction


def soup(seed, turned):
    rng = random.Random(seed)
    origin = (500000, 4000000, -1000)
    a, b, c = (rng.uniform(0, 2 * math.pi) for _ in range(3))

    def corner():
        p = [rng.randint(0, 2) for _ in range(3)]
        if not turned:
            return [round(o + k / 10, 1) for o, k in zip(origin, p)]
        x, y, z = (k / 10 for k in p)
        x, y = math.cos(a) * x - math.sin(a) * y, math.sin(a) * x + math.cos(a) * y
        y, z = math.cos(b) * y - math.sin(b) * z, math.sin(b) * y + math.cos(b) * z
        x, z = math.cos(c) * x - math.sin(c) * z, math.sin(c) * x + math.cos(c) * z
        return [o + v for o, v in zip(origin, (x, y, z))]

    return [[corner() for _ in range(3)] for _ in range(rng.randint(40, 80))]


def write(triangles, path):
    lines = ["v %r %r %r" % tuple(p) for t in triangles for p in t]
    for i in range(len(triangles)):
        lines += ["g t%d" % i, "f %d %d %d" % (3 * i + 1, 3 * i + 2, 3 * i + 3)]
    path.write_text("\n".join(lines) + "\n")


def read(path):
    vertices, groups, names = [], {}, []
    for line in path.read_text().splitlines():
        w = line.split()
        if not w:
            continue
        if w[0] == "v":
            vertices.append(tuple(Fraction(float(x)) for x in w[1:4]))
        elif w[0] == "g":
            names = w[1:]
        elif w[0] == "f":
            for name in names:
                groups.setdefault(name, []).append(tuple(int(x.split("/")[0]) - 1 for x in w[1:4]))
    return vertices, groups


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def to_segment(p, a, b):
    """The square of the distance of p from a segment."""
    d, w = minus(b, a), minus(p, a)
    t = min(max(dot(w, d) / dot(d, d), 0), 1) if any(d) else Fraction(0)
    r = minus(w, tuple(t * x for x in d))
    return dot(r, r)


def to_triangle(p, t):
    n = cross(minus(t[1], t[0]), minus(t[2], t[0]))
    inside = all(dot(cross(n, minus(t[(i + 1) % 3], t[i])), minus(p, t[i])) >= 0 for i in range(3))
    if inside:
        return dot(n, minus(p, t[0]))**2 / dot(n, n)
    return min(to_segment(p, t[i], t[(i + 1) % 3]) for i in range(3))


def height(t):
    """The least height of a triangle."""
    n = cross(minus(t[1], t[0]), minus(t[2], t[0]))
    longest = max(dot(minus(t[(i + 1) % 3], t[i]), minus(t[(i + 1) % 3], t[i])) for i in range(3))
    return root(dot(n, n) / longest)


def root(x):
    return math.sqrt(float(x))


def longest_open(intervals):
    """The longest part of [0, 1] that no interval covers."""
    at, longest = 0, 0
    for low, high in sorted(intervals):
        longest = max(longest, low - at)
        at = max(at, high)
    return max(longest, 1 - at)


def back(t, parts, vertices):
    """A bound of the distance of any point of t from the parts; infinite where none is shown."""
    n = cross(minus(t[1], t[0]), minus(t[2], t[0]))
    nn = dot(n, n)

    def flat(p):  # along the normal, into the plane of t
        h = dot(n, minus(p, t[0])) / nn
        return minus(p, tuple(h * x for x in n))

    place = {v: flat(vertices[v]) for part in parts for v in part}
    above = max((abs(dot(n, minus(vertices[v], t[0]))) / root(nn) for v in place), default=math.inf)
    count = {}
    for part in parts:
        for i in range(3):
            side = tuple(sorted((part[i], part[(i + 1) % 3])))
            count[side] = count.get(side, 0) + 1
    covered = [[], [], []]
    aside = 0
    for (u, v), k in count.items():
        if k % 2 == 0:
            continue
        p, q = place[u], place[v]
        far = [max(to_segment(p, t[i], t[(i + 1) % 3]), to_segment(q, t[i], t[(i + 1) % 3])) for i in range(3)]
        best = min(range(3), key=lambda i: far[i])
        aside = max(aside, far[best])
        for i in range(3):
            if far[i] <= 4 * far[best]:
                d = minus(t[(i + 1) % 3], t[i])
                covered[i].append(sorted(dot(minus(x, t[i]), d) / dot(d, d) for x in (p, q)))
    e = root(aside)
    area = sum((abs(dot(n, cross(minus(place[b], place[a]), minus(place[c], place[a])))) for a, b, c in parts), Fraction(0)) / nn
    if not Fraction(1, 2) < area < Fraction(3, 2):
        return math.inf
    gap = max(float(longest_open(c)) * root(dot(minus(t[(i + 1) % 3], t[i]), minus(t[(i + 1) % 3], t[i])))
              for i, c in enumerate(covered))
    return 2 * e + gap + float(above)


thin = 2  # ulps of the largest coordinate


def judge(given, result, box):
    points, before = read(given)
    vertices, after = read(result)
    ulp = math.ulp(max(float(abs(x)) for p in points for x in p))
    parts, parents, area, gone = 0, 0, 0, 0
    for name, [corners] in before.items():
        t = [points[v] for v in corners]
        n = cross(minus(t[1], t[0]), minus(t[2], t[0]))
        if not any(n):
            continue
        pieces = after.get(name, [])
        if not pieces and height(t) < thin * ulp:
            gone += 1
            continue
        own = {v for piece in pieces for v in piece}
        parts = max([parts] + [root(to_triangle(vertices[v], t)) for v in own])
        if not box:
            parents = max(parents, back(t, pieces, vertices))
            whole = root(dot(n, n))
            covered = sum(root(dot(m, m)) for m in (cross(minus(vertices[b], vertices[a]), minus(vertices[c], vertices[a]))
                                                    for a, b, c in pieces))
            area = max(area, abs(covered / whole - 1))
    outside = max((max(Fraction(l) - x, x - Fraction(h)) for p in vertices for l, x, h in zip(box[:3], p, box[3:])), default=0) if box else 0
    return parts / ulp, parents / ulp, area, float(outside) / ulp, gone


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--terrane", required=True)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--turned", action="store_true")
    parser.add_argument("--box", action="store_true")
    parser.add_argument("--most", type=float, default=1000, help="ulps of the largest coordinate")
    parser.add_argument("--share", type=float, default=0.95, help="of the soups that must not be refused")
    parser.add_argument("--options", default="", help="for terrane arrange")
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    args = parser.parse_args()
    box = [500000.03, 4000000.03, -999.97, 500000.17, 4000000.17, -999.83] if args.box else None
    rows, broken, refused = [], 0, 0
    with tempfile.TemporaryDirectory() as folder:
        folder = args.keep or pathlib.Path(folder)
        folder.mkdir(exist_ok=True)
        for i in range(len(args.files) or args.count):
            name = args.files[i].stem if args.files else "soup%d" % (args.seed + i)
            given = args.files[i] if args.files else folder / (name + ".obj")
            if not args.files:
                write(soup(args.seed + i, args.turned), given)
            result, stats = folder / (name + ".out.obj"), folder / (name + ".json")
            result.unlink(missing_ok=True)
            command = [args.terrane, "arrange", given, "-o", result, "--stats", stats] + args.options.split()
            if box:
                command += ["--box", ",".join("%r" % x for x in box)]
            run = subprocess.run(command, capture_output=True, text=True)
            if run.returncode == 1 and not result.exists():
                refused += 1
                print("%s: refused: %s" % (name, run.stderr.strip().splitlines()[:1]))
                continue
            if run.returncode != 0:
                broken += 1
                print("%s: status %d %s" % (name, run.returncode, run.stderr.strip()[:200]))
                continue
            row = judge(given, result, box)
            stated = json.loads(stats.read_text())["rounding"]
            rows.append(row)
            good = max(row[0], row[1]) <= args.most and row[3] <= 0
            good = good and (box is not None or row[4] == stated["vanished"])
            broken += not good
            print("%s: parts %.3g, parents %.3g ulps, areas by %.2g, outside %.3g, %d needles gone; stated %s%s"
                  % (name, *row, {k: stated.get(k) for k in ("max_move", "deviation", "surface_deviation") if k in stated},
                     "" if good else "  BROKEN"))
    worst = sorted(max(r[0], r[1]) for r in rows)
    if worst:
        share = [worst[min(len(worst) - 1, int(len(worst) * q))] for q in (0, .5, .9, .95, 1)]
        print("ulps: least %.3g, median %.3g, 90 %% %.3g, 95 %% %.3g, most %.3g" % tuple(share))
    print("%d judged, %d refused, %d broken" % (len(rows), refused, broken))
    return 1 if broken or len(rows) < args.share * (len(rows) + refused) else 0


if __name__ == "__main__":
    sys.exit(main())
