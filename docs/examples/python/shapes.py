# SPDX-License-Identifier: LGPL-3.0-or-later
"""Surfaces for the examples, from NumPy alone."""

import numpy as np

import terrane


def to_millimetres(points):
    """Return points rounded as they would be in a file: the last digits of NumPy's sines depend on the processor."""
    return np.round(points, 3)


def grid(height, low=(-200, -200), high=(2200, 2200), n=25, name="", role="horizon"):
    """Return the surface z = height(x, y) over a rectangle."""
    x, y = np.meshgrid(np.linspace(low[0], high[0], n), np.linspace(low[1], high[1], n))
    x, y = x.ravel(), y.ravel()
    q = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    triangles = np.vstack([np.c_[q, q + 1, q + n + 1], np.c_[q, q + n + 1, q + n]])
    return terrane.Surface(to_millimetres(np.c_[x, y, height(x, y)]), triangles, name, role)


def faulted(height, throw, short=8, dip=70, name="", n=21):
    """Return the surface z = height(x, y), down by `throw` east of a fault that strikes north through (1000, ., -700).

    Both parts stop about `short` before the fault, as the level sets of implicit models do.
    """
    parts = []
    for down, low, sign in ((0, -200, -1), (throw, 2200, 1)):
        u, y = (a.ravel() for a in np.meshgrid(np.linspace(0, 1, n), np.linspace(-200, 2200, 2 * n)))
        x = np.full_like(u, 1000.0)
        for _ in range(20):  # where the horizon meets the fault
            x = 1000 + (-(height(x, y) - down) - 700) / np.tan(np.radians(dip)) + sign * short
        x = low + (x - low) * u
        q = (np.arange(2 * n - 1)[:, None] * n + np.arange(n - 1)).ravel()
        triangles = np.vstack([np.c_[q, q + 1, q + n + 1], np.c_[q, q + n + 1, q + n]])
        parts.append((np.c_[x, y, height(x, y) - down], triangles))
    (west, first), (east, second) = parts
    return terrane.Surface(to_millimetres(np.vstack([west, east])), np.vstack([first, second + len(west)]), name, "horizon")


def plane(point, strike, dip, length, depth, name, role="fault"):
    """Return a rectangle through a point: strike and dip in degrees, clockwise from y, to the right of the strike."""
    s, d = np.radians(strike), np.radians(dip)
    along = np.array([np.sin(s), np.cos(s), 0]) * length / 2
    down = np.array([np.cos(s) * np.cos(d), -np.sin(s) * np.cos(d), -np.sin(d)]) * depth / 2
    p = np.array(point, dtype=float)
    corners = to_millimetres([p - along - down, p + along - down, p + along + down, p - along + down])
    return terrane.Surface(corners, [[0, 1, 2], [0, 2, 3]], name, role)
