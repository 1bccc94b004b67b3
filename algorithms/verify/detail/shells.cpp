// SPDX-License-Identifier: LGPL-3.0-or-later
//
// find_shells of blocks.hpp.
#include <algorithm>
#include <array>
#include <utility>

#include <terrane/algorithms/verify/detail/blocks.hpp>
#include <terrane/algorithms/verify/detail/edges.hpp>
#include <terrane/algorithms/verify/detail/joined_sets.hpp>

namespace terrane::verifier {

namespace {

/// The side of a triangle that faces the triangles at larger angles around an edge. The normal of one that
/// ascends is the direction of the edge times that to the apex.
std::uint32_t ahead(const HalfEdge& at) {
    return 2 * at.triangle + (at.ascends ? 0 : 1);
}

/// A direction in a plane; the length is arbitrary.
using Direction = std::array<mpz_class, 2>;

/// Returns b - a, times a positive number.
std::array<mpz_class, 3> towards(const Vector4& a, const Vector4& b) {
    std::array<mpz_class, 3> d;
    for (std::size_t i = 0; i < 3; ++i) d[i] = b[i] * a[3] - a[i] * b[3];
    return d;
}

/// Returns the direction from the edge to the apex, projected along the edge. Seen against the
/// edge, its angles grow counterclockwise.
Direction direction(const ExactMesh& mesh, const HalfEdge& at) {
    const Vector4& start = mesh.points[at.edge[0]];
    const auto along = towards(start, mesh.points[at.edge[1]]);
    const auto out = towards(start, mesh.points[at.apex]);
    std::size_t k = 0;
    while (k < 2 && sgn(along[k]) == 0) ++k;
    const auto component = [&](std::size_t i) -> mpz_class {
        return (out[i] * along[k] - out[k] * along[i]) * sgn(along[k]);
    };
    Direction d{component((k + 1) % 3), component((k + 2) % 3)};
    if (sgn(along[k]) < 0) std::swap(d[0], d[1]);
    return d;
}

/// Tells whether the angle of a direction, from 0 to below a whole turn, is at least half a turn.
bool in_second_half(const Direction& d) {
    return sgn(d[1]) < 0 || (sgn(d[1]) == 0 && sgn(d[0]) < 0);
}

bool has_smaller_angle(const Direction& a, const Direction& b) {
    const bool late = in_second_half(a);
    if (late != in_second_half(b)) return !late;
    return a[0] * b[1] > a[1] * b[0];
}

/// Sorts the triangles at one edge by their angles.
void sort_by_angle(const ExactMesh& mesh, std::vector<HalfEdge>& around) {
    if (around.size() < 3) return; // two are in order anyway
    std::vector<std::pair<Direction, HalfEdge>> sorted;
    for (const HalfEdge& at : around) sorted.emplace_back(direction(mesh, at), at);
    std::sort(sorted.begin(), sorted.end(),
              [](const auto& a, const auto& b) { return has_smaller_angle(a.first, b.first); });
    for (std::size_t i = 0; i < around.size(); ++i) around[i] = sorted[i].second;
}

} // namespace

std::vector<Facing> facing_sides(const ExactMesh& mesh) {
    const auto all = half_edges(mesh.triangles);
    std::vector<Facing> pairs;
    pairs.reserve(all.size());
    for_each_edge(all, [&](std::span<const HalfEdge> sides) {
        std::vector<HalfEdge> around(sides.begin(), sides.end());
        sort_by_angle(mesh, around);
        const auto first = static_cast<std::ptrdiff_t>(pairs.size());
        for (std::size_t k = 0; k < around.size(); ++k)
            pairs.push_back(
                {around[k].edge, {ahead(around[k]), ahead(around[(k + 1) % around.size()]) ^ 1U}});
        std::sort(pairs.begin() + first, pairs.end());
    });
    return pairs;
}

Shells find_shells(const ExactMesh& mesh) {
    const std::size_t count = mesh.triangles.size();
    JoinedSets sides(2 * count), components(count);
    for (const auto& [edge, facing] : facing_sides(mesh)) {
        sides.join(facing[0], facing[1]);
        components.join(facing[0] / 2, facing[1] / 2);
    }
    Shells shells;
    shells.of_side.assign(2 * count, no_number);
    for (std::uint32_t s = 0; s < 2 * count; ++s) {
        const std::uint32_t first = sides.find(s); // the lowest side, which has its number already
        if (first == s) {
            shells.of_side[s] = static_cast<std::uint32_t>(shells.sides_of.size());
            shells.sides_of.emplace_back();
            shells.component_of.push_back(components.find(s / 2));
        }
        shells.of_side[s] = shells.of_side[first];
        shells.sides_of[shells.of_side[s]].push_back(s);
    }
    return shells;
}

} // namespace terrane::verifier
