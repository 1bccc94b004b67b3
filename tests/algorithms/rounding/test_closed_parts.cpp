// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/closed_parts.hpp>

#include <catch2/catch.hpp>

#include <terrane/algorithms/rounding/detail/state.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <utility>

namespace {

using namespace terrane;
using namespace terrane::rounding::detail;

/// Returns a state whose triangles have the parents 0 to count - 1.
RoundingState state_of(std::vector<Triangle> triangles, std::span<const std::uint32_t> counts) {
    RoundingState state;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        std::vector<std::uint32_t> parents(counts[t]);
        std::iota(parents.begin(), parents.end(), 0U);
        state.parents_of.push_back(parents);
    }
    state.triangles = std::move(triangles);
    return state;
}

std::vector<std::uint32_t> superfluous(const std::vector<Triangle>& triangles) {
    std::vector<std::uint32_t> parts(triangles.size());
    std::iota(parts.begin(), parts.end(), 0U);
    const auto state = state_of(triangles, std::vector<std::uint32_t>(triangles.size(), 1));
    return superfluous_parts(triangles, state.parents_of, parts);
}

std::set<std::pair<std::uint32_t, std::uint32_t>> edges_of(const std::vector<Triangle>& triangles) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const Triangle& t : triangles)
        for (unsigned i = 0; i < 3; ++i) edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
    return edges;
}

const std::vector<Triangle> tetrahedron{{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

} // namespace

TEST_CASE("rounding: parts that enclose nothing are not superfluous") {
    CHECK(superfluous({}).empty());
    CHECK(superfluous({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}).empty());            // a fan
    CHECK(superfluous({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 1, 5}}).empty()); // a book
    // A ring: no edge of it is shared by all.
    CHECK(superfluous({{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}, {2, 0, 5}, {0, 3, 5}}).empty());
    // A projective plane of six vertices has no free edge, but is no boundary modulo 2 of a space: it
    // is a cycle all the same, which loses one triangle.
    CHECK(superfluous({{0, 1, 2},
                       {0, 2, 3},
                       {0, 3, 4},
                       {0, 4, 5},
                       {0, 5, 1},
                       {1, 2, 4},
                       {2, 3, 5},
                       {3, 4, 1},
                       {4, 5, 2},
                       {5, 1, 3}})
              .size() == 1);
}

TEST_CASE("rounding: parts that enclose spaces lose one triangle for each, and no edge") {
    CHECK(superfluous(tetrahedron) == std::vector<std::uint32_t>{3});
    auto two = tetrahedron; // on either side of a triangle
    two.insert(two.end(), {{0, 1, 4}, {1, 2, 4}, {2, 0, 4}});
    // A triangle that hangs on, a sheet round it, and a tube between two tetrahedra.
    auto more = two;
    more.insert(more.end(), {{0, 1, 5}, {5, 1, 6}});
    auto apart = tetrahedron;
    for (Triangle t : tetrahedron) {
        for (std::uint32_t& v : t) v += 4;
        apart.push_back(t);
    }
    apart.insert(apart.end(), {{0, 1, 4}, {1, 5, 4}});
    for (const auto& triangles : {two, more, apart}) {
        auto left = triangles;
        const auto gone = superfluous(triangles);
        CHECK(gone.size() == 2);
        for (auto t = gone.rbegin(); t != gone.rend(); ++t) left.erase(left.begin() + *t);
        CHECK(edges_of(left) == edges_of(triangles));
        CHECK(superfluous(left).empty());
    }
}

TEST_CASE("rounding: a triangle goes where it encloses a space as the part of its last input") {
    auto state = state_of(tetrahedron, std::array<std::uint32_t, 4>{2, 1, 1, 1});
    state.open_closed_parts(0.25);
    CHECK(state.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 1, 3}, {1, 2, 3}});
    CHECK(state.parents_of.values == std::vector<std::uint32_t>{0, 1, 0, 0});
    CHECK(state.total_gaps() >= 0.25);
    state.open_closed_parts(0.5);
    CHECK(state.triangles.size() == 3);
    CHECK(state.total_gaps() < 0.5);
    state = state_of(tetrahedron,
                     std::array<std::uint32_t, 4>{3, 3, 3, 2}); // the third has no such part
    state.open_closed_parts(0.25);
    CHECK(state.triangles.size() == 3);
    CHECK(state.parents_of.size() == 3);
}

TEST_CASE("rounding: two triangles whose common side is two paths are ill-joined") {
    const std::vector<Triangle> corners{{0, 1, 2}, {1, 0, 3}};
    // The side 0 1 goes through 4 and through 5. Each input has slivers between, and one of these paths
    // is its border.
    std::vector<Triangle> triangles{{0, 5, 2}, {5, 1, 2}, {0, 4, 5}, {4, 1, 5}, {4, 0, 3},
                                    {1, 4, 3}, {0, 4, 6}, {0, 6, 5}, {4, 1, 6}, {6, 1, 5}};
    IndexLists<std::uint32_t> parents_of;
    for (std::uint32_t t = 0; t < 10; ++t) parents_of.push_back(std::array{t < 4 ? 0U : 1U});
    const auto found = [&](std::span<const Triangle> inputs) {
        return ill_joined(triangles, parents_of, inputs);
    };
    CHECK(found(corners) == std::vector<Side>{{0, 1}});
    CHECK(found(std::vector<Triangle>{{0, 1, 2}, {1, 6, 3}}).empty()); // no common side
    triangles = {{0, 4, 2}, {4, 1, 2}, {4, 0, 3}, {1, 4, 3}};
    parents_of = {};
    for (std::uint32_t t = 0; t < 4; ++t) parents_of.push_back(std::array{t / 2});
    CHECK(found(corners).empty());

    const auto may_change = [&](std::vector<Triangle> before, std::vector<Triangle> after,
                                const Triangle& second) {
        return may_change_joints(before, parents_of, after, parents_of,
                                 {{0, corners[0]}, {1, second}});
    };
    auto torn = triangles; // only at one end
    torn[3] = {1, 5, 3};
    CHECK(may_change(triangles, torn, corners[1]));
    CHECK(may_change(torn, triangles, corners[1]));
    CHECK_FALSE(may_change(triangles, torn, {1, 6, 3})); // no common side
    IndexLists<std::uint32_t> of_two;                    // 4 is merged with 0
    for (std::uint32_t t = 0; t < 2; ++t) of_two.push_back(std::array{t});
    CHECK_FALSE(may_change_joints(triangles, parents_of, corners, of_two,
                                  {{0, corners[0]}, {1, corners[1]}}));
}
