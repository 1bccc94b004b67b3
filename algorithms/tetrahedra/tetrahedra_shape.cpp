// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/tetrahedra/bad_tetrahedra.hpp>
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

std::size_t quality_bin(double quality) {
    const double scaled = std::max(quality, 0.0) * quality_bins;
    return std::min(static_cast<std::size_t>(scaled), quality_bins - 1);
}

/// Counts a tetrahedron among the bad ones, if it is one.
void add_bad(const BadCauses& causes, const std::array<std::uint32_t, 4>& t,
             const std::array<Point3, 4>& corners, const std::array<double, 6>& angles,
             std::array<BadTetrahedra, bad_causes>& bad) {
    const double least = *std::min_element(angles.begin(), angles.end());
    if (least >= bad_angle) return;
    BadTetrahedra& of_cause = bad[static_cast<std::size_t>(causes.of(t, corners, angles))];
    if (of_cause.count++ > 0 && least >= of_cause.least) return;
    of_cause.least = least;
    const auto mean = [&](double Point3::*x) {
        return corners[0].*x / 4 + corners[1].*x / 4 + corners[2].*x / 4 + corners[3].*x / 4;
    };
    of_cause.place = {mean(&Point3::x), mean(&Point3::y), mean(&Point3::z)};
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

double inverse_condition(const std::array<Point3, 4>& input) {
    const std::array<Point3, 4> corners = of_unit_size(input);
    const Vector3 a = from_to(corners[0], corners[1]), b = from_to(corners[0], corners[2]),
                  c = from_to(corners[0], corners[3]);
    // The columns of J: edges of the regular tetrahedron, (1, 0, 0), (1/2, sqrt(3)/2, 0) and
    // (1/2, sqrt(3)/6, sqrt(2/3)), become a, b and c.
    constexpr double root = std::numbers::sqrt3, low = 1 / root, high = root / std::numbers::sqrt2;
    const auto column = [](double r, const Vector3& u, double s, const Vector3& v, double t,
                           const Vector3& w) {
        return Vector3{r * u.x + s * v.x + t * w.x, r * u.y + s * v.y + t * w.y,
                       r * u.z + s * v.z + t * w.z};
    };
    const Vector3 y = column(2 * low, b, -low, a, 0, c);
    const Vector3 z = column(high, c, -high / 3, a, -high / 3, b);
    const auto norm = [](const Vector3& u, const Vector3& v, const Vector3& w) {
        return std::sqrt(dot(u, u) + dot(v, v) + dot(w, w));
    };
    const double volume = dot(cross(a, y), z);
    const double product = norm(a, y, z) * norm(cross(y, z), cross(z, a), cross(a, y));
    return product > 0 ? 3 * volume / product : 0;
}

double mean_ratio(const std::array<Point3, 4>& input) {
    const std::array<Point3, 4> corners = of_unit_size(input);
    const Vector3 a = from_to(corners[0], corners[1]), b = from_to(corners[0], corners[2]),
                  c = from_to(corners[0], corners[3]);
    double squares = 0;
    for (const auto& edge : edges) {
        const Vector3 e = from_to(corners[edge[0]], corners[edge[1]]);
        squares += dot(e, e);
    }
    const double root = std::cbrt(std::fabs(dot(cross(a, b), c)) / 2); // of three volumes
    return squares > 0 ? 12 * root * root / squares : 0;
}

TetrahedraShape shape_of(const TetrahedralMesh& mesh) {
    const StandardArithmetic guard;
    TetrahedraShape shape;
    Gather dihedral, radius_edge, sicn, ratio_of_means;
    shape.count = mesh.tetrahedra.size();
    const BadCauses causes(mesh);
    for (const auto& [a, b, c, d] : mesh.tetrahedra) {
        const auto& v = mesh.vertices;
        const std::array<Point3, 4> corners{v[a], v[b], v[c], v[d]};
        const auto angles = dihedral_angles(corners);
        for (const double angle : angles) {
            dihedral.add(angle);
            ++shape.dihedral_histogram[dihedral_bin(angle)];
        }
        add_bad(causes, {a, b, c, d}, corners, angles, shape.bad);
        sicn.add(inverse_condition(corners));
        ++shape.sicn_histogram[quality_bin(inverse_condition(corners))];
        ratio_of_means.add(mean_ratio(corners));
        ++shape.mean_ratio_histogram[quality_bin(mean_ratio(corners))];
        const double ratio = radius_edge_ratio(corners);
        radius_edge.add(ratio);
        ++shape.radius_edge_histogram[radius_edge_bin(ratio)];
    }
    shape.dihedral = dihedral.spread();
    shape.radius_edge = radius_edge.spread();
    shape.sicn = sicn.spread();
    shape.mean_ratio = ratio_of_means.spread();
    return shape;
}

} // namespace terrane
