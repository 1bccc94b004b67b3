// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the search for improper pairs at vertices of many triangles with a test of all pairs, and counts its work.
#include <terrane/algorithms/verify/detail/contacts.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "support/verify_points.hpp"
#include "support/verify_work.hpp"

namespace {

using namespace terrane;
using namespace terrane::verifier;

using namespace verify_points;
using verify_work::check_growth;

struct Model {
    std::vector<Vector4> points;
    std::vector<Triangle> triangles;

    std::uint32_t add(int x, int y, int z) {
        points.push_back(point(x, y, z));
        return static_cast<std::uint32_t>(points.size() - 1);
    }
    [[nodiscard]] ExactMesh mesh() const { return make_exact_mesh(points, 1, triangles); }
};

/// Needles from the origin to a line of points that rise and fall; neighbours have a side in common.
Model fan(int n) {
    Model m;
    m.add(0, 0, 0);
    for (int i = 0; i <= n; ++i) m.add(8 * n, 4 * i, i * i % 7);
    for (std::uint32_t i = 1; i < m.points.size() - 1; ++i) m.triangles.push_back({0, i, i + 1});
    return m;
}

/// Needles from the origin that have nothing else in common.
Model apart(int n) {
    Model m;
    m.add(0, 0, 0);
    for (int i = 0; i < n; ++i) {
        const auto a = m.add(8 * n, 4 * i, i * i % 7), b = m.add(8 * n, 4 * i + 2, i * i % 5);
        m.triangles.push_back({a, b, 0});
    }
    return m;
}

/// Triangles around one edge, facing both ways.
Model book(int n) {
    Model m;
    m.add(0, 0, 0);
    m.add(0, 0, n);
    for (int i = 0; i < n; ++i) {
        const auto page = m.add(i, n, i % 3);
        m.triangles.push_back(i % 2 == 0 ? Triangle{0, 1, page} : Triangle{1, 0, page});
    }
    return m;
}

/// Triangles of a few points on a small lattice, so that many have corners, edges and planes in common; all of the
/// first half are at one of two points.
Model random_model(std::mt19937& random) {
    std::uniform_int_distribution<int> place(-2, 2);
    Model m;
    for (int i = 0; i < 14; ++i) m.add(place(random), place(random), place(random));
    std::uniform_int_distribution<std::uint32_t> corner(0, 13), hub(0, 1);
    for (int i = 0; i < 80; ++i) {
        Triangle t{i < 60 ? hub(random) : corner(random), corner(random), corner(random)};
        std::shuffle(t.begin(), t.end(), random);
        m.triangles.push_back(t);
    }
    return m;
}

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

Pairs by_testing_all(const ExactMesh& mesh, std::uint32_t from) {
    Pairs pairs;
    for (std::uint32_t a = 0; a < mesh.triangles.size(); ++a)
        for (std::uint32_t b = std::max(a + 1, from); b < mesh.triangles.size(); ++b)
            if (projection_axis(mesh.planes[a]) && projection_axis(mesh.planes[b]) &&
                !meet_properly(mesh, a, b))
                pairs.push_back({a, b});
    return pairs;
}

} // namespace

TEST_CASE("contacts: triangles at common vertices, as a test of all pairs finds them") {
    std::mt19937 random(72);
    for (int i = 0; i < 60; ++i) {
        const ExactMesh mesh = random_model(random).mesh();
        CHECK(find_improper_pairs(mesh, SIZE_MAX) == by_testing_all(mesh, 0));
        CHECK(find_improper_pairs(mesh, SIZE_MAX, 50) == by_testing_all(mesh, 50));
    }
}

TEST_CASE("contacts: a fan, a star and a book, in which one triangle crosses another") {
    for (const auto& make : {fan, apart, book}) {
        Model m = make(60);
        CHECK(find_improper_pairs(m.mesh(), SIZE_MAX).empty());
        m.triangles.push_back(m.triangles[20]);
        for (std::uint32_t& v : m.triangles.back())
            if (v != 0) { // farther out, and in other directions
                const Vector4 p = m.points[v];
                v = m.add(0, 0, 0);
                m.points[v] = {p[0] * 2, p[1] * 2, p[2] * 2 + (v % 2 == 0 ? 3 : -3), 1};
            }
        const ExactMesh mesh = m.mesh();
        const Pairs expected = by_testing_all(mesh, 0);
        CHECK_FALSE(expected.empty());
        CHECK(find_improper_pairs(mesh, SIZE_MAX) == expected);
    }
}

TEST_CASE("contacts: work grows with the triangles at a vertex or an edge, not with their pairs") {
    for (const auto& make : {fan, apart, book})
        check_growth([&](int n) { CHECK(find_improper_pairs(make(n).mesh(), 1).empty()); });
}
