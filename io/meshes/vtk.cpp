// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/vtk.hpp>

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/io/meshes/detail/groups.hpp>
#include <terrane/io/meshes/detail/vtk_writer.hpp>
#include <terrane/io/text/values.hpp>

namespace terrane {

using namespace detail;

namespace {

/// Appends the first value of each list; -1 for an empty list.
void append_first(std::vector<std::int32_t>& out, const IndexLists<std::uint32_t>& lists) {
    for (std::size_t i = 0; i < lists.size(); ++i)
        out.push_back(lists[i].empty() ? -1 : static_cast<std::int32_t>(lists[i][0]));
}

void append_counts(std::vector<std::int32_t>& out, const IndexLists<std::uint32_t>& lists) {
    for (std::size_t i = 0; i < lists.size(); ++i)
        out.push_back(static_cast<std::int32_t>(lists[i].size()));
}

std::optional<Error> check_lengths(std::span<const CellArray> cells, std::size_t count) {
    for (const auto& cell : cells) {
        const auto size = std::visit([](const auto& values) { return values.size(); }, cell.values);
        if (size != count)
            return Error{
                ErrorCode::bad_option,
                fmt::format("cell array {} has {} values for {} cells", cell.name, size, count),
                ""};
    }
    return std::nullopt;
}

template <class Fill>
std::vector<std::int32_t> filled(Fill fill) {
    std::vector<std::int32_t> values;
    fill(values);
    return values;
}

void write_triangle_data(VtkWriter& out, const Mesh& mesh) {
    out.array("surface", filled([&](auto& v) { append_first(v, mesh.surfaces_of); }));
    out.array("surface_count", filled([&](auto& v) { append_counts(v, mesh.surfaces_of); }));
    if (mesh.regions_of.size() != 0)
        out.array("region", filled([&](auto& v) { append_first(v, mesh.regions_of); }));
    if (mesh.parents_of.size() != 0)
        out.array("parent", filled([&](auto& v) { append_first(v, mesh.parents_of); }));
}

void write_tetrahedron_data(VtkWriter& out, const TetrahedralMesh& mesh) {
    const auto count = mesh.tetrahedra.size();
    const auto faces = mesh.faces.size();
    auto block = std::vector<std::int32_t>(mesh.block_of.begin(), mesh.block_of.end());
    block.resize(count + faces, -1);
    out.array("block", block);
    std::vector<std::int32_t> surface(count, -1), surface_count(count, 0), parent(count, -1);
    append_first(surface, mesh.surfaces_of);
    append_counts(surface_count, mesh.surfaces_of);
    for (const auto triangle : mesh.face_triangle)
        parent.push_back(static_cast<std::int32_t>(triangle)); // UINT32_MAX becomes -1
    out.array("surface", surface);
    out.array("surface_count", surface_count);
    out.array("parent", parent);
    if (mesh.twins.empty()) return;
    std::vector<std::int32_t> twin(count + faces, -1);
    for (const auto& [front, back] : mesh.twins) {
        twin[count + front] = static_cast<std::int32_t>(count + back);
        twin[count + back] = static_cast<std::int32_t>(count + front);
    }
    out.array("twin", twin);
    out.array("cut_side", filled([&](auto& v) {
                  v.resize(count);
                  for (const auto side : detail::cut_sides(mesh))
                      v.push_back(static_cast<std::int32_t>(side));
              }));
}

void write_point_data(VtkWriter& out, std::span<const ValueArray> arrays) {
    if (std::ranges::all_of(arrays, &ValueArray::on_triangles)) return;
    out.text("<PointData>");
    out.values(arrays, false);
    out.text("</PointData>");
}

/// Returns the values of a grid of tetrahedra and faces; only vertices and faces on surfaces have any.
std::vector<ValueArray> grid_values(const TetrahedralMesh& mesh, std::size_t vertices,
                                    std::span<const SurfaceValues> values) {
    auto arrays = joined_values(vertices, mesh.faces, mesh.surfaces_of, values);
    std::vector<std::uint32_t> faces(mesh.tetrahedra.size(), no_index);
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) faces.push_back(f);
    for (ValueArray& array : arrays)
        if (array.on_triangles) array = picked(array, faces);
    return arrays;
}

} // namespace

Result<std::string> to_vtp(const Mesh& mesh, bool compress, std::span<const CellArray> cells,
                           std::span<const std::string> block_names,
                           std::span<const SurfaceValues> values) {
    if (auto trouble = check_lengths(cells, mesh.triangles.size())) return *trouble;
    const auto arrays =
        joined_values(mesh.vertices.size(), mesh.triangles, mesh.surfaces_of, values);
    VtkWriter out(compress);
    out.begin_file("PolyData");
    out.field(mesh.surfaces, mesh.surfaces_of, "block_name", block_names, arrays);
    out.text(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
                         "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">",
                         mesh.vertices.size(), mesh.triangles.size()));
    write_point_data(out, arrays);
    out.text("<CellData Scalars=\"surface\">");
    write_triangle_data(out, mesh);
    out.further(cells);
    out.values(arrays, true);
    out.text("</CellData>");
    out.points(mesh.vertices);
    std::vector<std::int64_t> corners, offsets;
    append_nodes(corners, mesh.triangles);
    append_offsets(offsets, mesh.triangles.size(), 3);
    out.text("<Polys>");
    out.array("connectivity", corners);
    out.array("offsets", offsets);
    out.text("</Polys>");
    return out.end_file("PolyData");
}

Result<std::string> to_vtu(const TetrahedralMesh& mesh, bool compress,
                           std::span<const CellArray> cells,
                           std::span<const std::string> block_names, const EdgeNodes* nodes,
                           std::span<const SurfaceValues> values) {
    const auto count = mesh.tetrahedra.size() + mesh.faces.size();
    if (auto trouble = check_lengths(cells, count)) return *trouble;
    VtkWriter out(compress);
    out.begin_file("UnstructuredGrid");
    const auto& vertices = nodes ? nodes->vertices : mesh.vertices;
    const auto arrays = grid_values(mesh, vertices.size(), values);
    out.field(mesh.surfaces, mesh.surfaces_of, "block_name", block_names, arrays);
    out.begin_piece(vertices.size(), count);
    write_point_data(out, arrays);
    out.text("<CellData Scalars=\"block\">");
    write_tetrahedron_data(out, mesh);
    out.further(cells);
    out.values(arrays, true);
    out.text("</CellData>");
    out.points(vertices);
    std::vector<std::int64_t> corners, offsets;
    append_nodes(corners, mesh.tetrahedra, nodes ? &nodes->of_tetrahedra : nullptr);
    append_nodes(corners, mesh.faces, nodes ? &nodes->of_faces : nullptr);
    append_offsets(offsets, mesh.tetrahedra.size(), nodes ? 10 : 4);
    append_offsets(offsets, mesh.faces.size(), nodes ? 6 : 3);
    std::vector<std::uint8_t> types(mesh.tetrahedra.size(),
                                    nodes ? vtk_tetrahedron_of_10 : vtk_tetrahedron);
    types.resize(count, nodes ? vtk_triangle_of_6 : vtk_triangle);
    out.cells(corners, offsets, types);
    return out.end_file("UnstructuredGrid");
}

} // namespace terrane
