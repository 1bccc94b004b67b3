// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares pairs of surfaces with CGAL's corefinement in its exact kernel: the points, the number
// of triangles, the area.
#include "support/corefine_oracle.hpp"
#include "support/effort.hpp"
#include "support/points.hpp"

#include <catch2/catch.hpp>

#include <functional>

namespace {

using namespace terrane;
using namespace test_support;

/// Returns n x m squares over [0, n] x [0, m] with the given heights.
Surface height_field(int n, int m, const std::function<double(int, int)>& height) {
    Surface s;
    for (int j = 0; j <= m; ++j)
        for (int i = 0; i <= n; ++i) s.vertices.push_back({double(i), double(j), height(i, j)});
    for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i) {
            const auto v = static_cast<std::uint32_t>(j * (n + 1) + i);
            const auto up = v + static_cast<std::uint32_t>(n) + 1;
            s.triangles.push_back({v, v + 1, up});
            s.triangles.push_back({v + 1, up + 1, up});
        }
    return s;
}

enum class PairModel { two_horizons, horizon_and_fault, integer_heights, integer_fault, shifted };

/// Returns two surfaces, neither of which crosses itself: each is a graph over z = 0 or x = 0.
std::array<Surface, 2> random_pair(Random& random, PairModel model) {
    const bool integers = model == PairModel::integer_heights || model == PairModel::integer_fault;
    const auto height = [&](int, int) {
        return integers ? double(random_int(random, -1, 1)) : random_real(random, -0.4, 0.4);
    };
    const int n = random_int(random, 1, 6), m = random_int(random, 1, 6);
    std::array<Surface, 2> pair{height_field(n, m, height), height_field(n, m, height)};
    Surface& second = pair[1];
    if (model == PairModel::horizon_and_fault || model == PairModel::integer_fault) {
        const double off = integers ? random_int(random, 0, n) : random_real(random, 0.2, n - 0.2);
        const double down = integers ? random_int(random, 0, n) : random_real(random, 0.2, n - 0.2);
        for (Point3& p : second.vertices) p = {p.z + off, p.y, p.x - down};
    }
    if (model == PairModel::shifted)
        for (Point3& p : second.vertices) p = {p.x + 0.3, p.y - 0.7, p.z + 0.1};
    return pair;
}

} // namespace

TEST_CASE("pairs of surfaces: the points, triangles and areas of CGAL's corefinement") {
    Random random(91);
    int crossing = 0;
    for (const PairModel model :
         {PairModel::two_horizons, PairModel::horizon_and_fault, PairModel::integer_heights,
          PairModel::integer_fault, PairModel::shifted})
        for (int i = 0; i < cases(160); ++i) {
            const auto pair = random_pair(random, model);
            const auto arranged = arrange(pair);
            REQUIRE(arranged);
            INFO("model " << static_cast<int>(model) << ", pair " << i);
            const auto outcome = corefine_oracle::compare(pair, arranged.value());
            REQUIRE(outcome.flaw == "");
            crossing += outcome.crossing > 0;
        }
    CHECK(crossing >= cases(600));
}
