# SPDX-License-Identifier: LGPL-3.0-or-later
"""The first model: two horizons and a fault, from arrays to blocks."""

import matplotlib.pyplot as plt
import numpy as np

import drawing
import terrane
from shapes import grid, plane


def main():
    top = grid(lambda x, y: -300 + 60 * np.sin(x / 400), name="top")
    base = grid(lambda x, y: -900 + 0.1 * x + 50 * np.cos(y / 500), name="base")
    fault = plane((1000, 1000, -700), 20, 65, 4000, 3000, "F1")
    model = terrane.model([top, base, fault], box=((0, 0, -1500), (2000, 2000, 0)))
    for name, block in model.blocks.items():
        print(f"{name}: {block.volume / 1e9:.3f} km3, {len(block.neighbours)} neighbours")
    wells = [(400, 1000, -600), (1600, 1000, -1200)]
    print("two wells end in:", "; ".join(model.names_of(wells)))

    figure = plt.figure(figsize=(10, 4.5))
    left = drawing.axes(figure, 121, "two horizons and a fault")
    for surface, colour in zip((top, base, fault), drawing.COLOURS):
        drawing.add(left, surface.vertices, surface.triangles, colour, alpha=0.85)
    right = drawing.axes(figure, 122, f"{len(model.blocks)} blocks, moved apart")
    drawing.add_blocks(right, model)
    for ax in (left, right):
        drawing.finish(ax)
    drawing.save(figure, "first_model.png")


if __name__ == "__main__":
    main()
