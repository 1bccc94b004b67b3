// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/model_lines.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include <terrane/algorithms/verify/detail/edges.hpp>
#include <terrane/algorithms/verify/detail/measure.hpp>

namespace terrane::verifier {

namespace {

/// An edge of a line: the triangles around it, and their patches, each once and ascending.
struct BorderEdge {
    Edge ends{};
    Numbers triangles, patches;
    Numbers patches_of_sides; ///< one per triangle, ascending
    bool used = false;
};

class LineFinder {
public:
    LineFinder(const WrittenMesh& mesh, std::span<const SurfaceInfo> surfaces,
               const BlockParts& parts) :
        mesh_(mesh),
        surfaces_(surfaces), parts_(parts), at_vertex_(mesh.vertices.size()),
        rank_(ranks_of(mesh.vertices)) {
        find_edges();
    }

    LineParts operator()() {
        for (std::uint32_t v = 0; v < at_vertex_.size(); ++v)
            if (is_corner(v))
                for (const std::uint32_t e : at_vertex_[v]) follow(v, e);
        for (std::uint32_t e = 0; e < edges_.size(); ++e) follow(edges_[e].ends[0], e);
        const auto rank_of = [this](std::uint32_t v) { return rank_[v]; };
        std::ranges::sort(found_.lines, [&](const LinePart& a, const LinePart& b) {
            return std::ranges::lexicographical_compare(a.vertices, b.vertices, {}, rank_of,
                                                        rank_of);
        });
        number_corners();
        found_.lines_of_patch.resize(parts_.patches.size());
        for (std::uint32_t l = 0; l < found_.lines.size(); ++l)
            for (const std::uint32_t p : found_.lines[l].patches)
                found_.lines_of_patch[p].push_back(l);
        return std::move(found_);
    }

private:
    void find_edges() {
        for (auto& [ends, triangles] : triangles_at_edges(mesh_.triangles)) {
            const auto& interface = parts_.interface_of;
            if (triangles.size() == 2 && interface[triangles[0]] == interface[triangles[1]])
                continue;
            for (const std::uint32_t v : ends)
                at_vertex_[v].push_back(static_cast<std::uint32_t>(edges_.size()));
            BorderEdge edge{ends, std::move(triangles), {}, {}, false};
            for (const std::uint32_t t : edge.triangles)
                edge.patches_of_sides.push_back(parts_.patch_of[t]);
            std::sort(edge.patches_of_sides.begin(), edge.patches_of_sides.end());
            std::ranges::unique_copy(edge.patches_of_sides, std::back_inserter(edge.patches));
            edges_.push_back(std::move(edge));
        }
    }

    [[nodiscard]] bool is_corner(std::uint32_t v) const {
        const Numbers& here = at_vertex_[v];
        return !here.empty() && (here.size() != 2 || edges_[here[0]].patches_of_sides !=
                                                         edges_[here[1]].patches_of_sides);
    }

    /// Follows the line that begins at a vertex with an edge, unless it is known.
    void follow(std::uint32_t v, std::uint32_t e) {
        if (edges_[e].used) return;
        LinePart line = described(edges_[e]);
        line.vertices = {v};
        do {
            edges_[e].used = true;
            v = edges_[e].ends[edges_[e].ends[0] == v ? 1 : 0];
            line.vertices.push_back(v);
            const Numbers& here = at_vertex_[v];
            e = here[here[0] == e ? here.size() - 1 : 0];
        } while (!is_corner(v) && v != line.vertices.front());
        put_least_first(line.vertices);
        for (std::size_t i = 1; i < line.vertices.size(); ++i)
            line.length += distance_between(mesh_.vertices[line.vertices[i - 1]],
                                            mesh_.vertices[line.vertices[i]]);
        found_.lines.push_back(std::move(line));
    }

    void put_least_first(Numbers& line) const {
        const auto before = [&](std::uint32_t a, std::uint32_t b) { return rank_[a] < rank_[b]; };
        if (line.front() != line.back()) {
            if (before(line.back(), line.front())) std::reverse(line.begin(), line.end());
            return;
        }
        if (!is_corner(line.front())) {
            line.pop_back();
            std::rotate(line.begin(), std::min_element(line.begin(), line.end(), before),
                        line.end());
            line.push_back(std::uint32_t(line.front()));
        }
        if (before(line[line.size() - 2], line[1])) std::reverse(line.begin(), line.end());
    }

    [[nodiscard]] LinePart described(const BorderEdge& edge) const {
        std::map<std::uint32_t, std::size_t> triangles_of; // surface: number of triangles
        for (const std::uint32_t t : edge.triangles)
            for (const std::uint32_t s : mesh_.surfaces_of[t]) ++triangles_of[s];
        LinePart line{kind_of(edge, triangles_of), {}, edge.patches, {}};
        for (const auto& [surface, count] : triangles_of) line.surfaces.push_back(surface);
        return line;
    }

    [[nodiscard]] std::string_view
    kind_of(const BorderEdge& edge,
            const std::map<std::uint32_t, std::size_t>& triangles_of) const {
        if (edge.triangles.size() == 1) return "free border";
        const auto any = [&](const auto& holds) {
            return std::ranges::any_of(triangles_of, [&](const auto& s) {
                return holds(surfaces_[s.first].role, s.second);
            });
        };
        const auto has = [&](Role role) {
            return any([&](Role r, std::size_t) { return r == role; });
        };
        if (has(Role::boundary)) return "boundary line";
        if (has(Role::horizon) && has(Role::fault)) return "cutoff line";
        const bool faults_only = !has(Role::horizon) && !has(Role::unknown);
        const bool one_ends = any([](Role, std::size_t count) { return count == 1; });
        return faults_only && one_ends && triangles_of.size() > 1 ? "branch line"
                                                                  : "intersection curve";
    }

    void number_corners() {
        std::map<std::uint32_t, std::uint32_t> number_of; // rank: number
        for (std::uint32_t v = 0; v < at_vertex_.size(); ++v)
            if (is_corner(v)) number_of[rank_[v]] = v;
        for (auto& [rank, number] : number_of) {
            const std::uint32_t vertex = number;
            number = static_cast<std::uint32_t>(found_.corners.size());
            found_.corners.push_back({vertex, {}});
        }
        for (std::uint32_t l = 0; l < found_.lines.size(); ++l) {
            LinePart& line = found_.lines[l];
            const std::array ends{line.vertices.front(), line.vertices.back()};
            for (std::size_t i = 0; i < 2; ++i) {
                if (!is_corner(ends[i])) continue;
                line.corners[i] = number_of.at(rank_[ends[i]]);
                found_.corners[line.corners[i]].lines.push_back(l);
            }
        }
    }

    const WrittenMesh& mesh_;
    std::span<const SurfaceInfo> surfaces_;
    const BlockParts& parts_;
    std::vector<BorderEdge> edges_;
    std::vector<Numbers> at_vertex_; ///< edges of lines
    Numbers rank_;                   ///< per vertex, in the lexicographic order of the points
    LineParts found_;
};

} // namespace

LineParts find_lines(const WrittenMesh& mesh, std::span<const SurfaceInfo> surfaces,
                     const BlockParts& parts) {
    return LineFinder(mesh, surfaces, parts)();
}

} // namespace terrane::verifier
