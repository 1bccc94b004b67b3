// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/pflotran.hpp>

#include <utility>

#include <fmt/format.h>

#include <terrane/io/meshes/detail/side_sets.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

/// Appends the type of a cell or face, and its vertices.
template <class Corners>
void append_element_line(std::string& out, const Corners& corners) {
    out += 'T'; // of a tetrahedron and of a triangle
    for (const auto v : corners) {
        out += ' ';
        append_number(out, std::uint64_t(v) + 1);
    }
    out += '\n';
}

std::string grid_text(const TetrahedralMesh& mesh) {
    auto out = fmt::format("{} {}\n", mesh.tetrahedra.size(), mesh.vertices.size());
    for (const auto& corners : mesh.tetrahedra) append_element_line(out, corners);
    for (const auto& vertex : mesh.vertices) {
        append_point(out, vertex);
        out += '\n';
    }
    return out;
}

} // namespace

SeveralFiles to_pflotran(const TetrahedralMesh& mesh, std::string_view stem,
                         std::span<const std::string> block_names) {
    const auto parts = named_parts(mesh, block_names);
    SeveralFiles all{{"", grid_text(mesh)}};
    for (const auto& block : parts.blocks) {
        std::string cells;
        for (const auto t : block.tetrahedra) {
            append_number(cells, std::uint64_t(t) + 1);
            cells += '\n';
        }
        all.push_back({fmt::format("{}_{}.txt", stem, block.name), std::move(cells)});
    }
    for (const SideSet& set : parts.side_sets) {
        auto faces = fmt::format("{}\n", set.sides.size());
        for (const auto& side : set.sides)
            append_element_line(faces, outward_nodes(mesh, nullptr, side));
        all.push_back({fmt::format("{}_{}.ss", stem, set.name), std::move(faces)});
    }
    return all;
}

} // namespace terrane
