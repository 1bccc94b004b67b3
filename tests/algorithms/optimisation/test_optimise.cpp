// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/optimisation/optimise.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include <gmpxx.h>

#include <terrane/algorithms/tetrahedra/tetrahedra_shape.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

using Cell = std::array<std::uint32_t, 4>;

/// n^3 cubes of six tetrahedra each. Vertices inside of a region are displaced at random by up to
/// `disorder` edges, as long as no tetrahedron is inverted. The plane z = wall divides the cubes
/// into regions 1 and 2; none if it is 0.
class Cubes {
public:
    Cubes(int n, int wall, double disorder, std::uint64_t seed) : n_(n), wall_(wall) {
        for (int k = 0; k <= n; ++k)
            for (int j = 0; j <= n; ++j)
                for (int i = 0; i <= n; ++i)
                    mesh.vertices.push_back({double(i), double(j), double(k)});
        for (int k = 0; k < n; ++k)
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) add_cube(i, j, k);
        mesh.region_count = 3;
        mesh.surfaces = {{"wall", Role::horizon}, {"box", Role::boundary}};
        add_faces();
        displace(disorder, seed);
    }

    TetrahedralMesh mesh;

private:
    [[nodiscard]] std::uint32_t at(int i, int j, int k) const {
        return static_cast<std::uint32_t>((k * (n_ + 1) + j) * (n_ + 1) + i);
    }

    void add_cube(int i, int j, int k) {
        std::array<int, 3> order{0, 1, 2};
        do { // a path along the axes, in each order
            std::array<int, 3> p{i, j, k};
            Cell cell{at(i, j, k)};
            for (std::size_t s = 0; s < 3; ++s) {
                ++p[static_cast<std::size_t>(order[s])];
                cell[s + 1] = at(p[0], p[1], p[2]);
            }
            const auto& v = mesh.vertices;
            if (orient3d(v[cell[0]], v[cell[1]], v[cell[2]], v[cell[3]]) != Sign::Positive)
                std::swap(cell[2], cell[3]);
            mesh.tetrahedra.push_back(cell);
            mesh.region_of.push_back(wall_ > 0 && k >= wall_ ? 2 : 1);
        } while (std::next_permutation(order.begin(), order.end()));
    }

    void add_faces() {
        std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>> beside;
        for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
            for (unsigned k = 0; k < 4; ++k) {
                const Cell& c = mesh.tetrahedra[t];
                std::array<std::uint32_t, 3> face{c[(k + 1) % 4], c[(k + 2) % 4], c[(k + 3) % 4]};
                std::sort(face.begin(), face.end());
                beside[face].push_back(mesh.region_of[t]);
            }
        for (const auto& [face, regions] : beside) {
            const bool inside = regions.size() == 2;
            if (inside && regions[0] == regions[1]) continue;
            mesh.faces.push_back({face[0], face[1], face[2]});
            mesh.face_triangle.push_back(inside ? 0 : UINT32_MAX);
            mesh.surfaces_of.push_back(std::array<std::uint32_t, 1>{inside ? 0U : 1U});
        }
    }

    void displace(double disorder, std::uint64_t seed) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> by(-disorder, disorder);
        std::vector<bool> fixed(mesh.vertices.size(), false);
        for (const Triangle& f : mesh.faces)
            for (const std::uint32_t v : f) fixed[v] = true;
        for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
            if (fixed[v]) continue;
            const Point3 before = mesh.vertices[v];
            mesh.vertices[v] = {before.x + by(random), before.y + by(random),
                                before.z + by(random)};
            const auto& p = mesh.vertices;
            for (const Cell& c : mesh.tetrahedra)
                if (std::find(c.begin(), c.end(), v) != c.end() &&
                    orient3d(p[c[0]], p[c[1]], p[c[2]], p[c[3]]) != Sign::Positive)
                    mesh.vertices[v] = before;
        }
    }

    int n_, wall_;
};

std::array<Point3, 4> corners_of(const TetrahedralMesh& mesh, const Cell& c) {
    return {mesh.vertices[c[0]], mesh.vertices[c[1]], mesh.vertices[c[2]], mesh.vertices[c[3]]};
}

/// Sines of the worst dihedral angles, by the angles that are reported, ascending.
std::vector<double> sines(const TetrahedralMesh& mesh) {
    std::vector<double> all;
    for (const Cell& c : mesh.tetrahedra) {
        double least = 1;
        for (const double degrees : dihedral_angles(corners_of(mesh, c)))
            least = std::min(least, std::sin(degrees * std::numbers::pi / 180));
        all.push_back(least);
    }
    std::sort(all.begin(), all.end());
    return all;
}

/// The qualities as optimise.hpp defines them, by the angles that are reported, ascending.
std::vector<double> qualities(const TetrahedralMesh& mesh) {
    std::vector<double> all;
    for (const Cell& c : mesh.tetrahedra) {
        double least = 1;
        for (const double degrees : dihedral_angles(corners_of(mesh, c)))
            least = std::min(least,
                             std::sin(degrees * std::numbers::pi / 180) * (degrees > 90 ? 0.7 : 1));
        all.push_back(least);
    }
    std::sort(all.begin(), all.end());
    return all;
}

double least_quality(const TetrahedralMesh& mesh) {
    return qualities(mesh)[0];
}

mpq_class six_volumes(const TetrahedralMesh& mesh, std::uint32_t region) {
    mpq_class sum = 0;
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
        if (mesh.region_of[t] != region) continue;
        const auto p = corners_of(mesh, mesh.tetrahedra[t]);
        std::array<std::array<mpq_class, 3>, 3> e;
        for (std::size_t k = 0; k < 3; ++k)
            e[k] = {mpq_class(p[k + 1].x) - p[0].x, mpq_class(p[k + 1].y) - p[0].y,
                    mpq_class(p[k + 1].z) - p[0].z};
        sum += e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
               e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
               e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    }
    return sum;
}

/// Checks what is promised of the tetrahedra, but for their shapes. `beside_wall`: the regions beside
/// faces that are not on the box.
void check_still_fills(const TetrahedralMesh& before, const TetrahedralMesh& after,
                       const std::vector<std::uint32_t>& beside_wall = {1, 2}) {
    for (const Cell& c : after.tetrahedra) {
        const auto p = corners_of(after, c);
        CHECK(orient3d(p[0], p[1], p[2], p[3]) == Sign::Positive);
    }
    for (const std::uint32_t region : {1U, 2U})
        CHECK(six_volumes(after, region) == six_volumes(before, region));
    REQUIRE(after.faces.size() == before.faces.size());
    std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>> beside;
    for (std::size_t t = 0; t < after.tetrahedra.size(); ++t)
        for (unsigned k = 0; k < 4; ++k) {
            const Cell& c = after.tetrahedra[t];
            std::array<std::uint32_t, 3> face{c[(k + 1) % 4], c[(k + 2) % 4], c[(k + 3) % 4]};
            std::sort(face.begin(), face.end());
            beside[face].push_back(after.region_of[t]);
        }
    for (std::size_t f = 0; f < after.faces.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(after.vertices[after.faces[f][k]] == before.vertices[before.faces[f][k]]);
        std::array<std::uint32_t, 3> face{after.faces[f][0], after.faces[f][1], after.faces[f][2]};
        std::sort(face.begin(), face.end());
        const auto at = beside.find(face);
        REQUIRE(at != beside.end());
        auto regions = at->second;
        std::sort(regions.begin(), regions.end());
        if (after.face_triangle[f] == UINT32_MAX)
            CHECK(regions.size() == 1);
        else
            CHECK(regions == beside_wall);
        beside.erase(at);
    }
    for (const auto& [face, regions] : beside) {
        REQUIRE(regions.size() == 2);
        CHECK(regions[0] == regions[1]);
    }
}

TEST_CASE("optimise: tetrahedra fill the same space, and the worst never gets worse",
          "[optimisation]") {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const int wall = seed % 3 == 0 ? 0 : 2;
        const TetrahedralMesh before = Cubes(4, wall, 0.3 + 0.05 * double(seed % 5), seed).mesh;
        TetrahedralMesh after = before;
        const auto report = optimise(after);
        REQUIRE(report);
        check_still_fills(before, after);
        const auto was = sines(before), is = sines(after);
        CHECK(is[0] >= was[0]);
        CHECK(report->before.quality == Approx(least_quality(before)).epsilon(1e-9));
        CHECK(report->after.quality == Approx(least_quality(after)).epsilon(1e-9));
        CHECK(report->after.quality >= report->before.quality);
        const auto shape = shape_of(after).dihedral;
        CHECK(report->after.least_angle == Approx(shape.least));
        CHECK(report->after.largest_angle == Approx(shape.largest));
        const double bad = std::sin(bad_angle * std::numbers::pi / 180);
        const auto count = [&](const std::vector<double>& all) {
            return std::lower_bound(all.begin(), all.end(), bad) - all.begin();
        };
        CHECK(20 * count(is) <= count(was) + 20);
    }
}

TEST_CASE("optimise: the mean ratio of needles with good angles is raised", "[optimisation]") {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        TetrahedralMesh mesh = Cubes(8, 0, 0.45, seed).mesh;
        REQUIRE(optimise(mesh));
        CHECK(sines(mesh)[0] > std::sin(bad_angle * std::numbers::pi / 180));
        double least = 1;
        for (const Cell& c : mesh.tetrahedra)
            least = std::min(least, mean_ratio(corners_of(mesh, c)));
        CHECK(least >= 0.25);
    }
}

TEST_CASE("optimise: a sheet that ends inside of a region stays", "[optimisation]") {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        TetrahedralMesh before = Cubes(6, 3, 0.45, seed).mesh;
        for (std::uint32_t& region : before.region_of) region = 1;
        std::vector<Triangle> faces;
        std::vector<std::uint32_t> triangles;
        before.surfaces_of = {};
        for (std::size_t f = 0; f < before.faces.size(); ++f) { // those of the wall with x <= 3
            const Triangle& face = before.faces[f];
            const bool inside = before.face_triangle[f] != UINT32_MAX;
            if (inside && std::any_of(face.begin(), face.end(),
                                      [&](std::uint32_t v) { return before.vertices[v].x > 3; }))
                continue;
            faces.push_back(face);
            triangles.push_back(before.face_triangle[f]);
            before.surfaces_of.push_back(std::array<std::uint32_t, 1>{inside ? 0U : 1U});
        }
        before.faces = faces;
        before.face_triangle = triangles;
        TetrahedralMesh after = before;
        REQUIRE(optimise(after));
        check_still_fills(before, after, {1, 1});
    }
}

TEST_CASE("optimise: the same tetrahedra give the same result, at any scale", "[optimisation]") {
    const TetrahedralMesh before = Cubes(4, 2, 0.4, 5).mesh;
    TetrahedralMesh once = before, twice = before, large = before;
    for (Point3& p : large.vertices)
        p = {std::ldexp(p.x, 900), std::ldexp(p.y, 900), std::ldexp(p.z, 900)};
    REQUIRE(optimise(once));
    REQUIRE(optimise(twice));
    REQUIRE(optimise(large));
    CHECK(once.vertices == twice.vertices);
    CHECK(once.tetrahedra == twice.tetrahedra);
    CHECK(once.tetrahedra == large.tetrahedra);
    for (std::size_t v = 0; v < once.vertices.size(); ++v)
        CHECK(std::ldexp(once.vertices[v].x, 900) == large.vertices[v].x);
}

TEST_CASE("optimise: any number of threads gives the same result", "[optimisation]") {
    const TetrahedralMesh before = Cubes(6, 3, 0.45, 7).mesh;
    TetrahedralMesh one = before;
    const auto report = optimise(one, {.wanted_angle = 40}, {.threads = 1});
    REQUIRE(report);
    CHECK(report->inserted + report->moved > 100);
    for (const unsigned threads : {2U, 3U, 7U}) {
        TetrahedralMesh several = before;
        const auto again = optimise(several, {.wanted_angle = 40}, {.threads = threads});
        REQUIRE(again);
        CHECK(several.vertices == one.vertices);
        CHECK(several.tetrahedra == one.tetrahedra);
        CHECK(several.region_of == one.region_of);
        CHECK(again->moved == report->moved);
    }
}

TEST_CASE("optimise: a limit of effort ends the work early, with a sound result",
          "[optimisation]") {
    const TetrahedralMesh before = Cubes(6, 3, 0.45, 7).mesh;
    TetrahedralMesh whole = before;
    const auto all = optimise(whole, {.wanted_angle = 40}, {.threads = 1});
    REQUIRE(all);
    CHECK_FALSE(all->is_cut_short);
    const double least_sine = sines(before)[0];
    const std::vector<double> was = qualities(before);
    for (const std::size_t most : {std::size_t{1}, all->effort / 16, all->effort / 4}) {
        TetrahedralMesh one = before, two = before;
        const OptimiseOptions options{.wanted_angle = 40, .max_effort = most};
        const auto report = optimise(one, options, {.threads = 1});
        REQUIRE(report);
        REQUIRE(optimise(two, options, {.threads = 2}));
        CHECK(report->is_cut_short);
        CHECK(report->untried > 0);
        CHECK(report->effort >= most);
        // The proposals of a batch are all measured.
        CHECK(report->effort < all->effort / 2);
        CHECK(one.vertices == two.vertices);
        CHECK(one.tetrahedra == two.tetrahedra);
        CHECK(one.region_of == two.region_of);
        check_still_fills(before, one);
        CHECK(sines(one)[0] >= least_sine);
        CHECK(qualities(one) >= was); // from the worst one on
    }
}

TEST_CASE("optimise: where doubles are no help, tetrahedra stay as they are", "[optimisation]") {
    const TetrahedralMesh good = Cubes(3, 1, 0.4, 3).mesh;
    TetrahedralMesh flat = good; // flatter than the rounding of their volumes
    for (Point3& p : flat.vertices) p.z = std::ldexp(p.z, -60);
    TetrahedralMesh far = good; // too large for products, beside which one is too small
    for (Point3& p : far.vertices)
        p = {std::ldexp(p.x, -800), std::ldexp(p.y, -800), std::ldexp(p.z, -800)};
    far.vertices.push_back({0x1p1000, 0, 0});
    for (const TetrahedralMesh& before : {flat, far}) {
        TetrahedralMesh after = before;
        const auto report = optimise(after);
        REQUIRE(report);
        CHECK(after.tetrahedra == before.tetrahedra);
        for (std::size_t v = 0; v < after.vertices.size(); ++v)
            CHECK(after.vertices[v] == before.vertices[v]);
    }
}

TEST_CASE("optimise: places are those that the mesh can have, among denormals as well",
          "[optimisation]") {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        TetrahedralMesh before = Cubes(4, 2, 0.4, seed).mesh;
        for (Point3& p : before.vertices) // multiples of 2^-1074, 64 to an edge
            p = {std::ldexp(p.x, -1068), std::ldexp(p.y, -1068), std::ldexp(p.z, -1068)};
        bool sound = true; // rounding may have turned one over
        for (const Cell& c : before.tetrahedra) {
            const auto p = corners_of(before, c);
            sound = sound && orient3d(p[0], p[1], p[2], p[3]) == Sign::Positive;
        }
        if (!sound) continue;
        TetrahedralMesh after = before;
        const auto report = optimise(after, {.wanted_angle = 40});
        REQUIRE(report);
        CHECK(report->moved > 0);
        check_still_fills(before, after);
        for (TetrahedralMesh* mesh : {&before, &after})
            for (Point3& p : mesh->vertices)
                p = {std::ldexp(p.x, 1068), std::ldexp(p.y, 1068), std::ldexp(p.z, 1068)};
        CHECK(report->after.quality == Approx(least_quality(after)).epsilon(1e-9));
        CHECK(least_quality(after) >= least_quality(before));
    }
}

TEST_CASE("optimise: the outside stays as it is on request", "[optimisation]") {
    TetrahedralMesh before = Cubes(4, 2, 0.45, 9).mesh;
    for (std::uint32_t& region : before.region_of) region = region == 2 ? 0 : 1;
    TetrahedralMesh after = before;
    REQUIRE(optimise(after, {.outside = false}));
    const auto outside = [](const TetrahedralMesh& mesh) {
        std::multiset<std::vector<std::array<double, 3>>> all;
        for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
            if (mesh.region_of[t] != 0) continue;
            std::vector<std::array<double, 3>> corners;
            for (const std::uint32_t v : mesh.tetrahedra[t])
                corners.push_back({mesh.vertices[v].x, mesh.vertices[v].y, mesh.vertices[v].z});
            std::sort(corners.begin(), corners.end());
            all.insert(corners);
        }
        return all;
    };
    CHECK(outside(after) == outside(before));
    CHECK(after.vertices != before.vertices);
}

TEST_CASE("optimise: good tetrahedra stay as they are", "[optimisation]") {
    const TetrahedralMesh before = Cubes(3, 1, 0, 1).mesh;
    TetrahedralMesh after = before;
    const auto report = optimise(after);
    REQUIRE(report);
    CHECK(after.tetrahedra == before.tetrahedra);
    CHECK(after.vertices == before.vertices);
    CHECK(report->removed_edges + report->removed_faces + report->moved + report->contracted +
              report->inserted ==
          0);
}

TEST_CASE("optimise: an edge with three flat tetrahedra around it goes", "[optimisation]") {
    TetrahedralMesh mesh;
    mesh.vertices = {{0, 0, -0.5}, {0, 0, 0.5}};
    mesh.vertices[0].z = -0.4;
    mesh.vertices[1].z = 0.4;
    for (int k = 0; k < 3; ++k)
        mesh.vertices.push_back({std::cos(2.1 * k) * 4, std::sin(2.1 * k) * 4, 0});
    mesh.tetrahedra = {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 2}};
    mesh.region_of = {1, 1, 1};
    mesh.region_count = 2;
    for (const Cell& c : mesh.tetrahedra) {
        const auto p = corners_of(mesh, c);
        REQUIRE(orient3d(p[0], p[1], p[2], p[3]) == Sign::Positive);
        for (const std::uint32_t end : {c[0], c[1]}) {
            mesh.faces.push_back({end, c[2], c[3]});
            mesh.face_triangle.push_back(UINT32_MAX);
            mesh.surfaces_of.push_back(std::array<std::uint32_t, 1>{0});
        }
    }
    mesh.surfaces = {{"box", Role::boundary}};
    const double before = sines(mesh)[0];
    TetrahedralMesh after = mesh;
    const auto report = optimise(after, {.wanted_angle = 50});
    REQUIRE(report);
    CHECK(sines(after)[0] >= before);
    check_still_fills(mesh, after);
}

TEST_CASE("optimise: on request no tetrahedron is larger than the largest before",
          "[optimisation]") {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const TetrahedralMesh before = Cubes(4, 2, 0.45, seed).mesh;
        const auto largest = [](const TetrahedralMesh& mesh) {
            double most = 0;
            for (const Cell& c : mesh.tetrahedra) {
                TetrahedralMesh one;
                one.vertices = mesh.vertices;
                one.tetrahedra = {c};
                one.region_of = {1};
                most = std::max(most, six_volumes(one, 1).get_d());
            }
            return most;
        };
        TetrahedralMesh free = before, bounded = before;
        REQUIRE(optimise(free));
        REQUIRE(optimise(bounded, {.may_grow = false}));
        CHECK(largest(bounded) <= largest(before) * (1 + 1e-12));
        check_still_fills(before, bounded);
    }
}

/// Cubes in which a vertex of the wall z = 2 is near an opposite edge of a triangle there, so that
/// tetrahedra are flat that no change inside of the regions makes better.
TetrahedralMesh crowded_wall(std::uint32_t& moved) {
    Cubes cubes(4, 2, 0, 1);
    moved = 2 * 25 + 2 * 5 + 2;
    REQUIRE(cubes.mesh.vertices[moved] == Point3{2, 2, 2});
    cubes.mesh.vertices[moved] = {2.99, 2.5, 2};
    return cubes.mesh;
}

OptimiseOptions with_free(const TetrahedralMesh& mesh, const std::vector<std::uint32_t>& vertices) {
    OptimiseOptions options;
    options.freedom.is_free.resize(mesh.vertices.size());
    for (const std::uint32_t v : vertices) options.freedom.is_free[v] = true;
    options.freedom.place = [](std::uint32_t, const Point3& p) { return Point3{p.x, p.y, 2}; };
    return options;
}

/// Returns the corners of faces that have moved, and where they are then.
std::map<std::uint32_t, Point3> moved_corners(const TetrahedralMesh& before,
                                              const TetrahedralMesh& after) {
    std::map<std::uint32_t, Point3> moved;
    for (std::size_t f = 0; f < before.faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const Point3& now = after.vertices[after.faces[f][k]];
            if (!(now == before.vertices[before.faces[f][k]])) moved[before.faces[f][k]] = now;
        }
    return moved;
}

TEST_CASE("optimise: a free vertex on a wall moves where tetrahedra are bad, as it may",
          "[optimisation]") {
    std::uint32_t crowded = 0;
    const TetrahedralMesh before = crowded_wall(crowded);
    const double bad = std::sin(10 * std::numbers::pi / 180);
    TetrahedralMesh fixed = before;
    REQUIRE(optimise(fixed));
    CHECK(least_quality(fixed) < bad);
    CHECK(moved_corners(before, fixed).empty());

    TetrahedralMesh free = before;
    const auto report = optimise(free, with_free(before, {crowded}));
    REQUIRE(report);
    CHECK(report->loosened > 0);
    CHECK(report->loosened <= report->moved);
    CHECK(least_quality(free) > bad);
    const auto moved = moved_corners(before, free);
    REQUIRE(moved.size() == 1);
    CHECK(moved.count(crowded) == 1);
    CHECK(moved.at(crowded).z == 2); // so the regions have their volumes
    for (const std::uint32_t region : {1U, 2U})
        CHECK(six_volumes(free, region) == six_volumes(before, region));
    for (const Cell& c : free.tetrahedra) {
        const auto p = corners_of(free, c);
        CHECK(orient3d(p[0], p[1], p[2], p[3]) == Sign::Positive);
    }

    SECTION("the other vertices at the flat tetrahedra may be the ones that move") {
        TetrahedralMesh other = before;
        REQUIRE(optimise(other, with_free(before, {crowded + 1})));
        for (const auto& [v, at] : moved_corners(before, other)) CHECK(v == crowded + 1);
    }
    SECTION("it stays where no place is known") {
        auto options = with_free(before, {crowded});
        options.freedom.place = [](std::uint32_t, const Point3&) {
            return std::optional<Point3>();
        };
        TetrahedralMesh stuck = before;
        const auto none = optimise(stuck, options);
        REQUIRE(none);
        CHECK(none->loosened == 0);
        CHECK(moved_corners(before, stuck).empty());
    }
    SECTION("it moves no farther than it must") {
        CHECK(moved.at(crowded).x > 2.5);
        CHECK(moved.at(crowded).x < 2.95);
    }
    SECTION("vertices that are free stay where tetrahedra are not bad") {
        const TetrahedralMesh good = Cubes(4, 2, 0.2, 3).mesh;
        std::vector<std::uint32_t> all;
        for (std::uint32_t v = 0; v < good.vertices.size(); ++v)
            if (good.vertices[v].z == 2) all.push_back(v);
        TetrahedralMesh same = good;
        const auto none = optimise(same, with_free(good, all));
        REQUIRE(none);
        CHECK(none->loosened == 0);
        CHECK(moved_corners(good, same).empty());
    }
    SECTION("any number of threads gives the same result") {
        Run run;
        run.threads = 4;
        TetrahedralMesh parallel = before;
        REQUIRE(optimise(parallel, with_free(before, {crowded}), run));
        CHECK(parallel.vertices == free.vertices);
        CHECK(parallel.tetrahedra == free.tetrahedra);
    }
    SECTION("at another scale it moves to the same place") {
        TetrahedralMesh large = before;
        for (Point3& p : large.vertices) p = {0x1p40 * p.x, 0x1p40 * p.y, 0x1p40 * p.z};
        auto options = with_free(before, {crowded});
        options.freedom.place = [](std::uint32_t, const Point3& p) {
            return Point3{p.x, p.y, 0x1p41};
        };
        const TetrahedralMesh given = large;
        REQUIRE(optimise(large, options));
        CHECK(moved_corners(given, large).at(crowded) ==
              Point3{0x1p40 * moved.at(crowded).x, 0x1p40 * moved.at(crowded).y, 0x1p41});
    }
    SECTION("freedom is given for all vertices or for none") {
        TetrahedralMesh mesh = before;
        auto options = with_free(before, {crowded});
        options.freedom.is_free.pop_back();
        CHECK(optimise(mesh, options).error().code == ErrorCode::bad_option);
        options = with_free(before, {crowded});
        options.freedom.place = nullptr;
        CHECK(optimise(mesh, options).error().code == ErrorCode::bad_option);
        CHECK(mesh.vertices == before.vertices);
    }
}

TEST_CASE("optimise: a free vertex on a wall with much room moves where tetrahedra are needles",
          "[optimisation]") {
    Cubes cubes(4, 2, 0, 1);
    const std::uint32_t near = 2 * 25 + 2 * 5 + 2;
    cubes.mesh.vertices[near] = {2.96, 2, 2}; // beside (3, 2, 2)
    const TetrahedralMesh before = cubes.mesh;
    const auto least_ratio = [](const TetrahedralMesh& mesh) {
        double least = 1;
        for (const Cell& c : mesh.tetrahedra)
            least = std::min(least, mean_ratio(corners_of(mesh, c)));
        return least;
    };
    auto options = with_free(before, {near});
    TetrahedralMesh narrow = before;
    REQUIRE(optimise(narrow, options));
    CHECK(least_quality(narrow) > std::sin(10 * std::numbers::pi / 180)); // angles are good
    CHECK(least_ratio(narrow) < 0.2);
    CHECK(moved_corners(before, narrow).empty());

    options.freedom.is_wide = true;
    TetrahedralMesh wide = before;
    const auto report = optimise(wide, options);
    REQUIRE(report);
    CHECK(report->loosened > 0);
    CHECK(least_ratio(wide) >= 0.2);
    CHECK(least_quality(wide) > std::sin(10 * std::numbers::pi / 180));
    const auto moved = moved_corners(before, wide);
    REQUIRE(moved.size() == 1);
    CHECK(moved.at(near).z == 2);
    CHECK(moved.at(near).x > 2.5); // no farther than it must
    for (const std::uint32_t region : {1U, 2U})
        CHECK(six_volumes(wide, region) == six_volumes(before, region));
}

TEST_CASE("optimise: tetrahedra outside, which are dropped later, keep no vertex from its place",
          "[optimisation]") {
    std::uint32_t crowded = 0;
    TetrahedralMesh before = crowded_wall(crowded);
    for (std::uint32_t& region : before.region_of) region = region == 2 ? 0 : 1;
    const auto inner = [](const TetrahedralMesh& mesh) {
        TetrahedralMesh kept = mesh;
        kept.tetrahedra.clear();
        for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
            if (mesh.region_of[t] != 0) kept.tetrahedra.push_back(mesh.tetrahedra[t]);
        return kept;
    };
    // Above the wall, a vertex is so near to it that no place for the crowded one is good there.
    const std::uint32_t above = crowded + 25;
    REQUIRE(before.vertices[above] == Point3{2, 2, 3});
    before.vertices[above] = {2.2, 2.2, 2.05};
    for (const Cell& c : before.tetrahedra) {
        const auto p = corners_of(before, c);
        REQUIRE(orient3d(p[0], p[1], p[2], p[3]) == Sign::Positive);
    }
    auto options = with_free(before, {crowded});
    options.outside = false;
    TetrahedralMesh after = before;
    REQUIRE(optimise(after, options));
    CHECK(least_quality(inner(after)) > std::sin(10 * std::numbers::pi / 180));
    for (const Cell& c : after.tetrahedra) {
        const auto p = corners_of(after, c);
        CHECK(orient3d(p[0], p[1], p[2], p[3]) == Sign::Positive);
    }
    CHECK(moved_corners(before, after).count(crowded) == 1);
    CHECK(std::count(after.vertices.begin(), after.vertices.end(), before.vertices[above]) == 1);
}

TEST_CASE("optimise: refuses options that make no sense, and stops on request", "[optimisation]") {
    TetrahedralMesh mesh = Cubes(3, 0, 0.4, 2).mesh;
    const TetrahedralMesh before = mesh;
    for (const double angle : {0.0, -1.0, 60.0, std::nan("")}) {
        const auto refused = optimise(mesh, {.wanted_angle = angle});
        REQUIRE_FALSE(refused);
        CHECK(refused.error().code == ErrorCode::bad_option);
    }
    std::stop_source source;
    source.request_stop();
    Run run;
    run.stop = source.get_token();
    const auto stopped = optimise(mesh, {}, run);
    REQUIRE_FALSE(stopped);
    CHECK(stopped.error().code == ErrorCode::interrupted);
    CHECK(mesh.tetrahedra == before.tetrahedra);
    TetrahedralMesh broken = mesh;
    broken.tetrahedra[5][2] = static_cast<std::uint32_t>(broken.vertices.size());
    CHECK(optimise(broken).error().code == ErrorCode::bad_index);
    broken = mesh;
    broken.region_of.pop_back();
    CHECK(optimise(broken).error().code == ErrorCode::bad_index);
    mesh.twins.push_back({0, 1});
    CHECK(optimise(mesh).error().code == ErrorCode::bad_option);
}

} // namespace
} // namespace terrane
