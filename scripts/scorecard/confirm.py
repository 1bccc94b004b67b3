#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Confirms a finding in rational numbers, with docs/examples/python/check_case.py alone and nothing of Terrane.

    confirm.py CASE.json OUTPUT.off OPERATION

It prints what is so of an engine's output: pairs of its triangles that share more than a corner or an edge of both;
edges that are not run through as often one way as the other; its volume, beside that of the case; points of the exact
arrangement that it lacks.
"""
import collections
import json
import pathlib
import sys
from fractions import Fraction

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs" / "examples" / "python"))
import check_case  # noqa: E402


def read(path):
    """The triangles of an OFF file; faces with more corners are fans."""
    words = pathlib.Path(path).read_text().split()
    vertices, faces, at = int(words[1]), int(words[2]), 4 + 3 * int(words[1])
    points = [tuple(Fraction(float(w)) for w in words[4 + 3 * k:7 + 3 * k]) for k in range(vertices)]
    triangles = []
    for _ in range(faces):
        first, *rest = (points[int(w)] for w in words[at + 1:at + 1 + int(words[at])])
        triangles += [(first, b, c) for b, c in zip(rest, rest[1:])]
        at += 1 + int(words[at])
    return triangles


def volume(triangles):
    return sum(check_case.dot(a, check_case.cross(b, c)) for a, b, c in triangles) / Fraction(6)


def unbalanced(triangles):
    """Edges that are run through more often one way than the other."""
    sums = collections.Counter()
    for t in triangles:
        for a, b in zip(t, t[1:] + t[:1]):
            sums[min(a, b), max(a, b)] += 1 if a < b else -1
    return [e for e, n in sums.items() if n]


def improper(triangles):
    """Pairs of triangles that share more than a corner or an edge of both; a triangle that repeats another is one."""
    planes = [check_case.Plane(t) for t in triangles]
    pairs = []
    for i, s in enumerate(planes):
        for j, t in enumerate(planes[:i]):
            if any(s.normal) and any(t.normal):
                shared = check_case.common_points(s, t)
                if shared and not check_case.is_proper(s, t, shared):
                    pairs.append((j, i))
    return pairs


def main(case_path, output, operation):
    case = json.loads(pathlib.Path(case_path).read_text())
    triangles = read(output)
    inputs = sum(len(check_case.read_off(pathlib.Path(case_path).parent / name)) for name in case["inputs"])
    print(f"{case['name']}, {operation}: {inputs} input triangles, {len(triangles)} in the result")
    pairs = improper(triangles)
    print(f"{len(pairs)} pairs meet improperly" + (f", the first {pairs[0]}" if pairs else ""))
    print(f"{sum(not any(check_case.Plane(t).normal) for t in triangles)} triangles without area")
    if operation == "arrangement":
        points = {tuple(map(Fraction, p)) for p in case["points"]}
        print(f"{len(points - {p for t in triangles for p in t})} of {len(points)} exact points are no vertices")
    else:
        print(f"{len(unbalanced(triangles))} edges are open")
        print(f"its volume is {float(volume(triangles)):.12g}, exactly {float(Fraction(case['booleans'][operation])):.12g}")


if __name__ == "__main__":
    main(*sys.argv[1:])
