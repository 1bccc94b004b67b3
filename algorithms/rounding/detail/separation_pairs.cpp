// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/separation_pairs.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane::rounding::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Positions of a vertex relative to a plane. A part leaves the plane to one side if all corners
// that do not rest on it are above, or all are below.
constexpr std::uint8_t rests = 0, above = 1, below = 2, neither = 3;
constexpr std::uint8_t unknown = 0xff;

/// Returns the height to which the other corners must rise if a part leaves g at a vertex; infinity
/// if the vertex is not well conditioned.
double least_rise(const Sizes& there, double longest, double d) {
    const double l = std::max(there.longest, longest);
    if (!Sizes{there.altitude, l}.is_well_conditioned(d)) return infinity;
    const double ratio = l / there.altitude;
    return rise_factor * d * ratio * ratio;
}

/// A part that passes the end of a line on which two faces cross has corners above and below.
/// The functional that measures the distance e beyond the edge is therefore rotated about the edge
/// towards the height h, until two corners have equal values. All corners `before` the edge must
/// rise by more than `least` on the same side.
template <class Leaves>
bool leaves_turned(const std::array<double, 3>& e, const std::array<double, 3>& h,
                   const std::array<bool, 3>& before, double least, const Leaves& leaves) {
    bool up = true, down = true;
    for (unsigned i = 0; i < 3; ++i)
        if (before[i]) {
            up = up && h[i] > least;
            down = down && h[i] < -least;
        }
    for (unsigned i = 0; i < 3 && (up || down); ++i) {
        const unsigned j = (i + 1) % 3;
        const double across = h[j] - h[i], along = e[i] - e[j];
        const double size = std::copysign(std::sqrt(across * across + along * along), across);
        const double c = across / size, s = along / size;
        if (leaves(c * e[0] + s * h[0], c * e[1] + s * h[1], c * e[2] + s * h[2])) return true;
    }
    return false;
}

/// Whether a ball is so far from a plane that the computed heights of its points exceed d. They and
/// that of the centre err by less than d / 16: see margin.
bool is_far(const Ball& ball, double lift, double d) {
    return lift - ball.radius > 2 * d;
}

/// Returns one bit for each edge of g, set if p lies beyond the edge by more than d.
std::uint8_t edges_before(const std::array<Functional, 3>& beyond, const Point3& p, double d) {
    unsigned edges = 0;
    for (unsigned j = 0; j < 3; ++j)
        if (beyond[j](p) > d) edges |= 1u << j;
    return static_cast<std::uint8_t>(edges);
}

} // namespace

PairProver::Pair PairProver::pair_of(std::uint32_t f_slot, std::uint32_t g_slot) const {
    const Face &f = faces_.faces[f_slot], &g = faces_.faces[g_slot];
    return {f_slot,
            g_slot,
            f,
            g,
            faces_.margin(f, g),
            g.height(),
            {g.beyond(0), g.beyond(1), g.beyond(2)}};
}

/// Returns the vertex of g at a vertex of f, or none.
std::uint32_t PairProver::vertex_of_g(const Pair& pair, std::uint32_t v) const {
    const std::uint32_t point = faces_.vertices[v];
    return pair.g_slot == marked_.slot() ? marked_.find(point) : faces_.find(pair.g_slot, point);
}

/// Whether a part of f is one of g, too. Of two parts of g, statement (5) tells.
bool PairProver::is_part_of_g(const Pair& pair, std::uint32_t e) const {
    const auto faces = moved_.faces_of[faces_.parts[e]];
    return faces.size() > 1 &&
           std::binary_search(faces.begin(), faces.end(), faces_.names[pair.g_slot]);
}

/// Tests statements (3) and (4) for a part of f with all functionals.
bool PairProver::is_clear(const Pair& pair, const Triangle& part) const {
    const double d = pair.d;
    std::array<Point3, 3> at;
    std::array<bool, 3> on{}; // whether the corner is a vertex of g
    std::array<std::uint32_t, 3> there{};
    double longest = infinity;
    for (unsigned i = 0; i < 3; ++i) {
        there[i] = vertex_of_g(pair, part[i]);
        on[i] = there[i] != none;
        at[i] = faces_.places[part[i]];
        longest = std::min(longest, faces_.sizes[part[i]].longest); // >= the part's longest edge
    }
    double least = d; // corners off g must rise above this height
    for (unsigned i = 0; i < 3; ++i)
        if (on[i]) least = std::max(least, least_rise(faces_.sizes[there[i]], longest, d));
    if (std::isinf(least)) return false;
    const auto leaves = [&](double a, double b, double c) {
        const bool rests_a = on[0] && std::fabs(a) <= d / 2,
                   rests_b = on[1] && std::fabs(b) <= d / 2,
                   rests_c = on[2] && std::fabs(c) <= d / 2;
        return (rests_a || a > least) && (rests_b || b > least) && (rests_c || c > least) &&
               !(rests_a && rests_b && rests_c);
    };
    const Functional& height = pair.height;
    const std::array<double, 3> h{height(at[0]), height(at[1]), height(at[2])};
    if (leaves(h[0], h[1], h[2]) || leaves(-h[0], -h[1], -h[2])) return true;
    for (const Functional& u : pair.beyond) {
        const std::array<double, 3> e{u(at[0]), u(at[1]), u(at[2])};
        if (leaves(e[0], e[1], e[2])) return true;
        std::array<bool, 3> before{};
        for (unsigned i = 0; i < 3; ++i)
            before[i] = e[i] <= least && !(on[i] && std::fabs(e[i]) <= d / 2);
        if (leaves_turned(e, h, before, least, leaves)) return true;
    }
    return false;
}

/// Classifies the vertices of f: above the plane of g, below it, resting on a vertex of g, or
/// neither. Those of clusters that are far from the plane stay unknown. Returns true if every
/// vertex that rises rises enough for all vertices that rest.
bool PairProver::find_sides(const Pair& pair) {
    const std::uint32_t first = pair.f.vertex, count = pair.f.vertex_end - first;
    auto& sides = sides_;
    auto& low = low_;
    low.resize(count);
    const Point3* place = faces_.places.data() + first;
    const Functional height = pair.height;
    const double d = pair.d;
    double least_lift = infinity, most_rise = 0;
    std::uint32_t lows = 0;
    const auto classify = [&](std::uint32_t k) { // avoids branches, which would be mispredicted
        const double u = height(place[k]), lift = std::fabs(u);
        sides[k] = static_cast<std::uint8_t>(neither - (u > d ? below : 0) - (u < -d ? above : 0));
        least_lift = std::min(least_lift, lift > d ? lift : least_lift);
        low[lows] = k;
        lows += lift > d ? 0 : 1;
    };
    const FaceClusters* const clusters = clusters_of(pair.f);
    far_.clear();
    if (clusters == nullptr) {
        sides.resize(count);
        for (std::uint32_t k = 0; k < count; ++k) classify(k);
    } else {
        sides.assign(count, unknown);
        const auto& [members, balls] = clusters->vertices;
        for (std::uint32_t c = 0; c < balls.size(); ++c) {
            if (is_far(balls[c], std::fabs(height(balls[c].centre)), d))
                far_.push_back(c);
            else
                for (const std::uint32_t v : members[c]) classify(v - first);
        }
    }
    for (std::uint32_t n = 0; n < lows; ++n) {
        const std::uint32_t k = low[n];
        const std::uint32_t there = vertex_of_g(pair, first + k);
        if (there == none || !(std::fabs(height(place[k])) <= d / 2)) continue;
        sides[k] = rests;
        most_rise = std::max(most_rise,
                             least_rise(faces_.sizes[there], faces_.sizes[first + k].longest, d));
    }
    if (!(least_lift > most_rise)) return false;
    for (const std::uint32_t c : far_) {
        const Ball& ball = clusters->vertices.balls[c];
        if (std::fabs(height(ball.centre)) - ball.radius - d > most_rise) continue;
        for (const std::uint32_t v : clusters->vertices.members[c])
            if (!(std::fabs(height(faces_.places[v])) > most_rise)) return false;
    }
    return true;
}

/// Finds the parts of f that may meet parts of g improperly. Most parts lie on one side of the
/// plane of g, or leave it at common vertices.
void PairProver::find_left(const Pair& pair, std::vector<std::uint32_t>& left) {
    left.clear();
    const bool all_leave = find_sides(pair);
    const std::uint32_t first = pair.f.vertex;
    auto& sides = sides_;
    const auto side = [&](std::uint32_t v) -> unsigned {
        std::uint8_t& s = sides[v - first];
        if (s == unknown) s = pair.height(faces_.places[v]) > 0 ? above : below;
        return s;
    };
    const auto is_doubtful = [&](const Triangle& c) {
        const unsigned i = side(c[0]), j = side(c[1]), k = side(c[2]);
        const unsigned together = i | j | k;
        const bool both_sides = together == neither || together == rests;
        const bool any_rests = i == rests || j == rests || k == rests;
        return both_sides || (any_rests && !all_leave);
    };
    beyond_.assign(sides.size(), unknown);
    const auto beyond = [&](std::uint32_t v) {
        std::uint8_t& edges = beyond_[v - first];
        if (edges == unknown) edges = edges_before(pair.beyond, faces_.places[v], pair.d);
        return edges;
    };
    const auto test = [&](std::uint32_t e) {
        const Triangle& c = faces_.corners[e];
        if (is_doubtful(c) && (beyond(c[0]) & beyond(c[1]) & beyond(c[2])) == 0 &&
            !is_part_of_g(pair, e) && !is_clear(pair, c))
            left.push_back(e);
    };
    const FaceClusters* const clusters = clusters_of(pair.f);
    if (clusters == nullptr) {
        for (std::uint32_t e = pair.f.part; e < pair.f.part_end; ++e) test(e);
        return;
    }
    const auto& [members, balls] = clusters->parts;
    for (std::size_t c = 0; c < balls.size(); ++c)
        if (!is_far(balls[c], std::fabs(pair.height(balls[c].centre)), pair.d))
            for (const std::uint32_t e : members[c]) test(e);
}

/// Adds the pairs whose boxes overlap if they are few; else the parts of the face with fewer parts
/// left.
void PairProver::add_pairs(Unproven& found) {
    const auto &f = left_, &g = left_back_;
    if (f.empty() || g.empty()) return;
    constexpr std::size_t few = 4096;
    if (f.size() * g.size() > few) {
        for (const std::uint32_t e : f.size() < g.size() ? f : g)
            found.parts.push_back(faces_.parts[e]);
        return;
    }
    const BoxSource boxes(moved_.points, moved_.parts);
    boxes_.clear();
    for (const std::uint32_t h : g) boxes_.push_back(boxes[faces_.parts[h]]);
    for (const std::uint32_t e : f) {
        const std::uint32_t a = faces_.parts[e];
        const Box box = boxes[a];
        for (std::size_t k = 0; k < g.size(); ++k) {
            const std::uint32_t b = faces_.parts[g[k]];
            if (box.overlaps(boxes_[k]) && a != b)
                found.pairs.push_back({std::min(a, b), std::max(a, b)});
        }
    }
}

void PairProver::operator()(std::uint32_t g, std::uint32_t f, Unproven& found) {
    marked_.mark(faces_, g);
    find_left(pair_of(f, g), left_);
    if (left_.empty()) return;
    find_left(pair_of(g, f), left_back_);
    add_pairs(found);
}

} // namespace terrane::rounding::detail
