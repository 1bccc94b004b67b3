// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/gocad/detail/write.hpp>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/io/gocad/gocad.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

namespace detail {

std::string in_gocad_quotes(std::string_view name) {
    const auto text = one_line(name);
    const bool plain = !text.empty() && trimmed(text).size() == text.size() &&
                       text.find_first_of("\"{}") == std::string::npos;
    return plain ? text : '"' + text + '"';
}

void append_gocad_header(std::string& out, std::string_view type, std::string_view name,
                         std::string_view in_model, std::string_view unit) {
    out += "GOCAD ";
    out += type;
    out += " 1\nHEADER {\nname: ";
    out += in_gocad_quotes(name);
    if (!in_model.empty()) out += "\nname_in_model_list: " + in_gocad_quotes(in_model);
    out += "\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\n";
    if (!unit.empty()) out += fmt::format("AXIS_UNIT \"{0}\" \"{0}\" \"{0}\"\n", unit);
    out += "ZPOSITIVE Elevation\nEND_ORIGINAL_COORDINATE_SYSTEM\n";
}

void append_gocad_role(std::string& out, Role role) {
    switch (role) {
    case Role::horizon:
        out += "GEOLOGICAL_TYPE top\n";
        break;
    case Role::fault:
        out += "GEOLOGICAL_TYPE fault\n";
        break;
    case Role::boundary:
        out += "GEOLOGICAL_TYPE boundary\n";
        break;
    case Role::unknown:
        break;
    }
}

void append_gocad_vertex(std::string& out, std::uint64_t id, const Point3& place) {
    out += "VRTX ";
    append_number(out, id);
    out += ' ';
    append_point(out, place);
    out += '\n';
}

} // namespace detail

using namespace detail;

namespace {

void append_tface(std::string& out, const std::vector<Point3>& vertices,
                  const std::vector<Triangle>& triangles) {
    out += "TFACE\n";
    for (std::size_t i = 0; i < vertices.size(); ++i) append_gocad_vertex(out, i + 1, vertices[i]);
    for (const auto& triangle : triangles) {
        out += "TRGL";
        for (const auto vertex : triangle) {
            out += ' ';
            append_number(out, std::uint64_t(vertex) + 1);
        }
        out += '\n';
    }
    out += "END\n";
}

} // namespace

std::string to_gocad(const Mesh& mesh) {
    std::vector<std::vector<Triangle>> triangles_of(mesh.surfaces.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const auto surface : mesh.surfaces_of[i])
            triangles_of[surface].push_back(mesh.triangles[i]);
    std::string out;
    Submesh subset(mesh.vertices);
    for (std::size_t s = 0; s < mesh.surfaces.size(); ++s) {
        const auto vertices = subset.cut(triangles_of[s]);
        append_gocad_header(out, "TSurf", mesh.surfaces[s].name);
        append_gocad_role(out, mesh.surfaces[s].role);
        append_tface(out, vertices, triangles_of[s]);
    }
    return out;
}

} // namespace terrane
