# SPDX-License-Identifier: LGPL-3.0-or-later
"""Looks for a collapse that improves the worst triangle of a mesh, in the plainest way."""
import math


def minus(p, q):
    return tuple(x - y for x, y in zip(p, q))


def normal(t):
    u, v = minus(t[1], t[0]), minus(t[2], t[0])
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    size = math.hypot(*n)
    return tuple(x / size for x in n) if size > 0 else (0., 0., 0.)


def cosine(s, t):
    return sum(x * y for x, y in zip(normal(s), normal(t)))


class Fans:
    def __init__(self, vertices, triangles, labels, fixed_edges):
        self.vertices, self.triangles, self.labels = vertices, triangles, labels
        self.star = {}
        for t, c in enumerate(triangles):
            for v in c:
                self.star.setdefault(v, []).append(t)
        self.fixed = {v for e in fixed_edges for v in e}

    def corners(self, c):
        return [self.vertices[v] for v in c]

    def neighbours(self, v):
        return {u for t in self.star[v] for u in self.triangles[t]} - {v}

    def is_inner(self, v):
        """Whether the triangles at v are of one sheet that is closed and rather smooth there."""
        star = self.star[v]
        if v in self.fixed or len({self.labels[t] for t in star}) > 1:
            return False
        for u in self.neighbours(v):
            pair = [t for t in star if u in self.triangles[t]]
            if len(pair) != 2 or cosine(*(self.corners(self.triangles[t]) for t in pair)) < .87:
                return False
        return True

    def result(self, gone, kept):
        """The triangles at `gone` after its collapse into `kept`, or None if the topology does not allow it."""
        common = self.neighbours(gone) & self.neighbours(kept)
        pair = [t for t in self.star[gone] if kept in self.triangles[t]]
        if common != {v for t in pair for v in self.triangles[t]} - {gone, kept} or len(self.star[gone]) < 4:
            return None
        return [tuple(kept if v == gone else v for v in self.triangles[t]) for t in self.star[gone] if t not in pair]


def find(mesh, labels, fixed_edges, worst, quality):
    """A pair (gone, kept) whose collapse turns no triangle much and improves the worst one at `gone` clearly, or None."""
    vertices, triangles = mesh
    fans = Fans(vertices, triangles, labels, fixed_edges)
    for gone in triangles[worst]:
        if not fans.is_inner(gone):
            continue
        old = [fans.corners(triangles[t]) for t in fans.star[gone]]
        before = min(map(quality, old))
        for kept in sorted(fans.neighbours(gone)):
            added = fans.result(gone, kept)
            if not added:
                continue
            new = [fans.corners(c) for c in added]
            if min(map(quality, new)) > 1.001 * before and all(cosine(s, t) > .87 for s in new for t in old):
                return gone, kept
    return None
