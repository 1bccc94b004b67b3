# SPDX-License-Identifier: LGPL-3.0-or-later
"""Certified cases of two triangles, and of coplanar ones; as in generate.py."""
from shapes import FLAT, all_moved, case, grid, pair, tri, turned


# --- How two triangles can meet ---------------------------------------------------------------

@case
def contact_none():
    """boxes overlap, triangles do not"""
    return pair(FLAT, ((5, 5, -1), (9, 5, -1), (5, 5, 3)))

@case
def contact_vertex_vertex():
    """one corner of each is the same point"""
    return pair(FLAT, ((0, 0, 0), (-3, 1, 4), (-3, -1, 4)))

@case
def contact_vertex_edge():
    """a corner on an open edge"""
    return pair(FLAT, ((3, 0, 0), (2, -3, 4), (4, -3, 4)))

@case
def contact_vertex_face():
    """a corner inside"""
    return pair(FLAT, ((2, 3, 0), (1, 1, 5), (3, 1, 5)))

@case
def contact_vertex_face_inexact():
    """a corner inside a plane whose doubles are no round numbers"""
    return pair(((0.1, 0.2, 0.3), (8.1, 0.2, 0.3), (0.1, 8.2, 0.3)),
                ((2.7, 3.1, 0.3), (1, 1, 5), (3, 1, 5)))

@case
def contact_edges_cross():
    """two edges cross in a point inside both, not coplanar triangles"""
    return pair(FLAT, ((3, -2, -1), (3, 2, 1), (3, -2, 7)))

@case
def contact_edges_same():
    """a common edge, proper"""
    return pair(FLAT, ((0, 0, 0), (8, 0, 0), (3, -1, 5)))

@case
def contact_edges_overlap():
    """collinear edges overlap in part"""
    return pair(FLAT, ((3, 0, 0), (11, 0, 0), (5, -2, 5)))

@case
def contact_edge_within_edge():
    """an edge is part of another"""
    return pair(FLAT, ((2, 0, 0), (5, 0, 0), (3, -2, 5)))

@case
def contact_edges_share_end():
    """collinear edges from one corner, one longer"""
    return pair(FLAT, ((0, 0, 0), (5, 0, 0), (3, -2, 5)))

@case
def contact_edge_on_face():
    """an edge lies inside"""
    return pair(FLAT, ((1, 1, 0), (4, 2, 0), (2, 2, 5)))

@case
def contact_edge_across_face():
    """an edge lies in the plane and sticks out on both sides"""
    return pair(FLAT, ((-1, 2, 0), (9, 3, 0), (2, 2, 5)))

@case
def contact_edge_corner_to_face():
    """an edge from a common corner into the inside"""
    return pair(FLAT, ((0, 0, 0), (3, 2, 0), (2, 2, 5)))

@case
def contact_pierced():
    """a corner sticks through: the intersection lies inside one of them"""
    return pair(FLAT, ((2, 1, -2), (2, 5, -2), (2, 3, 2)))

@case
def contact_linked():
    """each pierces the other with one edge"""
    return pair(FLAT, ((3, -2, -2), (3, 3, 1), (3, -2, 4)))

@case
def contact_cut_through():
    """the whole width is cut"""
    return pair(FLAT, ((2, -9, -5), (2, 20, -5), (2, 3, 9)))

@case
def contact_through_corner():
    """the plane of one runs through a corner of the other"""
    return pair(FLAT, ((-1, -1, -2), (9, 9, -2), (4, 4, 9)))

@case
def contact_corner_and_crossing():
    """a common corner, and a segment from it"""
    return pair(FLAT, ((0, 0, 0), (6, 3, -2), (3, 6, 2)))

@case
def contact_from_edge_inwards():
    """a corner on an edge, the triangle goes on through the inside"""
    return pair(FLAT, ((3, 0, 0), (4, 5, -3), (2, 5, 3)))

@case
def contact_inexact_segment():
    """the ends of the intersection are no doubles"""
    return pair(((0, 0, 0), (7, 1, 0), (1, 9, 0)), ((2, 1, -3), (3, 7, -1), (2.5, 3, 5)))


# --- Coplanar pairs ---------------------------------------------------------------------------

@case
def coplanar_apart():
    """in one plane, boxes overlap, nothing in common"""
    return pair(FLAT, ((8, 8, 0), (8, 1, 0), (1, 8, 0)))

@case
def coplanar_vertex_vertex():
    """touch in a common corner"""
    return pair(FLAT, ((0, 0, 0), (-3, 0, 0), (0, -3, 0)))

@case
def coplanar_vertex_edge():
    """a corner on an edge, from outside"""
    return pair(FLAT, ((3, 0, 0), (2, -3, 0), (4, -3, 0)))

@case
def coplanar_edge_edge():
    """a common edge, on either side"""
    return pair(FLAT, ((0, 0, 0), (8, 0, 0), (3, -4, 0)))

@case
def coplanar_edges_overlap():
    """edges overlap in part, on either side"""
    return pair(FLAT, ((3, 0, 0), (12, 0, 0), (3, -4, 0)))

@case
def coplanar_overlap():
    """overlap in a triangle"""
    return pair(FLAT, ((2, 2, 0), (10, 2, 0), (2, 10, 0)))

@case
def coplanar_star():
    """overlap in a hexagon"""
    return pair(((0, 0, 0), (6, 0, 0), (3, 6, 0)), ((0, 4, 0), (6, 4, 0), (3, -2, 0)))

@case
def coplanar_contained():
    """one inside the other"""
    return pair(FLAT, ((1, 1, 0), (3, 1, 0), (1, 3, 0)))

@case
def coplanar_contained_to_the_edge():
    """one inside the other, an edge and a corner on its border"""
    return pair(FLAT, ((1, 0, 0), (6, 0, 0), (0, 5, 0)))

@case
def coplanar_common_edge_same_side():
    """a common edge, both on one side of it"""
    return pair(FLAT, ((0, 0, 0), (8, 0, 0), (3, 3, 0)))

@case
def coplanar_common_corner():
    """a common corner, overlap from there"""
    return pair(FLAT, ((0, 0, 0), (9, 2, 0), (2, 9, 0)))

@case
def coplanar_tilted():
    """overlap in a plane that is parallel to no axis"""
    lift = lambda x, y, z: (x, y, 3 * x - 5 * y + 7)
    return all_moved(coplanar_star(), lift)

@case
def coplanar_three():
    """three overlap, pairwise and all"""
    return {**coplanar_overlap(), "c": tri((1, 0, 0), (6, 6, 0), (-1, 5, 0))}

@case
def coplanar_crossed():
    """an overlap that a third triangle cuts through"""
    return {**coplanar_overlap(), "c": tri((1, 1, -3), (6, 3, -3), (3, 3, 4))}

@case
def coplanar_grids():
    """two triangulations of one rectangle"""
    flat = lambda x, y: (x, y, 0.0)
    return {"a": grid(5, 4, flat), "b": grid(3, 7, flat)}

@case
def duplicates():
    """equal triangles: in one surface, in another, turned over"""
    v, _ = tri(*FLAT)
    return {"a": (v, [(0, 1, 2), (2, 0, 1)]), "b": (v, [(0, 2, 1)]),
            "c": tri((2, 1, -2), (2, 5, -2), (2, 3, 2))}

@case
def degenerate():
    """triangles that are a segment or a point, among others"""
    v = [(0, 0, 0), (8, 0, 0), (0, 8, 0), (4, 0, 0), (2, 2, 5), (8, 0, 0)]
    return {"a": (v, [(0, 1, 2), (0, 3, 1), (4, 4, 4), (1, 5, 2)]),
            "b": tri((2, 1, -2), (2, 5, -2), (2, 3, 2))}
