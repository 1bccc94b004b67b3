// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Surfaces that are known everywhere, with a hole in each.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace fill_bench {

struct Model {
    std::string name;
    bool smooth = true;                                 ///< has neither noise nor throw
    bool graph = true;                                  ///< is a graph z = f(x, y)
    double share = 0;                                   ///< of the area, in the hole
    std::function<double(double x, double y)> height{}; ///< exact height of a graph
    terrane::Surface holed;
    terrane::Surface whole; ///< the truth, four times as fine
};

/// Returns 30 surfaces of 60 x 60 cells (planes, waves, domes, noise, folds, throws) with holes of
/// 1 to 20 % of the area.
std::vector<Model> models();

/// Returns 42 folds, from a steep one to limbs that almost touch, with holes of the same sizes.
std::vector<Model> fold_models();

/// Area-weighted root mean square and maximum of the distance between points of the triangles from
/// `first` on and the true surface; and the same measures of the added vertices alone, which do not
/// include that triangles are flat.
struct Misfit {
    double rms = 0, largest = 0;
    double vertex_rms = 0, vertex_largest = 0;
};
Misfit misfit(const Model& model, const terrane::Surface& filled, std::size_t first);

} // namespace fill_bench
