// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks boundaries of volumes of interest against exact volumes.
#include <terrane/algorithms/volume_of_interest/boundary_surfaces.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <gmpxx.h>

#include "support/boundary_bodies.hpp"
#include "support/certified_inputs.hpp"
#include "support/cut_cases.hpp"
#include "support/effort.hpp"
#include "support/points.hpp"
#include "support/solids.hpp"

using namespace terrane;
using namespace test_support;
using namespace cut_cases;

TEST_CASE("volume of interest: boundaries are closed and oriented outward", "[voi]") {
    const std::vector<Point2> star{{0, 0}, {4, 1}, {8, 0}, {7, 4}, {8, 8}, {4, 7}, {0, 8}, {1, 4}};
    std::vector<Point2> clockwise(star.rbegin(), star.rend());
    clockwise.push_back(clockwise.front());
    const auto counter = polygon_boundary(star, 5, -5), same = polygon_boundary(clockwise, -5, 5);
    REQUIRE(counter);
    REQUIRE(same);
    mpq_class area; // shoelace formula
    for (std::size_t i = 0; i < star.size(); ++i) {
        const Point2 &p = star[i], &q = star[(i + 1) % star.size()];
        area += mpq_class(p[0]) * q[1] - mpq_class(p[1]) * q[0];
    }
    CHECK(volume_of(counter.value()) == area / 2 * 10);
    CHECK(volume_of(same.value()) == area / 2 * 10);
    REQUIRE(counter.value().size() == 10);
    CHECK(counter.value()[0].name == "boundary top");
    CHECK(counter.value()[1].name == "boundary bottom");
    CHECK(counter.value()[9].name == "boundary side 8");
    for (const Surface& s : counter.value()) CHECK(s.role == Role::boundary);
    CHECK(volume_of(box_of({-1, 2, 3}, {4, 6, 5})) == 40);
}

TEST_CASE("volume of interest: polygons with many corners and collinear corners are valid",
          "[voi]") {
    Random random(5);
    for (int round = 0; round < 20; ++round) {
        // A polygon that is star-shaped around 0 is simple, whatever the radii.
        std::vector<Point2> ring;
        const int n = random_int(random, 3, 60);
        for (int i = 0; i < n; ++i) {
            const double a = 2 * std::acos(-1.0) * i / n, r = random_real(random, 1, 20);
            const Point2 p{4e5 + r * std::cos(a), 4e6 + r * std::sin(a)};
            ring.push_back(p);
        }
        const auto made = polygon_boundary(ring, -1, 1);
        REQUIRE(made);
        mpq_class area;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Point2 &p = ring[i], &q = ring[(i + 1) % ring.size()];
            area += mpq_class(p[0]) * q[1] - mpq_class(p[1]) * q[0];
        }
        CHECK(volume_of(made.value()) == area);
        CHECK(made.value().size() == (n > 12 ? 3 : 2 + static_cast<std::size_t>(n)));
        CHECK(made.value()[0].triangles.size() == ring.size() - 2);
    }
    const std::vector<Point2> in_line{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    const auto made = polygon_boundary(in_line, 0, 1);
    REQUIRE(made);
    CHECK(volume_of(made.value()) == 4);
}

TEST_CASE("volume of interest: rotated boxes have their place, directions and volume", "[voi]") {
    RotatedBox box;
    box.place = {10, 20, 30};
    box.lengths = {2, 4, 6};
    const auto bounds = [](const std::vector<Surface>& surfaces) {
        Point3 low = surfaces[0].vertices[0], high = low;
        for (const Surface& s : surfaces)
            for (const Point3& p : s.vertices) {
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            }
        return std::array{low, high};
    };
    CHECK(bounds(rotated_box_boundary(box).value()) ==
          std::array{Point3{9, 18, 27}, Point3{11, 22, 33}});
    box.azimuth = 90; // the edges along point east
    CHECK(bounds(rotated_box_boundary(box).value()) ==
          std::array{Point3{8, 19, 27}, Point3{12, 21, 33}});
    box.is_corner = true;
    CHECK(bounds(rotated_box_boundary(box).value()) ==
          std::array{Point3{10, 18, 30}, Point3{14, 20, 36}});
    box.azimuth = 0;
    box.plunge = 90; // the edges along point down, those up to the north
    CHECK(bounds(rotated_box_boundary(box).value()) ==
          std::array{Point3{10, 20, 26}, Point3{12, 26, 30}});
    box.plunge = 0;
    box.roll = 90; // the edges across point down, those up to the east
    CHECK(bounds(rotated_box_boundary(box).value()) ==
          std::array{Point3{10, 20, 28}, Point3{16, 24, 30}});
    Random random(3);
    for (int round = 0; round < 50; ++round) {
        box.azimuth = random_real(random, -360, 360);
        box.plunge = random_real(random, -90, 90);
        box.roll = random_real(random, -180, 180);
        const auto made = rotated_box_boundary(box);
        REQUIRE(made);
        CHECK(volume_of(made.value()).get_d() == Approx(48).epsilon(1e-12));
    }
    for (double* angle : {&box.azimuth, &box.plunge, &box.roll}) {
        const double before = std::exchange(*angle, 361);
        CHECK_FALSE(rotated_box_boundary(box));
        *angle = before;
    }
}

TEST_CASE("volume of interest: invalid boundaries are refused", "[voi]") {
    using Ring = std::vector<Point2>;
    const auto polygon = [](const Ring& ring) { return polygon_boundary(ring, 0, 1).error(); };
    const Error crossed = polygon({{0, 0}, {2, 2}, {2, 0}, {0, 2}});
    CHECK(crossed.code == ErrorCode::improper_contact);
    CHECK(crossed.sentence == "the polygon meets itself: edge 1 from (0, 0) to (2, 2) and edge 3 "
                              "from (2, 0) to (0, 2)");
    CHECK(polygon({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}).code == ErrorCode::improper_contact);
    CHECK(polygon({{0, 0}, {4, 0}, {2, 0}, {2, 2}}).code == ErrorCode::improper_contact);
    CHECK(polygon({{0, 0}, {1, 0}, {1, 0}, {0, 1}}).code == ErrorCode::improper_contact);
    CHECK(polygon({{0, 0}, {2, 0}, {4, 0}}).code == ErrorCode::improper_contact);
    CHECK(polygon({{0, 0}, {1, 1}, {0, 0}}).code == ErrorCode::bad_option);
    CHECK(polygon({{0, 0}, {1, NAN}, {0, 1}}).code == ErrorCode::bad_number);
    CHECK(polygon({{-1e308, 0}, {1e308, 0}, {0, 1e308}}).code == ErrorCode::bad_number);
    CHECK(polygon_boundary(Ring{{0, 0}, {1, 0}, {0, 1}}, 2, 2).error().code ==
          ErrorCode::bad_option);
    CHECK(box_boundary({0, 0, 0}, {1, 0, 1}).error().code == ErrorCode::bad_option);
    CHECK(box_boundary({0, 0, 0}, {1, HUGE_VAL, 1}).error().code == ErrorCode::bad_number);
    RotatedBox thin;
    CHECK(rotated_box_boundary(thin).error().code == ErrorCode::bad_option);
    thin = {{1e6, 1e6, 1e6}, false, {1e-11, 1, 1}, 30, 20, 10};
    CHECK_FALSE(rotated_box_boundary(thin));

    // Doubles have to hold its volume, not its corners alone.
    CHECK(box_boundary({0, 0, 0}, {1e100, 1e100, 1e100}));
    CHECK(box_boundary({0, 0, 0}, {1e-100, 1e200, 1e100}));
    for (const Point3 high : {Point3{8, 8, 1e308}, Point3{1e103, 1e103, 1e103},
                              Point3{1e-200, 1e200, 1e200}, Point3{1e300, 1, 1e10}})
        CHECK(box_boundary({0, 0, 0}, high).error().code == ErrorCode::bad_number);
    CHECK(
        rotated_box_boundary({{0, 0, 0}, false, {1e103, 1e103, 1e103}, 30, 20, 10}).error().place ==
        "rotated box");
    CHECK(closed_boundary(std::vector{cube(-1e103, 1e103)}).error().code == ErrorCode::bad_number);

    Surface open = cube(0, 1);
    open.triangles.pop_back();
    const Error hole = closed_boundary(std::vector{open}).error();
    CHECK(hole.code == ErrorCode::not_closed);
    CHECK(hole.place == "(0, 1, 0)"); // a corner of the missing triangle
    CHECK(closed_boundary(std::vector{cube(0, 2), cube(1, 3)}).error().code ==
          ErrorCode::improper_contact);
    CHECK(closed_boundary(std::vector{cube(0, 2), cube(0, 2)}).error().code ==
          ErrorCode::improper_contact);
    CHECK(closed_boundary(std::vector<Surface>{}).error().code == ErrorCode::nothing_to_do);

    // An open surface given as the boundary is refused.
    const std::vector<Surface> sheet{level(0, 0, 0, 1, 1)};
    const auto a = arrange(sheet);
    const std::vector<std::uint32_t> all{0};
    CHECK(locate(a.value(), all).error().code == ErrorCode::not_closed);
}

TEST_CASE("volume of interest: a ring that repeats its first corner is the same polygon", "[voi]") {
    using Ring = std::vector<Point2>;
    const Ring ring{{0, 0}, {4, 0}, {4, 3}, {0, 4}}, closed{{0, 0}, {4, 0}, {4, 3}, {0, 4}, {0, 0}};
    const auto once = polygon_boundary(ring, 0, 1), twice = polygon_boundary(closed, 0, 1);
    REQUIRE((once && twice));
    REQUIRE(once->size() == twice->size());
    for (std::size_t s = 0; s < once->size(); ++s) {
        CHECK((*once)[s].vertices == (*twice)[s].vertices);
        CHECK((*once)[s].triangles == (*twice)[s].triangles);
    }
}
