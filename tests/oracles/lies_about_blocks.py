# SPDX-License-Identifier: LGPL-3.0-or-later
"""Lies that only certificates of blocks and tetrahedra have: see lies.py."""
import copy

from lies import exchanged, lie, point, put


@lie("volumes", "tetrahedra")
def blocks_with_other_numbers(c, rng):
    """Two blocks change their numbers, volumes and tetrahedra."""
    b = c["blocks"]
    if len(b["volumes"]) < 3:
        return None
    x, y = rng.sample(range(1, len(b["volumes"])), 2)
    for of in (b["volumes"], b["names"]):
        of[x], of[y] = of[y], of[x]
    b["block_of_shell"] = exchanged(b["block_of_shell"], x, y)
    if "tetrahedra" in c:
        c["tetrahedra"]["blocks"] = exchanged(c["tetrahedra"]["blocks"], x, y)
    return True


@lie("volumes", "tetrahedra")
def a_block_without_volume(c, rng):
    b = c["blocks"]
    b["volumes"].append("0")
    b["names"].append("shale")


@lie("volumes", "tetrahedra")
def a_block_that_the_exact_part_has(c, rng):
    """A block more, in the doubles and in the exact part."""
    a_block_without_volume(c, rng)
    c["blocks"]["exact"] += 1


@lie("volumes", "tetrahedra")
def a_shell_divided(c, rng):
    b = c["blocks"]
    s = max(range(len(b["shells"])), key=lambda s: len(b["shells"][s]))
    side = b["shells"][s].pop()
    b["shells"].append([side])
    b["block_of_shell"].append(b["block_of_shell"][s])
    b["around"].append(None)


@lie("volumes", "tetrahedra")
def a_side_on_two_shells(c, rng):
    shells = c["blocks"]["shells"]
    a, b = rng.sample(range(len(shells)), 2)
    shells[a] = sorted({*shells[a], shells[b][0]})


@lie("volumes", "tetrahedra")
def a_side_on_no_shell(c, rng):
    rng.choice([s for s in c["blocks"]["shells"] if len(s) > 1]).pop()


@lie("volumes", "tetrahedra")
def sides_exchanged(c, rng):
    """The front of a triangle changes its shell with the back."""
    b = c["blocks"]
    t = rng.randrange(len(c["rounded"]["triangles"]))
    if any({2 * t, 2 * t + 1} <= set(s) for s in b["shells"]):
        return None
    b["shells"] = [sorted(exchanged(s, 2 * t, 2 * t + 1)) for s in b["shells"]]
    return True


@lie("volumes", "tetrahedra")
def shells_in_another_order(c, rng):
    b = c["blocks"]
    for k in ("shells", "block_of_shell"):
        b[k].reverse()
    last = len(b["shells"]) - 1
    b["around"] = [a if a is None else last - a for a in reversed(b["around"])]


@lie("volumes", "tetrahedra")
def a_shell_around_itself(c, rng):
    s = rng.randrange(len(c["blocks"]["around"]))
    c["blocks"]["around"][s] = s


@lie("volumes", "tetrahedra")
def a_volume_below_nothing(c, rng):
    v = c["blocks"]["volumes"]
    v[-1] = "-" + v[-1]


@lie("volumes", "tetrahedra")
def a_volume_over_nothing(c, rng):
    c["blocks"]["volumes"][-1] = "1/0"


@lie("volumes", "tetrahedra")
def a_name_less(c, rng):
    c["blocks"]["names"].pop()


@lie("volumes")
def a_block_less_in_the_model(c, rng):
    c["model"]["blocks"].pop()
    c["blocks"]["names"].pop()


@lie("tetrahedra")
def a_block_doubled(c, rng):
    """All tetrahedra of a block once more, on nodes of their own."""
    x = c["tetrahedra"]
    n = len(x["vertices"])
    x["vertices"] += copy.deepcopy(x["vertices"])
    for t in [t for t, b in enumerate(x["blocks"]) if b == 1]:
        x["tetrahedra"].append([v + n for v in x["tetrahedra"][t]])
        x["blocks"].append(1)


@lie("tetrahedra")
def a_block_left_empty(c, rng):
    x = c["tetrahedra"]
    keep = [t for t, b in enumerate(x["blocks"]) if b != 1]
    for k in ("blocks", "tetrahedra"):
        x[k] = [x[k][t] for t in keep]


@lie("tetrahedra")
def the_outside_left_out(c, rng):
    x = c["tetrahedra"]
    if not x["box"]:
        return None
    keep = [t for t, b in enumerate(x["blocks"]) if b != 0]
    for k in ("blocks", "tetrahedra"):
        x[k] = [x[k][t] for t in keep]
    return True


@lie("tetrahedra")
def a_tetrahedron_flattened(c, rng):
    x = c["tetrahedra"]
    t = rng.choice(x["tetrahedra"])
    x["vertices"][t[3]] = list(x["vertices"][t[0]])


@lie("tetrahedra")
def an_inner_face_turned_over(c, rng):
    """Two tetrahedra with a common face become others with the same five nodes, which overlap or are flat."""
    x = c["tetrahedra"]
    at = {}
    for t, v in enumerate(x["tetrahedra"]):
        for k in range(4):
            at.setdefault(tuple(sorted(v[:k] + v[k + 1:])), []).append(t)
    face, (t, s) = rng.choice([f for f in at.items() if len(f[1]) == 2])
    (far,) = set(x["tetrahedra"][s]) - set(face)
    x["tetrahedra"][t] = [far if v == face[0] else v for v in x["tetrahedra"][t]]


@lie("tetrahedra")
def a_node_without_tetrahedra(c, rng):
    x = c["tetrahedra"]
    x["vertices"].append(["0.5", "0.25", "0.125"])


@lie("tetrahedra")
def a_node_twice(c, rng):
    x = c["tetrahedra"]
    t = rng.choice(x["tetrahedra"])
    x["vertices"].append(list(x["vertices"][t[0]]))
    t[0] = len(x["vertices"]) - 1


@lie("tetrahedra")
def a_face_twice(c, rng):
    x = c["tetrahedra"]
    f = rng.randrange(len(x["faces"]))
    x["faces"].append(list(x["faces"][f]))
    x["triangles"].append(x["triangles"][f])


@lie("tetrahedra")
def a_face_turned(c, rng):
    rng.choice(c["tetrahedra"]["faces"]).reverse()


@lie("tetrahedra")
def a_face_of_the_box_on_a_triangle(c, rng):
    t = c["tetrahedra"]["triangles"]
    if None not in t:
        return None
    t[t.index(None)] = 0
    return True


@lie("tetrahedra")
def a_face_on_the_box_that_is_inside(c, rng):
    t = c["tetrahedra"]["triangles"]
    t[rng.choice([f for f, on in enumerate(t) if on is not None])] = None


@lie("tetrahedra")
def an_inner_face_listed(c, rng):
    """A face between two tetrahedra is said to be on a triangle."""
    x = c["tetrahedra"]
    known = {tuple(sorted(f)) for f in x["faces"]}
    inner = [v[:3] for v in x["tetrahedra"] if tuple(sorted(v[:3])) not in known]
    x["faces"].append(rng.choice(inner))
    x["triangles"].append(0)


@lie("tetrahedra")
def a_twin_with_itself(c, rng):
    c["tetrahedra"]["twins"].append([0, 0])


@lie("tetrahedra")
def twins_forgotten(c, rng):
    if not c["tetrahedra"]["twins"]:
        return None
    c["tetrahedra"]["twins"] = []
    return True


@lie("tetrahedra")
def twins_exchanged(c, rng):
    w = c["tetrahedra"]["twins"]
    if not w:
        return None
    rng.choice(w).reverse()
    return True


@lie("tetrahedra")
def a_cut_grown_together(c, rng):
    """Two nodes at the same place, on both sides of a cut, become one."""
    x = c["tetrahedra"]
    at = {}
    for v, p in enumerate(x["vertices"]):
        at.setdefault(tuple(p), []).append(v)
    several = [vs for vs in at.values() if len(vs) > 1]
    if not several:
        return None
    a, b = rng.choice(several)[:2]
    x["tetrahedra"] = [[a if v == b else v for v in t] for t in x["tetrahedra"]]
    x["faces"] = [[a if v == b else v for v in f] for f in x["faces"]]
    return True
