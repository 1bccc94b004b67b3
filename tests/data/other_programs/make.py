#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes the files of this folder with VTK, gmsh and meshio (Debian's python3-vtk9, gmsh, python3-meshio).

The .vtu files, and the .vtk files called grid, have a tetrahedron below it, an edge and a point as well. Files called
named have the arrays that Terrane writes into .vtp and .vtu files: what VTK makes of these when it writes .vtk.
All of them hold the same roof: six points, two triangles and a quadrilateral; the gmsh files hold a square
that is divided into two named physical surfaces. The files of OBJ are a triangle that Python has compressed.

usage: /usr/bin/python3 make.py [FOLDER]
"""
import lzma
import pathlib
import subprocess
import sys
import tempfile
import zipfile

import meshio
import numpy
from vtkmodules.vtkCommonCore import vtkIntArray, vtkPoints, vtkStringArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (VTK_LINE, VTK_PIXEL, VTK_QUAD, VTK_TETRA, VTK_TRIANGLE,
                                           VTK_VERTEX, vtkCellArray, vtkPolyData,
                                           vtkStructuredGrid, vtkUnstructuredGrid)
from vtkmodules.vtkIOLegacy import (vtkPolyDataWriter, vtkStructuredGridWriter,
                                     vtkUnstructuredGridWriter)
from vtkmodules.vtkIOXML import (vtkXMLPolyDataWriter, vtkXMLStructuredGridWriter,
                                  vtkXMLUnstructuredGridWriter)

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
        {True: writer.SetCompressorTypeToZLib, "lz4": writer.SetCompressorTypeToLZ4,
         "lzma": writer.SetCompressorTypeToLZMA}[compress]()
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


def structured():
    """The roof as a structured grid, whose second row of points begins with the fourth of POINTS."""
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for k in (0, 1, 3, 2, 4, 5):
        points.InsertNextPoint(*POINTS[k])
    data = vtkStructuredGrid()
    data.SetDimensions(2, 1, 3)
    data.SetPoints(points)
    return data


def write_structured(folder):
    for blank in (False, True):
        writer, data = vtkXMLStructuredGridWriter(), structured()
        if blank:
            data.BlankCell(1)
        writer.SetFileName(str(folder / f"vtk_{'blank' if blank else 'lzma'}.vts"))
        writer.SetInputData(data)
        writer.SetCompressorTypeToLZMA()
        writer.Write()
    for binary in (False, True):
        writer = vtkStructuredGridWriter()
        writer.SetFileName(str(folder / f"vtk_structured_{'binary' if binary else 'ascii'}.vtk"))
        writer.SetInputData(structured())
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


def write_compressed(folder):
    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    (folder / "triangle.obj.xz").write_bytes(lzma.compress(text.encode()))
    for name, method, files in (("triangle.obj.zip", zipfile.ZIP_DEFLATED, ("triangle.obj",)),
                                ("stored.obj.zip", zipfile.ZIP_STORED, ("__MACOSX/._x", "a/", "a/x.obj")),
                                ("two.zip", zipfile.ZIP_STORED, ("a.obj", "b.obj"))):
        with zipfile.ZipFile(folder / name, "w", method) as archive:
            for file in files:
                archive.writestr(zipfile.ZipInfo(file), "" if file.endswith("/") else text, method)


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
    write_xml(folder / "vtk_lz4.vtp", "appended", "lz4", encode=False)
    write_xml(folder / "vtk_lzma.vtp", "binary", "lzma")
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
    write_structured(folder)
    write_compressed(folder)
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
