// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The verifier accepts true claims.
#include "support/verify_cases.hpp"

#include <catch2/catch.hpp>

#include <functional>
#include <random>

namespace {

using namespace verify_cases;

void transform(Case& c, const std::function<Point3(const Point3&)>& map) {
    for (Surface& s : c.inputs) {
        for (Point3& p : s.vertices) p = map(p);
    }
}

} // namespace

TEST_CASE("verify_arrangement accepts true claims") {
    CHECK(verdict({}).empty());
    CHECK(verdict(crossing()).empty());
    CHECK(verdict(overlap()).empty());
    CHECK(verdict(three_planes_meet()).empty());
    CHECK(verdict(twins()).empty());
    CHECK(verdict(square_in_one()).empty());
    CHECK(verdict(square_in_two()).empty());
}

TEST_CASE("verify_arrangement: an overlap within one surface counts its parents") {
    Case c = overlap();
    c.inputs = {surface({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {5, 1, 0}, {1, 5, 0}},
                        {{0, 1, 2}, {3, 5, 4}})};
    CHECK(verdict(c).empty());
}

TEST_CASE("verify_arrangement: a duplicate within its surface makes no intersection edge") {
    Case c = square_in_one();
    c.inputs[0].triangles.push_back({2, 0, 1});
    set_parents(c.claim, 0, {0, 2});
    c.claim.duplicates = {{2, 0}};
    CHECK(verdict(c).empty());
    c.inputs.push_back(surface(c.inputs[0].vertices, {{0, 1, 2}}));
    set_parents(c.claim, 0, {0, 2, 3});
    c.claim.duplicates.push_back({3, 0});
    c.claim.intersection_edges = {{0, 2}}; // but a duplicate in another surface makes one
    CHECK(verdict(c).empty());
}

TEST_CASE("verify_arrangement: parents are counted surface by surface") {
    // Both triangles at the diagonal 0, 2 have two parents: one has one of each surface, the other
    // two of the first.
    Case c;
    c.inputs = {surface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}},
                        {{0, 1, 2}, {0, 2, 3}, {0, 2, 4}}),
                surface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}})};
    c.claim.vertices = input_vertices(5);
    add_triangle(c.claim, {0, 1, 2}, {0, 3});
    add_triangle(c.claim, {0, 2, 3}, {1, 2});
    add_triangle(c.claim, {0, 3, 4}, {2});
    c.claim.duplicates = {{3, 0}};
    c.claim.intersection_edges = {{0, 2}, {0, 3}};
    CHECK(verdict(c).empty());
}

TEST_CASE("verify_arrangement is invariant under powers of two and permuted axes") {
    for (const Case& original : {crossing(), three_planes_meet(), twins()}) {
        for (const double factor : {0x1p-1060, 0x1p-300, 0.125, 0x1p300, 0x1p1000}) {
            Case c = original;
            transform(c, [&](const Point3& p) {
                return Point3{p.x * factor, p.y * factor, p.z * factor};
            });
            CHECK(verdict(c).empty());
            transform(c, [&](const Point3& p) { return Point3{p.z, p.x, -p.y}; });
            CHECK(verdict(c).empty());
        }
    }
}

TEST_CASE("verify_arrangement accepts three crossing triangles in general position") {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> noise(-0.01, 0.01);
    for (int i = 0; i < 50; ++i) {
        Case c = three_planes_meet();
        transform(c, [&](const Point3& p) {
            return Point3{p.x + noise(random), p.y + noise(random), p.z + noise(random)};
        });
        CHECK(verdict(c).empty());
        drop_triangle(c.claim, static_cast<std::size_t>(i % 27));
        CHECK(verdict(c).find("R6") != std::string::npos);
    }
}

TEST_CASE("verify_arrangement names the elements at fault") {
    Case c = crossing();
    set_parents(c.claim, 5, {0});
    const auto violations = verify_arrangement(c.inputs, c.claim);
    REQUIRE(violations.size() == 2);
    CHECK(violations[0].rule == Rule::R6_parents);
    CHECK(violations[0].elements == Indices{0, 5});
    CHECK(violations[0].sentence == "triangle 5 does not lie within its parent, input triangle 0");
    CHECK(violations[1].elements == Indices{1});
}
