// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rounds an arrangement from exact points to doubles. Each point goes to the nearest doubles. Where
// the mesh of doubles is then no longer conforming, iterated snap rounding moves the corners of the
// triangles that cross, and all points in the same grid cells. Inputs that were written as decimals
// are arranged as these decimals instead, so that triangles coplanar in decimals are coplanar.
//
// Guarantee: if report.clean, no two triangles of the mesh meet other than in a shared vertex or
// edge, none is degenerate and none is repeated, as exact predicates on the doubles have shown.
// Otherwise report.contacts lists the remaining pairs. There is no proof that the rounds succeed
// for every input; therefore the result is checked. No surface moves farther than options.max_move,
// whether report.clean or not, and no point leaves or passes a plane of a volume of interest that
// is parallel to two axes.
// Cost: nearest doubles of the constructed points and one box search for the triangles that have
// such points; then, per round, the same for the points that moved.
// Source: Valque and Lazard, Removing self-intersections in triangular meshes (2025), made local.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
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
    /// Number of pairs that meet improperly at the nearest doubles; a lower bound from least_sampled on,
    /// where the pairs of a sample of the triangles decide that the input is moved at once.
    std::size_t naive_contacts = 0;
    static constexpr std::size_t least_sampled = 64;
    static constexpr std::size_t most_counted = 100'000;
    /// Remaining contacts, by triangles of the mesh: all, or the first most_counted in the order of
    /// their triangles.
    std::vector<ImproperContact> contacts;
    /// No point of the mesh is farther from the input triangles that it is part of, and no point of
    /// an input triangle is farther from its parts, except for vanished ones; unit of the input.
    double surface_deviation = 0;
    double max_allowed = 0; ///< the limit of surface_deviation: max_move of the options
    double sufficient_limit =
        0; ///< a max_move with which the mesh would be conforming, where it is not; 0: max_move was
           ///< given, or none was found
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

/// Returns the largest move that is allowed unless options say otherwise: 1024 times the spacing of
/// doubles at the largest coordinate (docs/explanation/rounding.md has the reason).
double default_max_move(const Arrangement& arrangement);
/// Does the same for the largest coordinate, which is not negative.
double default_max_move(double largest);

/// Rounds an arrangement. Errors: interrupted, out_of_memory, bad_option (no doubles are within
/// max_move), bad_number (a constructed point is beyond the largest double), nothing_to_do (all
/// triangles vanished), internal. Times: round, with the step regions (intersection edges and
/// regions of the mesh; not rounding).
Result<RoundedMesh> round_to_doubles(const Arrangement& arrangement,
                                     const RoundingOptions& options = {}, const Run& run = {});

/// The constants that decide how contacts are repaired; they are documented in detail/tuning.hpp.
std::vector<NamedConstant> rounding_constants();

} // namespace terrane
