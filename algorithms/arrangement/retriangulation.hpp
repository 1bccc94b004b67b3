// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Steps (c) to (f) of the arrangement on a soup of triangles: where they meet improperly they are
// divided, and what coincides becomes one. Knows no surfaces: the arrangement uses it, and each
// round of rounding.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/intersection/contacts.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane {

struct RetriangulationStatistics {
    std::size_t improper_contacts = 0; ///< pairs of triangles
    std::size_t divided = 0;           ///< triangles that were triangulated
    PredicateCounts predicates;
    double seconds_intersect = 0, seconds_triangulate = 0, seconds_stitch = 0;
};

/// Conforming, unique triangles; each triangle of the soup is exactly the union of those that name
/// it.
struct Retriangulation {
    PointStore points;                  ///< the soup's points, then constructed ones
    std::vector<PointIndex> ascending;  ///< constructed points in use, in lexicographic order,
                                        ///< distinct from each other and from the soup's points
    std::vector<Triangle> triangles;    ///< corners by point; in the order of the soup; oriented
                                        ///< as the first face
    IndexLists<std::uint32_t> faces_of; ///< per triangle: triangles of the soup that contain it,
                                        ///< ascending, >= 1
    std::vector<std::uint32_t>
        unchanged_as;                ///< per triangle of the soup: the same triangle here, where
                                     ///< it came out whole and alone; UINT32_MAX where not
    std::vector<CandidatePair> near; ///< candidates whose parts may meet when their points are
                                     ///< rounded to nearest doubles; all others stay apart
    RetriangulationStatistics statistics;
};

/// Triangles as in TriangleSoup. `candidates` must hold all pairs that meet improperly. Check
/// run.stop afterwards: a stopped run leaves the result unfinished. Throws std::logic_error where a
/// promise of the kernel is broken.
Retriangulation retriangulate(std::vector<Point3> points, std::span<const Triangle> triangles,
                              std::span<const CandidatePair> candidates, const Run& run);

} // namespace terrane
