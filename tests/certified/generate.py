#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes the inputs of the certified cases that are made by rule: generate.py [FOLDER].

A case is a function: its name is the folder's, its first line says what is hard about it, and it
returns {surface: (vertices, triangles)}. scripts/record_certified.sh --all records what is expected.
"""
import math
import pathlib
import random
import sys

from pairs import contact_inexact_segment, coplanar_grids  # and its cases come first
from shapes import CASES, all_moved, box, case, grid, joined, moved, pair, quad, tetrahedron, tri, turned

HERE = pathlib.Path(__file__).resolve().parent
DATA = HERE.parent / "data"


# --- Three and more ---------------------------------------------------------------------------

def square(axis, size=4.0, at=0.0):
    corners = [(-size, -size), (size, -size), (size, size), (-size, size)]
    place = {0: lambda u, v: (at, u, v), 1: lambda u, v: (v, at, u), 2: lambda u, v: (u, v, at)}
    return quad(*(place[axis](*c) for c in corners))

@case
def triple_point():
    """three squares meet in a point"""
    return {"x": square(0), "y": square(1), "z": square(2)}

@case
def triple_point_inexact():
    """three planes meet in a point that is no double"""
    return {"a": tri((-9, -7, -1), (11, -6, 2), (1, 13, 1)), "b": tri((-8, 1, -9), (9, 2, -7), (1, -1, 12)),
            "c": tri((1, -9, -8), (2, 12, -7), (-1, 1, 11))}

@case
def triple_line():
    """three triangles share a segment of their insides"""
    return {n: tri((0, 0, -4), (0, 0, 4), p) for n, p in
            {"a": (5, 1, 0), "b": (-4, 3, 1), "c": (1, -5, -1)}.items()}

@case
def triple_line_inside():
    """three squares through one line"""
    wall = lambda x, y: quad((-x, -y, -3), (x, y, -3), (x, y, 3), (-x, -y, 3))
    return {"a": wall(4, 1), "b": wall(1, 4), "c": wall(-3, 2)}

@case
def four_planes_in_a_point():
    """any three of four planes meet in the same point"""
    return {"x": square(0), "y": square(1), "z": square(2),
            "d": quad((-5, 5, -4), (5, -5, -4), (5, -5, 4), (-5, 5, 4))}

@case
def point_named_in_many_ways():
    """an edge, a corner and three planes in one point"""
    return {"x": square(0), "y": square(1), "z": square(2), "e": tri((-1, -2, -3), (1, 2, 3), (9, 0, 1)),
            "v": tri((0, 0, 0), (3, 4, 7), (4, 3, 7))}

@case
def fan_on_an_edge():
    """six triangles on one edge, crossed by a seventh"""
    fan = [tri((0, 0, -2), (0, 0, 2), (math.floor(8 * math.cos(k)), math.floor(8 * math.sin(k)), 0))
           for k in range(6)]
    return {"fan": joined(*fan), "cut": tri((-9, -9, 0.5), (9, -9, 0.5), (0, 14, 0.5))}


# --- Sets of fractures ------------------------------------------------------------------------

def fracture(rng, centre, size, planes=None):
    normal = [rng.uniform(-1, 1) for _ in range(3)]
    if planes is not None:
        normal = planes
    length = math.sqrt(sum(n * n for n in normal))
    n = [c / length for c in normal]
    a = (0, -n[2], n[1]) if abs(n[0]) < 0.9 else (-n[2], 0, n[0])
    la = math.sqrt(sum(c * c for c in a))
    a = [c / la for c in a]
    b = (n[1] * a[2] - n[2] * a[1], n[2] * a[0] - n[0] * a[2], n[0] * a[1] - n[1] * a[0])
    at = lambda u, v: tuple(centre[k] + size * (u * a[k] + v * b[k]) for k in range(3))
    return quad(at(-1, -1), at(1, -1), at(1, 1), at(-1, 1))

def network(count, size, seed):
    rng = random.Random(seed)
    return {f"f{i}": fracture(rng, [rng.uniform(-1, 1) for _ in range(3)], size) for i in range(count)}

@case
def fractures_8():
    """eight square fractures at random"""
    return network(8, 1.2, 8)

@case
def fractures_20():
    """twenty, with many triple points"""
    return network(20, 1.0, 20)

@case
def fractures_grid():
    """three orthogonal sets of three: 27 triple points"""
    return {f"{'xyz'[axis]}{at}": square(axis, 4.0, float(at)) for axis in range(3) for at in (-2, 0, 1)}

def close_angles(angle, count=4):
    return {f"f{k}": quad((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)) if k == 0 else
            quad((-1, -1, -k * angle), (1, -1, -k * angle), (1, 1, k * angle), (-1, 1, k * angle))
            for k in range(count)}

@case
def close_angle_1e3():
    """planes through one line, 1e-3 apart"""
    return close_angles(1e-3)

@case
def close_angle_1e9():
    """planes through one line, 1e-9 apart"""
    return close_angles(1e-9)

@case
def close_angle_1e15():
    """planes through one line, 1e-15 apart"""
    return close_angles(1e-15)

@case
def close_angle_turned():
    """planes through nearly one line, all coordinates rounded"""
    return all_moved(close_angles(1e-9), turned)

@case
def ends_nearly_meet():
    """fractures end a step of a double before, in and behind another"""
    wall = lambda end: quad((end, -1, -1), (3, -1, -1), (3, 1, 1), (end, 1, 1))
    return {"plane": square(0, 4.0, 1.0), "before": wall(math.nextafter(1, 2)),
            "at": moved(wall(1.0), lambda x, y, z: (x, y + 0.25, z)),
            "behind": moved(wall(math.nextafter(1, 0)), lambda x, y, z: (x, y + 0.5, z))}

@case
def tips_touch():
    """corners of fractures on edges and corners of others"""
    return {"a": quad((0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)),
            "b": quad((4, 2, 0), (7, 2, 2), (7, 2, -2), (5, 2, -2)),
            "c": quad((2, 4, 0), (2, 7, 2), (2, 7, 5), (2, 4, 3)),
            "d": quad((4, 4, 0), (6, 6, 2), (6, 6, 4), (4, 4, 2))}

@case
def junction_t():
    """a wall ends on another"""
    return {"wall": square(0, 3.0), "foot": quad((0, -2, -2), (3, -2, -2), (3, -2, 2), (0, -2, 2))}

@case
def junction_x():
    """two walls and a floor cross"""
    return {"a": quad((-3, -3, -2), (3, 3, -2), (3, 3, 2), (-3, -3, 2)),
            "b": quad((-3, 3, -2), (3, -3, -2), (3, -3, 2), (-3, 3, 2)), "floor": square(2)}

@case
def junction_y():
    """three walls end on one line, a floor crosses them"""
    wall = lambda x, y: quad((0, 0, -2), (x, y, -2), (x, y, 2), (0, 0, 2))
    return {"a": wall(3, 0), "b": wall(-2, 3), "c": wall(-2, -3), "floor": square(2)}


# --- Solids: coplanar faces, triple intersections, contacts in corners and edges --------------

@case
def cubes_overlap():
    """two boxes cross in general position"""
    return {"a": box(0, 0, 0, 4, 4, 4), "b": box(1, 2, 3, 5, 6, 7)}

@case
def cubes_coplanar_face():
    """faces overlap in part, from either side"""
    return {"a": box(0, 0, 0, 4, 4, 4), "b": box(4, 1, 1, 7, 6, 6)}

@case
def cubes_same_planes():
    """two boxes, one within the other, three faces in common planes"""
    return {"a": box(0, 0, 0, 4, 4, 4), "b": box(0, 0, 0, 2, 3, 1)}

@case
def cubes_edge_contact():
    """an edge of each in a line"""
    return {"a": box(0, 0, 0, 4, 4, 4), "b": box(4, 4, 1, 7, 7, 6)}

@case
def cubes_corner_contact():
    """touch in a corner"""
    return {"a": box(0, 0, 0, 4, 4, 4), "b": box(4, 4, 4, 7, 7, 7)}

@case
def cubes_three():
    """three boxes with a common corner region: all planes cross"""
    return {"a": box(0, 0, 0, 4, 4, 4), "b": box(2, 2, 2, 6, 6, 6), "c": box(1, 3, -1, 5, 5, 5)}

@case
def tetrahedra_corner_on_face():
    """the tip of one on a face of the other, one surface"""
    return {"both": joined(tetrahedron((0, 0, 0), (6, 0, 0), (0, 6, 0), (0, 0, 6)),
                           tetrahedron((2, 1, 0), (1, 1, -4), (3, 1, -4), (2, 3, -4)))}

@case
def tetrahedra_star():
    """two tetrahedra through each other"""
    return {"a": tetrahedron((4, 4, 4), (4, -4, -4), (-4, 4, -4), (-4, -4, 4)),
            "b": tetrahedron((-4, -4, -4), (-4, 4, 4), (4, -4, 4), (4, 4, -4))}

@case
def planes_round_a_point():
    """eight triangles round one corner, crossed by a tilted one through it"""
    rim = [(5, 0, 2), (4, 4, -1), (0, 5, 2), (-4, 4, -1), (-5, 0, 2), (-4, -4, -1), (0, -5, 2), (4, -4, -1)]
    return {"cone": ([(0, 0, 0)] + rim, [(0, i + 1, (i + 1) % 8 + 1) for i in range(8)]),
            "plane": tri((-9, -9, -1), (9, -9, -1), (0, 18, 2))}

@case
def moebius():
    """a band that can't be oriented, crossed by a plane"""
    n, v, t = 12, [], []
    for i in range(n):
        a = 2 * math.pi * i / n
        for s in (-1, 1):
            r = 3 + s * math.cos(a / 2)
            v.append((r * math.cos(a), r * math.sin(a), s * math.sin(a / 2)))
    for i in range(n):
        a, b = 2 * i, 2 * i + 1
        c, d = (a + 2, b + 2) if i + 1 < n else (1, 0)
        t += [(a, b, c), (b, d, c)]
    return {"band": (v, t), "plane": square(2, 5.0, 0.125)}

@case
def crosses_itself():
    """one surface that runs through itself"""
    return {"fold": grid(8, 4, lambda u, v: (math.sin(3 * u) + v / 8, 2 * v, math.sin(6 * u + v)), 0, 2)}


# --- Scales -----------------------------------------------------------------------------------

def model():
    top = grid(5, 5, lambda x, y: (x, y, 0.1 * math.sin(5 * x) * math.cos(4 * y)))
    base = grid(4, 6, lambda x, y: (x, y, -0.2 + 0.15 * math.cos(6 * x + y)))
    fault = grid(2, 3, lambda s, z: (0.3 + 0.3 * s + 0.2 * z, 0.1 + 0.8 * s, z), 0, 1, -0.5, 0.4)
    return {"top": top, "base": base, "fault": fault}

@case
def horizons_and_fault():
    """two horizons that cross, and a fault through both"""
    return model()

@case
def utm():
    """the same in UTM metres"""
    return all_moved(model(), lambda x, y, z: (432100.25 + 900 * x, 5678900.5 + 900 * y, -1500 + 900 * z))

@case
def utm_millimetres():
    """a model of a millimetre in UTM metres: few bits are left"""
    return all_moved(model(), lambda x, y, z: (432100.25 + 1e-3 * x, 5678900.5 + 1e-3 * y, -1500 + 1e-3 * z))

@case
def subnormal():
    """coordinates of a few thousand times the smallest double"""
    return all_moved(triple_point_inexact(), lambda *p: tuple(c * 4096 * 5e-324 for c in p))

@case
def smallest():
    """coordinates of a few times the smallest double: hardly a point between them"""
    return all_moved(contact_inexact_segment(), lambda *p: tuple(c * 8 * 5e-324 for c in p))

@case
def huge():
    """coordinates of 1e38"""
    return all_moved(triple_point_inexact(), lambda *p: tuple(c * 1e38 for c in p))

@case
def nearly_too_large():
    """coordinates of 1e307: squares overflow"""
    return all_moved(triple_point_inexact(), lambda *p: tuple(c * 1e306 for c in p))

@case
def mixed_scales():
    """x of 1e30, y of 1, z of 1e-30"""
    return all_moved(triple_point_inexact(), lambda x, y, z: (x * 1e30, y, z * 1e-30))

@case
def far_away():
    """a small model far from the origin"""
    return all_moved(model(), lambda *p: tuple(1e9 + c for c in p))

@case
def negative_zero():
    """0.0 and -0.0 are one point"""
    return pair(((0.0, 0.0, 0.0), (4, 0.0, 0.0), (0.0, 4, 0.0)), ((-0.0, -0.0, 0.0), (4, 0, -0.0), (1, 1, 3)))


# --- Nearly coplanar, thin, one step of a double apart ----------------------------------------

@case
def turned_grids():
    """two triangulations of one rectangle, rotated and rounded"""
    return all_moved(coplanar_grids(), turned)

@case
def turned_half():
    """two grids, coplanar in one half, rotated and rounded"""
    ridge = lambda x, y: (x, y, 0.5 * max(0.0, x - 0.5))
    return all_moved({"a": grid(6, 6, lambda x, y: (x, y, 0.0)), "b": grid(4, 4, ridge)}, turned)

@case
def turned_ridges():
    """ridges that touch along lines, rotated and rounded"""
    up = grid(6, 3, lambda x, y: (x, y, abs((6 * x) % 2 - 1) / 8))
    down = grid(6, 3, lambda x, y: (x, y + 0.01, 0.25 - abs((6 * x) % 2 - 1) / 8))
    return all_moved({"up": up, "down": down}, turned)

@case
def nearly_coplanar_integers():
    """integers in a plane, a few moved by one, times 2^-40"""
    rng = random.Random(40)
    surfaces = {}
    for name in "abc":
        def height(x, y):
            i, j = round(x), round(y)
            return (i * 2.0**-40, j * 2.0**-40, (3 * i - 2 * j + rng.choice((-1, 0, 0, 0, 1))) * 2.0**-40)
        n = {"a": 3, "b": 4, "c": 5}[name]
        surfaces[name] = grid(n, n, height, 0, 60, 0, 60)
    return surfaces

@case
def needles():
    """twenty needles, 1e-9 thick, through a plane"""
    thin = [tri((0.1 * k, 0.31 * k, -1), (0.1 * k + 1e-9, 0.31 * k, -1), (0.1 * k, 0.3 * k + 0.1, 1))
            for k in range(20)]
    return {"needles": joined(*thin), "plane": square(2, 8.0, 1 / 3)}

@case
def needle_tip():
    """a needle one unit in the last place wide: its tip is cut off and has no area when rounded"""
    high = 1 + 2.0**-52
    sheet = joined(tri((0, 1, 0), (0.5, 0, 0), (1, 1, 0)), tri((0, 1, 0), (0.5, high, 0), (0.5, 2, 0)),
                   tri((0.5, high, 0), (1, 1, 0), (0.5, 2, 0)))
    return {"needle": tri((0, 1, 0), (1, 1, 0), (0.5, high, 0)), "sheet": sheet,
            "wall": tri((0.1, 0.5, -1), (0.1, 1.5, -1), (0.1, 1, 1))}

@case
def slivers():
    """strips of triangles that are a million times longer than wide"""
    strip = lambda f: grid(10, 1, f, 0, 10, 0, 1e-6)
    return {"along": strip(lambda x, y: (x, y, 0.0)), "across": strip(lambda x, y: (5 + y, x - 5, y / 3)),
            "over": strip(lambda x, y: (x, y, 1e-7 - 3e-8 * x))}

@case
def one_ulp_apart():
    """two sheets, one step of a double apart"""
    return {"a": grid(3, 3, lambda x, y: (x, y, 1.0)), "b": grid(2, 2, lambda x, y: (x, y, math.nextafter(1, 2)))}

@case
def one_ulp_checkered():
    """two sheets that are alternately one step of a double above and below each other"""
    def sheet(sign):
        return grid(5, 5, lambda x, y: (x, y, math.nextafter(1, 2 if (round(5 * x) + round(5 * y)) % 2 == sign else 0)))
    return {"a": sheet(0), "b": sheet(1)}

@case
def one_ulp_tilted():
    """a triangle that leaves the plane by one step of a double"""
    return pair(((0, 0, 1), (8, 0, 1), (0, 8, 1)), ((1, 1, math.nextafter(1, 2)), (6, 1, 1.0), (1, 6, math.nextafter(1, 0))))


# --- Parts of models (see tests/data/README.md for origin and licence) ------------------------

def read_ts(path):
    """The triangles of each GOCAD surface, in the order of the file."""
    surfaces, points = [], {}
    for line in path.read_text(errors="replace").splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "GOCAD":
            points = {}
            surfaces.append([])
        elif words[0] in ("VRTX", "PVRTX"):
            points[words[1]] = tuple(float(c) for c in words[2:5])
        elif words[0] == "TRGL":
            surfaces[-1].append(tuple(points[w] for w in words[1:4]))
    return surfaces

def nearest_triangles(surfaces, centre, count, most=1):
    """Of the `most` surfaces nearest to a point, the `count` triangles nearest to it."""
    def away(t):
        return math.dist([sum(p[k] for p in t) / 3 for k in range(3)], centre)
    near = [(i, sorted(s, key=away)[:count]) for i, s in enumerate(surfaces) if s]
    near.sort(key=lambda entry: away(entry[1][0]))
    return {f"s{i}": joined(*(tri(*t) for t in part)) for i, part in near[:most]}

@case
def part_of_faults():
    """faults near the point where two of them meet (arch-platform)"""
    surfaces = read_ts(DATA / "arch-platform" / "faults.ts")
    box_of = lambda s: [sum(p[k] for t in s for p in t) / (3 * len(s)) for k in range(3)]
    return nearest_triangles(surfaces, box_of(surfaces[0]), 40, 6)

@case
def part_of_relief():
    """a relief and the plane through the middle of it (arch-platform)"""
    surface = read_ts(DATA / "arch-platform" / "mnt.ts")[0]
    middle = surface[len(surface) // 2][0]
    part = nearest_triangles([surface], middle, 120)["s0"]
    low = [min(p[k] for p in part[0]) for k in range(3)]
    high = [max(p[k] for p in part[0]) for k in range(3)]
    z = (low[2] + high[2]) / 2
    return {"relief": part, "water": quad((low[0], low[1], z), (high[0], low[1], z), (high[0], high[1], z), (low[0], high[1], z))}

@case
def fault_and_planes():
    """a fault, cut by planes through its middle (ImplicitBenchmark)"""
    surfaces = read_ts(DATA / "implicit-benchmark" / "Fault.ts")
    fault = joined(*(tri(*t) for t in surfaces[0]))
    low = [min(p[k] for p in fault[0]) for k in range(3)]
    high = [max(p[k] for p in fault[0]) for k in range(3)]
    planes = {}
    for k, name in enumerate("xyz"):
        a, b = [list(low), list(high)]
        i, j = (k + 1) % 3, (k + 2) % 3
        a[k] = b[k] = (low[k] + high[k]) / 2
        c, d = list(a), list(a)
        c[i], d[j] = high[i], high[j]
        planes[name] = quad(tuple(a), tuple(c), tuple(b), tuple(d))
    return {"fault": fault, **planes}


def to_obj(model_, comment):
    lines, base = [f"# {comment}"], 1
    for name, (vertices, triangles) in model_.items():
        lines += ["v " + " ".join(repr(c) for c in v) for v in vertices]
        lines.append(f"g {name}")
        lines += ["f " + " ".join(str(base + i) for i in t) for t in triangles]
        base += len(vertices)
    return "\n".join(lines) + "\n"


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
    for name, make in CASES.items():
        (folder / name).mkdir(parents=True, exist_ok=True)
        (folder / name / "input.obj").write_text(to_obj(make(), make.__doc__))
    print(f"{len(CASES)} cases")


if __name__ == "__main__":
    main()
