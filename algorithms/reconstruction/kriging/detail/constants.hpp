// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of kriging that decide the models, their weights, and the mesh of a filling.
#pragma once

#include <cstddef>

#include <terrane/algorithms/core/constants.hpp>

namespace terrane::kriging::detail {

struct KrigingConstants : Constants {
    /// No further ring is added to this number of near data.
    std::size_t enough_data = add("enough_data", 4000);
    /// With fewer data, no expected error can be told.
    std::size_t least_data = add("least_data", 20);
    /// Data of an estimate, for which rings are added. Larger: nearer to smooth surfaces, and to rough
    /// data of a long border, n^3.
    std::size_t most_at_once = add("most_at_once", 800);
    /// Misfit of a model to all data above which it estimates from those near the hole alone. Larger:
    /// farther data help smooth models, but may be of another kind.
    double most_misfit = add("most_misfit", 1.5);
    /// Well-spread data near the hole that stand for all: of blocks, and of standard deviations where
    /// all would take more multiplications than these do at `most_places` places. Larger: slower, n^3
    /// for each model.
    std::size_t few_data = add("few_data", 250);
    /// Well-spread data near the hole from which likelihoods are computed; half of them with their
    /// nearest neighbour, and a quarter as many farther away. Larger: slower, n^3 for each model.
    std::size_t most_fitted = add("most_fitted", 112);
    /// Least range, in median distances of neighbours: a surface that is rougher than that can't be
    /// told from noise.
    double gaps_per_range = add("gaps_per_range", 3);
    /// Range across in ranges along of the models with anisotropy.
    double turned_ratio = add("turned_ratio", 0.4);
    /// Logarithms of likelihoods are divided by this: no surface is a draw of any of the models.
    double temper = add("temper", 2);
    /// Weight below which a model has no say.
    double least_weight = add("least_weight", 0.01);
    /// Blocks that are left out in turn. Since they overlap, half as many count as independent.
    std::size_t blocks = add("blocks", 16);
    /// Width of the widest rim of data round the hole that is left out, in radii of the hole.
    double rim = add("rim", 0.5);
    /// Blocks that the models' own expected errors count for.
    double block_prior = add("block_prior", 2);
    /// Interpolated vertices of a filling; above, the mesh becomes coarser.
    std::size_t most_places = add("most_places", 20'000);
    /// Edges at which flatness is judged.
    std::size_t most_sags = add("most_sags", 64);
    /// Least distance of interpolated vertices from a border, and largest one of its samples, from
    /// which it is measured, in mesh sizes.
    double border_distance = add("border_distance", 0.7);
};

inline constexpr KrigingConstants constants{};

} // namespace terrane::kriging::detail
