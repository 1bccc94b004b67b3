// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Prisms between surfaces: volumes of all cells in rationals against closed forms and the base by brute force; faces
// that cells share; faults, pinch-outs, gaps and crossings.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include <gmpxx.h>

#include <terrane/algorithms/cells/prisms.hpp>

#include "support/samples.hpp"
#include "support/shapes.hpp"
#include "support/winding_oracle.hpp"

using namespace terrane;
using namespace test_support;

namespace {

/// A surface over a lattice of n x n squares of a size, from a corner, with heights z(x, y).
template <class Height>
Surface sheet(std::uint32_t n, double size, const Point3& from, const Height& z) {
    const auto node = [&](std::uint32_t i, std::uint32_t j) {
        const double x = from.x + size * i, y = from.y + size * j;
        return Point3{x, y, from.z + z(x, y)};
    };
    return grid(n, n, node, "sheet", Role::horizon);
}

template <class T>
ErrorCode refusal(const Result<T>& result) {
    REQUIRE(!result);
    return result.error().code;
}

PrismMesh prisms_of(const Surface& top, const Surface& base, const PrismOptions& options = {}) {
    auto made = make_prisms(top, base, options);
    REQUIRE(message_of(made) == "no error");
    return std::move(*made);
}

mpq_class six_volumes_of(const PrismMesh& mesh, const PrismCell& cell,
                         const std::array<std::size_t, 4>& of) {
    const Point3& p = mesh.vertices[cell.nodes[of[3]]];
    const RationalPoint origin{mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)};
    const auto at = [&](std::size_t k) {
        return between(mesh.vertices[cell.nodes[of[k]]], origin);
    };
    return -determinant(at(0), at(1), at(2));
}

/// Returns the exact volume of a cell, by tetrahedra each of which must not be turned over.
mpq_class volume_of(const PrismMesh& mesh, const PrismCell& cell) {
    static const std::vector<std::array<std::size_t, 4>> prism{
        {0, 1, 2, 3}, {1, 2, 3, 4}, {2, 3, 4, 5}};
    mpq_class sum;
    if (cell.size == 6) { // 1, 2, 3, 4 is turned over as listed
        sum = six_volumes_of(mesh, cell, prism[0]) + abs(six_volumes_of(mesh, cell, prism[1])) +
              abs(six_volumes_of(mesh, cell, prism[2]));
        CHECK(six_volumes_of(mesh, cell, prism[0]) > 0);
    } else if (cell.size == 5) {
        for (const auto& of : {std::array<std::size_t, 4>{0, 1, 2, 4}, {0, 2, 3, 4}}) {
            sum += six_volumes_of(mesh, cell, of);
            CHECK(six_volumes_of(mesh, cell, of) > 0);
        }
    } else {
        sum = six_volumes_of(mesh, cell, {0, 1, 2, 3});
        CHECK(sum > 0);
    }
    return sum / 6;
}

mpq_class volume_of(const PrismMesh& mesh) {
    mpq_class sum;
    for (const PrismCell& cell : mesh.cells) sum += volume_of(mesh, cell);
    return sum;
}

/// Counts the faces that one cell has, and those that two have; no face has more.
std::array<std::size_t, 2> faces_of(const PrismMesh& mesh) {
    static const std::map<int, std::vector<std::vector<std::size_t>>> faces{
        {6, {{0, 1, 2}, {3, 4, 5}, {0, 1, 3, 4}, {1, 2, 4, 5}, {0, 2, 3, 5}}},
        {5, {{0, 1, 2, 3}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {0, 3, 4}}},
        {4, {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}}}};
    std::map<std::vector<std::uint32_t>, std::size_t> count;
    for (const PrismCell& cell : mesh.cells)
        for (const auto& face : faces.at(cell.size)) {
            std::vector<std::uint32_t> nodes;
            for (const std::size_t k : face) nodes.push_back(cell.nodes[k]);
            std::sort(nodes.begin(), nodes.end());
            ++count[nodes];
        }
    std::array<std::size_t, 2> found{};
    for (const auto& [face, cells] : count) {
        REQUIRE(cells <= 2);
        ++found[cells - 1];
    }
    return found;
}

/// Tells whether no double is nearer to a number.
bool is_nearest(double d, const mpq_class& number) {
    const mpq_class off = abs(mpq_class(d) - number);
    return off <= abs(mpq_class(std::nextafter(d, HUGE_VAL)) - number) &&
           off <= abs(mpq_class(std::nextafter(d, -HUGE_VAL)) - number);
}

std::size_t count_of_size(const PrismMesh& mesh, int size) {
    return std::size_t(std::count_if(mesh.cells.begin(), mesh.cells.end(),
                                     [&](const PrismCell& c) { return c.size == size; }));
}

/// Returns the heights of the nodes on a vertical, ascending.
std::vector<double> heights_at(const PrismMesh& mesh, double x, double y) {
    std::vector<double> heights;
    for (const Point3& p : mesh.vertices)
        if (p.x == x && p.y == y) heights.push_back(p.z);
    std::sort(heights.begin(), heights.end());
    return heights;
}

} // namespace

TEST_CASE("prisms: planes in closed form", "[prisms]") {
    const auto flat = [](double, double) { return 0.0; };
    const auto top = sheet(4, 2, {0, 0, 5}, [](double x, double) { return x / 4; });
    const auto base = sheet(1, 20, {-5, -5, 1}, flat);
    for (const std::uint32_t layers : {1U, 2U, 7U}) {
        const auto mesh = prisms_of(top, base, {.layers = layers});
        CHECK(mesh.cells.size() == 32 * layers);
        CHECK(mesh.vertices.size() == 25 * (layers + 1));
        CHECK(mesh.gaps.empty());
        CHECK(mesh.volume == 64 * 5); // the mean of 4 .. 6
        CHECK(volume_of(mesh) == 64 * 5);
        const auto [alone, shared] = faces_of(mesh);
        CHECK(alone == 32 + 32 + 16 * layers);
        CHECK(shared == 32 * (layers - 1) + 40 * layers);
    }
}

TEST_CASE("prisms: layers that follow a surface are cut by the other one", "[prisms]") {
    const auto top = sheet(4, 2, {0, 0, 0}, [](double, double) { return 0.0; });
    const auto base = sheet(4, 2, {0, 0, 0}, [](double x, double) { return -x / 2; });
    const auto below = prisms_of(top, base, {4, PrismLayers::top, 1});
    CHECK(below.volume == 64 * 2);
    CHECK(volume_of(below) == 64 * 2);
    CHECK(count_of_size(below, 4) + count_of_size(below, 5) > 0);
    for (const Point3& p : below.vertices) CHECK((p.z == std::round(p.z) || p.z == -p.x / 2));
    CHECK(heights_at(below, 8, 0) == std::vector<double>{-4, -3, -2, -1, 0});
    CHECK(heights_at(below, 4, 2) == std::vector<double>{-2, -1, 0});
    faces_of(below);
    const auto above = prisms_of(top, base, {4, PrismLayers::base, 0.5});
    CHECK(volume_of(above) == 64 * 2);
    for (const Point3& p : above.vertices) {
        const double n = (p.z + p.x / 2) / 0.5;
        CHECK((p.z == 0 || n == std::round(n)));
    }
    CHECK(heights_at(above, 8, 0) == std::vector<double>{-4, -3.5, -3, -2.5, 0});
    CHECK(heights_at(above, 2, 2) == std::vector<double>{-1, -0.5, 0});
    faces_of(above);
}

TEST_CASE("prisms: surfaces that meet pinch out", "[prisms]") {
    const auto top = sheet(4, 1, {0, 0, 0}, [](double x, double) { return std::max(0.0, x - 2); });
    const auto base = sheet(4, 1, {0, 0, 0}, [](double, double) { return 0.0; });
    const auto mesh = prisms_of(top, base, {.layers = 2});
    CHECK(count_of_size(mesh, 6) == 2 * 8);
    CHECK(count_of_size(mesh, 5) == 2 * 4);
    CHECK(count_of_size(mesh, 4) == 2 * 4);
    CHECK(volume_of(mesh) == 8);
    CHECK(mesh.volume == 8);
    CHECK(faces_of(mesh)[0] == 2 * 16 + 2 * (4 + 2 * 2)); // a triangle each at the north and south
    CHECK(refusal(make_prisms(base, base)) == ErrorCode::nothing_to_do);
}

TEST_CASE("prisms: the nodes on random bases are the nearest doubles", "[prisms]") {
    std::mt19937 random(11);
    const auto number = [&](int most) { return double(random() % unsigned(2 * most)) - most; };
    for (const double scale : {1.0, 1e-90, 1e90, 0.1}) {
        INFO(scale);
        const auto top = sheet(6, scale, {scale, scale, 20 * scale},
                               [&](double, double) { return number(5) * scale; });
        const auto base = sheet(5, 2 * scale, {-0.5 * scale, 0, 0},
                                [&](double, double) { return number(5) * scale / 7; });
        const auto mesh = prisms_of(top, base);
        CHECK(mesh.gaps.empty());
        CHECK(mesh.cells.size() == 72);
        std::map<std::pair<double, double>, mpq_class> heights;
        for (const Triangle& t : base.triangles)
            for (const Point3& p : top.vertices) {
                const RationalPoint place{mpq_class(p.x), mpq_class(p.y), 0};
                std::array<RationalPoint, 3> c;
                for (std::size_t k = 0; k < 3; ++k) c[k] = between(base.vertices[t[k]], place);
                const RationalPoint up{0, 0, 1};
                const mpq_class a = determinant(c[1], c[2], up), b = determinant(c[2], c[0], up),
                                d = determinant(c[0], c[1], up);
                if (a < 0 || b < 0 || d < 0) continue;
                const mpq_class z = (a * c[0][2] + b * c[1][2] + d * c[2][2]) / (a + b + d);
                heights[{p.x, p.y}] = z;
            }
        std::size_t on_base = 0;
        for (const Point3& p : mesh.vertices)
            on_base += is_nearest(p.z, heights.at({p.x, p.y})) ? 1 : 0;
        CHECK(on_base == 49);
        const mpq_class volume = volume_of(mesh);
        CHECK(abs(volume - mpq_class(mesh.volume)) <= volume * 0x1p-53);
    }
}

TEST_CASE("prisms: a vertical fault has a base on each side", "[prisms]") {
    // two halves with a throw of 3 at x = 2, also in the base; the base is divided otherwise along y
    const auto halves = [](std::uint32_t n, double z) {
        Surface both = sheet(n, 2.0 / n, {0, 0, z}, [](double, double) { return 0.0; });
        const auto fallen = sheet(n, 2.0 / n, {2, 0, z - 3}, [](double, double) { return 0.0; });
        const auto first = std::uint32_t(both.vertices.size());
        both.vertices.insert(both.vertices.end(), fallen.vertices.begin(), fallen.vertices.end());
        for (const auto& [a, b, c] : fallen.triangles)
            both.triangles.push_back({first + a, first + b, first + c});
        return both;
    };
    Surface base = halves(3, 0);
    base.triangles.push_back({3, 16, 20}); // a part of the wall, which is vertical
    const auto mesh = prisms_of(halves(2, 5), base, {.layers = 2});
    CHECK(mesh.gaps.empty());
    CHECK(volume_of(mesh) == 8 * 5);
    CHECK(mesh.volume == 40);
    CHECK(mesh.vertices.size() == 2 * 9 * 3);
    for (const PrismCell& cell : mesh.cells)
        for (std::size_t k = 0; k < 6; ++k) {
            const Point3& p = mesh.vertices[cell.nodes[k]];
            const double middle = mesh.vertices[cell.nodes[0]].x + mesh.vertices[cell.nodes[1]].x +
                                  mesh.vertices[cell.nodes[2]].x;
            CHECK((middle < 6 ? p.z >= 0 : p.z <= 2));
        }
    // a top without throw over a base with one: verticals on the fault have two nodes on the base
    const auto whole = sheet(2, 2, {0, 0, 9}, [](double, double) { return 0.0; });
    Surface wide = halves(1, 0);
    for (Point3& p : wide.vertices) p.y *= 2;
    const auto split = prisms_of(whole, wide);
    CHECK(split.volume == 8 * 9 + 8 * 12);
    CHECK(split.vertices.size() == 9 + 9 + 3);
}

TEST_CASE("prisms: a base that is missing, or above, is named", "[prisms]") {
    const auto top = sheet(4, 1, {0, 0, 0}, [](double, double) { return 0.0; });
    const auto small = sheet(1, 3, {0, 0, -1}, [](double, double) { return 0.0; });
    const auto missing = prisms_of(top, small);
    CHECK(missing.cells.size() == 18);
    REQUIRE(missing.gaps.size() == 14);
    CHECK(missing.gaps[0].triangle == 6);
    CHECK(!missing.gaps[0].is_crossed);
    const auto slope = sheet(4, 1, {0, 0, 0}, [](double x, double) { return x - 2; });
    const auto crossed = prisms_of(top, slope);
    CHECK(crossed.cells.size() == 16);
    CHECK(crossed.gaps.size() == 16);
    CHECK(std::all_of(crossed.gaps.begin(), crossed.gaps.end(),
                      [](const PrismGap& gap) { return gap.is_crossed; }));
    CHECK(crossed.volume == 8);
}

TEST_CASE("prisms: what makes none is refused", "[prisms]") {
    const auto top = sheet(2, 1, {0, 0, 1}, [](double, double) { return 0.0; });
    const auto base = sheet(2, 1, {0, 0, 0}, [](double, double) { return 0.0; });
    const auto code = [&](const PrismOptions& options) {
        return refusal(make_prisms(top, base, options));
    };
    CHECK(code({.layers = 0}) == ErrorCode::bad_option);
    CHECK(code({.layers = 10001}) == ErrorCode::bad_option);
    CHECK(code({1, PrismLayers::top, 0}) == ErrorCode::bad_option);
    CHECK(code({1, PrismLayers::base, std::nan("")}) == ErrorCode::bad_option);
    CHECK(code({1, PrismLayers::proportional, 1}) == ErrorCode::bad_option);
    CHECK(refusal(make_prisms(base, top)) == ErrorCode::nothing_to_do);
    Surface fold = base;
    fold.vertices[4] = {2.5, 1, 0.5}; // beyond its neighbour
    CHECK(refusal(make_prisms(top, fold)) == ErrorCode::bad_option);
    CHECK(refusal(make_prisms(fold, base)) == ErrorCode::bad_option);
    Surface wall{"wall", Role::fault, {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}}, {{0, 1, 2}}};
    CHECK(refusal(make_prisms(top, wall)) == ErrorCode::bad_option);
    std::stop_source stop;
    stop.request_stop();
    CHECK(refusal(make_prisms(top, base, {}, {.stop = stop.get_token()})) ==
          ErrorCode::interrupted);
}
