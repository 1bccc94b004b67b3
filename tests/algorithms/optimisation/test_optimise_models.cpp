// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Random models of planes, sheets, solids and dangling pieces, filled and improved: what becomes of
// them is sound by both checks, which share no code, and never worse than what TetGen made. With
// TERRANE_EFFORT=10 these are 200 models.
#include "support/effort.hpp"
#include "support/exact_numbers.hpp"
#include "support/filled.hpp"
#include "support/random_models.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmpxx.h>

#include <terrane/algorithms/optimisation/optimise.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>
#include <terrane/algorithms/verify/detail/tetrahedra.hpp>

namespace optimised_models_test {

using namespace test_support;

namespace {

/// The worst angles of tetrahedra, by the measures that are reported.
struct Worst {
    double quality = 1; ///< least sine, that of an obtuse angle times 0.7
    double sine = 1;
};

Worst worst_of(const TetrahedralMesh& mesh) {
    Worst worst;
    for (const auto& t : mesh.tetrahedra) {
        const auto& v = mesh.vertices;
        for (const double degrees : dihedral_angles({v[t[0]], v[t[1]], v[t[2]], v[t[3]]})) {
            const double sine = std::sin(degrees * std::numbers::pi / 180);
            worst.sine = std::min(worst.sine, sine);
            worst.quality = std::min(worst.quality, degrees > 90 ? 0.7 * sine : sine);
        }
    }
    return worst;
}

void check_sound(const Filled& f) {
    CHECK(text_of(violations_of(f)) == "");
    const auto volumes = test_support::exact_numbers(f.mesh, f.volumes);
    const TetrahedralMesh& m = f.tetrahedra;
    verifier::Violations found;
    verifier::check_tetrahedra(
        {true, m.vertices, m.tetrahedra, m.block_of, m.faces, m.face_triangle, m.twins},
        {f.mesh.vertices, f.mesh.triangles, f.volumes.of_sides, volumes}, found);
    for (const auto& violation : found) UNSCOPED_INFO(static_cast<int>(violation.rule));
    CHECK(found.empty());
}

} // namespace

TEST_CASE("optimise: random models are sound by both checks, and never worse", "[optimisation]") {
    std::size_t filled = 0, changed = 0;
    for (int seed = 1; seed <= cases(40); ++seed) {
        const auto rounded = round_to_doubles(arrange(ModelMaker(seed).model()).value());
        if (!rounded->report.clean) continue;
        const Mesh& mesh = rounded->mesh;
        const auto raw =
            tetrahedralize(mesh, {.mesher = Mesher::tetgen, .optimise = std::nullopt}, {});
        if (!raw) continue; // TetGen may find surfaces too close
        ++filled;
        INFO("seed " << seed);
        Filled f{mesh, find_volumes(mesh).value(), *raw};
        const auto report = optimise(f.tetrahedra, {.wanted_angle = seed % 3 == 0 ? 35. : 18.});
        REQUIRE(report);
        check_sound(f);
        const Worst before = worst_of(*raw), after = worst_of(f.tetrahedra);
        CHECK(after.quality >= before.quality * (1 - 1e-6));
        CHECK(after.sine >= before.sine * (1 - 1e-6));
        changed += f.tetrahedra.tetrahedra != raw->tetrahedra ? 1 : 0;
    }
    CHECK(2 * filled >= static_cast<std::size_t>(cases(40)));
    CHECK(changed >= filled / 2);
}

} // namespace optimised_models_test
