# SPDX-License-Identifier: LGPL-3.0-or-later
"""A horizon with holes is filled by kriging, with a map of the expected error."""

import matplotlib.pyplot as plt
import numpy as np

import drawing
from shapes import grid
import terrane


def height(x, y):
    return -600 + 80 * np.sin(x / 300) * np.cos(y / 420) + 0.05 * x


def main():
    rng = np.random.default_rng(1)
    whole = grid(height, (0, 0), (2000, 2000), 51, "seismic horizon")
    noise = np.c_[np.zeros((len(whole.vertices), 2)), rng.normal(0, 2, len(whole.vertices))]
    whole = whole.replace(vertices=whole.vertices + noise)  # picks are 2 m off
    centres = whole.vertices[whole.triangles].mean(axis=1)
    gone = (np.hypot(centres[:, 0] - 700, centres[:, 1] - 800) < 300) | (
        (np.abs(centres[:, 0] - 1500) < 150) & (np.abs(centres[:, 1] - 1300) < 320))
    holed = whole.replace(triangles=whole.triangles[~gone])
    for i, hole in enumerate(terrane.holes(holed), 1):
        print(f"hole {i}: area {hole.area:.0f} m2, border {hole.length:.0f} m")
    filled = terrane.fill(holed)
    new = filled.surface.vertices[filled.given_vertices:]
    miss = np.abs(new[:, 2] - height(new[:, 0], new[:, 1]))
    for hole in filled.holes:
        print(f"hole {hole.number}: {hole.report.interpolated} vertices, expected error {hole.report.expected_error:.2f} m")
    print(f"the truth is missed by {np.sqrt(np.mean(miss ** 2)):.2f} m (root mean square)")

    figure = plt.figure(figsize=(10, 4.2))
    left = drawing.axes(figure, 121, "before", stretch=2)
    drawing.add(left, holed.vertices, holed.triangles, drawing.COLOURS[0])
    drawing.finish(left)
    right = figure.add_subplot(122, aspect="equal", title="expected error, m")
    v = filled.surface.vertices
    shown = right.tripcolor(v[:, 0], v[:, 1], filled.surface.triangles, filled.expected_error, cmap="magma_r")
    figure.colorbar(shown, ax=right)
    drawing.save(figure, "holes_filled.png")


if __name__ == "__main__":
    main()
