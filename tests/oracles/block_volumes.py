# SPDX-License-Identifier: LGPL-3.0-or-later
"""Blocks of a conforming triangle mesh and their exact volumes, by whole numbers.

Written for tests: slow, and without anything of the program that it judges. A mesh is a list of vertices (three doubles)
and a list of triangles (three indices).
"""
import math
from fractions import Fraction


def scaled(vertices):
    """The vertices as whole numbers, and the factor."""
    exact = [tuple(Fraction(x) for x in v) for v in vertices]
    factor = math.lcm(*{x.denominator for v in exact for x in v}) if exact else 1
    return [tuple(int(x * factor) for x in v) for v in exact], factor


def minus(p, q):
    return (p[0] - q[0], p[1] - q[1], p[2] - q[2])


def cross(u, v):
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


class Joined:
    def __init__(self, count):
        self.parent = list(range(count))

    def find(self, x):
        while self.parent[x] != x:
            self.parent[x] = self.parent[self.parent[x]]
            x = self.parent[x]
        return x

    def join(self, x, y):
        self.parent[self.find(x)] = self.find(y)


def sorted_around(points, a, b, fans):
    """The pairs (triangle, apex) counterclockwise around the direction from a to b."""
    along = minus(points[b], points[a])
    arms = [minus(points[apex], points[a]) for _, apex in fans]
    first = arms[0]

    def half(arm):
        """0 for the angle of the first arm, 1 up to 180 degrees, 2 for these, 3 beyond."""
        side = dot(along, cross(first, arm))
        if side != 0:
            return 1 if side > 0 else 3
        same = dot(first, arm) * dot(along, along) - dot(first, along) * dot(arm, along)
        return 0 if same > 0 else 2

    halves = [half(arm) for arm in arms]
    order = []
    for i in range(len(fans)):  # few per edge
        at = 0
        while at < len(order):
            j = order[at]
            if halves[i] < halves[j] or (halves[i] == halves[j] and dot(along, cross(arms[i], arms[j])) > 0):
                break
            at += 1
        order.insert(at, i)
    return [fans[i] for i in order]


def shells(points, triangles):
    """Per side of a triangle (2 t: in front; 2 t + 1: behind) a number of its shell, and pieces of connected triangles."""
    at_edge = {}
    for t, c in enumerate(triangles):
        for i in range(3):
            a, b, apex = c[i], c[(i + 1) % 3], c[(i + 2) % 3]
            at_edge.setdefault((min(a, b), max(a, b)), []).append((t, apex, a < b))
    sides, pieces = Joined(2 * len(triangles)), Joined(len(triangles))
    for (a, b), fans in at_edge.items():
        forward = {t: runs for t, _, runs in fans}
        ring = [(t, apex) for t, apex, _ in fans]
        if len(ring) > 2:
            ring = sorted_around(points, a, b, ring)
        for k, (t, _) in enumerate(ring):
            u = ring[(k + 1) % len(ring)][0]
            pieces.join(t, u)
            # The front of a triangle that runs from a to b faces counterclockwise.
            sides.join(2 * t + (0 if forward[t] else 1), 2 * u + (1 if forward[u] else 0))
    return sides, pieces


def is_inside(vertices, point, triangles):
    """Whether the closed triangles wind around the point."""
    angle = 0.
    for t in triangles:
        u, v, w = (tuple(x - y for x, y in zip(vertices[i], point)) for i in t)
        p, q, r = (math.sqrt(dot(x, x)) for x in (u, v, w))
        angle += 2 * math.atan2(dot(u, cross(v, w)), p * q * r + dot(u, v) * r + dot(v, w) * p + dot(w, u) * q)
    return abs(angle) > 2 * math.pi


def blocks(vertices, triangles):
    """The blocks: a list of (exact volume, sides); sides are numbers 2 t for the front of triangle t, 2 t + 1 for its back."""
    points, factor = scaled(vertices)
    joined, pieces = shells(points, triangles)
    of_shell = {}
    for side in range(2 * len(triangles)):
        of_shell.setdefault(joined.find(side), []).append(side)
    dets = []
    origin = points[triangles[0][0]]
    for c in triangles:
        p, q, r = (minus(points[i], origin) for i in c)
        dets.append(dot(p, cross(q, r)))
    measured = [(sum(-dets[s // 2] if s % 2 == 0 else dets[s // 2] for s in sides), sides) for sides in of_shell.values()]
    outer = [[volume, list(sides)] for volume, sides in measured if volume > 0]
    borders = []
    for _, sides in outer:
        of_block = set(sides)
        borders.append([triangles[s // 2] for s in sides if s ^ 1 not in of_block])
    for volume, sides in measured:
        if volume > 0:
            continue
        piece = pieces.find(sides[0] // 2)
        at = vertices[triangles[sides[0] // 2][0]]
        around = [o for o, border in zip(outer, borders) if pieces.find(o[1][0] // 2) != piece and
                  is_inside(vertices, at, border)]
        if around:
            within = min(around, key=lambda o: o[0])
            within[0] += volume
            within[1] += sides
    return [(Fraction(volume, 6 * factor ** 3), sides) for volume, sides in outer]
