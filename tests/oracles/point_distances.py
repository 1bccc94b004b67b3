# SPDX-License-Identifier: LGPL-3.0-or-later
"""Distances of points from triangles, by numpy and without a search structure."""
import numpy


def to_segments(points, a, b):
    along = b - a
    square = numpy.maximum(numpy.einsum("ti,ti->t", along, along), 1e-300)
    to = points[:, None, :] - a[None, :, :]
    share = numpy.clip(numpy.einsum("pti,ti->pt", to, along) / square, 0, 1)
    return numpy.linalg.norm(to - share[:, :, None] * along[None, :, :], axis=2)


def to_triangles(points, triangles):
    """Per point, the distance from the nearest triangle."""
    corners = numpy.array(triangles, dtype=float)
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    least = numpy.minimum(to_segments(points, a, b), numpy.minimum(to_segments(points, b, c), to_segments(points, c, a)))
    normal = numpy.cross(b - a, c - a)
    size = numpy.linalg.norm(normal, axis=1)
    with_area = size > 1e-9 * numpy.maximum(numpy.linalg.norm(b - a, axis=1), numpy.linalg.norm(c - a, axis=1)) ** 2
    unit = normal / numpy.maximum(size, 1e-300)[:, None]
    over = numpy.ones(least.shape, dtype=bool) & with_area[None, :]
    for p, q in ((a, b), (b, c), (c, a)):
        inward = numpy.cross(unit, q - p)
        over &= numpy.einsum("pti,ti->pt", points[:, None, :] - p[None, :, :], inward) >= 0
    height = numpy.abs(numpy.einsum("pti,ti->pt", points[:, None, :] - a[None, :, :], unit))
    return numpy.where(over, numpy.minimum(height, least), least).min(axis=1)
