// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tiles/pieces.hpp>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace terrane::tiles {

namespace {

Error bad_piece(std::string sentence) {
    return {ErrorCode::bad_index, std::move(sentence), ""};
}

} // namespace

void PieceJoiner::ShortLists::set(std::uint32_t id, std::span<const std::uint32_t> list) {
    first[id] = list[0];
    if (list.size() > 1) longer[id].assign(list.begin(), list.end());
}

IndexLists<std::uint32_t> PieceJoiner::ShortLists::lists() && {
    IndexLists<std::uint32_t> all;
    all.offsets.reserve(first.size() + 1);
    all.values.reserve(first.size());
    for (std::uint32_t id = 0; id < first.size(); ++id) {
        const auto found = longer.empty() ? longer.end() : longer.find(id);
        if (found == longer.end())
            all.values.push_back(first[id]);
        else
            all.values.insert(all.values.end(), found->second.begin(), found->second.end());
        all.close();
    }
    release(first);
    return all;
}

PieceJoiner::PieceJoiner(std::size_t vertices, std::size_t triangles) :
    has_vertex_(vertices, false), has_triangle_(triangles, false) {
    mesh_.vertices.resize(vertices);
    mesh_.triangles.resize(triangles);
    for (ShortLists* lists : {&surfaces_, &regions_, &parents_}) lists->first.resize(triangles);
}

Status PieceJoiner::add(const TilePiece& piece) {
    const Mesh& m = piece.mesh;
    const std::size_t count = m.triangles.size();
    if (piece.vertex_ids.size() != m.vertices.size() || piece.triangle_ids.size() != count ||
        m.surfaces_of.size() != count || m.regions_of.size() != count ||
        m.parents_of.size() != count ||
        (!piece.volumes_of_sides.empty() && piece.volumes_of_sides.size() != count))
        return bad_piece("the lists of a piece do not fit its vertices and triangles");
    if (mesh_.surfaces.empty()) mesh_.surfaces = m.surfaces;
    if (mesh_.surfaces != m.surfaces) return bad_piece("two pieces name different surfaces");
    for (std::size_t v = 0; v < m.vertices.size(); ++v) {
        const std::uint32_t id = piece.vertex_ids[v];
        if (id >= has_vertex_.size()) return bad_piece(fmt::format("there is no vertex {}", id));
        if (has_vertex_[id] && mesh_.vertices[id] != m.vertices[v])
            return bad_piece(fmt::format("vertex {} has different places in two pieces", id));
        has_vertex_[id] = true;
        mesh_.vertices[id] = m.vertices[v];
    }
    with_volumes_ += piece.volumes_of_sides.size();
    if (with_volumes_ > 0) volumes_of_sides_.resize(has_triangle_.size());
    for (std::size_t t = 0; t < count; ++t) {
        const std::uint32_t id = piece.triangle_ids[t];
        if (id >= has_triangle_.size() || has_triangle_[id])
            return bad_piece(fmt::format("triangle {} is in two pieces, or in none", id));
        has_triangle_[id] = true;
        for (unsigned i = 0; i < 3; ++i) {
            const std::uint32_t v = m.triangles[t][i];
            if (v >= m.vertices.size())
                return bad_piece(fmt::format("triangle {} names vertex {} of its piece, which has "
                                             "{}",
                                             id, v, m.vertices.size()));
            mesh_.triangles[id][i] = piece.vertex_ids[v];
        }
        if (m.surfaces_of[t].empty() || m.regions_of[t].empty() || m.parents_of[t].empty())
            return bad_piece(fmt::format("triangle {} has no surface", id));
        surfaces_.set(id, m.surfaces_of[t]);
        regions_.set(id, m.regions_of[t]);
        parents_.set(id, m.parents_of[t]);
        if (!piece.volumes_of_sides.empty()) volumes_of_sides_[id] = piece.volumes_of_sides[t];
    }
    return Done{};
}

Result<Mesh> PieceJoiner::finish() && {
    for (const auto* has : {&has_vertex_, &has_triangle_}) {
        const auto missing = std::find(has->begin(), has->end(), false);
        if (missing != has->end())
            return bad_piece(fmt::format("no piece has {} {}",
                                         has == &has_vertex_ ? "vertex" : "triangle",
                                         missing - has->begin()));
    }
    if (with_volumes_ != 0 && with_volumes_ != has_triangle_.size())
        return bad_piece(
            "some pieces tell the volumes on the sides of their triangles, and others do not");
    mesh_.surfaces_of = std::move(surfaces_).lists();
    mesh_.regions_of = std::move(regions_).lists();
    mesh_.parents_of = std::move(parents_).lists();
    return std::move(mesh_);
}

} // namespace terrane::tiles
