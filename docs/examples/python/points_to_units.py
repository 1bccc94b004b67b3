# SPDX-License-Identifier: LGPL-3.0-or-later
"""Borehole markers, grid cells and seismic samples get their unit, exactly."""

import time

import matplotlib.pyplot as plt
import numpy as np

import drawing
import terrane
from shapes import grid, plane


def main():
    top = grid(lambda x, y: -400 + 70 * np.sin(x / 350), name="top")
    base = grid(lambda x, y: -900 + 0.12 * x, name="base")
    model = terrane.model([top, base, plane((1000, 1000, -700), 0, 65, 4000, 3000, "F1")],
                          box=((0, 0, -1500), (2000, 2000, 0)),
                          column=[("Cover", "top"), ("Reservoir", "base"), ("Basement", "")])
    well = np.c_[np.full(8, 600.0), np.full(8, 700.0), np.linspace(-50, -1450, 8)]
    for depth, name in zip(-well[:, 2], model.names_of(well)):
        print(f"{depth:6.0f} m: {name}")

    x, z = np.meshgrid(np.linspace(0, 2000, 400), np.linspace(-1500, 0, 300))
    section = np.c_[x.ravel(), np.full(x.size, 1000.0), z.ravel()]
    began = time.perf_counter()
    numbers = model.block_of(section)
    print(f"{len(section)} samples in {len(set(numbers.tolist()))} blocks")
    rate = len(section) / (time.perf_counter() - began)

    figure = plt.figure(figsize=(9, 4.5))
    ax = figure.add_subplot(111, aspect="equal", title="the section y = 1000 m: which block each sample is in")
    colours = plt.matplotlib.colors.ListedColormap(["white", *drawing.COLOURS])
    ax.pcolormesh(x, z, numbers.reshape(x.shape), cmap=colours, vmin=0, vmax=len(drawing.COLOURS), shading="nearest")
    ax.plot(well[:, 0], well[:, 2], "k.-", lw=1)
    drawing.save(figure, "points_to_units.png")
    return rate


if __name__ == "__main__":
    main()
