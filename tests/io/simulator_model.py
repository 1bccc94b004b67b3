# SPDX-License-Identifier: LGPL-3.0-or-later
"""A model with two faults, and what files with its tetrahedra must hold: worked out from its VTU and from places."""
import itertools
import os
import re
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

NAME = "top of a formation, with a name of more than thirty-two letters"
LONG = "top_of_a_formation_with_a_name_of_more_than_thirty-two_letters"


def check(condition, what):
    if not condition:
        sys.exit(f"read_simulators.py: {what}")


def surface(name, corners):
    """A GOCAD surface of two triangles."""
    lines = [f"VRTX {i + 1} {x} {y} {z}" for i, (x, y, z) in enumerate(corners)]
    return "\n".join(["GOCAD TSurf 1", "HEADER {", f"name:{name}", "}", "TFACE", *lines, "TRGL 1 2 3", "TRGL 1 3 4", "END", ""])


def make_model(folder):
    """A horizon through a box of 4 by 4 by 4, a fault right through both, and one in its eastern part that reaches the top
    of the box, and ends at x = 2, at x = 3 and at z = 1."""
    surfaces = {"horizon.ts": (NAME, [(-1, -1, 2.25), (5, -1, 2.25), (5, 5, 2.5), (-1, 5, 2.5)]),
                "f1.ts": ("F 1", [(0.5, -1, -1), (0.5, 5, -1), (1.5, 5, 5), (1.5, -1, 5)]),
                "f2.ts": ("F2", [(2, 2, 1), (3, 2, 1), (3, 2, 5), (2, 2, 5)])}
    for file, (name, corners) in surfaces.items():
        with open(os.path.join(folder, file), "w", encoding="utf-8") as out:
            out.write(surface(name, corners))


def volume(points, corners):
    a, b, c, d = (points[corners[..., k]] for k in range(4))
    return np.einsum("...i,...i", np.cross(b - a, c - a), d - a) / 6


def outward(points, face, corners):
    """Whether the corners of a face are counterclockwise seen from outside of its tetrahedron."""
    apex = [v for v in corners if v not in set(int(f) for f in face)]
    return len(apex) == 1 and volume(points, np.array([*face[:3], apex[0]], dtype=int)) < 0


def word(name):
    return re.sub("[^A-Za-z0-9-]+", "_", name).strip("_")


class Expected:
    """What files must hold: a tetrahedron is known by its number in the VTU, a node by its index."""

    def __init__(self, path):
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(path)
        reader.Update()
        grid = reader.GetOutput()
        self.points = vtk_to_numpy(grid.GetPoints().GetData())
        cells = [[grid.GetCell(i).GetPointId(k) for k in range(grid.GetCell(i).GetNumberOfPoints())]
                 for i in range(grid.GetNumberOfCells())]
        data = {grid.GetCellData().GetArrayName(i): vtk_to_numpy(grid.GetCellData().GetArray(i))
                for i in range(grid.GetCellData().GetNumberOfArrays())}
        field = {grid.GetFieldData().GetArrayName(i): vtk_to_numpy(grid.GetFieldData().GetArray(i))
                 for i in range(grid.GetFieldData().GetNumberOfArrays())}
        count = sum(len(c) == 4 for c in cells)
        self.tetrahedra = np.array(cells[:count])
        self.number = {tuple(c): i for i, c in enumerate(cells[:count])}
        self.faces = [tuple(c) for c in cells[count:]]
        self.twins = [(f, t - count) for f, (t, s) in enumerate(zip(data["twin"][count:], data["cut_side"][count:]))
                      if s == 1] if "twin" in data else []
        self.surfaces = [word(t.decode()) for t in bytes(field["surface_name"]).split(b"\0")[:-1]]
        self.is_fault = [t == b"fault" for t in bytes(field["surface_role"]).split(b"\0")[:-1]]
        if "surfaces" in field:
            ends = field["surfaces_offset"]
            self.surfaces_of = [field["surfaces"][a:b].tolist() for a, b in zip(ends, ends[1:])]
        else:
            self.surfaces_of = [[s] for s in data["surface"][count:]]
        self.block = data["block"][:count]
        names = [t.decode() for t in bytes(field["block_name"]).split(b"\0")[:-1]]
        self.blocks = {word(names[r]): {tuple(c) for c in self.tetrahedra[self.block == r].tolist()}
                       for r in set(self.block.tolist())}
        self._of_node = {}
        for t, corners in enumerate(cells[:count]):
            for v in corners:
                self._of_node.setdefault(v, set()).add(t)
        self.sides = self._sides()

    def volumes(self, corners):
        return volume(self.points, np.asarray(corners))

    def tetrahedra_with(self, face):
        return sorted(set.intersection(*(self._of_node[int(v)] for v in face)))

    def _faces_of(self, s):
        return [f for f, owners in enumerate(self.surfaces_of) if s in owners]

    def _sides(self):
        """The element faces in front of each surface, from which its triangles are counterclockwise, and behind it."""
        sides = {}
        for s, name in enumerate(self.surfaces):
            front, back = set(), set()
            for f in self._faces_of(s):
                for t in self.tetrahedra_with(self.faces[f]):
                    inwards = not outward(self.points, self.faces[f], self.tetrahedra[t])
                    (front if inwards else back).add((t, frozenset(self.faces[f])))
            if front and back:
                sides[name + "_front"], sides[name + "_back"] = front, back
            elif front or back:
                sides[name] = front | back
        return sides

    def _split(self):
        return {s for f, _ in self.twins for s in self.surfaces_of[f]}

    def point_sets(self):
        """Nodes of each surface; of split ones also those of the faces on each side."""
        sets = {}
        for s, name in enumerate(self.surfaces):
            sets[name] = {v for f in self._faces_of(s) for v in self.faces[f]}
            if s in self._split():
                for side in (name + "_front", name + "_back"):
                    sets[side] = {v for _, face in self.sides[side] for v in face}
        return {name: nodes for name, nodes in sets.items() if nodes}

    def pairs(self, name):
        s = self.surfaces.index(name)
        return {(a, b) for front, back in self.twins if s in self.surfaces_of[front]
                for a, b in zip(self.faces[front], self.faces[back]) if a != b}

    def node_sets(self):
        """Those of Exodus II: F2 is the only fault that ends inside, at places that are known."""
        sets = self.point_sets()
        for s in self._split():
            for k, ending in enumerate(("_pairs_front", "_pairs_back")):
                sets[self.surfaces[s] + ending] = {pair[k] for pair in self.pairs(self.surfaces[s])}
        x, _, z = self.points.T
        sets["F2_edges"] = {v for v in sets["F2"] if x[v] in (2, 3) or z[v] == 1}
        return sets

    def at(self, place):
        return np.flatnonzero((self.points == place).all(axis=1)).tolist()

    def _places(self, corners):
        return frozenset(map(tuple, self.points[list(corners)].tolist()))

    def places_of_surface(self, name):
        return {self._places(self.faces[f]) for f in self._faces_of(self.surfaces.index(name))}

    def places_of_twins(self, name):
        s = self.surfaces.index(name)
        return {self._places(self.faces[f]) for f, _ in self.twins if s in self.surfaces_of[f]}

    def places_of_block(self, block):
        return {self._places(c) for c in self.tetrahedra[self.block == block]}

    def middles_are_split(self, points, cells):
        """Tetrahedra on the two sides of a pair of faces that are not one share no node in the middle of an edge, but on
        the edges at which a fault ends; all other tetrahedra with an edge in common share its node."""
        places = {}
        for cell in cells:
            for k, (a, b) in enumerate(((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))):
                edge = tuple(sorted((tuple(points[cell[a]].tolist()), tuple(points[cell[b]].tolist()))))
                places.setdefault(edge, set()).add(int(cell[4 + k]))
        on_cuts = {}
        for f, _ in self.twins:
            corners = [tuple(self.points[v].tolist()) for v in self.faces[f]]
            for edge in itertools.combinations(sorted(corners), 2):
                on_cuts.setdefault(edge, set()).update(self.surfaces_of[f])
        f2 = self.surfaces.index("F2")
        for edge, nodes in places.items():
            ends = on_cuts.get(edge, set()) == {f2} and all(p[0] == 2 for p in edge) | all(p[0] == 3 for p in edge) | \
                all(p[2] == 1 for p in edge)
            if len(nodes) != (2 if edge in on_cuts and not ends else 1):
                return False
        return True
