// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The independent verifier judges the guarantees of rounding on the doubles themselves.
#include "support/claim.hpp"
#include "support/effort.hpp"
#include "support/points.hpp"
#include "support/read.hpp"
#include "support/rounded.hpp"
#include "support/shapes.hpp"
#include "support/soup_laws.hpp"

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/rounding/detail/collapsed_triangles.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <string>

namespace {

using namespace terrane;
using namespace terrane::rounding::detail;
using namespace test_support;

/// Rotates and shifts a point. The result must be rounded: coplanar points become nearly coplanar.
Point3 turned(const Point3& p) {
    const double y = std::cos(0.7) * p.y - std::sin(0.7) * p.z;
    const double z = std::sin(0.7) * p.y + std::cos(0.7) * p.z;
    return {std::cos(0.4) * p.x - std::sin(0.4) * z + 0.3, y - 0.2,
            std::sin(0.4) * p.x + std::cos(0.4) * z + 0.1};
}

std::vector<Surface> turned_sheets(unsigned n) {
    const double h = 0.5 / n;
    return {unit_grid(n, n,
                      [](double x, double y) {
                          return turned({x, y, 0});
                      }),
            unit_grid(n, n, [h](double x, double y) {
                return turned({x + h, y + h, 0});
            })};
}

bool is_conforming(const Mesh& m) {
    return verify_conforming(m.vertices, m.triangles).empty();
}

void check_lists(const RoundedMesh& r) {
    const Mesh& m = r.mesh;
    REQUIRE(m.surfaces_of.size() == m.triangles.size());
    REQUIRE(m.parents_of.size() == m.triangles.size());
    REQUIRE(m.regions_of.offsets == m.surfaces_of.offsets);
    for (std::size_t t = 0; t < m.triangles.size(); ++t)
        for (std::size_t k = 0; k < m.surfaces_of[t].size(); ++k)
            REQUIRE(r.regions[m.regions_of[t][k]].surface == m.surfaces_of[t][k]);
}

} // namespace

TEST_CASE("round: progress ascends to 1", "[rounding]") {
    const Surface flat{"flat", Role::horizon, {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}}, {{0, 1, 2}}};
    const Surface wall{"wall", Role::fault, {{1, 1, -1}, {1, 1, 1}, {1, 5, 0}}, {{0, 1, 2}}};
    const auto arranged = arrange(std::vector{flat, wall});
    REQUIRE(arranged);
    std::vector<double> shares;
    const Run run{.threads = 1, .stop = {}, .progress = [&](auto stage, double share) {
                      CHECK(stage == "round");
                      shares.push_back(share);
                  }};
    REQUIRE(round_to_doubles(*arranged, {}, run));
    CHECK(std::is_sorted(shares.begin(), shares.end()));
    CHECK(shares.size() >= 3);
    CHECK(shares.back() == 1);
}

TEST_CASE("rounding: a triangle that disappears when the input is snapped is listed") {
    const auto surfaces = read_data("regression/013-needle-in-line-as-decimals.obj");
    const auto exact = arrange(surfaces);
    REQUIRE(exact);
    const auto rounded = round_to_doubles(exact.value());
    REQUIRE(rounded);
    const RoundingReport& report = rounded.value().report;
    CHECK(report.clean);
    // Arranging decimals took its area: no round of snapping the output made it collapse.
    CHECK(report.collapsed_triangles == 0);
    CHECK(report.arranged_again);
    CHECK(exact.value().degenerate.empty());
    CHECK(report.vanished == std::vector<std::uint32_t>{6});
}

TEST_CASE("rounding: merged vertices are counted") {
    const auto exact = arrange(read_data("regression/005-interval-without-end.obj"));
    REQUIRE(exact);
    const auto rounded = round_to_doubles(exact.value());
    REQUIRE(rounded);
    CHECK(rounded.value().report.merged_vertices == 1);
}

TEST_CASE("rounding: triangles that cross within a few doubles are separated by two of them") {
    const auto exact = arrange(read_data("regression/004-snapped-onto-each-other.obj"));
    REQUIRE(exact);
    const auto r = round_to_doubles(exact.value());
    REQUIRE(r);
    CHECK(r->report.naive_contacts == 8);
    CHECK(r->report.clean);
    CHECK(is_conforming(r->mesh));
    const double unit = default_max_move(exact.value()) / 1024;
    CHECK(r->report.surface_deviation < 3 * unit);
    CHECK(r->report.moved_input_vertices == 0);
    CHECK(r->report.vanished.empty());
    const auto left = round_to_doubles(exact.value(), {.max_move = 0.6 * unit});
    REQUIRE(left);
    CHECK(left->report.contacts.size() == 8);
    CHECK(left->report.surface_deviation <= 0.6 * unit);
}

TEST_CASE("rounding: what is exact in doubles stays as it is") {
    const auto a = arranged({surface({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}),
                             surface({{1, 1, -1}, {1, 1, 1}, {2, 1, 1}}, {{0, 1, 2}})});
    const auto r = rounded(a);
    CHECK(r.report.clean);
    CHECK(r.report.rounds == 0);
    CHECK(r.report.max_move == 0);
    CHECK(r.report.deviation == 0);
    CHECK(r.mesh->triangles == a.triangles);
    CHECK(r.mesh->intersection_edges == a.intersection_edges);
    CHECK(is_conforming(r.mesh));
    check_lists(r);
}

TEST_CASE("rounding: nothing is farther from its exact place than reported") {
    const auto a =
        arranged({surface({{0, 0, 0}, {1, 0.1, 0}, {0.1, 1, 0.3}}, {{0, 1, 2}}),
                  surface({{0.3, 0.2, -1}, {0.31, 0.3, 1}, {0.7, 0.3, 1}}, {{0, 1, 2}})});
    const auto r = rounded(a);
    REQUIRE(r.report.clean);
    REQUIRE(r.mesh->vertices.size() == a.vertices.size());
    CHECK(r.report.max_move > 0);
    CHECK(r.report.max_move < 1e-15);
    for (std::size_t v = 0; v < a.vertices.size(); ++v) {
        const Enclosure e = a.state->points.enclosure(a.vertices[v]);
        CHECK(r.mesh->vertices[v].x >= e.low[0] - r.report.max_move);
        CHECK(r.mesh->vertices[v].x <= e.high[0] + r.report.max_move);
    }
}

TEST_CASE("rounding: nearly coplanar sheets come out conforming, hardly moved") {
    for (const int n : {3, 8, 16, 32}) { // for the last one, contacts are many from the start
        const auto a = arranged(turned_sheets(n));
        const auto naive = rounded(a, {.max_rounds = 0});
        CHECK(naive.report.clean == is_conforming(naive.mesh));
        CHECK(naive.report.contacts.size() == naive.report.naive_contacts);
        CHECK((naive.report.naive_contacts >= 1024) == (n == 32));
        const auto r = rounded(a);
        REQUIRE(r.report.clean);
        CHECK(r.report.contacts.empty());
        CHECK(is_conforming(r.mesh));
        CHECK(r.report.deviation < 1e-9);
        CHECK(r.report.vanished.empty());
        check_lists(r);
    }
}

TEST_CASE("rounding: crowded contacts are counted in a sample, and the sheets hardly move") {
    const auto a = arranged(turned_sheets(64));
    const std::size_t all = rounded(a, {.max_rounds = 0}).report.naive_contacts;
    const auto r = rounded(a);
    REQUIRE(r.report.clean);
    CHECK(is_conforming(r.mesh));
    CHECK(r.report.naive_contacts >= RoundingReport::least_sampled);
    CHECK(2 * r.report.naive_contacts < all);
    CHECK(r.report.deviation < 1e-9);
    check_lists(r);
}

TEST_CASE("rounding: what is left is named when no round is allowed") {
    const auto a = arranged(turned_sheets(16));
    const auto r = rounded(a, {.max_rounds = 0});
    REQUIRE_FALSE(r.report.clean);
    REQUIRE_FALSE(r.report.contacts.empty());
    for (const ImproperContact& c : r.report.contacts) {
        REQUIRE(c.triangles[0] < c.triangles[1]);
        REQUIRE(c.triangles[1] < r.mesh->triangles.size());
        CHECK(improper_contact(r.mesh->vertices, r.mesh->triangles[c.triangles[0]],
                               r.mesh->triangles[c.triangles[1]]));
    }
}

TEST_CASE("rounding: a triangle too thin for doubles is reported as vanished, or still there") {
    // Two needles cross a sheet; one is thinner than the spacing of doubles where it is cut.
    std::vector<Surface> model{unit_grid(4, 4, [](double x, double y) {
        return Point3{x, y, 0.1 * x};
    })};
    const double ulp = std::nextafter(0.3, 1) - 0.3;
    model.push_back(surface({{0.3, 0.4, -1}, {0.3, 0.45, 1}, {0.3 + ulp, 0.45, 1}}, {{0, 1, 2}}));
    model.push_back(surface({{0.6, 0.4, -1}, {0.6, 0.45, 1}, {0.6001, 0.45, 1}}, {{0, 1, 2}}));
    const auto r = rounded(arranged(model));
    REQUIRE(r.report.clean);
    CHECK(is_conforming(r.mesh));
    std::vector<bool> present(34, false);
    for (const std::uint32_t p : r.mesh->parents_of.values) present[p] = true;
    for (std::uint32_t t = 0; t < present.size(); ++t) {
        const auto& gone = r.report.vanished;
        CHECK(present[t] != (std::find(gone.begin(), gone.end(), t) != gone.end()));
    }
}

TEST_CASE("rounding: random soups are conforming wherever it says so") {
    Random random(11);
    int clean = 0, total = 0;
    for (int i = 0; i < cases(600); ++i) {
        const auto family = std::array{Family::lattice, Family::decimals, Family::one_ulp,
                                       Family::utm, Family::coplanar}[static_cast<unsigned>(i % 5)];
        Surface s;
        const int n = random_int(random, 2, 12);
        for (int t = 0; t < n; ++t) {
            const auto p = points_of(random, family, 3);
            const auto first = static_cast<std::uint32_t>(s.vertices.size());
            s.vertices.insert(s.vertices.end(), p.begin(), p.end());
            s.triangles.push_back({first, first + 1, first + 2});
        }
        const auto r = rounded(arranged({s}));
        INFO(written_out(std::vector{s}));
        REQUIRE(r.report.clean == is_conforming(r.mesh));
        ++total;
        clean += r.report.clean;
        check_lists(r);
    }
    CHECK(clean == total);
}

TEST_CASE("rounding: the same for any number of threads, and stopped on request") {
    const auto a = arranged(turned_sheets(8));
    Run two;
    two.threads = 2;
    const auto one = rounded(a);
    const auto other = round_to_doubles(a, {}, two);
    REQUIRE(other.ok());
    CHECK(one.mesh->vertices == other.value().mesh->vertices);
    CHECK(one.mesh->triangles == other.value().mesh->triangles);
    CHECK(one.mesh->parents_of == other.value().mesh->parents_of);
    std::stop_source stop;
    stop.request_stop();
    Run run;
    run.stop = stop.get_token();
    const auto stopped = round_to_doubles(a, {}, run);
    REQUIRE_FALSE(stopped.ok());
    CHECK(stopped.error().code == ErrorCode::interrupted);
}

namespace {

/// Returns a wavy sheet of 2 n^2 triangles over a square.
Surface waves(std::uint32_t n, double height, double phase) {
    Surface s{"waves", Role::unknown, {}, {}};
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i) {
            const double x = 4.0 * i / n, y = 4.0 * j / n;
            s.vertices.push_back({x, y, height * std::sin(2 * x + phase) * std::cos(3 * y)});
        }
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i, b = a + n + 1;
            s.triangles.push_back({a, a + 1, b + 1});
            s.triangles.push_back({a, b + 1, b});
        }
    return s;
}

/// Gives each triangle vertices of its own.
Surface loose(const Surface& s) {
    Surface apart{s.name, s.role, {}, {}};
    for (const Triangle& t : s.triangles) {
        const auto first = static_cast<std::uint32_t>(apart.vertices.size());
        for (const std::uint32_t v : t) apart.vertices.push_back(s.vertices[v]);
        apart.triangles.push_back({first, first + 1, first + 2});
    }
    return apart;
}

/// Checks that several threads give the same result as one thread, and returns it.
Arrangement check_threads_change_nothing(const std::vector<Surface>& surfaces) {
    Arrangement a = arrange(surfaces).value();
    const RoundedMesh m = round_to_doubles(a).value();
    CHECK(m.report.clean);
    for (const unsigned threads : {2U, 3U}) {
        const Run run{.threads = threads, .stop = {}, .progress = {}};
        const Arrangement b = arrange(surfaces, {}, run).value();
        CHECK(a.triangles == b.triangles);
        CHECK(a.vertices == b.vertices);
        CHECK(a.parents_of == b.parents_of);
        CHECK(a.surfaces_of == b.surfaces_of);
        CHECK(a.intersection_edges == b.intersection_edges);
        CHECK(a.degenerate == b.degenerate);
        CHECK(a.inputs.duplicates == b.inputs.duplicates);
        CHECK(a.state->neighbours == b.state->neighbours);
        CHECK(a.state->patches.of == b.state->patches.of);
        CHECK(a.state->adjacency.edges == b.state->adjacency.edges);
        CHECK(a.state->adjacency.triangles_at == b.state->adjacency.triangles_at);
        CHECK(a.state->corners == b.state->corners);
        CHECK(a.state->patches.turn == b.state->patches.turn);
        const RoundedMesh n = round_to_doubles(b, {}, run).value();
        CHECK(m.mesh->vertices == n.mesh->vertices);
        CHECK(m.mesh->triangles == n.mesh->triangles);
        CHECK(m.mesh->regions_of == n.mesh->regions_of);
        CHECK(m.mesh->surfaces_of == n.mesh->surfaces_of);
        CHECK(m.report.max_move == n.report.max_move);
        REQUIRE(m.regions.size() == n.regions.size());
        for (std::size_t r = 0; r < m.regions.size(); ++r) {
            CHECK(m.regions[r].area == n.regions[r].area); // to the last bit
            CHECK(m.regions[r].neighbours == n.regions[r].neighbours);
        }
    }
    return a;
}

} // namespace

// Threads share passes over triangles, points and edges only if there are tens of thousands of
// them.
TEST_CASE("rounding: what threads share gives the same as one thread") {
    std::vector<Surface> surfaces{waves(120, 0.3, 0), waves(110, 0.2, 1), waves(120, 0.3, 0)};
    surfaces[2].triangles.resize(9000);         // duplicates, and the surface ends within others
    surfaces[2].triangles.push_back({0, 1, 2}); // on a line: no area
    surfaces[1].vertices.push_back({0.5, 0.5, 0});
    surfaces[1].triangles.push_back(
        {5, 40, static_cast<std::uint32_t>(surfaces[1].vertices.size()) - 1});
    CHECK(check_threads_change_nothing(surfaces).inputs.duplicates.size() == 9000);
}

TEST_CASE("rounding: threads change nothing where surfaces cross and triangles lie apart") {
    const auto all = [](int, int) { return true; };
    const auto wave = [&](double x, double y) { return Point3{x, y, std::sin(x / 9) * 5}; };
    const auto slope = [&](double x, double y) { return Point3{x, y + 0.3, (x - y) / 11}; };
    const auto steep = [&](double x, double y) { return Point3{x, 50 + y / 8, y - 60.3}; };
    const Arrangement one = check_threads_change_nothing(
        {sheet_of(190, 190, 1, all, wave), loose(sheet_of(150, 150, 1.3, all, slope)),
         sheet_of(120, 120, 1.5, all, steep)});
    CHECK(one.triangles.size() > 140'000);
    CHECK(one.intersection_edges.size() > 1'000);
}
