// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The check against damage: sound meshes with added nodes are accepted, and each kind of damage is
// refused by the name of its defect, on a cube, a geological model, and faults in a box.
#include "support/divided_models.hpp"
#include "support/effort.hpp"
#include "support/tetrahedra_damage.hpp"

#include <algorithm>

using namespace test_support;

namespace {

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
    for (std::size_t i = 0; i < damage.size(); i += is_sanitized ? 6 : 1) {
        const Damage& kind = damage[i];
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

/// Damages a model in some forms. Under sanitizers, which judge no verdicts, each sixth kind of damage is tried.
void check_model(const Filled& f, const std::vector<Filled>& forms) {
    check_accepted(f);
    for (const Filled& form : forms) {
        check_refused(form, damage_to_nodes());
        check_refused(form, damage_to_tetrahedra());
        check_refused(form, damage_to_attributes());
    }
    Filled cut = f;
    cut.tetrahedra = split_everywhere(f, f.tetrahedra);
    check_refused(cut, damage_to_cuts());
}

} // namespace

TEST_CASE("check_tetrahedra: each kind of damage is refused, on a cube", "[tetrahedra]") {
    const Filled f = tilted_cube();
    check_model(f, is_sanitized ? std::vector{blocks_of(f)} : std::vector{blocks_of(f), f});
}

TEST_CASE("check_tetrahedra: each kind of damage is refused, on a geological model",
          "[tetrahedra][once]") {
    const Filled f = geological_model();
    check_model(f, {blocks_of(f)});
}

TEST_CASE("check_tetrahedra: each kind of damage is refused, on faults", "[tetrahedra][once]") {
    const Filled f = faults();
    check_model(f, {f});
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
