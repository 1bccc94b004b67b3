// SPDX-License-Identifier: LGPL-3.0-or-later
//
// From exact points to doubles: each to the nearest, then, where the mesh of doubles is not
// conforming any more, iterated snap rounding of what still crosses and what shares its cells.
//
// Guarantee: where report.clean, no two triangles of the mesh meet other than in a shared vertex or
// edge, none is degenerate, none repeated: shown by exact predicates on the doubles themselves.
// Otherwise report.contacts names the pairs that are left. There is no proof that the rounds end
// well for every input; hence the check, and the refusal.
// Cost: nearest doubles of the constructed points and one box search of the triangles that have
// one; then, per round, the same for what moved.
// Source: Valque and Lazard, Removing self-intersections in triangular meshes (2025), made local.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/check/conforming.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/shared_mesh.hpp>
#include <terrane/algorithms/regions/regions.hpp>

namespace terrane {

/// Options of round_to_doubles().
struct RoundingOptions {
    unsigned max_rounds = 8; ///< of snapping, at most 8; 0: to the nearest double and no further
};

/// A surface some of whose regions were too thin for doubles.
struct LostRegions {
    std::uint32_t surface = 0; ///< which surface
    std::size_t exact = 0;     ///< regions before rounding
    std::size_t rounded = 0;   ///< regions after rounding
};

/// How rounding went.
struct RoundingReport {
    bool clean = false;                    ///< conforming, by exact check of the doubles
    unsigned rounds = 0;                   ///< of snapping
    std::size_t naive_contacts = 0;        ///< pairs that met improperly when all was nearest
    std::vector<ImproperContact> contacts; ///< left at the end; triangles of the mesh
    double max_move = 0;  ///< no vertex is farther from its exact point; unit of the
                          ///< input
    double deviation = 0; ///< no point of the mesh is farther from the exact surfaces,
                          ///< nor the reverse, but for vanished parts; >= max_move
    std::array<std::size_t, 32> moves{};   ///< vertices by move: [0] none, [k] from 10^(k - 24) on
    std::size_t moved_input_vertices = 0;  ///< input vertices that had to give way
    std::size_t merged_vertices = 0;       ///< distinct points that became one
    std::size_t collapsed_triangles = 0;   ///< lost their area
    double seconds_regions = 0;            ///< of the whole: intersection edges and regions of the
                                           ///< mesh, which is no rounding
    std::vector<LostRegions> lost_regions; ///< surfaces with fewer regions than the exact ones
    std::vector<std::uint32_t> vanished;   ///< input triangles of which nothing is left, ascending
};

/// The mesh of doubles, with regions, parents and intersection edges, and how it came about.
struct RoundedMesh {
    SharedMesh mesh; ///< conforming where report.clean
    std::optional<ConformingMesh>
        conforming{};            ///< the same mesh with its proof, where report.clean
    std::vector<Region> regions; ///< of the mesh; regions_of counts them
    RoundingReport report;       ///< how it came about
};

/// Errors: interrupted, out_of_memory, bad_number (a constructed point is beyond the largest
/// double).
Result<RoundedMesh> round_to_doubles(const Arrangement& arrangement,
                                     const RoundingOptions& options = {}, const Run& run = {});

} // namespace terrane
