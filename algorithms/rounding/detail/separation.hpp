// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which parts of divided triangles may meet improperly after their vertices moved a little. Most
// provably do not, face against face, with no pair of parts looked at.
//
// Two faces F and G, divided exactly; every vertex of their parts within d of its exact place.
// First what the faces themselves show. Where they are not coplanar, let their planes meet at an
// angle with sine s in a line, along which F and G have the intervals I and J; C at least the
// cotangents of all edges with the line that it crosses; D the distance of a point p of F from q of
// G. Then p is at most D / s from the line, its foot thus C D / s from I, that of q the same from
// J, and the feet D from each other. So (1) if I and J are a distance g apart, D >= g s / (s + 2
// C): clear where that is more than 2 d; (2) if I and J meet, in T, p is at most D / k from T, with
// k = s / (s + 1 + C). Then F and G are
//     clear where a^2 >= 64 d l / k: l at least the longest edge, a at most the least altitude of
//     the parts at all vertices that F and G have in common.
// Reason for (2): let f be 1 at these vertices, 0 at all others, linear on parts. T consists of
// common vertices and edges, where f is 1, and f falls at most by 1 / a per distance: so a (1 - f)
// is at most the distance from T. Parts c and b with points p and q at one place after the move
// have D <= 2 d, hence 1 - f <= 2 d / (k a) <= a / (32 l): both points are close to corners on T,
// and as different vertices on T are a apart, c and b have a corner v in common there, or two.
// Relative to v, p and q have moved by at most 2 d / a times their distances from v, which are at
// most some l (1 - f); so D would be at most 17 d l (1 - f) / a, though it is at least k a (1 - f),
// with the larger 1 - f of both: only with 1 - f = 0, on T itself, which the parts have in common.
//
// Else part by part. Let u be a unit functional that is <= 0 on G (the height above its plane,
// above or below, the distance beyond one of its edges, or the latter turned round its edge by less
// than a right angle): after the move u <= d on the parts of G. A part c of F (3) with u > d at all
// corners meets no part of G; (4) whose corners either are vertices of parts of G with |u| <= d, or
// have u
// >= 64 d (l / a)^2,
//     meets each part of G in their common vertices and edges only, where a^2 >= 64 d l. Here l is
//     at least the longest edge of c and of the parts of G at those vertices, and a at most the
//     least altitude of these.
// Reason for (4): c leaves the vertex or edge that it shares with G at a slope of at least 64 d l /
// a^2, the parts of G at a vertex of it at one of at most 2 d / a, or turned away from c by an
// angle of a / l; and all others are a^2 / l away, farther than c goes while u <= d. Likewise
// (5) two parts of one face meet improperly only if both have a vertex where a^2 < 64 d l.
// All in doubles, with the rounding errors added to d.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane {

/// Divided faces and their parts, after the move.
struct MovedParts {
    std::span<const Point3> face_points; ///< exact corners of faces
    std::span<const Triangle> faces;     ///< indices into face_points
    std::span<const PointIndex> names;   ///< per point: its index into face_points, if it is one
                                         ///< of them; else no index of these
    std::span<const Point3> points;      ///< moved vertices of the parts
    std::span<const double> moves;       ///< per point: at most this far from its exact place
    std::span<const Triangle> parts;     ///< indices into points
    const IndexLists<std::uint32_t>& faces_of; ///< per part: the faces that contain it, sorted
};

/// Of parts whose faces are a pair of `meeting`, whatever meets improperly is among `pairs` or has
/// one of `parts` in it; of parts of one face, it has one of `ill_conditioned` in it.
struct Unproven {
    std::vector<CandidatePair> pairs;           ///< of parts; sorted, unique
    std::vector<std::uint32_t> parts;           ///< ascending
    std::vector<std::uint32_t> ill_conditioned; ///< ascending
};

/// `meeting`: pairs of faces of which one is divided; sorted.
/// Cost: linear in all parts of the mesh, and in the common vertices of pairs; where a pair is not
/// clear as a whole, in the parts of its faces.
Unproven find_unproven(const MovedParts& moved, std::span<const CandidatePair> meeting,
                       const Run& run);

} // namespace terrane
