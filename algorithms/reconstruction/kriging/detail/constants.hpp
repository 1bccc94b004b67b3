// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of kriging that decide the model and the filling.
#pragma once

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
    };
}

} // namespace terrane::kriging::detail
