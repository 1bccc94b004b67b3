// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The readers of output.hpp for OBJ, OFF, STL as text and GOCAD TSurf.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include <terrane/algorithms/verify/detail/line_scanner.hpp>
#include <terrane/algorithms/verify/detail/output.hpp>

namespace terrane::verifier {

namespace {

/// Returns the names that formats without quotes have: blanks, control characters, '#' and '\' are
/// '_', an empty name is "surface", and a name that was there before gets _2, _3, ...
std::vector<std::string> plain_names(std::span<const SurfaceInfo> surfaces) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    std::map<std::string, unsigned> next;
    for (const SurfaceInfo& surface : surfaces) {
        std::string base = surface.name.empty() ? "surface" : surface.name;
        for (char& c : base)
            if (const auto code = static_cast<unsigned char>(c);
                code <= 32 || code == 127 || c == '#' || c == '\\')
                c = '_';
        std::string name = base;
        unsigned& number = next.try_emplace(base, 2).first->second;
        while (!taken.insert(name).second) name = base + "_" + std::to_string(number++);
        names.push_back(std::move(name));
    }
    return names;
}

/// Reads three corners, counted from `first`, which must be those of a triangle.
void expect_corners(LineScanner& in, const Triangle& triangle, std::uint64_t first) {
    for (const std::uint32_t corner : triangle)
        if (in.integer() != corner + first) in.fail("another corner than in the certificate");
    in.end_line();
}

/// Returns the triangles of each surface, in order.
std::vector<std::vector<std::uint32_t>> triangles_of_surfaces(const ExpectedMesh& expected) {
    std::vector<std::vector<std::uint32_t>> triangles(expected.surfaces.size());
    for (std::uint32_t t = 0; t < expected.mesh.surfaces_of.size(); ++t)
        for (const std::uint32_t surface : expected.mesh.surfaces_of[t])
            triangles[surface].push_back(t);
    return triangles;
}

std::string one_line(std::string name) {
    for (char& c : name)
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
    return name;
}

} // namespace

void compare_obj(std::string_view contents, const ExpectedMesh& expected) {
    LineScanner in(contents);
    for (const Point3& vertex : expected.mesh.vertices) {
        in.next();
        in.expect_word("v");
        in.expect_point(vertex);
        in.end_line();
    }
    const auto names = plain_names(expected.surfaces);
    std::span<const std::uint32_t> group;
    for (std::size_t t = 0; t < expected.mesh.triangles.size(); ++t) {
        const auto surfaces = expected.mesh.surfaces_of[t];
        if (t == 0 || !std::ranges::equal(group, surfaces)) {
            std::string line = "g";
            for (const std::uint32_t surface : surfaces) line += " " + names[surface];
            in.expect(line);
            group = surfaces;
        }
        in.next();
        in.expect_word("f");
        expect_corners(in, expected.mesh.triangles[t], 1);
    }
    in.end();
}

void compare_off(std::string_view contents, const ExpectedMesh& expected) {
    LineScanner in(contents);
    in.expect("OFF");
    in.expect(std::to_string(expected.mesh.vertices.size()) + " " +
              std::to_string(expected.mesh.triangles.size()) + " 0");
    for (const Point3& vertex : expected.mesh.vertices) {
        in.next();
        in.expect_point(vertex);
        in.end_line();
    }
    for (const Triangle& triangle : expected.mesh.triangles) {
        in.next();
        in.expect_word("3");
        expect_corners(in, triangle, 0);
    }
    in.end();
}

void compare_stl_ascii(std::string_view contents, const ExpectedMesh& expected) {
    LineScanner in(contents);
    const auto names = plain_names(expected.surfaces);
    const auto triangles = triangles_of_surfaces(expected);
    for (std::size_t s = 0; s < triangles.size(); ++s) {
        if (triangles[s].empty()) continue;
        in.expect("solid " + names[s]);
        for (const std::uint32_t t : triangles[s]) {
            in.next();
            in.expect_word("facet");
            in.expect_word("normal");
            for (int i = 0; i < 3; ++i) (void)in.number<float>();
            in.end_line();
            in.expect("outer loop");
            for (const std::uint32_t corner : expected.mesh.triangles[t]) {
                in.next();
                in.expect_word("vertex");
                in.expect_point(expected.mesh.vertices[corner]);
                in.end_line();
            }
            in.expect("endloop");
            in.expect("endfacet");
        }
        in.expect("endsolid " + names[s]);
    }
    in.end();
}

// --- GOCAD TSurf ------------------------------------------------------------------------------

namespace {

void expect_gocad_header(LineScanner& in, const SurfaceInfo& surface) {
    const std::string name = one_line(surface.name);
    const bool plain = !name.empty() && name.front() != ' ' && name.back() != ' ' &&
                       name.find_first_of("\"{}") == std::string::npos;
    in.expect("GOCAD TSurf 1");
    in.expect("HEADER {");
    in.expect("name: " + (plain ? name : "\"" + name + "\""));
    for (const std::string_view line :
         {"}", "GOCAD_ORIGINAL_COORDINATE_SYSTEM", "NAME Default", "AXIS_NAME \"X\" \"Y\" \"Z\"",
          "ZPOSITIVE Elevation", "END_ORIGINAL_COORDINATE_SYSTEM"})
        in.expect(line);
    if (surface.role == Role::horizon) in.expect("GEOLOGICAL_TYPE top");
    if (surface.role == Role::fault) in.expect("GEOLOGICAL_TYPE fault");
    if (surface.role == Role::boundary) in.expect("GEOLOGICAL_TYPE boundary");
    in.expect("TFACE");
}

/// Reads the part of the mesh that belongs to one surface; it has the vertices of its triangles, in
/// the order of the mesh.
void expect_tface(LineScanner& in, const WrittenMesh& mesh,
                  const std::vector<std::uint32_t>& triangles) {
    std::map<std::uint32_t, std::uint64_t> number_of; // vertex: its number in the file
    for (const std::uint32_t t : triangles)
        for (const std::uint32_t corner : mesh.triangles[t]) number_of[corner] = 0;
    std::uint64_t next = 1;
    for (auto& [vertex, number] : number_of) {
        number = next++;
        in.next();
        in.expect_word("VRTX");
        if (in.integer() != number) in.fail("another number of a vertex is needed");
        in.expect_point(mesh.vertices[vertex]);
        in.end_line();
    }
    for (const std::uint32_t t : triangles) {
        in.next();
        in.expect_word("TRGL");
        for (const std::uint32_t corner : mesh.triangles[t])
            if (in.integer() != number_of[corner])
                in.fail("another corner than in the certificate");
        in.end_line();
    }
    in.expect("END");
}

} // namespace

void compare_gocad(std::string_view contents, const ExpectedMesh& expected) {
    LineScanner in(contents);
    const auto triangles = triangles_of_surfaces(expected);
    for (std::size_t s = 0; s < triangles.size(); ++s) {
        expect_gocad_header(in, expected.surfaces[s]);
        expect_tface(in, expected.mesh, triangles[s]);
    }
    in.end();
}

} // namespace terrane::verifier
