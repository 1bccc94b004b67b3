// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of filling by radial basis functions that decide its result.
#pragma once

#include <array>
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
    std::size_t most_sags = 256;
    /// Degrees of polynomials along the surface that are tried.
    std::array<unsigned, 6> degrees{1, 2, 3, 4, 6, 8};
    /// Degrees of polynomials in space that are tried.
    std::array<unsigned, 5> degrees_in_space{2, 3, 4, 5, 6};
    /// Centres per term of a polynomial along the surface, at least; of a graph, trial data.
    /// Larger: lower degrees.
    std::size_t centres_per_term = 3;
    /// Least number of centres at the start.
    std::size_t least_start = 10;
    /// Ratio of the allowed centres to those of the start.
    std::size_t start_part = 4;
    /// Largest growth of the number of centres in a round.
    std::size_t centre_growth = 2;
    /// Least distance between new centres, in spacings of the round before. Larger: fewer
    /// centres per round.
    double crowded = 0.5;
    /// Distance of offset constraints: the radius of the hole divided by this, if that is more
    /// than by offset_edges.
    double offset_part = 20;
    /// Least distance of offset constraints, in median border edges.
    double offset_edges = 0.5;
    /// Least distance of offset constraints near noisy data, in radii of the hole.
    double noisy_offset = 0.25;
    /// Largest width of what is left out for validation: that of the data divided by this.
    double left_out_part = 3;
    /// Least width of what is left out for validation, in median border edges.
    double left_out_edges = 1.5;
    /// With fewer data left, forms are not compared.
    std::size_t least_judged = 10;
    /// Centres of a trial fit.
    std::size_t trial_centres = 800;
    /// Centres of a trial fit with smoothing.
    std::size_t trial_centres_smoothed = 400;
    /// Centres of a trial fit, at most, in centres that are allowed.
    std::size_t trial_growth = 4;
    /// Least slope by which the value at a datum is divided for its distance from the level.
    double least_slope = 0.1;
    /// Length of the mean border normal below which it is no axis.
    double least_mean_normal = 0.1;
    /// One normal in this many may lean farther than the steepness that is compared.
    std::size_t outlier_part = 20;
    /// Least degree of smoothing that cross-validation tries: power of ten, in largest
    /// eigenvalues.
    double least_lambda = -13;
    /// Largest degree of smoothing, likewise.
    double most_lambda = 3;
    /// Step between degrees of smoothing, in powers of ten.
    double lambda_step = 0.25;
    /// Eigenvalues below this share of the largest one count as 0.
    double eigenvalue_noise = 1e-14;
    /// The solution is refined until the residual shrinks to no less than this share.
    double least_refinement = 0.5;
    /// Half of the points of the power function are no farther from the border than this, in
    /// radii of the hole, beyond the margin.
    double error_near = 0.25;
    /// Room of the lattice around the border, in sizes of the border.
    double domain_share = 0.5;
    /// Room of the lattice around the border, in lattice steps, in addition.
    double domain_steps = 8;
    /// How often a long edge is halved.
    unsigned long_edge_halvings = 10;
    /// Largest step of a vertex towards the level: the edge length divided by this.
    double level_part = 3;
    /// Least shape, relative to that before, after a vertex has moved to the mean of its
    /// neighbours.
    double least_moved_shape = 0.4;
    /// The same after a vertex has moved to the level alone.
    double least_levelled_shape = 0.05;
    /// Distance of the level from the triangles at the border, in edge lengths, above which the
    /// triangles are halved.
    double cut_corner = 0.25;
    /// Distance from the surface up to which the filling counts as over it, in edge lengths.
    double over_surface = 0.5;
    /// Well-spread data from which the kernel and the degree of a graph are chosen. Larger: slower,
    /// n^3.
    std::size_t height_trial = 112;
    /// Of these data, those whose nearest neighbour is taken as well.
    std::size_t height_pairs = 48;
    /// Blocks as wide as the hole that are left out of a graph in turn.
    std::size_t height_blocks = 12;
    /// Data that are left out of a graph in such blocks, well spread.
    std::size_t height_validation = 300;
    /// Share of the nugget that is noise, by the weights of the data, above which all of it counts
    /// as such.
    double least_noise_share = 0.5;
    /// Least factor of a kernel whose data may as well be noise.
    double least_share = 1e-6;
    /// The model of kriging is believed up to this multiple of the error of the fit at such blocks.
    double worth_own = 1.5;
    /// Square of what kriging misses of blocks beyond noise, in squares of the noise, above which
    /// this tells two models apart.
    double least_excess = 0.5;
    /// Noise of the fit, in that of the model of kriging, above which its model is not believed.
    double most_own_noise = 2;
    /// Multiplications above which expected errors come from these data alone.
    double most_operations = 5e9;
    /// A block with more than this share of the data is not left out.
    double most_of_all = 0.7;
    /// Centres of a graph whose data are to be missed by a given amount.
    std::size_t most_smoothed_heights = 600;
    /// Slope between two data above which they are no graph: 87 degrees.
    double steepest_graph = 20;
    /// Distance of the data from a polynomial, in units, below which it is rounding.
    double height_rounding = 1e-13;
    /// How far what a graph misses of the data reaches into the hole, in median border edges.
    /// Larger: noise enters the hole; much less: the filling has spikes at its border.
    double noise_reach = 0.75;
    /// First addition to the diagonal of a singular system of a graph, in its mean entries.
    double least_addition = 1e-13;
    /// Largest such addition.
    double most_addition = 1e-7;
    /// Growth of such additions.
    double addition_growth = 100;
};

inline constexpr RbfConstants constants;

/// The constants of the fit by name, in the order of their declaration.
inline constexpr auto fit_constants_by_name = std::to_array<NamedConstant>({
    {"degrees_1", static_cast<double>(constants.degrees[0])},
    {"degrees_2", static_cast<double>(constants.degrees[1])},
    {"degrees_3", static_cast<double>(constants.degrees[2])},
    {"degrees_4", static_cast<double>(constants.degrees[3])},
    {"degrees_5", static_cast<double>(constants.degrees[4])},
    {"degrees_6", static_cast<double>(constants.degrees[5])},
    {"degrees_in_space_1", static_cast<double>(constants.degrees_in_space[0])},
    {"degrees_in_space_2", static_cast<double>(constants.degrees_in_space[1])},
    {"degrees_in_space_3", static_cast<double>(constants.degrees_in_space[2])},
    {"degrees_in_space_4", static_cast<double>(constants.degrees_in_space[3])},
    {"degrees_in_space_5", static_cast<double>(constants.degrees_in_space[4])},
    {"centres_per_term", static_cast<double>(constants.centres_per_term)},
    {"least_start", static_cast<double>(constants.least_start)},
    {"start_part", static_cast<double>(constants.start_part)},
    {"centre_growth", static_cast<double>(constants.centre_growth)},
    {"crowded", constants.crowded},
    {"offset_part", constants.offset_part},
    {"offset_edges", constants.offset_edges},
    {"noisy_offset", constants.noisy_offset},
    {"left_out_part", constants.left_out_part},
    {"left_out_edges", constants.left_out_edges},
    {"least_judged", static_cast<double>(constants.least_judged)},
    {"trial_centres", static_cast<double>(constants.trial_centres)},
    {"trial_centres_smoothed", static_cast<double>(constants.trial_centres_smoothed)},
    {"trial_growth", static_cast<double>(constants.trial_growth)},
    {"least_slope", constants.least_slope},
    {"least_mean_normal", constants.least_mean_normal},
    {"outlier_part", static_cast<double>(constants.outlier_part)},
    {"least_lambda", constants.least_lambda},
    {"most_lambda", constants.most_lambda},
    {"lambda_step", constants.lambda_step},
    {"eigenvalue_noise", constants.eigenvalue_noise},
    {"least_refinement", constants.least_refinement},
    {"error_near", constants.error_near},
    {"domain_share", constants.domain_share},
    {"domain_steps", constants.domain_steps},
    {"long_edge_halvings", static_cast<double>(constants.long_edge_halvings)},
    {"level_part", constants.level_part},
    {"least_moved_shape", constants.least_moved_shape},
    {"least_levelled_shape", constants.least_levelled_shape},
    {"cut_corner", constants.cut_corner},
    {"over_surface", constants.over_surface},
    {"height_trial", static_cast<double>(constants.height_trial)},
    {"height_pairs", static_cast<double>(constants.height_pairs)},
    {"height_blocks", static_cast<double>(constants.height_blocks)},
    {"height_validation", static_cast<double>(constants.height_validation)},
    {"least_noise_share", constants.least_noise_share},
    {"least_share", constants.least_share},
    {"worth_own", constants.worth_own},
    {"least_excess", constants.least_excess},
    {"most_own_noise", constants.most_own_noise},
    {"most_operations", constants.most_operations},
    {"most_of_all", constants.most_of_all},
    {"most_smoothed_heights", static_cast<double>(constants.most_smoothed_heights)},
    {"steepest_graph", constants.steepest_graph},
    {"height_rounding", constants.height_rounding},
    {"noise_reach", constants.noise_reach},
    {"least_addition", constants.least_addition},
    {"most_addition", constants.most_addition},
    {"addition_growth", constants.addition_growth},
});

/// Lists the constants of the fit, by name, in the order of their declaration.
inline std::vector<NamedConstant> named_constants_of_fit() {
    return {fit_constants_by_name.begin(), fit_constants_by_name.end()};
}

/// Lists all constants by name, in the order of their declaration.
inline std::vector<NamedConstant> named_constants() {
    std::vector<NamedConstant> all{
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
    const auto fit = named_constants_of_fit();
    all.insert(all.end(), fit.begin(), fit.end());
    return all;
}

} // namespace terrane::rbf::detail
