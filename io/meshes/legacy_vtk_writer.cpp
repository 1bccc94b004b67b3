// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <terrane/io/meshes/legacy_vtk.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/values.hpp>

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

void append_triangles(std::string& out, const Mesh& mesh) {
    out += fmt::format("POLYGONS {} {}\n", mesh.triangles.size(), 4 * mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) out += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
}

/// Returns a name as one word, as VTK encodes it.
std::string encoded(std::string_view name) {
    std::string word;
    for (const char c : name) {
        const auto code = static_cast<unsigned char>(c);
        const bool plain = code > ' ' && code < 127 && c != '%' && c != '"';
        word += plain ? std::string(1, c) : fmt::format("%{:02X}", code);
    }
    return word;
}

std::string_view legacy_name(NumberType type) {
    constexpr std::array<std::string_view, 10> names{
        "double",         "float", "char",         "unsigned_char", "short",
        "unsigned_short", "int",   "unsigned_int", "vtktypeint64",  "vtktypeuint64"};
    return names[static_cast<std::size_t>(type)];
}

/// Appends the values on vertices or triangles, as a field.
void append_values(std::string& out, std::span<const ValueArray> arrays, bool on_triangles) {
    const auto count = std::ranges::count(arrays, on_triangles, &ValueArray::on_triangles);
    if (count == 0) return;
    out += fmt::format("FIELD FieldData {}\n", count);
    for (const ValueArray& array : arrays) {
        if (array.on_triangles != on_triangles) continue;
        out += fmt::format("{} {} {} {}\n", encoded(array.name), array.components, array.size(),
                           legacy_name(array.type));
        for (std::size_t i = 0; i < array.size() * array.components; ++i) {
            append_value(out, array, i);
            out += i % array.components + 1 == array.components ? '\n' : ' ';
        }
    }
}

/// Returns the lists of what values are besides their numbers: name, unit, and the number for none.
std::string described_values(std::span<const ValueArray> arrays) {
    std::vector<std::uint64_t> names, units;
    std::string no_data;
    for (const bool on_triangles : {false, true}) // as they will be written
        for (const ValueArray& array : arrays) {
            if (array.on_triangles != on_triangles) continue;
            append_text(names, array.name);
            append_text(units, array.unit);
            append_number(no_data, array.no_data.value_or(std::nan("")));
            no_data += '\n';
        }
    std::string out;
    append_field(out, "value_name", "unsigned_char", names);
    append_field(out, "value_unit", "unsigned_char", units);
    return out + fmt::format("value_no_data 1 {} double\n", arrays.size()) + no_data;
}

void append_fields(std::string& out, const Mesh& mesh, std::span<const ValueArray> arrays) {
    std::vector<std::uint64_t> names, roles, offsets{0}, lists;
    for (const SurfaceInfo& surface : mesh.surfaces) {
        append_text(names, surface.name);
        append_text(roles, role_names[static_cast<std::size_t>(surface.role)]);
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const auto s : mesh.surfaces_of[t]) lists.push_back(s);
        offsets.push_back(lists.size());
    }
    out += fmt::format("FIELD FieldData {}\n", arrays.empty() ? 4 : 7);
    append_field(out, "surface_name", "unsigned_char", names);
    append_field(out, "surface_role", "unsigned_char", roles);
    append_field(out, "surfaces_offset", "int", offsets);
    append_field(out, "surfaces", "int", lists);
    if (!arrays.empty()) out += described_values(arrays);
}

} // namespace

std::string to_vtk(const Mesh& mesh, std::span<const SurfaceValues> values) {
    const auto arrays =
        joined_values(mesh.vertices.size(), mesh.triangles, mesh.surfaces_of, values);
    std::string out = "# vtk DataFile Version 3.0\nterrane\nASCII\nDATASET POLYDATA\n";
    append_fields(out, mesh, arrays);
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
    append_values(out, arrays, true);
    if (std::ranges::count(arrays, false, &ValueArray::on_triangles) > 0)
        out += fmt::format("POINT_DATA {}\n", mesh.vertices.size());
    append_values(out, arrays, false);
    return out;
}

} // namespace terrane
