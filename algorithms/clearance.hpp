// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which parts of divided triangles may meet improperly after their vertices moved a little. Most
// provably do not, face against face, with no pair of parts looked at.
//
// Two faces F and G, divided exactly; every vertex of their parts within d of its exact place. Let
// u be a unit functional that is <= 0 on G (the height above its plane, above or below, the
// distance beyond one of its edges, or the latter turned round its edge by less than a right
// angle): after the move u <= d on the parts of G. A part c of F (1) with u > d at all corners
// meets no part of G; (2) whose corners either are vertices of parts of G with |u| <= d, or have u
// >= 64 d (l / a)^2,
//     meets each part of G in their common vertices and edges only, where a^2 >= 64 d l. Here l is
//     at least the longest edge of c and of the parts of G at those vertices, and a at most the
//     least altitude of these.
// Reason for (2): c leaves the vertex or edge that it shares with G at a slope of at least 64 d l /
// a^2, the parts of G at a vertex of it at one of at most 2 d / a, or turned away from c by an
// angle of a / l; and all others are a^2 / l away, farther than c goes while u <= d. Likewise
// (3) two parts of one face meet improperly only if both have a vertex where a^2 < 64 d l.
// All in doubles, with the rounding errors added to d.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/lists.hpp>
#include <terrane/algorithms/run.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/algorithms/surface.hpp>

namespace terrane {

/// Divided faces and their parts, after the move.
struct MovedParts {
    std::span<const Point3> face_points;  ///< exact corners of faces
    std::span<const Triangle> faces;      ///< indices into face_points
    std::span<const Point3> points;       ///< moved vertices of the parts
    std::span<const double> moves;        ///< per point: at most this far from its exact place
    std::span<const Triangle> parts;      ///< indices into points
    const Lists<std::uint32_t>& faces_of; ///< per part: the faces that contain it, sorted
};

/// Of parts whose faces are a pair of `meeting`, whatever meets improperly is among `pairs` or has
/// one of `parts` in it; of parts of one face, it has one of `restless` in it.
struct Unclear {
    std::vector<CandidatePair> pairs;    ///< of parts; sorted, unique
    std::vector<std::uint32_t> parts;    ///< ascending
    std::vector<std::uint32_t> restless; ///< ascending
};

/// `meeting`: pairs of faces whose boxes overlap and of which one is divided; sorted.
/// Cost: linear in the parts of all faces in pairs, summed over the pairs.
Unclear find_unclear(const MovedParts& moved, std::span<const CandidatePair> meeting,
                     const Run& run);

} // namespace terrane
