// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of filling by radial basis functions that decide its result.
#pragma once

#include <array>
#include <cstddef>

#include <terrane/algorithms/core/constants.hpp>

namespace terrane::rbf::detail {

/// Thresholds named worth_... are the share of the validation error of the best form so far below
/// which another form is preferred. Smaller: the simpler form is kept more often.
struct RbfConstants : Constants {
    /// Least cosine between normals and axis for which a surface counts as a graph: 60 degrees.
    double graph_cosine = add("graph_cosine", 0.5);
    /// Cosine below which offsets along normals are tried as well: 45 degrees.
    double steep_cosine = add("steep_cosine", 0.7);
    /// For a polynomial of another degree.
    double worth_degree = add("worth_degree", 0.9);
    /// For a polynomial in space.
    double worth_in_space = add("worth_in_space", 0.75);
    /// For smoothing, which takes roughness for noise.
    double worth_smoothing = add("worth_smoothing", 0.75);
    /// Validation error, in radii of the hole, below which nothing more is tried.
    double exact = add("exact", 1e-12);
    /// Least distance of an offset constraint from the surface, in expected distances: the
    /// surface may curve towards it a little.
    double least_distance = add("least_distance", 0.95);
    /// Distances that are tried for an offset constraint.
    unsigned offset_halvings = add("offset_halvings", 3);
    /// Error at a datum, in median border edges, that is left to it.
    double tolerance = add("tolerance", 0.001);
    /// Distance from the data at which what is left of them has faded, in median border edges.
    double rest_reach = add("rest_reach", 6);
    /// Data left out at which a form is judged.
    std::size_t most_judged = add("most_judged", 1000);
    /// By how much the hole is widened for validation, in its radii. Larger: a more
    /// pessimistic expected error.
    double left_out_width = add("left_out_width", 0.25);
    /// Step of the lattice, in target edge lengths; with `thinning` it gives edges of the
    /// target length on average.
    double lattice_step = add("lattice_step", 0.72);
    /// Vertices nearer to each other are thinned, in target edge lengths.
    double thinning = add("thinning", 0.7);
    /// Least distance of a vertex from the ends of its lattice edge, in edges; keeps
    /// triangles from being degenerate.
    double least_cut = add("least_cut", 0.02);
    /// Edges are long above this multiple of the median border edge.
    double long_edge = add("long_edge", 1.5);
    /// Distance from the border up to which long edges are divided, in median border edges.
    double long_edge_reach = add("long_edge_reach", 3);
    /// Distance from the border up to which the level continues over the surface, in edge
    /// lengths; joining needs some rows there.
    double mask_margin = add("mask_margin", 3);
    /// Distance from the surface up to which the level counts as over it, in edge lengths.
    double mask_under = add("mask_under", 1.5);
    /// Share of a distance bound that is used; the rest exceeds rounding errors.
    double mask_sure = add("mask_sure", 0.99);
    /// Edges at which flatness is judged.
    std::size_t most_sags = add("most_sags", 256);
    /// Degrees of polynomials along the surface that are tried.
    std::array<unsigned, 6> degrees = add<unsigned>(
        {"degrees_1", "degrees_2", "degrees_3", "degrees_4", "degrees_5", "degrees_6"},
        {1, 2, 3, 4, 6, 8});
    /// Degrees of polynomials in space that are tried.
    std::array<unsigned, 5> degrees_in_space =
        add<unsigned>({"degrees_in_space_1", "degrees_in_space_2", "degrees_in_space_3",
                       "degrees_in_space_4", "degrees_in_space_5"},
                      {2, 3, 4, 5, 6});
    /// Centres per term of a polynomial along the surface, at least; of a graph, trial data.
    /// Larger: lower degrees.
    std::size_t centres_per_term = add("centres_per_term", 3);
    /// Least number of centres at the start.
    std::size_t least_start = add("least_start", 10);
    /// The start has one in this many of the centres that are allowed.
    std::size_t start_part = add("start_part", 4);
    /// Distance of offset constraints: the radius of the hole divided by this, if that is more
    /// than by offset_edges.
    double offset_part = add("offset_part", 20);
    /// Least distance of offset constraints, in median border edges.
    double offset_edges = add("offset_edges", 0.5);
    /// Least distance of offset constraints near noisy data, in radii of the hole.
    double noisy_offset = add("noisy_offset", 0.25);
    /// The width of a part left out for validation is at most that of the data divided by this.
    double left_out_part = add("left_out_part", 3);
    /// Least width of a part left out for validation, in median border edges.
    double left_out_edges = add("left_out_edges", 1.5);
    /// With fewer data left, forms are not compared.
    std::size_t least_judged = add("least_judged", 10);
    /// Least slope by which the value at a datum is divided for its distance from the level.
    double least_slope = add("least_slope", 0.1);
    /// Length of the mean border normal below which it is no axis.
    double least_mean_normal = add("least_mean_normal", 0.1);
    /// One normal in this many may lean farther than the steepness that is compared.
    std::size_t outlier_part = add("outlier_part", 20);
    /// Room of the lattice around the border, in sizes of the border.
    double domain_share = add("domain_share", 0.5);
    /// Room of the lattice around the border, in lattice steps, in addition.
    double domain_steps = add("domain_steps", 8);
    /// How often a long edge is halved.
    unsigned long_edge_halvings = add("long_edge_halvings", 10);
    /// Largest step of a vertex towards the level: the edge length divided by this.
    double level_part = add("level_part", 3);
    /// Least shape, relative to that before, after a vertex has moved to the mean of its
    /// neighbours.
    double least_moved_shape = add("least_moved_shape", 0.4);
    /// The same after a vertex has moved to the level alone.
    double least_levelled_shape = add("least_levelled_shape", 0.05);
    /// Distance of the level from the triangles at the border, in edge lengths, above which the
    /// triangles are halved.
    double cut_corner = add("cut_corner", 0.25);
    /// Distance from the surface up to which the filling counts as over it, in edge lengths.
    double over_surface = add("over_surface", 0.5);
};

inline constexpr RbfConstants constants{};

} // namespace terrane::rbf::detail
