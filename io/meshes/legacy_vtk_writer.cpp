// SPDX-License-Identifier: LGPL-3.0-or-later
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <terrane/io/meshes/legacy_vtk.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

/// Appends an array of the whole file.
void append_field(std::string& out, std::string_view name, std::string_view type,
                  const std::vector<std::uint64_t>& values) {
    out += fmt::format("{} 1 {} {}\n", name, values.size(), type);
    for (std::size_t i = 0; i < values.size(); ++i) {
        append_number(out, values[i]);
        out += i + 1 == values.size() || i % 20 == 19 ? '\n' : ' ';
    }
    if (values.empty()) out += '\n';
}

void append_text(std::vector<std::uint64_t>& codes, std::string_view text) {
    for (const char c : text)
        if (c != '\0') codes.push_back(static_cast<unsigned char>(c));
    codes.push_back(0);
}

void append_fields(std::string& out, const Mesh& mesh) {
    std::vector<std::uint64_t> names, roles, offsets{0}, lists;
    for (const SurfaceInfo& surface : mesh.surfaces) {
        append_text(names, surface.name);
        append_text(roles, role_names[static_cast<std::size_t>(surface.role)]);
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const auto s : mesh.surfaces_of[t]) lists.push_back(s);
        offsets.push_back(lists.size());
    }
    out += "FIELD FieldData 4\n";
    append_field(out, "surface_name", "unsigned_char", names);
    append_field(out, "surface_role", "unsigned_char", roles);
    append_field(out, "surfaces_offset", "int", offsets);
    append_field(out, "surfaces", "int", lists);
}

void append_triangles(std::string& out, const Mesh& mesh) {
    out += fmt::format("POLYGONS {} {}\n", mesh.triangles.size(), 4 * mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) out += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
}

} // namespace

std::string to_vtk(const Mesh& mesh) {
    std::string out = "# vtk DataFile Version 3.0\nterrane\nASCII\nDATASET POLYDATA\n";
    append_fields(out, mesh);
    out += fmt::format("POINTS {} double\n", mesh.vertices.size());
    for (const Point3& p : mesh.vertices) {
        append_point(out, p);
        out += '\n';
    }
    append_triangles(out, mesh);
    out += fmt::format("CELL_DATA {}\nSCALARS surface int 1\nLOOKUP_TABLE default\n",
                       mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        out += mesh.surfaces_of[t].empty() ? "-1\n" : fmt::format("{}\n", mesh.surfaces_of[t][0]);
    out += "SCALARS surface_count int 1\nLOOKUP_TABLE default\n";
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        out += fmt::format("{}\n", mesh.surfaces_of[t].size());
    return out;
}

} // namespace terrane
