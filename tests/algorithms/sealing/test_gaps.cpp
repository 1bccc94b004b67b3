// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests the widths of gaps, their natural breaks, and the distance that is chosen.
#include <terrane/algorithms/sealing/sealing.hpp>

#include <cmath>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "support/shapes.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/model/arrange_within.hpp>

using namespace terrane;
using namespace test_support;

namespace {

/// Horizons that end `gaps` short of a fault at x = 10, one above the other, in a box.
std::vector<Surface> steps(const std::vector<double>& gaps) {
    std::vector<Surface> surfaces{grid(
        1, 1,
        [&](unsigned i, unsigned j) {
            return Point3{10, -1.0 + 12 * i, -1.0 + 40 * j};
        },
        "fault")};
    for (std::size_t k = 0; k < gaps.size(); ++k) {
        const double end = 10 - gaps[k], z = 2.0 + 2 * static_cast<double>(k);
        surfaces.push_back(unit_grid(
            5, 5,
            [&](double u, double v) {
                return Point3{-1 + (end + 1) * u, -1 + 12 * v, z};
            },
            "horizon"));
    }
    return surfaces;
}

std::vector<Surface> box_around(double height) {
    Surface sides = box({0, 0, 0}, {20, 10, height}, "box");
    sides.role = Role::boundary;
    return {sides};
}

std::vector<SurfaceGap> gaps_of(const std::vector<double>& widths, double length = 1) {
    std::vector<SurfaceGap> gaps;
    for (const double w : widths) gaps.push_back({SurfaceId(0), SurfaceId(1), length, w, {}});
    return gaps;
}

} // namespace

TEST_CASE("gaps: width, length and surfaces of each", "[seal]") {
    const auto surfaces = steps({0.125});
    const auto a = arrange(surfaces);
    REQUIRE(a);
    const auto gaps = find_gaps(*a, 1);
    REQUIRE(gaps);
    REQUIRE(gaps->size() == 5);
    double length = 0;
    for (const SurfaceGap& gap : *gaps) {
        CHECK(gap.from == SurfaceId(1));
        CHECK(gap.to == SurfaceId(0));
        CHECK(gap.width == Approx(0.125));
        CHECK(gap.place.x == Approx(9.875));
        length += gap.length;
    }
    CHECK(length == Approx(12));
    CHECK(find_gaps(*a, 0.12)->empty());
    for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL})
        CHECK(find_gaps(*a, bad).error().code == ErrorCode::bad_option);
}

TEST_CASE("gaps: a break is where widths triple and next to no gap is", "[seal]") {
    CHECK(find_breaks({}, 10).empty());
    const auto one = find_breaks(gaps_of({0.3}), 10);
    REQUIRE(one.size() == 1);
    CHECK(one[0].low == 0.3);
    CHECK(one[0].high == 10);
    CHECK(one[0].distance == 0.5);
    CHECK(one[0].gaps == 1);
    CHECK(find_breaks(gaps_of({4}), 10).empty()); // it may go on beyond what was looked at

    const auto two = find_breaks(gaps_of({0.001, 0.002, 0.004, 1.5, 3, 4}), 20);
    REQUIRE(two.size() == 2);
    CHECK(two[0].low == 0.004);
    CHECK(two[0].high == 1.5);
    CHECK(two[0].distance == 0.005);
    CHECK(two[0].length == 3);
    CHECK(two[1].low == 4);
    CHECK(two[1].distance == 5);
    CHECK(two[1].gaps == 3);
    // Widths that double from one to the next have no break.
    CHECK(find_breaks(gaps_of({1, 2, 4, 8, 16, 32}), 64).empty());
}

TEST_CASE("gaps: few short gaps do not hide a break, a long one does", "[seal]") {
    auto gaps = gaps_of({0.001, 0.002, 0.004}, 100);
    const auto with = [&](double length) {
        auto more = gaps;
        more.push_back({SurfaceId(0), SurfaceId(1), length, 0.01, {}});
        for (const double w : {0.05, 0.1, 0.2})
            more.push_back({SurfaceId(0), SurfaceId(1), 100, w, {}});
        return find_breaks(more, 1);
    };
    REQUIRE(with(1).size() == 2);
    CHECK(with(1)[0].low == 0.004);
    CHECK(with(1)[0].high == 0.05);
    CHECK(with(1)[1].gaps == 4); // with the short one inside of the break before
    REQUIRE(with(50).size() == 2);
    CHECK(with(50)[0].low == 0.01); // five times less than the next
}

TEST_CASE("gaps: a random break is found between two clouds", "[seal]") {
    std::mt19937_64 random(4);
    for (int trial = 0; trial < 200; ++trial) {
        const double scale = std::pow(10, std::uniform_real_distribution<double>(-9, 6)(random));
        std::vector<double> widths;
        for (int i = 0; i < 40; ++i) { // each cloud in steps of less than a factor of 1.3
            const double step =
                std::pow(10, std::uniform_real_distribution<double>(0, .01)(random));
            widths.push_back(scale * std::pow(1.1, i) * step);
        }
        const double low = widths.back();
        const double first = low * std::uniform_real_distribution<double>(3.1, 50)(random);
        for (int i = 0; i < 40; ++i) widths.push_back(first * std::pow(1.1, i));
        const auto breaks = find_breaks(gaps_of(widths), widths.back() * 2.9);
        REQUIRE(breaks.size() == 1);
        CHECK(breaks[0].low == low);
        CHECK(breaks[0].high == first);
        CHECK(breaks[0].distance > low);
        CHECK(breaks[0].distance < first);
    }
}

TEST_CASE("seal advice: the distance that closes the gaps of data errors, not those meant",
          "[seal]") {
    // Three horizons end less than 0.02 short of the fault, one ends 3 short of it.
    const auto surfaces = steps({0.0125, 0.015, 0.02, 3});
    const auto boundary = box_around(12);
    const auto advice = advise_seal(surfaces, boundary);
    REQUIRE(advice);
    CHECK(advice->choice.distance == 0.05);
    REQUIRE(advice->choice.breaks.size() == 1);
    CHECK(advice->choice.breaks[0].low == Approx(0.02));
    REQUIRE(advice->trials.size() == 2);
    CHECK(advice->trials[0].blocks == 2); // the fault parts the box
    CHECK(advice->trials[0].changes == 0);
    CHECK(advice->trials[1].blocks == 5); // three horizons more on one side of it
    CHECK(advice->trials[1].changes == 3);
    CHECK(advice->trials[1].triangles > 0);
    CHECK(advice->trials[1].left == 0);

    const auto automatic = arrange_within(surfaces, boundary, {.seal_automatic = true});
    const auto stated = arrange_within(surfaces, boundary, {.seal = 0.05});
    REQUIRE(automatic);
    REQUIRE(stated);
    REQUIRE(automatic->choice);
    CHECK(automatic->choice->distance == 0.05);
    CHECK(automatic->sealed->distance == 0.05);
    CHECK(automatic->rounded.mesh->vertices == stated->rounded.mesh->vertices);
    CHECK(automatic->rounded.mesh->triangles == stated->rounded.mesh->triangles);
}

TEST_CASE("seal advice: nothing is sealed where there is no gap", "[seal]") {
    const std::vector<Surface> surfaces{cube(0, 8), cube(4, 12)};
    const auto automatic = arrange_within(surfaces, {}, {.seal_automatic = true});
    const auto plain = arrange_within(surfaces, {});
    REQUIRE(automatic);
    CHECK(automatic->choice->distance == 0);
    CHECK(automatic->choice->breaks.empty());
    CHECK_FALSE(automatic->sealed);
    CHECK(automatic->rounded.mesh->triangles == plain->rounded.mesh->triangles);
    CHECK(automatic->growth.empty());
}

TEST_CASE("gaps: two parts of one surface have the gap that two surfaces have", "[seal]") {
    auto surfaces = steps({0.125});
    const auto two = find_gaps(*arrange(surfaces), 1);
    Surface& all = surfaces[0];
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), surfaces[1].vertices.begin(),
                        surfaces[1].vertices.end());
    for (const auto& [i, j, k] : surfaces[1].triangles)
        all.triangles.push_back({first + i, first + j, first + k});
    surfaces.erase(surfaces.begin() + 1);
    const auto one = find_gaps(*arrange(surfaces), 1);
    REQUIRE(two);
    REQUIRE(one);
    REQUIRE(one->size() == two->size());
    for (std::size_t g = 0; g < one->size(); ++g) {
        CHECK((*one)[g].from == (*one)[g].to);
        CHECK((*one)[g].width == (*two)[g].width);
        CHECK((*one)[g].length == (*two)[g].length);
    }
}
