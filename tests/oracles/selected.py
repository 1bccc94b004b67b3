#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Judges `terrane select` by winding numbers of random points, which NumPy sums from solid angles, and by volumes.

    tests/oracles/selected.py --terrane build/release/cli/terrane [--count 2000] [--seed 1] [--points 400] [--cgal FILE]

A case has two or three operands: boxes, octahedra, tori and crosses of boxes on a lattice of integers, so that faces are
coplanar and edges and corners touch, or turned and moved; some are nested, face inwards or cross themselves. A random
expression over them selects a region. Then

- a random point near the surfaces has the winding number 1 in the boundary if the expression holds there for the winding numbers of the
  operands, else 0;
- the volume of the boundary, by the divergence theorem, is the one that is printed;
- of two operands a - b and a & b make a, a | b and a & b make a and b;
- `terrane check` finds the boundary closed and conforming;
- with --cgal (the program of scripts/scorecard/setup.sh) CGAL's corefinement with exact numbers has the same volume,
  where its operands are solids that do not cross themselves and it returns one.

Nothing here is shared with the program. Prints a line for each case that fails, and a summary; status 1 if there is one.
"""
import argparse
import itertools
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

BOX = np.array([[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2],
                [1, 3, 7], [1, 7, 5]])


def box(rng):
    low = rng.integers(0, 3, 3)
    high = low + rng.integers(1, 5, 3)
    return np.array([[(low, high)[k >> a & 1][a] for a in range(3)] for k in range(8)], float), BOX


def octahedron(rng):
    points = np.vstack([np.eye(3), -np.eye(3)]) * rng.integers(1, 4) + rng.integers(1, 5, 3)
    faces = [(a, b, c) for a, b, c in itertools.product((0, 3), (1, 4), (2, 5))]
    return points, np.array([f if sum(k > 2 for k in f) % 2 == 0 else f[::-1] for f in faces])


def torus(rng):
    n, m, wide, thin = rng.integers(3, 9), rng.integers(3, 7), rng.uniform(1.5, 3), rng.uniform(0.4, 1.2)
    u, v = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.arange(m) * 2 * np.pi / m, indexing="ij")
    points = np.stack([(wide + thin * np.cos(v)) * np.cos(u), (wide + thin * np.cos(v)) * np.sin(u), thin * np.sin(v)], -1)
    faces = []
    for i, j in itertools.product(range(n), range(m)):
        a, b, c, d = i * m + j, (i + 1) % n * m + j, (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m
        faces += [(a, b, c), (a, c, d)]
    return points.reshape(-1, 3) + rng.integers(1, 4, 3), np.array(faces)


def operand(rng):
    """(vertices, triangles, whether it is a solid that faces outwards and does not cross itself)."""
    points, faces = (box, octahedron, torus)[rng.integers(3)](rng)
    simple = True
    if rng.random() < 0.3:  # several bodies, which may cross, touch or contain each other
        more, others = box(rng)
        points, faces, simple = np.vstack([points, more]), np.vstack([faces, others + len(points)]), False
    if rng.random() < 0.3:
        turn, _ = np.linalg.qr(rng.standard_normal((3, 3)))
        points = points @ (turn * np.sign(np.linalg.det(turn))).T + rng.uniform(-1, 1, 3)
    if rng.random() < 0.15:
        faces, simple = faces[:, ::-1], False
    return points, faces, simple


def windings(points, faces, places):
    """Winding numbers by the solid angles of the triangles (Van Oosterom and Strackee 1983)."""
    a, b, c = (points[faces[:, k]][None] - places[:, None] for k in range(3))
    x, y, z = (np.linalg.norm(v, axis=-1) for v in (a, b, c))
    top = (a * np.cross(b, c)).sum(-1)
    bottom = x * y * z + (a * b).sum(-1) * z + (b * c).sum(-1) * x + (c * a).sum(-1) * y
    return np.arctan2(top, bottom).sum(-1) / (2 * np.pi)


def volume(points, faces):
    a, b, c = (points[faces[:, k]] for k in range(3))
    return (a * np.cross(b, c)).sum() / 6


def write(path, points, faces):
    path.write_text("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points.tolist()) +
                    "".join(f"f {a} {b} {c}\n" for a, b, c in (faces + 1).tolist()))


def read(path):
    lines = [line.split() for line in path.read_text().splitlines()]
    return (np.array([w[1:4] for w in lines if w[0] == "v"], float).reshape(-1, 3),
            np.array([w[1:4] for w in lines if w[0] == "f"], int).reshape(-1, 3) - 1)


def expression(rng, names):
    """A region with an end, for the program and for Python."""
    text = names[0]
    for name in names[1:]:
        text = f"({text}) {rng.choice(list('|&-^'))} {name}"
    if rng.random() < 0.3:
        text = f"({text}) & ~({names[-1]} & {names[0]})"
    return text


def region(args, folder, names, text, rule):
    """(points, faces, volume that is printed) of an expression."""
    out = folder / "out.obj"
    out.unlink(missing_ok=True)
    ran = subprocess.run([args.terrane, "select", text, *(folder / f"{n}.obj" for n in names), "-o", out, "--rule", rule,
                          "--threads", "1"], capture_output=True, text=True)
    if "region: empty" in ran.stdout:
        return np.zeros((0, 3)), np.zeros((0, 3), int), 0.0
    assert ran.returncode == 0, ran.stderr + ran.stdout
    printed = float(re.search(r"^region: .* volume ([-\d.,e+]+)", ran.stdout, re.M)[1].rstrip(",").replace(",", ""))
    found = subprocess.run([args.terrane, "check", out], capture_output=True, text=True)
    assert found.returncode == 0 and "improper contacts: 0" in found.stdout, found.stdout
    assert re.search(r"\b0 free border edges|no flaws", found.stdout), found.stdout
    return *read(out), printed


def judge(args, seed, folder):
    rng = np.random.default_rng(seed)
    names = ["a", "b", "c"][:rng.integers(2, 4)]
    operands = [operand(rng) for _ in names]
    for name, (points, faces, _) in zip(names, operands):
        write(folder / f"{name}.obj", points, faces)
    rule = rng.choice(["nonzero", "positive", "odd"])
    inside = {"nonzero": lambda w: w != 0, "positive": lambda w: w > 0, "odd": lambda w: w % 2 != 0}[rule]
    text = expression(rng, names)
    points, faces, printed = region(args, folder, names, text, rule)
    measured = volume(points, faces)
    assert abs(measured - printed) <= 1e-4 * max(1, abs(measured)), ("volume", measured, printed)
    places = places_near([(p, f) for p, f, _ in operands], args.points, rng)
    numbers = [windings(p, f, places) for p, f, _ in operands]
    have = windings(points, faces, places)
    clear = np.all([abs(w - np.rint(w)) < 1e-3 for w in [*numbers, have]], axis=0)  # not on a surface
    assert clear.mean() > 0.2, "most points lie on surfaces"
    sides = {n: inside(np.rint(w).astype(int)) for n, w in zip(names, numbers)}
    want = eval(python_of(text), {}, sides)  # an expression that was made here
    wrong = clear & (np.rint(have).astype(int) != want)
    assert not wrong.any(), ("winding numbers", text, rule, places[wrong][0], have[wrong][0])
    if len(names) == 2:
        parts = {op: region(args, folder, names, f"a {op} b", rule)[2] for op in "|&-"}
        whole = [region(args, folder, [n], n, rule)[2] for n in names]
        assert abs(parts["-"] + parts["&"] - whole[0]) < 1e-4 * max(1, *whole), (parts, whole)
        assert abs(parts["|"] + parts["&"] - sum(whole)) < 1e-4 * max(1, *whole), (parts, whole)
        if args.cgal and all(simple for _, _, simple in operands):
            return compare_with_cgal(args, folder, names, parts)
    return 0


def places_near(operands, count, rng):
    """Points near the triangles of the operands, and anywhere in the box that two of them share."""
    middles = np.vstack([p[f].mean(1) for p, f in operands])
    near = middles[rng.integers(len(middles), size=count // 2)]
    near = near + rng.standard_normal(near.shape) * 10 ** rng.uniform(-2, 0.3, (len(near), 1))
    (a, _), (b, _) = (operands[k] for k in rng.permutation(len(operands))[:2])
    ends = np.sort([np.maximum(a.min(0), b.min(0)), np.minimum(a.max(0), b.max(0))], axis=0)
    return np.vstack([near, rng.uniform(ends[0] - 0.1, ends[1] + 0.1, (count - len(near), 3))])


def python_of(text):
    """The expression for arrays of booleans, which have no difference."""
    return text.replace(" - ", " & ~")


def compare_with_cgal(args, folder, names, parts):
    same = 0
    for op, operation in (("|", "union"), ("&", "intersection"), ("-", "difference")):
        out = folder / "cgal.off"
        out.unlink(missing_ok=True)
        inputs = []
        for name in names:
            inputs.append(folder / f"{name}.off")
            points, faces = read(folder / f"{name}.obj")
            inputs[-1].write_text(f"OFF\n{len(points)} {len(faces)} 0\n" + "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in points.tolist()) +
                                  "".join(f"3 {a} {b} {c}\n" for a, b, c in faces.tolist()))
        ran = subprocess.run([args.cgal, "corefine-exact", operation, out, *inputs], capture_output=True, text=True)
        if ran.returncode or not out.exists():
            continue  # a result that is no manifold
        words = [w for line in out.read_text().splitlines() for w in line.split("#")[0].split()]
        assert words[0] == "OFF"
        n, m = int(words[1]), int(words[2])
        points = np.array(words[4:4 + 3 * n], float).reshape(-1, 3)
        faces = np.array(words[4 + 3 * n:4 + 3 * n + 4 * m], int).reshape(-1, 4)[:, 1:] if m else np.zeros((0, 3), int)
        found = volume(points, faces) if m else 0.0
        assert abs(found - parts[op]) < 1e-4 * max(1, abs(found)), ("CGAL", operation, found, parts[op])
        same += 1
    return same


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--terrane", required=True)
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--points", type=int, default=400)
    parser.add_argument("--cgal", help="build/scorecard/cgal")
    args = parser.parse_args()
    failures = compared = 0
    with tempfile.TemporaryDirectory() as name:
        for seed in range(args.seed, args.seed + args.count):
            try:
                compared += judge(args, seed, pathlib.Path(name))
            except AssertionError as flaw:
                failures += 1
                print(f"seed {seed}: {flaw}")
    print(f"{args.count} cases, {failures} failed; {compared} regions as CGAL has them")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
