// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Lists the parts of divided triangles that may meet improperly after their vertices moved a little.
// Most provably do not: docs/explanation/separation.md states and proves the conditions.
// (1) Faces whose intervals on the line of their planes are apart do not meet.
// (2) Faces that cross meet properly where the parts at their common vertices are well conditioned.
// (3) A part beyond a functional that bounds the other face does not meet that face.
// (4) A part that leaves the other face at common vertices, steeply enough, meets it properly.
// (5) Parts of one face meet properly where one of them has well conditioned vertices only.
// A vertex is well conditioned where a^2 >= 64 d l: a the least altitude, l the longest edge of the
// parts at it, d the largest move. All is computed in doubles, with the rounding errors added to d.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane::rounding::detail {

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

} // namespace terrane::rounding::detail
