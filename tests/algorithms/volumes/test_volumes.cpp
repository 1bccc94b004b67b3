// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests cases small enough for the answer to be known; the oracle judges each of them as well.
#include <terrane/algorithms/volumes/volumes.hpp>

#include <algorithm>
#include <cmath>
#include <stop_token>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <gmpxx.h>

#include "support/exact_numbers.hpp"
#include "support/found_volumes.hpp"
#include "support/solids.hpp"
#include "support/volume_oracle.hpp"
#include <terrane/algorithms/rounding/rounding.hpp>

using namespace terrane;
using namespace test_support;

namespace {

/// Arranges the surfaces, finds the volumes, and has the oracle judge them.
Found find(const std::vector<Surface>& surfaces) {
    Found found = find_in(surfaces);
    const auto& [arrangement, volumes] = found;
    const VolumeOracle judge(arrangement);
    CHECK(volumes.block_count() == judge.block_count());
    const auto exact = test_support::exact_numbers(arrangement, volumes);
    const auto expected = judge.measures(volumes);
    mpq_class sum;
    for (std::size_t v = 0; v < exact.size(); ++v) {
        CHECK(exact[v] == expected[v]);
        if (v > 0) sum += exact[v];
    }
    CHECK(sum == exact[0]);
    CHECK(std::isinf(volumes.measures[0])); // the outside has no end
    std::mt19937_64 random(1);
    for (int i = 0; i < 20; ++i) CHECK(judge.flaw_on_segment(volumes, random).empty());
    return found;
}

std::vector<double> sorted_measures(const Volumes& volumes) {
    std::vector<double> blocks(volumes.measures.begin() + 1, volumes.measures.end());
    std::sort(blocks.begin(), blocks.end());
    return blocks;
}

std::size_t dangling(const Volumes& volumes) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < volumes.of_sides.size(); ++t) count += volumes.dangles(t) ? 1 : 0;
    return count;
}

using Blocks = std::vector<double>;

} // namespace

TEST_CASE("volumes: a cube has an inside and an outside", "[volumes]") {
    const auto [a, v] = find({cube(0, 2)});
    REQUIRE(v.block_count() == 1);
    CHECK(v.measures == Blocks{HUGE_VAL, 8});
    CHECK(v.total == 8);
    for (const auto& sides : v.of_sides) CHECK(sides == std::array<std::uint32_t, 2>{0, 1});
    CHECK(exact_volumes(a, v).measures == std::vector<std::string>{"", "8"});
    CHECK(exact_volumes(a, v).total == "8");
}

TEST_CASE("volumes: wound inward, the inside is in front", "[volumes]") {
    Surface inward = cube(0, 2);
    for (Triangle& t : inward.triangles) std::swap(t[0], t[1]);
    const auto found = find({inward});
    CHECK(found.volumes.measures == Blocks{HUGE_VAL, 8});
    for (const auto& sides : found.volumes.of_sides)
        CHECK(sides == std::array<std::uint32_t, 2>{1, 0});
}

TEST_CASE("volumes: nothing gives nothing, an open surface no block", "[volumes]") {
    CHECK(find_volumes(Mesh{}).value().block_count() == 0);
    for (const Surface& s : {level(0, 0, 0, 1, 1), moebius_strip()}) {
        const auto found = find({s});
        CHECK(found.volumes.block_count() == 0);
        CHECK(dangling(found.volumes) == found.arrangement.triangles.size());
        CHECK(found.volumes.total == 0);
    }
}

TEST_CASE("volumes: cubes within cubes", "[volumes]") {
    const auto found = find({cube(1, 9, "b"), cube(3, 4, "d"), cube(0, 10, "a"), cube(2, 6, "c")});
    CHECK(sorted_measures(found.volumes) == Blocks{1, 63, 448, 488});
    CHECK(found.volumes.total == 1000);
    CHECK(found.volumes.measures[1] == 488); // blocks are ordered by their least vertex
    CHECK(found.volumes.measures[4] == 1);
}

TEST_CASE("volumes: two cubes side by side in a third", "[volumes]") {
    const auto found =
        find({cube(0, 10), cube(1, 2), box({5, 1, 1}, {6, 2, 2}), box({1, 7, 7}, {2, 9, 9})});
    CHECK(sorted_measures(found.volumes) == Blocks{1, 1, 4, 994});
}

TEST_CASE("volumes: cubes that touch", "[volumes]") {
    SECTION("in a face, half a face, an edge, half an edge, a corner") {
        for (const Surface& other :
             {box({1, 0, 0}, {2, 1, 1}), box({1, 0, 0.5}, {2, 1, 1.5}), box({1, 1, 0}, {2, 2, 1}),
              box({1, 1, 0.5}, {2, 2, 1.5}), box({1, 1, 1}, {2, 2, 2})}) {
            const auto found = find({cube(0, 1), other});
            CHECK(sorted_measures(found.volumes) == Blocks{1, 1});
            CHECK(dangling(found.volumes) == 0);
        }
    }
    SECTION("a corner from inside") {
        const auto found = find({cube(0, 4), cube(0, 1), cube(3, 4)});
        CHECK(sorted_measures(found.volumes) == Blocks{1, 1, 62});
    }
    SECTION("a vertex in the middle of a face, from inside and outside") {
        const auto found = find({cube(0, 4), octahedron({2, 2, 3}, 1), octahedron({2, 2, 5}, 1)});
        CHECK(sorted_measures(found.volumes)[2] == Approx(64 - 4.0 / 3));
        CHECK(found.volumes.block_count() == 3);
    }
    SECTION("eight around a point") {
        std::vector<Surface> cubes;
        for (unsigned i = 0; i < 8; ++i) {
            const Point3 low{(i & 1U) != 0 ? 0.0 : -1.0, (i & 2U) != 0 ? 0.0 : -1.0,
                             (i & 4U) != 0 ? 0.0 : -1.0};
            cubes.push_back(box(low, {low.x + 1, low.y + 1, low.z + 1}));
        }
        CHECK(sorted_measures(find(cubes).volumes) == Blocks(8, 1.0));
    }
}

TEST_CASE("volumes: cubes that overlap", "[volumes]") {
    CHECK(sorted_measures(find({cube(0, 2), cube(1, 3)}).volumes) == Blocks{1, 7, 7});
    CHECK(sorted_measures(find({cube(0, 2), cube(0, 2), cube(0, 2)}).volumes) == Blocks{8});
    CHECK(sorted_measures(find({cube(0, 2), box({0, 0, 1}, {2, 2, 3})}).volumes) ==
          Blocks{4, 4, 4});
    CHECK(sorted_measures(find({cube(0, 4), box({1, 1, -1}, {3, 3, 5})}).volumes) ==
          Blocks{4, 4, 16, 48});
}

TEST_CASE("volumes: a fault that ends inside dangles, one that goes through parts", "[volumes]") {
    const auto fault = [](double reach) {
        return quad({2, -1, -1}, {2, reach, -1}, {2, reach, 5}, {2, -1, 5}, "fault");
    };
    const auto tip = find({cube(0, 4), fault(2)});
    CHECK(tip.volumes.measures == Blocks{HUGE_VAL, 64});
    CHECK(dangling(tip.volumes) > 0);
    const auto through = find({cube(0, 4), fault(5)});
    CHECK(through.volumes.measures == Blocks{HUGE_VAL, 32, 32});
    const auto free = find({cube(0, 4), quad({1, 1, 1}, {2, 1, 1}, {2, 2, 2}, {1, 2, 2})});
    CHECK(free.volumes.block_count() == 1);
    CHECK(dangling(free.volumes) == 2);
    for (std::size_t t = 0; t < free.volumes.of_sides.size(); ++t)
        if (free.volumes.dangles(t)) CHECK(free.volumes.of_sides[t][0] == 1);
}

TEST_CASE("volumes: sheets that meet in X, T and Y", "[volumes]") {
    const auto wall = [](Point3 a, Point3 b) {
        return quad({a.x, a.y, -1}, {b.x, b.y, -1}, {b.x, b.y, 5}, {a.x, a.y, 5});
    };
    const Surface around = cube(0, 4);
    CHECK(sorted_measures(
              find({around, wall({2, -1, 0}, {2, 5, 0}), wall({-1, 2, 0}, {5, 2, 0})}).volumes) ==
          Blocks{16, 16, 16, 16});
    CHECK(sorted_measures(
              find({around, wall({2, -1, 0}, {2, 5, 0}), wall({2, 2, 0}, {5, 2, 0})}).volumes) ==
          Blocks{16, 16, 32});
    CHECK(sorted_measures(find({around, wall({2, 2, 0}, {2, 5, 0}), wall({2, 2, 0}, {-1, -1, 0}),
                                wall({2, 2, 0}, {5, -1, 0})})
                              .volumes) == Blocks{16, 24, 24});
}

TEST_CASE("volumes: rings", "[volumes]") {
    const Surface ring = torus({0, 0, 0}, 4, 1, 12);
    const auto one = find({ring});
    CHECK(one.volumes.block_count() == 1);
    const auto linked = find({ring, torus({4, 0, 0}, 4, 1, 12, 1, "other")});
    CHECK(linked.volumes.block_count() == 2);
    CHECK(linked.volumes.measures[1] == Approx(linked.volumes.measures[2]));
    const auto boxed =
        find({torus({4, 0, 0}, 4, 1, 12, 1, "other"), ring, box({-9, -9, -9}, {9, 9, 9})});
    CHECK(boxed.volumes.block_count() == 3);
    const auto within = find({ring, cube(-1, 1), torus({0, 0, 0}, 4, 0.5, 12)});
    CHECK(within.volumes.block_count() == 3);
}

TEST_CASE("volumes: layers and a fault in a box", "[volumes]") {
    std::vector<Surface> model{box({0, 0, 0}, {8, 8, 8}, "box")};
    for (const double z : {2.0, 4.0, 5.0}) model.push_back(level(z, -1, -1, 9, 9));
    model.push_back(quad({3, -1, -1}, {3, 9, -1}, {7, 9, 9}, {7, -1, 9}, "fault"));
    const auto found = find(model);
    CHECK(found.volumes.block_count() == 8);
    CHECK(found.volumes.total == 512);
}

TEST_CASE("volumes: volumes that no double holds are rounded correctly", "[volumes]") {
    const auto found =
        find({cube(0, 1), quad({-1, -1, 0.1}, {2, -1, 0.2}, {2, 2, 0.7}, {-1, 2, 0.6})});
    const auto exact = test_support::exact_numbers(found.arrangement, found.volumes);
    for (std::size_t v = 0; v < exact.size(); ++v) {
        const double measure = v == 0 ? found.volumes.total : found.volumes.measures[v];
        const mpq_class is(measure), should(exact[v]);
        const double up = std::nextafter(measure, HUGE_VAL),
                     down = std::nextafter(measure, -HUGE_VAL);
        CHECK(abs(is - should) <= abs(mpq_class(up) - should));
        CHECK(abs(is - should) <= abs(mpq_class(down) - should));
    }
    // A tie between two doubles, rounded to even, which only the exact sum can decide.
    const double ulp = std::ldexp(1.0, -52);
    CHECK(find({box({0, 0, 0}, {1 + ulp, 1 + ulp, 1})}).volumes.measures[1] == 1 + 2 * ulp);
    const auto tie = find({box({0, 0, 0}, {1, 1, 1}), box({2, 0, 0}, {3, ulp / 2, 1})});
    CHECK(tie.volumes.total == 1);
}

TEST_CASE("volumes: coordinates near the ends of double's range", "[volumes]") {
    for (const double size : {0x1p-340, 0x1p+300}) {
        const auto found = find({cube(0, size), cube(size / 4, size / 2)});
        CHECK(found.volumes.total == size * size * size);
    }
    CHECK(find({cube(0, 0x1p+600)}).volumes.measures[1] == HUGE_VAL);
    CHECK(find({cube(0, 0x1p-600)}).volumes.measures[1] == 0);
}

TEST_CASE("volumes: blocks as thin as doubles can be", "[volumes]") {
    // For some of these, the double nearest to the centroid of a face lies outside the face.
    const double ulp = std::ldexp(1.0, -52);
    for (unsigned k = 0; k < 8; ++k) {
        const double x = (k & 1U) != 0 ? 1 : -1, y = (k & 2U) != 0 ? 1 : -1,
                     z = (k & 4U) != 0 ? 1 : -1;
        const auto at = [&](double i, double j, double l) {
            return Point3{x * (1 + i * ulp), y * (1 + j * ulp), z * (1 + l * ulp)};
        };
        const auto thin = tetrahedron(at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, 1));
        const auto needle = tetrahedron(at(4, 4, 4), at(5, 4, 4), at(5, 6, 4), at(7, 9, 5));
        const auto found = find({cube(-2, 2), thin, needle});
        CHECK(found.volumes.block_count() == 3);
        CHECK(sorted_measures(found.volumes)[1] == ulp * ulp * ulp / 3);
    }
}

TEST_CASE("volumes: a mesh of doubles gives the same as the arrangement", "[volumes]") {
    const auto found = find({cube(0, 4), octahedron({3, 3, 3}, 1.5), cube(1, 2),
                             quad({0.3, -1, -1}, {0.9, 9, -1}, {0.7, 9, 9}, {0.1, -1, 9})});
    const auto rounded = round_to_doubles(found.arrangement);
    REQUIRE(rounded);
    REQUIRE(rounded.value().report.clean);
    const Mesh& mesh = rounded.value().mesh;
    const auto of_mesh = find_volumes(mesh);
    REQUIRE(of_mesh);
    CHECK(of_mesh.value().of_sides == found.volumes.of_sides);
    for (std::size_t v = 1; v < found.volumes.measures.size(); ++v)
        CHECK(of_mesh.value().measures[v] == Approx(found.volumes.measures[v]).epsilon(1e-14));
    CHECK(of_mesh.value().total == Approx(found.volumes.total).epsilon(1e-14));
    const auto exact = test_support::exact_numbers(mesh, of_mesh.value());
    mpq_class sum;
    for (std::size_t v = 1; v < exact.size(); ++v) sum += exact[v];
    CHECK(sum == exact[0]);
    const auto match = match_volumes(found.arrangement, found.volumes, mesh, of_mesh.value());
    for (std::uint32_t v = 0; v < match.size(); ++v) CHECK(match[v] == v);
}

TEST_CASE("volumes: errors", "[volumes]") {
    const auto arrangement = arrange(std::vector{cube(0, 1)});
    std::stop_source stop;
    stop.request_stop();
    CHECK(find_volumes(arrangement.value(), {.stop = stop.get_token()}).error().code ==
          ErrorCode::interrupted);
    Mesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 3}};
    CHECK(find_volumes(mesh).error().code == ErrorCode::bad_index);
    mesh.triangles = {{0, 1, 2}};
    mesh.vertices[2].z = std::nan("");
    CHECK(find_volumes(mesh).error().code == ErrorCode::bad_number);
    mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 1, 4}, {0, 1, 2}, {0, 1, 3}}; // the last two overlap
    CHECK(find_volumes(mesh).error().code == ErrorCode::internal);
}
