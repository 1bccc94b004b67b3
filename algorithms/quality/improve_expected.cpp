// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/improve.hpp>

#include <cmath>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/quality/detail/reference_surface.hpp>

namespace terrane {

double least_deviation(double largest_coordinate) {
    const StandardArithmetic guard;
    using quality::detail::ReferenceSurface;
    return quality::detail::constants.least_bound *
           ReferenceSurface::rounding_at(largest_coordinate);
}

double expected_triangles(std::span<const Surface> surfaces, const ImproveOptions& options) {
    const StandardArithmetic guard;
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

} // namespace terrane
