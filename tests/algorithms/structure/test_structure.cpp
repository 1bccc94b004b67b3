// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/structure/structure.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "support/certified_inputs.hpp"
#include "support/paths.hpp"
#include "support/rounded.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/io/files.hpp>

using namespace terrane;
using namespace test_support;

namespace {

struct Built {
    Mesh mesh;
    Volumes volumes;
    Structure structure;
};

/// Returns std::nullopt if the mesh is not conforming in doubles.
std::optional<Built> try_build(const std::vector<Surface>& surfaces) {
    auto rounded = round_to_doubles(arranged(surfaces));
    if (!rounded || !rounded.value().report.clean) return std::nullopt;
    Built built;
    built.mesh = std::move(rounded.value().mesh);
    auto volumes = find_volumes(built.mesh);
    REQUIRE(volumes);
    built.volumes = std::move(volumes).value();
    built.structure = build_structure(built.mesh, built.volumes);
    return built;
}

Built build(const std::vector<Surface>& surfaces) {
    auto built = try_build(surfaces);
    REQUIRE(built);
    return std::move(*built);
}

std::map<LineKind, int> kinds(const Structure& s) {
    std::map<LineKind, int> count;
    for (const ModelLine& line : s.lines) ++count[line.kind];
    return count;
}

Surface with_role(Surface s, Role role) {
    s.role = role;
    return s;
}

/// Builds a vertical rectangle over (x0, y0) - (x1, y1), from -1 to 9.
Surface wall(double x0, double y0, double x1, double y1, std::string name) {
    return quad({x0, y0, -1}, {x1, y1, -1}, {x1, y1, 9}, {x0, y0, 9}, std::move(name));
}

/// Tells whether each directed edge occurs as often as its reverse, as in a closed mesh.
bool is_closed(const Mesh& mesh) {
    std::map<Edge, int> balance;
    for (const Triangle& t : mesh.triangles)
        for (unsigned i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i], b = t[(i + 1) % 3];
            balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    return std::all_of(balance.begin(), balance.end(), [](const auto& e) { return e.second == 0; });
}

/// Checks what holds for every model.
void check_laws(const Built& b) {
    const Structure& s = b.structure;
    const std::size_t triangles = b.mesh.triangles.size();
    std::vector<int> in_patch(triangles), in_interface(triangles);
    for (std::uint32_t p = 0; p < s.patches.size(); ++p)
        for (const std::uint32_t t : s.patches[p].triangles) {
            ++in_patch[t];
            CHECK(s.patch_of[t] == p);
            CHECK(s.patches[p].interface == s.interface_of[t]);
        }
    for (const ModelInterface& i : s.interfaces)
        for (const std::uint32_t t : i.triangles) {
            ++in_interface[t];
            auto sides = b.volumes.of_sides[t];
            std::sort(sides.begin(), sides.end());
            CHECK(sides == i.volumes);
            CHECK(std::ranges::equal(b.mesh.surfaces_of[t], i.surfaces));
        }
    CHECK(std::all_of(in_patch.begin(), in_patch.end(), [](int n) { return n == 1; }));
    CHECK(std::all_of(in_interface.begin(), in_interface.end(), [](int n) { return n == 1; }));

    // Lines contain each edge that is not within a patch exactly once.
    std::map<Edge, int> in_line;
    for (const ModelLine& line : s.lines)
        for (std::size_t i = 0; i + 1 < line.vertices.size(); ++i) {
            const std::uint32_t v = line.vertices[i], w = line.vertices[i + 1];
            ++in_line[{std::min(v, w), std::max(v, w)}];
        }
    group_edges(b.mesh.triangles, b.mesh.vertices.size())
        .for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            const bool within = sides.size() == 2 && s.interface_of[sides[0].triangle] ==
                                                         s.interface_of[sides[1].triangle];
            CHECK(in_line[Edge{low, high}] == (within ? 0 : 1));
            in_line.erase(Edge{low, high});
        });
    CHECK(in_line.empty());
    for (std::uint32_t c = 0; c < s.corners.size(); ++c)
        for (const std::uint32_t l : s.corners[c].lines)
            CHECK(std::ranges::count(s.lines[l].corners, c) > 0);

    // Blocks are closed; adjacent blocks have the same doubles on shared triangles.
    double sum = 0;
    std::map<std::array<Point3, 3>, int> shared;
    for (std::uint32_t block = 0; block < s.blocks.size(); ++block) {
        const MeshPart part = block_part(b.mesh, b.volumes, s, BlockId(block));
        CHECK(is_closed(part.mesh));
        if (block > 0) sum += s.blocks[block].volume;
        for (const Triangle& t : part.mesh.triangles) {
            std::array<Point3, 3> corners{part.mesh.vertices[t[0]], part.mesh.vertices[t[1]],
                                          part.mesh.vertices[t[2]]};
            std::sort(corners.begin(), corners.end());
            ++shared[corners];
        }
        const auto own = find_volumes(part.mesh);
        REQUIRE(own);
        if (block > 0) CHECK(own.value().total >= s.blocks[block].volume);
    }
    CHECK(std::all_of(shared.begin(), shared.end(), [](const auto& t) { return t.second == 2; }));
    CHECK(sum == Approx(b.volumes.total));
    CHECK(s.blocks[0].volume == 0);
}

} // namespace

TEST_CASE("structure: a cube of six surfaces has eight corners and twelve lines", "[structure]") {
    const Surface whole = cube(0, 1);
    std::vector<Surface> sides;
    for (std::uint32_t k = 0; k < 6; ++k) {
        sides.push_back({"side" + std::to_string(k), Role::boundary, whole.vertices, {}});
        sides.back().triangles = {whole.triangles[2 * k], whole.triangles[2 * k + 1]};
    }
    const Built b = build(sides);
    CHECK(b.structure.corners.size() == 8);
    CHECK(b.structure.lines.size() == 12);
    CHECK(b.structure.patches.size() == 6);
    CHECK(b.structure.blocks.size() == 2);
    CHECK(b.structure.blocks[1].area == Approx(6));
    CHECK(kinds(b.structure) == std::map<LineKind, int>{{LineKind::boundary, 12}});
    CHECK(b.structure.blocks[1].name == "inside the boundary");
    check_laws(b);
    const Built one = build({whole});
    CHECK(one.structure.lines.empty());
    CHECK(one.structure.patches.size() == 1);
    CHECK(one.structure.blocks[1].name == "inside cube");
}

TEST_CASE("structure: two horizons and a fault in a box have the expected entities",
          "[structure]") {
    const Built b = build({with_role(box({0, 0, 0}, {8, 8, 8}, "box"), Role::boundary),
                           with_role(level(3, -1, -1, 9, 9, "base"), Role::horizon),
                           with_role(level(5, -1, -1, 9, 9, "top"), Role::horizon),
                           with_role(wall(4, -1, 4, 9, "fault"), Role::fault)});
    const Structure& s = b.structure;
    REQUIRE(s.blocks.size() == 7);
    CHECK(s.blocks[1].name == "below base, west of fault");
    CHECK(s.blocks[2].name == "below top, above base, west of fault");
    CHECK(s.blocks[3].name == "above top, west of fault");
    CHECK(s.blocks[4].name == "below base, east of fault");
    CHECK(s.blocks[1].neighbours == std::vector<std::uint32_t>{0, 2, 4});
    CHECK(s.blocks[2].neighbours == std::vector<std::uint32_t>{0, 1, 3, 5});
    CHECK(s.blocks[2].volume == 4 * 8 * 2);
    CHECK(s.blocks[2].area == Approx(2 * (4 * 8 + 4 * 2 + 8 * 2)));
    const auto count = kinds(s);
    CHECK(count.at(LineKind::cutoff) == 4 + 2); // two inside, and their ends beyond the box
    CHECK(count.at(LineKind::free_border) > 0);
    for (const ModelInterface& i : s.interfaces)
        if (i.volumes == std::array<std::uint32_t, 2>{1, 4}) CHECK(i.area == Approx(8 * 3));
    check_laws(b);
}

TEST_CASE("structure: roles determine the kinds of lines", "[structure]") {
    const auto kind_of_crossing = [](const Surface& a, const Surface& b) {
        std::set<LineKind> found;
        const Built built = build({a, b});
        for (const ModelLine& line : built.structure.lines)
            if (line.kind != LineKind::free_border) found.insert(line.kind);
        REQUIRE(found.size() == 1);
        return *found.begin();
    };
    const Surface a = wall(0, -4, 0, 4, "a"), crossing = wall(-4, 0, 4, 0, "b"),
                  ending = wall(0, 0, 4, 0, "b");
    const auto fault = [](const Surface& s) { return with_role(s, Role::fault); };
    CHECK(kind_of_crossing(a, crossing) == LineKind::intersection);
    CHECK(kind_of_crossing(fault(a), fault(crossing)) == LineKind::intersection);
    CHECK(kind_of_crossing(fault(a), fault(ending)) == LineKind::branch);
    CHECK(kind_of_crossing(fault(a), ending) == LineKind::intersection);
    CHECK(kind_of_crossing(with_role(a, Role::horizon), fault(ending)) == LineKind::cutoff);
    CHECK(kind_of_crossing(with_role(a, Role::boundary), fault(ending)) == LineKind::boundary);
}

TEST_CASE("structure: closed lines and dangling interfaces are found", "[structure]") {
    const Built b = build({cube(0, 8), level(4, 2, 2, 6, 6, "inside")});
    REQUIRE(b.structure.lines.size() == 1);
    const ModelLine& border = b.structure.lines[0];
    CHECK(border.kind == LineKind::free_border);
    CHECK(border.vertices.front() == border.vertices.back());
    CHECK(border.corners == std::array<std::uint32_t, 2>{UINT32_MAX, UINT32_MAX});
    CHECK(border.length == 16);
    CHECK(b.structure.corners.empty());
    CHECK(b.structure.blocks[1].inner_interfaces.size() == 1);
    CHECK(b.structure.blocks[1].interfaces.size() == 1);
    CHECK(b.structure.blocks[1].neighbours == std::vector<std::uint32_t>{0});
    check_laws(b);
}

TEST_CASE("structure: modelA1 has the entities that RINGMesh counts", "[structure]") {
    const auto surfaces = read_surfaces(test_data() + "/ringmesh/modelA1.ml");
    REQUIRE(surfaces);
    const Built b = build(surfaces.value());
    CHECK(b.structure.corners.size() == 20);
    CHECK(b.structure.lines.size() == 36);
    CHECK(b.structure.patches.size() == 21);
    CHECK(b.structure.blocks.size() == 5);
}

TEST_CASE("structure: the laws hold for the certified inputs", "[structure]") {
    std::size_t built = 0;
    for (const test_support::Model& model : certified_inputs(150)) {
        INFO(model.name);
        if (const auto b = try_build(model.surfaces)) {
            check_laws(*b);
            ++built;
        }
    }
    CHECK(built > 40);
}

TEST_CASE("structure: entities do not depend on the order of the surfaces", "[structure]") {
    std::vector<Surface> model{box({0, 0, 0}, {8, 8, 8}, "box"), level(3, -1, -1, 9, 9, "base"),
                               quad({2, -1, -1}, {2, 9, -1}, {5, 9, 9}, {5, -1, 9}, "fault"),
                               wall(2, 2, 6, 5, "piece"), cube(1, 2)};
    const Built before = build(model);
    check_laws(before);
    std::reverse(model.begin(), model.end());
    const Built after = build(model);
    const auto& s = before.structure;
    const auto& r = after.structure;
    REQUIRE(s.corners.size() == r.corners.size());
    for (std::size_t c = 0; c < s.corners.size(); ++c)
        CHECK(before.mesh.vertices[s.corners[c].vertex] ==
              after.mesh.vertices[r.corners[c].vertex]);
    REQUIRE(s.lines.size() == r.lines.size());
    for (std::size_t l = 0; l < s.lines.size(); ++l) {
        CHECK(s.lines[l].kind == r.lines[l].kind);
        CHECK(s.lines[l].corners == r.lines[l].corners);
        CHECK(s.lines[l].length == Approx(r.lines[l].length));
    }
    REQUIRE(s.interfaces.size() == r.interfaces.size());
    for (std::size_t i = 0; i < s.interfaces.size(); ++i) {
        CHECK(s.interfaces[i].volumes == r.interfaces[i].volumes);
        CHECK(s.interfaces[i].area == Approx(r.interfaces[i].area));
    }
    REQUIRE(s.blocks.size() == r.blocks.size());
    for (std::size_t b = 0; b < s.blocks.size(); ++b)
        CHECK(s.blocks[b].volume == r.blocks[b].volume);
}

TEST_CASE("structure: blocks of the mesh get the indices of the exact blocks", "[structure]") {
    Volumes volumes;
    volumes.of_sides = {{0, 1}, {2, 1}, {3, 0}};
    volumes.measures = {HUGE_VAL, 1, 2, 3};
    const std::vector<std::uint32_t> match{0, 3, UINT32_MAX, 1};
    const Volumes after = renumbered(volumes, match, 5); // exact blocks 2 and 4 are lost
    CHECK(after.measures == std::vector<double>{HUGE_VAL, 3, 0, 1, 0, 2});
    CHECK(after.of_sides == std::vector<std::array<std::uint32_t, 2>>{{0, 3}, {5, 3}, {1, 0}});
}
