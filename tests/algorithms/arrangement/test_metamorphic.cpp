// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Changes that must not affect the arrangement, on the inputs of tests/certified.
#include "support/certified_inputs.hpp"
#include "support/metamorphic.hpp"
#include "support/rounded.hpp"

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/verify/detail/digest.hpp>

#include <catch2/catch.hpp>

#include <random>

namespace {

using namespace terrane;
using namespace test_support;

std::string digest_of(std::span<const Surface> surfaces) {
    return canonical_digest(surfaces, arranged(surfaces));
}

/// Checks that both arrangements are equal, with the claim about the transformed surfaces carried
/// back.
void check_same(const Surfaces& original, const ArrangementClaim& carried) {
    CHECK(carried.triangles.size() == arranged(original).triangles.size());
    CHECK(verifier::digest_of(original, carried) == digest_of(original));
}

/// Returns triangles in general position: no three lines meet in a point, no four points lie on a
/// circle.
Surfaces random_surfaces(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    Surfaces surfaces(2);
    for (Surface& s : surfaces) {
        s.name = &s == surfaces.data() ? "a" : "b";
        for (std::uint32_t v = 0; v < 24; ++v)
            s.vertices.push_back({coordinate(random), coordinate(random), coordinate(random)});
        for (std::uint32_t t = 0; t < 8; ++t) s.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return surfaces;
}

} // namespace

TEST_CASE("metamorphic: order and orientation do not change the digest") {
    std::mt19937 random(1);
    for (const Model& model : certified_inputs()) {
        INFO(model.name);
        CHECK(digest_of(shuffled(model.surfaces, random)) == digest_of(model.surfaces));
    }
}

TEST_CASE("metamorphic: triangles as one surface each keep their points and parts") {
    for (const Model& model : certified_inputs(100)) {
        INFO(model.name);
        Surfaces apart;
        for (const Surface& s : model.surfaces)
            for (const Triangle& t : s.triangles)
                apart.push_back({s.name,
                                 s.role,
                                 {s.vertices[t[0]], s.vertices[t[1]], s.vertices[t[2]]},
                                 {{0, 1, 2}}});
        const auto a = arranged(model.surfaces), b = arranged(apart);
        CHECK(a.triangles.size() == b.triangles.size());
        CHECK(a.vertices.size() == b.vertices.size());
    }
}

TEST_CASE("metamorphic: scaling by a power of two commutes with arranging") {
    for (const Model& model : certified_inputs())
        for (const int k : {-3, 11}) {
            INFO(model.name << " times 2^" << k);
            const auto other = scaled(model.surfaces, k);
            if (other.empty()) continue;
            CHECK(verifier::digest_of(model.surfaces, claim_of(arranged(other))) ==
                  digest_of(model.surfaces));
        }
}

TEST_CASE("metamorphic: reflections do not change the digest") {
    for (const Model& model : certified_inputs())
        for (const Change& reflected : reflections) {
            INFO(model.name);
            check_same(model.surfaces, claim_of(arranged(changed(model.surfaces, reflected))));
        }
}

TEST_CASE("metamorphic: other names of the axes do not change the digest") {
    for (const Model& model : certified_inputs()) {
        INFO(model.name);
        auto claim = claim_of(arranged(changed(model.surfaces, turned)));
        turn_back(claim);
        check_same(model.surfaces, claim);
    }
}

TEST_CASE("metamorphic: random surfaces, reflected and with other names of the axes") {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        INFO(seed);
        const auto surfaces = random_surfaces(seed);
        for (const Change& reflected : reflections)
            check_same(surfaces, claim_of(arranged(changed(surfaces, reflected))));
        auto claim = claim_of(arranged(changed(surfaces, turned)));
        turn_back(claim);
        check_same(surfaces, claim);
    }
}

TEST_CASE("metamorphic: arranging what is arranged changes nothing") {
    for (const Model& model : certified_inputs()) {
        INFO(model.name);
        const auto rounded = round_to_doubles(arranged(model.surfaces));
        REQUIRE(rounded);
        REQUIRE(rounded.value().report.clean);
        const Mesh& mesh = rounded.value().mesh;
        const auto again = arranged(surfaces_of(mesh));
        const auto rounded_again = round_to_doubles(again);
        REQUIRE(rounded_again);
        const Mesh& same = rounded_again.value().mesh;
        CHECK(again.statistics.constructed_points == 0);
        CHECK(rounded_again.value().report.max_move == 0);
        CHECK(same.triangles.size() == mesh.triangles.size());
        CHECK(triangles_of(same.vertices, same.triangles) ==
              triangles_of(mesh.vertices, mesh.triangles));
        // Triangles that had several coplanar parents in one surface now have one parent.
        const bool one_parent_each =
            std::ranges::equal(mesh.parents_of.offsets, mesh.surfaces_of.offsets);
        if (one_parent_each)
            CHECK(same.intersection_edges.size() == mesh.intersection_edges.size());
    }
}
