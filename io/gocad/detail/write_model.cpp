// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/gocad/gocad_model.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/io/gocad/detail/write.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

/// Replaces braces, which begin and end a header.
std::string without_braces(std::string_view name) {
    std::string text = terrane::one_line(name);
    std::replace(text.begin(), text.end(), '{', '(');
    std::replace(text.begin(), text.end(), '}', ')');
    return text;
}

std::string_view feature_of(Role role) {
    switch (role) {
    case Role::horizon:
        return "top";
    case Role::fault:
        return "fault";
    case Role::boundary:
        return "boundary";
    case Role::unknown:
        break;
    }
    return "unclassified";
}

Edge edge_of(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

/// A patch in one of its surfaces.
struct ModelFace {
    std::uint32_t surface = 0, patch = 0;
    bool listed = true; ///< in regions: the surface is the first one of the patch
};

class GocadModelWriter {
public:
    GocadModelWriter(const Mesh& mesh, const Volumes& volumes, const Structure& structure,
                     std::string_view unit) :
        mesh_(mesh),
        volumes_(volumes), structure_(structure), unit_(unit),
        labels_(unique_names(mesh.surfaces,
                             [](std::string_view name) { return without_braces(name); })) {
        std::vector<std::vector<ModelFace>> faces(mesh.surfaces.size());
        for (std::uint32_t p = 0; p < structure.patches.size(); ++p) {
            const auto& surfaces = structure.interfaces[structure.patches[p].interface].surfaces;
            for (const std::uint32_t s : surfaces)
                faces[s].push_back({s, p, s == surfaces.front()});
        }
        for (const auto& of_surface : faces)
            faces_.insert(faces_.end(), of_surface.begin(), of_surface.end());
    }

    std::string write(std::string_view name) {
        append_model(without_braces(name));
        for (std::size_t f = 0; f < faces_.size();) {
            std::size_t end = f;
            while (end < faces_.size() && faces_[end].surface == faces_[f].surface) ++end;
            append_surface(f, end);
            f = end;
        }
        return std::move(out_);
    }

private:
    [[nodiscard]] const ModelPatch& patch_of(const ModelFace& face) const {
        return structure_.patches[face.patch];
    }

    /// Returns the volumes in front of a patch and behind it.
    [[nodiscard]] std::array<std::uint32_t, 2> sides_of(const ModelPatch& patch) const {
        return volumes_.of_sides[patch.triangles.front()];
    }

    /// Returns the triangles of a patch, all turned the same way.
    [[nodiscard]] std::vector<Triangle> triangles_of(const ModelPatch& patch) const {
        std::vector<Triangle> triangles;
        for (const std::uint32_t t : patch.triangles) {
            Triangle triangle = mesh_.triangles[t];
            if (volumes_.of_sides[t] != sides_of(patch)) std::swap(triangle[1], triangle[2]);
            triangles.push_back(triangle);
        }
        return triangles;
    }

    void append_model(const std::string& name) {
        append_gocad_header(out_, "Model3d", name, {}, unit_);
        for (std::size_t f = 0; f < faces_.size(); ++f)
            if (f == 0 || faces_[f - 1].surface != faces_[f].surface)
                out_ += fmt::format("TSURF {}\n", in_gocad_quotes(labels_[faces_[f].surface]));
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            const std::uint32_t s = faces_[f].surface;
            out_ += fmt::format("TFACE {}  {} {}\n", f + 1, feature_of(mesh_.surfaces[s].role),
                                in_gocad_quotes(labels_[s]));
            for (const std::uint32_t v : mesh_.triangles[patch_of(faces_[f]).triangles.front()]) {
                out_ += "  ";
                append_point(out_, mesh_.vertices[v]);
                out_ += '\n';
            }
        }
        append_regions();
        out_ += "END\n";
    }

    /// Appends ids, five on each line, and a 0.
    void append_list(const std::vector<std::string>& ids) {
        for (std::size_t i = 0; i < ids.size(); ++i)
            out_ += (i % 5 == 0 ? "  " : " ") + ids[i] + (i % 5 == 4 ? "\n" : " ");
        out_ += ids.size() % 5 == 0 ? "  0\n" : " 0\n";
    }

    void append_regions() {
        std::vector<std::vector<std::string>> sides(structure_.blocks.size());
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            if (!faces_[f].listed) continue;
            const auto [front, back] = sides_of(patch_of(faces_[f]));
            sides[front].push_back(fmt::format("+{}", f + 1));
            sides[back].push_back(fmt::format("-{}", f + 1));
        }
        std::size_t id = faces_.size() + 1;
        std::vector<std::pair<std::string, std::vector<std::string>>> layers;
        for (std::size_t b = 0; b < sides.size(); ++b) {
            if (sides[b].empty()) continue; // too thin for doubles
            const ModelBlock& block = structure_.blocks[b];
            auto name = b == 0 ? "Universe" : without_braces(block.name);
            if (b != 0 && same_ignoring_case(name, "Universe")) name += "_2";
            out_ += fmt::format("REGION {}  {}\n", id, in_gocad_quotes(name));
            append_list(sides[b]);
            const auto same = [&](const auto& layer) { return layer.first == block.unit; };
            auto layer = std::find_if(layers.begin(), layers.end(), same);
            if (!block.unit.empty() && layer == layers.end())
                layer = layers.insert(layer, {block.unit, {}});
            if (!block.unit.empty()) layer->second.push_back(fmt::format("{}", id));
            ++id;
        }
        for (const auto& [unit, regions] : layers) {
            out_ += fmt::format("LAYER {}\n", in_gocad_quotes(without_braces(unit)));
            append_list(regions);
        }
    }

    /// Appends the TSurf with these faces.
    void append_surface(std::size_t first, std::size_t last) {
        const std::uint32_t s = faces_[first].surface;
        append_gocad_header(out_, "TSurf", mesh_.surfaces[s].name, labels_[s], unit_);
        append_gocad_role(out_, mesh_.surfaces[s].role);
        ids_.clear();
        next_id_ = 1;
        std::set<std::uint64_t> stones;
        std::vector<std::pair<std::uint64_t, std::uint64_t>> starts;
        for (std::size_t f = first; f < last; ++f) append_face(faces_[f], stones, starts);
        for (const std::uint64_t id : stones) out_ += fmt::format("BSTONE {}\n", id);
        for (const auto& [from, to] : starts)
            out_ += fmt::format("BORDER {} {} {}\n", next_id_++, from, to);
        out_ += "END\n";
    }

    void append_face(const ModelFace& face, std::set<std::uint64_t>& stones,
                     std::vector<std::pair<std::uint64_t, std::uint64_t>>& starts) {
        const ModelPatch& patch = patch_of(face);
        const auto triangles = triangles_of(patch);
        std::vector<std::uint32_t> used;
        for (const Triangle& t : triangles) used.insert(used.end(), t.begin(), t.end());
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        std::vector<std::uint64_t> id(used.size());
        out_ += "TFACE\n";
        for (std::size_t i = 0; i < used.size(); ++i) {
            id[i] = next_id_++;
            const auto [known, added] = ids_.try_emplace(used[i], id[i]);
            if (added)
                append_gocad_vertex(out_, id[i], mesh_.vertices[used[i]]);
            else
                out_ += fmt::format("ATOM {} {}\n", id[i], known->second);
        }
        const auto id_of = [&](std::uint32_t v) {
            return id[static_cast<std::size_t>(std::lower_bound(used.begin(), used.end(), v) -
                                               used.begin())];
        };
        for (const Triangle& t : triangles)
            out_ += fmt::format("TRGL {} {} {}\n", id_of(t[0]), id_of(t[1]), id_of(t[2]));
        append_borders(patch, triangles, id_of, stones, starts);
    }

    /// Adds where the lines around a face begin, with the face on their left, and its corners.
    template <class IdOf>
    void append_borders(const ModelPatch& patch, const std::vector<Triangle>& triangles,
                        const IdOf& id_of, std::set<std::uint64_t>& stones,
                        std::vector<std::pair<std::uint64_t, std::uint64_t>>& starts) const {
        std::vector<std::pair<Edge, bool>> edges; // whether a triangle runs up along it
        for (const Triangle& t : triangles)
            for (std::size_t k = 0; k < 3; ++k)
                edges.emplace_back(edge_of(t[k], t[(k + 1) % 3]), t[k] < t[(k + 1) % 3]);
        std::sort(edges.begin(), edges.end());
        for (const std::uint32_t l : patch.lines) {
            const auto& line = structure_.lines[l].vertices;
            const Edge edge = edge_of(line[0], line[1]);
            const auto found = std::lower_bound(edges.begin(), edges.end(), std::pair(edge, false));
            const bool once = found != edges.end() && found->first == edge &&
                              (found + 1 == edges.end() || (found + 1)->first != edge);
            if (!once) continue; // the line is within the face
            const bool forward = found->second == (line[0] < line[1]);
            stones.insert(id_of(line.front()));
            stones.insert(id_of(line.back()));
            const std::size_t n = line.size();
            starts.emplace_back(id_of(forward ? line[0] : line[n - 1]),
                                id_of(forward ? line[1] : line[n - 2]));
        }
    }

    const Mesh& mesh_;
    const Volumes& volumes_;
    const Structure& structure_;
    std::string_view unit_;
    std::vector<std::string> labels_; ///< per surface: its name in the model
    std::vector<ModelFace> faces_;    ///< by surface, then by patch; their ids are 1, 2, ...
    std::unordered_map<std::uint32_t, std::uint64_t> ids_; ///< of the vertices of this TSurf
    std::uint64_t next_id_ = 1;
    std::string out_;
};

} // namespace

std::string to_gocad_model(const Mesh& mesh, const Volumes& volumes, const Structure& structure,
                           std::string_view name, std::string_view unit) {
    return GocadModelWriter(mesh, volumes, structure, unit).write(name);
}

} // namespace terrane
