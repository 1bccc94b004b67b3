// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "support/solids.hpp"
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

using namespace terrane;
using namespace test_support;

namespace {

struct ExtensionCase {
    Extended extended;
    VolumeOfInterest cut;
    Volumes volumes;
};

ExtensionCase extend(std::vector<Surface> surfaces, const std::vector<Surface>& boundary,
                     double limit) {
    std::vector<std::uint32_t> faces(boundary.size());
    std::iota(faces.begin(), faces.end(), static_cast<std::uint32_t>(surfaces.size()));
    surfaces.insert(surfaces.end(), boundary.begin(), boundary.end());
    auto extended = extend_to_boundary(surfaces, faces, {.limit = limit});
    INFO((extended ? std::string() : extended.error().message()));
    REQUIRE(extended);
    auto whole = arrange(extended.value().surfaces);
    REQUIRE(whole);
    auto cut = cut_to_volume(std::move(whole).value(), faces);
    REQUIRE(cut);
    auto volumes = find_volumes(cut.value().arrangement);
    REQUIRE(volumes);
    CHECK(round_to_doubles(cut.value().arrangement).value().report.clean);
    return {std::move(extended).value(), std::move(cut).value(), std::move(volumes).value()};
}

const std::vector<Surface> box8 = box_boundary({0, 0, 0}, {8, 8, 8}).value();

} // namespace

TEST_CASE("extension: a horizon inside a box is extended to all its walls", "[extend]") {
    const auto c = extend({level(4, 1, 2, 7, 7.5, "horizon")}, box8, 2.5);
    CHECK(c.volumes.measures == std::vector<double>{HUGE_VAL, 256, 256});
    CHECK(c.cut.report.borders.empty());
    REQUIRE(c.extended.borders.size() == 1);
    CHECK(c.extended.borders[0].reached);
    CHECK(c.extended.borders[0].length == Approx(2 * (6 + 5.5)));
    CHECK(c.extended.borders[0].place == Point3{1, 2, 4});
    CHECK(c.extended.surfaces[0].triangles.size() > 2);
    CHECK(c.cut.report.surfaces[0].area_inside == Approx(64));
}

TEST_CASE("extension: borders too far from the boundary are not extended but listed", "[extend]") {
    // Left and right walls are one unit away, front and back walls three units.
    const auto c = extend({level(4, 1, 3, 7, 5, "horizon")}, box8, 1.5);
    CHECK(c.volumes.block_count() == 1);
    bool near = false, far = false;
    for (const ExtendedBorder& b : c.extended.borders) (b.reached ? near : far) = true;
    CHECK(far);
    const auto none = extend({level(4, 3, 3, 5, 5, "horizon")}, box8, 1.5);
    REQUIRE(none.extended.borders.size() == 1);
    CHECK_FALSE(none.extended.borders[0].reached);
    CHECK(none.extended.surfaces[0].triangles.size() == 2);
}

TEST_CASE("extension: faults are not extended, and horizons pass through them", "[extend]") {
    Surface fault = quad({4, 2, 1}, {4, 6, 1}, {4, 6, 7}, {4, 2, 7}, "fault");
    fault.role = Role::fault;
    Surface crossed = quad({6, -1, -1}, {6, 9, -1}, {6, 9, 9}, {6, -1, 9}, "through");
    crossed.role = Role::fault;
    Surface horizon = level(4, -1, -1, 5, 9, "horizon");
    horizon.role = Role::horizon;
    const auto c = extend({fault, horizon, crossed}, box8, 3.5);
    CHECK(c.volumes.block_count() == 4);
    CHECK(c.extended.surfaces[0].triangles.size() == 2);
    REQUIRE(c.extended.borders.size() == 1);
    CHECK(c.extended.borders[0].surface == 1);
    for (const OpenBorder& b : c.cut.report.borders) CHECK(b.surface == 0);
}

TEST_CASE("extension: strips follow the tangent plane at any dip; rough borders do not fold",
          "[extend]") {
    Surface dipping{"dipping", Role::horizon, {}, {}};
    const unsigned n = 12;
    const auto height = [](double x, double y) { return 4 + 0.25 * x - 0.2 * y; };
    for (unsigned j = 0; j <= n; ++j)
        for (unsigned i = 0; i <= n; ++i) {
            const double ragged = i == n ? 0.15 * ((j * 7) % 5) : 0;
            const double x = -3 + 6.0 * i / n - ragged, y = -6 + 12.0 * j / n;
            dipping.vertices.push_back({x, y, height(x, y)});
        }
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i;
            dipping.triangles.push_back({a, a + 1, a + n + 2});
            dipping.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    const auto boundary = box_boundary({-4, -5, 0}, {5, 5, 8}).value();
    const auto c = extend({dipping}, boundary, 3.5);
    CHECK(c.volumes.block_count() == 2);
    CHECK(c.volumes.total == 720);
    // The plane passes through the middle of the box, which it halves except for the slope.
    const double below = 9 * 10 * height(0.5, 0);
    CHECK(c.volumes.measures[1] + c.volumes.measures[2] == Approx(720));
    CHECK(std::min(std::fabs(c.volumes.measures[1] - below),
                   std::fabs(c.volumes.measures[2] - below)) < 1e-9);
}

TEST_CASE("extension: nothing to extend is no error, and bad limits are refused", "[extend]") {
    const auto c = extend({level(4, -1, -1, 9, 9)}, box8, 1);
    CHECK(c.extended.borders.empty());
    CHECK(c.extended.surfaces[0].triangles.size() == 2);
    const std::vector<std::uint32_t> faces{0, 1, 2, 3, 4, 5};
    CHECK(extend_to_boundary(box8, faces, {.limit = 0}).error().code == ErrorCode::bad_option);
    CHECK(extend_to_boundary(box8, faces, {.limit = NAN}).error().code == ErrorCode::bad_option);
}
