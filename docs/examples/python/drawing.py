# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pictures of the examples, by matplotlib. With PyVista, `result.plot()` shows the same in a window."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

COLOURS = ["#4878a8", "#c8553d", "#588b5b", "#b08830", "#7d5a9e", "#3d8f95", "#a0606e", "#6b7280"]


def axes(figure, position=111, title="", stretch=1.0):
    """Return empty 3D axes without decoration."""
    ax = figure.add_subplot(position, projection="3d")
    ax.set_axis_off()
    ax.set_title(title, fontsize=10)
    ax.view_init(elev=24, azim=-62)
    ax.stretch = stretch
    return ax


def add(ax, vertices, triangles, colour=None, values=None, shift=(0, 0, 0), alpha=1.0, edges=0.15):
    """Draw triangles in one colour, or by values per triangle."""
    v = np.asarray(vertices) + np.asarray(shift)
    corners = v[np.asarray(triangles)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    light = 0.6 + 0.4 * np.abs(normals @ np.array([0.3, -0.5, 0.81]))
    if values is None:
        colours = np.tile(matplotlib.colors.to_rgba(colour, alpha), (len(corners), 1))
    else:
        colours = plt.get_cmap("viridis")(values)
    colours[:, :3] *= light[:, None]
    ax.add_collection3d(Poly3DCollection(corners, facecolors=colours, edgecolors=(0, 0, 0, 0.35), linewidths=edges))
    points = getattr(ax, "points", [])
    ax.points = [*points, v.min(axis=0), v.max(axis=0)]


def finish(ax):
    """Fit the axes to what was drawn."""
    low, high = np.min(ax.points, axis=0), np.max(ax.points, axis=0)
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    size = high - low
    ax.set_box_aspect((size[0], size[1], size[2] * ax.stretch), zoom=1.3)


def add_blocks(ax, model, apart=0.25):
    """Draw the blocks of a model, moved apart."""
    middle = (model.mesh.vertices.min(axis=0) + model.mesh.vertices.max(axis=0)) / 2
    for i, block in enumerate(model.blocks.values()):
        mesh = block.mesh
        centre = (mesh.vertices.min(axis=0) + mesh.vertices.max(axis=0)) / 2
        add(ax, mesh.vertices, mesh.triangles, COLOURS[i % len(COLOURS)], shift=(centre - middle) * apart)


def save(figure, path):
    """Write the picture."""
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    plt.close(figure)
    print("wrote", path)
