// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/project/detail/refinement.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/tetrahedra/bad_tetrahedra.hpp>

namespace terrane::project::detail {
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
    std::array<Point3, 4> corners;
    Point3 centre;
    for (std::size_t k = 0; k < 4; ++k) {
        const Point3& p = corners[k] = mesh.vertices[mesh.tetrahedra[number][k]];
        centre = {centre.x + p.x / 4, centre.y + p.y / 4, centre.z + p.z / 4};
    }
    return {centre, std::max(smallest, wanted_length(corners))};
}

} // namespace

BadPlaces bad_places(const TetrahedralMesh& mesh, double smallest) {
    BadPlaces found;
    for (const BadTetrahedron& bad : bad_tetrahedra(mesh)) {
        ++found.bad;
        if (bad.is_at_input_angle) continue;
        ++found.apart;
        found.sizes.push_back(size_at(mesh, bad.number, smallest));
    }
    for (const std::uint32_t number : misshapen_tetrahedra(mesh, misshapen_ratio)) {
        ++found.misshapen;
        if (found.apart == 0) found.sizes.push_back(size_at(mesh, number, smallest));
    }
    return found;
}

} // namespace terrane::project::detail
