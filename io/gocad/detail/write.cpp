// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/gocad/gocad.hpp>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

std::string in_quotes(std::string_view name) {
    const auto text = one_line(name);
    const bool plain = !text.empty() && trimmed(text).size() == text.size() &&
                       text.find_first_of("\"{}") == std::string::npos;
    return plain ? text : '"' + text + '"';
}

std::string_view feature_of_role(Role role) {
    switch (role) {
    case Role::horizon:
        return "GEOLOGICAL_TYPE top\n";
    case Role::fault:
        return "GEOLOGICAL_TYPE fault\n";
    case Role::boundary:
        return "GEOLOGICAL_TYPE boundary\n";
    case Role::unknown:
        break;
    }
    return "";
}

void append_header(std::string& out, const SurfaceInfo& surface) {
    out += "GOCAD TSurf 1\nHEADER {\nname: ";
    out += in_quotes(surface.name);
    out += "\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\n"
           "ZPOSITIVE Elevation\nEND_ORIGINAL_COORDINATE_SYSTEM\n";
    out += feature_of_role(surface.role);
}

void append_tface(std::string& out, const std::vector<Point3>& vertices,
                  const std::vector<Triangle>& triangles) {
    out += "TFACE\n";
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        out += "VRTX ";
        append_number(out, std::uint64_t(i) + 1);
        out += ' ';
        append_point(out, vertices[i]);
        out += '\n';
    }
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
        append_header(out, mesh.surfaces[s]);
        append_tface(out, vertices, triangles_of[s]);
    }
    return out;
}

} // namespace terrane
