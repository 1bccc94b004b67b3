// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the predicates with CGAL's exact kernel, an implementation independent of this library.
#include "support/effort.hpp"
#include "support/points.hpp"

#include <terrane/kernel/predicates.hpp>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <catch2/catch.hpp>

namespace {

using namespace terrane;
using namespace test_support;
using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;

Epeck::Point_3 exact(const Point3& p) {
    return {p.x, p.y, p.z};
}

Epeck::Point_2 projected(Axis axis, const Point3& p) {
    if (axis == Axis::x) return {p.y, p.z};
    if (axis == Axis::y) return {p.z, p.x};
    return {p.x, p.y};
}

Sign sign(CGAL::Sign s) {
    return static_cast<Sign>(static_cast<int>(s));
}

Sign epeck_in_circle(Axis axis, const std::vector<Point3>& p) {
    return sign(CGAL::side_of_oriented_circle(projected(axis, p[0]), projected(axis, p[1]),
                                              projected(axis, p[2]), projected(axis, p[3])));
}

} // namespace

TEST_CASE("orient3d, orient2d, in_circle and collinear agree with CGAL's EPECK") {
    Random random(21);
    for (const Family family : all_families)
        for (int i = 0; i < cases(1200); ++i) {
            const auto p = points_of(random, family, 4);
            std::array<Epeck::Point_3, 4> e;
            for (unsigned k = 0; k < 4; ++k) e[k] = exact(p[k]);
            bool ok =
                orient3d(p[0], p[1], p[2], p[3]) == sign(CGAL::orientation(e[0], e[1], e[2], e[3]));
            ok = ok && collinear(p[0], p[1], p[2]) == CGAL::collinear(e[0], e[1], e[2]);
            for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
                const Sign turn_sign = sign(CGAL::orientation(
                    projected(axis, p[0]), projected(axis, p[1]), projected(axis, p[2])));
                ok = ok && orient2d(axis, p[0], p[1], p[2]) == turn_sign &&
                     in_circle(axis, p[0], p[1], p[2], p[3]) == epeck_in_circle(axis, p);
            }
            REQUIRE(ok);
        }
}
