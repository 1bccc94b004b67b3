// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The writers of output.hpp for formats that hold surfaces only, but for VTP.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <terrane/algorithms/verify/detail/measure.hpp>
#include <terrane/algorithms/verify/detail/output.hpp>

namespace terrane::verifier {

namespace {

/// Makes a name fit for formats without quotes.
void make_plain(std::string& name) {
    for (char& c : name)
        if (static_cast<unsigned char>(c) <= 32 || c == 127 || c == '#' || c == '\\') c = '_';
}

/// Writes numbers with blanks before them, and ends the line.
template <class Numbers>
void end_line(Comparison& out, const Numbers& numbers, std::uint64_t first = 0) {
    for (const std::uint32_t n : numbers) out << " " << n + first;
    out << "\n";
}

/// Returns the triangles of each surface, in order.
std::vector<std::vector<std::uint32_t>> triangles_of_surfaces(const ExpectedMesh& expected) {
    std::vector<std::vector<std::uint32_t>> triangles(expected.surfaces.size());
    for (std::uint32_t t = 0; t < expected.mesh.surfaces_of.size(); ++t)
        for (const std::uint32_t surface : expected.mesh.surfaces_of[t])
            triangles[surface].push_back(t);
    return triangles;
}

/// Returns the normal of a triangle: of length 1 but for rounding; 0 for a triangle without area.
std::array<float, 3> normal_of(const WrittenMesh& mesh, const Triangle& triangle) {
    const Point3 &a = mesh.vertices[triangle[0]], &b = mesh.vertices[triangle[1]],
                 &c = mesh.vertices[triangle[2]];
    const Point3 n = cross_product(vector_to(b, a), vector_to(c, a));
    const double length = length_of(n);
    if (!std::isfinite(length) || length == 0) return {};
    return {static_cast<float>(n.x / length), static_cast<float>(n.y / length),
            static_cast<float>(n.z / length)};
}

} // namespace

void write_obj(Comparison& out, const ExpectedMesh& expected) {
    const WrittenMesh& mesh = expected.mesh;
    for (const Point3& vertex : mesh.vertices) out << "v " << vertex << "\n";
    const auto names = distinct_names(expected.surfaces, make_plain);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto surfaces = mesh.surfaces_of[t];
        if (t == 0 || !std::ranges::equal(surfaces, mesh.surfaces_of[t - 1])) {
            out << "g";
            for (const std::uint32_t s : surfaces) out << " " << names[s];
            out << "\n";
        }
        out << "f";
        end_line(out, mesh.triangles[t], 1);
    }
}

void write_off(Comparison& out, const ExpectedMesh& expected) {
    const WrittenMesh& mesh = expected.mesh;
    out << "OFF\n" << mesh.vertices.size() << " " << mesh.triangles.size() << " 0\n";
    for (const Point3& vertex : mesh.vertices) out << vertex << "\n";
    for (const Triangle& triangle : mesh.triangles) {
        out << "3";
        end_line(out, triangle);
    }
}

void write_stl_ascii(Comparison& out, const ExpectedMesh& expected) {
    const WrittenMesh& mesh = expected.mesh;
    const auto names = distinct_names(expected.surfaces, make_plain);
    const auto triangles = triangles_of_surfaces(expected);
    for (std::size_t s = 0; s < triangles.size(); ++s) {
        if (triangles[s].empty()) continue;
        out << "solid " << names[s] << "\n";
        for (const std::uint32_t t : triangles[s]) {
            const auto [x, y, z] = normal_of(mesh, mesh.triangles[t]);
            out << "facet normal " << x << " " << y << " " << z << "\nouter loop\n";
            for (const std::uint32_t corner : mesh.triangles[t])
                out << "vertex " << mesh.vertices[corner] << "\n";
            out << "endloop\nendfacet\n";
        }
        out << "endsolid " << names[s] << "\n";
    }
}

void write_stl(Comparison& out, const ExpectedMesh& expected) {
    const WrittenMesh& mesh = expected.mesh;
    std::string header = "Terrane: coordinates rounded to float32";
    header.resize(80, ' ');
    out << header;
    out.binary(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const Triangle& triangle : mesh.triangles) {
        for (const float n : normal_of(mesh, triangle)) out.binary(n);
        for (const std::uint32_t corner : triangle) {
            const Point3& p = mesh.vertices[corner];
            for (const double c : {p.x, p.y, p.z}) out.binary(static_cast<float>(c));
        }
        out.binary(std::uint16_t(0));
    }
}

void write_ply(Comparison& out, const ExpectedMesh& expected) {
    const WrittenMesh& mesh = expected.mesh;
    out << "ply\nformat binary_little_endian 1.0\n";
    for (const SurfaceInfo& surface : expected.surfaces) {
        std::string name = surface.name;
        put_on_one_line(name);
        name.erase(0, name.find_first_not_of(' '));
        name.erase(name.find_last_not_of(' ') + 1);
        out << "comment terrane surface " << name_of(surface.role) << " " << name << "\n";
    }
    out << "element vertex " << mesh.vertices.size()
        << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
        << mesh.triangles.size()
        << "\nproperty list uchar int vertex_indices\nproperty int surface\n"
           "property list uint int surfaces\nend_header\n";
    for (const Point3& p : mesh.vertices)
        for (const double c : {p.x, p.y, p.z}) out.binary(c);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto surfaces = mesh.surfaces_of[t];
        out.binary(std::uint8_t(3));
        for (const std::uint32_t corner : mesh.triangles[t]) out.binary(corner);
        out.binary(surfaces[0]);
        out.binary(static_cast<std::uint32_t>(surfaces.size()));
        for (const std::uint32_t surface : surfaces) out.binary(surface);
    }
}

// --- GOCAD TSurf --------------------------------------------------------------------------------

namespace {

void write_gocad_header(Comparison& out, const SurfaceInfo& surface) {
    std::string name = surface.name;
    put_on_one_line(name);
    if (name.empty() || name.front() == ' ' || name.back() == ' ' ||
        name.find_first_of("\"{}") != std::string::npos)
        name = "\"" + name + "\"";
    out << "GOCAD TSurf 1\nHEADER {\nname: " << name
        << "\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\n"
           "ZPOSITIVE Elevation\nEND_ORIGINAL_COORDINATE_SYSTEM\n";
    const std::string_view type = surface.role == Role::horizon ? "top" : name_of(surface.role);
    if (surface.role != Role::unknown) out << "GEOLOGICAL_TYPE " << type << "\n";
}

/// Writes the triangles of a surface with their vertices, in the order of the mesh.
void write_tface(Comparison& out, const WrittenMesh& mesh,
                 const std::vector<std::uint32_t>& triangles) {
    std::map<std::uint32_t, std::uint32_t> number_of; // vertex: its number in the file
    for (const std::uint32_t t : triangles)
        for (const std::uint32_t corner : mesh.triangles[t]) number_of[corner] = 0;
    out << "TFACE\n";
    std::uint32_t next = 0;
    for (auto& [vertex, number] : number_of) {
        number = ++next;
        out << "VRTX " << number << " " << mesh.vertices[vertex] << "\n";
    }
    for (const std::uint32_t t : triangles) {
        const auto& [a, b, c] = mesh.triangles[t];
        out << "TRGL";
        end_line(out, std::array{number_of[a], number_of[b], number_of[c]});
    }
    out << "END\n";
}

} // namespace

void write_gocad(Comparison& out, const ExpectedMesh& expected) {
    const auto triangles = triangles_of_surfaces(expected);
    for (std::size_t s = 0; s < triangles.size(); ++s) {
        write_gocad_header(out, expected.surfaces[s]);
        write_tface(out, expected.mesh, triangles[s]);
    }
}

} // namespace terrane::verifier
