// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Both implementations of the canonical digest agree; any other arrangement has another digest.
#include "support/certified_inputs.hpp"
#include "support/claim.hpp"

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/sha256.hpp>
#include <terrane/algorithms/verify/detail/digest.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

namespace {

using namespace terrane;
using test_support::claim_of;

/// Returns a coplanar overlap, a duplicate, a triangle without area, and a wall through them.
std::vector<Surface> some_surfaces() {
    return {
        {"a", Role::horizon, {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {4, 0, 0}}, {{0, 1, 2}, {0, 3, 1}}},
        {"b", Role::horizon, {{2, 2, 0}, {10, 2, 0}, {2, 10, 0}}, {{0, 1, 2}, {1, 0, 2}}},
        {"c", Role::fault, {{3, 1, -2}, {3, 7, -1}, {3, 4, 3}}, {{0, 1, 2}}}};
}

std::string digest(std::span<const Surface> surfaces) {
    const auto a = arrange(surfaces);
    REQUIRE(a);
    return canonical_digest(surfaces, a.value());
}

} // namespace

TEST_CASE("digest: of a single triangle, as defined, step by step") {
    const std::vector<Surface> one{
        {"top", Role::unknown, {{0, 0, 0}, {0.5, 0, 0}, {0, -17, 0}}, {{0, 1, 2}}}};
    std::vector<Hash> points{sha256("0 0 0"), sha256("1/2 0 0"), sha256("0 -11 0")};
    std::sort(points.begin(), points.end());
    Sha256 state;
    state.feed("input");
    state.feed(points);
    state.feed("top");
    const Hash input = state.finish();
    std::vector<Hash> records;
    for (const Hash& point : points) {
        state.feed("vertex");
        state.feed(point);
        state.feed(input);
        records.push_back(state.finish());
    }
    state.feed("parent");
    state.feed(input);
    state.feed("1");
    records.push_back(state.finish());
    std::sort(records.begin(), records.end());
    state.feed("terrane-digest 1\n");
    state.feed(records);
    CHECK(digest(one) == "sha256:" + hexadecimal(state.finish()));
}

TEST_CASE("digest: producer and verifier agree, on any number of threads") {
    for (const auto& model : test_support::certified_inputs()) {
        INFO(model.name);
        const auto a = arrange(model.surfaces);
        REQUIRE(a);
        const auto expected = canonical_digest(model.surfaces, a.value());
        CHECK(canonical_digest(model.surfaces, a.value(), {.threads = 2}) == expected);
        CHECK(verifier::digest_of(model.surfaces, claim_of(a.value())) == expected);
    }
}

TEST_CASE("digest: changes with anything that is said") {
    const auto surfaces = some_surfaces();
    const auto a = arrange(surfaces);
    REQUIRE(a);
    const ArrangementClaim claim = claim_of(a.value());
    REQUIRE(claim.degenerate.size() == 1);
    REQUIRE(claim.duplicates.size() == 1);
    const auto expected = verifier::digest_of(surfaces, claim);
    using Mutation = std::function<void(ArrangementClaim&)>;
    const std::vector<Mutation> mutations{
        [](ArrangementClaim& c) { // one triangle fewer
            c.triangles.pop_back();
            c.parents_of.offsets.pop_back();
            c.parents_of.values.resize(c.parents_of.offsets.back());
        },
        [](ArrangementClaim& c) { ++c.parents_of.values.back(), c.parents_of.values.back() %= 5; },
        [](ArrangementClaim& c) { c.intersection_edges.pop_back(); },
        [](ArrangementClaim& c) { c.degenerate.clear(); },
        [](ArrangementClaim& c) { c.duplicates.clear(); },
        [](ArrangementClaim& c) { c.vertices.back() = c.vertices.front(); },
    };
    for (std::size_t i = 0; i < mutations.size(); ++i) {
        INFO(i);
        ArrangementClaim other = claim;
        mutations[i](other);
        CHECK(verifier::digest_of(surfaces, other) != expected);
    }
}

TEST_CASE("digest: changes with a name, and with one step of a double; not with the role") {
    const auto surfaces = some_surfaces();
    auto other = surfaces;
    other[2].name = "d";
    CHECK(digest(other) != digest(surfaces));
    other = surfaces;
    other[2].vertices[2].z = std::nextafter(other[2].vertices[2].z, 4);
    CHECK(digest(other) != digest(surfaces));
    other = surfaces;
    other[2].role = Role::boundary;
    CHECK(digest(other) == digest(surfaces));
}
