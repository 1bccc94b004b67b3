# SPDX-License-Identifier: LGPL-3.0-or-later
"""Lies that only certificates of some kinds have: see lies.py."""
import copy
import fractions
import math

from lies import decimal, lie, lists_of, point, put

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
    if "thickness" in c["layered"]:
        return None  # which of them gave way is not judged
    o[0]["hardness"], o[1]["hardness"] = o[1]["hardness"], o[0]["hardness"]
    return True


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
    b[1] = decimal(math.nextafter(float(b[1]), math.inf))


@lie("cut")
def a_box_of_other_corners(c, rng):
    corner = rng.choice(c["cut"]["volume"]["corners"])
    corner[0] = decimal(float(corner[0]) + 2.0 ** -40)


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
    if not some or c["cut"]["volume"]:
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
    t[:] = [[decimal(float(x) + 1) for x in p] for p in t]
    return True


@lie("sealed")
def a_given_part_dropped(c, rng):
    d = c["cut"]["dropped"]
    rest = sorted(set(range(len(c["exact"]["triangles"]))) - set(d))
    c["cut"]["dropped"] = sorted(d + [rng.choice(rest)])
