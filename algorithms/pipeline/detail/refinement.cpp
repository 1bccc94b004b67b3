// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/pipeline/detail/refinement.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/tetrahedra/bad_tetrahedra.hpp>

namespace terrane::pipeline::detail {
namespace {

/// Edges that a tetrahedron between two surfaces may have, in multiples of its height: good ones
/// have about one and a half, and the corners of neighbours can be up to one edge away.
constexpr double edges_per_height = 2.5;
/// Bounds of the new length, as shares of the longest edge. A round that asks for less would make
/// more triangles than are needed, one that asks for more changes too little.
constexpr double least_share = 0.25, largest_share = 0.6;

/// Returns the length that edges near a tetrahedron are to have.
double wanted_length(const std::array<Point3, 4>& p) {
    double longest = 0, largest_face = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const Point3 &a = p[(k + 1) % 4], &b = p[(k + 2) % 4], &c = p[(k + 3) % 4];
        longest = std::max({longest, length(minus(b, a)), length(minus(p[k], a))});
        largest_face = std::max(largest_face, length(cross(minus(b, a), minus(c, a))));
    }
    const double volume =
        std::fabs(dot(minus(p[1], p[0]), cross(minus(p[2], p[0]), minus(p[3], p[0]))));
    const double height = largest_face > 0 ? volume / largest_face : 0; // the least of the four
    return std::clamp(edges_per_height * height, least_share * longest, largest_share * longest);
}

/// Returns the length that is wanted at the centre of a tetrahedron.
LocalSize size_at(const TetrahedralMesh& mesh, std::uint32_t number, double smallest) {
    const auto corners = corners_of(mesh, number);
    Point3 centre;
    for (const Point3& p : corners)
        centre = {centre.x + p.x / 4, centre.y + p.y / 4, centre.z + p.z / 4};
    return {centre, std::max(smallest, wanted_length(corners))};
}

/// Returns the worse of these tetrahedra: those in the lower half of the range of mean ratios.
std::vector<std::uint32_t> worse_of(const TetrahedralMesh& mesh,
                                    std::span<const std::uint32_t> misshapen) {
    double least = misshapen_ratio;
    std::vector<double> ratios;
    for (const std::uint32_t number : misshapen)
        least = std::min(least, ratios.emplace_back(mean_ratio(corners_of(mesh, number))));
    std::vector<std::uint32_t> worse;
    for (std::size_t i = 0; i < misshapen.size(); ++i)
        if (ratios[i] <= (least + misshapen_ratio) / 2) worse.push_back(misshapen[i]);
    return worse;
}

} // namespace

std::vector<LocalSize> scaled(std::vector<LocalSize> sizes, double share, double smallest) {
    for (LocalSize& size : sizes) size.length = std::max(smallest, share * size.length);
    return sizes;
}

BadPlaces bad_places(const TetrahedralMesh& mesh, double smallest) {
    BadPlaces found;
    for (const BadTetrahedron& bad : bad_tetrahedra(mesh)) {
        ++found.bad;
        if (bad.is_at_input_angle) continue;
        ++found.apart;
        found.sizes.push_back(size_at(mesh, bad.number, smallest));
    }
    const auto misshapen = misshapen_tetrahedra(mesh, misshapen_ratio);
    found.misshapen = misshapen.size();
    if (found.apart == 0)
        for (const std::uint32_t number : worse_of(mesh, misshapen))
            found.sizes.push_back(size_at(mesh, number, smallest));
    return found;
}

} // namespace terrane::pipeline::detail
