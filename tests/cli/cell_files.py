#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Reads back what `terrane grid` and `terrane prisms` write: with VTK, with Python's csv, and corner-point grids and Gmsh's meshes
by the descriptions of their formats.

    tests/cli/cell_files.py TERRANE

A tilted plane in a box has a volume in closed form below it; so do the cells of each format, and each cell has the same block in
all of them.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile
from collections import defaultdict

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLRectilinearGridReader, vtkXMLUnstructuredGridReader

LOW, HIGH = np.array([461000.1, 5932000.7, -2000.0]), np.array([461800.1, 5932600.7, -1500.0])
SIZE = HIGH - LOW


def check(condition, what):
    if not condition:
        sys.exit(f"cell_files.py: {what}")


def plane():
    """A surface that falls from -1600 in the west to -1900 in the east, and runs beyond the box."""
    x = (LOW[0] - SIZE[0], HIGH[0] + SIZE[0])
    z = (-1600 + 300, -1900 - 300)
    y = (LOW[1] - SIZE[1], HIGH[1] + SIZE[1])
    corners = [(x[0], y[0], z[0]), (x[1], y[0], z[1]), (x[1], y[1], z[1]), (x[0], y[1], z[0])]
    return "o slope\n" + "".join(f"v {a!r} {b!r} {c!r}\n" for a, b, c in corners) + "f 1 2 3\nf 1 3 4\n"


class Image:
    """Cells of a VTK file: planes, blocks of centres, and volumes by block."""

    def __init__(self, path):
        reader = vtkXMLImageDataReader() if path.suffix == ".vti" else vtkXMLRectilinearGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        grid = reader.GetOutput()
        self.blocks = vtk_to_numpy(grid.GetCellData().GetArray("block"))
        fractions = vtk_to_numpy(grid.GetCellData().GetArray("fraction"))
        field = {name: vtk_to_numpy(grid.GetFieldData().GetArray(name)) for name in ("share_cell", "share_block", "share_fraction")}
        names = bytes(vtk_to_numpy(grid.GetFieldData().GetArray("block_name"))).split(b"\0")[:-1]
        self.names = [name.decode() for name in names]
        sizes = np.array([np.prod(np.subtract(b[1::2], b[::2])) for b in (grid.GetCell(c).GetBounds() for c in range(len(fractions)))])
        self.centres = np.array([np.add(b[1::2], b[::2]) / 2 for b in (grid.GetCell(c).GetBounds() for c in range(len(fractions)))])
        shared = set(field["share_cell"].tolist())
        self.volumes = defaultdict(float)
        for cell, (block, fraction) in enumerate(zip(self.blocks, fractions)):
            if cell not in shared:
                check(fraction == 1, "a cell with one block is full of it")
                self.volumes[int(block)] += sizes[cell]
        for cell, block, fraction in zip(*field.values()):
            check(0 < fraction < 1, "shares are parts")
            check(block != self.blocks[cell] or fraction == fractions[cell], "the share of the block of the centre")
            self.volumes[int(block)] += fraction * sizes[cell]


def keywords(text):
    """The values of each keyword of a GRDECL file: -- begins a comment, / ends values, 3*1 repeats one."""
    found, name = {}, None
    for line in text.splitlines():
        for word in line.split("--")[0].split():
            if name is None:
                name, found[word] = word, []
            elif word == "/":
                name = None
            elif "*" in word:
                count, value = word.split("*")
                found[name] += int(count) * [value]
            else:
                found[name].append(word)
    return found


def corner_points(path):
    """Centres, volumes, FIPNUM, ACTNUM and MULTPV of the cells of a corner-point grid with vertical pillars."""
    found = keywords(path.read_text())
    nx, ny, nz = map(int, found["SPECGRID"][:3])
    pillars = np.array(found["COORD"], float).reshape(ny + 1, nx + 1, 2, 3)
    check((pillars[..., 0, :2] == pillars[..., 1, :2]).all(), "pillars are vertical")
    depths = np.array(found["ZCORN"], float).reshape(nz, 2, ny, 2, nx, 2)
    check((np.diff(depths, axis=1) > 0).all(), "the base of a cell is below its top: depths grow downward")
    thickness = (depths[:, 1] - depths[:, 0]).mean(axis=(2, 4))
    x, y = pillars[..., 0, 0], pillars[..., 0, 1]
    areas = np.diff(x, axis=1)[:-1] * np.diff(y, axis=0)[:, :-1]
    middle = [np.broadcast_to((a[:-1, :-1] + a[1:, 1:]) / 2, thickness.shape) for a in (x, y)]
    centres = np.stack((*middle, -depths.mean(axis=(1, 3, 5))), -1)
    arrays = [np.array(found[name], float).reshape(nz, ny, nx) for name in ("FIPNUM", "ACTNUM", "MULTPV")]
    return centres, thickness * areas, *arrays


TENT = """v 0 0 0
v 4 0 2
v 4 4 2
v 0 4 0
v 8 0 0
v 8 4 0
f 1 2 3
f 1 3 4
f 2 5 6
f 2 6 3
"""
#: Faces of Gmsh's prisms, pyramids and tetrahedra, counterclockwise from outside.
GMSH_FACES = {6: ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
              7: ((3, 2, 1, 0), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)), 4: ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))}


def volume_of_faces(points, faces):
    """The volume within faces, by the divergence theorem."""
    return sum(np.dot(points[f[0]], np.cross(points[f[k]], points[f[k + 1]])) for f in faces for k in range(1, len(f) - 1)) / 6


def check_prisms(program, folder, floor, expected, types):
    (folder / "tent.obj").write_text(TENT)
    (folder / "floor.obj").write_text("".join(f"v {x} {y} {floor}\n" for x, y in ((-1, -1), (9, -1), (9, 9), (-1, 9)))
                                      + "f 1 2 3\nf 1 3 4\n")
    subprocess.run([program, "prisms", "tent.obj", "floor.obj", "--layers", "3", "-o", "p.vtu", "-o", "p.msh", "--quiet"], cwd=folder,
                   check=True, stdout=subprocess.DEVNULL)
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder / "p.vtu"))
    sizes = vtkCellSizeFilter()
    sizes.SetInputConnection(reader.GetOutputPort())
    sizes.Update()
    grid = sizes.GetOutput()
    volumes = vtk_to_numpy(grid.GetCellData().GetArray("Volume"))
    kinds = [grid.GetCellType(c) for c in range(grid.GetNumberOfCells())]
    check(set(kinds) == types and len(kinds) == 12, "types of cells")
    layers = vtk_to_numpy(grid.GetCellData().GetArray("layer"))
    check((volumes > 0).all() and abs(volumes.sum() - expected) < 1e-12 * expected, "VTK finds the volume of the tent, and no cell turned over")
    check([round(volumes[layers == n].sum(), 9) for n in (1, 2, 3)] == 3 * [round(expected / 3, 9)], "layers are equally thick")
    lines = iter((folder / "p.msh").read_text().splitlines())
    points, total = {}, 0
    for line in lines:
        if line == "$Nodes":
            for _ in range(int(next(lines))):
                number, *place = next(lines).split()
                points[int(number)] = np.array(place, float)
        if line == "$Elements":
            for cell in range(int(next(lines))):
                _, kind, tags, *rest = map(int, next(lines).split())
                check(rest[0] == layers[cell], "both number the layers alike")
                nodes = [points[n] for n in rest[tags:]]
                volume = volume_of_faces(nodes, GMSH_FACES[kind])
                check(abs(volume - volumes[cell]) < 1e-12, "cells of Gmsh have the volumes that VTK finds")
                total += volume
    check(abs(total - expected) < 1e-12 * expected, "the volume of the tent in Gmsh's format")


def check_pillars(program, folder):
    """Two levels with a throw of 30 at x = 200, on pillars there: each side keeps its depth, and volumes are those of boxes."""
    for name, z in (("top", -100), ("base", -200)):
        corners = [(x, y, z - down) for down, xs in ((0, (0, 200)), (30, (200, 400))) for x, y in
                   ((xs[0], 0), (xs[1], 0), (xs[1], 400), (xs[0], 400))]
        (folder / f"{name}.obj").write_text("".join(f"v {x} {y} {h}\n" for x, y, h in corners)
                                            + "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\n")
    subprocess.run([program, "pillars", "top.obj", "base.obj", "--step", "100", "--layers", "5", "-o", "f.grdecl", "--quiet"],
                   cwd=folder, check=True, stdout=subprocess.DEVNULL)
    found = keywords((folder / "f.grdecl").read_text())
    check(found["SPECGRID"][:3] == ["4", "4", "5"], "the size of the grid")
    check(set(found["ACTNUM"]) == {"1"} and set(found["FIPNUM"]) == {"1"}, "all cells are active, in one unit")
    depths = np.array(found["ZCORN"], float).reshape(5, 2, 4, 2, 4, 2)
    pillars = np.array(found["COORD"], float).reshape(5, 5, 2, 3)
    check((pillars[:, :, 0, 0] == np.arange(5) * 100).all() and (pillars[:, :, 0, 1].T == np.arange(5) * 100).all(), "pillars")
    for side, columns in ((0, depths[..., :2, :]), (30, depths[..., 2:, :])):
        for layer in range(5):
            check((columns[layer, 0] == 100 + side + 20 * layer).all() and (columns[layer, 1] == 120 + side + 20 * layer).all(),
                  "nodes on the fault are split")
    check((depths[..., 1, 1] != depths[..., 2, 0]).all(), "columns on both sides of the fault differ on its pillars")


def main():
    program = str(pathlib.Path(sys.argv[1]).absolute())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "slope.obj").write_text(plane())
        box = ",".join(repr(float(v)) for v in (*LOW, *HIGH))
        subprocess.run([program, "grid", "slope.obj", "--box", box, "--cells", "7,5,9", "-o", "g.vti", "-o", "g.vtr", "-o", "g.csv",
                        "-o", "g.grdecl", "--quiet"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        images = [Image(folder / f"g.{kind}") for kind in ("vti", "vtr")]
        below = images[0].names.index("below slope")
        expected = SIZE[0] * SIZE[1] * (-1750 - LOW[2])
        for image in images:
            check(abs(image.volumes[below] - expected) < 1e-9 * expected, "the volume below the plane")
            check((image.blocks == images[0].blocks).all(), "both have the same blocks")
            heights = -1600 - 300 * (image.centres[:, 0] - LOW[0]) / SIZE[0]
            check(((image.blocks == below) == (image.centres[:, 2] < heights)).all(), "centres are below the plane, or above it")
        volume, sums = 0, defaultdict(float)
        for row in csv.DictReader((folder / "g.csv").open()):
            sums[row["i"], row["j"], row["k"]] += float(row["fraction"])
            volume += float(row["fraction"]) * np.prod(SIZE) / 315 * (row["name"] == "below slope")
            if row["centre"] == "1":
                cell = ((int(row["k"]) - 1) * 5 + int(row["j"]) - 1) * 7 + int(row["i"]) - 1
                check(int(row["block"]) == images[0].blocks[cell], "the table has the same blocks")
        check(len(sums) == 315 and all(abs(s - 1) < 1e-15 for s in sums.values()), "fractions of a cell add up to 1")
        check(abs(volume - expected) < 1e-9 * expected, "the volume of the table")
        centres, volumes, blocks, active, parts = corner_points(folder / "g.grdecl")
        check((blocks[::-1].ravel() == images[0].blocks).all(), "layers run downward, with the same blocks")
        check((active == 1).all() and (parts == 1).all(), "the box is full of blocks")
        check(np.allclose(centres[::-1].reshape(-1, 3), images[0].centres, rtol=1e-12), "cells are in the same places")
        check(abs(volumes.sum() - np.prod(SIZE)) < 1e-9 * np.prod(SIZE), "cells fill the box")
        check_pillars(program, folder)
        check_prisms(program, folder, 0, 32, {10, 14})  # tetrahedra and pyramids
        check_prisms(program, folder, -3, 128, {13})  # wedges


if __name__ == "__main__":
    main()
