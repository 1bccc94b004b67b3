// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/holes/expected_points.hpp>

#include <cmath>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/reconstruction/holes/detail/constants.hpp>

namespace terrane {

double expected_points(const BorderLoop& loop, double edge_length) {
    const double of_triangle = std::sqrt(3.0) / 4 * edge_length * edge_length;
    return loop.area / of_triangle / 2 + loop.length / edge_length; // two triangles per point
}

Status check_edge_length(const BorderLoop& loop, double edge_length) {
    constexpr double most = holes::detail::constants.most_points;
    if (!(edge_length > 0)) return Done{};
    const double count = expected_points(loop, edge_length);
    if (count <= most) return Done{};
    return Error{ErrorCode::bad_option,
                 fmt::format("edges of {} ask for about {} points in a hole, more than {}",
                             figure(edge_length), figure(count, 3), figure(most)),
                 "mesh_size"};
}

} // namespace terrane
