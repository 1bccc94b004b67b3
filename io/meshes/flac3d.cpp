// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/flac3d.hpp>

#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <terrane/io/meshes/detail/face_groups.hpp>
#include <terrane/io/meshes/detail/side_sets.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

template <class Cells>
void append_flac3d_cells(std::string& out, std::string_view type, const Cells& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        out += type;
        append_number(out, std::uint64_t(i + 1));
        for (const auto v : cells[i]) {
            out += ' ';
            append_number(out, std::uint64_t(v) + 1);
        }
        out += '\n';
    }
}

void append_flac3d_group(std::string& out, std::string_view keyword, const std::string& name,
                         std::size_t slot, const std::vector<std::uint32_t>& members) {
    constexpr std::size_t most_in_line = 10;
    out += fmt::format("{} \"{}\" SLOT {}\n", keyword, name, slot);
    for (std::size_t i = 0; i < members.size(); ++i) {
        append_number(out, std::uint64_t(members[i]) + 1);
        out += i + 1 == members.size() || (i + 1) % most_in_line == 0 ? '\n' : ' ';
    }
}

} // namespace

std::string to_flac3d(const TetrahedralMesh& mesh, std::span<const std::string> block_names) {
    const auto parts = named_parts(mesh, block_names);
    std::string out = "* FLAC3D grid by Terrane\n* GRIDPOINTS\n";
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        out += "G ";
        append_number(out, std::uint64_t(v + 1));
        out += ' ';
        append_point(out, mesh.vertices[v]);
        out += '\n';
    }
    out += "* ZONES\n";
    append_flac3d_cells(out, "Z T4 ", mesh.tetrahedra);
    out += "* ZONE GROUPS\n";
    for (const ElementBlock& block : parts.blocks)
        append_flac3d_group(out, "ZGROUP", block.name, 1, block.tetrahedra);
    out += "* FACES\n";
    append_flac3d_cells(out, "F T3 ", mesh.faces);
    out += "* FACE GROUPS\n";
    std::size_t slot = 0;
    for (const FaceGroup& group : face_groups(mesh, parts))
        append_flac3d_group(out, "FGROUP", group.name, ++slot, group.faces);
    return out;
}

} // namespace terrane
