// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>

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

TEST_CASE("shape: SICN and mean ratio of known tetrahedra", "[tetrahedra]") {
    const Corners upright{regular[0], regular[2], regular[1], regular[3]};
    CHECK(inverse_condition(upright) == Approx(1));
    CHECK(inverse_condition(regular) == Approx(-1)); // inverted
    CHECK(mean_ratio(upright) == Approx(1));
    CHECK(mean_ratio(regular) == Approx(1));
    // From the definitions, by NumPy.
    const Corners oblique{{{0, 0, 0}, {1, 0, 0}, {3, 5, 0}, {1, 2, 0.5}}};
    CHECK(inverse_condition(of_cube) == Approx(0.8164965809277261));
    CHECK(inverse_condition(oblique) == Approx(0.20453172095502542));
    CHECK(mean_ratio(of_cube) == Approx(0.839947366596582));
    CHECK(mean_ratio(oblique) == Approx(0.16051604035548517));
    const Corners flat{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    CHECK(inverse_condition(flat) == 0);
    CHECK(mean_ratio(flat) == 0);
    const auto shape = shape_of(mesh_of({upright, of_cube, flat}));
    CHECK(shape.count == 3);
    CHECK(shape.sicn.mean == Approx((1 + 0.8164965809277261) / 3));
    CHECK(shape.mean_ratio_histogram[0] == 1);
    CHECK(shape.mean_ratio_histogram[8] == 1);
    CHECK(shape.mean_ratio_histogram[9] == 1);
}

TEST_CASE("shape: why tetrahedra are bad", "[tetrahedra]") {
    const double thin = 0.05;
    const Corners wedge{{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 1, thin}}};
    const Corners sliver{{{0, 0, 0}, {1, 0, thin}, {1, 1, 0}, {0, 1, thin}}};
    const auto count = [](const Corners& corners, const std::vector<Triangle>& faces) {
        TetrahedralMesh mesh = mesh_of({corners});
        mesh.faces = faces;
        std::array<std::size_t, bad_causes> counts{};
        const auto shape = shape_of(mesh);
        for (std::size_t i = 0; i < bad_causes; ++i) counts[i] = shape.bad[i].count;
        return counts;
    };
    using Counts = std::array<std::size_t, bad_causes>;
    CHECK(count(regular, {{0, 1, 2}, {0, 1, 3}}) == Counts{0, 0, 0, 0});
    CHECK(count(wedge, {{1, 0, 2}, {0, 1, 3}}) == Counts{1, 0, 0, 0}); // at the angle itself
    CHECK(count(wedge, {{1, 0, 2}, {0, 2, 3}}) == Counts{0, 1, 0, 0}); // 0, 2, 3 is thin
    CHECK(count(wedge, {{2, 0, 1}}) == Counts{0, 0, 0, 1});            // 3 is on no surface
    CHECK(count(sliver, {{0, 1, 2}, {1, 2, 3}}) == Counts{1, 0, 0, 0});
    CHECK(count(sliver, {}) == Counts{0, 0, 0, 1});
    // All corners are on surfaces, none of the faces is.
    TetrahedralMesh mesh = mesh_of({sliver, regular});
    mesh.faces = {{0, 1, 4}, {2, 3, 5}};
    const auto shape = shape_of(mesh);
    CHECK(shape.bad[static_cast<std::size_t>(BadCause::gap)].count == 1);
    CHECK(shape.bad[static_cast<std::size_t>(BadCause::gap)].least < bad_angle);
    CHECK(shape.bad[static_cast<std::size_t>(BadCause::gap)].place.x == Approx(0.5));
}
