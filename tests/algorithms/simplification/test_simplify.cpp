// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Judges simplification by the sentences of docs/explanation/resolution.md, on small models whose
// answers are known and on random ones. Distances, sides of the box and the blocks of points are
// found here, by code that shares nothing with what is judged.
#include <terrane/algorithms/simplification/simplify.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/points.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/simplification/detail/pockets.hpp>
#include <terrane/algorithms/simplification/detail/traced_mesh.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
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
    return volumes->total;
}

std::size_t blocks_of(const Mesh& mesh) {
    const auto volumes = find_volumes(mesh);
    REQUIRE(volumes);
    return volumes->block_count();
}

double distance_to_edge(const Point3& p, const Point3& a, const Point3& b) {
    const Point3 d = minus(b, a);
    const double square = dot(d, d);
    const double t = square > 0 ? std::clamp(dot(minus(p, a), d) / square, 0.0, 1.0) : 0;
    return length(minus(p, {a.x + t * d.x, a.y + t * d.y, a.z + t * d.z}));
}

double distance_to_triangle(const Point3& p, const Point3& a, const Point3& b, const Point3& c) {
    const Point3 n = cross(minus(b, a), minus(c, a));
    const bool is_above = dot(cross(minus(b, a), minus(p, a)), n) >= 0 &&
                          dot(cross(minus(c, b), minus(p, b)), n) >= 0 &&
                          dot(cross(minus(a, c), minus(p, c)), n) >= 0;
    if (is_above && dot(n, n) > 0) return std::abs(dot(minus(p, a), n)) / length(n);
    return std::min(
        {distance_to_edge(p, a, b), distance_to_edge(p, b, c), distance_to_edge(p, c, a)});
}

double distance_to(const Point3& p, const Surface& surface) {
    double least = std::numeric_limits<double>::infinity();
    const auto& v = surface.vertices;
    for (const auto& [a, b, c] : surface.triangles)
        least = std::min(least, distance_to_triangle(p, v[a], v[b], v[c]));
    return least;
}

/// The largest distance from points of one surface, 10 of each triangle, to another surface.
double farthest_point(const Surface& from, const Surface& to) {
    constexpr int steps = 3;
    double most = 0;
    for (const auto& [a, b, c] : from.triangles) {
        const Point3 &p = from.vertices[a], &q = from.vertices[b], &r = from.vertices[c];
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; i + j <= steps; ++j) {
                const double u = double(i) / steps, v = double(j) / steps, w = 1 - u - v;
                most = std::max(
                    most, distance_to({u * p.x + v * q.x + w * r.x, u * p.y + v * q.y + w * r.y,
                                       u * p.z + v * q.z + w * r.z},
                                      to));
            }
    }
    return most;
}

/// The volume in which a point lies, by the first triangle above it; 0 if there is none.
std::uint32_t volume_at(const Point3& p, const Mesh& mesh, const Volumes& volumes) {
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t volume = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Point3 &a = mesh.vertices[mesh.triangles[t][0]],
                     &b = mesh.vertices[mesh.triangles[t][1]],
                     &c = mesh.vertices[mesh.triangles[t][2]];
        const auto turn = [&](const Point3& q, const Point3& r) {
            return (r.x - q.x) * (p.y - q.y) - (r.y - q.y) * (p.x - q.x);
        };
        const double u = turn(b, c), v = turn(c, a), w = turn(a, b);
        if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) continue;
        const double z = (u * a.z + v * b.z + w * c.z) / (u + v + w);
        if (z < p.z || z >= least) continue;
        least = z;
        // From below, the side behind is seen of a triangle that runs counterclockwise in the map.
        volume = volumes.of_sides[t][u > 0 ? 1 : 0];
    }
    return volume;
}

bool is_listed(const SimplifyReport& report, std::uint32_t block) {
    return std::any_of(report.blocks.begin(), report.blocks.end(),
                       [&](const ChangedBlock& c) { return c.block == block || c.into == block; });
}

/// Points farther than the resolution from all surfaces are in the same block as before, unless
/// the report lists it; and there are as many blocks as the report says.
void check_blocks(const Mesh& before, const Simplified& s, double resolution) {
    const Mesh& after = s.rounded.mesh;
    const auto was = find_volumes(before), is = find_volumes(after);
    REQUIRE(was);
    REQUIRE(is);
    REQUIRE(s.block_before.size() == is->measures.size());
    std::size_t expected = was->block_count();
    for (const ChangedBlock& c : s.report.blocks) {
        CHECK(c.parts != 1);
        expected += c.parts - 1;
        CHECK(c.volume == Approx(c.block == 0 ? 0 : was->measures[c.block]));
    }
    CHECK(is->block_count() == expected);
    std::vector<Surface> surfaces;
    for (std::uint32_t i = 0; i < before.surfaces.size(); ++i)
        surfaces.push_back(surface_of_mesh(before, i));
    for (double x = 4.7; x < 100; x += 18.1)
        for (double y = 7.3; y < 80; y += 23.7)
            for (double z = 2.9; z < 60; z += 4.3) {
                const Point3 p{x, y, z};
                if (std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& surface) {
                        return distance_to(p, surface) <= resolution;
                    }))
                    continue;
                const std::uint32_t block = volume_at(p, before, *was);
                CHECK(block != 0);
                CHECK((s.block_before[volume_at(p, after, *is)] == block ||
                       is_listed(s.report, block)));
            }
}

/// All triangles of the boundary lie in sides of the box still, apart from rounding errors.
void check_sides(const Mesh& mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto of = mesh.surfaces_of[t];
        if (std::none_of(of.begin(), of.end(),
                         [&](std::uint32_t s) { return mesh.surfaces[s].role == Role::boundary; }))
            continue;
        const auto all_at = [&](double Point3::*axis, double value) {
            const Triangle& c = mesh.triangles[t];
            return std::all_of(c.begin(), c.end(),
                               [&](std::uint32_t v) { return mesh.vertices[v].*axis == value; });
        };
        const Point3& corner = mesh.vertices[mesh.triangles[t][0]];
        INFO("at " << corner.x << " " << corner.y << " " << corner.z);
        CHECK((all_at(&Point3::x, box_low.x) || all_at(&Point3::x, box_high.x) ||
               all_at(&Point3::y, box_low.y) || all_at(&Point3::y, box_high.y) ||
               all_at(&Point3::z, box_low.z) || all_at(&Point3::z, box_high.z)));
    }
}

/// Checks the sentences that hold for any model.
void check_promises(const Arranged& arranged, const Simplified& s, double resolution) {
    const Mesh &before = arranged.rounded.mesh, &after = s.rounded.mesh;
    CHECK(prove_conforming(after));
    CHECK(after.surfaces == before.surfaces);
    CHECK(s.report.is_shown);
    for (std::uint32_t i = 0; i < before.surfaces.size(); ++i) {
        INFO("surface " << i);
        const auto& gone = s.report.vanished;
        const bool is_gone = std::find(gone.begin(), gone.end(), i) != gone.end();
        CHECK(is_gone == (has_triangles(before, i) && !has_triangles(after, i)));
        if (!has_triangles(before, i) || is_gone) continue;
        const Surface old = surface_of_mesh(before, i), now = surface_of_mesh(after, i);
        CHECK(farthest_point(now, old) <= resolution * (1 + 1e-9));
        CHECK(farthest_point(old, now) <= resolution * (1 + 1e-9));
    }
    check_sides(after);
    CHECK(total_volume(after) == Approx(total_volume(before)).epsilon(1e-12));
    check_blocks(before, s, resolution);
}

/// Simplifies, and checks the sentences that hold for any model.
Simplified simplified(const Arranged& arranged, double resolution, bool dissolve = false) {
    auto result =
        simplify(*arranged.rounded.conforming, {.resolution = resolution, .dissolve = dissolve});
    REQUIRE(result);
    check_promises(arranged, *result, resolution);
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

/// Returns the least distance between a vertex and a triangle that does not have it as a corner.
double least_gap(const Mesh& mesh) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles)
        for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
            if (v != a && v != b && v != c)
                least = std::min(least, distance_to_triangle(mesh.vertices[v], mesh.vertices[a],
                                                             mesh.vertices[b], mesh.vertices[c]));
    return least;
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
          "[simplification][once]") {
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

TEST_CASE("simplify: a wedge of more than 20 degrees stays open", "[simplification]") {
    for (const double slope : {0.4, 0.5}) { // 21.8 and 26.6 degrees
        const auto a =
            in_box({sheet_over_box([](double) { return 30.0; }, "flat"),
                    sheet_over_box([&](double x) { return 30 + slope * (x - 50); }, "inclined")});
        const auto s = simplified(a, 3);
        INFO("slope " << slope);
        CHECK(s.report.sheets == 0);
        CHECK(s.report.curves == 0);
        CHECK(common_part(s.rounded.mesh, "flat", "inclined").triangles == 0);
    }
}

TEST_CASE("simplify: two surfaces that are joined move alike", "[simplification][once]") {
    const auto a = in_box({sheet_over_box([](double) { return 30.0; }, "low"),
                           sheet_over_box([](double) { return 33.0; }, "high")});
    const auto s = simplified(a, 6, true);
    const Mesh& after = s.rounded.mesh;
    std::size_t halfway = 0, all = 0;
    for (std::size_t t = 0; t < after.triangles.size(); ++t)
        for (const std::uint32_t i : after.surfaces_of[t])
            if (after.surfaces[i].role != Role::boundary)
                for (const std::uint32_t v : after.triangles[t]) {
                    ++all;
                    halfway += after.vertices[v].z == Approx(31.5) ? 1 : 0;
                }
    INFO(halfway << " of " << all);
    CHECK(halfway > all * 8 / 10); // some at the sides of the box are left alone
}

TEST_CASE("simplify: a pocket that was outside opens to it, a block does not", "[simplification]") {
    Surface pocket = tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, "pocket");
    pocket.role = Role::fault;
    const auto exact = arrange(std::vector{pocket});
    REQUIRE(exact);
    const auto rounded = round_to_doubles(*exact);
    REQUIRE(rounded);
    const auto traced = simplification::detail::traced(rounded->mesh);
    const auto volumes = find_volumes(traced.mesh);
    REQUIRE(volumes);
    REQUIRE(volumes->block_count() == 1);
    const std::vector<std::uint32_t> blocks{1};
    for (const std::uint32_t before : {0U, 1U}) {
        auto cells = traced.cells;
        const std::vector<std::uint32_t> block_before{0, before};
        CHECK(simplification::detail::dissolve(traced.mesh, *volumes, blocks, block_before,
                                               cells) == (before == 0 ? 1 : 0));
    }
}

TEST_CASE("simplify: a thin layer stays and is listed, or is dissolved", "[simplification][once]") {
    const auto a = in_box({sheet_over_box([](double) { return 30.0; }, "low"),
                           sheet_over_box([](double) { return 33.0; }, "high")});
    const auto volumes = find_volumes(*a.rounded.mesh);
    REQUIRE(volumes);
    const std::uint32_t layer = volume_at({51.3, 37.7, 31.5}, *a.rounded.mesh, *volumes);
    const auto kept = simplified(a, 6);
    CHECK(blocks_of(kept.rounded.mesh) == 3);
    CHECK(kept.report.kept == std::vector{layer});
    CHECK(kept.report.blocks.empty());
    CHECK_FALSE(kept.report.left.empty());
    const auto zipped = simplified(a, 6, true);
    CHECK(blocks_of(zipped.rounded.mesh) == 2);
    CHECK(zipped.report.kept.empty());
    REQUIRE(zipped.report.blocks.size() == 1);
    CHECK(zipped.report.blocks[0].block == layer);
    CHECK(zipped.report.blocks[0].parts == 0);
    CHECK(zipped.report.blocks[0].volume == Approx(24000));
    const Common common = common_part(zipped.rounded.mesh, "low", "high");
    CHECK(common.from == 0);
    CHECK(common.to == 100);
}

TEST_CASE("simplify: walls that end at a wall next to each other are joined", "[simplification]") {
    const auto a = in_box({wall(50, -10, 90, "wall"), cross_wall(40, -10, 50, "left"),
                           cross_wall(42, 50, 110, "right")});
    const auto s = simplified(a, 5);
    CHECK(blocks_of(s.rounded.mesh) == 4);
    CHECK(touch_now(s, "left", "right"));
}

TEST_CASE("simplify: what hardly misses an edge or a triangle is joined, too", "[simplification]") {
    for (const double gap : {1e-3, 1e-6}) { // of a resolution of 5
        INFO("gap " << gap);
        const auto borders =
            in_box({quad({10, 10, 30}, {50, 10, 30}, {50, 70, 30}, {10, 70, 30}, "a"),
                    quad({50 + gap, 13, 30}, {90, 13, 50}, {90, 61, 50}, {50 + gap, 61, 30}, "b")});
        REQUIRE(least_gap(*borders.rounded.mesh) < 1.1 * gap);
        CHECK(least_gap(simplified(borders, 5).rounded.mesh) > 0.5);
        const auto edge = in_box(
            {sheet_over_box([](double x) { return 30 + 0.3 * (x - 50); }, "inclined"),
             quad({20, 20, -10}, {20, 60, -10}, {20, 60, 21 - gap}, {20, 20, 21 - gap}, "wall")});
        REQUIRE(least_gap(*edge.rounded.mesh) < 1.1 * gap);
        CHECK(least_gap(simplified(edge, 5).rounded.mesh) > 0.5);
    }
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
    Run alone;
    alone.threads = 1;
    const auto first = simplify(*a.rounded.conforming, {.resolution = 5}, alone);
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

TEST_CASE("simplify: random planes keep all promises, or are refused by name", "[simplification]") {
    const int count = cases(3);
    int made = 0;
    for (int seed = 0; seed < count; ++seed) {
        INFO("seed " << seed);
        std::mt19937_64 random(static_cast<std::uint64_t>(seed));
        std::vector<Surface> surfaces;
        for (int i = 0; i < 3; ++i) {
            const double z = random_real(random, 10, 50), slope = random_real(random, -0.2, 0.2);
            surfaces.push_back(sheet_over_box([&](double x) { return z + slope * (x - 50); },
                                              "sheet " + std::to_string(i)));
        }
        surfaces.push_back(wall(random_real(random, 10, 90), -10, 90, "wall"));
        const auto a = in_box(std::move(surfaces));
        const double resolution = random_real(random, 3, 6);
        const auto s =
            simplify(*a.rounded.conforming, {.resolution = resolution, .dissolve = seed % 2 == 1});
        if (s) {
            ++made;
            check_promises(a, *s, resolution);
            continue;
        }
        CHECK(s.error().code == ErrorCode::bad_option);
        CHECK(s.error().place == "resolution");
    }
    CHECK(made > 0);
}
