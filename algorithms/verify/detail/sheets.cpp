// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/sheets.hpp>

#include <algorithm>
#include <set>

#include <terrane/algorithms/verify/detail/edges.hpp>
#include <terrane/algorithms/verify/detail/joined_sets.hpp>

namespace terrane::verifier {

namespace {

class SheetFinder {
public:
    SheetFinder(const LabelledMesh& mesh, SharedNumbers& numbers) :
        mesh_(mesh), numbers_(numbers), joined_(mesh.triangles.size()) {}

    Sheets operator()() {
        name_sheets();
        for_each_edge(half_edges(mesh_.triangles), [this](auto sides) { add_edge(sides); });
        count_vertices();
        count_components();
        follow_chains();
        find_points();
        return std::move(found_);
    }

private:
    void name_sheets() {
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            const auto surfaces = mesh_.surfaces_of[t], regions = mesh_.regions_of[t];
            const std::uint32_t sheet = numbers_.sheets({Numbers(surfaces.begin(), surfaces.end()),
                                                         Numbers(regions.begin(), regions.end())});
            if (found_.triangles.size() <= sheet) {
                found_.triangles.resize(sheet + 1);
                found_.shapes.resize(sheet + 1);
            }
            found_.sheet_of.push_back(sheet);
            found_.triangles[sheet].push_back(static_cast<std::uint32_t>(t));
            ++found_.shapes[sheet].characteristic;
        }
    }

    /// Adds an edge with all its triangles.
    void add_edge(std::span<const HalfEdge> sides) {
        Numbers sheets;
        for (const HalfEdge& side : sides) sheets.push_back(found_.sheet_of[side.triangle]);
        std::ranges::sort(sheets);
        const bool listed = std::ranges::binary_search(mesh_.intersection_edges, sides[0].edge);
        if (listed) ++found_.intersection_edges;
        for (std::size_t i = 0; i < sheets.size(); ++i)
            if (i == 0 || sheets[i - 1] != sheets[i]) --found_.shapes[sheets[i]].characteristic;
        if (listed || sides.size() != 2 || sheets[0] != sheets[1]) {
            const std::uint32_t label = numbers_.labels({sheets, listed});
            found_.sheets_of_label[label] = sheets;
            edges_.push_back({sides[0].edge, label});
            return;
        }
        joined_.join(sides[0].triangle, sides[1].triangle);
        if (sides[0].ascends == sides[1].ascends) found_.shapes[sheets[0]].oriented = false;
    }

    void count_vertices() {
        std::set<std::array<std::uint32_t, 2>> used; // {sheet, vertex}
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
            for (const std::uint32_t v : mesh_.triangles[t])
                if (used.insert({found_.sheet_of[t], v}).second)
                    ++found_.shapes[found_.sheet_of[t]].characteristic;
    }

    void count_components() {
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
            if (joined_.find(t) == t) ++found_.shapes[found_.sheet_of[t]].components;
    }

    /// Finds the vertices at which several fans of triangles meet.
    void find_points() {
        std::map<std::uint32_t, Numbers> triangles_at;
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
            for (const std::uint32_t v : mesh_.triangles[t]) triangles_at[v].push_back(t);
        for (const auto& [v, triangles] : triangles_at)
            if (auto fans = fans_of(v, triangles); fans.size() > 1)
                ++found_.points[{numbers_.corners(mesh_.vertices[v]), std::move(fans)}];
    }

    /// Returns the sheets of each fan at a vertex, sorted.
    [[nodiscard]] std::vector<Numbers> fans_of(std::uint32_t v, const Numbers& triangles) const {
        JoinedSets sets(triangles.size());
        std::map<std::uint32_t, std::uint32_t> first_with; // by the other end of an edge
        for (std::uint32_t i = 0; i < triangles.size(); ++i)
            for (const std::uint32_t w : mesh_.triangles[triangles[i]])
                if (w != v) sets.join(i, first_with.try_emplace(w, i).first->second);
        std::map<std::uint32_t, std::set<std::uint32_t>> sheets;
        for (std::uint32_t i = 0; i < triangles.size(); ++i)
            sheets[sets.find(i)].insert(found_.sheet_of[triangles[i]]);
        std::vector<Numbers> fans;
        for (const auto& [fan, all] : sheets) fans.emplace_back(all.begin(), all.end());
        std::ranges::sort(fans);
        return fans;
    }

    // --- Chains ----------------------------------------------------------------------------------

    void follow_chains() {
        for (std::uint32_t e = 0; e < edges_.size(); ++e)
            for (const std::uint32_t v : edges_[e].first) at_[v].push_back(e);
        followed_.assign(edges_.size(), false);
        for (const auto& [v, edges] : at_)
            if (is_corner(edges))
                for (const std::uint32_t e : edges)
                    if (!followed_[e]) follow(v, e);
        for (std::uint32_t e = 0; e < edges_.size(); ++e)
            if (!followed_[e]) follow(edges_[e].first[0], e);
    }

    [[nodiscard]] bool is_corner(const Numbers& edges) const {
        return edges.size() != 2 || edges_[edges[0]].second != edges_[edges[1]].second;
    }

    /// Follows a chain from a vertex to the next corner, or back to the vertex.
    void follow(std::uint32_t start, std::uint32_t e) {
        std::vector<Triangle> edges;
        std::uint32_t v = start;
        const std::uint32_t label = edges_[e].second;
        for (;;) {
            followed_[e] = true;
            const Edge& edge = edges_[e].first;
            edges.push_back({edge[0], edge[1], edge[1]});
            v = edge[0] == v ? edge[1] : edge[0];
            const Numbers& here = at_[v];
            if (is_corner(here)) break;
            const std::uint32_t next = here[0] == e ? here[1] : here[0];
            if (followed_[next]) break;
            e = next;
        }
        CurveClass key{label, corner(start), corner(v)};
        if (key[1] > key[2]) std::swap(key[1], key[2]);
        ++found_.chains[key];
        auto& all = found_.curves[key];
        all.insert(all.end(), edges.begin(), edges.end());
    }

    /// Returns the number of a corner; no_number if the vertex, where a closed chain begins, is
    /// none.
    std::uint32_t corner(std::uint32_t v) {
        return is_corner(at_[v]) ? numbers_.corners(mesh_.vertices[v]) : no_number;
    }

    const LabelledMesh& mesh_;
    SharedNumbers& numbers_;
    Sheets found_;
    JoinedSets joined_;                                 ///< of triangles
    std::vector<std::pair<Edge, std::uint32_t>> edges_; ///< curve edges with their labels
    std::map<std::uint32_t, Numbers> at_;               ///< curve edges at a vertex
    std::vector<bool> followed_;                        ///< per curve edge
};

} // namespace

Sheets find_sheets(const LabelledMesh& mesh, SharedNumbers& numbers) {
    return SheetFinder(mesh, numbers)();
}

} // namespace terrane::verifier
