// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Repairs a part of a mesh of nearest doubles as round_to_doubles() repairs it in the whole mesh.
//
// Guarantee: a part that needs no more of the whole (RepairedPart::missing is empty) and is clean has the
// points and triangles that round_to_doubles() gives the whole mesh, in the same order.
// Reason: rounding looks at the triangles that overlap those in the way. It counts pairs that meet
// improperly, and the part has all of them. The caller states the numbers of the whole that it uses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/rounding/detail/parents_in_contact.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane {

/// A part of a mesh of nearest doubles, and what has to be known of the whole.
struct PartOfDoubles {
    std::vector<Point3> points; ///< input vertices, then constructed points, in the order of the
                                ///< whole; those of the triangles
    std::size_t input_vertices = 0;       ///< number of the former
    std::vector<double> moves;            ///< per point: bound of the distance from its exact place
    std::vector<Triangle> triangles;      ///< in the order of the whole
    IndexLists<std::uint32_t> parents_of; ///< per triangle, sorted
    std::vector<std::uint32_t>
        unclean;              ///< points, ascending: the corners of triangles that meet others
                              ///< improperly or have no area, and points that are equal
    std::vector<Box> covered; ///< all triangles that overlap one of these are in the part

    std::size_t triangles_elsewhere = 0;       ///< number of other triangles
    std::array<double, 3> largest_elsewhere{}; ///< absolute coordinate of their points, per axis
    double largest_move = 0;                   ///< of all points of the whole
    double limit = 0;                          ///< see RoundingReport::max_allowed
    bool is_moved = false; ///< whether the input was moved: also crowded contacts are repaired then
    double used = 0;       ///< of the limit, by that
};

/// A part after its repair.
struct RepairedPart {
    std::vector<Box> missing;   ///< if not empty: what has to be covered, too; nothing is repaired
    std::uint64_t compared = 0; ///< boxes, to find that
    bool clean =
        false; ///< whether nothing meets improperly any more. If not, the input has to be moved
    rounding::detail::ParentsInContact in_contact; ///< if it is not clean
    std::size_t naive_contacts = 0;                ///< see RoundingReport
    unsigned rounds = 0;
    double surface_deviation = 0, max_move = 0;

    std::vector<Point3>
        points; ///< those of the part, some of which no triangle has any more, and new ones
    std::vector<double> moves; ///< per point
    std::vector<Triangle> triangles;
    IndexLists<std::uint32_t> parents_of;
    std::vector<std::uint32_t>
        origins; ///< per triangle: the one of the part in whose place it is; ascending
};

/// Repairs a part. Check run.stop afterwards: a stopped run leaves it unfinished.
RepairedPart repair_part(PartOfDoubles part, const Run& run = {});

} // namespace terrane
