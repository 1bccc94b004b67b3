# SPDX-License-Identifier: LGPL-3.0-or-later
"""More lies about meshes of all kinds, as in lies.py: each changes the shape of something, or the way it is stated."""
import copy
import math

from lies import MESHES, PARTS, add_triangle, decimal, lie, lists_of, mesh_of, point, put

EXACT = ("arrangement", "volumes", "tetrahedra", "improved", "cut", "sealed")
ROUNDED = ("arrangement", "volumes", "tetrahedra", "cut", "sealed")
ALL = (*MESHES, "layered", "filled")


def new_vertex(mesh, p):
    mesh["vertices"].append(None)
    put(mesh, len(mesh["vertices"]) - 1, p)
    return len(mesh["vertices"]) - 1


def edges_of(mesh):
    """Triangles at each edge."""
    at = {}
    for t, corners in enumerate(mesh["triangles"]):
        for k in range(3):
            at.setdefault(tuple(sorted((corners[k - 1], corners[k]))), []).append(t)
    return at


def drop_triangles(mesh, gone):
    for k in lists_of(mesh):
        mesh[k] = [x for t, x in enumerate(mesh[k]) if t not in gone]


# ---- Shapes

@lie(*ALL)
def a_sheet_doubled_a_double_away(c, rng):
    """All triangles once more, on vertices of their own."""
    m, n = mesh_of(c), len(mesh_of(c)["vertices"])
    for v in range(n):
        p = point(m, v)
        new_vertex(m, [p[0], p[1], math.nextafter(p[2], math.inf)])
    for t in range(len(m["triangles"])):
        add_triangle(m, t, [v + n for v in m["triangles"][t]])


@lie(*ALL)
def a_triangle_twice(c, rng):
    m = mesh_of(c)
    t = rng.randrange(len(m["triangles"]))
    add_triangle(m, t, list(m["triangles"][t]))


@lie(*ALL)
def a_triangle_twice_turned(c, rng):
    m = mesh_of(c)
    t = rng.randrange(len(m["triangles"]))
    add_triangle(m, t, m["triangles"][t][::-1])


@lie(*MESHES, "layered")
def a_pillow(c, rng):
    """A triangle of two sheets: its middle is doubled, a double apart."""
    m = mesh_of(c)
    t = rng.randrange(len(m["triangles"]))
    a, b, d = m["triangles"][t]
    mid = [sum(x) / 3 for x in zip(*(point(m, v) for v in (a, b, d)))]
    up = [*mid[:2], math.nextafter(mid[2], math.inf)]
    for v in (new_vertex(m, mid), new_vertex(m, up)):
        for corners in ([a, b, v], [b, d, v], [d, a, v]):
            add_triangle(m, t, corners)
    drop_triangles(m, {t})


@lie(*MESHES, "layered")
def a_crack_along_an_edge(c, rng):
    """An edge inside of a sheet is split on both sides, at points a double apart."""
    m = mesh_of(c)
    edge, (t, s) = rng.choice([x for x in edges_of(m).items() if len(x[1]) == 2])
    p, q = (point(m, v) for v in edge)
    mid = [(x + y) / 2 for x, y in zip(p, q)]
    for triangle, place in ((t, mid), (s, [*mid[:2], math.nextafter(mid[2], math.inf)])):
        corners = m["triangles"][triangle]
        k = next(k for k in range(3) if {corners[k - 1], corners[k]} == set(edge))
        a, b, d = corners[k - 1], corners[k], corners[k - 2]
        v = new_vertex(m, place)
        m["triangles"][triangle] = [a, v, d]
        add_triangle(m, triangle, [v, b, d])


@lie(*ALL)
def a_triangle_made_a_line(c, rng):
    t = rng.choice(mesh_of(c)["triangles"])
    t[1] = t[0]


@lie(*ALL)
def an_edge_collapsed(c, rng):
    """A vertex becomes its neighbour; the triangles at the edge are gone."""
    m = mesh_of(c)
    edge, around = rng.choice([x for x in edges_of(m).items() if len(x[1]) == 2])
    drop_triangles(m, set(around))
    m["triangles"] = [[edge[0] if v == edge[1] else v for v in t] for t in m["triangles"]]


@lie(*ALL)
def a_vertex_without_triangles(c, rng):
    m = mesh_of(c)
    new_vertex(m, point(m, 0)[:2] + [point(m, 0)[2] + 1])


@lie(*ALL)
def two_vertices_at_one_place(c, rng):
    """A triangle has a copy of one of its vertices."""
    m = mesh_of(c)
    t = rng.choice(m["triangles"])
    t[0] = new_vertex(m, point(m, t[0]))


@lie(*ALL)
def a_fin(c, rng):
    """A triangle that stands on an edge inside of a sheet, some doubles high. At a border it would be a part of it."""
    m = mesh_of(c)
    (a, b), around = rng.choice([x for x in edges_of(m).items() if len(x[1]) > 1])
    mid = [(x + y) / 2 for x, y in zip(point(m, a), point(m, b))]
    add_triangle(m, around[0], [a, b, new_vertex(m, [mid[0], mid[1], mid[2] + 1e-13])])


@lie(*ALL)
def a_speck(c, rng):
    """A triangle of some doubles that touches nothing."""
    m = mesh_of(c)
    t = rng.randrange(len(m["triangles"]))
    mid = [sum(x) / 3 for x in zip(*(point(m, v) for v in m["triangles"][t]))]
    place = [mid[0], mid[1], mid[2] + 1e-13]
    add_triangle(m, t, [new_vertex(m, [x + (1e-13 if i == k else 0) for i, x in enumerate(place)]) for k in range(3)])


@lie(*ALL)
def a_spike(c, rng):
    """A vertex goes far up."""
    m = mesh_of(c)
    v = rng.choice(m["triangles"])[0]
    p = point(m, v)
    put(m, v, [p[0], p[1], p[2] + 100])


@lie(*ALL)
def everything_moved(c, rng):
    m = mesh_of(c)
    for v in range(len(m["vertices"])):
        p = point(m, v)
        put(m, v, [p[0] + 1, p[1], p[2]])


@lie(*ALL)
def everything_upside_down(c, rng):
    """All heights have the other sign, and all triangles turn with them."""
    m = mesh_of(c)
    for v in range(len(m["vertices"])):
        p = point(m, v)
        put(m, v, [p[0], p[1], -p[2]])
    m["triangles"] = [t[::-1] for t in m["triangles"]]


@lie(*ALL)
def an_edge_turned_over(c, rng):
    """Two triangles that are not in one plane get the other diagonal."""
    m = mesh_of(c)
    key = next(k for k in ("parents", "layers", "surfaces", "invented") if k in lists_of(m))

    def bent(t, s):
        a, b, d = (point(m, v) for v in m["triangles"][t])
        (e,) = (point(m, v) for v in set(m["triangles"][s]) - set(m["triangles"][t]))
        u, v, w = ([y - x for x, y in zip(a, p)] for p in (b, d, e))
        return abs(sum(w[i] * (u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2]) for i in range(3))) > 1e-3
    pairs = [ts for ts in edges_of(m).values() if len(ts) == 2 and m[key][ts[0]] == m[key][ts[1]] and bent(*ts)]
    if c["kind"] in ROUNDED:
        pairs = [ts for ts in edges_of(m).values() if len(ts) == 2 and bent(*ts)]
    if not pairs or c["kind"] == "improved":
        return None
    t, s = rng.choice(pairs)
    a, b = set(m["triangles"][t]), set(m["triangles"][s])
    (r,), (u,) = a - b, b - a
    k = m["triangles"][t].index(r)
    p, q = m["triangles"][t][(k + 1) % 3], m["triangles"][t][(k + 2) % 3]
    m["triangles"][t], m["triangles"][s] = [r, p, u], [r, u, q]
    return True


@lie(*MESHES, "layered")
def half_of_a_surface_gone(c, rng):
    m = mesh_of(c)
    left = [t for t, corners in enumerate(m["triangles"]) if point(m, corners[0])[0] < 4]
    if not left:
        return None
    drop_triangles(m, set(left))
    return True


@lie(*ALL)
def nothing_at_all(c, rng):
    m = mesh_of(c)
    if c["kind"] == "filled":
        for s in m["surfaces"]:
            s["vertices"] = s["triangles"] = 0
    for k in (*lists_of(m), "vertices", "intersection_edges"):
        if k in m:
            m[k] = []


@lie(*ALL)
def an_index_behind_the_last(c, rng):
    m = mesh_of(c)
    rng.choice(m["triangles"])[0] = len(m["vertices"])


@lie(*ALL)
def an_index_of_the_largest_number(c, rng):
    rng.choice(mesh_of(c)["triangles"])[2] = 2 ** 32 - 1


@lie(*ALL)
def a_huge_coordinate(c, rng):
    m = mesh_of(c)
    v = rng.choice(m["triangles"])[1]
    put(m, v, [1e300, *point(m, v)[1:]])


@lie(*MESHES, "layered")
def a_list_with_an_entry_more(c, rng):
    m = mesh_of(c)
    k = rng.choice([k for k in lists_of(m) if k != "triangles"])
    m[k].append(copy.deepcopy(m[k][0]))


@lie(*MESHES, "layered")
def a_list_with_an_entry_less(c, rng):
    m = mesh_of(c)
    m[rng.choice([k for k in lists_of(m) if k != "triangles"])].pop()


@lie(*MESHES)
def regions_with_other_numbers(c, rng):
    """The first two regions change their numbers."""
    m = mesh_of(c)
    if max(max(r) for r in m["regions"]) == 0:
        return None
    m["regions"] = [[1 - r if r < 2 else r for r in of] for of in m["regions"]]
    return True


@lie(*MESHES)
def intersection_edges_unsorted(c, rng):
    e = mesh_of(c)["intersection_edges"]
    if len(e) < 2:
        return None
    e[0], e[-1] = e[-1], e[0]
    return True


@lie(*MESHES)
def an_intersection_edge_twice(c, rng):
    e = mesh_of(c)["intersection_edges"]
    if e:
        e.append(list(e[-1]))
    return bool(e) or None


@lie(*MESHES)
def an_intersection_edge_backwards(c, rng):
    e = mesh_of(c)["intersection_edges"]
    if e:
        e[rng.randrange(len(e))].reverse()
    return bool(e) or None


# ---- What is stated about doubles

@lie(*ROUNDED)
def a_smaller_move(c, rng):
    m = c["rounded"]
    if m["max_move"] in (None, "0"):
        return None
    m["max_move"] = "5e-324"
    return True


@lie(*ROUNDED)
def a_smaller_deviation(c, rng):
    m = c["rounded"]
    if m["deviation"] == "0" or m["max_move"] is None:
        return None
    m["deviation"] = m["max_move"] = "5e-324"
    return True


@lie(*ROUNDED)
def a_deviation_below_nothing(c, rng):
    c["rounded"]["deviation"] = "-1"


@lie(*ROUNDED)
def a_deviation_of_a_metre(c, rng):
    c["rounded"]["deviation"] = "1"


@lie(*ROUNDED)
def a_triangle_with_a_parent_more(c, rng):
    m = c["rounded"]
    t = rng.randrange(len(m["parents"]))
    other = rng.choice([p for ps in m["parents"] for p in ps if p not in m["parents"][t]])
    m["parents"][t] = sorted([*m["parents"][t], other])
    m["regions"][t] = m["regions"][t] + m["regions"][t][:1]


@lie(*ROUNDED)
def a_triangle_without_parents(c, rng):
    t = rng.randrange(len(c["rounded"]["parents"]))
    c["rounded"]["parents"][t], c["rounded"]["regions"][t] = [], []


@lie(*ROUNDED)
def a_parent_twice(c, rng):
    m = c["rounded"]
    t = rng.randrange(len(m["parents"]))
    m["parents"][t] = m["parents"][t] + m["parents"][t][-1:]


@lie(*ROUNDED)
def a_parent_that_does_not_exist(c, rng):
    c["rounded"]["parents"][rng.randrange(len(c["rounded"]["parents"]))] = [10 ** 6]


@lie("volumes", "tetrahedra", "improved")
def no_doubles(c, rng):
    c["rounded"] = None


# ---- The exact part

@lie(*EXACT)
def an_exact_triangle_turned(c, rng):
    rng.choice(c["exact"]["triangles"]).reverse()


@lie(*EXACT)
def an_exact_triangle_twice(c, rng):
    e = c["exact"]
    t = rng.randrange(len(e["triangles"]))
    e["triangles"].append(list(e["triangles"][t]))
    e["parents"].append(list(e["parents"][t]))


@lie(*EXACT)
def an_exact_vertex_twice(c, rng):
    e = c["exact"]
    t = rng.choice(e["triangles"])
    e["vertices"].append(copy.deepcopy(e["vertices"][t[0]]))
    t[0] = len(e["vertices"]) - 1


@lie(*EXACT)
def an_exact_vertex_without_triangles(c, rng):
    c["exact"]["vertices"].append(["v", 0])


@lie(*EXACT)
def an_exact_vertex_on_a_line_with_itself(c, rng):
    made = [v for v in c["exact"]["vertices"] if v[0] == "lp"]
    if not made:
        return None
    v = rng.choice(made)
    v[2] = v[1]
    return True


@lie(*EXACT)
def an_exact_vertex_of_an_unknown_kind(c, rng):
    c["exact"]["vertices"][0] = ["xyz", 0, 0, 0]


@lie(*EXACT)
def an_exact_vertex_behind_the_last_input(c, rng):
    c["exact"]["vertices"][0] = ["v", 10 ** 6]


@lie(*EXACT)
def an_exact_vertex_with_a_number_too_many(c, rng):
    c["exact"]["vertices"][0].append(0)


@lie(*EXACT)
def an_exact_vertex_with_axis_x_or_none(c, rng):
    v = c["exact"]["vertices"][0]
    c["exact"]["vertices"][0] = ["ll", v[1], v[1] + 1, v[1], v[1] + 1, "w"]


@lie(*EXACT)
def an_exact_side_split_for_one_triangle(c, rng):
    """A corner of one triangle in the side of another one: the vertex is where no lines meet, and not on its curve."""
    e = c["exact"]
    made = [v for v, how in enumerate(e["vertices"]) if how[0] != "v"]
    if not made:
        return None
    t = rng.choice([t for t in e["triangles"] if not set(t) & set(made)] or e["triangles"])
    t[0] = rng.choice(made)
    return True


@lie(*EXACT)
def an_exact_parent_forgotten(c, rng):
    of = c["exact"]["parents"]
    several = [p for p in of if len(p) > 1]
    p = rng.choice(several or of)
    p.pop()


@lie(*EXACT)
def an_exact_parent_more(c, rng):
    of = c["exact"]["parents"]
    t = rng.randrange(len(of))
    of[t] = sorted({*of[t], rng.choice([p for ps in of for p in ps if p not in of[t]])})


@lie(*EXACT)
def exact_parents_unsorted(c, rng):
    of = c["exact"]["parents"]
    t = rng.randrange(len(of))
    of[t] = [of[t][0] + 1, *of[t]]


@lie(*EXACT)
def an_exact_index_behind_the_last(c, rng):
    rng.choice(c["exact"]["triangles"])[0] = len(c["exact"]["vertices"])


@lie(*EXACT)
def a_duplicate_that_is_none(c, rng):
    c["exact"]["duplicates"] = [[1, 0]]


@lie(*EXACT)
def no_exact_part(c, rng):
    for k in ("vertices", "triangles", "parents", "intersection_edges"):
        c["exact"][k] = []


@lie(*EXACT)
def exact_edges_unsorted(c, rng):
    e = c["exact"]["intersection_edges"]
    if len(e) < 2:
        return None
    e.reverse()
    return True


@lie(*EXACT)
def exact_triangles_exchanged(c, rng):
    """Two triangles have each other's parents."""
    of = c["exact"]["parents"]
    t, s = rng.sample(range(len(of)), 2)
    if of[t] == of[s]:
        return None
    of[t], of[s] = of[s], of[t]
    return True


@lie(*EXACT)
def a_vertex_of_a_neighbour(c, rng):
    """A triangle reaches to the far corner of its neighbour."""
    e = c["exact"]
    _, (t, s) = rng.choice([x for x in edges_of(e).items() if len(x[1]) == 2])
    (far,) = set(e["triangles"][s]) - set(e["triangles"][t])
    e["triangles"][t][0] = far


@lie(*MESHES)
def nobody_has_a_parent_in_the_exact_part(c, rng):
    c["exact"]["parents"] = [[] for _ in c["exact"]["parents"]]


assert set(PARTS) <= set(ALL)
