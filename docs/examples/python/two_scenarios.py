# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two scenarios of one structure: how much does the throw of a fault matter?"""

import matplotlib.pyplot as plt
import numpy as np

import drawing
import terrane
from shapes import faulted, plane

BOX = ((0, 0, -1500), (2000, 2000, 0))
COLUMN = [("Cover", "top"), ("Reservoir", "base"), ("Basement", "")]


def dome(z0, height):
    """Return a function of x and y."""
    return lambda x, y: z0 + height * np.exp(-((x - 1000) ** 2 + (y - 1000) ** 2) / 7e5)


def scenario(throw):
    """Return the model with another throw of the fault."""
    horizons = [faulted(dome(-600, 200), throw, name="top"), faulted(dome(-900, 150), throw, name="base")]
    return terrane.model([*horizons, plane((1000, 1000, -700), 0, 70, 4000, 4000, "F1")], box=BOX, seal=20, column=COLUMN)


def main():
    models = {throw: scenario(throw) for throw in (60, 240)}
    for throw, model in models.items():
        for name, block in model.blocks.items():
            if block.unit == "Reservoir":
                print(f"throw {throw} m: {name}: {block.volume / 1e9:.3f} km3")
        across = sum(j.area for j in model.juxtapositions if j.surface == "F1" and "outside" not in j.blocks
                     and all(model.blocks[b].unit == "Reservoir" for b in j.blocks))
        print(f"throw {throw} m: reservoir against reservoir across F1: {across / 1e6:.3f} km2")
    points = np.random.default_rng(1).uniform(BOX[0], BOX[1], (20000, 3))
    units = [[model.structure.blocks[n].unit for n in model.block_of(points)] for model in models.values()]
    changed = np.mean([a != b for a, b in zip(*units)])
    print(f"{100 * changed:.1f} % of the volume is in another unit")

    figure = plt.figure(figsize=(10, 4.5))
    for position, (throw, model) in zip((121, 122), models.items()):
        ax = drawing.axes(figure, position, f"throw {throw} m")
        drawing.add_blocks(ax, model)
        drawing.finish(ax)
    drawing.save(figure, "two_scenarios.png")


if __name__ == "__main__":
    main()
