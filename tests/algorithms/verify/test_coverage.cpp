// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/coverage.hpp>

#include <catch2/catch.hpp>

#include <cstdint>
#include <utility>
#include <vector>

#include "support/verify_points.hpp"
#include "support/verify_work.hpp"

namespace {

using namespace terrane;
using namespace terrane::verifier;

using namespace verify_points;
using verify_work::check_growth;

/// Judges the coverage of the parent (0,0) (12,0) (0,12) in z = 0 by children, given by their
/// corners.
bool covered(const std::vector<Vector4>& points, const std::vector<Triangle>& children,
             int collar) {
    const Vector4 a = point(0, 0, 0), b = point(12, 0, 0), c = point(0, 12, 0);
    const Coverage coverage({&a, &b, &c}, points, collar);
    return coverage.holds(Coverage::Facing(coverage, children));
}

/// Needles from one corner of a parent to its opposite side.
struct Needles {
    explicit Needles(int count) : size(4 * count) {
        points = {point(0, size, 0)};
        for (int i = 0; i <= count; ++i) points.push_back(point(4 * i, 0, 0));
        for (std::uint32_t i = 1; i < points.size() - 1; ++i) triangles.push_back({0, i, i + 1});
    }
    bool are_covering(int collar) const {
        const Vector4 a = point(0, 0, 0), b = point(size, 0, 0), c = point(0, size, 0);
        const Coverage coverage({&a, &b, &c}, points, collar);
        return coverage.holds(Coverage::Facing(coverage, triangles));
    }
    int size;
    std::vector<Vector4> points;
    std::vector<Triangle> triangles;
};

} // namespace

TEST_CASE("verifier: coverage takes time in proportion to the children", "[once]") {
    check_growth([](int n) { CHECK(Needles(n).are_covering(0)); });
    check_growth([](int n) { // a triangle across all needles
        Needles needles(n);
        const auto v = static_cast<std::uint32_t>(needles.points.size());
        for (const auto& [x, y] : {std::pair{1, 1}, {needles.size - 8, 1}, {1, needles.size / 2}})
            needles.points.push_back(point(x, y, 1));
        needles.triangles.push_back({v, v + 1, v + 2});
        CHECK(needles.are_covering(0));
    });
    check_growth([](int n) { // needles that have no sides in common
        Needles apart(n);
        std::vector<Vector4> points;
        for (Triangle& t : apart.triangles)
            for (std::uint32_t& corner : t) {
                points.push_back(apart.points[corner]);
                corner = static_cast<std::uint32_t>(points.size() - 1);
            }
        apart.points = points;
        CHECK_FALSE(apart.are_covering(0)); // too much to look at
    });
    check_growth([](int n) { // a side near many small triangles
        const Needles needles(n);
        const NearTriangles near(needles.points, needles.triangles, 1);
        CHECK(near.reach(point(0, 0, 0), point(needles.size, 0, 0)));
        CHECK(near.reach(point(0, 0, 0), point(0, needles.size, 0)));
    });
}

TEST_CASE("verifier: coverage of a triangle by itself, and by three around a point") {
    const std::vector<Vector4> points{point(0, 0, 0), point(12, 0, 0), point(0, 12, 0),
                                      point(3, 3, 0)};
    CHECK(covered(points, {{0, 1, 2}}, 0));
    CHECK(covered(points, {{0, 2, 1}}, 0));
    CHECK(covered(points, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, 0));
    CHECK_FALSE(covered(points, {{0, 1, 3}, {1, 2, 3}}, 0));
    CHECK_FALSE(covered(points, {{0, 1, 3}, {1, 2, 3}}, 1));
    CHECK_FALSE(covered(points, {}, 0));
    CHECK(covered(points, {{0, 1, 3}}, 4)); // all of the parent is in the collar
}

TEST_CASE("verifier: coverage by children that moved") {
    const std::vector<Vector4> lifted{point(0, 1, 1), point(12, -1, 0), point(0, 12, -1),
                                      point(3, 3, 1)};
    CHECK(covered(lifted, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, 2));
    CHECK_FALSE(covered(lifted, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, 0));
}

TEST_CASE("verifier: coverage with a fold, that others cover") {
    // Vertex 3 was pulled over the edge from 1 to 4, so that the child 1 3 4 is flipped.
    const std::vector<Vector4> points{point(0, 0, 0), point(12, 0, 0), point(0, 12, 0),
                                      point(4, 2, 0), point(3, 4, 0)};
    CHECK(covered(points, {{0, 1, 3}, {1, 4, 3}, {0, 3, 4}, {1, 2, 4}, {2, 0, 4}}, 0));
    const std::vector<Vector4> folded{point(0, 0, 0), point(12, 0, 0), point(0, 12, 0),
                                      point(4, 5, 0), point(3, 4, 0)};
    CHECK(covered(folded, {{0, 1, 3}, {1, 4, 3}, {0, 3, 4}, {1, 2, 4}, {2, 0, 4}}, 0));
    CHECK_FALSE(covered(folded, {{1, 4, 3}, {0, 3, 4}, {1, 2, 4}, {2, 0, 4}}, 0));
}

TEST_CASE("verifier: coverage is not fooled by two sheets with a hole between them") {
    // There are children on both sides of the middle line, each with a border there.
    const std::vector<Vector4> points{point(0, 0, 0), point(12, 0, 0), point(0, 12, 0),
                                      point(5, 0, 0), point(7, 0, 0),  point(0, 5, 0),
                                      point(0, 7, 0)};
    CHECK_FALSE(covered(points, {{0, 3, 5}, {4, 1, 2}, {4, 2, 6}}, 0));
    CHECK(covered(points, {{0, 3, 5}, {3, 4, 6}, {3, 6, 5}, {4, 1, 2}, {4, 2, 6}}, 0));
}
