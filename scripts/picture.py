#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Draws README's picture from what scripts/demo.sh wrote.

    xvfb-run -a scripts/picture.py [out/demo] [docs/demo.png]

Left: faults and topography, arranged; the curves in which they cross are black. Right: the
tetrahedra of a model with two faults, its volumes moved apart, some tetrahedra taken out.
Needs python3-vtk9, python3-numpy and, without a display, xvfb.
"""
import struct
import sys
import zlib

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

SIZE = (1700, 600)
MUTED = np.array([
    [196, 120, 92], [112, 146, 176], [222, 184, 120], [126, 158, 118], [176, 134, 164],
    [214, 158, 110], [96, 136, 140], [198, 176, 150], [150, 116, 100], [142, 170, 190],
    [186, 186, 118], [168, 98, 98]]) / 255.0
LAYERS = np.array([[150, 118, 108], [206, 140, 98], [222, 190, 126], [136, 164, 178]]) / 255.0
GROUND = (0.80, 0.82, 0.74)
INK = (0.08, 0.08, 0.10)


def read(reader, path):
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput()
    if data.GetNumberOfCells() == 0:
        sys.exit(f"picture: {path} has no cells: run scripts/demo.sh first")
    return data


def surfaces_of(path):
    """Returns points, triangles and the surface of each triangle."""
    data = read(vtk.vtkXMLPolyDataReader(), path)
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return points, triangles, vtk_to_numpy(data.GetCellData().GetArray("surface"))


def tetrahedra_of(path):
    """Returns points, tetrahedra and the block of each tetrahedron."""
    data = read(vtk.vtkXMLUnstructuredGridReader(), path)
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    is_tetrahedron = vtk_to_numpy(data.GetCellTypesArray()) == vtk.VTK_TETRA
    corners = vtk_to_numpy(data.GetCells().GetConnectivityArray())
    count = int(is_tetrahedron.sum())  # they come before the faces
    block_of = vtk_to_numpy(data.GetCellData().GetArray("block"))
    return points, corners[:4 * count].reshape(-1, 4), block_of[:count]


def poly_data(points, cells, kind):
    """Makes poly data of cells with `kind` points: 2 for lines, 3 for triangles."""
    used, renumbered = np.unique(cells, return_inverse=True)
    data = vtk.vtkPolyData()
    vertices = vtk.vtkPoints()
    vertices.SetData(numpy_to_vtk(np.ascontiguousarray(points[used]), deep=True))
    array = vtk.vtkCellArray()
    offsets = np.arange(0, cells.size + 1, kind, dtype=np.int64)
    array.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                  numpy_to_vtkIdTypeArray(renumbered.reshape(-1).astype(np.int64), deep=True))
    data.SetPoints(vertices)
    (data.SetLines if kind == 2 else data.SetPolys)(array)
    return data


def actor(data, colour, edges=0.0, width=1.0, opacity=1.0):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(3, 3)  # lines come out on top
    it = vtk.vtkActor()
    it.SetMapper(mapper)
    look = it.GetProperty()
    look.SetColor(*colour)
    look.SetOpacity(opacity)
    look.SetInterpolationToFlat()
    look.SetAmbient(0.18)
    look.SetDiffuse(0.85)
    look.SetLineWidth(width)
    if edges > 0:
        look.EdgeVisibilityOn()
        look.SetEdgeColor(*(edges * c for c in colour))
    return it


def line_actor(points, lines, width):
    it = actor(poly_data(points, lines, 2), INK, width=width)
    it.GetProperty().LightingOff()
    it.GetMapper().SetRelativeCoincidentTopologyLineOffsetParameters(-6, -6)
    return it


def crossing_edges(triangles):
    """Returns the edges in which more than two triangles meet."""
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]],
                                    triangles[:, [2, 0]]]), axis=1)
    edges, count = np.unique(sides, axis=0, return_counts=True)
    return edges[count > 2]


def border_faces(tetrahedra):
    """Returns the faces with one tetrahedron."""
    faces = np.concatenate([tetrahedra[:, [0, 2, 1]], tetrahedra[:, [0, 1, 3]],
                            tetrahedra[:, [1, 2, 3]], tetrahedra[:, [2, 0, 3]]])
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True,
                                return_counts=True)
    return faces[first[count == 1]]


def panel(window, left, right):
    renderer = vtk.vtkRenderer()
    renderer.SetViewport(left, 0, right, 1)
    renderer.SetBackground(1, 1, 1)
    lights = vtk.vtkLightKit()
    lights.SetKeyLightIntensity(0.95)
    lights.SetKeyLightAngle(50, -35)
    lights.SetKeyToFillRatio(2.2)
    lights.AddLightsToRenderer(renderer)
    window.AddRenderer(renderer)
    return renderer


def look(renderer, direction, zoom, shift=(0.0, 0.0)):
    camera = renderer.GetActiveCamera()
    camera.SetPosition(*direction)
    camera.SetFocalPoint(0, 0, 0)
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(22)
    renderer.ResetCamera()
    camera.Zoom(zoom)
    camera.SetWindowCenter(*shift)
    renderer.ResetCameraClippingRange()


def draw_surfaces(renderer, path):
    points, triangles, surface = surfaces_of(path)
    ground = surface.max()  # the topography is the last one
    corner = points[triangles]
    centre = corner.mean(axis=1)
    # The topography is drawn behind the faults only, so that they can be seen below it.
    behind = centre[:, 1] > 42.485 + 0.16 * (centre[:, 0] - 2.2)
    frame = (centre[:, 0] > 1.93) & (centre[:, 0] < 2.56)
    shown = frame & ((surface != ground) | behind)
    middle = corner[shown].reshape(-1, 3).mean(axis=0)
    points = (points - middle) * (0.74, 1, 1.6)  # degrees to equal lengths; heights stretched
    for s in np.unique(surface[shown]):
        colour = GROUND if s == ground else MUTED[(5 * s + 2) % len(MUTED)]
        data = poly_data(points, triangles[shown & (surface == s)], 3)
        renderer.AddActor(actor(data, colour, edges=0.80))
    curves = crossing_edges(triangles[shown])
    renderer.AddActor(line_actor(points, curves, 2.6))
    look(renderer, (-0.28, -1.0, 0.42), 1.68)


def layer_colours(centres):
    """Returns a colour per layer and a shade per block; three blocks lie between two faults."""
    colours = {}
    by_x = np.argsort(centres[:, 0])
    for block, members in enumerate(np.array_split(by_x, 3)):
        upwards = members[np.argsort(centres[members, 2])]
        for layer, member in enumerate(upwards):
            colours[member] = LAYERS[layer] * (0.90, 1.0, 1.08)[block]
    return colours


def draw_tetrahedra(renderer, path):
    points, tetrahedra, block_of = tetrahedra_of(path)
    whole = points[tetrahedra[block_of > 0]].reshape(-1, 3)
    middle = (whole.min(axis=0) + whole.max(axis=0)) / 2
    points = (points - middle) / (whole.max(axis=0) - whole.min(axis=0)).max()
    blocks = [tetrahedra[block_of == r] for r in range(1, block_of.max() + 1)]
    centres = np.array([points[np.unique(b)].mean(axis=0) for b in blocks])
    colours = layer_colours(centres)
    for i, block in enumerate(blocks):
        inside = points[block].mean(axis=1)
        kept = block[0.35 * inside[:, 0] - inside[:, 1] < 0.22]  # cut open towards the viewer
        away = centres[i] * (0.34, 0.0, 0.62)
        renderer.AddActor(actor(poly_data(points + away, border_faces(kept), 3),
                                np.minimum(colours[i], 1), edges=0.74))
    look(renderer, (0.30, -1.0, 0.36), 1.14)


def write_png(image, path):
    """Writes an image with a palette of 256 colours, which takes a third of the bytes."""
    quantized = vtk.vtkImageQuantizeRGBToIndex()
    quantized.SetInputConnection(image.GetOutputPort())
    quantized.SetNumberOfColors(256)
    quantized.Update()
    table = quantized.GetLookupTable()
    colours = [table.GetTableValue(i)[:3] for i in range(table.GetNumberOfTableValues())]
    palette = bytes(round(255 * c) for colour in colours for c in colour)
    width, height, _ = quantized.GetOutput().GetDimensions()
    index = vtk_to_numpy(quantized.GetOutput().GetPointData().GetScalars()).astype(np.uint8)
    rows = index.reshape(height, width)[::-1]
    raw = b"".join(b"\0" + row.tobytes() for row in rows)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n"
                   + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0))
                   + chunk(b"PLTE", palette) + chunk(b"IDAT", zlib.compress(raw, 9))
                   + chunk(b"IEND", b""))


def main():
    source = sys.argv[1] if len(sys.argv) > 1 else "out/demo"
    target = sys.argv[2] if len(sys.argv) > 2 else "docs/demo.png"
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    draw_surfaces(panel(window, 0.0, 0.56), f"{source}/faults-topography.vtp")
    draw_tetrahedra(panel(window, 0.56, 1.0), f"{source}/modelA2.vtu")
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    write_png(image, target)
    print(f"picture: wrote {target}")


if __name__ == "__main__":
    main()
