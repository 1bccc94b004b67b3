# SPDX-License-Identifier: LGPL-3.0-or-later
"""VTK's filters for the score card: vtk_booleans.py boolean|loop|intersection OPERATION OUTPUT.off A.off B.off"""
import sys
import time

import off
import vtk


def poly_data(path):
    points, triangles = off.read(path)
    data, places, cells = vtk.vtkPolyData(), vtk.vtkPoints(), vtk.vtkCellArray()
    places.SetDataTypeToDouble()
    for p in points:
        places.InsertNextPoint(p)
    for t in triangles:
        cells.InsertNextCell(3, t)
    data.SetPoints(places)
    data.SetPolys(cells)
    return data


def triangles_of(data):
    made = vtk.vtkTriangleFilter()
    made.SetInputData(data)
    made.PassVertsOff()
    made.PassLinesOff()
    made.Update()
    data = made.GetOutput()
    points = [data.GetPoint(k) for k in range(data.GetNumberOfPoints())]
    return points, [[data.GetCell(k).GetPointId(i) for i in range(3)] for k in range(data.GetNumberOfCells())]


def main(method, operation, output, first, *others):
    failed = []
    data = poly_data(first)
    seconds = 0.0
    for path in others:
        if method == "intersection":
            made = vtk.vtkIntersectionPolyDataFilter()
        else:
            made = vtk.vtkBooleanOperationPolyDataFilter() if method == "boolean" else vtk.vtkLoopBooleanPolyDataFilter()
            getattr(made, f"SetOperationTo{operation.capitalize()}")()
        made.AddObserver("ErrorEvent", lambda *_: failed.append("VTK reports an error"))
        made.SetInputData(0, data)
        other = poly_data(path)
        made.SetInputData(1, other)
        begin = time.process_time()
        made.Update()
        seconds += time.process_time() - begin
        if method == "intersection":
            both = vtk.vtkAppendPolyData()
            for port, given in ((1, data), (2, other)):
                divided = made.GetOutput(port)
                both.AddInputData(divided if divided.GetNumberOfCells() else given)  # nothing is returned if they do not meet
            both.Update()
            data = both.GetOutput()
        else:
            data = made.GetOutput()
    off.write(output, *triangles_of(data))
    print(f"operation: {seconds} s")
    if failed:
        sys.exit(failed[0])


main(*sys.argv[1:])
