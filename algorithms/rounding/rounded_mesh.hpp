// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The result of rounding an arrangement to doubles, its report, and the options that decide it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/check/conforming.hpp>
#include <terrane/algorithms/check/pair_check.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/mesh/shared_mesh.hpp>
#include <terrane/algorithms/regions/regions.hpp>

namespace terrane {

/// Options of round_to_doubles().
struct RoundingOptions {
    unsigned max_rounds = 8;  ///< limit on the rounds of snapping, for a part of an arrangement
                              ///< in place and with moved input each; 0: nearest doubles only
    PairCheckOptions check{}; ///< how the doubles are checked; the mesh does not depend on it
    /// The farthest that surfaces may move, unit of the input: what no move up to it makes
    /// conforming is refused. None: default_max_move(). Must be at least the error of the nearest
    /// doubles.
    std::optional<double> max_move{};
};

/// A surface that lost regions because they were too thin for doubles.
struct VanishedRegions {
    SurfaceId surface{};     ///< index of the surface
    std::size_t exact = 0;   ///< regions before rounding
    std::size_t rounded = 0; ///< regions after rounding
};

/// The moves, contacts and losses of rounding.
struct RoundingReport {
    bool clean = false;  ///< conforming, by exact check of the doubles
    unsigned rounds = 0; ///< number of snapping rounds
    /// Pairs that meet improperly at the nearest doubles. If they are more than most_counted, there
    /// may be more: the input is then moved at once.
    std::size_t naive_contacts = 0;
    static constexpr std::size_t most_counted = 100'000;
    /// Remaining contacts; triangles of the mesh. If they are more than most_counted, there may be
    /// more: they are then the first ones, in the order of their triangles.
    std::vector<ImproperContact> contacts;
    /// No point of the mesh is farther from the input triangles that it is part of, and no point of
    /// an input triangle is farther from its parts, except for vanished ones; unit of the input.
    double surface_deviation = 0;
    double max_allowed = 0; ///< the limit of surface_deviation: max_move of the options
    double vanished_length =
        0;               ///< points of slivers that became narrower than doubles, and vanished,
                         ///< are at most so much farther from the mesh
    double max_move = 0; ///< no vertex is farther from its exact point
    bool arranged_again = false; ///< whether exact points are those in which surfaces cross after
                                 ///< they were moved, by at most surface_deviation
    double deviation = 0; ///< what a certificate states of all points, vanished slivers included:
        ///< >= surface_deviation + vanished_length, >= max_move of the same triangles
    std::array<std::size_t, 32> moves{};  ///< vertices by move: [0] none, [k] from 10^(k - 24) on
    std::size_t moved_input_vertices = 0; ///< number of input vertices that moved
    std::size_t merged_vertices = 0;      ///< number of points that were merged with another one
    std::size_t collapsed_triangles = 0;  ///< number of triangles that lost their area
    std::vector<VanishedRegions>
        vanished_regions;                ///< surfaces with fewer regions than the exact ones
    std::vector<std::uint32_t> vanished; ///< input triangles without any part left, ascending
    std::optional<PairCounts> pairs;     ///< what decided each pair of triangles, if counted
};

/// The mesh of doubles, with regions, parents and intersection edges, and the report.
struct RoundedMesh {
    SharedMesh mesh;                            ///< conforming if report.clean
    std::optional<ConformingMesh> conforming{}; ///< the same mesh, if report.clean
    std::vector<Region> regions;                ///< regions of the mesh; regions_of refers to them
    RoundingReport report;                      ///< moves, contacts and losses
};

} // namespace terrane
