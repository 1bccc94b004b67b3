#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Makes the cases of this folder: OFF files, and answers that docs/examples/python/check_case.py derives.

    tests/corpus/make.py [NAME]                       makes all cases again, or one
    PYTHONPATH=build/release/python tests/corpus/make.py --compare [CASE.json ...]   compares Terrane's answers with theirs
"""
import itertools
import json
import pathlib
import random
import sys
from fractions import Fraction

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "docs" / "examples" / "python"))
sys.dont_write_bytecode = True
import check_case  # noqa: E402


def box(low, high):
    v = [(x, y, z) for z in (low[2], high[2]) for y in (low[1], high[1]) for x in (low[0], high[0])]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]
    return v, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def octahedron(c, r):
    v = [tuple(c[k] + (s * r if k == axis else 0) for k in range(3)) for axis in range(3) for s in (1, -1)]
    return v, [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]


def tetrahedron(*v):
    return list(v), [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]


def soup(*triangles):
    return [p for t in triangles for p in t], [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(triangles))]


def turned(solid):
    """The solid with its inside out."""
    return solid[0], [(b, a, c) for a, b, c in solid[1]]


def joined(*solids):
    """Several shells as one operand."""
    v, t = [], []
    for more, triangles in solids:
        t += [tuple(k + len(v) for k in triangle) for triangle in triangles]
        v += more
    return v, t


def moved(solid, by):
    return [tuple(x + d for x, d in zip(p, by)) for p in solid[0]], solid[1]


def lattice(seed, n, size):
    rng = random.Random(seed)
    made = []
    while len(made) < n:
        t = [tuple(float(rng.randint(0, size)) for _ in range(3)) for _ in range(3)]
        if len(set(t)) == 3:
            made.append(t)
    return soup(*made)


ULP = 2.0 ** -52
CUBE = box((0.0, 0.0, 0.0), (2.0, 2.0, 2.0))
SQUARE = ((0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (4.0, 4.0, 0.0), (0.0, 4.0, 0.0))
TETRAHEDRON = tetrahedron((0.0,) * 3, (2.0, 0.0, 0.0), (0.0, 2.0, 0.0), (0.0, 0.0, 2.0))
FLAT = (list(SQUARE), [(0, 1, 2), (0, 2, 3)])
#: Name: operands, and whether they are solids.
CASES = {
    "cubes-cross-at-a-corner": ([CUBE, box((1.0,) * 3, (3.0,) * 3)], True),
    "cubes-share-a-face": ([CUBE, moved(CUBE, (2.0, 0.0, 0.0))], True),
    "cubes-share-half-a-face": ([CUBE, moved(CUBE, (2.0, 1.0, 0.0))], True),
    "cubes-share-an-edge": ([CUBE, moved(CUBE, (2.0, 2.0, 0.0))], True),
    "cubes-share-a-corner": ([CUBE, moved(CUBE, (2.0, 2.0, 2.0))], True),
    "cubes-coincide": ([CUBE, CUBE], True),
    "cubes-coincide-inside-out": ([CUBE, turned(CUBE)], True),
    "cubes-a-spacing-apart": ([CUBE, moved(CUBE, (2 + 2 * ULP, 0.0, 0.0))], True),
    "cubes-overlap-by-a-spacing": ([CUBE, moved(CUBE, (2 - 2 * ULP, 0.0, 0.0))], True),
    "cube-within-a-cube": ([CUBE, box((0.5,) * 3, (1.5,) * 3)], True),
    "cube-with-a-void": ([joined(CUBE, turned(box((0.5,) * 3, (1.5,) * 3))), box((1.0, 1.0, -1.0), (3.0, 3.0, 1.0))], True),
    "cube-in-a-corner-of-a-cube": ([CUBE, box((0.0,) * 3, (1.0,) * 3)], True),
    "octahedra-cross": ([octahedron((0.0,) * 3, 2.0), octahedron((0.5, 0.25, 0.125), 2.0)], True),
    "octahedra-meet-at-a-tip": ([octahedron((0.0,) * 3, 2.0), octahedron((4.0, 0.0, 0.0), 2.0)], True),
    "octahedron-through-a-cube": ([CUBE, octahedron((1.0,) * 3, 2.0)], True),
    "octahedron-tip-on-a-face": ([CUBE, octahedron((1.0, 1.0, 3.0), 1.0)], True),
    "octahedron-tip-on-an-edge": ([CUBE, octahedron((1.0, 2.0, 3.0), 1.0)], True),
    "tetrahedra-in-tenths": ([tetrahedron((0.1, 0.2, 0.3), (1.1, 0.2, 0.3), (0.1, 1.2, 0.3), (0.1, 0.2, 1.3)),
                              tetrahedron((0.3, 0.3, 0.3), (1.3, 0.3, 0.3), (0.3, 1.3, 0.3), (0.3, 0.3, 1.3))], True),
    "tetrahedron-needle": ([CUBE, tetrahedron((1.0, 1.0, -9.0), (1 + ULP, 1.0, -9.0), (1.0, 1 + ULP, -9.0), (1.0, 1.0, 9.0))], True),
    "tetrahedra-apart": ([TETRAHEDRON, moved(TETRAHEDRON, (3.0, 0.0, 0.0))], True),
    "tetrahedra-meet-at-a-tip": ([TETRAHEDRON, moved(TETRAHEDRON, (2.0, 0.0, 0.0))], True),
    "tetrahedra-cross-in-corners-of-a-cube": ([tetrahedron((1.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 1.0), (1.0, 1.0, 1.0)),
                                               tetrahedron((1.0, 0.0, 1.0), (1.0, 1.0, 1.0), (0.0, 0.0, 0.0), (0.0, 1.0, 1.0))], True),
    "tetrahedra-cross-from-a-corner": ([tetrahedron((0.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 1.0)),
                                                    tetrahedron((0.0, 0.0, 0.0), (0.0, 1.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))], True),
    "tetrahedra-whose-difference-touches-itself": ([tetrahedron((0.0, 1.0, 0.0), (1.0, 1.0, 1.0), (0.0, 0.0, 1.0), (0.0, 0.0, 0.0)),
                                                    tetrahedron((1.0, 1.0, 0.0), (0.0, 0.0, 0.0), (1.0, 0.0, 1.0), (0.0, 1.0, 1.0))], True),
    "tetrahedron-with-a-void": ([joined(tetrahedron((0.0,) * 3, (8.0, 0.0, 0.0), (0.0, 8.0, 0.0), (0.0, 0.0, 8.0)),
                                        turned(tetrahedron((1.0,) * 3, (2.0, 1.0, 1.0), (1.0, 2.0, 1.0), (1.0, 1.0, 2.0)))),
                                 tetrahedron((-1.0, 1.25, 1.25), (9.0, 1.25, 1.25), (-1.0, 3.0, 1.25), (-1.0, 1.25, 3.0))], True),
    "three-cubes-in-a-row": ([CUBE, moved(CUBE, (1.0, 0.0, 0.0)), moved(CUBE, (2.0, 0.0, 0.0))], True),
    "three-cubes-in-general-places": ([CUBE, moved(CUBE, (0.5, 0.75, 1.25)), moved(CUBE, (1.125, 0.375, -0.5))], True),
    "cubes-in-utm": ([moved(CUBE, (500000.1, 5600000.2, -1500.3)), moved(CUBE, (500001.2, 5600000.9, -1499.7))], True),
    "cubes-tiny": ([box((0.0,) * 3, (2.0 ** -500,) * 3), box((2.0 ** -501,) * 3, (2.0 ** -499,) * 3)], True),
    "squares-overlap-in-a-plane": ([FLAT, moved(FLAT, (1.0, 1.5, 0.0))], False),
    "squares-with-other-diagonals": ([FLAT, (list(SQUARE), [(0, 1, 3), (1, 2, 3)])], False),
    "squares-nearly-in-a-plane": ([FLAT, ([(0.0, 0.0, ULP), (4.0, 0.0, -ULP), (4.0, 4.0, ULP), (0.0, 4.0, -ULP)],
                                         [(0, 1, 2), (0, 2, 3)])], False),
    "wall-ends-in-a-square": ([FLAT, soup(((1.0, 2.0, -1.0), (3.0, 2.0, -1.0), (2.0, 2.0, 1.0)))], False),
    "wall-stands-on-a-square": ([FLAT, soup(((1.0, 2.0, 0.0), (3.0, 2.0, 0.0), (2.0, 2.0, 1.0)))], False),
    "wall-touches-in-a-point": ([FLAT, soup(((1.0, 2.0, 1.0), (3.0, 2.0, 1.0), (2.0, 1.5, 0.0)))], False),
    "corner-on-a-diagonal": ([FLAT, soup(((1.0, 1.0, 0.0), (3.0, 0.0, 1.0), (0.0, 3.0, 1.0)))], False),
    "fan-of-planes-through-a-line": ([soup(*(((0.0, 0.0, -1.0), (0.0, 0.0, 1.0), (x, y, 0.25)) for x, y in
                                            ((1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -2.0)))),
                                      soup(((-3.0, -3.0, 0.0), (3.0, -3.0, 0.0), (0.0, 4.0, 0.0)))], False),
    "three-planes-in-a-point": ([soup(((-2.0, -2.0, 0.0), (2.0, -2.0, 0.0), (0.0, 3.0, 0.0))),
                                 soup(((-2.0, 0.0, -2.0), (2.0, 0.0, -2.0), (0.0, 0.0, 3.0))),
                                 soup(((0.0, -2.0, -2.0), (0.0, 2.0, -2.0), (0.0, 0.0, 3.0)))], False),
    "triangle-twice": ([soup(SQUARE[:3], SQUARE[:3], SQUARE[1:])], False),
    "triangle-without-area": ([soup(((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (2.0, 2.0, 2.0)), SQUARE[:3])], False),
    "triangles-apart": ([soup(SQUARE[:3], tuple((x, y, 9.0) for x, y, _ in SQUARE[:3]))], False),
}


def pair(t):
    """One triangle in the plane z = 0, and another."""
    return [soup(((0.0, 0.0, 0.0), (8.0, 0.0, 0.0), (0.0, 8.0, 0.0))), soup(tuple(tuple(map(float, p)) for p in t))]


#: How two triangles meet: the second one, beside (0, 0, 0), (8, 0, 0), (0, 8, 0).
PAIRS = {
    "corner-on-corner": ((0, 0, 0), (-2, 0, 3), (0, -2, 3)),
    "corner-on-edge": ((4, 0, 0), (4, -2, 3), (6, -2, 3)),
    "corner-on-face": ((2, 2, 0), (2, 4, 3), (4, 2, 3)),
    "corner-beside-a-corner": ((8, 0, 0), (9, 1, 2), (9, -1, -2)),
    "edge-through-corner": ((0, 0, 2), (0, 0, -2), (-4, -4, 0)),
    "edge-through-edge": ((4, 0, 2), (4, 0, -2), (4, -4, 0)),
    "edge-through-face": ((2, 2, 2), (2, 2, -2), (9, 9, 0)),
    "edge-on-edge": ((2, 0, 0), (6, 0, 0), (4, -3, 3)),
    "edge-beyond-edge": ((6, 0, 0), (12, 0, 0), (9, -3, 3)),
    "edge-shared": ((0, 0, 0), (8, 0, 0), (4, -3, 3)),
    "edge-from-a-corner": ((0, 0, 0), (4, 0, 0), (2, -3, 3)),
    "edge-on-face": ((1, 1, 0), (3, 3, 0), (2, 2, 4)),
    "edge-across-face": ((-1, 2, 0), (9, 2, 0), (4, 2, 4)),
    "edge-from-corner-into-face": ((0, 0, 0), (3, 3, 0), (1, 1, 4)),
    "edge-from-corner-to-edge": ((0, 0, 0), (4, 4, 0), (2, 2, 4)),
    "face-through-corner": ((-2, 2, -2), (2, -2, -2), (0, 0, 4)),
    "face-through-edge-and-corner": ((0, 0, -3), (4, 4, -3), (2, 2, 6)),
    "face-through-face": ((1, 1, -3), (5, 1, -3), (3, 2, 6)),
    "faces-pierce-each-other": ((2, -2, -1), (2, 2, -1), (2, 1, 5)),
    "in-plane-apart": ((9, 9, 0), (12, 9, 0), (9, 12, 0)),
    "in-plane-corner-on-corner": ((8, 0, 0), (12, 0, 0), (12, -4, 0)),
    "in-plane-corner-on-edge": ((4, 4, 0), (9, 5, 0), (5, 9, 0)),
    "in-plane-edge-shared": ((8, 0, 0), (0, 8, 0), (8, 8, 0)),
    "in-plane-edges-overlap": ((2, 0, 0), (6, 0, 0), (4, -4, 0)),
    "in-plane-within": ((1, 1, 0), (3, 1, 0), (1, 3, 0)),
    "in-plane-within-from-a-corner": ((0, 0, 0), (3, 0, 0), (0, 3, 0)),
    "in-plane-star": ((5, 5, 0), (-3, 5, 0), (5, -3, 0)),
    "in-plane-across-a-corner": ((-1, -1, 0), (3, -1, 0), (-1, 3, 0)),
    "in-plane-turned-over": ((0, 0, 0), (0, 8, 0), (8, 0, 0)),
    "in-plane-one-edge-and-more": ((0, 0, 0), (8, 0, 0), (8, 8, 0)),
}


def placed(operands, scale, by):
    """Each coordinate scaled and moved, rounded to a double."""
    return [([tuple(x * scale + d for x, d in zip(p, by)) for p in v], t) for v, t in operands]


#: Ranges along an axis beside that from 0 to 4.
RANGES = {"apart": (5.0, 7.0), "touch": (4.0, 6.0), "cross": (3.0, 6.0), "begin": (0.0, 2.0), "within": (1.0, 3.0), "equal": (0.0, 4.0)}


def boxes(names):
    low, high = zip(*(RANGES[name] for name in names))
    return [box((0.0,) * 3, (4.0,) * 3), box(low, high)]


def frame(low, high, hole_low, hole_high):
    """A box with a square hole along z: a solid of genus 1."""
    square = lambda a, b: [(a[0], a[1]), (b[0], a[1]), (b[0], b[1]), (a[0], b[1])]  # noqa: E731
    rings = [[(x, y, z) for x, y in square(a, b)] for a, b in ((low, high), (hole_low, hole_high)) for z in (low[2], high[2])]
    v = [p for ring in rings for p in ring]
    t = []
    for i in range(4):
        j = (i + 1) % 4
        for a, b, c, d in ((i, j, 4 + j, 4 + i), (8 + j, 8 + i, 12 + i, 12 + j), (4 + i, 4 + j, 12 + j, 12 + i), (j, i, 8 + i, 8 + j)):
            t += [(a, b, c), (a, c, d)]
    return v, t


FRAME = frame((0.0, 0.0, 0.0), (6.0, 6.0, 2.0), (2.0, 2.0), (4.0, 4.0))


def shells(depth, turn):
    """Boxes, each within the one before; every other one inside out if they turn."""
    made = [box((float(k),) * 3, (float(20 - k),) * 3) for k in range(depth)]
    return [joined(*(turned(b) if turn and k % 2 else b for k, b in enumerate(made))), box((-1.0, 9.0, 9.0), (21.0, 11.0, 11.0))]


def strip(n, height, slope=0.0):
    """A strip of 2 n triangles over the square from 0 to 4."""
    v = [(4.0 * i / n, y, height(4.0 * i / n) + slope * y) for i in range(n + 1) for y in (0.0, 4.0)]
    return v, [t for i in range(n) for t in ((2 * i, 2 * i + 2, 2 * i + 1), (2 * i + 1, 2 * i + 2, 2 * i + 3))]


def fan(n, top):
    """n triangles round an upright edge."""
    places = ((3, 0), (2, 2), (0, 3), (-2, 2), (-3, 0), (-2, -2), (0, -3), (2, -2))
    return soup(*(((0.0, 0.0, -1.0), (0.0, 0.0, 1.0), (float(x), float(y), top)) for x, y in places[:n]))


def needles(n, width):
    """Needles through a square, side by side."""
    return soup(*(((0.5 + k, 1.0, -4.0), (0.5 + k + width, 1.0, -4.0), (0.5 + k, 1.0, 4.0)) for k in range(n)))


CUT = soup(((-5.0, -5.0, 0.0), (5.0, -5.0, 0.25), (0.0, 6.0, -0.25)))
UTM = (1.0, (450000.1, 5600000.7, -1234.5))
CASES |= {f"pair-{name}": (pair(t), False) for name, t in PAIRS.items()}
CASES |= {f"pair-{name}-in-tenths": (placed(pair(t), 0.1, (0.1, 0.2, 0.3)), False) for name, t in PAIRS.items()}
CASES |= {f"pair-{name}-in-utm": (placed(pair(t), *UTM), False) for name, t in PAIRS.items()}
CASES |= {f"boxes-{'-'.join(names)}": (boxes(names), True) for names in itertools.combinations_with_replacement(RANGES, 3)}
CASES |= {f"shells-{depth}{'-facing-both-ways' if turn else ''}": (shells(depth, turn), True)
          for depth in (2, 3, 4) for turn in (False, True)}
CASES |= {f"frame-{name}": ([FRAME, other], True) for name, other in {
    "and-a-bar-through-its-hole": box((2.5, 2.5, -1.0), (3.5, 3.5, 3.0)),
    "and-a-bar-that-fills-its-hole": box((2.0, 2.0, -1.0), (4.0, 4.0, 3.0)),
    "and-a-bar-wider-than-its-hole": box((1.0, 1.0, -1.0), (5.0, 5.0, 3.0)),
    "and-a-bar-across": box((-1.0, 2.5, 0.5), (7.0, 3.5, 1.5)),
    "and-a-cube-in-its-wall": box((0.5, 0.5, 0.5), (1.5, 1.5, 1.5)),
    "and-a-frame-that-links": frame((3.0, 2.5, -2.0), (9.0, 8.5, 4.0), (3.25, 5.0), (8.0, 8.0)),
    "on-a-frame": moved(FRAME, (0.0, 0.0, 2.0)),
    "across-a-frame": moved(FRAME, (3.0, 3.0, 1.0)),
    "of-the-same-place": FRAME,
    "and-an-octahedron-in-its-hole": octahedron((3.0, 3.0, 1.0), 1.0)}.items()}
CASES |= {f"sheets-{k}-in-one-plane": ([moved(FLAT, (0.5 * i, 0.75 * i, 0.0)) for i in range(k)], False) for k in (3, 4, 5)}
CASES |= {f"sheets-{k}-in-one-place": ([FLAT] * k, False) for k in (2, 3, 6)}
CASES |= {f"sheets-{n}-apart-by-{n}-spacings": ([FLAT, moved(FLAT, (0.0, 0.0, n * ULP))], False) for n in (1, 2, 4)}
CASES |= {f"sheets-cross-at-{n}-spacings": ([strip(2, lambda x, n=n: n * ULP * (x - 2)), strip(2, lambda x: 0.0)], False)
          for n in (1, 2, 3, 8)}
CASES |= {f"sheets-in-waves-{n}-{m}": ([strip(n, lambda x: abs(x - 2) - 1), strip(m, lambda x: 0.25 * x - 0.5, 0.125)], False)
          for n, m in ((2, 2), (4, 2), (4, 3), (6, 5), (8, 7))}
CASES |= {f"fan-of-{n}-and-a-cut": ([fan(n, 0.25), CUT], False) for n in range(3, 9)}
CASES |= {f"fan-of-{n}-alone": ([fan(n, 2.0)], False) for n in (3, 5, 8)}
CASES |= {f"needles-{n}-of-width-{name}": ([FLAT, needles(n, width)], False)
          for n in (1, 3) for name, width in (("a-thousandth", 2.0 ** -10), ("a-millionth", 2.0 ** -20), ("a-spacing", ULP))}
CASES |= {f"octahedra-{name}": ([octahedron((0.0,) * 3, 2.0), octahedron(c, r)], True) for name, c, r in (
    ("share-an-edge", (2.0, 2.0, 0.0), 2.0), ("nested", (0.0,) * 3, 1.0), ("nested-and-touching", (1.0, 0.0, 0.0), 1.0),
    ("share-a-face-plane", (1.0, 1.0, 0.0), 2.0), ("a-spacing-apart", (4 + 4 * ULP, 0.0, 0.0), 2.0),
    ("in-thirds", (1 / 3, 2 / 3, 1 / 7), 5 / 3), ("far-from-zero", (2.0 ** 40, 0.0, 0.0), 1.0),
    ("within-a-spacing", (2 * ULP, 0.0, 0.0), 2.0), ("huge", (2.0 ** 400, 2.0 ** 399, 0.0), 2.0 ** 400))}
CASES |= {f"lattice-{size}-{n}-{seed}": ([lattice(seed, n, size)], False)
          for seed, (size, n) in enumerate(((1, 6), (1, 10), (2, 6), (2, 9), (2, 12), (3, 8), (3, 10), (4, 12)))}
CASES |= {f"lattice-{size}-{n}-{seed}": ([lattice(seed, n, size)], False)
          for seed, (size, n) in enumerate(itertools.product((1, 2, 3, 4, 6, 9), (5, 7, 9, 11, 14)), 8)}
CASES |= {f"lattice-in-tenths-{seed}": (placed([lattice(seed, 8, 4)], 0.1, (0.0,) * 3), False) for seed in range(100, 112)}
CASES |= {f"lattice-in-utm-{seed}": (placed([lattice(seed, 8, 4)], *UTM), False) for seed in range(112, 120)}
CASES |= {f"lattices-{k}-surfaces-{seed}": ([lattice(seed + i, 4, 3) for i in range(k)], False) for seed, k in ((120, 2), (130, 3), (140, 4))}


def write(name, operands, solids):
    files = [f"{name}-{letter}.off" for letter, _ in zip("abcdef", operands)]
    for file, (v, t) in zip(files, operands):
        (HERE / file).write_text(f"OFF\n{len(v)} {len(t)} 0\n" + "".join("%r %r %r\n" % p for p in v) + "".join("3 %d %d %d\n" % k for k in t))
    case = {"format": "terrane-case 1", "name": name, "inputs": files} | ({"booleans": {}} if solids else {})
    case |= check_case.derived(case, HERE)
    lines = (f" {json.dumps(key)}: {json.dumps(value)}" for key, value in case.items())
    (HERE / f"{name}.json").write_text("{\n" + ",\n".join(lines) + "\n}\n")


def terrane_answers(case):
    """The answers of Terrane that a case has, in its form."""
    import terrane
    surfaces = [s for name in case["inputs"] for s in terrane.read(str(HERE / name))]
    exact = terrane.arrange(surfaces)
    places = [tuple(map(str, exact.coordinates(v))) for v in range(len(exact.vertices))]
    number = {tuple(p): i for i, p in enumerate(case["points"])}
    on = {}
    for corners, parents in zip(exact.triangles, exact.parents_of):
        for parent, corner in itertools.product(parents, corners):
            on.setdefault(str(parent), set()).add(number.get(places[corner], -1))
    first = {str(k) for k in case["points_on"]}
    blocks = sorted(terrane.volumes(exact).exact().values())
    return {"points": sorted(map(list, places), key=lambda p: number.get(tuple(p), -1)),
            "points_on": {key: sorted(v) for key, v in sorted(on.items(), key=lambda i: int(i[0])) if key in first},
            "contacts": sorted([int(a), int(b)] for a, b in (c.triangles for c in terrane.check(surfaces).contacts)),
            "curves": sorted(sorted(number.get(places[v], -1) for v in edge) for edge in exact.intersection_edges),
            "blocks": [str(v) for v in blocks]}


def breaks_a_law(case):
    """Whether union and intersection of two solids do not add up to both, or their difference not to the first."""
    if "booleans" not in case or len(case["inputs"]) != 2:
        return False
    union, both, rest, odd = (Fraction(case["booleans"][key]) for key in ("union", "intersection", "difference", "symmetric-difference"))
    alone = [Fraction(check_case.derived(case | {"inputs": [name]}, HERE)["booleans"]["union"]) for name in case["inputs"]]
    return union + both != sum(alone) or rest + both != alone[0] or odd != union - both


def compare(paths):
    wrong = 0
    for path in map(pathlib.Path, paths):
        case = json.loads(path.read_text())
        different = [key for key, value in terrane_answers(case).items() if case[key] != value]
        if breaks_a_law(case):
            different.append("booleans")
        if different:
            wrong += 1
            print(f"{path.name}: {', '.join(different)}")
    print(f"{len(paths)} cases, {wrong} differ")
    return 1 if wrong else 0


if __name__ == "__main__":
    if sys.argv[1:2] == ["--compare"]:
        sys.exit(compare(sys.argv[2:] or sorted(HERE.glob("*.json"))))
    for case_name, (made, closed) in CASES.items():
        if sys.argv[1:] in ([], [case_name]):
            write(case_name, made, closed)
