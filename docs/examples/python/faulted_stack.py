# SPDX-License-Identifier: LGPL-3.0-or-later
"""A faulted stack as implicit modelling makes it, from NumPy alone to tetrahedra.

Like GemPy and LoopStructural, this takes horizons as level sets of a scalar field that a fault displaces; each
horizon reaches the fault from both sides with a throw, and stops a little short of it.
"""

import matplotlib.pyplot as plt
import numpy as np

import drawing
import terrane
from shapes import faulted, plane


def main():
    fault = plane((1000, 1000, -700), 0, 70, 4000, 3000, "main fault")
    stack = [faulted(lambda x, y, z=z: z + 60 * np.sin((x + y) / 700), 180, name=name)
             for z, name in ((-350, "Upper"), (-650, "Middle"), (-950, "Lower"))]
    box = ((0, 0, -1500), (2000, 2000, 0))
    open_model = terrane.model([*stack, fault], box=box)
    model = terrane.model([*stack, fault], box=box, seal=20, column=[
        ("Cover", "Upper"), ("Sandstone", "Middle"), ("Shale", "Lower"), ("Basement", "")])
    print(f"{len(open_model.blocks)} blocks before the gaps are closed, {len(model.blocks)} after")
    for name, block in model.blocks.items():
        print(f"{name}: {block.volume / 1e9:.3f} km3")
    cells = model.improved(150).tetrahedra(time_limit=60)
    print(f"{len(cells.tetrahedra)} tetrahedra, {len(cells.violations)} violations")
    cells.save("faulted_stack.vtu")

    figure = plt.figure(figsize=(10, 4.5))
    left = drawing.axes(figure, 121, "level sets with a throw, short of the fault")
    for surface, colour in zip((*stack, fault), drawing.COLOURS):
        drawing.add(left, surface.vertices, surface.triangles, colour, alpha=0.8, edges=0.05)
    right = drawing.axes(figure, 122, "tetrahedra, cut open")
    middles = cells.vertices[cells.tetrahedra].mean(axis=1)
    for number, colour in zip(range(1, len(cells.block_names)), drawing.COLOURS):
        kept = cells.tetrahedra[(cells.block_of == number) & (middles[:, 1] > 900)]
        faces = np.sort(kept[:, [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]]].reshape(-1, 3), axis=1)
        outside, counts = np.unique(faces, axis=0, return_counts=True)
        drawing.add(right, cells.vertices, outside[counts == 1], colour)
    for ax in (left, right):
        drawing.finish(ax)
    drawing.save(figure, "faulted_stack.png")


if __name__ == "__main__":
    main()
