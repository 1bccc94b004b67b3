// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <string>

#include <fmt/format.h>

#include <terrane/io/surfaces/ply.hpp>
#include <terrane/io/text/bytes.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/values.hpp>

namespace terrane {

using namespace detail;

namespace {

/// Returns the type that PLY has for numbers of this type; integers of 64 bits become doubles.
std::string_view ply_type(NumberType type) {
    constexpr std::array<std::string_view, 10> names{"double", "float", "char", "uchar",  "short",
                                                     "ushort", "int",   "uint", "double", "double"};
    return names[static_cast<std::size_t>(type)];
}

/// Appends the properties of the arrays on vertices or faces, described by comments.
void append_properties(std::string& out, std::span<const ValueArray> arrays, bool on_faces) {
    for (const ValueArray& array : arrays) {
        if (array.on_triangles != on_faces) continue;
        const std::string name = one_line(array.name),
                          unit = replaced_texts(one_line(array.unit), " ", "%20");
        std::string word = replaced_texts(name, " ", "_");
        out += fmt::format("comment terrane values {} {} ", on_faces ? "face" : "vertex",
                           array.components);
        if (array.no_data)
            append_number(out, *array.no_data);
        else
            out += '-';
        out += fmt::format(" {} {}\n", unit.empty() ? "-" : unit, name);
        if (word == "x" || word == "y" || word == "z") word += '_'; // which are coordinates
        for (std::uint32_t c = 0; c < array.components; ++c)
            out += fmt::format("property {} {}{}\n", ply_type(array.type), word,
                               array.components == 1 ? "" : fmt::format("_{}", c + 1));
    }
}

/// Appends the values of a vertex or face.
void append_values(std::string& out, std::span<const ValueArray> arrays, bool on_faces,
                   std::size_t element) {
    for (const ValueArray& array : arrays) {
        if (array.on_triangles != on_faces) continue;
        const bool is_wide = array.type >= NumberType::int64;
        with_type(is_wide ? NumberType::float64 : array.type, [&]<class T>(T) {
            std::visit(
                [&](const auto& numbers) {
                    for (std::size_t c = 0; c < array.components; ++c)
                        store(out, static_cast<T>(numbers[element * array.components + c]));
                },
                array.numbers);
        });
    }
}

} // namespace

std::string to_ply(const Mesh& mesh, std::span<const SurfaceValues> values) {
    const auto arrays =
        joined_values(mesh.vertices.size(), mesh.triangles, mesh.surfaces_of, values);
    std::string out = "ply\nformat binary_little_endian 1.0\n";
    for (const auto& surface : mesh.surfaces) {
        const std::string name = one_line(surface.name); // a blank at an end would not be read
        out += fmt::format("comment terrane surface {} {}\n",
                           role_names[static_cast<std::size_t>(surface.role)], trimmed(name));
    }
    out += fmt::format("element vertex {}\nproperty double x\nproperty double y\n"
                       "property double z\n",
                       mesh.vertices.size());
    append_properties(out, arrays, false);
    out += fmt::format("element face {}\nproperty list uchar int vertex_indices\n"
                       "property int surface\nproperty list uint int surfaces\n",
                       mesh.triangles.size());
    append_properties(out, arrays, true);
    out += "end_header\n";
    out.reserve(out.size() + mesh.vertices.size() * 24 + mesh.triangles.size() * 25);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Point3& p = mesh.vertices[v];
        for (const double c : {p.x, p.y, p.z}) store(out, c);
        append_values(out, arrays, false, v);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto surfaces = mesh.surfaces_of[i];
        store(out, std::uint8_t(3));
        for (const auto vertex : mesh.triangles[i]) store(out, vertex);
        store(out, surfaces[0]);
        store(out, static_cast<std::uint32_t>(surfaces.size()));
        for (const auto surface : surfaces) store(out, surface);
        append_values(out, arrays, true, i);
    }
    return out;
}

} // namespace terrane
