// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/detail/borders.hpp>

#include <algorithm>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/intersection/injective_patches.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/quality/detail/features.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/predicates.hpp>

#include "support/points.hpp"

using namespace terrane;
using namespace terrane::quality::detail;
using namespace test_support;

namespace {

constexpr std::uint32_t cells = 5;

/// Builds a level sheet of squares from which some are missing: a crooked border, with holes.
Mesh holed_sheet(Random& random) {
    Mesh mesh;
    mesh.surfaces.push_back({"sheet", Role::unknown});
    for (int j = 0; j <= static_cast<int>(cells); ++j)
        for (int i = 0; i <= static_cast<int>(cells); ++i)
            mesh.vertices.push_back({2.0 * i, 2.0 * j, 0});
    for (std::uint32_t j = 0; j < cells; ++j)
        for (std::uint32_t i = 0; i < cells; ++i) {
            if (random_int(random, 0, 3) == 0) continue;
            const std::uint32_t a = j * (cells + 1) + i, b = a + cells + 1;
            mesh.triangles.push_back({a, a + 1, b + 1});
            mesh.triangles.push_back({a, b + 1, b});
        }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        mesh.surfaces_of.push_back(std::vector<std::uint32_t>{0});
    return mesh;
}

struct Sheet {
    Mesh mesh;
    Features features;
    WorkMesh work;
    InjectivePatches patches;

    explicit Sheet(Random& random) :
        mesh(holed_sheet(random)), features(find_features(mesh, {0.8, 3.2})), work(mesh, features),
        patches(find_injective_patches(work.points, work.triangles, features.sheet_of,
                                       group_edges(work.triangles, work.points.size(), {}))) {}

    [[nodiscard]] bool is_injective(std::uint32_t patch) const {
        for (std::uint32_t t = 0; t < work.triangles.size(); ++t)
            for (std::uint32_t u = 0; u < t; ++u)
                if (patches.of[t] == patch && patches.of[u] == patch &&
                    improper_contact(work.points, work.triangles[t], work.triangles[u]))
                    return false;
        return true;
    }
};

struct Count {
    int kept = 0, rejected_rightly = 0, rejected_needlessly = 0;
};

/// Moves a vertex of a border to a place near it where its triangles keep their orientation.
void move_one(Sheet& sheet, Borders& borders, Random& random, Count& count) {
    WorkMesh& work = sheet.work;
    const auto v =
        static_cast<std::uint32_t>(random_int(random, 0, static_cast<int>(work.points.size()) - 1));
    if (work.star[v].empty() || work.kinds[v] == VertexKind::inner) return;
    Change change;
    change.in_place = change.on_border = true;
    change.placed = v;
    const Point3 before = work.points[v];
    change.place = before;
    change.place.x += random_int(random, -3, 3);
    change.place.y += random_int(random, -3, 3);
    change.removed.assign(work.star[v].begin(), work.star[v].end());
    for (const std::uint32_t t : change.removed) change.add(work.triangles[t], t);
    const std::uint32_t patch = sheet.patches.of[change.removed[0]];
    if (patch == no_group) return;
    const Axis axis = sheet.patches.axis[patch];
    const auto orientation_of = [&](std::uint32_t t) {
        const auto& [a, b, c] = work.triangles[t];
        return orient2d(axis, work.points[a], work.points[b], work.points[c]);
    };
    const Sign orientation = orientation_of(change.removed[0]);
    work.points[v] = change.place;
    const bool is_oriented =
        std::all_of(change.removed.begin(), change.removed.end(), [&](std::uint32_t t) {
            return sheet.patches.of[t] == patch && orientation_of(t) == orientation;
        });
    const bool stays_injective = is_oriented && sheet.is_injective(patch);
    work.points[v] = before;
    if (!is_oriented) return;
    Borders::Search search;
    const bool kept = borders.keeps(change, sheet.patches.of, patch, axis, search);
    if (kept) REQUIRE(stays_injective);
    count.kept += kept;
    count.rejected_rightly += !kept && !stays_injective;
    count.rejected_needlessly += !kept && stays_injective;
    if (!kept || random_int(random, 0, 1) == 0) return;
    borders.update(change, sheet.patches.of, patch, true);
    work.points[v] = change.place; // the move is kept
}

} // namespace

TEST_CASE("improve: a patch whose border moves is kept only if it stays injective", "[improve]") {
    Random random(17);
    Count count;
    for (int model = 0; model < 120; ++model) {
        Sheet sheet(random);
        if (sheet.mesh.triangles.empty()) continue;
        Borders borders(sheet.work);
        borders.find(sheet.patches.of, sheet.patches.axis.size());
        for (int i = 0; i < 60; ++i) move_one(sheet, borders, random, count);
    }
    INFO(count.kept << ' ' << count.rejected_rightly << ' ' << count.rejected_needlessly);
    CHECK(count.kept > 5 * count.rejected_needlessly);
    CHECK(count.rejected_rightly > 20); // otherwise the test would be too easy
}
