// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests the tables of how surfaces end at each other, and of what faces what across them.
#include <terrane/algorithms/structure/structure.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include "support/rounded.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/volumes/volumes.hpp>

using namespace terrane;
using namespace test_support;

namespace {

struct Tables {
    std::vector<SurfaceRelation> relations;
    std::vector<Juxtaposition> juxtapositions;
};

Tables tables_of(const std::vector<Surface>& surfaces) {
    const Mesh mesh = mesh_of(surfaces);
    const auto volumes = find_volumes(mesh);
    REQUIRE(volumes);
    const Structure structure = build_structure(mesh, *volumes);
    return {find_relations(mesh, structure, find_free_borders(mesh, structure)),
            find_juxtapositions(structure)};
}

/// Describes the relations, those of surfaces that end near others or all the others.
std::vector<std::string> rows_of(const std::vector<SurfaceRelation>& relations,
                                 const std::vector<Surface>& surfaces, bool near = false) {
    std::vector<std::string> rows;
    for (const SurfaceRelation& r : relations) {
        if ((r.kind == RelationKind::near) != near) continue;
        rows.push_back(fmt::format("{} {} {} {:.4g}", surfaces[r.from].name, name_of(r.kind),
                                   surfaces[r.to].name, r.length));
        if (r.kind == RelationKind::near)
            rows.back() += fmt::format(", {:.4g} to {:.4g}", r.least, r.largest);
        else
            CHECK(r.largest == 0);
    }
    return rows;
}

using Rows = std::vector<std::string>;

/// An upright sheet at x, from y0 to y1 and z0 to z1.
Surface upright(double x, double y0, double y1, double z0, double z1, const std::string& name) {
    return quad({x, y0, z0}, {x, y1, z0}, {x, y1, z1}, {x, y0, z1}, name);
}

} // namespace

TEST_CASE("relations: a sheet that stops at another one, crosses it, or ends near it",
          "[structure]") {
    const Surface fault = upright(4, 0, 8, 0, 8, "fault");
    const auto rows = [&](double x0, double x1, bool near = false) {
        const std::vector<Surface> surfaces{fault, level(3, x0, 1, x1, 7, "horizon")};
        return rows_of(tables_of(surfaces).relations, surfaces, near);
    };
    CHECK(rows(0, 4) == Rows{"horizon stops at fault 6"});
    CHECK(rows(0, 8) == Rows{"fault crosses horizon 6"});
    CHECK(rows(0, 3.5).empty());
    const Rows near = rows(0, 3.5, true); // the end, and the sides of the horizon
    REQUIRE_FALSE(near.empty());
    for (const std::string& row : near) CHECK(row.find(" ends near ") != std::string::npos);
    CHECK(std::find_if(near.begin(), near.end(), [](const std::string& row) {
              return row == "horizon ends near fault 6, 0.5 to 0.5";
          }) != near.end());
}

TEST_CASE("relations: the surface that goes on is named second, in any order", "[structure]") {
    const Surface fault = upright(4, 0, 8, 0, 8, "fault"),
                  horizon = level(3, 0, 0, 4, 8, "horizon");
    for (const std::vector<Surface>& surfaces :
         {std::vector<Surface>{fault, horizon}, std::vector<Surface>{horizon, fault}}) {
        const auto relations = tables_of(surfaces).relations;
        CHECK(rows_of(relations, surfaces) == Rows{"horizon stops at fault 8"});
        for (const SurfaceRelation& r : relations)
            if (r.kind == RelationKind::stops) {
                CHECK(r.place.x == 4);
                CHECK(r.place.z == 3);
            }
    }
}

TEST_CASE("relations: two that end at each other, and two that share triangles", "[structure]") {
    const std::vector<Surface> corner{upright(0, 0, 8, 0, 8, "wall"),
                                      level(0, 0, 0, 8, 8, "floor")};
    CHECK(rows_of(tables_of(corner).relations, corner) == Rows{"wall meets floor 8"});
    const std::vector<Surface> overlap{level(0, 0, 0, 8, 8, "a"), level(0, 4, 2, 12, 6, "b")};
    const auto rows = rows_of(tables_of(overlap).relations, overlap);
    REQUIRE_FALSE(rows.empty());
    CHECK(rows[0].starts_with("a overlaps b "));
}

TEST_CASE("relations: areas between blocks, by surface", "[structure]") {
    std::vector<Surface> surfaces{box({0, 0, 0}, {8, 8, 8}), level(3, -1, -1, 9, 9, "horizon"),
                                  upright(2, -1, 9, -1, 9, "fault"),
                                  level(5, 1, 1, 1.5, 1.5, "loose")};
    const auto all = tables_of(surfaces).juxtapositions;
    double horizon = 0, fault = 0, outside = 0;
    for (const Juxtaposition& j : all) {
        CHECK(j.surface != SurfaceId(3)); // it dangles
        CHECK(j.blocks[0] < j.blocks[1]);
        if (j.surface == SurfaceId(1)) horizon += j.area;
        if (j.surface == SurfaceId(2)) fault += j.area;
        if (j.surface == SurfaceId(0)) {
            CHECK(j.blocks[0] == 0);
            outside += j.area;
        }
    }
    CHECK(all.size() == 2 + 2 + 4); // four blocks
    CHECK(horizon == Approx(64));
    CHECK(fault == Approx(64));
    CHECK(outside == Approx(6 * 64));
}
