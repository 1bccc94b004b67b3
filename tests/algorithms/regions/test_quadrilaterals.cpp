// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Divides a horizon of a seismic survey, a grid of quadrilaterals with gaps, by a fault and a
// contact.
#include <terrane/algorithms/regions/regions.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/diffusion.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

#include "support/paths.hpp"
#include "support/solids.hpp"

using namespace terrane;
using namespace test_support;

namespace {

/// Reads a horizon with a line "NAME" INLINE CROSSLINE Z for every second inline and crossline of
/// the survey that it covers; these are 25 m apart.
QuadSurface survey_horizon() {
    std::ifstream file(test_data() + "/gio/F3_FS6_ILXL.dat");
    QuadSurface horizon{"FS6", Role::horizon, {}, {}};
    std::map<std::array<int, 2>, std::uint32_t> number; // by inline and crossline
    for (std::string line; std::getline(file, line);) {
        std::string name;
        std::array<int, 2> place{};
        double z = 0;
        std::istringstream words(line);
        if (!(words >> name >> place[0] >> place[1] >> z)) continue; // a comment
        number.emplace(place, static_cast<std::uint32_t>(horizon.vertices.size()));
        horizon.vertices.push_back({25.0 * place[0], 25.0 * place[1], z});
    }
    for (const auto& [place, a] : number) {
        const auto [i, j] = place;
        const auto b = number.find({i + 2, j}), c = number.find({i + 2, j + 2}),
                   d = number.find({i, j + 2});
        if (b != number.end() && c != number.end() && d != number.end())
            horizon.quads.push_back({a, b->second, c->second, d->second});
    }
    return horizon;
}

/// Returns a plane through the middle of the points: with `dip`, a fault across them, else level.
Surface plane(const std::vector<Point3>& points, bool is_fault) {
    Point3 low = points[0], high = points[0];
    for (const Point3& p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const double x = (low.x + high.x) / 2, y = (low.y + high.y) / 2, z = (low.z + high.z) / 2;
    const double w = high.x - low.x, h = high.y - low.y, t = high.z - low.z;
    if (is_fault) // it ends in the middle
        return quad({x - 0.31 * w, y, low.z - t}, {x + 0.27 * w, low.y - h, low.z - t},
                    {x + 0.33 * w, low.y - h, high.z + t}, {x - 0.25 * w, y, high.z + t});
    return quad({low.x - w, low.y - h, z}, {high.x + w, low.y - h, z}, {high.x + w, high.y + h, z},
                {low.x - w, high.y + h, z});
}

struct Case {
    QuadSurface horizon;
    std::vector<Surface> surfaces;
    Arrangement exact;
    RoundedMesh rounded;
};

Case cut_horizon() {
    Case made{survey_horizon(), {}, {}, {}};
    const auto& points = made.horizon.vertices;
    made.surfaces = {plane(points, true), triangles_of(made.horizon), plane(points, false)};
    auto exact = arrange(made.surfaces);
    REQUIRE(exact);
    made.exact = std::move(exact).value();
    auto rounded = round_to_doubles(made.exact);
    REQUIRE(rounded);
    made.rounded = std::move(rounded).value();
    REQUIRE(made.rounded.report.clean);
    return made;
}

/// Tells for each quadrilateral, by exact tests of its two triangles with those of the other
/// surfaces, whether one of them meets it.
std::vector<bool> met_quads(const Case& made) {
    std::vector<bool> met(made.horizon.quads.size());
    for (std::size_t t = 0; t < made.surfaces[1].triangles.size(); ++t)
        for (const std::size_t other : {std::size_t{0}, std::size_t{2}})
            for (const Triangle& o : made.surfaces[other].triangles) {
                std::vector<Point3> points;
                for (const std::uint32_t v : made.surfaces[1].triangles[t])
                    points.push_back(made.surfaces[1].vertices[v]);
                for (const std::uint32_t v : o) points.push_back(made.surfaces[other].vertices[v]);
                if (improper_contact(points, {0, 1, 2}, {3, 4, 5})) met[t / 2] = true;
            }
    return met;
}

/// Lists the sides of cells that one cell alone has, which are the border of the surface if cells
/// are conforming.
std::set<Edge> border_of(const IndexLists<std::uint32_t>& cells) {
    std::map<Edge, int> count;
    for (std::size_t c = 0; c < cells.size(); ++c)
        for (std::size_t i = 0; i < cells[c].size(); ++i) {
            const auto [low, high] = std::minmax(cells[c][i], cells[c][(i + 1) % cells[c].size()]);
            ++count[{low, high}];
        }
    std::set<Edge> border;
    for (const auto& [edge, cells_there] : count) {
        REQUIRE(cells_there <= 2);
        if (cells_there == 1) border.insert(edge);
    }
    return border;
}

} // namespace

TEST_CASE("quadrilaterals: a horizon of a survey is divided where curves cross it, and only there",
          "[regions]") {
    const Case made = cut_horizon();
    const Mesh& mesh = made.rounded.mesh;
    const auto found = quad_cells(mesh, made.exact.inputs, SurfaceId(1));
    REQUIRE(found);
    const QuadCells& all = found.value();

    // Whole are those quadrilaterals that nothing meets, with their own four corners.
    const auto met = met_quads(made);
    std::vector<bool> whole(made.horizon.quads.size());
    for (std::size_t c = 0; c < all.cells.size(); ++c) {
        if (all.cells[c].size() != 4) continue;
        const std::uint32_t q = all.quad_of[c];
        whole[q] = true;
        for (unsigned i = 0; i < 4; ++i)
            CHECK(mesh.vertices[all.cells[c][i]] ==
                  made.horizon.vertices[made.horizon.quads[q][i]]);
    }
    std::size_t divided = 0;
    for (std::size_t q = 0; q < whole.size(); ++q) {
        CHECK(whole[q] != met[q]);
        divided += met[q] ? 1 : 0;
    }
    CHECK(made.horizon.quads.size() > 1000);
    CHECK(divided > 40);
    CHECK(5 * divided < made.horizon.quads.size());

    // Each triangle of the horizon is in exactly one cell, and the cells have the border of the
    // triangles: so they are conforming.
    std::size_t triangles = 0, in_cells = 0;
    IndexLists<std::uint32_t> of_triangles;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        if (std::ranges::binary_search(mesh.surfaces_of[t], 1U)) {
            ++triangles;
            of_triangles.push_back(mesh.triangles[t]);
        }
    for (std::size_t c = 0; c < all.cells.size(); ++c) in_cells += all.cells[c].size() - 2;
    CHECK(in_cells == triangles);
    CHECK(border_of(all.cells) == border_of(of_triangles));
}

TEST_CASE("quadrilaterals: regions of cells are the regions of their triangles", "[regions]") {
    const Case made = cut_horizon();
    const Mesh& mesh = made.rounded.mesh;
    const auto found = quad_cells(mesh, made.exact.inputs, SurfaceId(1));
    REQUIRE(found);
    const QuadCells& all = found.value();
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> region_of; // by sorted corners
    std::set<std::uint32_t> known;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < mesh.surfaces_of[t].size(); ++k)
            if (mesh.surfaces_of[t][k] == 1) {
                auto corners = mesh.triangles[t];
                std::sort(corners.begin(), corners.end());
                region_of[corners] = mesh.regions_of[t][k];
                known.insert(mesh.regions_of[t][k]);
            }
    CHECK(all.regions == known.size());
    CHECK(all.regions > 5);                      // the level plane cuts out closed curves
    std::map<std::uint32_t, std::uint32_t> same; // region of cells -> region of triangles
    for (std::size_t c = 0; c < all.cells.size(); ++c) {
        const auto corners = all.cells[c];
        std::array<std::uint32_t, 3> triangle{corners[0], corners[1], corners[2]};
        std::sort(triangle.begin(), triangle.end());
        REQUIRE(region_of.contains(triangle)); // 0, 1, 2 is one half of a whole quadrilateral
        const auto [it, fresh] = same.emplace(all.region_of[c], region_of[triangle]);
        CHECK(it->second == region_of[triangle]);
    }
    CHECK(same.size() == known.size());

    // Without the inclusion of the curves the horizon hangs together as it did before.
    IndexLists<std::uint32_t> quads;
    for (const Quadrilateral& q : made.horizon.quads) quads.push_back(q);
    const auto apart = regions_of_polygons(quads, {});
    CHECK(1 + *std::max_element(apart.begin(), apart.end()) < all.regions);
}

TEST_CASE("quadrilaterals: what is no surface of quadrilaterals is refused", "[regions]") {
    Surface one = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    one.triangles.pop_back();
    const auto exact = arrange(std::vector{one});
    REQUIRE(exact);
    auto rounded = round_to_doubles(exact.value());
    REQUIRE(rounded);
    Mesh mesh = rounded.value().mesh;
    const auto code = [&](std::uint32_t surface) {
        const auto found = quad_cells(mesh, exact.value().inputs, SurfaceId(surface));
        REQUIRE_FALSE(found);
        return found.error().code;
    };
    CHECK(code(0) == ErrorCode::unsupported);
    CHECK(code(1) == ErrorCode::bad_index);
    mesh.parents_of = {};
    CHECK(code(0) == ErrorCode::nothing_to_do);
}
