// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/io/gocad/gocad_curves.hpp>
#include <terrane/io/gocad/gocad_model.hpp>

#include <algorithm>
#include <compare>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/io/gocad/detail/write.hpp>

namespace terrane {

using namespace detail;

namespace {

using Chain = std::vector<std::uint32_t>; ///< vertices; the first one again at the end: closed

/// Joins edges, which are different, to chains.
class ChainMaker {
public:
    explicit ChainMaker(const std::vector<Edge>& edges) : taken_(edges.size()) {
        for (std::uint32_t e = 0; e < edges.size(); ++e) {
            ends_.push_back({edges[e][0], edges[e][1], e});
            ends_.push_back({edges[e][1], edges[e][0], e});
        }
        std::sort(ends_.begin(), ends_.end());
    }

    std::vector<Chain> make() {
        for (const bool ends : {true, false}) // closed chains are what is left
            for (const End& end : ends_)
                if (!taken_[end.edge] && (!ends || degree(end.from) != 2)) follow(end);
        return std::move(chains_);
    }

private:
    /// An edge at one of its vertices.
    struct End {
        std::uint32_t from, to, edge;
        friend auto operator<=>(const End&, const End&) = default;
    };

    [[nodiscard]] auto ends_at(std::uint32_t v) const {
        return std::equal_range(ends_.begin(), ends_.end(), End{v, 0, 0},
                                [](const End& a, const End& b) { return a.from < b.from; });
    }
    [[nodiscard]] std::ptrdiff_t degree(std::uint32_t v) const {
        const auto [first, last] = ends_at(v);
        return last - first;
    }

    void follow(End end) {
        Chain chain{end.from};
        for (;;) {
            taken_[end.edge] = true;
            chain.push_back(end.to);
            const auto [first, last] = ends_at(end.to);
            if (last - first != 2) break;
            const auto next =
                std::find_if(first, last, [&](const End& e) { return !taken_[e.edge]; });
            if (next == last) break; // round to the beginning
            end = *next;
        }
        chains_.push_back(std::move(chain));
    }

    std::vector<End> ends_;
    std::vector<bool> taken_; ///< per edge
    std::vector<Chain> chains_;
};

void append_pline(std::string& out, const std::string& name, const Mesh& mesh,
                  const std::vector<Chain>& chains) {
    append_gocad_header(out, "PLine", name);
    std::uint64_t id = 1;
    for (const Chain& chain : chains) {
        const bool closed = chain.size() > 2 && chain.front() == chain.back();
        const std::size_t count = chain.size() - (closed ? 1 : 0);
        out += "ILINE\n";
        for (std::size_t i = 0; i < count; ++i)
            append_gocad_vertex(out, id + i, mesh.vertices[chain[i]]);
        for (std::size_t i = 1; i < count; ++i)
            out += fmt::format("SEG {} {}\n", id + i - 1, id + i);
        if (closed) out += fmt::format("SEG {} {}\n", id + count - 1, id);
        id += count;
    }
    out += "END\n";
}

std::string joined(const std::vector<std::uint32_t>& surfaces,
                   const std::vector<std::string>& labels) {
    std::string text;
    for (const std::uint32_t s : surfaces) text += (text.empty() ? "" : " and ") + labels[s];
    return text;
}

/// Returns the edges that one of the triangles has.
std::vector<Edge> border_of(const std::vector<Triangle>& triangles) {
    std::vector<Edge> edges, border;
    for (const Triangle& t : triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
            if (low != high) edges.push_back({low, high});
        }
    std::sort(edges.begin(), edges.end());
    for (std::size_t e = 0; e < edges.size();) {
        std::size_t end = e;
        while (end < edges.size() && edges[end] == edges[e]) ++end;
        if (end == e + 1) border.push_back(edges[e]);
        e = end;
    }
    return border;
}

/// Returns the intersection edges by the surfaces that meet there.
std::map<std::vector<std::uint32_t>, std::vector<Edge>> intersections_of(const Mesh& mesh) {
    std::map<std::vector<std::uint32_t>, std::vector<Edge>> groups;
    if (mesh.intersection_edges.empty()) return groups;
    group_edges(mesh.triangles, mesh.vertices.size())
        .for_each([&](std::uint32_t low, std::uint32_t high, const auto& sides) {
            const Edge edge{low, high};
            if (!std::binary_search(mesh.intersection_edges.begin(), mesh.intersection_edges.end(),
                                    edge))
                return;
            std::vector<std::uint32_t> surfaces;
            for (const auto& side : sides)
                for (const std::uint32_t s : mesh.surfaces_of[side.triangle]) surfaces.push_back(s);
            std::sort(surfaces.begin(), surfaces.end());
            surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
            groups[surfaces].push_back(edge);
        });
    return groups;
}

Result<std::string> unless_empty(std::string text) {
    if (!text.empty()) return text;
    return Error{ErrorCode::nothing_to_do, "there is no line: no border and no intersection", ""};
}

} // namespace

std::string to_vset(const Mesh& mesh) {
    const auto labels = unique_labels(mesh.surfaces);
    std::vector<std::vector<Triangle>> triangles_of(mesh.surfaces.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const auto s : mesh.surfaces_of[t]) triangles_of[s].push_back(mesh.triangles[t]);
    std::string out;
    Submesh subset(mesh.vertices);
    for (std::size_t s = 0; s < mesh.surfaces.size(); ++s) {
        if (triangles_of[s].empty()) continue;
        const auto vertices = subset.cut(triangles_of[s]);
        append_gocad_header(out, "VSet", labels[s]);
        for (std::size_t i = 0; i < vertices.size(); ++i)
            append_gocad_vertex(out, i + 1, vertices[i]);
        out += "END\n";
    }
    return out;
}

Result<std::string> to_plines(const Mesh& mesh) {
    const auto labels = unique_labels(mesh.surfaces);
    std::vector<std::vector<Triangle>> triangles_of(mesh.surfaces.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const auto s : mesh.surfaces_of[t]) triangles_of[s].push_back(mesh.triangles[t]);
    std::string out;
    for (std::size_t s = 0; s < mesh.surfaces.size(); ++s)
        if (const auto border = border_of(triangles_of[s]); !border.empty())
            append_pline(out, labels[s] + " border", mesh, ChainMaker(border).make());
    for (const auto& [surfaces, edges] : intersections_of(mesh))
        append_pline(out, joined(surfaces, labels), mesh, ChainMaker(edges).make());
    return unless_empty(std::move(out));
}

Result<std::string> lines_to_gocad(const Mesh& mesh, const Structure& structure) {
    return guarded("to write the lines", "lines", [&]() -> Result<std::string> {
        const auto labels = unique_labels(mesh.surfaces);
        std::map<std::pair<LineKind, std::vector<std::uint32_t>>, std::vector<Chain>> groups;
        for (const ModelLine& line : structure.lines)
            groups[{line.kind, line.surfaces}].push_back(line.vertices);
        std::string out;
        for (const auto& [key, chains] : groups)
            append_pline(out,
                         fmt::format("{} of {}", name_of(key.first), joined(key.second, labels)),
                         mesh, chains);
        return unless_empty(std::move(out));
    });
}

} // namespace terrane
