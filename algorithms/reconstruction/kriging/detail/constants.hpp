// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of kriging that decide the model and the filling.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <terrane/algorithms/core/named_constant.hpp>

namespace terrane::kriging::detail {

/// Thresholds named worth_... are the share of the best validation error so far below which another
/// model is preferred: those models can be far off in holes wider than the patches that are left
/// out. Smaller: they are chosen less often.
struct KrigingConstants {
    /// For a model without nugget.
    double worth_no_nugget = 0.8;
    /// For a trend of degree 2.
    double worth_degree_2 = 0.8;
    /// For a gaussian model, which is infinitely smooth.
    double worth_gaussian = 0.5;
    /// For a gaussian model if most of the error is noise.
    double worth_noisy_gaussian = 0.9;
    /// Share of the mean square error above which noise is most of it.
    double mostly_noise = 0.3;
    /// For anisotropy in a fit, in misfits of the isotropic model.
    double worth_anisotropy = 0.8;
    /// With fewer data, validation errors do not decide.
    std::size_t least_data = 20;
    /// Data that take part in validation by patches. Larger: slower choice, n^3 each time.
    std::size_t most_block_data = 150;
    /// Patches that are left out in turn.
    std::size_t blocks = 5;
    /// A patch contains one in so many data. Smaller: wider patches.
    std::size_t block_part = 10;
    /// Classes of the experimental variogram by distance.
    std::size_t distance_classes = 15;
    /// Classes of the experimental variogram by direction, 15 degrees each.
    std::size_t direction_classes = 12;
    /// Points all pairs of which enter the experimental variogram.
    std::size_t most_variogram_points = 1500;
    /// First addition to the diagonal of a singular system, in sills.
    double least_addition = 1e-12;
    /// Largest addition to the diagonal, in sills. Larger: data are smoothed.
    double most_addition = 1e-6;
    /// Cost above which standard deviations are computed from neighbours alone.
    double most_operations = 4e9;
    /// Spacing of thinned data per distance from the nearest datum. Larger: farther data
    /// enter an estimate.
    double spacing_per_distance = 0.25;
    /// Data up to which each estimate uses all of them. Larger: smoother, n^3.
    std::size_t most_at_once = 700;
    /// Data of an estimate if there are more.
    std::size_t neighbours = 40;
    /// Interpolated vertices of a filling; above, the mesh becomes coarser.
    std::size_t most_places = 20'000;
    /// Data left out one at a time for the report.
    std::size_t most_validated = 400;
    /// Edges at which flatness is judged.
    std::size_t most_sags = 256;
    /// Least distance of interpolated vertices from a border, in mesh sizes.
    double border_distance = 0.7;
    /// Points at which noise is estimated.
    std::size_t most_noise_points = 2000;
    /// Ratios of the ranges across and along that a fit of anisotropy tries.
    std::array<double, 6> anisotropy_ratios{0.8, 0.65, 0.5, 0.4, 0.3, 0.2};
    /// Angle between the directions that a fit of anisotropy tries, in degrees.
    double anisotropy_step = 15;
    /// Least range that is fitted: the longest distance of the experimental variogram divided
    /// by this.
    double range_part = 30;
    /// Largest range that is fitted, in longest distances of the experimental variogram.
    double range_factor = 4;
    /// Least exponent of a power model.
    double least_power = 0.1;
    /// Largest exponent of a power model; 2 would be no variogram.
    double most_power = 1.98;
    /// Steps of the grid on which a range or exponent is searched.
    int fit_steps = 24;
    /// Steps of the golden section search between grid points.
    int fit_refinements = 20;
    /// Ranges of a gaussian model without nugget that are validated, each twice the one before.
    int stretches = 3;
    /// Longest distance of the experimental variogram, in diagonals of the data.
    double variogram_share = 0.5;
    /// Growth of the addition to the diagonal of a singular system.
    double addition_growth = 100;
    /// Spacing of the first thinning, in spacings of the data.
    double first_spacing = 2;
    /// Thinning ends with this number of data or fewer, in neighbours of an estimate.
    std::size_t least_level = 4;
    /// Neighbours without which a point takes no part in the estimate of noise.
    std::size_t noise_neighbours = 10;
    /// Reciprocal condition below which the fit of noise at a point counts as singular.
    double noise_singular = 1e-10;
    /// Samples of a border per mesh size, for distances from it.
    double border_samples = 2;
    /// Samples of a border edge.
    double most_border_samples = 1000;
    /// First growth that is tried if a filling has too many vertices: the spacing of vertices
    /// grows to at most their distance from the border divided by the growth, which is halved
    /// until they are few enough.
    double first_growth = 64;
};

inline constexpr KrigingConstants constants;

/// Lists all constants by name, in the order of their declaration.
inline std::vector<NamedConstant> named_constants() {
    return {
        {"worth_no_nugget", constants.worth_no_nugget},
        {"worth_degree_2", constants.worth_degree_2},
        {"worth_gaussian", constants.worth_gaussian},
        {"worth_noisy_gaussian", constants.worth_noisy_gaussian},
        {"mostly_noise", constants.mostly_noise},
        {"worth_anisotropy", constants.worth_anisotropy},
        {"least_data", static_cast<double>(constants.least_data)},
        {"most_block_data", static_cast<double>(constants.most_block_data)},
        {"blocks", static_cast<double>(constants.blocks)},
        {"block_part", static_cast<double>(constants.block_part)},
        {"distance_classes", static_cast<double>(constants.distance_classes)},
        {"direction_classes", static_cast<double>(constants.direction_classes)},
        {"most_variogram_points", static_cast<double>(constants.most_variogram_points)},
        {"least_addition", constants.least_addition},
        {"most_addition", constants.most_addition},
        {"most_operations", constants.most_operations},
        {"spacing_per_distance", constants.spacing_per_distance},
        {"most_at_once", static_cast<double>(constants.most_at_once)},
        {"neighbours", static_cast<double>(constants.neighbours)},
        {"most_places", static_cast<double>(constants.most_places)},
        {"most_validated", static_cast<double>(constants.most_validated)},
        {"most_sags", static_cast<double>(constants.most_sags)},
        {"border_distance", constants.border_distance},
        {"most_noise_points", static_cast<double>(constants.most_noise_points)},
        {"anisotropy_ratios_1", constants.anisotropy_ratios[0]},
        {"anisotropy_ratios_2", constants.anisotropy_ratios[1]},
        {"anisotropy_ratios_3", constants.anisotropy_ratios[2]},
        {"anisotropy_ratios_4", constants.anisotropy_ratios[3]},
        {"anisotropy_ratios_5", constants.anisotropy_ratios[4]},
        {"anisotropy_ratios_6", constants.anisotropy_ratios[5]},
        {"anisotropy_step", constants.anisotropy_step},
        {"range_part", constants.range_part},
        {"range_factor", constants.range_factor},
        {"least_power", constants.least_power},
        {"most_power", constants.most_power},
        {"fit_steps", static_cast<double>(constants.fit_steps)},
        {"fit_refinements", static_cast<double>(constants.fit_refinements)},
        {"stretches", static_cast<double>(constants.stretches)},
        {"variogram_share", constants.variogram_share},
        {"addition_growth", constants.addition_growth},
        {"first_spacing", constants.first_spacing},
        {"least_level", static_cast<double>(constants.least_level)},
        {"noise_neighbours", static_cast<double>(constants.noise_neighbours)},
        {"noise_singular", constants.noise_singular},
        {"border_samples", constants.border_samples},
        {"most_border_samples", constants.most_border_samples},
        {"first_growth", constants.first_growth},
    };
}

} // namespace terrane::kriging::detail
