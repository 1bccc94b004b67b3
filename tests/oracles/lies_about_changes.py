# SPDX-License-Identifier: LGPL-3.0-or-later
"""Lies that only certificates of changed surfaces have: see lies.py."""
import copy
import math

from lies import decimal, exchanged, lie, point, put
from lies_about_shapes import drop_triangles


# ---- Improved meshes

def body(m, surface):
    own = {v for t, of in zip(m["triangles"], m["surfaces"]) if of == [surface] for v in t}
    other = {v for t, of in zip(m["triangles"], m["surfaces"]) if of != [surface] for v in t}
    return own if own and not own & other else None


@lie("improved")
def a_body_moved(c, rng):
    """By twice its limit."""
    m = c["improved"]
    own = body(m, len(c["inputs"]) - 1)
    if not own:
        return None
    m["limits"] = ["0.03125"] * len(m["limits"])
    for v in own:
        p = point(m, v)
        put(m, v, [p[0] + 0.0625, *p[1:]])
    return True


@lie("improved")
def a_body_left_out(c, rng):
    m = c["improved"]
    own = body(m, len(c["inputs"]) - 1)
    if not own:
        return None
    drop_triangles(m, {t for t, v in enumerate(m["triangles"]) if v[0] in own})
    return True


@lie("improved")
def surfaces_exchanged(c, rng):
    m = c["improved"]
    s, t = rng.sample(range(len(m["limits"])), 2)
    m["surfaces"] = [sorted(exchanged(of, s, t)) for of in m["surfaces"]]


@lie("improved")
def a_limit_too_wide(c, rng):
    c["improved"]["limits"][rng.randrange(len(c["improved"]["limits"]))] = "1000"


@lie("improved")
def a_limit_below_nothing(c, rng):
    c["improved"]["limits"][0] = "-1"


@lie("improved")
def a_limit_less(c, rng):
    c["improved"]["limits"].pop()


@lie("improved")
def a_corner_moved_by_a_bit(c, rng):
    """A vertex with a border and an intersection, or with several curves."""
    m = c["improved"]
    ends = [v for e in m["intersection_edges"] for v in e]
    corners = [v for v in set(ends) if ends.count(v) != 2]
    if not corners:
        return None
    v = rng.choice(corners)
    p = point(m, v)
    put(m, v, [p[0], p[1], math.nextafter(p[2], math.inf)])
    return True


@lie("improved")
def a_surface_of_nobody(c, rng):
    c["improved"]["surfaces"][rng.randrange(len(c["improved"]["surfaces"]))] = [len(c["improved"]["limits"])]


# ---- Filled surfaces

def filled_triangles(f):
    return [t for t, h in enumerate(f["invented"]) if h]


@lie("filled")
def a_vertex_of_another_surface(c, rng):
    s = c["filled"]["surfaces"]
    s[0]["vertices"] += 1
    s[1]["vertices"] -= 1


@lie("filled")
def a_triangle_of_another_surface(c, rng):
    s = c["filled"]["surfaces"]
    s[0]["triangles"] += 1
    s[1]["triangles"] -= 1


@lie("filled")
def a_given_vertex_with_an_expected_error(c, rng):
    c["filled"]["deviation"][0] = "0.5"


@lie("filled")
def a_given_vertex_of_unknown_error(c, rng):
    c["filled"]["deviation"][rng.randrange(20)] = None


@lie("filled")
def an_expected_error_below_nothing(c, rng):
    d = c["filled"]["deviation"]
    new = [v for v, x in enumerate(d) if x != "0"]
    if not new:
        return None
    d[rng.choice(new)] = "-1"
    return True


@lie("filled")
def a_limit_wider_than_the_model(c, rng):
    c["filled"]["surfaces"][0]["limit"] = "1000"


@lie("filled")
def an_outer_border_closed(c, rng):
    """A triangle between two edges of the outer border."""
    f = c["filled"]
    f["triangles"].insert(f["surfaces"][0]["triangles"], [0, 1, 9])
    f["invented"].insert(f["surfaces"][0]["triangles"], max(f["invented"]) + 1)
    f["surfaces"][0]["triangles"] += 1


@lie("filled")
def a_filling_doubled(c, rng):
    f = c["filled"]
    end = f["surfaces"][0]["triangles"]
    new = [t for t in filled_triangles(f) if t < end and f["invented"][t] == 1]
    for t in new:
        f["triangles"].insert(end, f["triangles"][t][::-1])
        f["invented"].insert(end, max(f["invented"]) + (t == new[0]))
    f["surfaces"][0]["triangles"] += len(new)


@lie("filled")
def a_filling_left_out(c, rng):
    """The filling without its triangles at one vertex of the border."""
    f = c["filled"]
    v = f["triangles"][rng.choice(filled_triangles(f))][0]
    gone = {t for t in filled_triangles(f) if v in f["triangles"][t]}
    if {f["invented"][t] for t in gone} - {h for t, h in enumerate(f["invented"]) if t not in gone}:
        return None  # a hole may stay open
    f["surfaces"][0]["triangles"] -= len(gone)
    for k in ("triangles", "invented"):
        f[k] = [x for t, x in enumerate(f[k]) if t not in gone]
    return True


@lie("filled")
def fillings_that_are_one(c, rng):
    """A filling says that it has the number of no hole."""
    f = c["filled"]
    f["invented"] = [min(h, 1) * 7 for h in f["invented"]]


@lie("filled")
def a_given_triangle_left_out(c, rng):
    f = c["filled"]
    t = f["invented"].index(0)
    for k in ("triangles", "invented"):
        del f[k][t]
    f["surfaces"][0]["triangles"] -= 1


# ---- Layers

@lie("layered")
def a_layer_twice(c, rng):
    o = c["layered"]["order"]
    o[1] = dict(o[0])


@lie("layered")
def a_layer_of_no_surface(c, rng):
    c["layered"]["order"][0]["surface"] = 7


@lie("layered")
def a_layer_of_the_lower_surface(c, rng):
    o = c["layered"]["order"]
    o[0]["surface"], o[1]["surface"] = o[1]["surface"], o[0]["surface"]


@lie("layered")
def a_deviation_of_the_layers_below_nothing(c, rng):
    c["layered"]["deviation"] = "-1"


@lie("layered")
def a_deviation_of_the_layers_too_wide(c, rng):
    c["layered"]["deviation"] = "0.5"


@lie("layered")
def layers_less_thick_than_nothing(c, rng):
    c["layered"]["thickness"] = "0"


@lie("layered")
def a_layer_lifted(c, rng):
    """All vertices that only one layer has."""
    m = c["layered"]
    own = {v for t, of in zip(m["triangles"], m["layers"]) if of == [0] for v in t}
    own -= {v for t, of in zip(m["triangles"], m["layers"]) if of != [0] for v in t}
    if not own:
        return None
    for v in own:
        p = point(m, v)
        put(m, v, [p[0], p[1], p[2] + 0.01])
    return True


@lie("layered")
def a_layer_alone(c, rng):
    m = c["layered"]
    drop_triangles(m, {t for t, of in enumerate(m["layers"]) if of == [1]})


@lie("layered")
def layers_exchanged(c, rng):
    m = c["layered"]
    m["layers"] = [sorted(1 - x for x in of) for of in m["layers"]]


@lie("layered")
def a_triangle_of_no_layer(c, rng):
    c["layered"]["layers"][0] = []


@lie("layered")
def a_triangle_of_a_layer_that_does_not_exist(c, rng):
    c["layered"]["layers"][0] = [2]


# ---- Volumes of interest

@lie("cut", "sealed")
def dropped_twice(c, rng):
    d = c["cut"]["dropped"]
    if not d:
        return None
    d.append(d[-1])
    return True


@lie("cut")
def everything_dropped(c, rng):
    c["cut"]["dropped"] = list(range(len(c["exact"]["triangles"])))


@lie("cut")
def nothing_dropped(c, rng):
    c["cut"]["dropped"] = []


@lie("cut", "sealed")
def a_triangle_dropped_that_does_not_exist(c, rng):
    c["cut"]["dropped"].append(len(c["exact"]["triangles"]))


@lie("cut")
def a_volume_of_another_shape(c, rng):
    v = c["cut"]["volume"]
    v["shape"] = rng.choice([s for s in ("prism", "hexahedron", "surface", "ball") if s != v["shape"]])


@lie("cut")
def a_volume_of_files(c, rng):
    c["cut"]["volume"]["files"] += 1


@lie("cut")
def no_volume(c, rng):
    c["cut"]["volume"] = None


@lie("cut")
def heights_exchanged(c, rng):
    b = c["cut"]["volume"]["between"]
    if not b:
        return None
    b.reverse()
    return True


@lie("cut")
def corners_of_a_prism_in_another_order(c, rng):
    k = c["cut"]["volume"]["corners"]
    if not k:
        return None
    k[0], k[1] = k[1], k[0]
    return True


@lie("cut")
def a_corner_less(c, rng):
    k = c["cut"]["volume"]["corners"]
    return k.pop() if k else None


@lie("cut")
def a_boundary_doubled(c, rng):
    b = c["cut"]["volume"]["boundary"]
    b.append(copy.deepcopy(b[0]))


@lie("cut")
def a_side_of_the_boundary_left_out(c, rng):
    b = c["cut"]["volume"]["boundary"]
    if len(b) > 1:
        b.pop()
    else:
        b[0]["triangles"] = b[0]["triangles"][2:]


@lie("cut")
def a_corner_of_the_boundary_moved(c, rng):
    part = rng.choice(c["cut"]["volume"]["boundary"])
    p = rng.choice(part["vertices"])
    p[2] = decimal(float(p[2]) + 0.001)


@lie("cut")
def doubles_outside(c, rng):
    """A vertex on the boundary goes a thousandth outside."""
    m = c["rounded"]
    v = max(range(len(m["vertices"])), key=lambda v: point(m, v)[0])
    p = point(m, v)
    put(m, v, [p[0] + 1e-3, *p[1:]])


# ---- Sealed surfaces

def sealing(c, key="sealed"):
    return [s for s in c["sealed"] if s[key]]


@lie("sealed")
def an_added_triangle_twice(c, rng):
    some = sealing(c)
    if not some:
        return None
    s = rng.choice(some)["sealed"]
    s.append(copy.deepcopy(s[0]))
    return True


@lie("sealed")
def added_triangles_that_were_given(c, rng):
    some = sealing(c)
    if not some:
        return None
    rng.choice(some)["sealed"] = []
    return True


@lie("sealed")
def an_added_triangle_moved_by_a_bit(c, rng):
    some = sealing(c)
    if not some:
        return None
    p = rng.choice(rng.choice(rng.choice(some)["sealed"]))
    p[2] = decimal(math.nextafter(float(p[2]), math.inf))
    return True


@lie("sealed")
def an_added_triangle_without_area(c, rng):
    some = sealing(c)
    if not some:
        return None
    t = rng.choice(rng.choice(some)["sealed"])
    t[1] = list(t[0])
    return True


@lie("sealed")
def a_limit_wider_than_accepted(c, rng):
    rng.choice(c["sealed"])["limit"] = "1000"


@lie("sealed")
def a_limit_that_is_negative(c, rng):
    rng.choice(c["sealed"])["limit"] = "-1"


@lie("sealed")
def surfaces_that_sealed_exchanged(c, rng):
    c["sealed"].append(c["sealed"].pop(0))
    return c["sealed"][0] != c["sealed"][-1] or None


@lie("sealed")
def a_sealed_surface_less(c, rng):
    c["sealed"].pop()


@lie("sealed")
def an_added_triangle_kept_that_is_not_needed(c, rng):
    """What was dropped of added triangles is kept."""
    given = sum(s["triangles"] for i in c["inputs"] for s in i["surfaces"])
    d = [t for t in c["cut"]["dropped"]]
    if not d or not given:
        return None
    c["cut"]["dropped"].remove(rng.choice(d))
    return True


@lie("sealed")
def a_speck_added(c, rng):
    """A triangle that goes on from nothing, with a part of the exact result that nothing claims."""
    s = rng.choice(c["sealed"])
    s["sealed"].append([[decimal(x + (k == i) * 0.01) for i, x in enumerate((2.0, 2.0, 2.0))] for k in range(3)])
