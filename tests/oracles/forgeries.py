#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tells lies in certificates of all kinds, and has `terrane verify` refute each.

    tests/oracles/forgeries.py --terrane build/release/cli/terrane [--seeds 10] [--first 1] [--keep FOLDER]

Each seed makes a certificate of each kind about small random surfaces, and tells each lie about each once, at a random
place. A lie leaves out the output files, so that the certificate itself must be refuted, and a lie about the mesh of
doubles states its true regions and the largest deviation that is accepted. A wrong digest alone does not count; a
verdict that counts differences from the exact part does. Prints the lies that are believed, and honest certificates
that are refuted; status 1 if there are any, or if a lie could not be told in any seed.
"""
import argparse
import copy
import fractions
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile


# ---- Surfaces

def sheet(rng, n, at, bumps, turned=False):
    """A grid of n x n squares; at(u, v) is a point."""
    points = []
    for i in range(n + 1):
        for j in range(n + 1):
            x, y, z = at(i / n, j / n)
            points.append((x, y, z + rng.uniform(-bumps, bumps)))
    triangles = []
    for i in range(n):
        for j in range(n):
            a, b, c, d = i * (n + 1) + j, (i + 1) * (n + 1) + j, (i + 1) * (n + 1) + j + 1, i * (n + 1) + j + 1
            triangles += [(a, b, c), (a, c, d)] if rng.random() < 0.5 else [(a, b, d), (b, c, d)]
    return points, [t[::-1] for t in triangles] if turned else triangles


def cube(x, y, z, size):
    points = [(x + i * size, y + j * size, z + k * size) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return points, [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]


def write(file, surface):
    points, triangles = surface
    file.write_text("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points) +
                    "".join("f {} {} {}\n".format(*(v + 1 for v in t)) for t in triangles))


def write_models(rng, folder):
    def horizon(z, slope):
        return lambda u, v: (10 * u, 10 * v, z + slope * u)
    a, b = rng.uniform(-1, 1), rng.uniform(0.5, 2)
    write(folder / "top.obj", sheet(rng, 4, horizon(5, a), 0.2))
    write(folder / "base.obj", sheet(rng, 4, horizon(1, -a), 0.2))
    write(folder / "fault.obj", sheet(rng, 3, lambda u, v: (4 + b * v, -1 + 12 * u, -1 + 7 * v), 0.1))
    write(folder / "cross.obj", sheet(rng, 4, horizon(3, 4), 0.1))
    write(folder / "floor.obj", sheet(rng, 3, horizon(1, 0), 0.02))
    write(folder / "roof.obj", sheet(rng, 3, horizon(4, 0), 0.02))
    write(folder / "wall.obj", sheet(rng, 3, lambda u, v: (4 + b * v, 1 + 8 * u, 1.3 + 2.4 * v), 0))
    write(folder / "outer.obj", cube(0, 0, 0, 8.0 + b))
    write(folder / "inner.obj", cube(1 + b, 2, 1, 2.0))
    points, triangles = sheet(rng, 6, horizon(0, a), 0.1)
    left = [t for t in triangles if (min(v // 7 for v in t), min(v % 7 for v in t)) not in ((2, 2), (4, 4))]
    write(folder / "holes.obj", (points, left))


COMMANDS = {
    "arrangement": ["arrange", "top.obj", "base.obj", "fault.obj", "cross.obj", "-o", "out.obj"],
    "volumes": ["volume", "outer.obj", "inner.obj", "cross.obj", "-o", "out"],
    "tetrahedra": ["tetrahedralize", "outer.obj", "inner.obj", "top.obj", "-o", "out.vtu"],
    "improved": ["improve", "top.obj", "outer.obj", "inner.obj", "-o", "out.obj"],
    "filled": ["fill", "holes.obj", "top.obj", "-o", "out.obj"],
    "layered": ["layer", "--hard", "top.obj", "--soft", "cross.obj", "--keep", "lower", "-o", "out.obj"],
    "cut": ["arrange", "top.obj", "fault.obj", "-o", "out.obj", "--box", "1,1,0,9,9,6"],
    "sealed": ["arrange", "floor.obj", "roof.obj", "wall.obj", "-o", "out.obj", "--seal", "0.6"],
}


# ---- Lies: functions of a certificate and random numbers; None where there is nothing to lie about

LIES = {}


def lie(*kinds):
    def add(function):
        for kind in kinds:
            LIES[kind, function.__name__] = function
        return function
    return add


MESHES = ("arrangement", "volumes", "tetrahedra", "improved", "cut", "sealed")
PARTS = {"improved": "improved", "layered": "layered", "filled": "filled"}


def mesh_of(c):
    """The mesh of doubles that the certificate is about."""
    return c[PARTS.get(c["kind"], "rounded")]


def lists_of(part):
    """The names of the lists with one entry per triangle."""
    n = len(part["triangles"])
    return [k for k, v in part.items() if isinstance(v, list) and len(v) == n and k not in ("vertices", "limits")]


def point(mesh, v):
    return [float(x) for x in mesh["vertices"][v]]


def put(mesh, v, p):
    mesh["vertices"][v] = [repr(x) if x != int(x) else str(int(x)) for x in p]


def add_triangle(mesh, like, corners):
    for k in lists_of(mesh):
        if k != "triangles":
            mesh[k].append(copy.deepcopy(mesh[k][like]))
    mesh["triangles"].append(corners)


@lie(*MESHES, "layered")
def all_triangles_turned(c, rng):
    m = mesh_of(c)
    m["triangles"] = [[a, d, b] for a, b, d in m["triangles"]]


@lie(*MESHES, "layered", "filled")
def one_triangle_turned(c, rng):
    t = rng.choice(mesh_of(c)["triangles"])
    t[1], t[2] = t[2], t[1]


@lie(*MESHES)
def a_hole(c, rng):
    m = mesh_of(c)
    t = rng.randrange(len(m["triangles"]))
    for k in lists_of(m):
        del m[k][t]


@lie(*MESHES, "layered")
def a_triangle_twice_with_vertices_of_its_own(c, rng):
    m = mesh_of(c)
    t = rng.randrange(len(m["triangles"]))
    n = len(m["vertices"])
    for v in m["triangles"][t]:
        p = point(m, v)
        m["vertices"].append(None)
        put(m, len(m["vertices"]) - 1, [p[0], p[1], math.nextafter(p[2], math.inf)])
    add_triangle(m, t, [n, n + 1, n + 2])


@lie(*MESHES)
def a_bubble(c, rng):
    """Four triangles around a point near the middle of a triangle, some doubles high."""
    m = mesh_of(c)
    t = rng.randrange(len(m["triangles"]))
    a, b, d = (point(m, v) for v in m["triangles"][t])
    mid = [(x + y + z) / 3 for x, y, z in zip(a, b, d)]
    n, h = len(m["vertices"]), 1e-13
    up = [mid[0], mid[1], mid[2] + 3 * h]
    for p in ([up[0] - h, up[1] - h, up[2]], [up[0] + h, up[1] - h, up[2]], [up[0], up[1] + h, up[2]],
              [up[0], up[1], up[2] + h]):
        m["vertices"].append(None)
        put(m, len(m["vertices"]) - 1, p)
    for corners in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)):
        add_triangle(m, t, [n + k for k in corners])


@lie(*MESHES, "layered")
def a_side_split_for_one_triangle(c, rng):
    m = mesh_of(c)
    sides = [(t, k) for t, of in enumerate(m["triangles"]) for k in range(3)
             if any(s != t and of[k] in o and of[k - 1] in o for s, o in enumerate(m["triangles"]))]
    t, k = rng.choice(sides)
    b, d, a = m["triangles"][t][k:] + m["triangles"][t][:k]
    n = len(m["vertices"])
    m["vertices"].append(None)
    put(m, n, [(x + y) / 2 for x, y in zip(point(m, a), point(m, b))])
    m["triangles"][t] = [a, n, d]
    add_triangle(m, t, [n, b, d])


@lie(*MESHES, "layered")
def a_vertex_torn(c, rng):
    """Some triangles at a vertex get one of their own, a double away."""
    m = mesh_of(c)
    v = rng.choice([v for v in range(len(m["vertices"])) if sum(v in t for t in m["triangles"]) > 2])
    around = [t for t in m["triangles"] if v in t]
    p = point(m, v)
    m["vertices"].append(None)
    put(m, len(m["vertices"]) - 1, [p[0], p[1], math.nextafter(p[2], -math.inf)])
    for t in rng.sample(around, len(around) // 2):
        t[t.index(v)] = len(m["vertices"]) - 1


@lie(*MESHES)
def surfaces_parted_at_their_curve(c, rng):
    """The triangles of one parent's surface get vertices of their own along the intersection."""
    m = mesh_of(c)
    on = {v for e in m["intersection_edges"] for v in e}
    if not on:
        return None
    key = "parents" if "parents" in m else "surfaces"
    first = m[key][0]
    group = {x[0] for x in m[key] if abs(x[0] - first[0]) <= (0 if key == "surfaces" else 20)}
    new = {}
    for t, lists in zip(m["triangles"], m[key]):
        if lists[0] not in group:
            continue
        for k, v in enumerate(t):
            if v in on:
                if v not in new:
                    p = point(m, v)
                    new[v] = len(m["vertices"])
                    m["vertices"].append(None)
                    put(m, new[v], [math.nextafter(p[0], -math.inf), p[1], math.nextafter(p[2], math.inf)])
                t[k] = new[v]
    m["intersection_edges"] = []
    return bool(new) or None


@lie("arrangement", "volumes", "tetrahedra", "cut", "sealed")
def a_curve_opened_at_one_vertex(c, rng):
    """The triangles of one surface get a vertex of their own where it crosses another one, in two edges of the curve."""
    m, of = c["rounded"], surfaces_of(c)
    own = [{of[p] for p in parents} for parents in m["parents"]]
    ends = [v for e in m["intersection_edges"] for v in e]
    inner = [v for v in set(ends) if ends.count(v) == 2]
    places = []
    for v in inner:
        around = [t for t, corners in enumerate(m["triangles"]) if v in corners]
        surfaces = {s for t in around for s in own[t]}
        if len(surfaces) == 2 and all(len(own[t]) == 1 for t in around):
            places.append((v, [t for t in around if own[t] == {max(surfaces)}]))
    if not places:
        return None
    v, side = rng.choice(places)
    p = point(m, v)
    m["vertices"].append(None)
    new = len(m["vertices"]) - 1
    put(m, new, [math.nextafter(p[0], math.inf), p[1], p[2]])
    edges = {tuple(sorted((m["triangles"][t][k], m["triangles"][t][k - 1]))) for t in side for k in range(3)}
    for t in side:
        m["triangles"][t][m["triangles"][t].index(v)] = new
    lost = {e for e in map(tuple, m["intersection_edges"]) if v in e and e in edges}
    m["intersection_edges"] = [e for e in m["intersection_edges"] if tuple(e) not in lost]
    return True


@lie(*MESHES, "layered", "filled")
def two_vertices_exchanged(c, rng):
    v = mesh_of(c)["vertices"]
    a, b = rng.sample(range(len(v)), 2)
    if v[a] == v[b]:
        return None
    v[a], v[b] = v[b], v[a]
    return True


@lie(*MESHES, "layered")
def a_vertex_moved_by_a_thousandth(c, rng):
    m = mesh_of(c)
    if c["kind"] == "improved":
        c["improved"]["limits"] = ["0.0001220703125"] * len(c["improved"]["limits"])
    v = rng.randrange(len(m["vertices"]))
    p = point(m, v)
    put(m, v, [p[0] + 1e-3, p[1] - 1e-3, p[2] + 1e-3])


@lie(*MESHES)
def an_intersection_edge_forgotten(c, rng):
    edges = mesh_of(c)["intersection_edges"]
    if not edges:
        return None
    edges.remove(rng.choice(edges))
    return True


@lie(*MESHES)
def an_intersection_edge_invented(c, rng):
    m = mesh_of(c)
    known = {tuple(e) for e in m["intersection_edges"]}
    edges = sorted({tuple(sorted((t[k], t[k - 2]))) for t in m["triangles"] for k in range(3)} - known)
    m["intersection_edges"] = [list(e) for e in sorted(known | {rng.choice(edges)})]


@lie(*MESHES)
def regions_made_one(c, rng):
    m = mesh_of(c)
    highest = max(max(r) for r in m["regions"])
    if highest == 0:
        return None
    m["regions"] = [[r - (r == highest) for r in of] for of in m["regions"]]
    return True


@lie(*MESHES)
def a_region_divided(c, rng):
    m = mesh_of(c)
    t = rng.randrange(len(m["regions"]))
    m["regions"][t] = [max(max(r) for r in m["regions"]) + 1] * len(m["regions"][t])


@lie("arrangement", "volumes", "tetrahedra", "cut", "sealed")
def a_parent_exchanged(c, rng):
    m = c["rounded"]
    t, s = rng.sample(range(len(m["parents"])), 2)
    if m["parents"][t] == m["parents"][s] or len(m["parents"][t]) != len(m["parents"][s]):
        return None
    m["parents"][t], m["parents"][s] = m["parents"][s], m["parents"][t]
    return True


@lie("arrangement", "volumes", "tetrahedra", "cut", "sealed")
def something_vanished(c, rng):
    m = c["rounded"]
    m["vanished"] = sorted(set(m["vanished"]) | {m["parents"][rng.randrange(len(m["parents"]))][0]})


@lie("arrangement", "volumes", "tetrahedra", "cut", "sealed")
def no_doubles_conforming(c, rng):
    c["rounded"]["clean"] = False


@lie("arrangement", "volumes", "tetrahedra", "improved", "cut", "sealed")
def an_exact_triangle_missing(c, rng):
    e = c["exact"]
    t = rng.randrange(len(e["triangles"]))
    del e["triangles"][t], e["parents"][t]


@lie("arrangement", "volumes", "tetrahedra", "improved", "cut", "sealed")
def exact_triangles_with_other_parents(c, rng):
    p = c["exact"]["parents"]
    t, s = rng.sample(range(len(p)), 2)
    if p[t] == p[s]:
        return None
    p[t], p[s] = p[s], p[t]
    return True


@lie("arrangement", "volumes", "improved", "cut", "sealed")
def an_exact_diagonal_turned(c, rng):
    """Two triangles of one parent get the other diagonal, which only a convex pair of them has: then one is over."""
    e = c["exact"]
    pairs = [(t, s) for t in range(len(e["triangles"])) for s in range(t) if e["parents"][t] != e["parents"][s] and
             len(set(e["triangles"][t]) & set(e["triangles"][s])) == 2]
    if not pairs:
        return None
    t, s = rng.choice(pairs)
    a, b = set(e["triangles"][t]), set(e["triangles"][s])
    (p, q), (r,), (u,) = a & b, a - b, b - a
    e["triangles"][t], e["triangles"][s] = [r, u, p], [u, r, q]
    return True


@lie("arrangement", "volumes", "improved", "cut", "sealed")
def a_vertex_where_no_lines_meet(c, rng):
    made = [v for v in c["exact"]["vertices"] if v[0] != "v"]
    given = [v for v in c["exact"]["vertices"] if v[0] == "v"]
    if not made:
        return None
    v = rng.choice(made)
    others = [g[1] for g in given if g[1] not in v]
    v[1] = rng.choice(others)
    return True


@lie("arrangement", "volumes", "tetrahedra", "improved", "cut", "sealed")
def an_intersection_edge_of_the_exact_part_forgotten(c, rng):
    edges = c["exact"]["intersection_edges"]
    if not edges:
        return None
    edges.remove(rng.choice(edges))
    return True


@lie("arrangement", "volumes", "tetrahedra", "improved", "cut", "sealed")
def a_degenerate_triangle(c, rng):
    c["exact"]["degenerate"] = [c["exact"]["parents"][0][0]]


@lie("arrangement", "volumes", "tetrahedra", "improved", "cut", "sealed")
def a_digest_with_another_digit(c, rng):
    d = c["digest"]
    c["digest"] = d[:-1] + ("0" if d[-1] != "0" else "1")


@lie(*COMMANDS)
def an_input_of_another_size(c, rng):
    rng.choice(c["inputs"])["bytes"] += 1


@lie(*COMMANDS)
def inputs_in_another_order(c, rng):
    if len(c["inputs"]) < 2:
        return None
    files = [(i["name"], i["bytes"], i["sha256"]) for i in c["inputs"]]
    for i, (name, size, sha) in zip(c["inputs"], files[1:] + files[:1]):
        i["name"], i["bytes"], i["sha256"] = name, size, sha
    return True


# ---- Blocks and tetrahedra

@lie("volumes", "tetrahedra")
def volumes_exchanged(c, rng):
    v = c["blocks"]["volumes"]
    a, b = rng.sample(range(len(v)), 2)
    if v[a] == v[b]:
        return None
    v[a], v[b] = v[b], v[a]
    return True


@lie("volumes", "tetrahedra")
def a_volume_a_little_larger(c, rng):
    v = c["blocks"]["volumes"]
    b = rng.randrange(len(v))
    v[b] = str(fractions.Fraction(v[b]) + fractions.Fraction(1, 2 ** 200))


@lie("volumes", "tetrahedra")
def a_fraction_not_reduced(c, rng):
    v = c["blocks"]["volumes"]
    f = fractions.Fraction(v[-1])
    v[-1] = f"{3 * f.numerator}/{3 * f.denominator}"


@lie("volumes", "tetrahedra")
def shells_made_one(c, rng):
    b = c["blocks"]
    if len(b["shells"]) < 2:
        return None
    last = b["shells"].pop()
    b["shells"][-1] = sorted(b["shells"][-1] + last)
    b["block_of_shell"].pop()
    b["around"].pop()
    return True


@lie("volumes", "tetrahedra")
def a_shell_of_another_block(c, rng):
    b = c["blocks"]["block_of_shell"]
    s = rng.randrange(len(b))
    b[s] = (b[s] + 1) % len(c["blocks"]["volumes"])


@lie("volumes", "tetrahedra")
def shells_not_nested(c, rng):
    around = c["blocks"]["around"]
    inner = [s for s, a in enumerate(around) if a is not None]
    if not inner:
        return None
    around[rng.choice(inner)] = None
    return True


@lie("volumes", "tetrahedra")
def another_exact_block(c, rng):
    c["blocks"]["exact"] += rng.choice((-1, 1))


@lie("volumes", "tetrahedra")
def a_block_forgotten(c, rng):
    for k in ("volumes", "names"):
        c["blocks"][k].pop()


@lie("tetrahedra")
def a_tetrahedron_in_another_block(c, rng):
    b = c["tetrahedra"]["blocks"]
    t = rng.randrange(len(b))
    b[t] = (b[t] + 1) % len(c["blocks"]["volumes"])


@lie("tetrahedra")
def a_tetrahedron_missing(c, rng):
    t = rng.randrange(len(c["tetrahedra"]["blocks"]))
    del c["tetrahedra"]["blocks"][t], c["tetrahedra"]["tetrahedra"][t]


@lie("tetrahedra")
def a_tetrahedron_twice(c, rng):
    t = rng.randrange(len(c["tetrahedra"]["blocks"]))
    for k in ("blocks", "tetrahedra"):
        c["tetrahedra"][k].append(copy.copy(c["tetrahedra"][k][t]))


@lie("tetrahedra")
def a_tetrahedron_inverted(c, rng):
    t = rng.choice(c["tetrahedra"]["tetrahedra"])
    t[0], t[1] = t[1], t[0]


@lie("tetrahedra")
def tetrahedra_around_an_edge_missing(c, rng):
    x = c["tetrahedra"]
    a, b = rng.choice(x["tetrahedra"])[:2]
    keep = [t for t, v in enumerate(x["tetrahedra"]) if a not in v or b not in v]
    for k in ("blocks", "tetrahedra"):
        x[k] = [x[k][t] for t in keep]


@lie("tetrahedra")
def a_node_moved(c, rng):
    x = c["tetrahedra"]
    v = rng.choice(rng.choice(x["faces"]))
    put(x, v, [y + 1e-6 for y in point(x, v)])


@lie("tetrahedra")
def a_face_missing(c, rng):
    f = rng.randrange(len(c["tetrahedra"]["faces"]))
    del c["tetrahedra"]["faces"][f], c["tetrahedra"]["triangles"][f]


@lie("tetrahedra")
def faces_on_other_triangles(c, rng):
    t = c["tetrahedra"]["triangles"]
    a, b = rng.sample(range(len(t)), 2)
    if t[a] == t[b]:
        return None
    t[a], t[b] = t[b], t[a]
    return True


@lie("tetrahedra")
def faces_that_are_twins(c, rng):
    c["tetrahedra"]["twins"].append(rng.sample(range(len(c["tetrahedra"]["faces"])), 2))


@lie("tetrahedra")
def another_box(c, rng):
    c["tetrahedra"]["box"] = not c["tetrahedra"]["box"]


# ---- Changed surfaces

@lie("improved", "filled", "sealed")
def a_limit_of_nothing(c, rng):
    if c["kind"] == "improved":
        if all(x == "0" for x in c["improved"]["limits"]) or len(c["improved"]["triangles"]) == len(c["rounded"]["triangles"]):
            return None
        c["improved"]["limits"] = ["0"] * len(c["improved"]["limits"])
        return True
    if c["kind"] == "sealed":
        changed = [s for s in c["sealed"] if s["sealed"] or s["extended"]]
        for s in changed:
            s["limit"] = "0"
        return bool(changed) or None
    for s in c["filled"]["surfaces"]:
        s["limit"] = "-1"
    return True


@lie("improved")
def a_body_turned_around(c, rng):
    """The doubles of a closed sheet, mirrored in its middle: its box stays, its triangles face inwards."""
    m = c["improved"]
    s = len(c["inputs"]) - 1
    own = {v for t, of in zip(m["triangles"], m["surfaces"]) if of == [s] for v in t}
    other = {v for t, of in zip(m["triangles"], m["surfaces"]) if of != [s] for v in t}
    if not own or own & other:
        return None
    low, high = (f(point(m, v)[0] for v in own) for f in (min, max))
    for v in own:
        p = point(m, v)
        put(m, v, [low + high - p[0], p[1], p[2]])
    return True


@lie("improved")
def a_body_shrunk(c, rng):
    m = c["improved"]
    s = len(c["inputs"]) - 1
    own = {v for t, of in zip(m["triangles"], m["surfaces"]) if of == [s] for v in t}
    first = point(m, min(own))
    for v in own:
        put(m, v, [x + (y - x) / 1024 for x, y in zip(first, point(m, v))])


@lie("improved")
def a_surface_of_two(c, rng):
    m = c["improved"]
    t = rng.randrange(len(m["surfaces"]))
    m["surfaces"][t] = [(m["surfaces"][t][0] + 1) % len(c["inputs"])]
    m["regions"][t] = m["regions"][t][:1]


@lie("filled")
def a_filling_triangle_missing(c, rng):
    f = c["filled"]
    t = rng.choice([t for t, h in enumerate(f["invented"]) if h])
    del f["triangles"][t], f["invented"][t]
    f["surfaces"][0]["triangles"] -= 1


@lie("filled")
def a_given_vertex_moved_by_a_bit(c, rng):
    f = c["filled"]
    v = rng.randrange(int(0.8 * len(f["vertices"])))
    p = point(f, v)
    put(f, v, [p[0], p[1], math.nextafter(p[2], math.inf)])


@lie("filled")
def a_given_triangle_that_was_invented(c, rng):
    f = c["filled"]
    f["invented"][f["invented"].index(0)] = 1


@lie("filled")
def an_invented_triangle_that_was_given(c, rng):
    f = c["filled"]
    f["invented"][rng.choice([t for t, h in enumerate(f["invented"]) if h])] = 0


@lie("filled")
def holes_of_one_number(c, rng):
    f = c["filled"]
    if max(f["invented"]) < 2:
        return None
    f["invented"] = [min(h, 1) for h in f["invented"]]
    return True


@lie("filled")
def a_hole_of_two_numbers(c, rng):
    f = c["filled"]
    new = [t for t, h in enumerate(f["invented"]) if h == 1]
    if len(new) < 2:
        return None
    f["invented"][new[0]] = max(f["invented"]) + 1
    return True


@lie("filled")
def a_filling_turned(c, rng):
    f = c["filled"]
    for t, h in zip(f["triangles"], f["invented"]):
        if h == 1:
            t[1], t[2] = t[2], t[1]


@lie("layered")
def layers_in_another_order(c, rng):
    c["layered"]["order"].reverse()


@lie("layered")
def layers_of_other_hardness(c, rng):
    o = c["layered"]["order"]
    o[0]["hardness"], o[1]["hardness"] = o[1]["hardness"], o[0]["hardness"]


@lie("layered")
def a_triangle_in_another_layer(c, rng):
    m = c["layered"]
    single = [t for t, of in enumerate(m["layers"]) if len(of) == 1]
    t = rng.choice(single)
    m["layers"][t] = [1 - m["layers"][t][0]]


@lie("layered")
def a_triangle_in_both_layers(c, rng):
    m = c["layered"]
    single = [t for t, of in enumerate(m["layers"]) if len(of) == 1]
    t = rng.choice(single)
    m["layers"][t], m["regions"][t], m["parents"][t] = [0, 1], 2 * m["regions"][t], m["parents"][t]


@lie("layered")
def a_layer_without_its_largest_triangle(c, rng):
    m = c["layered"]

    def area(t):
        a, b, d = (point(m, v) for v in m["triangles"][t])
        return abs((b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]))
    t = max(range(len(m["triangles"])), key=area)
    for k in lists_of(m):
        del m[k][t]


# ---- Volumes of interest and sealed surfaces

@lie("cut")
def something_outside_kept(c, rng):
    d = c["cut"]["dropped"]
    d.remove(rng.choice(d))


@lie("cut")
def something_inside_dropped(c, rng):
    d = c["cut"]["dropped"]
    rest = sorted(set(range(len(c["exact"]["triangles"]))) - set(d))
    c["cut"]["dropped"] = sorted(d + [rng.choice(rest)])


@lie("cut")
def a_box_a_bit_higher(c, rng):
    b = c["cut"]["volume"]["between"]
    b[1] = repr(math.nextafter(float(b[1]), math.inf))


@lie("cut")
def a_box_of_other_corners(c, rng):
    corner = rng.choice(c["cut"]["volume"]["corners"])
    corner[0] = repr(float(corner[0]) + 2.0 ** -40)


@lie("cut")
def a_box_that_is_a_hexahedron(c, rng):
    c["cut"]["volume"]["shape"] = "surface"


@lie("cut")
def a_boundary_turned(c, rng):
    for part in c["cut"]["volume"]["boundary"]:
        part["triangles"] = [t[::-1] for t in part["triangles"]]


@lie("cut")
def a_boundary_with_a_gap(c, rng):
    c["cut"]["volume"]["boundary"][0]["triangles"].pop()


@lie("sealed")
def an_added_triangle_turned(c, rng):
    added = [t for s in c["sealed"] for t in s["sealed"]]
    if not added:
        return None
    t = rng.choice(added)
    t[1], t[2] = t[2], t[1]
    return True


@lie("sealed")
def an_added_triangle_missing(c, rng):
    some = [s for s in c["sealed"] if s["sealed"]]
    if not some:
        return None
    s = rng.choice(some)["sealed"]
    del s[rng.randrange(len(s))]
    return True


@lie("sealed")
def an_added_triangle_of_another_surface(c, rng):
    some = [k for k, s in enumerate(c["sealed"]) if s["sealed"]]
    if not some:
        return None
    k = rng.choice(some)
    c["sealed"][(k + 1) % len(c["sealed"])]["sealed"].append(c["sealed"][k]["sealed"].pop())
    return True


@lie("sealed")
def an_added_triangle_that_extends(c, rng):
    some = [s for s in c["sealed"] if s["sealed"]]
    if not some:
        return None
    s = rng.choice(some)
    s["extended"].append(s["sealed"].pop(0))
    return True


@lie("sealed")
def an_added_triangle_far_away(c, rng):
    some = [s for s in c["sealed"] if s["sealed"]]
    if not some:
        return None
    t = rng.choice(rng.choice(some)["sealed"])
    t[:] = [[repr(float(x) + 1) for x in p] for p in t]
    return True


@lie("sealed")
def a_given_part_dropped(c, rng):
    d = c["cut"]["dropped"]
    rest = sorted(set(range(len(c["exact"]["triangles"]))) - set(d))
    c["cut"]["dropped"] = sorted(d + [rng.choice(rest)])


# ---- Judging

def verdict(terrane, folder, certificate, name="forged.json"):
    (folder / name).write_text(json.dumps(certificate))
    done = subprocess.run([terrane, "verify", name, "--json"], cwd=folder, capture_output=True, text=True, check=False)
    try:
        return json.loads(done.stdout)
    except json.JSONDecodeError:
        return {"valid": False, "violations": [{"rule": "text", "sentence": done.stderr.strip()}]}


def surfaces_of(c):
    """The surface of each input triangle."""
    counts = [s["triangles"] for i in c["inputs"] for s in i["surfaces"]]
    if c["kind"] == "sealed":
        counts = [n + len(s["extended"]) + len(s["sealed"]) for n, s in zip(counts, c["sealed"])]
    if "cut" in c and c["cut"]["volume"]:
        counts += [len(b["triangles"]) for b in c["cut"]["volume"]["boundary"]]
    return [s for s, n in enumerate(counts) for _ in range(n)]


def regions_of(c):
    """The regions of the mesh of doubles: what its intersection edges leave connected of each surface."""
    mesh, of = c["rounded"], surfaces_of(c)
    own = [sorted({of[p] for p in parents}) for parents in mesh["parents"]]
    curves = {tuple(e) for e in mesh["intersection_edges"]}
    at = {}
    for t, corners in enumerate(mesh["triangles"]):
        for k in range(3):
            edge = tuple(sorted((corners[k], corners[k - 1])))
            if edge not in curves:
                at.setdefault(edge, []).append(t)
    joined, regions, count = {}, [[None] * len(o) for o in own], 0
    for triangles in at.values():
        for t in triangles:
            joined.setdefault(t, set()).update(triangles)
    for surface in range(max(of) + 1):
        for first, surfaces in enumerate(own):
            if surface not in surfaces or regions[first][surfaces.index(surface)] is not None:
                continue
            left = [first]
            while left:
                t = left.pop()
                if surface in own[t] and regions[t][own[t].index(surface)] is None:
                    regions[t][own[t].index(surface)] = count
                    left += joined.get(t, ())
            count += 1
    return regions


def be_modest(forged, honest, accepted):
    """Where the mesh of doubles was changed, states its own regions, no move and as much deviation as is accepted."""
    ours, before = forged.get("rounded"), honest.get("rounded")
    if ours and (ours["vertices"], ours["triangles"]) != (before["vertices"], before["triangles"]):
        ours["deviation"] = repr(accepted * (1 - 2.0 ** -20))
        if ours["triangles"] != before["triangles"]:
            ours["max_move"], ours["regions"] = None, regions_of(forged)


def judge_seed(terrane, seed, folder, told, kept):
    rng = random.Random(seed)
    write_models(rng, folder)
    flaws = []
    for kind, command in COMMANDS.items():
        made = subprocess.run([terrane, *command, "--certificate", f"{kind}.json"], cwd=folder, capture_output=True,
                              text=True, check=False)
        if made.returncode != 0:
            flaws.append(f"seed {seed}: {kind} has no certificate: {made.stderr.strip()[:300]}")
            continue
        honest = json.loads((folder / f"{kind}.json").read_text())
        if honest["kind"] != kind:
            flaws.append(f"seed {seed}: {kind} is of kind {honest['kind']}")
            continue
        honest["outputs"] = []
        if not (said := verdict(terrane, folder, honest))["valid"]:
            flaws.append(f"seed {seed}: {kind} is honest and refuted: {said['violations'][0]}")
            continue
        accepted = said["max_deviation"]
        assert kind in PARTS or regions_of(honest) == honest["rounded"]["regions"]
        for (of, name), tell in LIES.items():
            if of != kind:
                continue
            forged = copy.deepcopy(honest)
            if tell(forged, rng) is None and forged == honest:
                continue
            be_modest(forged, honest, accepted)
            said = verdict(terrane, folder, forged)
            if {v["rule"] for v in said["violations"]} == {"R17"} and not name.startswith("a_digest"):
                said["valid"] = True
            if any(said.get(key) for key in ("lost_meetings", "new_meetings", "turned_edges")):
                said["valid"], said["violations"] = False, [{"rule": "counted"}]  # the verdict tells the difference
            rules = told.setdefault((kind, name), [])
            rules.append("/".join(sorted({v["rule"] for v in said["violations"]})) if not said["valid"] else "believed")
            if said["valid"]:
                flaws.append(f"seed {seed}: {kind}: {name} is believed")
                if kept:
                    kept.mkdir(parents=True, exist_ok=True)
                    (kept / f"{seed}_{kind}_{name}.json").write_text(json.dumps(forged))
    return flaws


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--terrane", required=True)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--rules", action="store_true", help="print which rules refute each lie")
    options = parser.parse_args()
    terrane, told, flaws = str(pathlib.Path(options.terrane).resolve()), {}, []
    for seed in range(options.first, options.first + options.seeds):
        with tempfile.TemporaryDirectory() as name:
            flaws += judge_seed(terrane, seed, pathlib.Path(name), told, options.keep)
    flaws += [f"nobody could tell {kind}: {name}" for kind, name in LIES if (kind, name) not in told]
    if options.rules:
        for (kind, name), rules in told.items():
            print(f"{kind:12} {name:50} {' '.join(sorted(set(rules)))}")
    for flaw in flaws:
        print(flaw)
    print(f"{sum(map(len, told.values()))} lies, {len(flaws)} flaws")
    return 1 if flaws else 0


if __name__ == "__main__":
    sys.exit(main())
