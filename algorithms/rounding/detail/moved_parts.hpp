// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The questions to separation.hpp, and its answers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane::rounding::detail {

/// Divided faces and their parts, after the move.
struct MovedParts {
    std::span<const Point3> face_points; ///< exact corners of faces
    std::span<const Triangle> faces;     ///< indices into face_points
    std::span<const PointIndex> names;   ///< per point: its index into face_points if it is one of
                                         ///< them, else an index beyond their end
    std::span<const Point3> points;      ///< moved vertices of the parts
    std::span<const double> moves;       ///< per point: upper bound of its move
    std::span<const Triangle> parts;     ///< indices into points
    const IndexLists<std::uint32_t>& faces_of; ///< per part: the faces that contain it, sorted
};

/// Everything that may meet improperly after the move. Two parts of different faces (a pair of
/// `meeting`): the pair is in `pairs`, or one of them is in `parts`. Two parts of one face of such a
/// pair, whatever other faces contain them: `ill_conditioned` has both.
struct Unproven {
    std::vector<CandidatePair> pairs; ///< pairs of parts; repeated where parts have several faces
    std::vector<std::uint32_t> parts; ///< ascending
    std::vector<std::uint32_t> ill_conditioned; ///< ascending
};

} // namespace terrane::rounding::detail
