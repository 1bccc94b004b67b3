#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes the files of this folder with VTK, gmsh and meshio (Debian's python3-vtk9, gmsh, python3-meshio).

The .vtu files, and the .vtk files called grid, have a tetrahedron below it, an edge and a point as well. Files called
named have the arrays that Terrane writes into .vtp and .vtu files: what VTK makes of these when it writes .vtk.
All of them hold the same roof: six points, two triangles and a quadrilateral; the gmsh files hold a square
that is divided into two named physical surfaces.

usage: /usr/bin/python3 make.py [FOLDER]
"""
import pathlib
import subprocess
import sys
import tempfile

import meshio
import numpy
from vtkmodules.vtkCommonCore import vtkIntArray, vtkPoints, vtkStringArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (VTK_LINE, VTK_PIXEL, VTK_QUAD, VTK_TETRA, VTK_TRIANGLE,
                                           VTK_VERTEX, vtkCellArray, vtkPolyData,
                                           vtkUnstructuredGrid)
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter, vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter

POINTS = [(0, 0, 0), (2, 0, 0), (2, 1, 0.5), (0, 1, 0.5), (0, 2, 0.1), (2, 2, 0.1)]
TRIANGLES = [(3, 2, 4), (4, 2, 5)]
QUADRILATERAL = (0, 1, 2, 3)

GEO = """
Point(1) = {0, 0, 0, 1}; Point(2) = {1, 0, 0, 1}; Point(3) = {2, 0, 1, 1};
Point(4) = {2, 1, 1, 1}; Point(5) = {1, 1, 0, 1}; Point(6) = {0, 1, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6};
Line(6) = {6, 1}; Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6}; Plane Surface(1) = {1};
Curve Loop(2) = {2, 3, 4, -7}; Plane Surface(2) = {2};
Physical Surface("west", 11) = {1}; Physical Surface("east flank", 12) = {2};
Physical Curve("seam", 5) = {7};
"""


def roof(with_strip=False):
    points, cells = vtkPoints(), vtkCellArray()
    points.SetDataTypeToDouble()
    for p in POINTS:
        points.InsertNextPoint(p)
    for corners in (QUADRILATERAL,) if with_strip else (QUADRILATERAL, *TRIANGLES):
        cells.InsertNextCell(len(corners), corners)
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(cells)
    if with_strip:
        strips = vtkCellArray()
        strips.InsertNextCell(4, (3, 2, 4, 5))
        data.SetStrips(strips)
    return data


def grid(pixel=False):
    """The roof among cells of other kinds."""
    data = vtkUnstructuredGrid()
    data.SetPoints(roof().GetPoints())
    for kind, corners in ((VTK_TETRA, (0, 1, 2, 3)), (VTK_LINE, (0, 1)),
                          (VTK_PIXEL, (0, 1, 3, 2)) if pixel else (VTK_QUAD, QUADRILATERAL),
                          (VTK_VERTEX, (5,)), *((VTK_TRIANGLE, t) for t in TRIANGLES)):
        data.InsertNextCell(kind, len(corners), corners)
    return data


def write_xml(path, mode, compress, big_endian=False, encode=True, wide=False):
    is_grid = path.suffix == ".vtu"
    writer = vtkXMLUnstructuredGridWriter() if is_grid else vtkXMLPolyDataWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(grid(pixel=mode == "ascii") if is_grid else roof())
    {"ascii": writer.SetDataModeToAscii, "binary": writer.SetDataModeToBinary,
     "appended": writer.SetDataModeToAppended}[mode]()
    if compress:
        writer.SetCompressorTypeToZLib()
        writer.SetBlockSize(96)  # so that there are several blocks
    else:
        writer.SetCompressorTypeToNone()
    writer.SetEncodeAppendedData(encode)
    writer.SetHeaderTypeToUInt64() if wide else writer.SetHeaderTypeToUInt32()
    writer.SetByteOrderToBigEndian() if big_endian else writer.SetByteOrderToLittleEndian()
    writer.Write()


def array(kind, name, values):
    made = kind()
    made.SetName(name)
    for value in values:
        made.InsertNextValue(value)
    return made


def named(data):
    """The quadrilateral and the second triangle are of "west flank", the first triangle of "F%1"."""
    if isinstance(data, vtkPolyData):
        for name, values in (("surface_name", ("west flank", "F%1")), ("surface_role", ("horizon", "fault"))):
            data.GetFieldData().AddArray(array(vtkStringArray, name, values))
        data.GetCellData().AddArray(array(vtkIntArray, "surface", (0, 1, 0)))
    else:
        for name, codes in (("surface_name", b"west flank\0F%1\0"), ("surface_role", b"horizon\0fault\0")):
            data.GetFieldData().AddArray(array(vtkUnsignedCharArray, name, codes))
        data.GetCellData().AddArray(array(vtkIntArray, "region", (1, -1, -1, -1, -1, -1)))
        data.GetCellData().AddArray(array(vtkIntArray, "surface", (-1, -1, 0, -1, 1, 0)))
        data.GetCellData().SetActiveScalars("surface")
    return data


def write_legacy(path, binary, version, data):
    writer = vtkPolyDataWriter() if isinstance(data, vtkPolyData) else vtkUnstructuredGridWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(data)
    writer.SetFileVersion(version)
    writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
    writer.Write()


def write_gmsh(folder):
    with tempfile.TemporaryDirectory() as work:
        geo = pathlib.Path(work) / "square.geo"
        geo.write_text(GEO)
        for kind, name in (("msh41", "gmsh_41.msh"), ("msh22", "gmsh_22.msh")):
            subprocess.run(["gmsh", str(geo), "-2", "-format", kind, "-v", "1", "-o",
                            str(folder / name)], check=True)
        subprocess.run(["gmsh", str(geo), "-2", "-format", "msh41", "-bin", "-v", "1", "-o",
                        str(folder / "gmsh_binary.msh")], check=True)


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent
    write_xml(folder / "vtk_ascii.vtp", "ascii", False)
    write_xml(folder / "vtk_binary.vtp", "binary", False)
    write_xml(folder / "vtk_binary_zlib.vtp", "binary", True, wide=True)
    write_xml(folder / "vtk_appended.vtp", "appended", False, encode=True)
    write_xml(folder / "vtk_appended_raw.vtp", "appended", False, encode=False, wide=True)
    write_xml(folder / "vtk_appended_raw_zlib.vtp", "appended", True, encode=False)
    write_xml(folder / "vtk_appended_zlib.vtp", "appended", True, encode=True)
    write_xml(folder / "vtk_big_endian.vtp", "appended", True, big_endian=True)
    write_xml(folder / "vtk_ascii.vtu", "ascii", False)
    write_xml(folder / "vtk_binary_zlib.vtu", "binary", True, wide=True)
    write_xml(folder / "vtk_appended_raw.vtu", "appended", False, encode=False)
    write_legacy(folder / "vtk_ascii_42.vtk", False, 42, roof())
    write_legacy(folder / "vtk_binary_42.vtk", True, 42, roof())
    write_legacy(folder / "vtk_ascii_51.vtk", False, 51, roof())
    write_legacy(folder / "vtk_binary_51_strip.vtk", True, 51, roof(True))
    for binary, version in ((False, 42), (True, 42), (False, 51), (True, 51)):
        name = f"{'binary' if binary else 'ascii'}_{version}.vtk"
        write_legacy(folder / f"vtk_grid_{name}", binary, version, grid(pixel=binary))
        write_legacy(folder / f"vtk_named_grid_{name}", binary, version, named(grid()))
        write_legacy(folder / f"vtk_named_{name}", binary, version, named(roof()))
    write_gmsh(folder)
    mesh = meshio.Mesh(numpy.array(POINTS, dtype=float),
                       [("quad", [QUADRILATERAL]), ("triangle", TRIANGLES)])
    meshio.write(folder / "meshio_22.msh", mesh, file_format="gmsh22", binary=False)
    meshio.write(folder / "meshio.vtu", mesh)
    for binary in (False, True):
        meshio.write(folder / f"meshio_{'binary' if binary else 'ascii'}.vtk", mesh, binary=binary)
    triangles = meshio.Mesh(numpy.array(POINTS, dtype=float), [("triangle", TRIANGLES)])
    meshio.write(folder / "meshio_41.msh", triangles, file_format="gmsh", binary=False)


if __name__ == "__main__":
    main()
