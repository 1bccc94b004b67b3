# SPDX-License-Identifier: LGPL-3.0-or-later
"""Lies in certificates about meshes, their exact parts and inputs: functions of a certificate and random numbers, which
return None where they changed nothing."""
import copy
import math

from forged_models import KINDS

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


def decimal(x):
    """The shortest text that reads back as the same double."""
    return repr(float(x)).removesuffix(".0")


def exchanged(values, a, b):
    return [b if v == a else a if v == b else v for v in values]


def put(mesh, v, p):
    mesh["vertices"][v] = [decimal(x) for x in p]


def add_triangle(mesh, like, corners):
    for k in lists_of(mesh):
        if k != "triangles":
            mesh[k].append(copy.deepcopy(mesh[k][like]))
    mesh["triangles"].append(corners)


def surfaces_of(c):
    """The surface of each input triangle."""
    counts = [s["triangles"] for i in c["inputs"] for s in i["surfaces"]]
    if c["kind"] == "sealed":
        counts = [n + len(s["extended"]) + len(s["sealed"]) for n, s in zip(counts, c["sealed"])]
    if "cut" in c and c["cut"]["volume"]:
        counts += [len(b["triangles"]) for b in c["cut"]["volume"]["boundary"]]
    return [s for s, n in enumerate(counts) for _ in range(n)]


def curves_of(c):
    """The intersection edges of the mesh of doubles: with more than two triangles, or two that differ in the number of
    their parents in some surface."""
    mesh, of, first = c["rounded"], surfaces_of(c), {b: a for b, a in c["exact"]["duplicates"]}
    own = [sorted(of[p] for p in {first.get(p, p) for p in parents}) for parents in mesh["parents"]]
    at = {}
    for t, corners in enumerate(mesh["triangles"]):
        for k in range(3):
            at.setdefault(tuple(sorted((corners[k], corners[k - 1]))), []).append(t)
    return sorted(list(e) for e, ts in at.items() if len(ts) > 2 or len(ts) == 2 and own[ts[0]] != own[ts[1]])


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


@lie(*KINDS)
def an_input_of_another_size(c, rng):
    rng.choice(c["inputs"])["bytes"] += 1


@lie(*KINDS)
def inputs_in_another_order(c, rng):
    if len(c["inputs"]) < 2:
        return None
    files = [(i["name"], i["bytes"], i["sha256"]) for i in c["inputs"]]
    for i, (name, size, sha) in zip(c["inputs"], files[1:] + files[:1]):
        i["name"], i["bytes"], i["sha256"] = name, size, sha
    return True
