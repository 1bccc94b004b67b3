// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/volumes/volumes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/polynomials.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

constexpr std::uint32_t most_in_map_leaf = 4;
constexpr std::size_t points_in_block = 4096;

Sign sign_of_difference(double a, double b) {
    return a > b ? Sign::Positive : a < b ? Sign::Negative : Sign::Zero;
}

/// A triangle that is not vertical, and whether its front is above it.
struct MapTriangle {
    std::uint32_t number = 0;
    Sign up = Sign::Zero;
};

/// The triangles of a mesh as they lie in the map.
class MapTree {
public:
    explicit MapTree(const Mesh& mesh) : mesh_(mesh) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto& [a, b, c] = mesh.triangles[t];
            const auto& v = mesh.vertices;
            const Sign up = orient2d(Axis::z, v[a], v[b], v[c]);
            if (up != Sign::Zero) triangles_.push_back({t, up});
        }
        if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(triangles_.size()));
    }

    /// Calls visit(triangle) for those whose boxes are not beside the point, not below it, and not
    /// above `ceiling`, which visit may lower.
    template <class Visit>
    void for_above(const Point3& p, const double& ceiling, const Visit& visit) const {
        if (nodes_.empty()) return;
        std::array<std::uint32_t, 96> stack; // NOLINT: filled as far as used; one per level and one
        std::size_t top = 0;
        stack[top++] = 0;
        while (top > 0) {
            const Node& node = nodes_[stack[--top]];
            const bool apart = p.x < node.low.x || p.x > node.high.x || p.y < node.low.y ||
                               p.y > node.high.y || p.z > node.high.z || node.low.z > ceiling;
            if (apart) continue;
            if (node.left == 0) {
                for (std::uint32_t t = node.first; t < node.last; ++t) visit(triangles_[t]);
                continue;
            }
            stack[top++] = node.left;
            stack[top++] = node.right;
        }
    }

private:
    struct Node {
        Point3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        std::uint32_t first = 0, last = 0; ///< triangles of the node
        std::uint32_t left = 0, right = 0; ///< children; 0: a leaf
    };

    std::uint32_t build(std::uint32_t first, std::uint32_t last) {
        Node node;
        node.first = first;
        node.last = last;
        for (std::uint32_t t = first; t < last; ++t)
            for (const std::uint32_t v : mesh_.triangles[triangles_[t].number]) {
                const Point3& p = mesh_.vertices[v];
                node.low = {std::min(node.low.x, p.x), std::min(node.low.y, p.y),
                            std::min(node.low.z, p.z)};
                node.high = {std::max(node.high.x, p.x), std::max(node.high.y, p.y),
                             std::max(node.high.z, p.z)};
            }
        const auto at = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back(node);
        if (last - first <= most_in_map_leaf) return at;
        const bool wide = node.high.x - node.low.x >= node.high.y - node.low.y;
        const auto middle = [&](const MapTriangle& t) {
            double sum = 0;
            for (const std::uint32_t v : mesh_.triangles[t.number])
                sum += (wide ? mesh_.vertices[v].x : mesh_.vertices[v].y) / 4;
            return std::pair(sum, t.number);
        };
        const std::uint32_t half = first + (last - first) / 2;
        std::nth_element(
            triangles_.begin() + first, triangles_.begin() + half, triangles_.begin() + last,
            [&](const MapTriangle& t, const MapTriangle& u) { return middle(t) < middle(u); });
        const std::uint32_t left = build(first, half), right = build(half, last);
        nodes_[at].left = left;
        nodes_[at].right = right;
        return at;
    }

    const Mesh& mesh_;
    std::vector<MapTriangle> triangles_;
    std::vector<Node> nodes_;
};

/// The height at which a vertical line meets the plane of a triangle, and its derivatives by the
/// shift of the line along x and y: numerators over a common denominator.
struct LineHeight {
    std::array<Exact, 3> numerators;
    Exact denominator; ///< > 0
};

/// Finds the volume of one point after the other.
class PointLocator {
public:
    PointLocator(UpwardWitness upward, const Mesh& mesh, const Volumes& volumes,
                 const MapTree& tree) :
        upward_(upward),
        mesh_(mesh), volumes_(volumes), tree_(tree) {}

    [[nodiscard]] std::uint32_t volume_at(const Point3& p) const {
        Hit lowest;
        bool found = false;
        double ceiling = HUGE_VAL;
        tree_.for_above(p, ceiling, [&](const MapTriangle& t) {
            if (!passes_through(t, p)) return;
            const Sign side = side_of(t.number, p);
            if (side == t.up) return; // the triangle is below
            Hit hit{t.number, side == Sign::Positive, height(t.number, p)};
            if (found && !below(hit, lowest, p)) return;
            lowest = hit;
            found = true;
            ceiling = hit.height.sup();
        });
        return found ? volumes_.of_sides[lowest.triangle][lowest.front ? 0 : 1] : 0;
    }

private:
    /// A triangle above a point; `front`: its front faces the point.
    struct Hit {
        std::uint32_t triangle = 0;
        bool front = false;
        Interval height{0};
    };

    [[nodiscard]] const Point3& corner(std::uint32_t triangle, std::size_t k) const {
        return mesh_.vertices[mesh_.triangles[triangle][k]];
    }

    /// Returns Positive iff the shifted point lies to the left of a b in the map, and Zero only if a
    /// and b coincide there. The shift adds (b - a) x (e, e^2).
    static Sign turn(const Point3& a, const Point3& b, const Point3& p) {
        const Sign s = orient2d(Axis::z, a, b, p);
        if (s != Sign::Zero) return s;
        const Sign first = sign_of_difference(a.y, b.y);
        return first != Sign::Zero ? first : sign_of_difference(b.x, a.x);
    }

    [[nodiscard]] bool passes_through(const MapTriangle& t, const Point3& p) const {
        const Point3 &a = corner(t.number, 0), &b = corner(t.number, 1), &c = corner(t.number, 2);
        return turn(a, b, p) == t.up && turn(b, c, p) == t.up && turn(c, a, p) == t.up;
    }

    /// Returns the side of the triangle on which the shifted point lies.
    [[nodiscard]] Sign side_of(std::uint32_t t, const Point3& p) const {
        const Point3 &a = corner(t, 0), &b = corner(t, 1), &c = corner(t, 2);
        const Sign s = orient3d(a, b, c, p);
        if (s != Sign::Zero) return s;
        for (const Axis axis : {Axis::x, Axis::y})
            if (const Sign n = orient2d(axis, a, b, c); n != Sign::Zero) return n;
        return orient2d(Axis::z, a, b, c);
    }

    /// Encloses the height of the line through p at the plane of a triangle, from n (x - a) = 0.
    [[nodiscard]] Interval height(std::uint32_t t, const Point3& p) const {
        const auto a = polynomial::cartesian<Interval>(corner(t, 0));
        const auto n = cross(difference(polynomial::cartesian<Interval>(corner(t, 1)), a),
                             difference(polynomial::cartesian<Interval>(corner(t, 2)), a));
        if (certain_sign(upward_, n.z).value_or(Sign::Zero) == Sign::Zero)
            return {-HUGE_VAL, HUGE_VAL};
        const Interval dx = a.x - Interval(p.x), dy = a.y - Interval(p.y);
        return a.z + (n.x * dx + n.y * dy) / n.z;
    }

    [[nodiscard]] LineHeight exact_height(std::uint32_t t, const Point3& p) const {
        const auto at = [&](std::size_t k) { return polynomial::cartesian<Exact>(corner(t, k)); };
        const auto a = at(0);
        const auto n = cross(difference(at(1), a), difference(at(2), a));
        LineHeight result{
            {n.x * (a.x - Exact(p.x)) + n.y * (a.y - Exact(p.y)) + n.z * a.z, -n.x, -n.y}, n.z};
        if (exact_sign(n.z) != Sign::Negative) return result;
        result.denominator = -result.denominator;
        for (Exact& x : result.numerators) x = -x;
        return result;
    }

    /// Tells which of two triangles the shifted line meets first.
    [[nodiscard]] bool below(const Hit& a, const Hit& b, const Point3& p) const {
        if (a.height.sup() < b.height.inf()) return true;
        if (b.height.sup() < a.height.inf()) return false;
        ++predicate_counts().exact;
        const LineHeight first = exact_height(a.triangle, p), second = exact_height(b.triangle, p);
        for (std::size_t i = 0; i < 3; ++i) {
            const Sign s = exact_sign(first.numerators[i] * second.denominator -
                                      second.numerators[i] * first.denominator);
            if (s != Sign::Zero) return s == Sign::Negative;
        }
        throw std::logic_error("two triangles overlap");
    }

    [[no_unique_address]] UpwardWitness upward_;
    const Mesh& mesh_;
    const Volumes& volumes_;
    const MapTree& tree_;
};

} // namespace

Result<std::vector<std::uint32_t>> locate_points(std::span<const Point3> points, const Mesh& mesh,
                                                 const Volumes& volumes, const Run& run) {
    using Blocks = std::vector<std::uint32_t>;
    return guarded("for the points", "points", [&]() -> Result<Blocks> {
        const MapTree tree(mesh);
        auto found = concatenated(
            for_blocks<Blocks>(points.size(), points_in_block, run,
                               [&](UpwardWitness upward, std::size_t first, std::size_t last) {
                                   const PointLocator locator(upward, mesh, volumes, tree);
                                   Blocks blocks;
                                   for (std::size_t p = first; p < last; ++p)
                                       blocks.push_back(locator.volume_at(points[p]));
                                   return blocks;
                               }));
        if (run.stop.stop_requested())
            return Error{ErrorCode::interrupted, "stopped on request", ""};
        return found;
    });
}

} // namespace terrane
