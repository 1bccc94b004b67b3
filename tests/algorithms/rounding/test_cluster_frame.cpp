// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The frame of nearly coplanar clusters, and the planes that it is made of.
#include "support/rounded.hpp"
#include "support/shapes.hpp"

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/rounding/detail/cluster_frame.hpp>
#include <terrane/algorithms/rounding/detail/contact_clusters.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace terrane;
using namespace terrane::rounding::detail;
using namespace test_support;

constexpr double spacing = 0x1p-31; // of doubles at 4e6
constexpr double tolerance = 16 * spacing;

/// Three unit vectors across each other.
struct Directions {
    Point3 u{2. / 3, -1. / 3, 2. / 3}, v{2. / 3, 2. / 3, -1. / 3}, w{-1. / 3, 2. / 3, 2. / 3};
    [[nodiscard]] Point3 at(double a, double b, double c) const {
        return {5e5 + a * u.x + b * v.x + c * w.x, 4e6 + a * u.y + b * v.y + c * w.y,
                a * u.z + b * v.z + c * w.z - 1000};
    }
};

double distance_of(const Point3& p, const Point3& q) {
    return length(minus(p, q));
}

} // namespace

TEST_CASE("cluster frame: points of a turned lattice are integers, and go back to themselves") {
    const Directions d;
    std::vector<Point3> points;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 5; k += 2) points.push_back(d.at(0.1 * i, 0.1 * j, 0.1 * k));
    points.push_back(d.at(0.1, 0.123456, 0.2)); // is not chosen, and in no lattice
    std::vector<bool> chosen(points.size(), true);
    chosen.back() = false;
    const std::vector<Point3> normals{d.u, d.v, d.w};
    const auto frame = ClusterFrame::of(points, chosen, normals, tolerance);
    REQUIRE(frame);
    CHECK(frame->largest_error() < 4 * spacing);
    for (std::size_t p = 0; p < points.size(); ++p) {
        const Point3 place = frame->into(points[p]);
        CHECK(frame->back(place) == points[p]);
        CHECK(place.x == std::nearbyint(place.x));
        CHECK(place.z == std::nearbyint(place.z));
        if (chosen[p]) CHECK(place.y == std::nearbyint(place.y));
    }
    CHECK(frame->into(points[0]) == Point3{0, 0, 0});
    CHECK(frame->into(points.back()).y == Approx(1.23456).epsilon(1e-7));
}

TEST_CASE("cluster frame: points near one plane get one coordinate, others keep theirs") {
    const Directions d;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0, 100), off(-4 * spacing, 4 * spacing);
    std::vector<Point3> points;
    for (int i = 0; i < 50; ++i) points.push_back(d.at(off(random), place(random), place(random)));
    for (int i = 0; i < 50; ++i)
        points.push_back(d.at(5 + 10 * i * tolerance, place(random), place(random)));
    const std::vector<bool> chosen(points.size(), true);
    const std::vector<Point3> normals{d.u};
    const auto frame = ClusterFrame::of(points, chosen, normals, tolerance);
    REQUIRE(frame);
    const double plane = frame->into(points[0]).x;
    for (int i = 1; i < 50; ++i) CHECK(frame->into(points[static_cast<std::size_t>(i)]).x == plane);
    for (std::size_t i = 51; i < 100; ++i)
        CHECK(frame->into(points[i]).x > frame->into(points[i - 1]).x);
    for (const Point3& p : points) CHECK(frame->back(frame->into(p)) == p);
    CHECK(frame->largest_error() < 2 * tolerance);
}

TEST_CASE("cluster frame: the stated error holds for points between others") {
    const Directions d;
    std::vector<Point3> points;
    for (int i = 0; i < 8; ++i)
        points.push_back(d.at(0.1 * (i & 1), 0.1 * (i >> 1 & 1), 0.1 * (i >> 2)));
    const std::vector<Point3> normals{d.u, d.v, d.w};
    const auto frame =
        ClusterFrame::of(points, std::vector<bool>(points.size(), true), normals, tolerance);
    REQUIRE(frame);
    std::mt19937 random(6);
    std::uniform_real_distribution<double> share(0, 1);
    for (int i = 0; i < 1000; ++i) {
        const double a = share(random), b = share(random), c = share(random);
        const auto far = distance_of(frame->back({a, b, c}), d.at(a / 10, b / 10, c / 10));
        CHECK(far <= frame->error_of({a, b, c}, {}) + 4 * spacing);
        CHECK(frame->error_of({a, b, c}, {}) < 4 * spacing);
        CHECK(frame->error_of({a, b, c}, {1, 0, 0}) > 0.1 - 4 * spacing);
    }
}

TEST_CASE("cluster frame: there is none without a chosen point, a normal or a finite length") {
    const std::vector<Point3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<Point3> normals{{0, 0, 1}};
    const std::vector<bool> none(3, false), all(3, true);
    CHECK_FALSE(ClusterFrame::of(points, none, normals, tolerance));
    CHECK_FALSE(ClusterFrame::of(points, all, {}, tolerance));
    CHECK(ClusterFrame::of(points, all, normals, tolerance));
    const std::vector<Point3> far{{1e308, 1e308, 1e308}, {-1e308, 0, 0}, {0, 1, 0}};
    CHECK_FALSE(ClusterFrame::of(far, all, normals, tolerance));
}

TEST_CASE("contact clusters: the plane of two sheets that cross all over is found") {
    const Directions d;
    const auto sheet = [&](double shift) {
        return unit_grid(40, 40, [&](double x, double y) { return d.at(0, x + shift, y + shift); });
    };
    const auto a = arranged({sheet(0), sheet(1. / 80)});
    const auto naive = round_to_doubles(a, {.max_rounds = 0});
    REQUIRE(naive);
    REQUIRE(naive->report.contacts.size() > 10);
    const auto directions = [&](const ParentsInContact& in_contact) {
        return cluster_directions(a.state->corners, a.state->points.inputs(), in_contact,
                                  tolerance);
    };
    const auto normals = directions(parents_in_contact(*naive));
    REQUIRE(normals.size() == 3);
    CHECK(std::fabs(dot(normals[0], d.u)) == Approx(1).epsilon(1e-9));
    CHECK(directions(parents_in_contact(rounded(a))).empty());
}

TEST_CASE("contact clusters: there are none if contacts are in many planes") {
    const auto directions = [](int planes,
                               int at_first) { // pairs of equal triangles in planes through a line
        std::vector<Point3> points{{0, 0, 0}, {0, 0, 1}};
        std::vector<Triangle> corners;
        ParentsInContact in_contact;
        for (int k = 0; k < planes; ++k) {
            points.push_back({std::cos(k * 0.3), std::sin(k * 0.3), 0.5});
            for (int n = 0; n < (k == 0 ? at_first : 1); ++n) {
                const auto t = static_cast<std::uint32_t>(corners.size());
                corners.insert(corners.end(), 2, {0, 1, static_cast<std::uint32_t>(k) + 2});
                in_contact.pairs.emplace_back(t, t + 1);
            }
        }
        return cluster_directions(corners, points, in_contact, 1e-14);
    };
    CHECK(directions(2, 1).size() == 3);
    CHECK(directions(3, 1).empty()); // planes through a line have two independent normals
    CHECK(directions(3, 2).size() == 3);
    CHECK(directions(6, 10).empty());
    CHECK(directions(6, 11).size() == 3);
}
