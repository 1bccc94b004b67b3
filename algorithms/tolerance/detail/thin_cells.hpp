// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/tolerance/detail/owners.hpp>
#include <terrane/algorithms/tolerance/tolerance.hpp>

namespace terrane::tolerance::detail {

/// The surfaces that run along each triangle of an arrangement; none: the triangle goes.
struct Ownership {
    Owners owners;
    std::size_t cells = 0;      ///< thin cells that were joined
    double volume = 0;          ///< of these
    std::vector<ThinCell> left; ///< that were not, from the largest volume on
};

/// Joins the thin cells of an arrangement whose last surface consists of fences. No surface moves by
/// more than about `bound`. `closed`: per surface whether it is; where such a surface covers itself an
/// even number of times, it is not there, so that it stays closed. Errors: those of find_volumes().
Result<Ownership> join_thin_cells(const Arrangement& arrangement, const std::vector<bool>& closed,
                                  double bound, const Run& run = {});

} // namespace terrane::tolerance::detail
