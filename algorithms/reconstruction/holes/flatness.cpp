// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/holes/flatness.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <terrane/algorithms/mesh/edges.hpp>

namespace terrane::detail {

using holes::detail::constants;

double root_mean_square(std::span<const double> values) {
    const double squares = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
    return std::sqrt(squares / static_cast<double>(values.size()));
}

std::vector<Edge> some_inner_edges(std::span<const Triangle> triangles, std::size_t vertices,
                                   std::size_t most) {
    std::vector<Edge> all;
    group_edges(triangles, vertices)
        .for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            if (sides.size() == 2) all.push_back({low, high});
        });
    std::vector<Edge> some(std::min(most, all.size()));
    for (std::size_t k = 0; k < some.size(); ++k) some[k] = all[k * all.size() / some.size()];
    return some;
}

bool flatness_outweighs(std::span<const double> sags, std::span<const double> expected,
                        double size) {
    if (sags.empty()) return false;
    const double sag = root_mean_square(sags), allowed = root_mean_square(expected);
    return std::isfinite(allowed) && sag > std::max(allowed, constants.rounding * size);
}

} // namespace terrane::detail
