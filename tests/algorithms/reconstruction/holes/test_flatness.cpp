// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/holes/flatness.hpp>

#include <array>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>

using namespace terrane;
using detail::flatness_outweighs;
using detail::some_inner_edges;

namespace {

/// Builds an open fan of `n` triangles around vertex 0, which has n - 1 inner edges.
std::vector<Triangle> fan_of(std::uint32_t n) {
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 1; i <= n; ++i) triangles.push_back({0, i, i + 1});
    return triangles;
}

} // namespace

TEST_CASE("flatness: only edges of two triangles are inner edges", "[fill]") {
    const auto fan = fan_of(4);
    CHECK(some_inner_edges(fan, 6, 10) == std::vector<Edge>{{0, 2}, {0, 3}, {0, 4}});
    CHECK(some_inner_edges({}, 0, 10).empty());
    CHECK(some_inner_edges(std::span(fan).first(1), 6, 10).empty());
}

TEST_CASE("flatness: at most the wanted number of edges is selected, from all parts", "[fill]") {
    CHECK(some_inner_edges(fan_of(101), 103, 4) ==
          std::vector<Edge>{{0, 2}, {0, 27}, {0, 52}, {0, 77}});
}

TEST_CASE("flatness: sags are compared with expected errors and with rounding", "[fill]") {
    const std::array sags{3.0, -4.0, 0.0, 0.0}; // root mean square 2.5
    CHECK(flatness_outweighs(sags, std::array{2.4, 2.4, 2.4, 2.4}, 1));
    CHECK(!flatness_outweighs(sags, std::array{2.6, 2.6, 2.6, 2.6}, 1));
    CHECK(!flatness_outweighs(sags, std::array{0.0, 0.0, 6.0, 0.0}, 1)); // mean squares, not means
    CHECK(flatness_outweighs(sags, std::array{0.0, 0.0, 0.0, 0.0}, 2.4e6));
    CHECK(!flatness_outweighs(sags, std::array{0.0, 0.0, 0.0, 0.0}, 2.6e6)); // rounding
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    CHECK(!flatness_outweighs(sags, std::array{0.0, 0.0, 0.0, unknown}, 1));
    CHECK(!flatness_outweighs({}, {}, 1));
}
