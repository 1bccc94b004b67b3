#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Opens what Terrane writes with VTK and gmsh and compares it with what was meant.

usage: read_back.py TERRANE_TESTS

Needs VTK's Python modules and the program gmsh; without either it fails.
"""
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
from collections import Counter

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
    check(found == meant["names"], f"{path}: names {found}")
    check_lists(field, meant["surfaces_of"], path)
    check_cell_data(path, grid.GetCellData(), meant)


def check_cell_data(path, data, meant):
    tetrahedra = len(meant["cells"]) if "faces" in meant else 0
    wanted = {
        "surface": [-1] * tetrahedra + [entry[0] for entry in meant["surfaces_of"]],
        "surface_count": [0] * tetrahedra + [len(entry) for entry in meant["surfaces_of"]],
    }
    if tetrahedra:
        wanted["region"] = meant["region_of"] + [-1] * len(meant["faces"])
    for array, lists in (("region", "regions_of"), ("parent", "parents_of")):
        if meant.get(lists):
            wanted[array] = [entry[0] for entry in meant[lists]]
    for name, values in wanted.items():
        check(scalars(data, name) == values, f"{path}: array {name}")


def through_gmsh(path):
    """Nodes and elements {(type, physical tag, nodes): count}, as gmsh writes them in MSH 2.2."""
    out = path + ".22.msh"
    run = subprocess.run(["gmsh", path, "-save", "-format", "msh22", "-o", out, "-v", "2"],
                         capture_output=True, text=True)
    said = run.stdout + run.stderr
    check(run.returncode == 0 and "Error" not in said and "Warning" not in said,
          f"gmsh on {path}: {said}")
    with open(out, encoding="utf-8") as file:
        lines = iter(file.read().split("\n"))
    nodes, elements, names = {}, Counter(), {}
    for line in lines:
        if line == "$PhysicalNames":
            for _ in range(int(next(lines))):
                dimension, tag, name = next(lines).split(" ", 2)
                names[int(dimension), int(tag)] = name.strip('"')
        if line == "$Nodes":
            for _ in range(int(next(lines))):
                tag, *xyz = next(lines).split()
                nodes[int(tag)] = xyz
        if line == "$Elements":
            for _ in range(int(next(lines))):
                words = [int(word) for word in next(lines).split()]
                corners = tuple(words[3 + words[2]:])
                elements[words[1], words[3], corners] += 1
    return nodes, elements, names


def check_gmsh(path, meant):
    nodes, elements, names = through_gmsh(path)
    triangles = meant.get("faces", meant["cells"])
    used = sorted({v for cell in meant["cells"] + triangles for v in cell})
    check(len(nodes) == len(used), f"{path}: {len(nodes)} nodes")
    number = {v: i + 1 for i, v in enumerate(used)}  # gmsh saves no others, and counts anew
    for v in used:
        wanted = [f"{x:.16g}" for x in meant["points"][v]]  # the digits that gmsh prints
        check(nodes[number[v]] == wanted, f"{path}: node {nodes[number[v]]}, not {wanted}")
    wanted = Counter()
    for corners, surfaces in zip(triangles, meant["surfaces_of"]):
        for surface in surfaces:
            wanted[2, surface + 1, tuple(number[v] for v in corners)] += 1
    for corners, region in zip(meant["cells"], meant.get("region_of", [])):
        wanted[4, region + 1, tuple(number[v] for v in corners)] += 1
    check(elements == wanted, f"{path}: elements {elements - wanted}, not {wanted - elements}")
    check(sum(dimension == 2 for dimension, _ in names) == len(meant["names"]),
          f"{path}: names {names}")


def main():
    check(len(sys.argv) == 2, "usage: read_back.py TERRANE_TESTS")
    check(shutil.which("gmsh"), "there is no program gmsh")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], "[.samples]"], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "TERRANE_SAMPLES": folder})
        for name, extension in (("awkward", ".vtp"), ("grid", ".vtp"), ("tetrahedra", ".vtu")):
            base = os.path.join(folder, name)
            with open(base + ".json", encoding="utf-8") as file:
                meant = json.load(file)
            check_vtk(base + extension, meant)
            check_vtk(base + "_plain" + extension, meant)
            check_gmsh(base + ".msh", meant)
            print(f"{name}: VTK and gmsh read what was meant")


main()
