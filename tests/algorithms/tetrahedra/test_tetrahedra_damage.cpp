// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The check against damage: sound meshes with added nodes are accepted, and each kind of damage is
// refused by the name of its defect, on a cube, a geological model, and faults in a box.
#include "support/tetrahedra_damage.hpp"

#include <algorithm>

#include "support/read.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/tetrahedra/split_nodes.hpp>
#include <terrane/algorithms/tetrahedra/without_outside.hpp>

using namespace test_support;

namespace {

/// A filled model with added nodes on edges, on triangles and in tetrahedra.
Filled divided(const std::vector<Surface>& surfaces) {
    Filled f = fill(surfaces);
    divide(f, 5);
    CHECK(f.on_edges.size() == 5);
    CHECK(f.on_faces.size() == 5);
    CHECK(f.inside.size() == 5);
    return f;
}

Filled tilted_cube() {
    Surface tilted = box({0, 0, 0}, {4, 4, 4}, "cube");
    for (Point3& p : tilted.vertices) // no side is parallel to an axis
        p = {p.x + .3 * p.y + .1, p.y - .2 * p.z + 7, p.z + .7 * p.x - .1 * p.y};
    return divided({tilted});
}

Filled geological_model() {
    return divided(read_data("ringmesh/modelA1.ml"));
}

/// The first faults of a region, cut by a level, in a box of two blocks.
Filled faults() {
    auto surfaces = read_data("arch-platform/faults.ts");
    surfaces.resize(6);
    surfaces.push_back(box({1.6, 42.3, -.2}, {2.9, 42.8, .1}, "region"));
    surfaces.push_back(level(-.01, 1.5, 42.2, 3, 42.9));
    return divided(surfaces);
}

using TetrahedralMeshes = std::vector<std::pair<const char*, TetrahedralMesh>>;

/// The tetrahedra as they were made, without the outside, and with the nodes on all surfaces split.
TetrahedralMeshes forms_of(const Filled& f) {
    const TetrahedralMesh blocks = without_outside(f.tetrahedra);
    std::vector<std::uint32_t> all(f.mesh.surfaces.size());
    for (std::uint32_t s = 0; s < all.size(); ++s) all[s] = s;
    auto split = split_nodes(f.tetrahedra, all), split_blocks = split_nodes(blocks, all);
    REQUIRE(split);
    REQUIRE(split_blocks);
    return {{"whole", f.tetrahedra},
            {"blocks", blocks},
            {"whole, split", std::move(split).value()},
            {"blocks, split", std::move(split_blocks).value()}};
}

/// The model without the outside.
Filled blocks_of(const Filled& f) {
    Filled blocks = f;
    blocks.tetrahedra = without_outside(f.tetrahedra);
    const auto& left = blocks.tetrahedra.vertices;
    for (auto* nodes : {&blocks.on_faces, &blocks.on_edges, &blocks.inside})
        for (std::uint32_t& node : *nodes)
            node = static_cast<std::uint32_t>(
                std::find(left.begin(), left.end(), f.tetrahedra.vertices[node]) - left.begin());
    return blocks;
}

void check_accepted(const Filled& f) {
    for (const auto& [form, tetrahedra] : forms_of(f)) {
        INFO(form);
        const auto report = check_tetrahedra(tetrahedra, f.mesh, f.volumes);
        CHECK(text_of(report.violations) == "");
        for (std::size_t v = 1; v < report.volumes.size(); ++v)
            CHECK(std::fabs(report.volumes[v].difference) <= report.volumes[v].bound);
    }
}

void check_refused(const Filled& sound, const std::vector<Damage>& damage) {
    const bool whole = sound.tetrahedra.surfaces.size() > sound.mesh.surfaces.size();
    for (const Damage& kind : damage) {
        if (kind.needs_outside && !whole) continue;
        INFO(kind.name);
        Filled f = sound;
        kind.inflict(f);
        const auto found = violations_of(f);
        INFO(text_of(found));
        CHECK(std::any_of(found.begin(), found.end(), [&](const TetrahedraViolation& v) {
            return v.defect == kind.expected && v.count > 0 && !v.first.empty();
        }));
    }
}

void check_model(const Filled& f) {
    check_accepted(f);
    for (const Filled& form : {f, blocks_of(f)}) {
        check_refused(form, damage_to_nodes());
        check_refused(form, damage_to_tetrahedra());
        check_refused(form, damage_to_attributes());
    }
    Filled cut = f;
    std::vector<std::uint32_t> all(f.mesh.surfaces.size());
    for (std::uint32_t s = 0; s < all.size(); ++s) all[s] = s;
    cut.tetrahedra = split_nodes(f.tetrahedra, all).value();
    check_refused(cut, damage_to_cuts());
}

} // namespace

TEST_CASE("check_tetrahedra: each kind of damage is refused, on a cube", "[tetrahedra]") {
    check_model(tilted_cube());
}

TEST_CASE("check_tetrahedra: each kind of damage is refused, on a geological model",
          "[tetrahedra]") {
    check_model(geological_model());
}

TEST_CASE("check_tetrahedra: each kind of damage is refused, on faults", "[tetrahedra]") {
    check_model(faults());
}

TEST_CASE("check_tetrahedra: the nodes that TetGen adds are accepted", "[tetrahedra]") {
    Surface tilted = box({0, 0, 0}, {4, 4, 4}, "cube");
    for (Point3& p : tilted.vertices)
        p = {p.x + .3 * p.y + 1e5, p.y - .2 * p.z + 3e5, p.z + .7 * p.x - .1 * p.y};
    Filled f = fill({tilted}, {.edge_length = .8});
    CHECK(f.tetrahedra.vertices.size() > 200);
    check_accepted(f);
    const auto& of = f.tetrahedra.face_triangle;
    CHECK(std::count_if(of.begin(), of.end(), [](std::uint32_t t) { return t < 12; }) > 200);
}

TEST_CASE("check_tetrahedra: facet nodes moved off a cube are refused, however many there are",
          "[tetrahedra]") {
    Filled f = fill({cube(0, 4)}, {.edge_length = .8});
    std::size_t moved = 0;
    for (Point3& p : f.tetrahedra.vertices)
        if (p.z == 4 && p.x > 0 && p.x < 4 && p.y > 0 && p.y < 4 && p.x != p.y && p.x + p.y != 4) {
            p.z += .15;
            ++moved;
        }
    CHECK(moved >= 10);
    const auto found = violations_of(f);
    INFO(text_of(found));
    REQUIRE_FALSE(found.empty());
    CHECK(std::any_of(found.begin(), found.end(), [&](const TetrahedraViolation& v) {
        return v.defect == TetrahedraDefect::node_off_plane && v.count == moved;
    }));
}
