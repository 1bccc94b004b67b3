// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/coverage.hpp>

#include <catch2/catch.hpp>

#include <vector>

#include "support/verify_points.hpp"

namespace {

using namespace terrane;
using namespace terrane::verifier;

using namespace verify_points;

/// Judges the coverage of the parent (0,0) (12,0) (0,12) in z = 0 by children, given by their
/// corners.
bool covered(const std::vector<Vector4>& points, const std::vector<Triangle>& children,
             int collar) {
    const Vector4 a = point(0, 0, 0), b = point(12, 0, 0), c = point(0, 12, 0);
    return Coverage({&a, &b, &c}, points, collar).holds(children);
}

} // namespace

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
