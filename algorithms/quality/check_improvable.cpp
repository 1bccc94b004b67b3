// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/improve.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/quality/detail/reference_surface.hpp>

namespace terrane {
namespace {

/// Estimates the number of triangles from areas and wanted lengths alone: without curvature, and without
/// what intersections add.
double expected_triangles(std::span<const Surface> surfaces, const ImproveOptions& options) {
    double sum = 0;
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const bool is_exception =
            s < options.edge_length_of.size() && options.edge_length_of[s] > 0;
        const double wanted = is_exception ? options.edge_length_of[s] : options.edge_length;
        if (!(wanted > 0)) { // as many as there are
            sum += static_cast<double>(surfaces[s].triangles.size());
            continue;
        }
        double area = 0;
        for (const Triangle& t : surfaces[s].triangles) {
            const auto& p = surfaces[s].vertices;
            area += length(cross(minus(p[t[1]], p[t[0]]), minus(p[t[2]], p[t[0]]))) / 2;
        }
        sum += area / (std::sqrt(3.0) / 4 * wanted * wanted);
    }
    return sum;
}

double largest_coordinate(std::span<const Surface> surfaces) {
    double largest = 0;
    for (const Surface& s : surfaces)
        for (const Point3& p : s.vertices)
            largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    return largest;
}

} // namespace

Status check_improvable(std::span<const Surface> surfaces, const ImproveOptions& options) {
    const StandardArithmetic guard;
    const double least =
        quality::detail::constants.least_bound *
        quality::detail::ReferenceSurface::rounding_at(largest_coordinate(surfaces));
    if (options.max_deviation > 0 && options.max_deviation < least)
        return Error{
            ErrorCode::bad_option,
            fmt::format("is too small for coordinates of this size; the least is {}", least),
            "max_deviation"};
    const double count = expected_triangles(surfaces, options);
    if (count > options.max_triangles)
        return Error{ErrorCode::bad_option,
                     fmt::format("about {} triangles are to be expected, more than the limit "
                                 "of {}; ask for longer edges or raise the limit",
                                 figure(count, 3), figure(options.max_triangles)),
                     "max_triangles"};
    return Done{};
}

} // namespace terrane
