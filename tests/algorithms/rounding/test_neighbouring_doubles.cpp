// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/neighbouring_doubles.hpp>

#include "support/rounded.hpp"

#include <catch2/catch.hpp>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/rounding/detail/tuning.hpp>
#include <terrane/kernel/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <random>
#include <set>
#include <vector>

namespace {

using namespace terrane;
using namespace terrane::rounding::detail;
using namespace test_support;

/// Triangles so far from the origin that the doubles are 1/64 of their unit apart.
Arrangement far_soup(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> coordinate(0, 8);
    Surface soup;
    for (std::uint32_t t = 0; t < 12; ++t) {
        for (int i = 0; i < 3; ++i)
            soup.vertices.push_back({0x1p+46 + coordinate(random) / 64.0,
                                     0x1p+46 + coordinate(random) / 64.0,
                                     0x1p+46 + coordinate(random) / 64.0});
        soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return arranged(std::vector{soup});
}

RoundingState at_nearest_doubles(const Arrangement& a) {
    RoundingState state;
    for (const PointIndex p : a.vertices) {
        state.input_vertices += p < a.state->points.input_count() ? 1 : 0;
        state.points.push_back(a.state->points.nearest(p));
    }
    state.move.assign(state.points.size(), 0);
    state.is_dirty.assign(state.points.size(), true);
    state.triangles = a.triangles;
    state.parents_of = a.parents_of;
    state.tidy({});
    return state;
}

bool have_overlapping_boxes(const RoundingState& s, const CandidatePair& p) {
    return box_of(s.points, s.triangles[p.first]).overlaps(box_of(s.points, s.triangles[p.second]));
}

bool meet_improperly(const RoundingState& s, const CandidatePair& p) {
    return improper_contact(s.points, s.triangles[p.first], s.triangles[p.second]).has_value();
}

bool is_corner(const RoundingState& s, std::uint32_t v, std::uint32_t t) {
    const Triangle& c = s.triangles[t];
    return c[0] == v || c[1] == v || c[2] == v;
}

double stepped(double x, int steps) {
    const double to = std::numeric_limits<double>::infinity() * (steps > 0 ? 1 : -1);
    for (int k = 0; k < std::abs(steps); ++k) x = std::nextafter(x, to);
    return x;
}

/// A vertex, and the pairs of its triangles with those whose boxes overlapped theirs before the search.
struct Vertex {
    std::uint32_t index;
    std::vector<CandidatePair> pairs{};
    std::set<std::uint32_t> corners{}; ///< all others of these triangles

    [[nodiscard]] std::size_t contacts(const RoundingState& s) const {
        return static_cast<std::size_t>(
            std::count_if(pairs.begin(), pairs.end(),
                          [&](const CandidatePair& p) { return meet_improperly(s, p); }));
    }

    /// Whether no triangle has lost its area, and no other corner is at the same place.
    [[nodiscard]] bool is_allowed(const RoundingState& s) const {
        for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
            const Triangle& c = s.triangles[t];
            if (is_corner(s, index, t) && collinear(s.points[c[0]], s.points[c[1]], s.points[c[2]]))
                return false;
        }
        return std::none_of(corners.begin(), corners.end(),
                            [&](std::uint32_t w) { return s.points[w] == s.points[index]; });
    }

    /// Returns the fewest contacts with any place that the search may choose.
    [[nodiscard]] std::size_t fewest(RoundingState s) const {
        const Point3 from = s.points[index];
        std::size_t least = contacts(s);
        constexpr int most = rounding_tuning.search_steps;
        for (int i = -most; i <= most; ++i)
            for (int j = -most; j <= most; ++j)
                for (int k = -most; k <= most; ++k) {
                    s.points[index] = {stepped(from.x, i), stepped(from.y, j), stepped(from.z, k)};
                    if (is_allowed(s)) least = std::min(least, contacts(s));
                }
        return least;
    }
};

std::vector<Vertex> vertices_of(const RoundingState& s, const std::vector<CandidatePair>& pairs,
                                const std::vector<CandidatePair>& contacts) {
    std::set<std::uint32_t> indices;
    for (const CandidatePair& p : contacts)
        for (const std::uint32_t t : {p.first, p.second})
            for (const std::uint32_t v : s.triangles[t])
                if (v >= s.input_vertices) indices.insert(v);
    std::vector<Vertex> found;
    for (const std::uint32_t v : indices) {
        Vertex vertex{v};
        for (const CandidatePair& p : pairs) {
            if (!is_corner(s, v, p.first) && !is_corner(s, v, p.second)) continue;
            vertex.pairs.push_back(p);
            for (const std::uint32_t t : {p.first, p.second})
                vertex.corners.insert(s.triangles[t].begin(), s.triangles[t].end());
        }
        vertex.corners.erase(v);
        found.push_back(vertex);
    }
    return found;
}

} // namespace

TEST_CASE("neighbouring doubles: in the end no vertex has a place near with fewer contacts",
          "[once]") {
    std::size_t searched = 0, moved = 0, left = 0;
    for (unsigned seed = 0; seed < 100; ++seed) {
        INFO("seed " << seed);
        auto state = at_nearest_doubles(far_soup(seed));
        std::vector<CandidatePair> pairs, contacts;
        for (std::uint32_t t = 0; t < state.triangles.size(); ++t)
            for (std::uint32_t u = t + 1; u < state.triangles.size(); ++u)
                if (have_overlapping_boxes(state, {t, u})) pairs.push_back({t, u});
        std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(contacts),
                     [&](const CandidatePair& p) { return meet_improperly(state, p); });
        if (contacts.empty() || contacts.size() > rounding_tuning.few) continue;
        ++searched;
        const auto before = state.points;
        const auto vertices = vertices_of(state, pairs, contacts);
        const bool any = search_neighbouring_doubles(state, contacts, {}, 1e300, {});
        CHECK(any == (before != state.points));
        moved += any;
        for (std::size_t v = 0; v < state.input_vertices; ++v) CHECK(state.points[v] == before[v]);
        for (const Vertex& v : vertices) {
            CHECK(v.is_allowed(state));
            CHECK(v.fewest(state) == v.contacts(state));
            left += v.contacts(state);
        }
        CHECK(std::count_if(pairs.begin(), pairs.end(), [&](const CandidatePair& p) {
                  return meet_improperly(state, p);
              }) <= std::ptrdiff_t(contacts.size()));
    }
    CHECK(searched > 80);
    CHECK(moved > 80);
    CHECK(left > 0); // some places are too crowded
}
