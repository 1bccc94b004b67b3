// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Judges simplification by the sentences of docs/explanation/resolution.md, with distances, sides
// of the box and blocks found by other code, on small models whose answers are known and on random
// ones.
#include <terrane/algorithms/simplification/simplify.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "support/solids.hpp"
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/quality/deviation.hpp>
#include <terrane/algorithms/volume_of_interest/boundary_surfaces.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

using namespace terrane;
using namespace test_support;

namespace {

constexpr Point3 box_low{0, 0, 0}, box_high{100, 80, 60};

Arranged in_box(std::vector<Surface> surfaces) {
    auto boundary = box_boundary(box_low, box_high);
    REQUIRE(boundary);
    auto arranged = arrange_within(std::move(surfaces), std::move(*boundary));
    REQUIRE(arranged);
    REQUIRE(arranged->rounded.conforming);
    return std::move(*arranged);
}

bool has_triangles(const Mesh& mesh, std::uint32_t surface) {
    const auto& all = mesh.surfaces_of.values;
    return std::find(all.begin(), all.end(), surface) != all.end();
}

/// Sums the exact volumes of all blocks; those of a box with planar sides are its own.
double total_volume(const Mesh& mesh) {
    const auto volumes = find_volumes(mesh);
    REQUIRE(volumes);
    return volumes->measures[0];
}

std::size_t blocks_of(const Mesh& mesh) {
    const auto volumes = find_volumes(mesh);
    REQUIRE(volumes);
    return volumes->block_count();
}

/// Simplifies, and checks the sentences that hold for any model.
Simplified simplified(const Arranged& arranged, double resolution, bool dissolve = false) {
    const Mesh& before = arranged.rounded.mesh;
    auto result =
        simplify(*arranged.rounded.conforming, {.resolution = resolution, .dissolve = dissolve});
    REQUIRE(result);
    const Mesh& after = result->rounded.mesh;
    const SimplifyReport& report = result->report;
    const auto flaws = check(surfaces_of_mesh(after));
    REQUIRE(flaws);
    CHECK(after.surfaces == before.surfaces);
    CHECK(report.is_shown);
    for (std::uint32_t s = 0; s < before.surfaces.size(); ++s) {
        const bool is_gone =
            std::find(report.vanished.begin(), report.vanished.end(), s) != report.vanished.end();
        CHECK(is_gone == (has_triangles(before, s) && !has_triangles(after, s)));
        if (!has_triangles(before, s) || is_gone) continue;
        const Surface old = surface_of_mesh(before, s), now = surface_of_mesh(after, s);
        CHECK(sampled_distance(now, old) <= resolution * (1 + 1e-9));
        CHECK(sampled_distance(old, now) <= resolution * (1 + 1e-9));
    }
    CHECK(total_volume(after) == Approx(total_volume(before)).epsilon(1e-12));
    const std::size_t was = blocks_of(before), is = blocks_of(after);
    CHECK((was == is || !report.blocks.empty()));
    return std::move(*result);
}

std::uint32_t named(const Mesh& mesh, const std::string& name) {
    for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s)
        if (mesh.surfaces[s].name == name) return s;
    FAIL("no surface " << name);
    return 0;
}

/// The range of x of the triangles that are in both surfaces, and their area.
struct Common {
    double from = std::numeric_limits<double>::infinity();
    double to = -std::numeric_limits<double>::infinity();
    std::size_t triangles = 0;
};

Common common_part(const Mesh& mesh, const std::string& a, const std::string& b) {
    Common common;
    const std::uint32_t s = named(mesh, a), t = named(mesh, b);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto of = mesh.surfaces_of[i];
        if (!std::binary_search(of.begin(), of.end(), s) ||
            !std::binary_search(of.begin(), of.end(), t))
            continue;
        ++common.triangles;
        for (const std::uint32_t v : mesh.triangles[i]) {
            common.from = std::min(common.from, mesh.vertices[v].x);
            common.to = std::max(common.to, mesh.vertices[v].x);
        }
    }
    return common;
}

/// A plane through the whole box, with z = at(x).
template <class At>
Surface sheet_over_box(const At& at, std::string name) {
    return quad({-10, -10, at(-10)}, {110, -10, at(110)}, {110, 90, at(110)}, {-10, 90, at(-10)},
                std::move(name));
}

/// A plane x = `x`, from y = `from` to y = `to`.
Surface wall(double x, double from, double to, std::string name) {
    return quad({x, from, -10}, {x, to, -10}, {x, to, 70}, {x, from, 70}, std::move(name));
}

/// A plane y = `y`, from x = `from` to x = `to`.
Surface cross_wall(double y, double from, double to, std::string name) {
    return quad({from, y, -10}, {to, y, -10}, {to, y, 70}, {from, y, 70}, std::move(name));
}

bool touch_now(const Simplified& s, const std::string& a, const std::string& b) {
    const std::uint32_t i = named(s.rounded.mesh, a), j = named(s.rounded.mesh, b);
    return std::any_of(
        s.report.surface_contacts.begin(), s.report.surface_contacts.end(),
        [&](const ChangedContact& c) {
            return c.is_new && c.between == std::array{std::min(i, j), std::max(i, j)};
        });
}

} // namespace

TEST_CASE("simplify: surfaces far apart stay as they are", "[simplification]") {
    const auto a = in_box({sheet_over_box([](double) { return 20.0; }, "low"),
                           sheet_over_box([](double) { return 40.0; }, "high")});
    const auto s = simplified(a, 5);
    CHECK(s.report.corners + s.report.curves + s.report.sheets == 0);
    CHECK(s.report.left.empty());
    CHECK(s.report.blocks.empty());
    CHECK(s.report.surface_contacts.empty());
    CHECK(blocks_of(s.rounded.mesh) == 3);
}

TEST_CASE("simplify: a sharp wedge is zipped, not farther than where it is open",
          "[simplification]") {
    // At x = 50 they cross, with a slope of 0.15: they are 3 apart 20 from there.
    const auto a =
        in_box({sheet_over_box([](double) { return 30.0; }, "flat"),
                sheet_over_box([](double x) { return 30 + 0.15 * (x - 50); }, "inclined")});
    const auto s = simplified(a, 3);
    CHECK(blocks_of(s.rounded.mesh) == 4);
    CHECK(s.report.blocks.empty());
    const Common common = common_part(s.rounded.mesh, "flat", "inclined");
    CHECK(common.triangles > 0);
    CHECK(common.from > 50 - 20 - 9);
    CHECK(common.to < 50 + 20 + 9);
}

TEST_CASE("simplify: walls that end at a wall next to each other are joined", "[simplification]") {
    const auto a = in_box({wall(50, -10, 90, "wall"), cross_wall(40, -10, 50, "left"),
                           cross_wall(42, 50, 110, "right")});
    const auto s = simplified(a, 5);
    CHECK(blocks_of(s.rounded.mesh) == 4);
    CHECK(touch_now(s, "left", "right"));
}

TEST_CASE("simplify: bad options", "[simplification]") {
    const auto a = in_box({sheet_over_box([](double) { return 30.0; }, "horizon")});
    const auto code = [&](SimplifyOptions options) {
        const auto s = simplify(*a.rounded.conforming, options);
        REQUIRE_FALSE(s);
        CHECK(s.error().place != "");
        return s.error().code;
    };
    CHECK(code({.resolution = 0}) == ErrorCode::bad_option);
    CHECK(code({.resolution = -1}) == ErrorCode::bad_option);
    CHECK(code({.resolution = std::numeric_limits<double>::quiet_NaN()}) == ErrorCode::bad_option);
    CHECK(code({.resolution = std::numeric_limits<double>::infinity()}) == ErrorCode::bad_option);
    CHECK(code({.resolution = 100}) == ErrorCode::bad_option);
    CHECK(code({.resolution = 1, .max_move = -1}) == ErrorCode::bad_option);
}

TEST_CASE("simplify: a request to stop", "[simplification]") {
    const auto a = in_box({sheet_over_box([](double) { return 30.0; }, "horizon")});
    std::stop_source source;
    source.request_stop();
    Run run;
    run.stop = source.get_token();
    const auto s = simplify(*a.rounded.conforming, {.resolution = 5}, run);
    REQUIRE_FALSE(s);
    CHECK(s.error().code == ErrorCode::interrupted);
}

TEST_CASE("simplify: neither threads nor the order of triangles matter", "[simplification]") {
    const auto a =
        in_box({sheet_over_box([](double) { return 30.0; }, "flat"),
                sheet_over_box([](double x) { return 30 + 0.15 * (x - 50); }, "inclined"),
                wall(50, -10, 90, "wall"), cross_wall(40, -10, 50, "left"),
                cross_wall(41, 50, 110, "right")});
    const auto first = simplify(*a.rounded.conforming, {.resolution = 5});
    Mesh turned = *a.rounded.mesh;
    std::reverse(turned.triangles.begin(), turned.triangles.end());
    IndexLists<std::uint32_t> surfaces_of;
    for (std::size_t t = turned.triangles.size(); t-- > 0;)
        surfaces_of.push_back(a.rounded.mesh->surfaces_of[t]);
    turned.surfaces_of = surfaces_of;
    turned.regions_of = {};
    turned.parents_of = {};
    const auto proven = prove_conforming(turned);
    REQUIRE(proven);
    Run run;
    run.threads = 2;
    const auto second = simplify(*proven, {.resolution = 5}, run);
    REQUIRE(first);
    REQUIRE(second);
    CHECK(first->rounded.mesh->vertices == second->rounded.mesh->vertices);
    CHECK(first->rounded.mesh->triangles == second->rounded.mesh->triangles);
}
