// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures the one-sided Hausdorff distance by branch and bound. Triangles are divided into convex
// polygons, each of which is mostly near a single triangle of the other surface. Such a polygon
// needs no further division, however small the distance is, since the distance from one triangle is
// a convex function: it is largest at a corner of the polygon.
#include <terrane/algorithms/quality/quality.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane {
namespace {

/// Share of the largest distance by which the measured one may fall short of it.
constexpr double measured_error = 0.05;
/// Parts of one triangle that are examined at most.
constexpr unsigned most_polygons = 1U << 16U;
/// Numbers of triangles that start from the same known distance: the first, and the most.
constexpr std::size_t first_batch = 256, largest_batch = 16384;

constexpr double anywhere = std::numeric_limits<double>::infinity();

using Polygon = std::vector<Point3>; ///< convex, corners in order

Point3 centre_of(std::span<const Point3> polygon) {
    const auto share = 1 / static_cast<double>(polygon.size());
    Point3 sum{};
    for (const Point3& p : polygon)
        sum = {sum.x + share * p.x, sum.y + share * p.y, sum.z + share * p.z};
    return sum;
}

/// A triangle with its unit normal, which is zero if the triangle has no area.
struct Facet {
    Facet(std::span<const Point3> points, const Triangle& t) :
        corners{points[t[0]], points[t[1]], points[t[2]]},
        normal(cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))) {
        const double size = length(normal);
        normal = size > 0 ? Point3{normal.x / size, normal.y / size, normal.z / size} : Point3{};
    }

    [[nodiscard]] double distance(const Point3& p) const {
        return distance_to_triangle(p, corners[0], corners[1], corners[2]);
    }
    [[nodiscard]] double height(const Point3& p) const { return dot(minus(p, corners[0]), normal); }

    std::array<Point3, 3> corners;
    Point3 normal;
};

/// Measures the parts of one triangle after the other.
class Measurer {
public:
    Measurer(const TriangleTree& tree, std::span<const Point3> points, double rounding,
             std::stop_token stop) :
        tree_(tree),
        points_(points), rounding_(rounding), stop_(std::move(stop)) {}

    /// Returns the larger of `least` and a distance that is within measured_error of the largest
    /// one of the triangle.
    double operator()(std::span<const Point3, 3> triangle, double least) {
        least_ = least;
        open_.assign(1, Polygon(triangle.begin(), triangle.end()));
        for (unsigned count = 1; !open_.empty() && count < most_polygons; ++count) {
            if (count % 256 == 0 && stop_.stop_requested()) break;
            const Polygon polygon = std::move(open_.back());
            open_.pop_back();
            measure(polygon);
        }
        return least_;
    }

    /// Tells whether all of the triangle is shown to be within the bound.
    bool is_within(std::span<const Point3, 3> triangle, double bound) {
        open_.assign(1, Polygon(triangle.begin(), triangle.end()));
        for (unsigned count = 0; !open_.empty(); ++count) {
            if (count == most_polygons || (count % 256 == 255 && stop_.stop_requested()))
                return false;
            const Polygon polygon = std::move(open_.back());
            open_.pop_back();
            if (!show(polygon, bound)) return false;
        }
        return true;
    }

private:
    /// Drops the polygon if it is within the bound, else divides it. Returns false if a point of it is not.
    bool show(const Polygon& polygon, double bound) {
        const Point3 middle = centre_of(polygon);
        const auto near = tree_.within(middle, bound + rounding_);
        if (near.empty()) return false;
        double radius = 0, least = anywhere;
        for (const Point3& p : polygon) radius = std::max(radius, length(minus(p, middle)));
        std::vector<std::pair<double, Facet>> facets; // by area
        for (const auto& one : near) {
            if (one.distance + radius <= bound) return true; // the distance is 1-Lipschitz
            const auto& [a, b, c] =
                facets.emplace_back(0.0, Facet(points_, one.triangle)).second.corners;
            facets.back().first = -length(cross(minus(b, a), minus(c, a)));
            double most = 0;
            for (const Point3& p : polygon) most = std::max(most, facets.back().second.distance(p));
            least = std::min(least, most);
        }
        if (least <= bound + rounding_) return true; // the distance from one triangle is convex
        // The largest triangles leave the fewest parts.
        std::ranges::sort(facets, {}, [](const auto& one) { return one.first; });
        for (const auto& [area, facet] : facets)
            if (cut_by_walls(polygon, facet)) return true;
        halve(polygon);
        return true;
    }

    /// Tells whether a bound adds nothing to what is known.
    [[nodiscard]] bool is_known(double bound) const {
        return bound <= least_ * (1 + measured_error) + rounding_;
    }

    /// Drops the polygon if no point of it is much farther than what is known, else divides it.
    void measure(const Polygon& polygon) {
        const Point3 middle = centre_of(polygon);
        const auto near = tree_.nearest(middle, anywhere);
        if (!near) return;
        least_ = std::max(least_, near->distance);
        double radius = 0;
        for (const Point3& p : polygon) radius = std::max(radius, length(minus(p, middle)));
        if (is_known(near->distance + radius)) return; // the distance is 1-Lipschitz
        const Facet here(points_, near->triangle);
        double most = 0;
        const Point3* farthest = nullptr;
        for (const Point3& p : polygon)
            if (const double d = here.distance(p); d >= most) {
                most = d;
                farthest = &p;
            }
        if (is_known(most)) return; // the distance from one triangle is convex
        const auto other = tree_.nearest(*farthest, anywhere);
        if (!other) return;
        least_ = std::max(least_, other->distance);
        if (is_known(most)) return;
        const Facet there(points_, other->triangle);
        if (!cut_by_walls(polygon, here) && !cut_by_walls(polygon, there) &&
            !cut_between(polygon, here, there, *farthest))
            halve(polygon);
    }

    /// Divides the polygon by the walls over the edges of the facet, along its normal: within them,
    /// and beyond one of them, the nearest triangle mostly is the same.
    bool cut_by_walls(const Polygon& polygon, const Facet& facet) {
        Polygon rest = polygon;
        bool is_cut = false;
        for (std::size_t i = 0; i < 3; ++i) {
            const Point3 &a = facet.corners[i], &b = facet.corners[(i + 1) % 3];
            const Point3 out = cross(minus(b, a), facet.normal);
            const double size = length(out);
            if (!(size > 0)) return false; // no area
            Polygon inside, outside;
            if (!cut(
                    rest, [&](const Point3& p) { return dot(minus(p, a), out) / size; }, inside,
                    outside))
                continue;
            open_.push_back(std::move(outside));
            rest = std::move(inside);
            is_cut = true;
        }
        if (is_cut) open_.push_back(std::move(rest));
        return is_cut;
    }

    /// Divides the polygon where it is at the same distance from the planes of two facets, on the
    /// sides of them on which `there` is.
    bool cut_between(const Polygon& polygon, const Facet& first, const Facet& second,
                     const Point3& there) {
        const double sign =
            std::copysign(1.0, first.height(there)) * std::copysign(1.0, second.height(there));
        Polygon nearer, farther;
        if (!cut(
                polygon, [&](const Point3& p) { return first.height(p) - sign * second.height(p); },
                nearer, farther))
            return false;
        open_.push_back(std::move(nearer));
        open_.push_back(std::move(farther));
        return true;
    }

    /// Divides the polygon in the middle between the two corners that are farthest apart.
    void halve(const Polygon& polygon) {
        double most = 0;
        Point3 from{}, along{};
        for (const Point3& p : polygon)
            for (const Point3& q : polygon)
                if (const double apart = length(minus(q, p)); apart > most) {
                    most = apart;
                    from = p;
                    along = {(q.x - p.x) / apart, (q.y - p.y) / apart, (q.z - p.z) / apart};
                }
        Polygon first, second;
        if (!cut(
                polygon, [&](const Point3& p) { return dot(minus(p, from), along) - most / 2; },
                first, second))
            return; // smaller than rounding errors
        open_.push_back(std::move(first));
        open_.push_back(std::move(second));
    }

    /// Divides the polygon where the affine function is zero. Returns false if it is not beyond
    /// rounding errors on both sides.
    template <class Height>
    [[nodiscard]] bool cut(const Polygon& polygon, const Height& height, Polygon& below,
                           Polygon& above) {
        heights_.clear();
        for (const Point3& p : polygon) heights_.push_back(height(p));
        const auto [low, high] = std::minmax_element(heights_.begin(), heights_.end());
        if (!(*low<-rounding_&& * high> rounding_)) return false;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const std::size_t j = (i + 1) % polygon.size();
            const double h = heights_[i], k = heights_[j];
            const Point3 &p = polygon[i], &q = polygon[j];
            if (h <= 0) below.push_back(p);
            if (h >= 0) above.push_back(p);
            if (!((h < 0 && k > 0) || (h > 0 && k < 0))) continue;
            const double share = h / (h - k);
            const Point3 between{p.x + share * (q.x - p.x), p.y + share * (q.y - p.y),
                                 p.z + share * (q.z - p.z)};
            below.push_back(between);
            above.push_back(between);
        }
        return true;
    }

    const TriangleTree& tree_;
    std::span<const Point3> points_;
    double rounding_;
    std::stop_token stop_;
    double least_ = 0;
    std::vector<Polygon> open_;
    std::vector<double> heights_;
};

constexpr double sampling_share = 0.5; ///< of the time, an estimate

/// Measures, per triangle, the largest distance of its corners and its centroid.
std::vector<double> sampled(const Surface& from, const TriangleTree& tree, const Run& run) {
    std::vector<double> of_vertices(from.vertices.size(), 0), largest(from.triangles.size(), 0);
    std::vector<char> is_used(from.vertices.size(), 0);
    for (const Triangle& t : from.triangles)
        for (const std::uint32_t v : t) is_used[v] = 1;
    const auto is_stopped = [&](std::size_t i) {
        return i % 256 == 0 && run.stop.stop_requested();
    };
    for_ranges(from.vertices.size(), run, [&](std::size_t first, std::size_t last) {
        for (std::size_t v = first; v < last && !is_stopped(v); ++v)
            if (is_used[v] != 0) of_vertices[v] = tree.distance(from.vertices[v], anywhere);
    });
    report_part(run, "measure", 0, sampling_share, from.vertices.size(),
                from.vertices.size() + from.triangles.size());
    for_ranges(from.triangles.size(), run, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last && !is_stopped(t); ++t) {
            const auto& [a, b, c] = from.triangles[t];
            const std::array corners{from.vertices[a], from.vertices[b], from.vertices[c]};
            largest[t] = std::max({of_vertices[a], of_vertices[b], of_vertices[c],
                                   tree.distance(centre_of(corners), anywhere)});
        }
    });
    report_part(run, "measure", 0, sampling_share, 1, 1);
    return largest;
}

/// Returns the largest absolute value of a coordinate.
double size_of(const Surface& from, const Surface& to) {
    double size = 0;
    for (const auto* points : {&from.vertices, &to.vertices})
        for (const Point3& p : *points)
            size = std::max({size, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    return size;
}

/// Returns the error that distances may have for coordinates of this size.
double rounding_for(double size) {
    return 256 * std::numeric_limits<double>::epsilon() * size;
}

/// Measures surfaces whose largest coordinate has this size; squares must neither overflow nor underflow.
double distance_in_range(const Surface& from, const Surface& to, double size, const Run& run) {
    const TriangleTree tree(to.vertices, to.triangles);
    const double rounding = rounding_for(size);
    std::vector<double> found = sampled(from, tree, run);
    // The triangles with the largest samples come first, so that others need fewer parts.
    std::vector<std::uint32_t> order(found.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(-found[a], a) < std::pair(-found[b], b);
    });
    double least = found[order[0]];
    // All triangles of a batch start from the same distance, so threads do not matter.
    for (std::size_t done = 0, batch = first_batch; done < order.size();
         done += batch, batch = std::min(2 * batch, largest_batch)) {
        const std::size_t count = std::min(batch, order.size() - done);
        const auto measure = [&](std::size_t first, std::size_t last) {
            Measurer measurer(tree, to.vertices, rounding, run.stop);
            for (std::size_t i = done + first; i < done + last; ++i) {
                if (run.stop.stop_requested()) return;
                const auto& [a, b, c] = from.triangles[order[i]];
                const std::array corners{from.vertices[a], from.vertices[b], from.vertices[c]};
                found[order[i]] = measurer(corners, least);
            }
        };
        for_ranges(count, run, measure, 4, 64);
        for (std::size_t i = done; i < done + count; ++i) least = std::max(least, found[order[i]]);
        report_part(run, "measure", sampling_share, 1, done + count, order.size());
    }
    return least;
}

Surface scaled(Surface surface, int exponent) {
    for (Point3& p : surface.vertices)
        p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
    return surface;
}

} // namespace

bool is_within(const Surface& from, const Surface& to, double bound, const Run& run) {
    const StandardArithmetic guard;
    if (to.triangles.empty()) return from.triangles.empty();
    const double rounding = rounding_for(size_of(from, to));
    const TriangleTree tree(to.vertices, to.triangles);
    const auto parts =
        parts_of_ranges<char>(from.triangles.size(), run, [&](std::size_t first, std::size_t last) {
            Measurer measurer(tree, to.vertices, rounding, run.stop);
            for (std::size_t t = first; t < last; ++t) {
                const auto& [a, b, c] = from.triangles[t];
                const std::array corners{from.vertices[a], from.vertices[b], from.vertices[c]};
                if (run.stop.stop_requested() || !measurer.is_within(corners, bound))
                    return char{0};
            }
            return char{1};
        });
    return std::find(parts.begin(), parts.end(), char{0}) == parts.end();
}

double measured_distance(const Surface& from, const Surface& to, const Run& run) {
    const StandardArithmetic guard;
    if (from.triangles.empty()) return 0;
    if (to.triangles.empty()) return anywhere;
    const double size = size_of(from, to);
    constexpr double least = 0x1p-300, most = 0x1p+300; // in between, scaling changes no digit
    if (size == 0 || (size > least && size < most)) return distance_in_range(from, to, size, run);
    const int exponent = std::ilogb(size);
    return std::ldexp(distance_in_range(scaled(from, -exponent), scaled(to, -exponent),
                                        std::ldexp(size, -exponent), run),
                      exponent);
}

} // namespace terrane
