# SPDX-License-Identifier: LGPL-3.0-or-later
"""Files of simulators as libraries of other projects see them."""
import subprocess
import sys

import meshio
import netCDF4
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOExodus import vtkExodusIIReader
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader, vtkXMLUnstructuredGridReader

# The corners of the sides of a tetrahedron in the manual of Exodus II (Mills-Curran et al., figure "Tetra").
EXODUS_SIDES = ((0, 1, 3), (1, 2, 3), (0, 3, 2), (0, 2, 1))


def words(variable):
    """The texts of a variable of characters."""
    return [b"".join(row).rstrip(b"\0").decode() for row in variable[:]]


class Exodus:
    """An Exodus II file by netCDF4, by the names of variables in its manual."""

    def __init__(self, path):
        with netCDF4.Dataset(path) as data:
            data.set_auto_mask(False)
            v = data.variables
            self.points = np.column_stack([v["coord" + axis][:] for axis in "xyz"])
            self.block_order = words(v["eb_names"])
            self.elements, self.blocks = [], {}
            for i, name in enumerate(self.block_order):
                corners = v[f"connect{i + 1}"]
                kind = corners.elem_type
                if kind != {4: "TETRA", 10: "TETRA10"}[corners.shape[1]]:
                    sys.exit(f"{path}: elements {kind} with {corners.shape[1]} nodes")
                self.elements += (corners[:, :4] - 1).tolist()
                self.blocks[name] = corners[:, :4] - 1
            self.side_sets, self.node_sets = {}, {}
            for i, name in enumerate(words(v["ss_names"])):
                elements, sides = v[f"elem_ss{i + 1}"][:] - 1, v[f"side_ss{i + 1}"][:] - 1
                faces = [[self.elements[e][k] for k in EXODUS_SIDES[s]] for e, s in zip(elements, sides)]
                self.side_sets[name] = (elements.tolist(), faces)
            for i, name in enumerate(words(v["ns_names"])):
                self.node_sets[name] = (v[f"node_ns{i + 1}"][:] - 1).tolist()
            self.ids = {kind: v[kind + "_prop1"][:].tolist() for kind in ("eb", "ss", "ns")}


def exodus_by_meshio(path, names):
    mesh = meshio.read(path)
    return dict(zip(names, (np.asarray(block.data).astype(int) for block in mesh.cells)))


def exodus_by_vtk(path):
    """Names of blocks, and how many elements they have."""
    reader = vtkExodusIIReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    kind = reader.ELEM_BLOCK
    names = [reader.GetObjectName(kind, i) for i in range(reader.GetNumberOfObjects(kind))]
    reader.Update()
    blocks = reader.GetOutput().GetBlock(0)
    return sorted(names), {name: blocks.GetBlock(i).GetNumberOfCells() for i, name in enumerate(names)}


class Grid:
    """A grid of VTK: points, cells by their number of nodes, and arrays."""

    def __init__(self, source):
        self._grid = source
        if isinstance(source, str):
            reader = vtkXMLUnstructuredGridReader()
            reader.SetFileName(source)
            reader.Update()
            self._grid = reader.GetOutput()
        self.points = vtk_to_numpy(self._grid.GetPoints().GetData())
        cells = self._grid.GetCells()
        ends, nodes = vtk_to_numpy(cells.GetOffsetsArray()), vtk_to_numpy(cells.GetConnectivityArray())
        lists = [nodes[a:b] for a, b in zip(ends, ends[1:])]
        self.cells = {n: np.array([c for c in lists if len(c) == n]) for n in set(map(len, lists))}

    @staticmethod
    def _array(data, name):
        array = data.GetArray(name)
        if array is None:
            sys.exit(f"read_simulators.py: there is no array {name}")
        return array

    def point_data(self, name):
        return vtk_to_numpy(self._array(self._grid.GetPointData(), name))

    def cell_data(self, name):
        return vtk_to_numpy(self._array(self._grid.GetCellData(), name))

    def point_type(self, name):
        return str(self.point_data(name).dtype)

    def cell_type(self, name):
        return str(self.cell_data(name).dtype)

    def has_global_ids(self):
        """Whether points and cells have them, as arrays of vtkIdType, which GEOS demands."""
        arrays = [self._grid.GetPointData().GetGlobalIds(), self._grid.GetCellData().GetGlobalIds()]
        return all(a is not None and a.GetClassName() == "vtkIdTypeArray" for a in arrays)

    def global_cell_ids(self):
        return vtk_to_numpy(self._grid.GetCellData().GetGlobalIds())


def comment_list(path):
    """The lists in the comment of a VTU: {heading: {number: name}}."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    lists, heading = {}, None
    for line in text[text.index("<!--\n") + 5:text.index("-->")].splitlines():
        if line.endswith(":"):
            heading = lists.setdefault(line[:-1], {})
        else:
            number, name = line.split(" ", 1)
            heading[int(number)] = name
    return lists


def multi_block(path):
    reader = vtkXMLMultiBlockDataReader()
    reader.SetFileName(path)
    reader.Update()
    blocks = reader.GetOutput()
    names = [blocks.GetMetaData(i).Get(blocks.NAME()) for i in range(blocks.GetNumberOfBlocks())]
    return {name: Grid(blocks.GetBlock(i)) for i, name in enumerate(names)}


def ugi(path):
    """Cells and vertices: PFLOTRAN's user guide, "Unstructured grid"."""
    with open(path, encoding="utf-8") as file:
        cells, points = map(int, file.readline().split())
        lines = [file.readline().split() for _ in range(cells)]
        if any(line[0] != "T" or len(line) != 5 for line in lines):
            sys.exit(f"{path}: cells that are no tetrahedra")
        vertices = np.array([[float(x) for x in file.readline().split()] for _ in range(points)])
        if file.read():
            sys.exit(f"{path}: lines after the last vertex")
    return np.array([[int(v) - 1 for v in line[1:]] for line in lines]), vertices


def side_set(path):
    with open(path, encoding="utf-8") as file:
        count = int(file.readline())
        lines = [line.split() for line in file]
    if len(lines) != count or any(line[0] != "T" for line in lines):
        sys.exit(f"{path}: {len(lines)} lines for {count} faces")
    return [[int(v) - 1 for v in line[1:]] for line in lines]


class Msh:
    """MSH by meshio."""

    def __init__(self, path):
        self._mesh = meshio.read(path)
        self.points = self._mesh.points
        self.groups = {name: tuple(map(int, data)) for name, data in self._mesh.field_data.items()}

    def cells_of(self, kind, group):
        found = [block.data[members] for block, members in zip(self._mesh.cells, self._mesh.cell_sets[group])
                 if block.type == kind and members is not None and len(members)]
        return np.concatenate(found) if found else np.empty((0, 0), dtype=int)

    def places_of(self, kind, group):
        return {frozenset(map(tuple, self.points[c].tolist())) for c in self.cells_of(kind, group)}


def open_with_gmsh(path):
    run = subprocess.run(["gmsh", path, "-save", "-format", "msh22", "-o", path + ".by_gmsh", "-v", "2"],
                         capture_output=True, text=True, check=False)
    said = run.stdout + run.stderr
    if run.returncode != 0 or "Error" in said or "Warning" in said:
        sys.exit(f"gmsh on {path}: {said}")


def second_order_by_vtk(path):
    grid = Grid(path)
    return grid.points, grid.cells[10]


def second_order_by_meshio(path):
    mesh = meshio.read(path)
    return mesh.points, np.concatenate([block.data for block in mesh.cells if block.type == "tetra10"])


def least_jacobian(points, cells):
    """The least determinant at the ten nodes, by the shape functions of quadratic tetrahedra."""
    nodes = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (.5, 0, 0), (.5, .5, 0), (0, .5, 0), (0, 0, .5), (.5, 0, .5), (0, .5, .5)]
    least = np.inf
    for r, s, t in nodes:
        u = 1 - r - s - t
        slopes = np.array([[1 - 4 * u] * 3, [4 * r - 1, 0, 0], [0, 4 * s - 1, 0], [0, 0, 4 * t - 1],
                           [4 * (u - r), -4 * r, -4 * r], [4 * s, 4 * r, 0], [-4 * s, 4 * (u - s), -4 * s],
                           [-4 * t, -4 * t, 4 * (u - t)], [4 * t, 0, 4 * r], [0, 4 * t, 4 * s]])
        least = min(least, np.linalg.det(np.einsum("cni,nj->cij", points[cells], slopes)).min())
    return least


def abaqus_sets(path):
    mesh = meshio.read(path)
    sets = {}
    for name, members in mesh.cell_sets.items():
        found = [block.data[m] for block, m in zip(mesh.cells, members) if m is not None and len(m)]
        if found:
            sets[name] = np.concatenate(found)
    return sets
