// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/long_edges.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include <catch2/catch.hpp>

#include "support/loops.hpp"
#include "support/shapes.hpp"
#include <terrane/algorithms/mesh/vectors.hpp>

using namespace terrane;
using namespace terrane::rbf::detail;
using namespace test_support;

namespace {

double area(const RbfData& data) {
    double sum = 0;
    for (const Triangle& t : data.triangles) {
        const Point3 n = cross(minus(data.points[t[1]], data.points[t[0]]),
                               minus(data.points[t[2]], data.points[t[0]]));
        sum += std::hypot(n.x, n.y, n.z) / 2;
    }
    return sum;
}

/// Counts for each directed edge the triangles along it.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides(const RbfData& data) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
    for (const Triangle& t : data.triangles)
        for (unsigned k = 0; k < 3; ++k) ++count[{t[k], t[(k + 1) % 3]}];
    return count;
}

double longest_near(const RbfData& data, double near) {
    double longest = 0;
    for (const auto& [edge, times] : sides(data)) {
        if (std::max(data.distances[edge.first], data.distances[edge.second]) > near) continue;
        const Point3 d = minus(data.points[edge.first], data.points[edge.second]);
        longest = std::max(longest, std::hypot(d.x, d.y, d.z));
    }
    return longest;
}

} // namespace

TEST_CASE("rbf: long edges near a border are divided, and the surface does not change", "[rbf]") {
    const Surface s = cliff(100);
    const auto data = collect_data(s, hole_of(s), {}, {});
    REQUIRE(data);
    RbfData divided = data.value();
    const double near = 30, limit = 15;
    CHECK(longest_near(divided, near) > 90);
    divide_long_edges(divided, limit, near);
    CHECK(longest_near(divided, near) <= limit);
    CHECK(area(divided) == Approx(area(data.value())).epsilon(1e-12));
    CHECK(divided.distances.size() == divided.points.size());
    const auto count = sides(divided);
    std::size_t open = 0;
    for (const auto& [edge, times] : count) {
        CHECK(times == 1); // oriented as before, and conforming
        open += count.count({edge.second, edge.first}) == 0 ? 1 : 0;
    }
    std::size_t open_before = 0;
    const auto before = sides(data.value());
    for (const auto& [edge, times] : before)
        open_before += before.count({edge.second, edge.first}) == 0 ? 1 : 0;
    // The border is one ring of border edges; the old points keep their order among the new ones.
    const std::size_t border = divided.next.size(), had = data.value().next.size();
    CHECK(open - border == open_before - had); // the outer end of the data is far and not divided
    CHECK(border >= had + 10);
    std::uint32_t v = 0;
    std::size_t steps = 0, met = 0;
    do {
        const bool along =
            count.count({v, divided.next[v]}) + count.count({divided.next[v], v}) == 1;
        CHECK(along);
        CHECK(divided.distances[v] == 0);
        if (met < had && divided.points[v] == data.value().points[met]) ++met;
        v = divided.next[v];
        ++steps;
    } while (v != 0 && steps <= border);
    CHECK(steps == border);
    CHECK(met == had);
}

TEST_CASE("rbf: short edges and edges far from the border are not divided", "[rbf]") {
    const Surface s = cliff(100);
    const auto data = collect_data(s, hole_of(s), {}, {});
    REQUIRE(data);
    RbfData same = data.value();
    divide_long_edges(same, 120, 30);
    CHECK((same.points == data.value().points));
    CHECK((same.triangles == data.value().triangles));
    CHECK((same.next == data.value().next));
    divide_long_edges(same, 15, -1);
    CHECK((same.points == data.value().points));
}
