// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests verticals where surfaces meet on them, against verticals nearby, and heights in slivers against planes whose
// heights there are doubles.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <terrane/algorithms/maps/maps.hpp>
#include <terrane/algorithms/maps/verticals.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

#include "algorithms/sections/sections_of_models.hpp"

using namespace terrane;
using namespace test_support;

namespace {

/// A square about the origin of the map in the plane z = a x + b y.
Surface square(double a, double b, double east) {
    Surface s{"plane", Role::horizon, {}, {{0, 1, 2}, {0, 2, 3}}};
    for (const auto& [x, y] : {std::pair{-5.0, -5.0}, {5.0, -5.0}, {5.0, 5.0}, {-5.0, 5.0}})
        s.vertices.push_back({east + x, y, a * x + b * y});
    return s;
}

SectionModel planes_through_a_point(std::mt19937& random, double east) {
    std::vector<Surface> surfaces;
    const auto slope = [&] { return double(random() % 5) - 2; };
    for (unsigned k = 0; k < 3; ++k) surfaces.push_back(square(slope(), slope(), east));
    const auto box = box_boundary({east - 4, -4, -40}, {east + 4, 4, 40});
    REQUIRE(box);
    return section_model(std::move(surfaces), *box);
}

double height_of(const std::array<Point3, 3>& t, const Point3& p) {
    return VerticalHeight(t, p).z();
}

} // namespace

TEST_CASE("verticals: blocks are in order where surfaces meet, as they are nearby", "[maps]") {
    std::mt19937 random(7);
    for (unsigned k = 0; k < 24; ++k) {
        const double east = k % 2 == 0 ? 0 : 500000;
        const auto model = planes_through_a_point(random, east);
        const Grid grid{"", east - 4, -4, 9, 9, 1, 1, 0, {}};
        const Grid near{"", grid.x + 0x1p-12, grid.y + 0x1p-22, 9, 9, 1, 1, 0, {}};
        std::vector<double> sums(81);
        for (std::uint32_t b = 1; b < model.volumes.measures.size(); ++b) {
            const std::vector<BlockId> block{BlockId(b)};
            const auto map = map_blocks(model.mesh, model.volumes, block, grid);
            const auto moved = map_blocks(model.mesh, model.volumes, block, near);
            REQUIRE(map);
            REQUIRE(moved);
            for (std::size_t n = 0; n < 81; ++n) {
                sums[n] += map->values[n];
                if (n % 9 == 8 || n / 9 == 8) continue; // moved out of the box
                CHECK(map->values[n] == Approx(moved->values[n]).margin(0.01));
            }
        }
        for (const double sum : sums) CHECK(sum == Approx(80).epsilon(1e-12));
    }
}

TEST_CASE("verticals: heights in slivers, far away and among the smallest doubles", "[maps]") {
    // In the plane z = 3 x - 2 y.
    for (const int thin : {10, 30, 40}) {
        const double d = std::ldexp(1.0, -thin);
        const std::array t{Point3{0, 0, 0}, Point3{1000, 700, 1600},
                           Point3{500, 350 + d, 800 - 2 * d}};
        CHECK(height_of(t, {500, 350 + d / 2, 0}) == 800 - d);
        CHECK(height_of({t[2], t[0], t[1]}, {500, 350 + d / 2, 0}) == 800 - d);
    }
    for (const double scale : {0x1p-1000, 0x1p-500, 0x1p400, 0x1p1000}) {
        const std::array t{Point3{0, 0, 0}, Point3{4 * scale, 0, 0},
                           Point3{0, 4 * scale, 4 * scale}};
        CHECK(height_of(t, {scale, 2 * scale, 0}) == 2 * scale);
        const auto [x, y] = fall_of(t);
        CHECK(x == 0);
        CHECK(y == -1);
    }
}

TEST_CASE("verticals: heights compare exactly, also where doubles do not tell", "[maps]") {
    const std::array flat{Point3{0, 0, 1}, Point3{4, 0, 1}, Point3{0, 4, 1}};
    const std::array steep{Point3{0, 0, 1}, Point3{3, 0, 1}, Point3{0, 3, 4}};
    const std::array higher{Point3{0, 0, 1}, Point3{0, 3, 1}, Point3{3, 0, 1 + 0x1p-50}};
    const Point3 p{1, 0, 0}, q{1, 1, 0};
    const auto at = [](const auto& t, const Point3& place) { return VerticalHeight(t, place); };
    CHECK(at(flat, p).compare(at(steep, p)) == Sign::Zero);
    CHECK(at(flat, p).compare(at(steep, p), {1, 1}) == Sign::Negative);
    CHECK(at(flat, p).compare(at(steep, p), {1, -1}) == Sign::Positive);
    CHECK(at(higher, q).compare(at(flat, q)) == Sign::Positive); // by 2^-50 / 3
    CHECK(at(flat, q).compare(at(higher, q), {-1, 1}) == Sign::Negative);
    CHECK(at(flat, q).compare(at(flat, q), {1, 1}) == Sign::Zero);
    const Point3 corner{0, 0, 0};
    CHECK(at(higher, corner).compare(at(flat, corner)) == Sign::Zero);
    CHECK(at(higher, corner).compare(at(flat, corner), {1, 1}) == Sign::Positive);
    CHECK(at(higher, corner).compare(at(flat, corner), {-1, 1}) == Sign::Negative);
}
