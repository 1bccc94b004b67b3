// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetgen/detail/facet_nodes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <terrane/algorithms/tetrahedra/allowance.hpp>
#include <terrane/kernel/nearest.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/polynomials.hpp>

namespace terrane::tetgen::detail {
namespace {

using polynomial::cartesian;
using Directed = std::array<std::uint32_t, 2>; ///< a step along the border of some faces

/// A node that is off by more allowances than this is not there because of rounding. Up to 38 were
/// seen, next to triangles with angles of a degree.
constexpr double farthest_allowances = 0x1p13;

/// Returns the doubles nearest to p + share v, where share is a fraction.
Point3 nearest_along(const Point3& p, const polynomial::Vector<Exact>& v, const Exact& numerator,
                     const Exact& denominator) {
    const auto moved = [&](double coordinate, const Exact& by) {
        return nearest_quotient(Exact(coordinate) * denominator + by * numerator, denominator);
    };
    return {moved(p.x, v.x), moved(p.y, v.y), moved(p.z, v.z)};
}

/// Returns the foot of the perpendicular from p to the line through a and b, rounded.
Point3 foot_on_line(const Point3& p, const Point3& a, const Point3& b) {
    const auto from = cartesian<Exact>(a);
    const auto along = difference(cartesian<Exact>(b), from);
    return nearest_along(a, along, dot(along, difference(cartesian<Exact>(p), from)),
                         dot(along, along));
}

/// Returns the foot of the perpendicular from p to the plane of a triangle, rounded.
Point3 foot_on_plane(const Point3& p, const std::array<Point3, 3>& t) {
    const auto a = cartesian<Exact>(t[0]);
    const auto normal =
        cross(difference(cartesian<Exact>(t[1]), a), difference(cartesian<Exact>(t[2]), a));
    return nearest_along(p, normal, dot(normal, difference(a, cartesian<Exact>(p))),
                         dot(normal, normal));
}

/// Returns the steps along the border of some faces, in both directions, sorted: the sides that only
/// one of them has.
std::vector<Directed> border_of(std::span<const Triangle> faces) {
    std::vector<Directed> sides, border;
    for (const Triangle& face : faces)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [from, to] = std::minmax(face[i], face[(i + 1) % 3]);
            sides.push_back({from, to});
        }
    std::sort(sides.begin(), sides.end());
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const bool again = i + 1 < sides.size() && sides[i + 1] == sides[i];
        if (again) {
            while (i + 1 < sides.size() && sides[i + 1] == sides[i]) ++i;
            continue;
        }
        border.push_back(sides[i]);
        border.push_back({sides[i][1], sides[i][0]});
    }
    std::sort(border.begin(), border.end());
    return border;
}

/// A node on an edge of a triangle.
struct EdgeNode {
    std::uint32_t node;
    Directed edge; ///< corners of the triangle
};

/// Follows the border of the faces of a triangle; nothing if it is no closed polygon through the
/// corners.
std::optional<std::vector<EdgeNode>> nodes_on_edges(std::span<const Directed> border,
                                                    const Triangle& corners) {
    const auto is_corner = [&](std::uint32_t v) {
        return std::find(corners.begin(), corners.end(), v) != corners.end();
    };
    std::vector<EdgeNode> found;
    std::vector<std::uint32_t> inside; // of the edge that is followed
    std::uint32_t start = corners[0], before = start, at = start;
    for (std::size_t step = 0; step < border.size() / 2; ++step) {
        const auto [first, last] =
            std::equal_range(border.begin(), border.end(), Directed{at, 0},
                             [](const Directed& x, const Directed& y) { return x[0] < y[0]; });
        if (last - first != 2) return std::nullopt;
        const std::uint32_t to = (*first)[1] != before ? (*first)[1] : (*(first + 1))[1];
        before = std::exchange(at, to);
        if (!is_corner(at)) {
            inside.push_back(at);
            continue;
        }
        for (const std::uint32_t node : inside) found.push_back({node, {start, at}});
        inside.clear();
        start = at;
    }
    return at == corners[0] ? std::optional(std::move(found)) : std::nullopt;
}

/// Puts nodes on the triangles, one triangle after the other.
class FacetNodes {
public:
    FacetNodes(const TetgenDomain& domain, TetgenOutput& output) :
        domain_(domain), output_(output), settled_(output.points.size(), 0) {
        const auto given = static_cast<std::ptrdiff_t>(domain.points.size());
        std::fill(settled_.begin(), settled_.begin() + given, 1);
    }

    bool operator()() {
        std::vector<std::uint32_t> order(output_.faces.size());
        std::iota(order.begin(), order.end(), 0U);
        const auto& facet = output_.face_facet;
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return facet[a] < facet[b]; });
        std::vector<Triangle> faces;
        bool all_near = true;
        for (std::size_t i = 0; i < order.size(); ++i) {
            faces.push_back(output_.faces[order[i]]);
            const std::uint32_t here = facet[order[i]];
            if (i + 1 < order.size() && facet[order[i + 1]] == here) continue;
            if (here < domain_.triangles.size() && faces.size() > 1)
                all_near = settle(domain_.triangles[here], faces) && all_near;
            faces.clear();
        }
        return all_near;
    }

private:
    /// Returns whether all nodes of the faces of a triangle are near it now.
    bool settle(const Triangle& corners, std::span<const Triangle> faces) {
        const auto border = border_of(faces);
        const auto on_edges = nodes_on_edges(border, corners);
        if (!on_edges) return false;
        bool all_near = true;
        for (const auto& [node, edge] : *on_edges)
            if (std::exchange(settled_[node], 1) == 0)
                all_near = put_on_edge(node, edge) && all_near;
        for (const Triangle& face : faces)
            for (const std::uint32_t node : face)
                if (std::exchange(settled_[node], 1) == 0)
                    all_near = put_on_plane(node, corners) && all_near;
        return all_near;
    }

    bool put_on_edge(std::uint32_t node, const Directed& edge) {
        const Point3 &a = domain_.points[edge[0]], &b = domain_.points[edge[1]];
        Point3& here = output_.points[node];
        if (tetrahedra::near_edge(here, a, b)) return true;
        const Point3 foot = foot_on_line(here, a, b);
        if (!is_step(here, foot, tetrahedra::allowance(a, b))) return false;
        here = foot;
        return tetrahedra::near_edge(here, a, b);
    }

    bool put_on_plane(std::uint32_t node, const Triangle& corners) {
        const auto& p = domain_.points;
        const std::array<Point3, 3> triangle{p[corners[0]], p[corners[1]], p[corners[2]]};
        Point3& here = output_.points[node];
        if (tetrahedra::near_plane(here, triangle)) return true;
        const Point3 foot = foot_on_plane(here, triangle);
        if (!is_step(here, foot, tetrahedra::allowance(triangle))) return false;
        here = foot;
        return tetrahedra::near_plane(here, triangle);
    }

    /// Whether a node would move no farther than rounding may have put it.
    static bool is_step(const Point3& from, const Point3& to, const Point3& allowed) {
        const double most = farthest_allowances * std::max({allowed.x, allowed.y, allowed.z});
        return std::fabs(to.x - from.x) <= most && std::fabs(to.y - from.y) <= most &&
               std::fabs(to.z - from.z) <= most;
    }

    const TetgenDomain& domain_;
    TetgenOutput& output_;
    std::vector<char> settled_; ///< per node: it is given, or was looked at
};

} // namespace

bool put_on_triangles(const TetgenDomain& domain, TetgenOutput& output) {
    return FacetNodes(domain, output)();
}

} // namespace terrane::tetgen::detail
