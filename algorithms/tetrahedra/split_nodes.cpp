// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/split_nodes.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/diffusion.hpp>
#include <terrane/algorithms/mesh/face_sides.hpp>

namespace terrane {
namespace {

class Split {
public:
    Split(const TetrahedralMesh& mesh, std::span<const std::uint32_t> surfaces) :
        mesh_(mesh), is_split_surface_(mesh.surfaces.size()), on_split_(mesh.vertices.size()),
        sets_(4 * mesh.tetrahedra.size()) {
        for (const std::uint32_t s : surfaces) is_split_surface_[s] = true;
    }

    Result<TetrahedralMesh> operator()() {
        mark();
        join();
        if (Status named = name_nodes(); !named) return named.error();
        return rebuilt();
    }

private:
    /// Returns the element of the sets that stands for a corner of a tetrahedron.
    static std::uint32_t element(std::uint32_t tetrahedron, std::uint32_t corner) {
        return 4 * tetrahedron + corner;
    }

    [[nodiscard]] bool is_split(std::size_t face) const {
        const auto of = mesh_.surfaces_of[face];
        return sides_[face].front.exists() && sides_[face].back.exists() &&
               std::any_of(of.begin(), of.end(),
                           [&](std::uint32_t s) { return is_split_surface_[s]; });
    }

    /// Collects the split faces and marks their vertices.
    void mark() {
        sides_ = sides_of_faces(mesh_);
        for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
            if (!is_split(f)) continue;
            Triangle key = mesh_.faces[f];
            for (const std::uint32_t v : key) on_split_[v] = true;
            std::sort(key.begin(), key.end());
            split_.push_back(key);
        }
        std::sort(split_.begin(), split_.end());
    }

    /// Joins the corners of the tetrahedra on both sides of each face that is not split, at its
    /// marked vertices.
    void join() {
        std::vector<CellFacet<3>> facets;
        for (std::uint32_t t = 0; t < mesh_.tetrahedra.size(); ++t)
            for (const auto& side : corners_of_side) {
                Triangle key{};
                for (std::size_t i = 0; i < 3; ++i) key[i] = mesh_.tetrahedra[t][side[i]];
                if (std::none_of(key.begin(), key.end(),
                                 [&](std::uint32_t v) { return on_split_[v]; }))
                    continue;
                std::sort(key.begin(), key.end());
                facets.push_back({key, t});
            }
        std::sort(facets.begin(), facets.end());
        for (std::size_t i = 0; i + 1 < facets.size(); ++i) {
            const auto& [corners, cell] = facets[i];
            if (facets[i + 1].corners != corners) continue;
            if (std::binary_search(split_.begin(), split_.end(), corners)) continue;
            for (const std::uint32_t v : corners)
                if (on_split_[v])
                    sets_.join(element(cell, corner_at(cell, v)),
                               element(facets[i + 1].cell, corner_at(facets[i + 1].cell, v)));
        }
    }

    [[nodiscard]] std::uint32_t corner_at(std::uint32_t tetrahedron, std::uint32_t vertex) const {
        const auto& corners = mesh_.tetrahedra[tetrahedron];
        return static_cast<std::uint32_t>(std::find(corners.begin(), corners.end(), vertex) -
                                          corners.begin());
    }

    /// Numbers the nodes. The root of a set is its lowest element, which belongs to its lowest
    /// tetrahedron.
    Status name_nodes() {
        std::vector<std::array<std::uint32_t, 2>> heads; // {vertex, lowest element}
        for (std::uint32_t t = 0; t < mesh_.tetrahedra.size(); ++t)
            for (std::uint32_t k = 0; k < 4; ++k)
                if (on_split_[mesh_.tetrahedra[t][k]] && sets_.find(element(t, k)) == element(t, k))
                    heads.push_back({mesh_.tetrahedra[t][k], element(t, k)});
        std::sort(heads.begin(), heads.end());
        if (mesh_.vertices.size() + heads.size() >= no_index)
            return Error{ErrorCode::unsupported, "too many nodes to split", ""};
        node_of_.assign(4 * mesh_.tetrahedra.size(), no_index);
        for (std::size_t i = 0; i < heads.size(); ++i) {
            const auto [vertex, head] = heads[i];
            const bool first = i == 0 || heads[i - 1][0] != vertex;
            if (!first) copies_.push_back(vertex);
            node_of_[head] =
                first ? vertex
                      : static_cast<std::uint32_t>(mesh_.vertices.size() + copies_.size() - 1);
        }
        return Done{};
    }

    [[nodiscard]] std::uint32_t node(std::uint32_t tetrahedron, std::uint32_t corner) {
        const std::uint32_t vertex = mesh_.tetrahedra[tetrahedron][corner];
        return on_split_[vertex] ? node_of_[sets_.find(element(tetrahedron, corner))] : vertex;
    }

    /// Returns the nodes of a face that the tetrahedron on this side has.
    [[nodiscard]] Triangle seen_from(const TetrahedronSide& side, Triangle face) {
        for (std::uint32_t& v : face) v = node(side.tetrahedron, corner_at(side.tetrahedron, v));
        return face;
    }

    TetrahedralMesh rebuilt() {
        TetrahedralMesh out = mesh_;
        for (const std::uint32_t vertex : copies_) out.vertices.push_back(mesh_.vertices[vertex]);
        for (std::uint32_t t = 0; t < out.tetrahedra.size(); ++t)
            for (std::uint32_t k = 0; k < 4; ++k) out.tetrahedra[t][k] = node(t, k);
        for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
            const auto& [front, back] = sides_[f];
            if (!front.exists() && !back.exists()) continue;
            out.faces[f] = seen_from(front.exists() ? front : back, mesh_.faces[f]);
            if (!is_split(f)) continue;
            const Triangle behind = seen_from(back, mesh_.faces[f]);
            if (behind == out.faces[f]) continue;
            out.twins.push_back({f, static_cast<std::uint32_t>(out.faces.size())});
            out.faces.push_back(behind);
            out.face_triangle.push_back(mesh_.face_triangle[f]);
            out.surfaces_of.push_back(mesh_.surfaces_of[f]);
        }
        return out;
    }

    const TetrahedralMesh& mesh_;
    std::vector<bool> is_split_surface_; ///< per surface
    std::vector<bool> on_split_;         ///< per vertex: a corner of a split face
    std::vector<FaceSides> sides_;       ///< per face
    std::vector<Triangle> split_;        ///< corners of split faces, ascending; sorted
    DisjointSets sets_;                  ///< corners of tetrahedra that share a node
    std::vector<std::uint32_t> node_of_; ///< per set, by its lowest element
    std::vector<std::uint32_t> copies_;  ///< per added node: the vertex that it is a copy of
};

} // namespace

Result<TetrahedralMesh> split_nodes(const TetrahedralMesh& mesh,
                                    std::span<const std::uint32_t> surfaces) {
    return guarded("to split nodes", "split", [&]() -> Result<TetrahedralMesh> {
        constexpr std::size_t most = std::size_t(1) << 30;
        for (const std::uint32_t s : surfaces)
            if (s >= mesh.surfaces.size())
                return Error{ErrorCode::bad_index, fmt::format("there is no surface {}", s), ""};
        if (!mesh.twins.empty()) return Error{ErrorCode::bad_option, "nodes are split already", ""};
        if (mesh.tetrahedra.size() >= most)
            return Error{ErrorCode::unsupported, "too many tetrahedra to split nodes", ""};
        return Split(mesh, surfaces)();
    });
}

std::vector<std::vector<NodePair>> node_pairs(const TetrahedralMesh& mesh) {
    const StandardArithmetic guard;
    std::vector<std::vector<NodePair>> pairs(mesh.surfaces.size());
    for (const auto& [front, back] : mesh.twins)
        for (std::size_t k = 0; k < 3; ++k) {
            const NodePair pair{mesh.faces[front][k], mesh.faces[back][k]};
            if (pair[0] == pair[1]) continue;
            for (const std::uint32_t s : mesh.surfaces_of[front]) pairs[s].push_back(pair);
        }
    for (auto& list : pairs) sort_unique(list);
    return pairs;
}

} // namespace terrane
