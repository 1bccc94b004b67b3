// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/data.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/reconstruction/kriging/cloud.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::kriging::detail {
namespace {

constexpr std::uint32_t none = UINT32_MAX;

Error no_graph(const Point3& p, std::string_view why) {
    return {ErrorCode::unsupported,
            fmt::format("the surface is no graph z = f(x, y) next to the hole: {}; --method rbf "
                        "can fill it",
                        why),
            place_text(p)};
}

/// Grows rings of triangles from a hole's border, as long as neighbours lie side by side along z.
class Rings {
public:
    explicit Rings(const Soup& soup) : soup_(soup), reached_(soup.triangles.size(), false) {
        beside_.resize(soup.triangles.size());
        soup.edges.for_each([&](std::uint32_t low, std::uint32_t high, const auto& sides) {
            if (sides.size() != 2) return;
            const auto a = sides[0].triangle, b = sides[1].triangle;
            if (side_of(a, low, high) * side_of(b, low, high) != Sign::Negative) return;
            beside_[a].push_back(b);
            beside_[b].push_back(a);
        });
    }

    /// Starts with the triangles at these vertices, which must lie side by side around each of
    /// them.
    Status start(const std::vector<std::uint32_t>& vertices) {
        std::vector<bool> wanted(soup_.points.size());
        for (const auto v : vertices) wanted[v] = true;
        for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
            const Triangle& corners = soup_.triangles[t];
            const auto at = std::find_if(corners.begin(), corners.end(),
                                         [&](std::uint32_t v) { return wanted[v]; });
            if (at == corners.end()) continue;
            if (upright(t)) return no_graph(soup_.points[*at], "a triangle is vertical");
            reach(t);
        }
        return check_folds(wanted);
    }

    /// Returns false if no further triangle is reached.
    bool spread() {
        std::vector<std::uint32_t> last;
        last.swap(ring_);
        for (const auto t : last)
            for (const auto other : beside_[t])
                if (!reached_[other]) reach(other);
        return !ring_.empty();
    }

    [[nodiscard]] const std::vector<std::uint32_t>& triangles() const { return all_; }

private:
    [[nodiscard]] bool upright(std::uint32_t t) const {
        const Triangle& c = soup_.triangles[t];
        const auto& p = soup_.points;
        return orient2d(Axis::z, p[c[0]], p[c[1]], p[c[2]]) == Sign::Zero;
    }

    /// Returns the side of the triangle's edge on which its third corner lies.
    [[nodiscard]] Sign side_of(std::uint32_t t, std::uint32_t low, std::uint32_t high) const {
        const Triangle& c = soup_.triangles[t];
        const auto third = *std::find_if(c.begin(), c.end(),
                                         [&](std::uint32_t v) { return v != low && v != high; });
        const auto& p = soup_.points;
        return orient2d(Axis::z, p[low], p[high], p[third]);
    }

    void reach(std::uint32_t t) {
        reached_[t] = true;
        ring_.push_back(t);
        all_.push_back(t);
    }

    /// Checks that edges at the vertices have one of their two triangles on each side.
    Status check_folds(const std::vector<bool>& wanted) const {
        Status status = Done{};
        soup_.edges.for_each([&](std::uint32_t low, std::uint32_t high, const auto& sides) {
            if (sides.size() != 2 || !status.ok() || (!wanted[low] && !wanted[high])) return;
            const auto a = sides[0].triangle, b = sides[1].triangle;
            if (side_of(a, low, high) * side_of(b, low, high) != Sign::Negative)
                status = no_graph(soup_.points[wanted[low] ? low : high], "it folds over there");
        });
        return status;
    }

    const Soup& soup_;
    std::vector<std::vector<std::uint32_t>> beside_; ///< per triangle: its neighbours that lie on
                                                     ///< the other side of the shared edge
    std::vector<bool> reached_;
    std::vector<std::uint32_t> ring_, all_;
};

/// Samples the borders.
Cloud sampled(std::span<const Point3> points, std::span<const Polygon> borders, double size) {
    Cloud cloud;
    for (const Polygon& polygon : borders)
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Point3 &a = points[polygon[i]], &b = points[polygon[(i + 1) % polygon.size()]];
            const double length = std::hypot(b.x - a.x, b.y - a.y);
            const double steps =
                std::clamp(std::ceil(length / (constants.border_distance * size)), 1.0, 1000.0);
            for (double k = 0; k < steps; ++k)
                cloud.points.push_back(
                    {a.x + (b.x - a.x) * k / steps, a.y + (b.y - a.y) * k / steps, 0});
        }
    return cloud;
}

/// Scan lines of a polygon: computes where a line y = const enters and leaves it.
class Rows {
public:
    Rows(std::span<const Point3> points, const Polygon& polygon) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Point3 *a = &points[polygon[i]], *b = &points[polygon[(i + 1) % polygon.size()]];
            if (a->y > b->y) std::swap(a, b);
            if (a->y < b->y) edges_.push_back({a->x, a->y, b->x, b->y});
        }
        std::sort(edges_.begin(), edges_.end(),
                  [](const EdgeOf& e, const EdgeOf& f) { return e.y0 < f.y0; });
    }

    /// Returns the crossings, ascending; the inside is between the first and second, third and
    /// fourth, ...
    std::vector<double> at(double y) {
        while (next_ < edges_.size() && edges_[next_].y0 <= y) active_.push_back(edges_[next_++]);
        std::erase_if(active_, [&](const EdgeOf& e) { return e.y1 <= y; });
        std::vector<double> crossings;
        for (const EdgeOf& e : active_)
            crossings.push_back(e.x0 + (e.x1 - e.x0) * ((y - e.y0) / (e.y1 - e.y0)));
        std::sort(crossings.begin(), crossings.end());
        return crossings;
    }

private:
    struct EdgeOf {
        double x0, y0, x1, y1; ///< y0 < y1
    };
    std::vector<EdgeOf> edges_, active_;
    std::size_t next_ = 0;
};

class Placer {
public:
    Placer(std::span<const Point3> points, std::span<const Polygon> borders, double size,
           std::stop_token stop) :
        stop_(std::move(stop)),
        points_(points), outer_(borders[0]), size_(size), cloud_(sampled(points, borders, size)),
        tree_(2, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(8)) {
        tree_.buildIndex();
        x0_ = y0_ = HUGE_VAL;
        y1_ = -HUGE_VAL;
        for (const auto v : outer_) {
            x0_ = std::min(x0_, points[v].x);
            y0_ = std::min(y0_, points[v].y);
            y1_ = std::max(y1_, points[v].y);
        }
    }

    /// Places points whose spacing grows to at most the distance from the border / `growth`, in
    /// powers of two.
    [[nodiscard]] std::vector<Point3> place(double growth, std::size_t most) const {
        std::vector<Point3> places;
        for (double scale = 1; places.size() <= most && !stop_.stop_requested(); scale *= 2) {
            const double low =
                scale == 1 ? constants.border_distance * size_ : scale * growth * size_;
            const double high = 2 * scale * growth * size_;
            if (!add_level(scale * size_, low, high, most, places)) break;
        }
        return places;
    }

private:
    /// Adds places of one spacing at distances from `low` to `high` from the border. Returns false
    /// if no place is as far from it as `high`.
    bool add_level(double step, double low, double high, std::size_t most,
                   std::vector<Point3>& places) const {
        constexpr double row_height = 0.8660254037844386; // of equilateral triangles
        bool farther = false, odd = false;
        Rows rows(points_, outer_);
        for (double row = 1;; ++row, odd = !odd) {
            const double y = y0_ + (row - 0.5) * row_height * step;
            if (!(y < y1_) || places.size() > most || stop_.stop_requested()) break;
            const auto crossings = rows.at(y);
            for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
                const double shift = odd ? 0.5 : 0.0;
                double column = std::ceil((crossings[k] - x0_) / step - shift);
                for (;; ++column) {
                    const double x = x0_ + (column + shift) * step;
                    if (!(x < crossings[k + 1]) || places.size() > most) break;
                    const double d = distance(x, y);
                    if (d >= low && d < high) places.push_back({x, y, 0});
                    farther = farther || d >= high;
                    // From one column to the next, the distance changes by at most a step.
                    const double off = d >= high ? d - high : low - d;
                    if (off > step) column += std::floor(off / step) - 1;
                }
            }
        }
        return farther;
    }

    [[nodiscard]] double distance(double x, double y) const {
        std::size_t found = 0;
        double square = 0;
        nanoflann::KNNResultSet<double> result(1);
        result.init(&found, &square);
        const std::array<double, 2> p{x, y};
        tree_.findNeighbors(result, p.data(), nanoflann::SearchParams());
        return std::sqrt(square);
    }

    std::stop_token stop_;
    std::span<const Point3> points_;
    const Polygon& outer_;
    double size_;
    Cloud cloud_;
    CloudTree<2> tree_;
    double x0_, y0_, y1_;
};

} // namespace

double signed_area(std::span<const Point3> points, const Polygon& polygon) {
    double sum = 0;
    const Point3& o = points[polygon[0]];
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point3 &a = points[polygon[i]], &b = points[polygon[(i + 1) % polygon.size()]];
        sum += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    }
    return sum / 2;
}

bool is_inside(std::span<const Point3> points, const Polygon& polygon, double x, double y) {
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point3 &a = points[polygon[i]], &b = points[polygon[(i + 1) % polygon.size()]];
        if ((a.y > y) != (b.y > y) && x < a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)))
            inside = !inside;
    }
    return inside;
}

Result<KrigingData> collect_data(const Surface& surface, std::span<const BorderLoop* const> loops,
                                 const RingRange& range, const Run& run) {
    const Error interrupted{ErrorCode::interrupted, "interrupted", ""};
    const Soup soup = merge_surfaces(std::span(&surface, 1), run);
    if (run.stop.stop_requested()) return interrupted;
    std::vector<std::uint32_t> border;
    for (const BorderLoop* loop : loops)
        for (const auto v : loop->vertices) {
            if (v >= surface.vertices.size())
                return Error{ErrorCode::bad_index, "the loop is not of this surface",
                             fmt::format("vertex {}", v)};
            border.push_back(v);
        }
    Rings near(soup);
    if (const auto status = near.start(border); !status) return status.error();
    std::size_t near_triangles = 0;
    for (std::size_t ring = 1;; ++ring) {
        if (run.stop.stop_requested()) return interrupted;
        const double left = range.enough_rings - static_cast<double>(ring);
        if (ring <= range.rings || left >= 0) near_triangles = near.triangles().size();
        const auto enough = left > 0 ? constants.enough_data : constants.most_at_once;
        // A vertex has two triangles.
        if (ring >= range.rings && near.triangles().size() > 2 * enough) break;
        if (!near.spread()) break;
    }

    KrigingData data;
    std::unordered_map<std::uint32_t, std::uint32_t> number;
    const auto number_of = [&](std::uint32_t v) {
        const auto [at, added] = number.try_emplace(v, static_cast<std::uint32_t>(number.size()));
        if (added) data.points.push_back(soup.points[v]);
        return at->second;
    };
    for (const BorderLoop* loop : loops) {
        Polygon& polygon = data.borders.emplace_back();
        for (const auto v : loop->vertices) polygon.push_back(number_of(v));
    }
    for (std::size_t t = 0; t < near.triangles().size(); ++t) {
        for (const auto v : soup.triangles[near.triangles()[t]]) number_of(v);
        if (t + 1 == near_triangles) data.near = data.points.size();
    }

    for (const BorderLoop* loop : loops)
        for (std::size_t i = 0; i < loop->vertices.size(); ++i) {
            const auto a = loop->vertices[i], b = loop->vertices[(i + 1) % loop->vertices.size()];
            const auto low = std::min(a, b), high = std::max(a, b);
            auto third = none;
            for (auto k = soup.edges.starts[low]; k < soup.edges.starts[low + 1]; ++k) {
                if (soup.edges.sides[k].high != high) continue;
                for (const auto v : soup.triangles[soup.edges.sides[k].triangle])
                    if (v != low && v != high) third = v;
            }
            if (third == none)
                return Error{ErrorCode::bad_index, "the loop is no border of this surface",
                             fmt::format("vertices {} and {}", a, b)};
            data.inner_of.push_back(number.at(third));
        }
    return data;
}

std::vector<Point3> places_within(std::span<const Point3> points, std::span<const Polygon> borders,
                                  double mesh_size, std::size_t most, const std::stop_token& stop) {
    const Placer placer(points, borders, mesh_size, stop);
    std::vector<Point3> places;
    // Where all places are within this distance of the border, in mesh sizes, the first spacing is
    // that of all; a hole that is deeper has more than `most`.
    for (double growth = std::sqrt(static_cast<double>(most)); growth > 1; growth /= 2) {
        places = placer.place(growth, most);
        if (places.size() <= most || stop.stop_requested()) break;
    }
    return places;
}

} // namespace terrane::kriging::detail
