#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Draws the tutorial's picture from the folder in which its commands were run.

    xvfb-run -a scripts/picture_tutorial.py first-model [docs/tutorial.png]

Left: the three surfaces after the arrangement. Right: the tetrahedra of the six blocks, moved apart.
Needs python3-vtk9, python3-numpy and, without a display, xvfb.
"""
import sys

import numpy as np
import vtk

import picture

COLOURS = {0: (0.80, 0.55, 0.38), 1: (0.44, 0.57, 0.69), 2: (0.74, 0.74, 0.72)}  # top, base, fault


def draw_surfaces(renderer, path):
    points, triangles, surface = picture.surfaces_of(path)
    points = (points - points.mean(axis=0)) / 1000
    for s in np.unique(surface):
        data = picture.poly_data(points, triangles[surface == s], 3)
        renderer.AddActor(picture.actor(data, COLOURS[s], edges=0.78))
    picture.look(renderer, (0.35, -1.0, 0.45), 1.38)


def draw_blocks(renderer, path):
    points, tetrahedra, block_of = picture.tetrahedra_of(path)
    points = (points - points.mean(axis=0)) / 1000
    for r in range(1, block_of.max() + 1):
        block = tetrahedra[block_of == r]
        centre = points[np.unique(block)].mean(axis=0)
        colour = picture.LAYERS[(r - 1) % 3 if r <= 3 else 6 - r] * (1.0 if r <= 3 else 0.9)
        data = picture.poly_data(points + centre * (0.25, 0, 0.55), picture.border_faces(block), 3)
        renderer.AddActor(picture.actor(data, np.minimum(colour, 1), edges=0.74))
    picture.look(renderer, (0.35, -1.0, 0.45), 1.22)


def main():
    folder = sys.argv[1]
    target = sys.argv[2] if len(sys.argv) > 2 else "docs/tutorial.png"
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(1500, 560)
    draw_surfaces(picture.panel(window, 0.0, 0.5), f"{folder}/model.vtp")
    draw_blocks(picture.panel(window, 0.5, 1.0), f"{folder}/result/tetrahedra.vtu")
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    picture.write_png(image, target)
    print(f"picture: wrote {target}")


if __name__ == "__main__":
    main()
