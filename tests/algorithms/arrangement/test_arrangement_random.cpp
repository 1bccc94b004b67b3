// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Random soups, mostly degenerate: the verifier judges them, and some changes must not affect the
// result.
#include "support/claim.hpp"
#include "support/effort.hpp"
#include "support/points.hpp"
#include "support/shapes.hpp"
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/kernel/predicates.hpp>

#include <catch2/catch.hpp>

#include <functional>

namespace {

using namespace terrane;
using namespace test_support;

enum class Shape {
    lattice,  ///< corners on a lattice of three points per axis
    stacked,  ///< coplanar sheets: three planes, two of which cross
    flat,     ///< all in one tilted plane
    fans,     ///< few vertices, so that most triangles share some
    rational, ///< multiples of 0.1
    slivers,  ///< long and thin
    uniform,
};

constexpr std::array all_shapes{Shape::lattice,  Shape::stacked, Shape::flat,   Shape::fans,
                                Shape::rational, Shape::slivers, Shape::uniform};

Point3 corner(Random& random, Shape shape) {
    const auto integer = [&](int high) { return double(random_int(random, 0, high)); };
    const double a = integer(4), b = integer(4);
    switch (shape) {
    case Shape::stacked:
        return std::array{Point3{a, b, 0}, Point3{a, b, 1},
                          Point3{a, 1, b}}[static_cast<std::size_t>(random_int(random, 0, 2))];
    case Shape::flat:
        return {a, b, 2 * a - b};
    case Shape::rational:
        return point_of([&] { return 0.1 * random_int(random, 0, 9); });
    case Shape::slivers:
        return {100 * a, b, integer(1)};
    case Shape::uniform:
        return point_of([&] { return random_real(random, 0, 1); });
    default:
        return point_of([&] { return integer(2); });
    }
}

/// Returns the corners of a random triangle; those of a stacked one lie in the same sheet.
std::array<Point3, 3> corners(Random& random, Shape shape) {
    std::array<Point3, 3> t;
    for (auto& p : t) p = corner(random, shape);
    if (shape == Shape::stacked) {
        const int sheet = random_int(random, 0, 2);
        for (auto& p : t) {
            const double u = random_int(random, 0, 4), v = random_int(random, 0, 4);
            p = sheet == 2 ? Point3{u, 1, v - 2} : Point3{u, v, double(sheet)};
        }
    }
    return t;
}

/// Returns `count` triangles in one to three surfaces.
std::vector<Surface> random_soup(Random& random, Shape shape, int count) {
    std::vector<Surface> surfaces(static_cast<std::size_t>(random_int(random, 1, 3)));
    std::vector<Point3> few;
    for (int i = 0; i < 7; ++i) few.push_back(corner(random, Shape::lattice));
    for (int i = 0; i < count; ++i) {
        Surface& s = surfaces[static_cast<std::size_t>(i) % surfaces.size()];
        const auto first = static_cast<std::uint32_t>(s.vertices.size());
        for (const Point3& p : corners(random, shape))
            s.vertices.push_back(
                shape == Shape::fans ? few[static_cast<std::size_t>(random_int(random, 0, 6))] : p);
        s.triangles.push_back({first, first + 1, first + 2});
    }
    return surfaces;
}

void transform(std::vector<Surface>& surfaces, const std::function<Point3(const Point3&)>& map) {
    for (Surface& s : surfaces)
        for (Point3& p : s.vertices) p = map(p);
}

/// Returns a mostly small number: the verifier takes long for many triangles that all cross.
int random_count(Random& random) {
    const int size = random_int(random, 0, 19);
    return size == 0 ? random_int(random, 25, 40) : random_int(random, 3, size < 6 ? 16 : 8);
}

/// Checks `count` soups of each shape, with at most `most` triangles each.
void check_soups(std::uint64_t seed, int count, int most,
                 const std::function<void(Random&, std::vector<Surface>&)>& change) {
    Random random(seed);
    for (const Shape shape : all_shapes)
        for (int i = 0; i < cases(count); ++i) {
            auto soup = random_soup(random, shape, std::min(most, random_count(random)));
            change(random, soup);
            const std::string found = flaws(soup);
            if (!found.empty()) FAIL(found);
        }
}

using Vertices = std::vector<Construction>;

Vertices constructions(const Arrangement& a) {
    Vertices all;
    for (const PointIndex p : a.vertices) all.push_back(a.state->points.construction(p));
    return all;
}

bool same(const Arrangement& a, const Arrangement& b) {
    return constructions(a) == constructions(b) && a.triangles == b.triangles &&
           a.parents_of == b.parents_of && a.surfaces_of == b.surfaces_of &&
           a.intersection_edges == b.intersection_edges && a.degenerate == b.degenerate &&
           a.inputs.duplicates == b.inputs.duplicates;
}

/// Tells whether 1 and 2 threads and all search methods give the same arrangement.
bool always_the_same(const std::vector<Surface>& surfaces) {
    const auto first = arrange(surfaces);
    if (!first) return false;
    for (int m = 0; m <= static_cast<int>(Search::brute); ++m)
        for (const unsigned threads : {1u, 2u}) {
            const auto other = arrange(surfaces, {static_cast<Search>(m)},
                                       {.threads = threads, .stop = {}, .progress = {}});
            if (!other || !same(first.value(), other.value())) return false;
        }
    return true;
}

/// Returns a sheet of n x n squares over the unit square, with random heights.
Surface rough_sheet(Random& random, unsigned n, double roughness) {
    return unit_grid(n, n, [&](double u, double v) {
        return Point3{u, v, random_real(random, 0, roughness)};
    });
}

} // namespace

TEST_CASE("random soups: arrangements hold for the verifier") {
    check_soups(81, 250, 40, [](Random&, auto&) {});
}

TEST_CASE("random soups nudged by one ulp") {
    check_soups(82, 60, 12, [](Random& random, auto& soup) {
        const double size = random_int(random, 0, 1) ? 1 : 0.1;
        transform(soup, [&](const Point3& p) {
            return nudged(random, Point3{size * p.x, size * p.y, size * p.z});
        });
    });
}

TEST_CASE("random soups at UTM coordinates") {
    check_soups(83, 60, 40, [](Random& random, auto& soup) {
        const double step = random_int(random, 0, 1) ? 1 : 0.01;
        transform(soup, [&](const Point3& p) {
            return Point3{5e5 + step * p.x, 4.2e6 + step * p.y, step * p.z};
        });
    });
}

TEST_CASE("random soups times powers of two, and of other scales") {
    check_soups(84, 60, 40, [](Random& random, auto& soup) {
        const std::array sizes{0x1p-1060, 0x1p-1022, 0x1p-500, 0x1p-300, 1e-300,
                               0x1p300,   0x1p500,   1e300,    0x1p1010, 3.4e38};
        const double size = sizes[static_cast<std::size_t>(random_int(random, 0, 9))];
        transform(soup, [&](const Point3& p) {
            return Point3{size * p.x, size * p.y, size * p.z};
        });
    });
}

TEST_CASE("random soups whose axes have scales of their own") {
    check_soups(85, 40, 40, [](Random& random, auto& soup) {
        const double x = std::ldexp(1, random_int(random, -1000, 900)),
                     y = std::ldexp(1, random_int(random, -1000, 900));
        transform(soup, [&](const Point3& p) { return Point3{x * p.x, y * p.y, p.z}; });
    });
}

TEST_CASE("arrangements depend on neither threads nor search method") {
    Random random(86);
    for (const Shape shape : all_shapes)
        for (int i = 0; i < cases(20); ++i)
            REQUIRE(always_the_same(random_soup(random, shape, random_count(random))));
    // There are enough triangles for several blocks of work.
    std::vector<Surface> sheets;
    for (int k = 0; k < 3; ++k) sheets.push_back(rough_sheet(random, 30, 0.1));
    REQUIRE(always_the_same(sheets));
}

TEST_CASE("arrangements of powers of two and of turned axes are the same") {
    Random random(87);
    for (const Shape shape : all_shapes)
        for (int i = 0; i < cases(20); ++i) {
            auto soup = random_soup(random, shape, random_int(random, 3, 12));
            const auto first = arrange(soup);
            REQUIRE(first);
            const auto vertices = first.value().vertices.size();
            transform(soup, [](const Point3& p) {
                return Point3{0x1p-700 * p.x, 0x1p-700 * p.y, 0x1p-700 * p.z};
            });
            const auto scaled = arrange(soup);
            REQUIRE(scaled);
            REQUIRE(same(first.value(), scaled.value()));
            transform(soup, [](const Point3& p) { return Point3{p.y, p.z, p.x}; });
            const auto turned = arrange(soup); // projected along another axis, with other diagonals
            REQUIRE(turned);
            REQUIRE(turned.value().vertices.size() == vertices);
            REQUIRE(turned.value().triangles.size() == first.value().triangles.size());
            REQUIRE(turned.value().intersection_edges.size() ==
                    first.value().intersection_edges.size());
        }
}

TEST_CASE("larger sheets that cross hold for the verifier") {
    Random random(88);
    std::vector<Surface> sheets;
    for (int k = 0; k < 3; ++k) sheets.push_back(rough_sheet(random, cases(20) > 1 ? 20 : 6, 0.1));
    const std::string found = flaws(sheets);
    if (!found.empty()) FAIL(found.substr(0, 2000));
}
