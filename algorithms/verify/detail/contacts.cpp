// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/contacts.hpp>

#include <algorithm>
#include <optional>
#include <utility>

#include <terrane/algorithms/verify/detail/fans.hpp>

namespace terrane::verifier {

namespace {

using Corners = std::array<const Vector4*, 3>;
using Heights = std::array<mpz_class, 3>;

/// Two triangles with their corners ordered so that the shared ones come first, in the same order.
struct Pair {
    std::array<Corners, 2> corners;
    std::size_t shared = 0;
};

Pair make_pair_of(const ExactMesh& mesh, Triangle a, Triangle b) {
    Pair pair;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto same =
            std::find(b.begin() + static_cast<std::ptrdiff_t>(pair.shared), b.end(), a[i]);
        if (same == b.end()) continue;
        std::swap(*same, b[pair.shared]);
        std::swap(a[i], a[pair.shared]);
        ++pair.shared;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        pair.corners[0][i] = &mesh.points[a[i]];
        pair.corners[1][i] = &mesh.points[b[i]];
    }
    return pair;
}

/// Returns the heights of the corners of a triangle over a plane that contains the shared corners.
Heights heights_over(const Vector4& plane, const Corners& corners, std::size_t shared) {
    Heights heights;
    for (std::size_t i = shared; i < 3; ++i) heights[i] = dot(plane, *corners[i]);
    return heights;
}

/// Tells whether all corners that are not shared lie strictly on one side; then the triangle meets
/// the plane only in the convex hull of the shared corners.
bool on_one_side(const Heights& heights, std::size_t shared) {
    const int side = sgn(heights[2]);
    if (side == 0) return false;
    return std::all_of(heights.begin() + static_cast<std::ptrdiff_t>(shared), heights.end(),
                       [side](const mpz_class& height) { return sgn(height) == side; });
}

// --- Two triangles in one plane, judged in a projection ---------------------------------------

int side_of(const Vector4& from, const Vector4& to, const Vector4& point, std::size_t axis) {
    return sgn(turn(from, to, point, axis));
}

/// Tells whether the line of some edge of the first triangle separates the two. Convex polygons are
/// disjoint iff the line of an edge of one of them separates them.
bool some_edge_separates(const Corners& triangle, const Corners& other, std::size_t axis) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (std::all_of(other.begin(), other.end(), [&](const Vector4* corner) {
                return side_of(*triangle[i], *triangle[(i + 1) % 3], *corner, axis) < 0;
            })) {
            return true;
        }
    }
    return false;
}

/// Tells whether the cone at corner 0 of a counterclockwise triangle contains another corner of
/// `other`.
bool cone_holds_some(const Corners& triangle, const Corners& other, std::size_t axis) {
    const auto in_cone = [&](const Vector4& point) {
        return side_of(*triangle[0], *triangle[1], point, axis) >= 0 &&
               side_of(*triangle[0], point, *triangle[2], axis) >= 0;
    };
    return in_cone(*other[1]) || in_cone(*other[2]);
}

bool coplanar_meet_properly(Pair pair, std::size_t axis) {
    auto& [a, b] = pair.corners;
    if (pair.shared == 2) {
        return side_of(*a[0], *a[1], *a[2], axis) != side_of(*a[0], *a[1], *b[2], axis);
    }
    for (Corners* corners : {&a, &b}) {
        if (side_of(*(*corners)[0], *(*corners)[1], *(*corners)[2], axis) < 0) {
            std::swap((*corners)[1], (*corners)[2]);
        }
    }
    // Two cones with a common apex share a ray iff a border ray of one lies in the other.
    if (pair.shared == 1) return !cone_holds_some(a, b, axis) && !cone_holds_some(b, a, axis);
    return some_edge_separates(a, b, axis) || some_edge_separates(b, a, axis);
}

// --- Two triangles in planes that cross in a line ---------------------------------------------

/// A coordinate of a point on that line: numerator / denominator, denominator > 0.
struct Position {
    mpz_class numerator;
    mpz_class denominator;

    friend bool operator<(const Position& a, const Position& b) {
        return a.numerator * b.denominator < b.numerator * a.denominator;
    }
};

/// The interval in which a triangle meets the line.
struct Interval {
    Position low;
    Position high;
};

void extend(std::optional<Interval>& interval, const Position& position) {
    if (!interval) {
        interval = Interval{position, position};
    } else if (position < interval->low) {
        interval->low = position;
    } else if (interval->high < position) {
        interval->high = position;
    }
}

/// Returns the point where the segment from p to q, whose heights have opposite signs, crosses
/// height zero.
Position crossing(const Vector4& p, const Vector4& q, const mpz_class& height_p,
                  const mpz_class& height_q, std::size_t axis) {
    Position result{height_p * q[axis] - height_q * p[axis], height_p * q[3] - height_q * p[3]};
    if (sgn(result.denominator) < 0) {
        result.numerator = -result.numerator;
        result.denominator = -result.denominator;
    }
    return result;
}

/// Returns the intersection of a triangle with the plane over which its corners have these heights,
/// as an interval of coordinate `axis`: the hull of the corners at height zero and of the points
/// where edges cross the plane. It is empty iff all corners lie strictly on one side.
/// Precondition: not all heights are zero.
std::optional<Interval> section(const Corners& corners, const Heights& heights, std::size_t axis) {
    std::optional<Interval> result;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if (sgn(heights[i]) == 0) extend(result, {(*corners[i])[axis], (*corners[i])[3]});
        if (sgn(heights[i]) * sgn(heights[j]) < 0) {
            extend(result, crossing(*corners[i], *corners[j], heights[i], heights[j], axis));
        }
    }
    return result;
}

/// Returns a coordinate that is not constant on the line of intersection of two planes.
std::size_t line_axis(const Vector4& a, const Vector4& b) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const std::size_t u = (axis + 1) % 3;
        const std::size_t v = (axis + 2) % 3;
        if (a[u] * b[v] != a[v] * b[u]) return axis;
    }
    return 2;
}

/// Tells whether two triangles with at most one shared corner meet properly: their intervals on the
/// line have nothing in common, or only that corner.
bool sections_meet_properly(const std::optional<Interval>& a, const std::optional<Interval>& b,
                            std::size_t shared) {
    if (!a || !b) return true;
    const Position& low = std::max(a->low, b->low);
    const Position& high = std::min(a->high, b->high);
    return shared == 0 ? high < low : !(low < high);
}

} // namespace

bool meet_properly(const ExactMesh& mesh, std::uint32_t first, std::uint32_t second) {
    const Pair pair = make_pair_of(mesh, mesh.triangles[first], mesh.triangles[second]);
    if (pair.shared == 3) return true;
    const auto& [a, b] = pair.corners;
    const Vector4& plane_a = mesh.planes[first];
    const Vector4& plane_b = mesh.planes[second];

    const Heights heights_b = heights_over(plane_a, b, pair.shared);
    if (on_one_side(heights_b, pair.shared)) return true;
    if (std::all_of(heights_b.begin(), heights_b.end(),
                    [](const mpz_class& height) { return sgn(height) == 0; })) {
        return coplanar_meet_properly(pair, *projection_axis(plane_a));
    }
    const Heights heights_a = heights_over(plane_b, a, pair.shared);
    if (on_one_side(heights_a, pair.shared)) return true;

    const std::size_t axis = line_axis(plane_a, plane_b);
    return sections_meet_properly(section(a, heights_a, axis), section(b, heights_b, axis),
                                  pair.shared);
}

// --- Which pairs to test ----------------------------------------------------------------------

std::vector<std::array<std::uint32_t, 2>>
find_improper_pairs(const ExactMesh& mesh, std::size_t at_most, std::uint32_t first) {
    const ContactSearch search(mesh);
    std::vector<std::array<std::uint32_t, 2>> improper;
    for (const std::uint32_t t : search.with_area()) {
        if (t < first) continue;
        for (const std::uint32_t other : search.near(t))
            if (other < t && !meet_properly(mesh, other, t)) improper.push_back({other, t});
        if (improper.size() >= at_most) break;
    }
    std::sort(improper.begin(), improper.end());
    return improper;
}

} // namespace terrane::verifier
