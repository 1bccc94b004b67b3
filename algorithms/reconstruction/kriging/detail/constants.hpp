// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of kriging that decide the model and the filling.
#pragma once

#include <array>
#include <cstddef>

#include <terrane/algorithms/core/constants.hpp>

namespace terrane::kriging::detail {

struct KrigingConstants : Constants {
    /// For anisotropy in a fit, in misfits of the isotropic model.
    double worth_anisotropy = add("worth_anisotropy", 0.8);
    /// With fewer data, validation errors do not decide.
    std::size_t least_data = add("least_data", 20);
    /// Blocks that are left out in turn.
    std::size_t blocks = add("blocks", 32);
    /// Classes of the experimental variogram by distance.
    std::size_t distance_classes = add("distance_classes", 15);
    /// Classes of the experimental variogram by direction, 15 degrees each.
    std::size_t direction_classes = add("direction_classes", 12);
    /// Points all pairs of which enter the experimental variogram.
    std::size_t most_variogram_points = add("most_variogram_points", 1500);
    /// First addition to the diagonal of a singular system, in sills.
    double least_addition = add("least_addition", 1e-12);
    /// Largest addition to the diagonal, in sills. Larger: data are smoothed.
    double most_addition = add("most_addition", 1e-6);
    /// Spacing of thinned data per distance from the nearest datum. Larger: farther data
    /// enter an estimate.
    double spacing_per_distance = add("spacing_per_distance", 0.25);
    /// Data up to which each estimate uses all of them. Larger: smoother, n^3.
    std::size_t most_at_once = add("most_at_once", 3000);
    /// Data of an estimate if there are more.
    std::size_t neighbours = add("neighbours", 40);
    /// Interpolated vertices of a filling; above, the mesh becomes coarser.
    std::size_t most_places = add("most_places", 20'000);
    /// Edges at which flatness is judged.
    std::size_t most_sags = add("most_sags", 256);
    /// Least distance of interpolated vertices from a border, in mesh sizes.
    double border_distance = add("border_distance", 0.7);
    /// Exponents of a power model that are tried.
    std::array<double, 4> powers =
        add<double>({"powers_1", "powers_2", "powers_3", "powers_4"}, {0.5, 1, 1.5, 1.9});
    /// Ratios of the ranges across and along that a fit of anisotropy tries.
    std::array<double, 6> anisotropy_ratios =
        add<double>({"anisotropy_ratios_1", "anisotropy_ratios_2", "anisotropy_ratios_3",
                     "anisotropy_ratios_4", "anisotropy_ratios_5", "anisotropy_ratios_6"},
                    {0.8, 0.65, 0.5, 0.4, 0.3, 0.2});
    /// Angle between the directions that a fit of anisotropy tries, in degrees.
    double anisotropy_step = add("anisotropy_step", 15);
    /// Least range that is fitted: the longest distance of the experimental variogram divided
    /// by this.
    double range_part = add("range_part", 30);
    /// Largest range that is fitted, in longest distances of the experimental variogram.
    double range_factor = add("range_factor", 4);
    /// Least exponent of a power model.
    double least_power = add("least_power", 0.1);
    /// Largest exponent of a power model; 2 would be no variogram.
    double most_power = add("most_power", 1.98);
    /// Steps of the grid on which a range or exponent is searched.
    int fit_steps = add("fit_steps", 24);
    /// Steps of the golden section search between grid points.
    int fit_refinements = add("fit_refinements", 20);
    /// Growth of the addition to the diagonal of a singular system.
    double addition_growth = add("addition_growth", 100);
    /// Spacing of the first thinning, in spacings of the data.
    double first_spacing = add("first_spacing", 2);
    /// Thinning ends with this number of data or fewer, in neighbours of an estimate.
    std::size_t least_level = add("least_level", 4);
    /// Samples of a border per mesh size, for distances from it.
    double border_samples = add("border_samples", 2);
    /// Samples of a border edge.
    double most_border_samples = add("most_border_samples", 1000);
    /// First growth that is tried if a filling has too many vertices: the spacing of vertices
    /// grows to at most their distance from the border divided by the growth, which is halved
    /// until they are few enough.
    double first_growth = add("first_growth", 64);
    /// Data from which the variogram is estimated, well spread. Larger: slower, n^3 for each
    /// variogram that is tried.
    std::size_t most_fitted = add("most_fitted", 96);
    /// Of these data, those whose nearest neighbour is taken as well.
    std::size_t close_pairs = add("close_pairs", 48);
    /// Least range that is tried, in median distances of such neighbours.
    double gaps_per_range = add("gaps_per_range", 3);
    /// By how much the log-likelihood of a gaussian model, which is infinitely smooth, must exceed
    /// that of others.
    double worth_gaussian = add("worth_gaussian", 8);
    /// By how much the log-likelihood with anisotropy must exceed that without.
    double worth_turned = add("worth_turned", 6);
    /// Factors of the most likely range without anisotropy that are tried with it. Where grooves are
    /// taken for noise that range says nothing of them.
    std::array<double, 3> turned_ranges =
        add<double>({"turned_ranges_1", "turned_ranges_2", "turned_ranges_3"}, {1, 0.3, 0.1});
    /// Least range that is tried, in extents of the data.
    double least_range = add("least_range", 0.03);
    /// Largest range that is tried, in extents of the data.
    double most_range = add("most_range", 8);
    /// Largest range of a gaussian model, likewise: its sill would grow beyond what doubles can
    /// subtract.
    double most_smooth_range = add("most_smooth_range", 2);
    /// Ranges that are tried first, at equal ratios.
    int range_steps = add("range_steps", 5);
    /// How often the ratio of ranges is halved about the most likely one.
    int range_halvings = add("range_halvings", 3);
    /// Least nugget that is tried, in mean variances of contrasts.
    double least_noise = add("least_noise", 1e-10);
    /// Largest nugget that is tried, in mean variances of contrasts.
    double most_noise = add("most_noise", 100);
    /// Nuggets that are tried first, at equal ratios.
    int noise_steps = add("noise_steps", 48);
    /// How often the ratio of nuggets is halved about the most likely one.
    int noise_halvings = add("noise_halvings", 5);
    /// Least factor of a sill whose data may as well be noise.
    double least_share = add("least_share", 1e-6);
    /// Ratio of diagonal entries below which a trend is not determined by the data.
    double trend_singular = add("trend_singular", 1e-10);
    /// Distance of the data from the trend, in largest heights, below which it is rounding.
    double trend_rounding = add("trend_rounding", 1e-13);
    /// Data of the validation by blocks, well spread.
    std::size_t most_block_data = add("most_block_data", 300);
    /// Blocks of the expected error that the model itself counts for in the calibration.
    double block_prior = add("block_prior", 2);
    /// The calibration weighs all blocks together as at most this number of independent ones, since
    /// they overlap.
    double most_counted = add("most_counted", 12);
    /// Share of the nugget that is noise, by the weights of the data, above which all of it counts
    /// as such.
    double least_noise_share = add("least_noise_share", 0.5);
    /// Blocks from which nugget and sill may shrink.
    std::size_t least_shrinking = add("least_shrinking", 8);
    /// The largest squared ratio of blocks must be less for that; the least factor.
    double shrinking = add("shrinking", 0.25);
    /// Share of the distance between estimates with and without anisotropy that is expected as an
    /// error, if both miss blocks by as much.
    double doubt = add("doubt", 0.5);
    /// Share of the error of blocks below which a trend of degree 2 is taken.
    double worth_degree = add("worth_degree", 0.1);
    /// A block with more than this share of the data is not left out.
    double most_of_all = add("most_of_all", 0.7);
    /// Data that determine standard deviations together where all of them would take too long.
    std::size_t most_deviations = add("most_deviations", 600);
    /// Data that determine the expected errors of another method's heights.
    std::size_t most_error_data = add("most_error_data", 300);
    /// The same if the data are noisy.
    std::size_t most_noisy_data = add("most_noisy_data", 800);
    /// Ratio of nugget and sill above which data are noisy. Exact data have the least nugget that is
    /// tried.
    double noisy = add("noisy", 1e-8);
    /// Multiplications between looks at the stop token.
    double operations_per_check = add("operations_per_check", 5e8);
    /// Multiplications above which all of them would take too long.
    double most_operations = add("most_operations", 2e10);
};

inline constexpr KrigingConstants constants{};

} // namespace terrane::kriging::detail
