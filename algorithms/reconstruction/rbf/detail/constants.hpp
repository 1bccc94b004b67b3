// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of filling by radial basis functions that decide its result.
#pragma once

#include <cstddef>
#include <vector>

#include <terrane/algorithms/core/named_constant.hpp>

namespace terrane::rbf::detail {

/// Thresholds named worth_... are the share of the validation error of the best form so far below
/// which another form is preferred. Smaller: the simpler form is kept more often.
struct RbfConstants {
    /// Least cosine between normals and axis for which a surface counts as a graph: 60
    /// degrees.
    double graph_cosine = 0.5;
    /// Cosine below which offsets along normals are tried as well: 45 degrees.
    double steep_cosine = 0.7;
    /// For a polynomial of another degree.
    double worth_degree = 0.9;
    /// For a polynomial in space.
    double worth_in_space = 0.75;
    /// For smoothing, which takes roughness for noise.
    double worth_smoothing = 0.75;
    /// Validation error, in radii of the hole, below which nothing more is tried.
    double exact = 1e-12;
    /// Least distance of an offset constraint from the surface, in expected distances: the
    /// surface may curve towards it a little.
    double least_distance = 0.95;
    /// Distances that are tried for an offset constraint.
    unsigned offset_halvings = 3;
    /// Data that determine a smoothed function. Larger: less noise, more time.
    std::size_t most_smoothed_data = 6000;
    /// Data that suffice to find where centres are needed.
    std::size_t enough_data = 20'000;
    /// Data left out at which a form is judged.
    std::size_t most_judged = 1000;
    /// Data of the power function, n^3.
    std::size_t most_error_points = 160;
    /// By how much the hole is widened for validation, in its radii. Larger: a more
    /// pessimistic expected error.
    double left_out_width = 0.25;
    /// Weight of a degree of freedom in cross-validation (Kim and Gu 2004). Larger:
    /// smoother.
    double freedom_weight = 1.4;
    /// Ratio of diagonal entries, in a unit box, below which a polynomial vanishes at all
    /// points.
    double singular = 1e-10;
    /// Points of a cell of the partition of unity.
    std::size_t most_in_cell = 48;
    /// Radius of a ball, in radii of its cell. Larger: smoother blending, more work.
    double ball_ratio = 1.5;
    /// Step of the lattice, in target edge lengths; with `thinning` it gives edges of the
    /// target length on average.
    double lattice_step = 0.72;
    /// Vertices nearer to each other are thinned, in target edge lengths.
    double thinning = 0.7;
    /// Least distance of a vertex from the ends of its lattice edge, in edges; keeps
    /// triangles from being degenerate.
    double least_cut = 0.02;
    /// Edges are long above this multiple of the median border edge.
    double long_edge = 1.5;
    /// Distance from the border up to which long edges are divided, in median border edges.
    double long_edge_reach = 3;
    /// Distance from the border up to which the level continues over the surface, in edge
    /// lengths; joining needs some rows there.
    double mask_margin = 3;
    /// Distance from the surface up to which the level counts as over it, in edge lengths.
    double mask_under = 1.5;
    /// Share of a distance bound that is used; the rest exceeds rounding errors.
    double mask_sure = 0.99;
    /// Edges at which flatness is judged.
    std::size_t most_sags = 1024;
};

inline constexpr RbfConstants constants;

/// Lists all constants by name, in the order of their declaration.
inline std::vector<NamedConstant> named_constants() {
    return {
        {"graph_cosine", constants.graph_cosine},
        {"steep_cosine", constants.steep_cosine},
        {"worth_degree", constants.worth_degree},
        {"worth_in_space", constants.worth_in_space},
        {"worth_smoothing", constants.worth_smoothing},
        {"exact", constants.exact},
        {"least_distance", constants.least_distance},
        {"offset_halvings", static_cast<double>(constants.offset_halvings)},
        {"most_smoothed_data", static_cast<double>(constants.most_smoothed_data)},
        {"enough_data", static_cast<double>(constants.enough_data)},
        {"most_judged", static_cast<double>(constants.most_judged)},
        {"most_error_points", static_cast<double>(constants.most_error_points)},
        {"left_out_width", constants.left_out_width},
        {"freedom_weight", constants.freedom_weight},
        {"singular", constants.singular},
        {"most_in_cell", static_cast<double>(constants.most_in_cell)},
        {"ball_ratio", constants.ball_ratio},
        {"lattice_step", constants.lattice_step},
        {"thinning", constants.thinning},
        {"least_cut", constants.least_cut},
        {"long_edge", constants.long_edge},
        {"long_edge_reach", constants.long_edge_reach},
        {"mask_margin", constants.mask_margin},
        {"mask_under", constants.mask_under},
        {"mask_sure", constants.mask_sure},
        {"most_sags", static_cast<double>(constants.most_sags)},
    };
}

} // namespace terrane::rbf::detail
