// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The distance up to which gaps between two surfaces are closed.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>

#include <terrane/algorithms/sealing/sealing.hpp>

namespace terrane::sealing::detail {

/// The general distance and the rules that are exceptions from it, see SealOptions.
class SealDistances {
public:
    explicit SealDistances(double general, std::span<const SealRule> rules = {});

    /// Returns the distance for two surfaces, or for parts of one. It is the same in either order.
    [[nodiscard]] double between(std::uint32_t surface, std::uint32_t other) const;
    [[nodiscard]] bool has_exceptions() const { return !of_surface_.empty() || !of_pair_.empty(); }
    /// Returns the largest distance that some pair of surfaces can have.
    [[nodiscard]] double largest() const { return largest_; }

private:
    double general_, largest_;
    std::map<std::uint32_t, double> of_surface_;
    std::map<std::array<std::uint32_t, 2>, double> of_pair_;
};

} // namespace terrane::sealing::detail
