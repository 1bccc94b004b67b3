# SPDX-License-Identifier: LGPL-3.0-or-later
"""Shapes that the certified cases are made of: a surface is (vertices, triangles)."""
import math

CASES = {}


def case(make):
    CASES[make.__name__] = make
    return make


def tri(*points):
    return list(points), [(0, 1, 2)]


def quad(a, b, c, d):
    return [a, b, c, d], [(0, 1, 2), (0, 2, 3)]


def pair(first, second):
    return {"a": tri(*first), "b": tri(*second)}


def moved(surface, change):
    vertices, triangles = surface
    return [change(*v) for v in vertices], triangles


def all_moved(model, change):
    return {name: moved(s, change) for name, s in model.items()}


def joined(*surfaces):
    vertices, triangles = [], []
    for v, t in surfaces:
        triangles += [tuple(len(vertices) + i for i in corners) for corners in t]
        vertices += v
    return vertices, triangles


def grid(nx, ny, height, x0=0.0, x1=1.0, y0=0.0, y1=1.0):
    at = lambda i, j: height(x0 + (x1 - x0) * i / nx, y0 + (y1 - y0) * j / ny)
    vertices = [at(i, j) for j in range(ny + 1) for i in range(nx + 1)]
    triangles = []
    for j in range(ny):
        for i in range(nx):
            a = j * (nx + 1) + i
            b, c, d = a + 1, a + nx + 1, a + nx + 2
            triangles += [(a, b, d), (a, d, c)]
    return vertices, triangles


def box(x0, y0, z0, x1, y1, z1):
    v = [(x, y, z) for z in (z0, z1) for y in (y0, y1) for x in (x0, x1)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return v, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def tetrahedron(a, b, c, d):
    return [a, b, c, d], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]


def turned(x, y, z):
    """A generic rotation and shift, rounded: what was coplanar is nearly so."""
    a, b = 0.7, 0.4
    x, y = math.cos(a) * x - math.sin(a) * y, math.sin(a) * x + math.cos(a) * y
    y, z = math.cos(b) * y - math.sin(b) * z, math.sin(b) * y + math.cos(b) * z
    return x + 0.1, y + 0.2, z + 0.3


FLAT = ((0, 0, 0), (8, 0, 0), (0, 8, 0))
