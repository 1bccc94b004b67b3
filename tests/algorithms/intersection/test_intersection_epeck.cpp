// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares random pairs of triangles on a small lattice, on which every kind of contact is common,
// with CGAL's intersection in its exact kernel.
#include "support/contact_oracle.hpp"
#include "support/effort.hpp"
#include "support/points.hpp"

#include <catch2/catch.hpp>

#include <map>

namespace {

using namespace terrane;
using namespace test_support;
using contact_oracle::Corners;

constexpr int width = 4; // lattice points per axis

Corners lattice_points() {
    std::vector<Point3> points;
    for (int i = 0; i < width * width * width; ++i)
        points.push_back({double(i % width), double(i / width % width), double(i / width / width)});
    return Corners(std::move(points));
}

/// Returns a triangle with an area; if `flat`, in the plane z = 0.
Triangle random_triangle(Random& random, const Corners& lattice, bool flat) {
    const int end = flat ? width * width : width * width * width;
    for (;;) {
        Triangle t;
        for (auto& v : t) v = static_cast<std::uint32_t>(random_int(random, 0, end - 1));
        const auto n = oracle::plane(lattice.exact[t[0]], lattice.exact[t[1]], lattice.exact[t[2]]);
        if (n[0] != 0 || n[1] != 0 || n[2] != 0) return t;
    }
}

} // namespace

TEST_CASE("improper_contact agrees with CGAL's intersection on random lattice triangles") {
    const Corners lattice = lattice_points();
    Random random(61);
    std::map<std::size_t, int> seen; // by number of common corners
    for (int i = 0; i < cases(100'000); ++i) {
        const bool flat = random_int(random, 0, 2) == 0;
        const Triangle s = random_triangle(random, lattice, flat);
        const Triangle t = random_triangle(random, lattice, flat);
        if (contact_oracle::shared_corners(s, t).size() == 3) continue;
        const auto contact = improper_contact(lattice.points, s, t);
        INFO(s[0] << " " << s[1] << " " << s[2] << ", " << t[0] << " " << t[1] << " " << t[2]);
        REQUIRE(contact_oracle::flaw(lattice, s, t, contact) == "");
        if (contact) ++seen[contact_oracle::by_terrane(lattice, s, t, contact).size()];
    }
    for (std::size_t corners = 1; corners <= 6; ++corners)
        CHECK(seen[corners] > cases(50'000) / 1000);
}
