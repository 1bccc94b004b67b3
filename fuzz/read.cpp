// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: any bytes give surfaces, or an error with a sentence and a place; accepted surfaces can
// be arranged, and are equal to the last bit after writing and reading.
// There is one program per format, into which format_name is linked.
#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/gocad/gocad.hpp>
#include <terrane/io/meshes/gmsh_reader.hpp>
#include <terrane/io/meshes/legacy_vtk.hpp>
#include <terrane/io/meshes/vtp_reader.hpp>
#include <terrane/io/points/outline.hpp>

#include "report.hpp"

using namespace terrane;
using fuzz::require;

extern const std::string_view format_name; ///< "ts", "obj", ...

namespace {

Result<std::vector<Surface>> read(std::string_view contents) {
    if (format_name == "ml") {
        auto model = read_gocad_model(contents, "fuzz", "fuzz");
        if (!model) return model.error();
        return std::move(model.value().surfaces);
    }
    return parse_surfaces(contents, "fuzz", *format_named(format_name));
}

/// Returns the format to write: PLY for formats that are only read.
Format written_format() {
    const Format format = *format_named(format_name);
    // A DXF has corners without numbers, so that those of a polyface may get others.
    return holds_surfaces(format) && format != Format::dxf ? format : Format::ply;
}

std::string written(const Mesh& mesh) {
    // Only text STL keeps doubles.
    const auto text = format_mesh(mesh, written_format(), {.ascii = true});
    if (!text) fuzz::fail("what was read can't be written: " + text.error().message());
    return text.value();
}

/// Removes the vertices that no triangle uses, which not all formats can store.
Surface in_use(const Surface& s) {
    std::vector<bool> used(s.vertices.size());
    for (const Triangle& t : s.triangles)
        for (const auto v : t) used[v] = true;
    Surface result{s.name, s.role, {}, s.triangles};
    std::vector<std::uint32_t> number(used.size());
    for (std::size_t v = 0; v < used.size(); ++v) {
        number[v] = static_cast<std::uint32_t>(result.vertices.size());
        if (used[v]) result.vertices.push_back(s.vertices[v]);
    }
    for (Triangle& t : result.triangles)
        for (auto& v : t) v = number[v];
    return result;
}

Mesh mesh_of(const std::vector<Surface>& surfaces) {
    Mesh mesh;
    for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        const Surface& surface = surfaces[s];
        mesh.surfaces.push_back({surface.name, surface.role});
        mesh.vertices.insert(mesh.vertices.end(), surface.vertices.begin(), surface.vertices.end());
        for (const Triangle& t : surface.triangles) {
            mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
            mesh.surfaces_of.push_back(std::vector{s});
        }
    }
    return mesh;
}

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_points(const std::vector<Point3>& a, const std::vector<Point3>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (!same_bits(a[i].x, b[i].x) || !same_bits(a[i].y, b[i].y) || !same_bits(a[i].z, b[i].z))
            return false;
    return true;
}

/// Tells whether every format keeps the names; others are changed in writing so that they read
/// back.
bool plain_names(const std::vector<Surface>& surfaces) {
    std::set<std::string> names;
    for (const Surface& s : surfaces) {
        const bool plain = std::all_of(s.name.begin(), s.name.end(), [](unsigned char c) {
            return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
        });
        if (!plain || s.name.empty() || !names.insert(s.name).second) return false;
    }
    return true;
}

/// Names a difference between two lists of surfaces; empty if there is none.
std::string difference(const std::vector<Surface>& a, const std::vector<Surface>& b) {
    if (a.size() != b.size()) return "number of surfaces";
    for (std::size_t s = 0; s < a.size(); ++s) {
        if (a[s].triangles != b[s].triangles) return "triangles";
        if (!same_points(a[s].vertices, b[s].vertices)) return "vertices";
        if (plain_names(a) && format_name != "off" && a[s].name != b[s].name) return "names";
        const bool has_roles = format_name != "obj" && format_name != "off" &&
                               format_name != "stl" && format_name != "msh";
        if (has_roles && a[s].role != b[s].role) return "roles";
    }
    return "";
}

/// Writes, reads and writes again. The two texts must be equal: names are changed only once.
void check_round_trip(const std::vector<Surface>& surfaces) {
    std::vector<Surface> first;
    for (const Surface& s : surfaces)
        if (!s.triangles.empty()) first.push_back(in_use(s));
    const std::string text = written(mesh_of(first));
    const auto again = parse_surfaces(text, "fuzz", written_format());
    if (!again)
        fuzz::fail("what was written can't be read: " + again.error().message() + "\n" + text);
    const auto what = difference(first, again.value());
    if (!what.empty()) fuzz::fail(what + " differ after writing and reading:\n" + text);
    require(written(mesh_of(again.value())) == text, "written again, it is another text");
}

void check_error(const Error& error) {
    require(!error.sentence.empty(), "an error without a sentence");
    require(!error.place.empty(), "an error without a place");
    require(error.code != ErrorCode::internal, "an internal error");
}

/// Checks an outline, which is no surface. Lines with its corners are read as the same outline.
void check_outline(std::string_view contents) {
    const auto corners = read_outline(contents, "fuzz." + std::string(format_name));
    if (!corners) return check_error(corners.error());
    std::string lines;
    for (const auto& [x, y] : *corners) {
        require(std::isfinite(x) && std::isfinite(y), "a corner that is not finite");
        char line[64];
        std::snprintf(line, sizeof line, "%.17g %.17g\n", x, y);
        lines += line;
    }
    if (corners->empty()) return;
    const auto again = read_outline(lines, "fuzz.txt");
    require(again && *again == *corners, "the corners differ after writing and reading");
}

/// Tetrahedra name vertices that there are, and have a label each or none at all.
void check_tetrahedra(std::string_view contents) {
    const auto found = format_name == "vtu"   ? read_vtu_tetrahedra(contents, "fuzz")
                       : format_name == "vtk" ? read_vtk_tetrahedra(contents, "fuzz")
                                              : read_msh_tetrahedra(contents, "fuzz");
    if (!found) return check_error(found.error());
    for (const auto& corners : found->tetrahedra)
        for (const auto v : corners)
            require(v < found->vertices.size(), "a corner that is no vertex");
    require(found->labels.empty() || found->labels.size() == found->tetrahedra.size(),
            "other labels than tetrahedra");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view contents(reinterpret_cast<const char*>(data), size);
    if (format_name == "geojson" || format_name == "shp") {
        check_outline(contents);
        return 0;
    }
    if (format_name == "vtu" || format_name == "vtk" || format_name == "msh")
        check_tetrahedra(contents);
    const auto surfaces = read(contents);
    if (!surfaces) {
        check_error(surfaces.error());
        return 0;
    }
    require(validate(surfaces.value()).ok(), "surfaces that no stage may be given");
    check_round_trip(surfaces.value());
    return 0;
}
