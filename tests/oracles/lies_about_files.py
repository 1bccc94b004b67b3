# SPDX-License-Identifier: LGPL-3.0-or-later
"""Lies about the files that a certificate names, each with the sentence that it breaks. They return None where they can
say nothing.

NAMING_LIES change what a certificate says about its files, or the folder: functions of the certificate, the folder and
random numbers. What they make in the folder begins with "lie".
INPUT_LIES change an input file: functions of its lines and random numbers, which return how many triangles there are
more. The certificate then has its hash, size and counts."""
import os

from forged_models import KINDS
from lies_about_formats import adds_to

NAMING_LIES, INPUT_LIES = {}, {}
naming_lie, input_lie = map(adds_to, (NAMING_LIES, INPUT_LIES))


# ---- What a certificate says about its files

@naming_lie("R21: an output file is not the one of the certificate")
def an_output_of_another_size(c, folder, rng):
    rng.choice(c["outputs"])["bytes"] += 1


@naming_lie("R21: an output file is not the one of the certificate")
def an_output_of_another_hash(c, folder, rng):
    o = rng.choice(c["outputs"])
    o["sha256"] = o["sha256"][1:] + o["sha256"][:1]


@naming_lie("outputs[].format is the format of the file")
def formats_exchanged(c, folder, rng):
    some = [o for o in c["outputs"] if o["format"] != c["outputs"][0]["format"]]
    if not some:
        return None
    o = rng.choice(some)
    o["format"], c["outputs"][0]["format"] = c["outputs"][0]["format"], o["format"]
    return True


@naming_lie("a format without a writer is not verified")
def a_format_that_nobody_knows(c, folder, rng):
    rng.choice(c["outputs"])["format"] = rng.choice(("mesh", "", "OBJ", "vtp ", "exe", "poly"))


@naming_lie("outputs[].surfaces: the surfaces of the inputs, in order")
def a_surface_less_in_an_output(c, folder, rng):
    rng.choice(c["outputs"])["surfaces"].pop()


@naming_lie("outputs[].surfaces: the surfaces of the inputs, in order")
def a_surface_more_in_an_output(c, folder, rng):
    o = rng.choice(c["outputs"])
    o["surfaces"].append(dict(o["surfaces"][0]))


def naming_all(c):
    """The outputs that have all surfaces; files of blocks and interfaces have their own."""
    return [o for o in c["outputs"] if c["kind"] != "volumes" or o["format"] == "json"]


@naming_lie("outputs[].surfaces: as the file calls them")
def another_name_in_an_output(c, folder, rng):
    some = [o for o in naming_all(c) if o["format"] not in ("off", "stl")]  # which have no names
    rng.choice(some)["surfaces"][0]["name"] += "x"


@naming_lie("outputs[].surfaces: as the file calls them")
def another_role_in_an_output(c, folder, rng):
    some = [o for o in naming_all(c) if o["format"] in ("ply", "vtp", "vtu", "json")]  # which have roles
    s = rng.choice(some)["surfaces"][0]
    s["role"] = "fault" if s["role"] != "fault" else "horizon"


@naming_lie("outputs[].surfaces: role is one of four")
def a_role_that_nobody_knows(c, folder, rng):
    rng.choice(c["outputs"])["surfaces"][0]["role"] = "salt"


@naming_lie("only files in the folder of the certificate are opened")
def an_output_outside(c, folder, rng):
    o = rng.choice(c["outputs"])
    o["name"] = "../" + folder.name + "/" + o["name"]


@naming_lie("only files in the folder of the certificate are opened")
def an_output_with_an_absolute_name(c, folder, rng):
    o = rng.choice(c["outputs"])
    o["name"] = str(folder / o["name"])


@naming_lie("only regular files are opened")
def an_output_that_is_a_link(c, folder, rng):
    o = rng.choice(c["outputs"])
    (folder / "lie_link").symlink_to("/dev/zero")
    o["name"] = "lie_link"


@naming_lie("only regular files are opened")
def an_output_that_is_a_pipe(c, folder, rng):
    os.mkfifo(folder / "lie_pipe")
    rng.choice(c["outputs"])["name"] = "lie_pipe"


@naming_lie("only regular files are opened")
def an_output_that_is_a_folder(c, folder, rng):
    (folder / "lie_folder").mkdir()
    rng.choice(c["outputs"])["name"] = "lie_folder"


@naming_lie("all outputs are judged")
def an_output_that_is_missing(c, folder, rng):
    rng.choice(c["outputs"])["name"] = "nowhere.obj"


@naming_lie("all outputs are judged")
def an_output_without_a_name(c, folder, rng):
    rng.choice(c["outputs"])["name"] = ""


@naming_lie("all outputs are judged")
def an_output_whose_name_ends_early(c, folder, rng):
    rng.choice(c["outputs"])["name"] += "\0.obj"


@naming_lie("the file is the one of the certificate")
def names_of_outputs_exchanged(c, folder, rng):
    if len(c["outputs"]) < 2:
        return None
    a, b = rng.sample(c["outputs"], 2)
    if a["sha256"] == b["sha256"]:
        return None
    a["name"], b["name"] = b["name"], a["name"]
    return True


@naming_lie("the files of a folder with blocks are all there, each once")
def an_output_left_out(c, folder, rng):
    if c["kind"] != "volumes":
        return None
    del c["outputs"][rng.randrange(len(c["outputs"]))]
    return True


@naming_lie("the files of a folder with blocks are all there, each once")
def an_output_twice(c, folder, rng):
    if c["kind"] != "volumes":
        return None
    c["outputs"].append(dict(rng.choice(c["outputs"])))
    return True


@naming_lie("the files of a folder with blocks are in one folder")
def a_block_in_another_folder(c, folder, rng):
    blocks = [o for o in c["outputs"] if "/blocks/" in o["name"]]
    if not blocks:
        return None
    (folder / "lie_folder").mkdir()
    o = rng.choice(blocks)
    name = "lie_folder/" + o["name"].rpartition("/")[2]
    (folder / name).write_bytes((folder / o["name"]).read_bytes())
    o["name"] = name
    return True


@naming_lie("the name of a file says what it must hold")
def a_block_and_an_interface_exchanged(c, folder, rng):
    blocks = [o for o in c["outputs"] if "block_" in o["name"]]
    parts = [o for o in c["outputs"] if "interface_" in o["name"]]
    if not blocks or not parts:
        return None
    a, b = rng.choice(blocks), rng.choice(parts)
    for key in ("sha256", "bytes"):
        a[key], b[key] = b[key], a[key]
    left, right = (folder / x["name"] for x in (a, b))
    for o, data in ((a, right.read_bytes()), (b, left.read_bytes())):
        name = "lie_" + o["name"].replace("/", "_")
        (folder / name).write_bytes(data)
        o["name"] = name
    return True


@naming_lie("R9: an input file is not the one of the certificate")
def no_inputs(c, folder, rng):
    c["inputs"] = []


@naming_lie("R9: an input file is not the one of the certificate")
def an_input_twice(c, folder, rng):
    if c["kind"] == "layered":
        return None  # layers need not be of all inputs
    c["inputs"].append(dict(c["inputs"][0]))
    return True


@naming_lie("R9: an input file is not the one of the certificate")
def an_input_left_out(c, folder, rng):
    c["inputs"].pop()


@naming_lie("R9: an input file is not the one of the certificate")
def an_input_of_another_hash(c, folder, rng):
    i = rng.choice(c["inputs"])
    i["sha256"] = i["sha256"][1:] + i["sha256"][:1]


@naming_lie("inputs[].surfaces: its surfaces")
def an_input_with_another_surface(c, folder, rng):
    rng.choice(c["inputs"])["surfaces"][0]["name"] += "x"


@naming_lie("inputs[].surfaces: its surfaces")
def an_input_with_another_role(c, folder, rng):
    s = rng.choice(c["inputs"])["surfaces"][0]
    s["role"] = "fault" if s["role"] != "fault" else "horizon"


@naming_lie("inputs[].surfaces: its surfaces")
def an_input_with_a_triangle_more(c, folder, rng):
    rng.choice(c["inputs"])["surfaces"][0]["triangles"] += 1


@naming_lie("inputs[].surfaces: its surfaces")
def an_input_with_a_vertex_less(c, folder, rng):
    rng.choice(c["inputs"])["surfaces"][0]["vertices"] -= 1


@naming_lie("inputs[].surfaces: its surfaces")
def an_input_of_two_surfaces(c, folder, rng):
    i = rng.choice(c["inputs"])
    s = dict(i["surfaces"][0])
    i["surfaces"][0]["triangles"] -= 1
    s["triangles"], s["vertices"] = 1, 0
    i["surfaces"].append(s)


@naming_lie("inputs[].surfaces: its surfaces")
def a_huge_input(c, folder, rng):
    s = rng.choice(c["inputs"])["surfaces"][0]
    s["triangles"] = s["vertices"] = 2 ** 64 - 1


@naming_lie("only regular files of the stated size are read")
def an_input_that_is_a_device(c, folder, rng):
    rng.choice(c["inputs"])["name"] = "/dev/zero"


@naming_lie("only files in the folder of the certificate are opened")
def an_input_that_is_a_link(c, folder, rng):
    (folder / "lie_link.obj").symlink_to("/proc/self/environ")
    rng.choice(c["inputs"])["name"] = "lie_link.obj"


@naming_lie("all inputs are read")
def an_input_that_is_missing(c, folder, rng):
    rng.choice(c["inputs"])["name"] = "nowhere.obj"


# ---- Inputs that were changed after the certificate was made, and sealed anew

ALL_BUT_LAYERED = [kind for kind in KINDS if kind != "layered"]  # whose parents are not judged


def vertices(all_lines):
    return [i for i, line in enumerate(all_lines) if line.startswith("v ")]


def faces(all_lines):
    return [i for i, line in enumerate(all_lines) if line.startswith("f ")]


@input_lie("the claims are about the surfaces in the inputs")
def an_input_vertex_moved(all_lines, rng):
    i = rng.choice(vertices(all_lines))
    x, y, z = map(float, all_lines[i].split()[1:])
    all_lines[i] = f"v {x!r} {y!r} {z + 0.05!r}"
    return 0


@input_lie("the claims are about the surfaces in the inputs")
def two_input_vertices_exchanged(all_lines, rng):
    a, b = rng.sample(vertices(all_lines), 2)
    all_lines[a], all_lines[b] = all_lines[b], all_lines[a]
    return 0


@input_lie("the claims are about the surfaces in the inputs")
def an_input_triangle_turned(all_lines, rng):
    i = rng.choice(faces(all_lines))
    a, b, d = all_lines[i].split()[1:]
    all_lines[i] = f"f {a} {d} {b}"
    return 0


@input_lie("the claims name the triangles of the inputs", ALL_BUT_LAYERED)
def two_input_triangles_exchanged(all_lines, rng):
    a, b = rng.sample(faces(all_lines), 2)
    all_lines[a], all_lines[b] = all_lines[b], all_lines[a]
    return 0


@input_lie("the claims are about the surfaces in the inputs")
def an_input_triangle_missing(all_lines, rng):
    del all_lines[rng.choice(faces(all_lines))]
    return -1


@input_lie("the claims name the triangles of the inputs", ALL_BUT_LAYERED)
def an_input_triangle_twice(all_lines, rng):
    i = rng.choice(faces(all_lines))
    all_lines.insert(i, all_lines[i])
    return 1


@input_lie("the claims are about the surfaces in the inputs")
def an_input_edge_turned_over(all_lines, rng):
    """The two triangles at an edge get the other diagonal."""
    of = {i: all_lines[i].split()[1:] for i in faces(all_lines)}
    pairs = [(i, j) for i in of for j in of if i < j and len(set(of[i]) & set(of[j])) == 2]
    i, j = rng.choice(pairs)
    (r,), (u,) = set(of[i]) - set(of[j]), set(of[j]) - set(of[i])
    k = of[i].index(r)
    p, q = of[i][(k + 1) % 3], of[i][(k + 2) % 3]
    all_lines[i], all_lines[j] = f"f {r} {p} {u}", f"f {r} {u} {q}"
    return 0
