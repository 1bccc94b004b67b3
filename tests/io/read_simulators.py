#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Reads the files for simulators by other programs' libraries and compares them with what they must hold.

usage: read_simulators.py TERRANE

A box with a horizon, a fault right through and a fault that ends inside is filled with tetrahedra. The VTU of the same
run says what they are; what each format must hold follows from it and from the places of the surfaces. Exodus II is read
by netCDF4, meshio and VTK, the files of OpenGeoSys and GEOS by VTK, MSH by meshio and gmsh, Abaqus by meshio. No library of
Debian reads PFLOTRAN's files: they are read by the few lines of its documentation. Without one of these the test fails.
"""
import os
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import simulator_readers as readers  # noqa: E402
from simulator_examples import check_examples  # noqa: E402
from simulator_model import LONG, Expected, check, make_model, outward  # noqa: E402


def run(program, folder, *arguments):
    made = subprocess.run([program, "tetrahedralize", "horizon.ts", "f1.ts", "f2.ts", "--box", "0,0,0,4,4,4",
                           "--edge-length", "1", "--role", "F 1=fault", "--role", "F2=fault", *arguments],
                          cwd=folder, capture_output=True, text=True, check=False)
    check(made.returncode == 0, f"terrane {arguments}: {made.stdout}{made.stderr}")
    return made.stdout


def same_blocks(what, expected, blocks):
    """Blocks by name: tetrahedra of corners, at places."""
    check(set(blocks) == set(expected.blocks), f"{what}: blocks {sorted(blocks)}, not {sorted(expected.blocks)}")
    for name, corners in blocks.items():
        volumes = expected.volumes(corners)
        check((volumes > 0).all(), f"{what}: {name} has tetrahedra turned over")
        check({tuple(c) for c in corners.tolist()} == expected.blocks[name], f"{what}: tetrahedra of {name}")


def same_sides(what, expected, sides):
    """Side sets by name: {(tetrahedron, its corners on the surface)}."""
    check(set(sides) == set(expected.sides), f"{what}: side sets {sorted(sides)}, not {sorted(expected.sides)}")
    for name, found in sides.items():
        check(found == expected.sides[name], f"{what}: faces of {name}")


def check_exodus(expected, path):
    what = "Exodus II by netCDF4"
    exodus = readers.Exodus(path)
    check(np.array_equal(exodus.points, expected.points), f"{what}: coordinates")
    same_blocks(what, expected, exodus.blocks)
    sides = {}
    for name, (elements, faces) in exodus.side_sets.items():
        for element, face in zip(elements, faces):
            check(outward(expected.points, face, exodus.elements[element]), f"{what}: {name} points inwards")
        sides[name] = {(tuple(exodus.elements[e]), frozenset(f)) for e, f in zip(elements, faces)}
    same_sides(what, expected, {name: {(expected.number[e], f) for e, f in found} for name, found in sides.items()})
    check(max(map(len, exodus.side_sets)) > 32, f"{what}: no name is longer than 32 characters")
    wanted = expected.node_sets()
    check(set(exodus.node_sets) == set(wanted), f"{what}: node sets {sorted(exodus.node_sets)}, not {sorted(wanted)}")
    for name, nodes in exodus.node_sets.items():
        check(name.endswith(("_pairs_front", "_pairs_back")) or set(nodes) == wanted[name], f"{what}: nodes of {name}")
    for name in ("F_1", "F2"):
        front, back = exodus.node_sets[name + "_pairs_front"], exodus.node_sets[name + "_pairs_back"]
        check(set(zip(front, back)) == expected.pairs(name), f"{what}: pairs of {name}")
        check(len(front) == len(expected.pairs(name)) > 0, f"{what}: number of pairs of {name}")
    for kind, ids in exodus.ids.items():
        check(len(set(ids)) == len(ids) and min(ids) > 0, f"{what}: numbers of {kind} {ids}")
    same_blocks("Exodus II by meshio", expected, readers.exodus_by_meshio(path, exodus.block_order))
    names, sizes = readers.exodus_by_vtk(path)
    check(names == sorted(exodus.blocks), f"Exodus II by VTK: blocks {names}")
    check(sizes == {name: len(corners) for name, corners in exodus.blocks.items()}, "Exodus II by VTK: sizes")


def check_opengeosys(expected, folder):
    what = "OpenGeoSys by VTK"
    bulk = readers.Grid(os.path.join(folder, "ogs.vtu"))
    check(np.array_equal(bulk.points, expected.points), f"{what}: coordinates")
    check(bulk.cell_type("MaterialIDs") == "int32", f"{what}: MaterialIDs are {bulk.cell_type('MaterialIDs')}")
    material, names = bulk.cell_data("MaterialIDs"), readers.comment_list(os.path.join(folder, "ogs.vtu"))
    check(set(material) == set(names["MaterialIDs"]), f"{what}: MaterialIDs without a name")
    same_blocks(what, expected, {names["MaterialIDs"][m]: bulk.cells[4][material == m] for m in set(material)})
    sides = {}
    for file in sorted(os.listdir(folder)):
        if not file.startswith("ogs_"):
            continue
        side, name = readers.Grid(os.path.join(folder, file)), file[4:-4]
        for kind, array in ((side.point_type, "bulk_node_ids"), (side.cell_type, "bulk_element_ids")):
            check(kind(array) == "uint64", f"{what}: {array} of {name} are {kind(array)}")
        nodes, elements = side.point_data("bulk_node_ids"), side.cell_data("bulk_element_ids")
        check(np.array_equal(side.points, bulk.points[nodes]), f"{what}: points of {name}")
        faces = nodes[side.cells[3]]
        for face, element in zip(faces, elements):
            check(outward(bulk.points, face, bulk.cells[4][element]), f"{what}: {name} points inwards")
        sides[name] = {(int(e), frozenset(f.tolist())) for e, f in zip(elements, faces)}
    same_sides(what, expected, sides)


def check_pflotran(expected, folder):
    what = "PFLOTRAN"
    cells, points = readers.ugi(os.path.join(folder, "flow.ugi"))
    check(np.array_equal(points, expected.points), f"{what}: coordinates")
    blocks, sides = {}, {}
    for file in sorted(os.listdir(folder)):
        path, name = os.path.join(folder, file), file[5:].rpartition(".")[0]
        if file.startswith("flow_") and file.endswith(".txt"):
            blocks[name] = cells[np.loadtxt(path, dtype=int, ndmin=1) - 1]
        if file.startswith("flow_") and file.endswith(".ss"):
            sides[name] = set()
            for face in readers.side_set(path):
                owner = [t for t in expected.tetrahedra_with(face) if outward(points, face, cells[t])]
                check(len(owner) == 1, f"{what}: {name} has {len(owner)} cells behind a face")
                sides[name].add((owner[0], frozenset(face)))
    same_blocks(what, expected, blocks)
    same_sides(what, expected, sides)


def check_geos(expected, folder):
    what = "GEOS by VTK"
    grids = readers.multi_block(os.path.join(folder, "geos.vtm"))
    check(sorted(grids) == ["F2", "F_1", "main"], f"{what}: blocks {sorted(grids)}")
    main, names = grids["main"], readers.comment_list(os.path.join(folder, "geos_main.vtu"))
    check(np.array_equal(main.points, expected.points), f"{what}: coordinates")
    block, count = main.cell_data("attribute"), len(main.cells[4])
    check(main.cell_type("attribute") == "int32", f"{what}: attribute is {main.cell_type('attribute')}")
    of_blocks = names["attribute of tetrahedra"]
    same_blocks(what, expected, {of_blocks[r]: main.cells[4][block[:count] == r] for r in set(block[:count])})
    check(set(block[count:]) == set(names["attribute of triangles"]), f"{what}: attributes of triangles")
    for name, nodes in expected.point_sets().items():
        check(main.point_type(name) == "int64", f"{what}: array {name} is {main.point_type(name)}")
        check(set(np.flatnonzero(main.point_data(name) == 1)) == nodes, f"{what}: points of {name}")
    ids = []
    for name, grid in grids.items():
        check(grid.has_global_ids(), f"{what}: {name} has no global ids")
        if name == "main":
            continue
        ids += grid.global_cell_ids().tolist()
        buckets = grid.point_data("collocated_nodes")
        for place, bucket in zip(grid.points, buckets):
            nodes = bucket[bucket >= 0]
            check((main.points[nodes] == place).all() and set(nodes) == set(expected.at(place)),
                  f"{what}: nodes of {name} at {place}: {bucket}")
        faces = {frozenset(map(tuple, grid.points[corners].tolist())) for corners in grid.cells[3]}
        check(faces == expected.places_of_twins(name) and len(faces) == len(grid.cells[3]), f"{what}: faces of {name}")
    check(sorted(ids) == list(range(len(ids))), f"{what}: ids of fractures are not counted on")


def check_pylith(expected, path):
    what = "PyLith's MSH by meshio"
    mesh = readers.Msh(path)
    numbers = [number for number, _ in mesh.groups.values()]
    check(len(set(numbers)) == len(numbers), f"{what}: numbers of groups are not unique: {mesh.groups}")
    names = {name for name, (_, dimension) in mesh.groups.items() if dimension == 3}
    check(names == {f"material-id:{r}" for r in range(1, 5)}, f"{what}: materials {names}")
    check(all(mesh.groups[name][0] == int(name.split(":")[1]) for name in names), f"{what}: numbers of materials")
    for block in range(1, 5):
        corners = {frozenset(map(tuple, mesh.points[c].tolist())) for c in mesh.cells_of("tetra", f"material-id:{block}")}
        check(corners == expected.places_of_block(block), f"{what}: tetrahedra of {block}")
    for name in expected.surfaces:
        check(mesh.places_of("triangle", name) == expected.places_of_surface(name), f"{what}: faces of {name}")
    lines = {name for name, (_, dimension) in mesh.groups.items() if dimension == 1}
    check(lines == {"F2_edges"}, f"{what}: lines {lines}")
    edges = mesh.points[mesh.cells_of("line", "F2_edges")]
    on = [(edges[:, :, 0] == 2).all(axis=1), (edges[:, :, 0] == 3).all(axis=1), (edges[:, :, 2] == 1).all(axis=1)]
    check(np.logical_or.reduce(on).all(), f"{what}: edges of F2 are elsewhere")
    lengths = np.linalg.norm(edges[:, 0] - edges[:, 1], axis=1)
    check(abs(lengths.sum() - 7) < 1e-9, f"{what}: edges of F2 are {lengths.sum()} long, not 3 + 3 + 1")
    readers.open_with_gmsh(path)


def check_second_order(expected, folder):
    """Ten nodes in the order of VTK, into which meshio brings those of each format."""
    found = {"VTU by VTK": readers.second_order_by_vtk(os.path.join(folder, "two.vtu"))}
    for name in ("two.vtu", "two.msh", "two_22.msh", "two.inp", "two.exo"):
        found[f"{name} by meshio"] = readers.second_order_by_meshio(os.path.join(folder, name))
    for what, (points, cells) in found.items():
        check(len(cells) == len(expected.tetrahedra), f"{what}: {len(cells)} tetrahedra")
        middle = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
        for k, (a, b) in enumerate(middle):
            off = np.abs(points[cells[:, 4 + k]] - (points[cells[:, a]] + points[cells[:, b]]) / 2).max()
            check(off < 1e-14, f"{what}: node {4 + k} is {off} off the middle of its edge")
        check(readers.least_jacobian(points, cells) > 0, f"{what}: Jacobians that are not positive")
        check(len(np.unique(cells)) == len(points), f"{what}: nodes of no tetrahedron")
        # Without cuts a node in the middle for each edge; at cuts one for each side.
        check(expected.middles_are_split(points, cells), f"{what}: nodes on edges of split faults")
    corners = {tuple(c) for c in found["VTU by VTK"][1][:, :4].tolist()}
    check(corners == {tuple(c) for c in expected.tetrahedra.tolist()}, "VTU by VTK: corners")
    exodus = readers.Exodus(os.path.join(folder, "two.exo"))
    for name in ("F_1", "F2"):
        front, back = exodus.node_sets[name + "_pairs_front"], exodus.node_sets[name + "_pairs_back"]
        check(np.array_equal(exodus.points[front], exodus.points[back]), f"Exodus II of order 2: pairs of {name}")
        check(len(front) > 2 * len(expected.pairs(name)), f"Exodus II of order 2: {name} has {len(front)} pairs")
    for name in ("two.msh", "two_22.msh"):
        readers.open_with_gmsh(os.path.join(folder, name))


def check_abaqus(expected, path):
    sets = readers.abaqus_sets(path)
    check(len(sets) == len(expected.blocks), f"Abaqus by meshio: element sets {sorted(sets)}")
    found = {frozenset(map(tuple, corners.tolist())) for corners in sets.values()}
    check(found == {frozenset(corners) for corners in expected.blocks.values()}, "Abaqus by meshio: tetrahedra")


def main():
    check(len(sys.argv) == 2, "usage: read_simulators.py TERRANE")
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        make_model(folder)
        split = ("--split", "fault")
        run(program, folder, "-o", "reference.vtu", "-o", "block.exo", "-o", "flow.ugi", "-o", "solid.inp", *split)
        said = run(program, folder, "-o", "ogs.vtu", "--output-format", "ogs", *split)
        run(program, folder, "-o", "geos.vtm", "--output-format", "geos", *split)
        run(program, folder, "-o", "two.vtu", "-o", "two.msh", "-o", "two.inp", "-o", "two.exo", "--order", "2", *split)
        run(program, folder, "-o", "two_22.msh", "--order", "2", "--msh", "2.2", *split)
        run(program, folder, "-o", "whole.vtu")
        run(program, folder, "-o", "fault.msh", "--output-format", "pylith")
        expected = Expected(os.path.join(folder, "reference.vtu"))
        check(len(expected.sides) == 12, f"the model has other sides: {sorted(expected.sides)}")
        check(f"and {len(expected.sides)} files that begin with ogs_" in said, f"said {said}")
        check(LONG in expected.surfaces, f"names {expected.surfaces}")
        check_exodus(expected, os.path.join(folder, "block.exo"))
        check_opengeosys(expected, folder)
        check_pflotran(expected, folder)
        check_geos(expected, folder)
        check_abaqus(expected, os.path.join(folder, "solid.inp"))
        check_second_order(expected, folder)
        check_pylith(Expected(os.path.join(folder, "whole.vtu")), os.path.join(folder, "fault.msh"))
        check_examples(program, folder)
        print(f"{len(expected.tetrahedra)} tetrahedra: all formats hold what was meant")


main()
