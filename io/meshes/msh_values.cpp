// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/msh_values.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/values.hpp>

namespace terrane {

using namespace detail;

namespace {

/// How the elements of a file are numbered.
struct MshNumbering {
    std::size_t first = 1;    ///< element of the first triangle
    bool per_surface = false; ///< a triangle is an element for each of its surfaces
};

std::string sections_of(std::size_t vertices, std::span<const Triangle> triangles,
                        const IndexLists<std::uint32_t>& surfaces_of,
                        std::span<const SurfaceValues> values, const MshNumbering& numbering) {
    std::string out;
    for (const ValueArray& array : joined_values(vertices, triangles, surfaces_of, values)) {
        if (!fits_msh(array)) continue;
        const std::size_t n = array.components;
        std::string lines, name = one_line(array.name);
        std::ranges::replace(name, '"', '\'');
        std::size_t count = 0;
        for (std::size_t i = 0; i < array.size(); ++i) {
            bool is_there = true;
            for (std::size_t c = 0; c < n; ++c)
                is_there = is_there && !has_no_data(array, n * i + c);
            if (!is_there) continue;
            std::string numbers;
            for (std::size_t c = 0; c < n; ++c) {
                numbers += ' ';
                append_value(numbers, array, n * i + c);
            }
            const auto first = array.on_triangles ? numbering.first : 1;
            const bool repeats = array.on_triangles && numbering.per_surface;
            const std::size_t begin = repeats ? surfaces_of.offsets[i] : i,
                              end = repeats ? surfaces_of.offsets[i + 1] : i + 1;
            for (std::size_t e = begin; e < end; ++e) {
                append_number(lines, std::uint64_t(first + e));
                lines += numbers + '\n';
                ++count;
            }
        }
        const char* const section = array.on_triangles ? "ElementData" : "NodeData";
        out += fmt::format("${}\n1\n\"{}\"\n1\n0\n3\n0\n{}\n{}\n{}$End{}\n", section, name, n,
                           count, lines, section);
    }
    return out;
}

} // namespace

bool fits_msh(const ValueArray& array) {
    return array.components == 1 || array.components == 3 || array.components == 9;
}

std::string to_msh_values(const Mesh& mesh, std::span<const SurfaceValues> values, bool is_22) {
    return sections_of(mesh.vertices.size(), mesh.triangles, mesh.surfaces_of, values, {1, is_22});
}

std::string to_msh_values(const TetrahedralMesh& mesh, std::span<const SurfaceValues> values,
                          bool is_22) {
    return sections_of(mesh.vertices.size(), mesh.faces, mesh.surfaces_of, values,
                       {mesh.tetrahedra.size() + 1, is_22});
}

} // namespace terrane
