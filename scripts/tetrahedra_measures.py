# SPDX-License-Identifier: LGPL-3.0-or-later
"""Reads meshes of tetrahedra and of triangles, and measures them with NumPy: for tetrahedra_table.py.

Nothing here is Terrane's: the figures of the table are those of the files, judged by code of its own.
"""
import collections
import dataclasses
import pathlib

import numpy
import scipy.spatial

BAD = 10  # degrees; a tetrahedron with a dihedral angle below it is bad
EDGES = ((0, 1, 2, 3), (0, 2, 1, 3), (0, 3, 1, 2), (1, 2, 0, 3), (1, 3, 0, 2), (2, 3, 0, 1))  # ends, then the other corners
FACES = ((1, 3, 2), (0, 2, 3), (0, 3, 1), (0, 1, 2))  # opposite to corner 0, ...


@dataclasses.dataclass
class Tetrahedra:
    points: numpy.ndarray
    corners: numpy.ndarray
    blocks: numpy.ndarray


def read_medit(path):
    words = (w for line in pathlib.Path(path).read_text().splitlines() if not line.startswith("#") for w in line.split())
    points, corners, blocks = None, None, None
    for word in words:
        if word == "Vertices":
            count = int(next(words))
            points = numpy.array([float(next(words)) for _ in range(4 * count)]).reshape(count, 4)[:, :3]
        elif word == "Triangles":
            for _ in range(4 * int(next(words))):
                next(words)
        elif word == "Tetrahedra":
            count = int(next(words))
            rows = numpy.array([int(next(words)) for _ in range(5 * count)]).reshape(count, 5)
            corners, blocks = rows[:, :4] - 1, rows[:, 4]
        elif word == "End":
            break
    return Tetrahedra(points, corners, blocks)


def write_medit(mesh, path):
    """Without comments, which CGAL does not know."""
    rows = ["MeshVersionFormatted 2", "Dimension 3", "Vertices", str(len(mesh.points))]
    rows += [f"{x!r} {y!r} {z!r} 0" for x, y, z in mesh.points.tolist()]
    rows += ["Tetrahedra", str(len(mesh.corners))]
    rows += [" ".join(map(str, row)) for row in numpy.column_stack([mesh.corners + 1, mesh.blocks]).tolist()]
    pathlib.Path(path).write_text("\n".join([*rows, "End", ""]))


def read_tetgen(stem):
    """What TetGen wrote: STEM.node and STEM.ele, numbered from 0, with blocks."""
    rows = [line.split() for line in pathlib.Path(f"{stem}.node").read_text().splitlines() if not line.startswith("#")]
    points = numpy.array([[float(x) for x in row[1:4]] for row in rows[1:] if row])
    rows = [line.split() for line in pathlib.Path(f"{stem}.ele").read_text().splitlines() if not line.startswith("#")]
    cells = numpy.array([[int(x) for x in row[1:6]] for row in rows[1:] if row])
    return Tetrahedra(points, cells[:, :4], cells[:, 4])


def read_obj(path):
    """Points, triangles, and the group of each triangle: the names of its surfaces."""
    points, triangles, groups, group = [], [], [], ""
    for line in pathlib.Path(path).read_text().splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            points.append([float(x) for x in words[1:4]])
        elif words[0] == "g":
            group = " ".join(words[1:])
        elif words[0] == "f":
            triangles.append([int(w.split("/")[0]) - 1 for w in words[1:4]])
            groups.append(group)
    return numpy.array(points), numpy.array(triangles), groups


def cross_length(u, v):
    return numpy.linalg.norm(numpy.cross(u, v), axis=-1)


def dihedral_angles(points, corners):
    """Degrees, at the six edges of each tetrahedron."""
    p = points[corners]
    angles = numpy.empty((len(corners), 6))
    for k, (a, b, c, d) in enumerate(EDGES):
        edge = p[:, b] - p[:, a]
        u, v = numpy.cross(edge, p[:, c] - p[:, a]), numpy.cross(edge, p[:, d] - p[:, a])
        angles[:, k] = numpy.degrees(numpy.arctan2(cross_length(u, v), (u * v).sum(axis=1)))
    return angles


def signed_volumes(points, corners):
    p = points[corners]
    return numpy.linalg.det(p[:, 1:] - p[:, :1]) / 6


def mean_ratios(points, corners):
    """12 (3 V)^(2/3) / sum of squared edges; 1 for the regular tetrahedron."""
    p = points[corners]
    squares = sum(((p[:, b] - p[:, a]) ** 2).sum(axis=1) for a, b, _, _ in EDGES)
    return 12 * numpy.cbrt(3 * numpy.abs(signed_volumes(points, corners))) ** 2 / squares


def face_set(corners):
    return {tuple(face) for columns in FACES for face in numpy.sort(corners[:, list(columns)], axis=1).tolist()}


def nodes_at(mesh, points):
    """The node of a mesh at each point, or -1. Programs may print fewer digits than a double has."""
    far, near = scipy.spatial.cKDTree(mesh.points).query(points)
    return numpy.where(far <= 1e-12 * numpy.abs(points).max(), near, -1)


def divided_triangles(mesh, points, triangles):
    """How many triangles are no face of the mesh."""
    nodes = nodes_at(mesh, points)
    if len(triangles) == 0:
        return 0
    found = face_set(mesh.corners)
    return sum(tuple(face) not in found for face in numpy.sort(nodes[triangles], axis=1).tolist())


def judge(mesh, points, triangles, volume):
    """The figures of a row. `volume`: what the tetrahedra must fill."""
    angles = dihedral_angles(mesh.points, mesh.corners)
    volumes = signed_volumes(mesh.points, mesh.corners)
    least = angles.min(axis=1)
    if numpy.median(volumes) < 0:
        volumes = -volumes
    return {"tetrahedra": len(mesh.corners), "least": float(least.min()), "greatest": float(angles.max()),
            "bad": int((least < BAD).sum()), "share": 100 * float((least < BAD).mean()),
            "mean_ratio": float(mean_ratios(mesh.points, mesh.corners).min()),
            "inverted": int((volumes <= 0).sum()), "blocks": len(set(mesh.blocks.tolist())),
            "unfilled": float(abs(volumes.sum() / volume - 1)), "divided": divided_triangles(mesh, points, triangles)}


# ---- What the triangles force

@dataclasses.dataclass
class Wedge:
    """Two triangles at an edge with no other one between them. A mesh that keeps them has the tetrahedron of both, or two and
    more tetrahedra at the edge, one of which has at most half of the angle there."""
    angle: float  # degrees
    corners: tuple  # the edge, then the third corner of either triangle
    least: float  # dihedral angles of the tetrahedron of both
    greatest: float


def wedges_below(points, triangles, degrees):
    """All wedges whose angle is smaller, the sharpest first."""
    at_edge = collections.defaultdict(list)
    for triangle in triangles.tolist():
        for k in range(3):
            a, b, c = triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]
            at_edge[min(a, b), max(a, b)].append(c)
    found = []
    for (a, b), thirds in at_edge.items():
        if len(thirds) < 2:
            continue
        axis = (points[b] - points[a]) / numpy.linalg.norm(points[b] - points[a])
        spokes = points[thirds] - points[a]
        spokes = spokes - numpy.outer(spokes @ axis, axis)
        x = spokes[0] / numpy.linalg.norm(spokes[0])
        turns = numpy.degrees(numpy.arctan2(spokes @ numpy.cross(axis, x), spokes @ x)) % 360
        order = numpy.argsort(turns)
        for here, after in zip(order, numpy.roll(order, -1)):
            angle = (turns[after] - turns[here]) % 360
            if not 0 < angle < degrees:
                continue
            corners = (a, b, thirds[here], thirds[after])
            own = dihedral_angles(points, numpy.array([corners]))[0]
            found.append(Wedge(float(angle), corners, float(own.min()), float(own.max())))
    return sorted(found, key=lambda w: w.angle)


def least_forced(points, triangles, limit):
    """Of all wedges, the one that keeps the greatest angle largest: every mesh that keeps its triangles and whose greatest
    angle is smaller than that of its tetrahedron has an angle of at most half of it. Only halves below `limit` count."""
    wedges = [w for w in wedges_below(points, triangles, 2 * limit) if w.greatest > 90]
    return max(wedges, key=lambda w: w.greatest, default=None)


def sharp_places(points, triangles, groups):
    """Where the triangles have an angle below BAD that no mesh can undo: the ends of edges of sharp wedges, and corners at which
    two curves meet at such an angle within a triangle. Curves are edges with other than two triangles, or with two of
    different surfaces."""
    at_edge = collections.defaultdict(list)
    for t, triangle in enumerate(triangles.tolist()):
        for k in range(3):
            a, b = triangle[k], triangle[(k + 1) % 3]
            at_edge[min(a, b), max(a, b)].append(t)
    is_curve = {edge: len(ts) != 2 or groups[ts[0]] != groups[ts[1]] for edge, ts in at_edge.items()}
    sharp = {v for w in wedges_below(points, triangles, BAD) for v in w.corners[:2]}
    for triangle in triangles.tolist():
        for k in range(3):
            a, b, c = triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]
            u, v = points[b] - points[a], points[c] - points[a]
            angle = numpy.degrees(numpy.arctan2(cross_length(u, v), u @ v))
            if angle < BAD and is_curve[min(a, b), max(a, b)] and is_curve[min(a, c), max(a, c)]:
                sharp.add(a)
    return sorted(sharp)


def bad_apart(mesh, points, triangles, groups):
    """Bad tetrahedra none of whose corners is at a sharp place: how many, and their least angle; and the causes of the bad
    ones, as (count, least angle, centre) by name."""
    least = dihedral_angles(mesh.points, mesh.corners).min(axis=1)
    nodes = nodes_at(mesh, points)
    sharp = numpy.zeros(len(mesh.points), bool)
    sharp[[n for n in nodes[sharp_places(points, triangles, groups)] if n >= 0]] = True
    apart = (least < BAD) & ~sharp[mesh.corners].any(axis=1)
    return int(apart.sum()), float(least[apart].min()) if apart.any() else None, numpy.flatnonzero(apart)
