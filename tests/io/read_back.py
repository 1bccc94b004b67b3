#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Opens what Terrane writes with VTK, gmsh and meshio and compares it with what was meant.

VTK reads VTP, VTU and its legacy format, gmsh MSH 4.1, MSH 2.2, MEDIT and UNV, meshio VTU, FLAC3D and Abaqus files; *SURFACE, which meshio
leaves out, is read by the few lines below, from Abaqus' description of the keywords. (TetGen's
formats are tested in test_poly.cpp.)

usage: read_back.py TERRANE_TESTS

Needs VTK's Python modules, meshio and the program gmsh; without one of them it fails.
"""
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter

import meshio
from vtkmodules.vtkIOLegacy import vtkPolyDataReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader


def check(condition, what):
    if not condition:
        sys.exit(f"read_back.py: {what}")


def tuples(array):
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def scalars(data, name):
    array = data.GetArray(name)
    check(array is not None, f"there is no array {name}")
    return [int(value[0]) for value in tuples(array)]


def same_numbers(a, b):
    """Equal to the last bit: -0 is not 0."""
    return len(a) == len(b) and all(
        x == y and math.copysign(1, x) == math.copysign(1, y) for x, y in zip(a, b))


def read_vtk(path):
    reader = vtkXMLPolyDataReader() if path.endswith(".vtp") else vtkXMLUnstructuredGridReader()
    errors = []
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(path))
    reader.SetFileName(path)
    reader.Update()
    check(not errors and reader.GetErrorCode() == 0, f"VTK cannot read {path}")
    return reader.GetOutput()


def check_lists(field, lists, path):
    if all(len(entry) == 1 for entry in lists):
        return
    offsets, values = scalars(field, "surfaces_offset"), scalars(field, "surfaces")
    found = [values[a:b] for a, b in zip(offsets, offsets[1:])]
    check(found == lists, f"{path}: lists of surfaces {found}, not {lists}")


def check_vtk(path, meant):
    grid = read_vtk(path)
    points = tuples(grid.GetPoints().GetData())
    check(len(points) == len(meant["points"]), f"{path}: {len(points)} points")
    for found, wanted in zip(points, meant["points"]):
        check(same_numbers(found, wanted), f"{path}: point {found}, not {wanted}")
    cells = meant["cells"] + meant.get("faces", [])
    check(grid.GetNumberOfCells() == len(cells), f"{path}: {grid.GetNumberOfCells()} cells")
    for i, wanted in enumerate(cells):
        ids = grid.GetCell(i).GetPointIds()
        found = [ids.GetId(k) for k in range(ids.GetNumberOfIds())]
        check(found == wanted, f"{path}: cell {i} is {found}, not {wanted}")
    field = grid.GetFieldData()
    names = field.GetAbstractArray("surface_name")
    found = [names.GetValue(i) for i in range(names.GetNumberOfValues())]
    if path.endswith(".vtu"):
        found = texts(found)
    check(found == meant["names"], f"{path}: names {found}")
    check_lists(field, meant["surfaces_of"], path)
    check_cell_data(path, grid.GetCellData(), meant)


def check_legacy(path, meant):
    reader = vtkPolyDataReader()
    reader.SetFileName(path)
    reader.ReadAllFieldsOn()
    reader.ReadAllScalarsOn()
    reader.Update()
    mesh = reader.GetOutput()
    points = tuples(mesh.GetPoints().GetData())
    check([same_numbers(a, b) for a, b in zip(points, meant["points"])] == [True] * len(meant["points"]),
          f"{path}: points")
    cells = [[mesh.GetCell(i).GetPointIds().GetId(k) for k in range(3)]
             for i in range(mesh.GetNumberOfCells())]
    check(cells == meant["cells"], f"{path}: cells")
    check(texts(scalars(mesh.GetFieldData(), "surface_name")) == meant["names"], f"{path}: names")
    check_lists(mesh.GetFieldData(), meant["surfaces_of"], path)
    for name, values in (("surface", [entry[0] for entry in meant["surfaces_of"]]),
                         ("surface_count", [len(entry) for entry in meant["surfaces_of"]])):
        check(scalars(mesh.GetCellData(), name) == values, f"{path}: array {name}")


def texts(codes):
    """The strings whose character codes these are, each ended by a 0."""
    return [text.decode() for text in bytes(map(int, codes)).split(b"\0")[:-1]]


def check_meshio_vtu(path, meant):
    """meshio's view of a VTU: points, cells in their order, names and arrays."""
    mesh = meshio.read(path)
    check([same_numbers(list(p), wanted) for p, wanted in zip(mesh.points, meant["points"])]
          == [True] * len(meant["points"]), f"{path}: meshio's points")
    cells = [list(map(int, corners)) for block in mesh.cells for corners in block.data]
    check(cells == meant["cells"] + meant["faces"], f"{path}: meshio's cells")
    check(texts(mesh.field_data["surface_name"].ravel()) == meant["names"], f"{path}: meshio's names")
    blocks = [int(r) for block in mesh.cell_data["block"] for r in block.ravel()]
    check(blocks == meant["block_of"] + [-1] * len(meant["faces"]), f"{path}: meshio's blocks")


def check_cell_data(path, data, meant):
    tetrahedra = len(meant["cells"]) if "faces" in meant else 0
    wanted = {
        "surface": [-1] * tetrahedra + [entry[0] for entry in meant["surfaces_of"]],
        "surface_count": [0] * tetrahedra + [len(entry) for entry in meant["surfaces_of"]],
    }
    if tetrahedra:
        wanted["block"] = meant["block_of"] + [-1] * len(meant["faces"])
    if meant.get("twins"):
        twin, sides = [-1] * (tetrahedra + len(meant["faces"])), sides_of(meant)
        for front, back in meant["twins"]:
            twin[tetrahedra + front], twin[tetrahedra + back] = tetrahedra + back, tetrahedra + front
        wanted["twin"] = twin
        wanted["cut_side"] = [0] * tetrahedra + sides
    for array, lists in (("region", "regions_of"), ("parent", "parents_of")):
        if meant.get(lists):
            wanted[array] = [entry[0] for entry in meant[lists]]
    for name, values in wanted.items():
        check(scalars(data, name) == values, f"{path}: array {name}")


def sides_of(meant):
    """Per face: 1 in front of a cut, 2 behind it, 0 elsewhere."""
    sides = [0] * len(meant.get("faces", meant["cells"]))
    for front, back in meant.get("twins", []):
        sides[front], sides[back] = 1, 2
    return sides


def group(surface, side, count):
    """The physical group of a surface, or of a side of it."""
    return count + 2 * surface + side if side else surface + 1


ENDINGS = ("", " front", " back")


def through_gmsh(path):
    """Nodes and elements {(type, physical tag, nodes): count}, as gmsh writes them in MSH 2.2.

    MEDIT has no physical groups: gmsh makes entities of the references."""
    tag = 4 if path.endswith(".mesh") else 3
    out = path + ".22.msh"
    run = subprocess.run(["gmsh", path, "-save", "-format", "msh22", "-o", out, "-v", "2"],
                         capture_output=True, text=True)
    said = run.stdout + run.stderr
    check(run.returncode == 0 and "Error" not in said and "Warning" not in said,
          f"gmsh on {path}: {said}")
    with open(out, encoding="utf-8") as file:
        lines = iter(file.read().split("\n"))
    nodes, elements, names, pairs = {}, Counter(), {}, set()
    for line in lines:
        if line == "$PhysicalNames":
            for _ in range(int(next(lines))):
                dimension, group, name = next(lines).split(" ", 2)
                names[int(dimension), int(group)] = name.strip('"')
        if line == "$Nodes":
            for _ in range(int(next(lines))):
                node, *xyz = next(lines).split()
                nodes[int(node)] = tuple(xyz)
        if line == "$Elements":
            for _ in range(int(next(lines))):
                words = [int(word) for word in next(lines).split()]
                corners = tuple(words[3 + words[2]:])
                elements[words[1], words[tag], corners] += 1
        if line == "$Periodic":
            for _ in range(int(next(lines))):
                next(lines)  # the entities
                count = next(lines)
                if count.startswith("Affine"):
                    count = next(lines)
                pairs |= {tuple(map(int, next(lines).split())) for _ in range(int(count))}
    return nodes, elements, names, pairs


def labelled(nodes, elements, pairs):
    """Nodes by place and by the groups of what is at them, since gmsh counts them anew: elements
    {(type, tag, labels): count} and pairs of labels."""
    groups = {v: set() for v in nodes}
    for kind, tag, corners in elements:
        for v in corners:
            groups[v].add((kind, tag))
    label = {v: (nodes[v], tuple(sorted(groups[v]))) for v in nodes}
    found = Counter()
    for (kind, tag, corners), count in elements.items():
        found[kind, tag, tuple(label[v] for v in corners)] += count
    return found, {(label[a], label[b]) for a, b in pairs}


def meshio_pairs(path):
    periodic = meshio.read(path).gmsh_periodic or []
    return {(int(a), int(b)) for _, _, _, pairs in periodic for a, b in pairs}


def check_gmsh(path, meant):
    nodes, elements, names, pairs = through_gmsh(path)
    triangles = meant.get("faces", meant["cells"])
    used = {v for cell in meant["cells"] + triangles for v in cell}  # gmsh saves no others
    check(len(nodes) == len(used), f"{path}: {len(nodes)} nodes")
    points = {v: tuple(f"{x:.16g}" for x in meant["points"][v]) for v in used}  # as gmsh prints
    wanted, wanted_pairs = Counter(), set()
    count, sides = len(meant["names"]), sides_of(meant)
    wanted_names = {s + 1: name for s, name in enumerate(in_quotes(meant["names"]))}
    for corners, surfaces, side in zip(triangles, meant["surfaces_of"], sides):
        for surface in surfaces:
            tag = group(surface, side, count)
            wanted[2, tag, tuple(corners)] += 1
            wanted_names[tag] = in_quotes(meant["names"])[surface] + ENDINGS[side]
    for corners, block in zip(meant["cells"], meant.get("block_of", [])):
        wanted[4, 3 * count + block + 1, tuple(corners)] += 1
    for front, back in meant.get("twins", []):
        wanted_pairs |= {(b, a) for a, b in zip(triangles[front], triangles[back]) if a != b}
    elements, pairs = labelled(nodes, elements, pairs)
    if path.endswith("_22.msh"):  # gmsh 4.8 skips $Periodic there, meshio does not
        check(meshio_pairs(path) == wanted_pairs, f"{path}: meshio's pairs")
        wanted_pairs = set()
    wanted, wanted_pairs = labelled(points, wanted, wanted_pairs)
    check(elements == wanted, f"{path}: elements {elements - wanted}, not {wanted - elements}")
    check(pairs == wanted_pairs, f"{path}: pairs {pairs}, not {wanted_pairs}")
    found = {tag: name for (dimension, tag), name in names.items() if dimension == 2}
    check(found == wanted_names, f"{path}: names {names}")
    blocks = {r: "outside" if r == 0 else f"block {r}" for r in meant.get("block_of", [])}
    check({tag - 1 - 3 * count: name for (dimension, tag), name in names.items() if dimension == 3} == blocks,
          f"{path}: names {names}")


def different(names, ending):
    """Names met again get a number."""
    return [name + (f"{ending}{names[:i].count(name) + 1}" if name in names[:i] else "")
            for i, name in enumerate(names)]


def in_quotes(names):
    return different([name.replace('"', "'") for name in names], "_")


def references(lists, sides, count):
    """Per triangle: of its surface from 1, and after those one for each set of several, and for
    each side of a cut."""
    keys = [(tuple(entry), side) for entry, side in zip(lists, sides)]
    others = sorted({key for key in keys if len(key[0]) > 1 or key[1]})
    return [count + 1 + others.index(key) if key in others else key[0][0] + 1 for key in keys]


def check_medit(path, meant):
    """By coordinates: gmsh counts the nodes anew."""
    nodes, elements, _, _ = through_gmsh(path)
    triangles = meant.get("faces", meant["cells"])
    point = [tuple(f"{x:.16g}" for x in p) for p in meant["points"]]
    wanted = Counter()
    wanted_references = references(meant["surfaces_of"], sides_of(meant), len(meant["names"]))
    for corners, reference in zip(triangles, wanted_references):
        wanted[2, reference, tuple(point[v] for v in corners)] += 1
    for corners, block in zip(meant["cells"], meant.get("block_of", [])):
        wanted[4, block, tuple(point[v] for v in corners)] += 1
    found = Counter()
    for (kind, tag, corners), count in elements.items():
        found[kind, tag, tuple(nodes[v] for v in corners)] += count
    check(found == wanted, f"{path}: elements {found - wanted}, not {wanted - found}")


def read_abaqus(path):
    """Keyword, parameters and data lines, in order."""
    blocks = []
    with open(path, encoding="utf-8") as file:
        for line in file.read().splitlines():
            if line.startswith("**"):
                continue  # a comment
            words = [word.strip() for word in line.split(",")]
            if line.startswith("*"):
                parameters = dict(word.partition("=")[::2] for word in words[1:])
                blocks.append((words[0], parameters, []))
            else:
                blocks[-1][2].append([word for word in words if word])
    return blocks


SIDES = {"S1": (0, 1, 2), "S2": (0, 3, 1), "S3": (1, 3, 2), "S4": (2, 3, 0)}


def label(name):
    return "".join(c if c.isascii() and c.isalnum() else "_" for c in name).upper()


def check_abaqus(path, meant):
    blocks = read_abaqus(path)
    nodes = [data for keyword, _, data in blocks if keyword == "*NODE"][0]
    check([int(words[0]) for words in nodes] == list(range(1, len(meant["points"]) + 1)),
          f"{path}: numbers of nodes")
    for words, wanted in zip(nodes, meant["points"]):
        check(same_numbers([float(word) for word in words[1:]], wanted), f"{path}: node {words}")
    elements, element_sets = {}, {}
    for keyword, parameters, data in blocks:
        if keyword == "*ELEMENT":
            check(parameters["TYPE"] == ("C3D4" if "faces" in meant else "S3"), f"{path}: type")
            for number, *corners in data:
                elements[int(number)] = [int(v) - 1 for v in corners]
        if "ELSET" in parameters:
            numbers = [row[:1] if keyword == "*ELEMENT" else row for row in data]
            element_sets[parameters["ELSET"]] = [int(n) - 1 for row in numbers for n in row]
    check([elements[i + 1] for i in range(len(elements))] == meant["cells"], f"{path}: elements")
    labels = different([label(name) for name in meant["names"]], "_")
    if "faces" in meant:
        check_sides(path, meant, blocks, elements, labels)
        owners = [{f"BLOCK_{r}" if r else "OUTSIDE"} for r in meant["block_of"]]
    else:
        owners = [{labels[s] for s in entry} for entry in meant["surfaces_of"]]
    found = [set() for _ in owners]
    for name, members in element_sets.items():
        for i in members:
            found[i].add(name)
    check(found == owners, f"{path}: element sets {element_sets}")
    check(sum(map(len, element_sets.values())) == sum(map(len, owners)), f"{path}: set sizes")
    check_with_meshio(path, meant, element_sets)


def check_with_meshio(path, meant, element_sets):
    """Another program's view of nodes, elements and their sets."""
    mesh = meshio.read(path)
    check([same_numbers(list(p), wanted) for p, wanted in zip(mesh.points, meant["points"])]
          == [True] * len(meant["points"]), f"{path}: meshio's points")
    cells = [list(map(int, corners)) for block in mesh.cells for corners in block.data]
    starts = [sum(len(block.data) for block in mesh.cells[:i]) for i in range(len(mesh.cells))]
    order = [i for data in element_numbers(path) for i in data]
    check([corners for _, corners in sorted(zip(order, cells))] == meant["cells"],
          f"{path}: meshio's elements")
    for name, members in element_sets.items():
        blocks = mesh.cell_sets[name]
        found = sorted(order[starts[i] + int(k)] for i, block in enumerate(blocks)
                       if block is not None for k in block)
        check(found == sorted(members), f"{path}: meshio's set {name}: {found}, not {members}")


def element_numbers(path):
    """Per *ELEMENT, the numbers in the file, from 0."""
    return [[int(row[0]) - 1 for row in data]
            for keyword, _, data in read_abaqus(path) if keyword == "*ELEMENT"]


def turned(corners):
    """The same winding from the least corner."""
    at = corners.index(min(corners))
    return tuple(corners[at:] + corners[:at])


def check_sides(path, meant, blocks, elements, labels):
    """The sides in a surface are its faces: wound like them in front, the other way behind."""
    found = {}
    for keyword, parameters, data in blocks:
        if keyword == "*SURFACE":
            check(parameters["TYPE"] == "ELEMENT", f"{path}: type of surface")
            found[parameters["NAME"]] = sorted(
                turned([elements[int(e)][i] for i in SIDES[side]]) for e, side in data)
        if keyword == "*NSET":
            found[parameters["NSET"]] = [int(n) - 1 for row in data for n in row]
    sides = {turned([t[i] for i in side]) for t in meant["cells"] for side in SIDES.values()}
    wanted = {}
    for s, name in enumerate(labels):
        faces = [f for f, owners in zip(meant["faces"], meant["surfaces_of"]) if s in owners]
        wanted[name] = sorted({v for face in faces for v in face})
        for ending, order in (("_FRONT", 1), ("_BACK", -1)):
            these = sorted(turned(f[::order]) for f in faces if turned(f[::order]) in sides)
            if these:
                wanted[name + ending] = these
        pairs = sorted({pair for front, back in meant.get("twins", [])
                        if s in meant["surfaces_of"][front]
                        for pair in zip(meant["faces"][front], meant["faces"][back])
                        if pair[0] != pair[1]})
        if pairs:
            wanted[name + "_PAIRS_FRONT"], wanted[name + "_PAIRS_BACK"] = map(list, zip(*pairs))
    check(found == wanted, f"{path}: sets and surfaces {found}, not {wanted}")


def word(name):
    return re.sub(r"[^0-9A-Za-z-]+", "_", name).strip("_")


def group_members(meant):
    """The names of blocks and surfaces, and of the sides of cuts, with the corners of their elements."""
    groups = {}
    for corners, block in zip(meant["cells"], meant.get("block_of", [])):
        groups.setdefault(f"block_{block}" if block else "outside", []).append(corners)
    names = different([word(name) for name in meant["names"]], "_")
    for corners, surfaces, side in zip(meant.get("faces", meant["cells"]), meant["surfaces_of"], sides_of(meant)):
        for s in surfaces:
            groups.setdefault(names[s], []).append(corners)
            if side:
                groups.setdefault(names[s] + ("", "_front", "_back")[side], []).append(corners)
    return groups


def check_flac3d(path, meant):
    mesh = meshio.read(path)
    check([same_numbers(list(p), wanted) for p, wanted in zip(mesh.points, meant["points"])]
          == [True] * len(meant["points"]), f"{path}: points")
    cells = {block.type: [list(map(int, corners)) for corners in block.data] for block in mesh.cells}
    check(cells == {"tetra": meant["cells"], "triangle": meant["faces"]}, f"{path}: cells {cells}")
    found, starts = {}, [sum(len(block.data) for block in mesh.cells[:i]) for i in range(len(mesh.cells))]
    for key, members in mesh.cell_sets.items():
        found[key.split(":")[1]] = [list(map(int, mesh.cells[i].data[k - starts[i]]))
                                    for i, ks in enumerate(members) for k in ks]
    check(found == group_members(meant), f"{path}: groups {found}")


def check_universal(path, meant):
    """Groups are read here, elements by Gmsh, whose entities are those of property numbers."""
    nodes, elements, _, _ = through_gmsh(path)
    point = [tuple(f"{x:.16g}" for x in p) for p in meant["points"]]
    wanted = Counter()
    for corners in meant["cells"]:
        wanted[4 if "faces" in meant else 2, tuple(point[v] for v in corners)] += 1
    for corners in meant.get("faces", []):
        wanted[2, tuple(point[v] for v in corners)] += 1
    found = Counter()
    for (kind, _, corners), count in elements.items():
        found[kind, tuple(nodes[v] for v in corners)] += count
    check(found == wanted, f"{path}: Gmsh's elements {found - wanted}, not {wanted - found}")
    with open(path, encoding="utf-8") as file:
        datasets = [part.strip("\n").split("\n") for part in re.split(r"(?m)^    -1\n", file.read())]
    datasets = {int(lines[0]): lines[1:] for lines in datasets if lines != [""]}
    found = [[float(x.replace("D", "E")) for x in line.split()] for line in datasets[2411][1::2]]
    check(len(found) == len(meant["points"]) and all(map(same_numbers, found, meant["points"])), f"{path}: nodes")
    corners_of = {int(head.split()[0]): [int(v) - 1 for v in corners.split()]
                  for head, corners in zip(datasets[2412][::2], datasets[2412][1::2])}
    groups, lines = {}, iter(datasets[2467])
    for head in lines:
        count, name, numbers = int(head.split()[7]), next(lines), []
        while len(numbers) < 4 * count:
            line = next(lines)
            numbers += [int(line[k:k + 10]) for k in range(0, len(line), 10)]
        groups[name] = [corners_of[n] for n in numbers[1::4]]
    check(groups == group_members(meant), f"{path}: groups {groups}")


def main():
    check(len(sys.argv) == 2, "usage: read_back.py TERRANE_TESTS")
    check(shutil.which("gmsh"), "there is no program gmsh")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], "[.samples]"], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "TERRANE_SAMPLES": folder})
        for name, extension in (("awkward", ".vtp"), ("grid", ".vtp"), ("tetrahedra", ".vtu"),
                                ("cut", ".vtu")):
            base = os.path.join(folder, name)
            with open(base + ".json", encoding="utf-8") as file:
                meant = json.load(file)
            check_vtk(base + extension, meant)
            check_vtk(base + "_plain" + extension, meant)
            if extension == ".vtp":
                check_legacy(base + ".vtk", meant)
            if extension == ".vtu":  # meshio does not know VTP
                check_meshio_vtu(base + extension, meant)
                check_meshio_vtu(base + "_plain" + extension, meant)
            check_gmsh(base + ".msh", meant)
            check_gmsh(base + "_22.msh", meant)
            check_medit(base + ".mesh", meant)
            check_abaqus(base + ".inp", meant)
            check_universal(base + ".unv", meant)
            if extension == ".vtu":
                check_flac3d(base + ".f3grid", meant)
            print(f"{name}: VTK, gmsh and meshio read what was meant")


main()
