// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/tetrahedra_shape.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <terrane/kernel/polynomials.hpp>

namespace terrane {
namespace {

using Vector3 = polynomial::Vector<double>;

Vector3 from_to(const Point3& a, const Point3& b) {
    return {b.x - a.x, b.y - a.y, b.z - a.z};
}

double length(const Vector3& v) {
    return std::hypot(v.x, v.y, v.z);
}

/// The ends of each edge, then the other two corners.
constexpr std::array<std::array<unsigned, 4>, 6> edges{
    {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};

/// Collects a ShapeSpread.
class Gather {
public:
    void add(double value) {
        least_ = std::min(least_, value);
        largest_ = std::max(largest_, value);
        sum_ += value;
        ++count_;
    }
    [[nodiscard]] ShapeSpread spread() const {
        if (count_ == 0) return {};
        return {least_, sum_ / static_cast<double>(count_), largest_};
    }

private:
    double least_ = std::numeric_limits<double>::infinity(), largest_ = 0, sum_ = 0;
    std::size_t count_ = 0;
};

/// Scales a tetrahedron by a power of two to a size of about 1, so that no product overflows or
/// underflows.
std::array<Point3, 4> of_unit_size(std::array<Point3, 4> corners) {
    double size = 0;
    for (const Point3& corner : corners) {
        const Vector3 v = from_to(corners[0], corner);
        size = std::max({size, std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    }
    if (size == 0) return corners;
    const int shift = -std::ilogb(size);
    for (Point3& p : corners)
        p = {std::ldexp(p.x, shift), std::ldexp(p.y, shift), std::ldexp(p.z, shift)};
    return corners;
}

std::size_t dihedral_bin(double degrees) {
    const auto bin = static_cast<std::size_t>(degrees / (180.0 / dihedral_bins));
    return std::min(bin, dihedral_bins - 1);
}

std::size_t radius_edge_bin(double ratio) {
    const auto* const at =
        std::upper_bound(radius_edge_bounds.begin(), radius_edge_bounds.end(), ratio);
    return static_cast<std::size_t>(at - radius_edge_bounds.begin());
}

} // namespace

std::array<double, 6> dihedral_angles(const std::array<Point3, 4>& input) {
    const std::array<Point3, 4> corners = of_unit_size(input);
    std::array<double, 6> angles{};
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto& [a, b, c, d] = edges[i];
        const Vector3 edge = from_to(corners[a], corners[b]);
        const Vector3 u = cross(edge, from_to(corners[a], corners[c]));
        const Vector3 w = cross(edge, from_to(corners[a], corners[d]));
        // The arc tangent is accurate near 0 and 180 degrees, the angles of slivers.
        angles[i] = std::atan2(length(cross(u, w)), dot(u, w)) * 180 / std::numbers::pi;
    }
    return angles;
}

double radius_edge_ratio(const std::array<Point3, 4>& input) {
    const std::array<Point3, 4> corners = of_unit_size(input);
    double shortest = std::numeric_limits<double>::infinity();
    for (const auto& edge : edges)
        shortest = std::min(shortest, length(from_to(corners[edge[0]], corners[edge[1]])));
    const Vector3 a = from_to(corners[0], corners[1]), b = from_to(corners[0], corners[2]),
                  c = from_to(corners[0], corners[3]);
    const Vector3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
    const Vector3 centre{aa * bc.x + bb * ca.x + cc * ab.x, aa * bc.y + bb * ca.y + cc * ab.y,
                         aa * bc.z + bb * ca.z + cc * ab.z};
    const double six_volumes = std::fabs(dot(a, bc));
    if (six_volumes == 0 || shortest == 0) return std::numeric_limits<double>::infinity();
    return length(centre) / (2 * six_volumes) / shortest;
}

TetrahedraShape shape_of(const TetrahedralMesh& mesh) {
    TetrahedraShape shape;
    Gather dihedral, radius_edge;
    for (const auto& [a, b, c, d] : mesh.tetrahedra) {
        const auto& v = mesh.vertices;
        const std::array<Point3, 4> corners{v[a], v[b], v[c], v[d]};
        for (const double angle : dihedral_angles(corners)) {
            dihedral.add(angle);
            ++shape.dihedral_histogram[dihedral_bin(angle)];
        }
        const double ratio = radius_edge_ratio(corners);
        radius_edge.add(ratio);
        ++shape.radius_edge_histogram[radius_edge_bin(ratio)];
    }
    shape.dihedral = dihedral.spread();
    shape.radius_edge = radius_edge.spread();
    return shape;
}

} // namespace terrane
