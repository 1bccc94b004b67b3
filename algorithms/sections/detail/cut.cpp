// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sections/detail/cut.hpp>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/selection/windings.hpp>

namespace terrane::sections {
namespace {

/// Returns the block of each volume of the arrangement: triangles of the section alone divide no block. `given`:
/// triangles of the model.
Result<std::vector<std::uint32_t>> blocks_of(const Arrangement& exact, const Volumes& found,
                                             const Volumes& volumes, std::size_t given) {
    if (volumes.of_sides.empty()) return std::vector<std::uint32_t>(found.measures.size(), 0);
    DisjointSets parts(found.measures.size());
    for (std::size_t t = 0; t < exact.triangles.size(); ++t)
        if (exact.parents_of[t][0] >= given) parts.join(found.of_sides[t][0], found.of_sides[t][1]);
    std::vector<std::uint32_t> block(found.measures.size(), no_index);
    block[0] = 0;
    for (std::size_t t = 0; t < exact.triangles.size(); ++t) {
        const std::uint32_t parent = exact.parents_of[t][0]; // by which the triangle is wound
        if (parent >= given) continue;
        for (const unsigned side : {0U, 1U}) {
            std::uint32_t& one = block[parts.find(found.of_sides[t][side])];
            if (one == no_index) one = volumes.of_sides[parent][side];
            if (one != volumes.of_sides[parent][side])
                return Error{ErrorCode::improper_contact,
                             "the mesh is not conforming, or the volumes are not its",
                             "triangle " + std::to_string(parent)};
        }
    }
    for (std::uint32_t v = 0; v < block.size(); ++v) block[v] = block[parts.find(v)];
    return block;
}

Error meets_itself(const Arrangement& exact, std::uint32_t vertex) {
    return {ErrorCode::bad_option,
            "the section surface crosses or touches itself near " +
                place_text(exact.nearest(VertexId(vertex))),
            "section"};
}

/// Whether a triangle is wound as the section is; it is wound as its first parent.
bool is_wound_as(const Arrangement& exact, std::uint32_t first, std::uint32_t section) {
    for (const Axis axis : {Axis::x, Axis::y, Axis::z})
        if (const Sign turn = turn_of(exact, first, axis); turn != Sign::Zero)
            return turn == turn_of(exact, section, axis);
    return true;
}

class Cutting {
public:
    Cutting(const Mesh& mesh, const SectionSurface& along, Arrangement exact) :
        mesh_(mesh), along_(along), number_(exact.triangles.size(), no_index) {
        made_.exact = std::move(exact);
    }

    /// Lists the triangles of the section. Returns the place of two that are the same.
    std::optional<Error> take(const Volumes& found, const std::vector<std::uint32_t>& block) {
        const Arrangement& exact = made_.exact;
        const std::size_t given = mesh_.triangles.size();
        for (std::size_t t = 0; t < exact.triangles.size(); ++t) {
            const auto parents = exact.parents_of[t];
            if (parents.back() < given) continue;
            if (parents.size() > 1 && parents[parents.size() - 2] >= given)
                return meets_itself(exact, exact.triangles[t][0]);
            CutTriangle one{exact.triangles[t],
                            {no_index, no_index, no_index},
                            {block[found.of_sides[t][0]], block[found.of_sides[t][1]]},
                            along_.sheet_of[parents.back() - given]};
            if (!is_wound_as(exact, parents.front(), parents.back())) {
                std::swap(one.corners[1], one.corners[2]);
                std::swap(one.blocks[0], one.blocks[1]);
            }
            number_[t] = static_cast<std::uint32_t>(made_.triangles.size());
            made_.triangles.push_back(one);
        }
        return std::nullopt;
    }

    /// Joins triangles across their edges, and finds traces. Returns the place of an edge at which the section
    /// meets itself.
    std::optional<Error> join() {
        std::optional<Error> flaw;
        const EdgeSides edges = group_edges(made_.exact.triangles, made_.exact.vertices.size());
        edges.for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            std::vector<std::uint32_t> own; // of the section, by their numbers in the arrangement
            for (const auto& side : sides)
                if (number_[side.triangle] != no_index) own.push_back(side.triangle);
            if (own.empty()) return;
            if (own.size() > 2 || (own.size() == 2 && !join_across(low, high, own)))
                flaw = flaw ? flaw : meets_itself(made_.exact, low);
            trace({low, high}, sides, own);
        });
        sort_unique(made_.traces);
        return flaw;
    }

    [[nodiscard]] Cut made() && { return std::move(made_); }

private:
    /// Joins two triangles; false if they face different ways.
    bool join_across(std::uint32_t low, std::uint32_t high, std::span<const std::uint32_t> two) {
        const std::uint32_t s = number_[two[0]], t = number_[two[1]];
        CutTriangle &one = made_.triangles[s], &other = made_.triangles[t];
        if (runs_along(one.corners, low, high) == runs_along(other.corners, low, high))
            return false;
        one.next[edge_in(one.corners, low, high)] = t;
        other.next[edge_in(other.corners, low, high)] = s;
        return true;
    }

    static std::size_t edge_in(const Triangle& corners, std::uint32_t a, std::uint32_t b) {
        for (std::size_t i = 0; i < 3; ++i)
            if (corners[i] != a && corners[i] != b) return (i + 1) % 3;
        return 0;
    }

    template <class Sides>
    void trace(const Edge& edge, const Sides& sides, std::span<const std::uint32_t> own) {
        std::vector<std::uint32_t> surfaces, within;
        for (const auto& side : sides) {
            const std::uint32_t parent = made_.exact.parents_of[side.triangle][0];
            if (parent >= mesh_.triangles.size()) continue;
            for (const std::uint32_t s : mesh_.surfaces_of[parent]) {
                surfaces.push_back(s);
                if (number_[side.triangle] != no_index) within.push_back(s);
            }
        }
        sort_unique(surfaces);
        for (const std::uint32_t s : surfaces)
            if (own.size() < 2 || std::count(within.begin(), within.end(), s) < 2)
                made_.traces.push_back({s, edge});
    }

    const Mesh& mesh_;
    const SectionSurface& along_;
    std::vector<std::uint32_t>
        number_; ///< per triangle of the arrangement: its number in the section, or no_index
    Cut made_;
};

} // namespace

Result<Cut> cut(const Mesh& mesh, const Volumes& volumes, const SectionSurface& along,
                const Run& run) {
    const std::array<Surface, 2> surfaces{
        Surface{"model", Role::unknown, mesh.vertices, mesh.triangles}, along.surface};
    auto exact = arrange(surfaces, {}, run);
    if (!exact) return exact.error();
    const auto found = find_volumes(*exact, run);
    if (!found) return found.error();
    const auto block = blocks_of(*exact, *found, volumes, mesh.triangles.size());
    if (!block) return block.error();
    Cutting cutting(mesh, along, std::move(*exact));
    if (const auto flaw = cutting.take(*found, *block)) return *flaw;
    if (const auto flaw = cutting.join()) return *flaw;
    return std::move(cutting).made();
}

} // namespace terrane::sections
