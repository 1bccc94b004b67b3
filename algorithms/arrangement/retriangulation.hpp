// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Performs steps (c) to (f) of the arrangement on a triangle soup: divides triangles where they
// meet improperly and merges coinciding parts. It knows nothing of surfaces; the arrangement and
// each round of rounding use it.
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

/// Counts what a retriangulation did.
struct RetriangulationStatistics {
    std::size_t improper_contacts = 0; ///< pairs of triangles
    std::size_t divided = 0;           ///< triangles that were triangulated
    PredicateCounts predicates;
};

/// Conforming, unique triangles. Each triangle of the soup is exactly the union of the triangles
/// that name it.
struct Retriangulation {
    PointStore points;                  ///< the soup's points, then constructed points
    std::vector<PointIndex> ascending;  ///< constructed points in use, in lexicographic order,
                                        ///< distinct from each other and from the soup's points
    std::vector<Triangle> triangles;    ///< corners by point; in the order of the soup; oriented
                                        ///< as the first face
    IndexLists<std::uint32_t> faces_of; ///< per triangle: triangles of the soup that contain it,
                                        ///< ascending, >= 1
    std::vector<std::uint32_t>
        unchanged_as;                 ///< per triangle of the soup: its index in triangles if it is
                                      ///< undivided and the only face there; else UINT32_MAX
    std::vector<CandidatePair> near;  ///< candidates whose parts may meet when their points are
                                      ///< rounded to nearest doubles; the others stay apart, but
                                      ///< for those within a pool or a pencil
    std::vector<std::uint32_t> pools; ///< per triangle of the soup: its pool, or no_group; empty
                                      ///< without pools
    RetriangulationStatistics statistics;
};

/// Retriangulates a soup; points and triangles are those of a TriangleSoup. `candidates` must
/// contain all pairs that meet improperly but for those in different planes of a pencil. tested:
/// see find_contacts. Check run.stop afterwards: a stopped run leaves the
/// result unfinished. Throws std::logic_error if an assertion fails. Times: intersect, triangulate
/// and stitch.
Retriangulation retriangulate(std::vector<Point3> points, std::span<const Triangle> triangles,
                              std::span<const CandidatePair> candidates, const Pencils& pencils,
                              const Run& run, TestedPairs* tested = nullptr);

} // namespace terrane
