// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The sections of MSH 4.1 in text.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetrahedra/split_nodes.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane::detail {

/// Types of elements in MSH.
inline constexpr int msh_line = 1, msh_triangle = 2, msh_tetrahedron = 4, msh_triangle_of_6 = 9,
                     msh_tetrahedron_of_10 = 11;

/// A discrete entity of Gmsh and its cells.
struct MshEntity {
    int dimension = 2;
    std::size_t tag = 0;
    std::vector<std::size_t> physical; ///< tags, ascending
    std::vector<std::size_t> cells;    ///< indices, ascending
    std::size_t first_element = 1;     ///< number of the element that is cell 0
};

/// A physical group and its name.
struct MshName {
    int dimension = 2;
    std::size_t tag = 0;
    std::string name; ///< fit for double quotes
};

/// The two entities on the sides of a cut, and their nodes.
struct MshLink {
    std::size_t front = 0, back = 0; ///< tags of the entities
    std::vector<NodePair> pairs;     ///< {front, back}, only where they differ; sorted, unique
};

/// Writes the sections of one file, in the order of the calls.
class MshWriter {
public:
    explicit MshWriter(const std::vector<Point3>& vertices) : vertices_(vertices) {
        out_ = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
        out_.reserve(vertices.size() * 96);
    }

    void names(std::span<const MshName> names) {
        out_ += fmt::format("$PhysicalNames\n{}\n", names.size());
        for (const auto& n : names)
            out_ += fmt::format("{} {} \"{}\"\n", n.dimension, n.tag, n.name);
        out_ += "$EndPhysicalNames\n";
    }

    template <class Cell>
    void entities(std::span<const MshEntity> entities, const std::vector<Cell>& cells) {
        for (const auto& entity : entities) {
            append_number(out_, std::uint64_t(entity.tag));
            append_box(entity, cells);
            out_ += fmt::format(" {}", entity.physical.size());
            for (const auto tag : entity.physical) out_ += fmt::format(" {}", tag);
            out_ += " 0\n"; // no bounding entities are stated
        }
    }

    /// Writes all nodes in one block, which belongs to the given entity.
    void nodes(const MshEntity& entity) {
        const auto count = vertices_.size();
        out_ += fmt::format("$Nodes\n1 {} 1 {}\n{} {} 0 {}\n", count, count, entity.dimension,
                            entity.tag, count);
        for (std::size_t v = 0; v < count; ++v) {
            append_number(out_, std::uint64_t(v + 1));
            out_ += '\n';
        }
        for (const auto& vertex : vertices_) {
            append_point(out_, vertex);
            out_ += '\n';
        }
        out_ += "$EndNodes\n";
    }

    template <class Cell>
    void elements(std::span<const MshEntity> entities, const std::vector<Cell>& cells, int type) {
        for (const auto& entity : entities) {
            text(fmt::format("{} {} {} {}", entity.dimension, entity.tag, type,
                             entity.cells.size()));
            for (const auto cell : entity.cells) {
                append_number(out_, std::uint64_t(entity.first_element + cell));
                for (const auto vertex : cells[cell]) {
                    out_ += ' ';
                    append_number(out_, std::uint64_t(vertex) + 1);
                }
                out_ += '\n';
            }
        }
    }

    /// Writes, for each link, the pairs of nodes of its two entities that are at the same point.
    void periodic(std::span<const MshLink> links) {
        if (links.empty()) return;
        text(fmt::format("$Periodic\n{}", links.size()));
        for (const auto& link : links) {
            text(fmt::format("2 {} {}\n0\n{}", link.back, link.front, link.pairs.size()));
            for (const auto& [front, back] : link.pairs)
                text(fmt::format("{} {}", back + 1, front + 1));
        }
        text("$EndPeriodic");
    }

    void text(std::string_view line) { out_.append(line).append("\n"); }
    std::string take() { return std::move(out_); }

private:
    template <class Cell>
    void append_box(const MshEntity& entity, const std::vector<Cell>& cells) {
        auto low = vertices_[cells[entity.cells[0]][0]];
        auto high = low;
        for (const auto cell : entity.cells)
            for (const auto vertex : cells[cell]) {
                const auto& p = vertices_[vertex];
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            }
        for (const auto& corner : {low, high}) {
            out_ += ' ';
            append_point(out_, corner);
        }
    }

    std::string out_;
    const std::vector<Point3>& vertices_;
};

} // namespace terrane::detail
