#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Makes the cases of this folder: OFF files, and answers that docs/examples/python/check_case.py derives.

    tests/corpus/make.py                              makes all cases again
    PYTHONPATH=build/release/python tests/corpus/make.py --compare   compares Terrane's answers with theirs
"""
import itertools
import json
import pathlib
import random
import sys

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
} | {f"lattice-{size}-{n}-{seed}": ([lattice(seed, n, size)], False)
     for seed, (size, n) in enumerate(((1, 6), (1, 10), (2, 6), (2, 9), (2, 12), (3, 8), (3, 10), (4, 12)))}


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


def compare():
    wrong = 0
    for path in sorted(HERE.glob("*.json")):
        case = json.loads(path.read_text())
        different = [key for key, value in terrane_answers(case).items() if case[key] != value]
        if different:
            wrong += 1
            print(f"{path.name}: {', '.join(different)}")
    print(f"{len(CASES)} cases, {wrong} differ")
    return 1 if wrong else 0


if __name__ == "__main__":
    if sys.argv[1:] == ["--compare"]:
        sys.exit(compare())
    for case_name, (made, closed) in CASES.items():
        write(case_name, made, closed)
