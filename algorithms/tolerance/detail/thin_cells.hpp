// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/tolerance/tolerance.hpp>

namespace terrane::tolerance::detail {

/// A surface that runs along a triangle.
struct Owner {
    std::uint32_t surface = 0;
    bool is_reversed = false; ///< whether its triangle has the other orientation

    friend bool operator==(const Owner&, const Owner&) = default;
};

/// The surfaces that run along each triangle of an arrangement; none: the triangle goes.
struct Ownership {
    std::vector<std::vector<Owner>> owners; ///< per triangle, by surface
    std::size_t cells = 0;                  ///< thin cells that were joined
    double volume = 0;                      ///< of these
    std::vector<ThinCell> left;             ///< that were not, from the largest volume on
};

/// Joins the thin cells of an arrangement whose last surface consists of fences. No surface moves by
/// more than `bound`. Errors: those of find_volumes().
Result<Ownership> join_thin_cells(const Arrangement& arrangement, double bound,
                                  const Run& run = {});

} // namespace terrane::tolerance::detail
