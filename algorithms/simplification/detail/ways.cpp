// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/simplification/detail/ways.hpp>

#include <algorithm>
#include <functional>
#include <optional>
#include <queue>
#include <unordered_map>
#include <utility>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/simplification/detail/tuning.hpp>

namespace terrane::simplification::detail {
namespace {

double between(const Point3& a, const Point3& b) {
    return length(minus(b, a));
}

/// Returns the length of the shortest way from x to y that meets the edge ab.
double way_across(const Point3& x, const Point3& y, const Point3& a, const Point3& b) {
    const auto way = [&](double t) {
        const Point3 q{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
        return between(x, q) + between(q, y);
    };
    double low = 0, high = 1; // the length is convex
    constexpr int steps = 24;
    for (int i = 0; i < steps; ++i) {
        const double p = low + (high - low) / 3, q = high - (high - low) / 3;
        (way(p) < way(q) ? high : low) = way(p) < way(q) ? q : p;
    }
    return way((low + high) / 2);
}

/// Returns the normal of the plane through two places that contains the shortest way between them
/// across the line in which two planes meet, if each place is on one of these. None: they are
/// parallel.
std::optional<Point3> section_across(const Point3& x, const Point3& of_x, const Point3& y,
                                     const Point3& of_y) {
    const Point3 line = cross(of_x, of_y);
    const Point3 from_x = cross(line, of_x), from_y = cross(line, of_y);
    const double slope_x = dot(from_x, of_y), slope_y = dot(from_y, of_x);
    if (slope_x == 0 || slope_y == 0) return std::nullopt;
    const Point3 way = minus(y, x);
    const auto foot = [](const Point3& p, const Point3& along, double share) {
        return Point3{p.x + share * along.x, p.y + share * along.y, p.z + share * along.z};
    };
    const Point3 a = foot(x, from_x, dot(way, of_y) / slope_x);
    const Point3 b = foot(y, from_y, -dot(way, of_x) / slope_y);
    const double to_a = between(x, a), to_b = between(y, b);
    if (!(to_a + to_b > 0)) return std::nullopt;
    return cross(way, minus(foot(a, minus(b, a), to_a / (to_a + to_b)), x));
}

} // namespace

std::vector<std::uint32_t> Ways::cells_of(const Place& place) const {
    std::vector<std::uint32_t> cells;
    for (const std::uint32_t t : complex_.star(place.corners[0]))
        if (std::all_of(place.vertices().begin(), place.vertices().end(),
                        [&](std::uint32_t v) { return contains(complex_.cells()[t].corners, v); }))
            cells.push_back(t);
    return cells;
}

/// Tells whether a way across an edge that cells at both places share is shorter than the limit.
bool Ways::meet_at_edge(const NearPlaces& c, double limit) const {
    const auto from = cells_of(c.from), to = cells_of(c.to);
    const Point3 x = at(c.from), y = at(c.to);
    for (const std::uint32_t s : from)
        for (const std::uint32_t t : to) {
            if (s == t) return true;
            std::array<std::uint32_t, 3> common{};
            std::size_t count = 0;
            for (const std::uint32_t v : complex_.cells()[s].corners)
                if (contains(complex_.cells()[t].corners, v)) common[count++] = v;
            if (count == 2 && way_across(x, y, complex_.points()[common[0]],
                                         complex_.points()[common[1]]) < limit)
                return true;
        }
    return false;
}

/// Follows the section of the surfaces with a plane through both places, from edge to edge.
bool Ways::meet_in_section(const NearPlaces& c, const Point3& normal, double limit) const {
    struct Step {
        std::uint32_t cell;
        Point3 at;
        double way;
    };
    const auto& points = complex_.points();
    const Point3 x = at(c.from), y = at(c.to);
    const auto height = [&](std::uint32_t v) { return dot(minus(points[v], x), normal); };
    const auto goals = cells_of(c.to);
    std::vector<Step> front;
    for (const std::uint32_t t : cells_of(c.from)) front.push_back({t, x, 0});
    std::unordered_map<std::uint32_t, double> best;
    while (!front.empty()) {
        const Step step = front.back();
        front.pop_back();
        const auto [known, is_new] = best.try_emplace(step.cell, step.way);
        if (!is_new && known->second <= step.way) continue;
        known->second = step.way;
        if (step.way + between(step.at, y) >= limit) continue;
        if (std::find(goals.begin(), goals.end(), step.cell) != goals.end()) return true;
        const Triangle& corners = complex_.cells()[step.cell].corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = corners[i], b = corners[(i + 1) % 3];
            const double h = height(a), k = height(b);
            if ((h > 0) == (k > 0)) continue;
            const double share = h / (h - k);
            const Point3 &p = points[a], &q = points[b];
            const Point3 next{p.x + share * (q.x - p.x), p.y + share * (q.y - p.y),
                              p.z + share * (q.z - p.z)};
            for (const std::uint32_t t : complex_.star(a, b))
                if (t != step.cell) front.push_back({t, next, step.way + between(step.at, next)});
        }
    }
    return false;
}

Point3 Ways::normal_of(std::uint32_t cell) const {
    const auto& [a, b, c] = complex_.cells()[cell].corners;
    const auto& p = complex_.points();
    return cross(minus(p[b], p[a]), minus(p[c], p[a]));
}

/// Tries the sections that contain the shortest way if the cells at both places go on as planes.
bool Ways::meet_in_a_section(const NearPlaces& c, double limit) const {
    const Point3 x = at(c.from), y = at(c.to);
    for (const std::uint32_t s : cells_of(c.from))
        for (const std::uint32_t t : cells_of(c.to)) {
            const auto normal = section_across(x, normal_of(s), y, normal_of(t));
            if (normal && meet_in_section(c, *normal, limit)) return true;
        }
    return false;
}

bool Ways::are_far(const NearPlaces& c, bool along_curves) const {
    const double limit = tuning.far_along * c.distance;
    const auto& points = complex_.points();
    using Step = std::pair<double, std::uint32_t>;
    std::priority_queue<Step, std::vector<Step>, std::greater<>> front;
    std::unordered_map<std::uint32_t, double> way;
    const auto reach = [&](std::uint32_t v, double d) {
        if (d > limit) return;
        const auto [at, is_new] = way.try_emplace(v, d);
        if (!is_new && at->second <= d) return;
        at->second = d;
        front.emplace(d, v);
    };
    const Point3 x = at(c.from), y = at(c.to);
    for (const std::uint32_t v : c.from.vertices()) reach(v, between(x, points[v]));
    while (!front.empty()) {
        const auto [d, v] = front.top();
        front.pop();
        if (d > way[v]) continue;
        const auto to = c.to.vertices();
        if (std::find(to.begin(), to.end(), v) != to.end() && d + between(points[v], y) < limit)
            return false;
        if (d + between(points[v], y) >= limit) continue; // no way on from here is short enough
        if (along_curves) {
            for (const std::uint32_t w : curves_.neighbours[v])
                reach(w, d + between(points[v], points[w]));
            continue;
        }
        for (const std::uint32_t t : complex_.star(v))
            for (const std::uint32_t w : complex_.cells()[t].corners)
                if (w != v) reach(w, d + between(points[v], points[w]));
    }
    return true;
}

bool Ways::are_far_along_surfaces(const NearPlaces& c) const {
    const double limit = tuning.far_along * c.distance;
    return !meet_at_edge(c, limit) && are_far(c, false) && !meet_in_a_section(c, limit);
}

bool Ways::are_far_along_curves(const NearPlaces& c) const {
    return are_far(c, true);
}

} // namespace terrane::simplification::detail
