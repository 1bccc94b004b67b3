// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks which gaps are closed where surfaces and pairs of them have distances of their own. The
// volumes of the blocks tell.
#include <terrane/algorithms/sealing/sealing.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "support/shapes.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/volumes/volumes.hpp>

using namespace terrane;
using namespace test_support;

namespace {

constexpr auto lower = SurfaceId(0), upper = SurfaceId(1), wall = SurfaceId(2), hull = SurfaceId(3);

/// Two horizons in a cube, at z = 2 and z = 5, that end 0.1 and 0.3 short of a wall at x = 4.
std::vector<Surface> stepped_model(double low_end = 3.9, double high_end = 3.7) {
    return {level(2, -1, -1, low_end, 9, "low"), level(5, -1, -1, high_end, 9, "high"),
            quad({4, -1, -1}, {4, 9, -1}, {4, 9, 9}, {4, -1, 9}, "fault"), cube(0, 8)};
}

/// Returns the volumes of the blocks, ascending.
std::vector<double> ruled_volumes(const std::vector<Surface>& surfaces,
                                  const SealOptions& options) {
    const auto sealed = seal(surfaces, options);
    REQUIRE(sealed);
    const auto volumes = find_volumes(sealed->arrangement);
    REQUIRE(volumes);
    std::vector<double> all(volumes->measures.begin() + 1, volumes->measures.end());
    std::sort(all.begin(), all.end());
    return all;
}

std::vector<double> ruled_volumes(double distance, const std::vector<SealRule>& rules) {
    return ruled_volumes(stepped_model(), {.distance = distance, .rules = rules});
}

SealRule rule(SurfaceId a, SurfaceId b, double distance) {
    return {a, b, distance};
}
SealRule rule(SurfaceId a, double distance) {
    return {a, std::nullopt, distance};
}

const std::vector<double> open_volumes{256, 256}, only_low{64, 192, 256}, only_high{96, 160, 256},
    all_closed{64, 96, 96, 256};

} // namespace

TEST_CASE("seal rules: a pair, a surface, and the general distance", "[seal]") {
    CHECK(ruled_volumes(0.15, {}) == only_low);
    CHECK(ruled_volumes(0.35, {}) == all_closed);
    SECTION("by pairs alone") {
        CHECK(ruled_volumes(0, {rule(lower, wall, 0.15)}) == only_low);
        CHECK(ruled_volumes(0, {rule(wall, upper, 0.35)}) == only_high);
        CHECK(ruled_volumes(0, {rule(lower, wall, 0.09)}) == open_volumes);
        CHECK(ruled_volumes(0, {rule(lower, wall, 0.35), rule(upper, hull, 0.2)}) == only_low);
    }
    SECTION("a pair goes before a surface and the general distance") {
        CHECK(ruled_volumes(0.15, {rule(upper, wall, 0.35)}) == all_closed);
        CHECK(ruled_volumes(0.35, {rule(lower, wall, 0)}) == only_high);
        CHECK(ruled_volumes(0.35, {rule(wall, 0), rule(wall, upper, 0.35)}) == only_high);
    }
    SECTION("a surface, from it and to it") {
        CHECK(ruled_volumes(0, {rule(lower, 0.35)}) == only_low);
        CHECK(ruled_volumes(0, {rule(wall, 0.15)}) == only_low);
        CHECK(ruled_volumes(0, {rule(wall, 0.35)}) == all_closed);
        CHECK(ruled_volumes(0.35, {rule(wall, 0)}) == open_volumes);
        CHECK(ruled_volumes(0.35, {rule(upper, 0.2)}) == only_low);
    }
    SECTION("two surfaces: the larger counts, but none goes before all") {
        CHECK(ruled_volumes(0, {rule(wall, 0.15), rule(upper, 0.35)}) == all_closed);
        CHECK(ruled_volumes(0, {rule(upper, 0.35), rule(wall, 0.15)}) == all_closed);
        CHECK(ruled_volumes(0, {rule(wall, 0.35), rule(lower, 0)}) == only_high);
    }
    SECTION("of rules for the same the last one counts") {
        CHECK(ruled_volumes(0, {rule(wall, 0.35), rule(wall, 0.15)}) == only_low);
        CHECK(ruled_volumes(0.35, {rule(lower, wall, 0), rule(wall, lower, 0.15)}) == all_closed);
    }
}

TEST_CASE("seal rules: what reaches beyond is trimmed by the rule for the pair", "[seal]") {
    const auto beyond =
        stepped_model(4.1, 4.3); // all_closed are closed, and dangle beyond the wall
    const auto trimmed = [&](double distance, const std::vector<SealRule>& rules) {
        const auto sealed = seal(beyond, {.distance = distance, .rules = rules});
        REQUIRE(sealed);
        std::vector<std::string> names;
        for (const SealChange& change : sealed->changes) {
            CHECK(change.kind == SealKind::trimmed);
            names.push_back(beyond[change.surface].name);
        }
        names.erase(std::unique(names.begin(), names.end()), names.end());
        return names;
    };
    using Names = std::vector<std::string>;
    CHECK(trimmed(0.15, {}) == Names{"low"});
    CHECK(trimmed(0.35, {rule(hull, 0)}) == Names{"low", "high"});
    CHECK(trimmed(0.35, {rule(hull, 0), rule(lower, wall, 0)}) == Names{"high"});
    CHECK(trimmed(0, {rule(upper, wall, 0.35)}) == Names{"high"});
    CHECK(trimmed(0, {rule(lower, 0.15)}) == Names{"low"});
}

TEST_CASE("seal rules: the order of the surfaces does not matter", "[seal]") {
    const auto surfaces = stepped_model();
    std::vector<std::uint32_t> order(surfaces.size());
    std::iota(order.begin(), order.end(), 0U);
    do {
        std::vector<Surface> moved(surfaces.size());
        for (std::size_t s = 0; s < order.size(); ++s) moved[order[s]] = surfaces[s];
        const auto at = [&](SurfaceId s) { return SurfaceId(order[s]); };
        CHECK(ruled_volumes(moved, {.distance = 0.15,
                                    .rules = {rule(at(upper), at(wall), 0.35),
                                              rule(at(lower), 0)}}) == only_high);
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("seal rules: what is no distance and what is no surface is refused", "[seal]") {
    const auto refused = [](const SealOptions& options) {
        const auto sealed = seal(stepped_model(), options);
        REQUIRE_FALSE(sealed);
        CHECK(sealed.error().code == ErrorCode::bad_option);
    };
    refused({.distance = 0, .rules = {rule(lower, 0)}});
    refused({.distance = -1, .rules = {rule(lower, 1)}});
    for (const double bad : {-1.0, std::nan(""), HUGE_VAL})
        refused({.distance = 1, .rules = {rule(lower, bad)}});
    refused({.distance = 1, .rules = {rule(SurfaceId(4), 1)}});
    refused({.distance = 1, .rules = {rule(lower, SurfaceId(4), 1)}});
}
