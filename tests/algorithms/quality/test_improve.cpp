// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/improve.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stop_token>
#include <string_view>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/quality/bounds_back.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

#include "support/improve_cases.hpp"
#include "support/paths.hpp"
#include "support/points.hpp"
#include "support/read.hpp"
#include "support/rounded.hpp"
#include "support/shapes.hpp"
#include "support/solids.hpp"

using namespace terrane;
using namespace test_support;
using namespace improve_cases;

namespace {

ErrorCode refusal(const Mesh& mesh, const ImproveOptions& options = {}, const Run& run = {}) {
    const auto result = improve(mesh, options, run);
    REQUIRE_FALSE(result);
    CHECK_FALSE(result.error().sentence.empty());
    return result.error().code;
}

double mean_edge(const Mesh& mesh, std::uint32_t surface) {
    const Surface s = surface_of_mesh(mesh, surface);
    return measure_quality(s.vertices, s.triangles).edge_length.mean;
}

} // namespace

TEST_CASE("improve: a horizon cut into nine regions, as in the paper's Figure 18", "[improve]") {
    const Mesh mesh = mesh_of(nine_regions());
    const Surface horizon = surface_of_mesh(mesh, 0);
    std::vector<std::uint32_t> regions;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t i = 0; i < mesh.surfaces_of[t].size(); ++i)
            if (mesh.surfaces_of[t][i] == 0) regions.push_back(mesh.regions_of[t][i]);
    std::sort(regions.begin(), regions.end());
    regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
    CHECK(regions.size() == 9);
    CHECK(horizon.triangles.size() == 1134);
    ImproveOptions options;
    options.edge_length = 0.18; // about 8700 triangles, as in the paper
    const Improved better = improved(mesh, options);
    const Surface after = surface_of_mesh(better.mesh, 0);
    const QualityReport q = measure_quality(after.vertices, after.triangles);
    INFO(horizon.triangles.size() << " -> " << q.triangles << " mean " << q.q.mean << " min "
                                  << q.q.min << " above 0.8 " << q.share_above_08);
    CHECK(q.triangles > 8000);
    CHECK(q.triangles < 9500);
    CHECK(q.q.mean >= 0.93);
    CHECK(q.share_above_08 >= 0.95);
    CHECK(better.report.worst_cause != WorstCause::none);
    CHECK(sampled_distance(after, horizon) <= better.report.bound_of[0]);
    CHECK(sampled_distance(horizon, after) <= better.report.bound_of[0]);
}

TEST_CASE("improve: another method confirms the bound for all points", "[improve]") {
    const Mesh mesh = mesh_of(nine_regions());
    ImproveOptions options;
    options.edge_length = 1.2;
    options.max_deviation = 0.2;
    const Improved better = improved(mesh, options);
    CHECK(better.mesh->triangles.size() < mesh.triangles.size());
    for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
        const double most =
            distance_bound(surface_of_mesh(better.mesh, s), surface_of_mesh(mesh, s), 0.02);
        CHECK(most <= 0.2 + 0.02);
    }
}

TEST_CASE("improve: vertices of curves stay on them", "[improve]") {
    const Mesh mesh = mesh_of(nine_regions());
    ImproveOptions options;
    options.edge_length = 0.3;
    const Improved better = improved(mesh, options);
    REQUIRE_FALSE(better.mesh->intersection_edges.empty());
    // The old curve is given as degenerate triangles to the tree that measures distances.
    Surface curve;
    for (const Edge& e : mesh.intersection_edges) {
        const auto first = static_cast<std::uint32_t>(curve.vertices.size());
        for (const std::uint32_t v : {e[0], e[1], e[1]}) curve.vertices.push_back(mesh.vertices[v]);
        curve.triangles.push_back({first, first + 1, first + 2});
    }
    Surface ends;
    for (const Edge& e : better.mesh->intersection_edges)
        for (const std::uint32_t v : e) {
            const auto first = static_cast<std::uint32_t>(ends.vertices.size());
            ends.vertices.push_back(better.mesh->vertices[v]);
            ends.triangles.push_back({first, first, first});
        }
    CHECK(sampled_distance(ends, curve) < 1e-13);
}

TEST_CASE("improve: sheets closer than the bound never meet", "[improve]") {
    const auto wave = [](double off) {
        return [off](double u, double v) {
            return Point3{4 * u, 4 * v, 0.3 * std::sin(7 * u + off) * std::cos(6 * v) + off};
        };
    };
    const std::vector<Surface> sheets{unit_grid(24, 24, wave(0), "low"),
                                      unit_grid(17, 31, wave(0.01), "high")};
    const Mesh mesh = mesh_of(sheets);
    ImproveOptions options;
    options.edge_length = 0.4;
    options.max_deviation = 0.1;
    options.thickness_share = 1000;  // the bound is not limited by the distance of the sheets,
    options.max_volume_change = 1e9; // nor by the volume between them
    const Improved better = improved(mesh, options); // the result is checked exactly
    CHECK(better.report.refused_contact > 0);        // otherwise the test would be too easy
}

TEST_CASE("improve: no sheet sweeps over a piece that is smaller than the bound", "[improve]") {
    const auto hill = [](double height, double narrow) {
        return [=](double u, double v) {
            const double r = (u - 0.5) * (u - 0.5) + (v - 0.5) * (v - 0.5);
            const double fade =
                16 * u * (1 - u) * v * (1 - v); // the two surfaces share their borders
            return Point3{10 * u, 10 * v, height * fade * std::exp(-narrow * r)};
        };
    };
    for (const double size : {0.1, 0.02})
        for (const double narrow : {120.0, 300.0})
            for (const double length : {2.0, 4.0}) {
                Surface piece = cube(0, size); // below the top of the hill
                for (Point3& p : piece.vertices) p = {4.99 + p.x, 4.99 + p.y, 0.3 + p.z};
                const Mesh mesh = mesh_of({unit_grid(20, 20, hill(0.6, narrow), "top"),
                                           unit_grid(9, 9, hill(-3, 0), "bottom"), piece});
                ImproveOptions options;
                options.edge_length = length;
                options.max_deviation = 0.8;
                options.thickness_share = 1000;
                options.max_volume_change = 1e9;
                const Improved better = improved(mesh, options);
                INFO(size << ' ' << narrow << ' ' << length);
                CHECK(better.mesh->triangles.size() < mesh.triangles.size() / 4);
                CHECK(better.report.refused_contact > 0);
                CHECK(better.report.sides_kept);
            }
}

TEST_CASE("improve: the result does not depend on the number of threads", "[improve]") {
    const Mesh mesh = mesh_of(nine_regions());
    const Improved one = improved(mesh), four = improved(mesh, {}, {.threads = 4});
    CHECK(one.mesh->vertices == four.mesh->vertices);
    CHECK(one.mesh->triangles == four.mesh->triangles);
    CHECK(one.mesh->surfaces_of == four.mesh->surfaces_of);
    CHECK(one.mesh->intersection_edges == four.mesh->intersection_edges);
}

TEST_CASE("improve: target lengths hold by surface, along curves, and where a surface is curved",
          "[improve]") {
    const std::vector<Surface> surfaces{level(0, 0, 0, 10, 10),
                                        quad({-1, 5, -3}, {11, 5, -3}, {11, 5, 3}, {-1, 5, 3})};
    const Mesh mesh = mesh_of(surfaces);
    ImproveOptions options;
    options.edge_length = 1;
    options.edge_length_of = {0, 0.5};
    const Improved better = improved(mesh, options);
    CHECK(mean_edge(better.mesh, 0) > 1.3 * mean_edge(better.mesh, 1));
    CHECK(mean_edge(better.mesh, 1) == Approx(0.5).epsilon(0.2));
    ImproveOptions near_curves;
    near_curves.edge_length = 2;
    near_curves.curve_length = 0.25;
    CHECK(improved(mesh, near_curves).mesh->triangles.size() >
          2 * improved(mesh, {.edge_length = 2}).mesh->triangles.size());
    const Mesh bump = mesh_of({unit_grid(
        30, 30,
        [](double u, double v) {
            const double r = (u - 0.5) * (u - 0.5) + (v - 0.5) * (v - 0.5);
            return Point3{10 * u, 10 * v, std::exp(-60 * r)};
        },
        "bump")});
    ImproveOptions turning;
    turning.edge_length = 1;
    turning.max_deviation = 0.2;
    turning.least_quality = 0.3; // the half squares are good, so that few would be changed
    const auto plain = static_cast<double>(improved(bump, turning).mesh->triangles.size());
    turning.turn = 15;
    const auto turned = static_cast<double>(improved(bump, turning).mesh->triangles.size());
    // Equilateral triangles of the wanted lengths, which follow from the curvature of exp(-60 r)
    // and grow by 0.3: the integral of area / (sqrt(3) / 4 length^2) is 236 and 378.
    CHECK(plain == Approx(236).epsilon(0.2));
    CHECK(turned == Approx(378).epsilon(0.2));
    CHECK(turned > 1.4 * plain);
}

TEST_CASE("improve: closed, one-sided and folded surfaces stay near their originals", "[improve]") {
    for (const Surface& s : {torus({0, 0, 0}, 3, 1, 24), moebius_strip(24), cube(0, 4)}) {
        const Mesh mesh = mesh_of({s});
        ImproveOptions options;
        options.edge_length = 0.5;
        options.least_quality = 0.3; // all triangles of the cube are good: half squares
        const Improved better = improved(mesh, options);
        const double bound = better.report.bound_of[0];
        CHECK(sampled_distance(surface_of_mesh(better.mesh, 0), s) <= bound);
        const auto back = bounds_back(mesh, better, options);
        REQUIRE(back);
        CHECK(back.value()[0] == bound);
        CHECK(sampled_distance(s, surface_of_mesh(better.mesh, 0)) <= back.value()[0]);
        CHECK(better.report.after.q.mean > 0.85);
    }
}

TEST_CASE("improve: triangles that cross at random are refused, however they are connected",
          "[improve]") {
    // Features and curves are searched for while the mesh is still being checked.
    std::mt19937 random(8);
    std::uniform_real_distribution<double> coordinate(0, 1);
    for (int i = 0; i < 200; ++i) {
        Mesh mesh;
        for (std::uint32_t v = 0; v < 12; ++v)
            mesh.vertices.push_back(
                {coordinate(random), coordinate(random), i % 2 == 0 ? coordinate(random) : 0});
        std::uniform_int_distribution<std::uint32_t> vertex(0, 11), surface(0, 2);
        mesh.surfaces.resize(3);
        while (mesh.triangles.size() < 40) {
            const Triangle t{vertex(random), vertex(random), vertex(random)};
            if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
            mesh.triangles.push_back(t);
            mesh.surfaces_of.push_back(std::vector<std::uint32_t>{surface(random)});
        }
        Run run;
        run.threads = 2;
        CHECK(refusal(mesh, {}, run) == ErrorCode::improper_contact);
    }
}

TEST_CASE("improve: measuring tells its progress", "[improve]") {
    const auto exact = arrange(nine_regions());
    REQUIRE(exact);
    const auto rounded = round_to_doubles(*exact);
    REQUIRE(rounded);
    REQUIRE(rounded->conforming);
    std::vector<double> shares;
    Run run;
    run.progress = [&](std::string_view stage, double share) {
        if (stage == "measure") shares.push_back(share);
    };
    ImproveOptions options;
    options.edge_length = 1;
    REQUIRE(improve_and_measure(*rounded->conforming, options, run));
    CHECK(std::is_sorted(shares.begin(), shares.end()));
    CHECK(std::ranges::count_if(shares, [](double s) { return s > 0 && s < 1; }) >= 2);
    REQUIRE_FALSE(shares.empty());
    CHECK(shares.back() == 1);
}

TEST_CASE("improve: invalid options and meshes are refused", "[improve]") {
    const Mesh mesh = mesh_of(nine_regions());
    CHECK(refusal({}) == ErrorCode::nothing_to_do);
    ImproveOptions options;
    options.edge_length = -1;
    CHECK(refusal(mesh, options) == ErrorCode::bad_option);
    options = {};
    options.max_deviation = 1e-15;
    CHECK(refusal(mesh, options) == ErrorCode::bad_option);
    options = {};
    options.edge_length_of = {1};
    CHECK(refusal(mesh, options) == ErrorCode::bad_option);
    options = {};
    options.passes = 0;
    CHECK(refusal(mesh, options) == ErrorCode::bad_option);
    options = {};
    options.crease_angle = std::numeric_limits<double>::quiet_NaN();
    CHECK(refusal(mesh, options) == ErrorCode::bad_option);
    options = {};
    options.smallest = std::numeric_limits<double>::quiet_NaN();
    CHECK(refusal(mesh, options) == ErrorCode::bad_option);
    options = {};
    options.layers_in_gaps = std::numeric_limits<double>::infinity();
    CHECK(refusal(mesh, options) == ErrorCode::bad_option);
    options.layers_in_gaps = 1001;
    CHECK(refusal(mesh, options) == ErrorCode::bad_option);
    options = {};
    options.refinements = {{{{0, 0, 0}, 0}}};
    CHECK(refusal(mesh, options) == ErrorCode::bad_option);
    options.refinements = {{{{0, std::numeric_limits<double>::infinity(), 0}, 1}}};
    CHECK(refusal(mesh, options) == ErrorCode::bad_option);

    Mesh broken = mesh;
    broken.triangles[3][1] = static_cast<std::uint32_t>(mesh.vertices.size());
    CHECK(refusal(broken) == ErrorCode::bad_index);
    broken = mesh;
    broken.vertices[5].y = std::numeric_limits<double>::infinity();
    CHECK(refusal(broken) == ErrorCode::bad_number);
    broken = mesh; // two additional triangles that cross each other
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Point3& p : {Point3{50, 0, 0}, Point3{52, 0, 0}, Point3{51, 2, 0}, Point3{51, 1, -1},
                            Point3{51, 1, 1}, Point3{51, 3, 0}})
        broken.vertices.push_back(p);
    for (const std::uint32_t v : {first, first + 3}) {
        broken.triangles.push_back({v, v + 1, v + 2});
        broken.surfaces_of.push_back(std::vector<std::uint32_t>{0});
        broken.regions_of.push_back(std::vector<std::uint32_t>{0});
        broken.parents_of.push_back(std::vector<std::uint32_t>{0});
    }
    CHECK(refusal(broken) == ErrorCode::improper_contact);
    broken = mesh;
    broken.triangles[1] = broken.triangles[0];
    CHECK(refusal(broken) == ErrorCode::improper_contact);
    broken = mesh;
    broken.vertices.push_back(mesh.vertices[mesh.triangles[0][0]]);
    broken.triangles[0][0] = static_cast<std::uint32_t>(mesh.vertices.size());
    CHECK(refusal(broken) == ErrorCode::improper_contact);
    broken = mesh;
    broken.surfaces_of = {};
    CHECK(refusal(broken) == ErrorCode::bad_index);

    std::stop_source stop;
    Run run;
    run.stop = stop.get_token();
    run.progress = [&](std::string_view, double) { stop.request_stop(); };
    CHECK(refusal(mesh, {}, run) == ErrorCode::interrupted);
}

TEST_CASE("improve: edges are short at places that ask for it, and no shorter elsewhere",
          "[improve]") {
    const Mesh mesh = mesh_of({unit_grid(6, 6, [](double u, double v) {
        return Point3{12 * u, 12 * v, .2 * std::sin(6 * u)};
    })});
    ImproveOptions options;
    options.edge_length = 2;
    const Mesh plain = improved(mesh, options).mesh;
    const Point3 place{7, 5, .1};
    options.refinements = {{{place, .25}}};
    const Mesh local = improved(mesh, options).mesh;
    const auto edges_within = [&](const Mesh& of, double least, double most) {
        double sum = 0, count = 0, longest = 0;
        for (const Triangle& t : of.triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const Point3 &a = of.vertices[t[k]], &b = of.vertices[t[(k + 1) % 3]];
                const double away =
                    std::hypot((a.x + b.x) / 2 - place.x, (a.y + b.y) / 2 - place.y);
                if (away < least || away > most) continue;
                const double edge = std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
                longest = std::max(longest, edge);
                sum += edge;
                ++count;
            }
        return std::pair(sum / count, longest);
    };
    const auto [mean, longest] = edges_within(local, 0, 1);
    // Lengths grow by 0.3 of the distance; edges may be a third longer than that.
    CHECK(mean < 4. / 3 * (.25 + .3 * 1));
    CHECK(longest < 2 * (.25 + .3 * 1.5));
    CHECK(mean < edges_within(plain, 0, 1).first / 2);
    // From 5.8 on, they are as long as elsewhere.
    CHECK(edges_within(local, 6, 12).first > .8 * edges_within(plain, 6, 12).first);
    options.refinements = {{{place, 2}}};
    CHECK(improved(mesh, options).mesh->vertices == plain.vertices);
}

TEST_CASE("improve: refinements follow each other and leave triangles far from them as they are",
          "[improve]") {
    const Mesh mesh = mesh_of({unit_grid(8, 8, [](double u, double v) {
        return Point3{40 * u, 40 * v, std::sin(6 * u) * std::cos(4 * v)};
    })});
    ImproveOptions options;
    options.edge_length = 2;
    options.least_quality = .3; // those of the grid are as good as few others can be
    const Point3 first{9, 9, 0}, second{31, 31, 0};
    const auto refined = [&](std::vector<std::vector<LocalSize>> lists) -> Mesh {
        options.refinements = std::move(lists);
        return improved(mesh, options).mesh;
    };
    const auto far_from = [](const Mesh& of, const Point3& place) {
        constexpr double reach = 10; // lengths are 2 beyond 6.7 from a place
        std::vector<Point3> far;
        for (const Point3& p : of.vertices)
            if (std::hypot(p.x - place.x, p.y - place.y) > reach) far.push_back(p);
        std::sort(far.begin(), far.end());
        return far;
    };
    const Mesh plain = refined({});
    const Mesh once = refined({{{first, .2}}});
    const Mesh twice = refined({{{first, .2}}, {{second, .2}}});
    CHECK(once.vertices.size() > plain.vertices.size() + 50);
    CHECK(twice.vertices.size() > once.vertices.size() + 50);
    const auto kept = [&](const Mesh& before, const Mesh& after, const Point3& place) {
        std::vector<Point3> both;
        const auto a = far_from(before, place), b = far_from(after, place);
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
        CHECK(a.size() > 200);
        CHECK(b.size() == a.size());
        return both.size() == a.size()
                   ? 1
                   : static_cast<double>(both.size()) / static_cast<double>(a.size());
    };
    CHECK(kept(plain, once, first) == 1);
    CHECK(kept(once, twice, second) == 1);
    // A wish that is stated twice changes nothing more.
    CHECK(refined({{{first, .2}}, {{first, .5}}}).vertices == once.vertices);
}

TEST_CASE("improve: no point leaves a box by one unit, and its sides stay planes", "[improve]") {
    const Point3 low{0.1, 0.3, -1700.7}, high{1999.9, 1500.1, -699.3}; // round in decimals alone
    std::vector<Surface> surfaces;
    for (const char* name : {"top.ts", "base.ts", "fault.ts"})
        surfaces.push_back(read_data(source_dir() + "/docs/data/" + name)[0]);
    const auto made = arrange_within(surfaces, box_boundary(low, high).value(), {.seal = 20});
    REQUIRE(made);
    for (const double edge_length : {100, 150, 300}) {
        INFO(edge_length);
        ImproveOptions options;
        options.edge_length = edge_length;
        options.refinements = {{{Point3{0, 700, -1200}, 40}}};
        const Mesh better = improved(*made->rounded.mesh, options).mesh;
        for (const Point3& p : better.vertices)
            CHECK((low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && low.z <= p.z &&
                   p.z <= high.z));
        std::size_t on_sides = 0;
        for (std::size_t t = 0; t < better.triangles.size(); ++t) {
            const auto surfaces_of = better.surfaces_of[t];
            if (std::ranges::none_of(surfaces_of, [&](std::uint32_t s) {
                    return better.surfaces[s].role == Role::boundary;
                }))
                continue;
            ++on_sides;
            const auto is_on = [&](double Point3::*c, double at) {
                return std::ranges::all_of(better.triangles[t], [&](std::uint32_t v) {
                    return better.vertices[v].*c == at;
                });
            };
            CHECK((is_on(&Point3::x, low.x) || is_on(&Point3::x, high.x) ||
                   is_on(&Point3::y, low.y) || is_on(&Point3::y, high.y) ||
                   is_on(&Point3::z, low.z) || is_on(&Point3::z, high.z)));
        }
        CHECK(on_sides > 100);
    }
}
