// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/tetrahedra_shape.hpp>

#include <cmath>
#include <numbers>
#include <numeric>

#include <catch2/catch.hpp>

#include "support/points.hpp"

using namespace terrane;
using namespace test_support;

namespace {

using Corners = std::array<Point3, 4>;

const Corners regular{{{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}};
const Corners of_cube{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}};

TetrahedralMesh mesh_of(const std::vector<Corners>& all) {
    TetrahedralMesh mesh;
    for (const Corners& corners : all) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
        mesh.tetrahedra.push_back({first, first + 1, first + 2, first + 3});
    }
    return mesh;
}

} // namespace

TEST_CASE("shape: angles and ratios of known tetrahedra", "[tetrahedra]") {
    for (const double angle : dihedral_angles(regular))
        CHECK(angle == Approx(std::acos(1.0 / 3) * 180 / std::numbers::pi));
    CHECK(radius_edge_ratio(regular) == Approx(std::sqrt(6.0) / 4));
    // A corner of a cube has right angles at its three edges, and the circumcentre is the cube's
    // centre.
    const auto angles = dihedral_angles(of_cube);
    for (const std::size_t i : {0, 1, 2}) CHECK(angles[i] == Approx(90));
    for (const std::size_t i : {3, 4, 5})
        CHECK(angles[i] == Approx(std::acos(1 / std::sqrt(3.0)) * 180 / std::numbers::pi));
    CHECK(radius_edge_ratio(of_cube) == Approx(std::sqrt(3.0) / 2));
    const Corners flat{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    CHECK(std::isinf(radius_edge_ratio(flat)));
    CHECK(dihedral_angles(flat)[1] == Approx(180)); // a diagonal
    CHECK(dihedral_angles(flat)[0] == Approx(0).margin(1e-12));
}

TEST_CASE("shape: turning, moving and scaling change nothing", "[tetrahedra]") {
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        Corners a, b;
        for (std::size_t k = 0; k < 4; ++k) {
            const auto number = [&] { return double(random_int(random, -50, 50)); };
            a[k] = point_of(number);
            b[k] = {4 * a[k].y - 8, 4 * a[k].z + 16, 4 * a[k].x + 32};
        }
        const auto angles = dihedral_angles(a), turned = dihedral_angles(b);
        for (std::size_t k = 0; k < 6; ++k) CHECK(angles[k] == Approx(turned[k]).margin(1e-9));
        if (std::isfinite(radius_edge_ratio(a))) {
            CHECK(radius_edge_ratio(a) == Approx(radius_edge_ratio(b)));
            CHECK(radius_edge_ratio(a) > 0.6123);
        }
    }
}

TEST_CASE("shape: the whole range of doubles, down to slivers a hair thick", "[tetrahedra]") {
    const Corners sliver{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0x1p-50}, {0, 1, 0}}};
    for (const Corners& corners : {regular, of_cube, sliver})
        for (const int shift : {-900, -300, 300, 900}) {
            Corners scaled = corners;
            for (Point3& p : scaled)
                p = {std::ldexp(p.x, shift), std::ldexp(p.y, shift), std::ldexp(p.z, shift)};
            CHECK(dihedral_angles(scaled) == dihedral_angles(corners));
            CHECK(radius_edge_ratio(scaled) == radius_edge_ratio(corners));
        }
}

TEST_CASE("shape: histograms count each angle and each tetrahedron once", "[tetrahedra]") {
    const auto shape = shape_of(mesh_of({regular, of_cube, of_cube}));
    std::array<std::size_t, dihedral_bins> dihedral{};
    dihedral[7] = 6; // 70.5 degrees
    dihedral[5] = 6; // 54.7
    dihedral[9] = shape.dihedral_histogram[9];
    dihedral[8] = 6 - dihedral[9]; // 90 degrees, up to rounding
    CHECK(shape.dihedral_histogram == dihedral);
    CHECK(shape.radius_edge_histogram[0] == 1);
    CHECK(shape.radius_edge_histogram[1] == 2);
    CHECK(shape.dihedral.least == Approx(54.7356).margin(1e-3));
    CHECK(shape.dihedral.largest == Approx(90));
    CHECK(shape.radius_edge.mean == Approx((0.612372 + 2 * 0.866025) / 3).margin(1e-5));
    const Corners flat{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    const auto worst = shape_of(mesh_of({flat}));
    CHECK(worst.radius_edge_histogram.back() == 1);
    CHECK(worst.dihedral_histogram.back() == 2);
    CHECK(std::accumulate(worst.dihedral_histogram.begin(), worst.dihedral_histogram.end(),
                          std::size_t(0)) == 6);
    const auto none = shape_of({});
    CHECK(none.dihedral.largest == 0);
    CHECK(none.radius_edge.least == 0);
}
