// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The elements of VTK's XML files. The arrays are inline base64, little endian, with 64-bit headers.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/io/meshes/cell_array.hpp>

namespace terrane::detail {

/// Numbers of types of cells in VTK.
inline constexpr std::uint8_t vtk_triangle = 5, vtk_tetrahedron = 10, vtk_triangle_of_6 = 22,
                              vtk_tetrahedron_of_10 = 24;

/// Writes the elements of one VTK file.
class VtkWriter {
public:
    explicit VtkWriter(bool compress) : compress_(compress) {}

    /// `attributes` of the data set, each after a blank.
    void begin_file(std::string_view type, std::string_view attributes = "");
    void text(std::string_view line) { out_.append(line).append("\n"); }
    /// Writes lines that programs pass over.
    void comment(std::string_view lines);

    /// Writes an array; `ids` makes it one of VTK's vtkIdType.
    template <class T>
    void array(std::string_view name, const std::vector<T>& values, int components = 1,
               bool ids = false) {
        begin_array(name, type_name(T()), values.size(), components, ids);
        end_array({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
    }

    /// Writes strings as VTK does: the codes of their characters, each string ended by a 0. In
    /// grids they are arrays of codes, as meshio reads no grid with arrays of strings.
    void strings(std::string_view name, const std::vector<std::string_view>& values);

    /// Field arrays are written between these.
    void begin_field();
    void end_field();
    /// `values`: the arrays of values(), whose units and numbers without value it lists.
    void field(const std::vector<SurfaceInfo>& surfaces,
               const IndexLists<std::uint32_t>& surfaces_of, std::string_view name_of_names,
               std::span<const std::string> further_names, std::span<const ValueArray> values = {});

    void begin_piece(std::size_t points, std::size_t cells);
    void points(const std::vector<Point3>& vertices);
    /// Writes the cells of a grid: their nodes one after the other, where each ends, and types.
    void cells(const std::vector<std::int64_t>& nodes, const std::vector<std::int64_t>& offsets,
               const std::vector<std::uint8_t>& types);
    void further(std::span<const CellArray> cells);
    /// Writes the values on vertices, or on triangles.
    void values(std::span<const ValueArray> arrays, bool on_triangles);
    std::string end_file(std::string_view type);

private:
    static std::string_view type_name(double) { return "Float64"; }
    static std::string_view type_name(float) { return "Float32"; }
    static std::string_view type_name(std::int8_t) { return "Int8"; }
    static std::string_view type_name(std::int16_t) { return "Int16"; }
    static std::string_view type_name(std::uint16_t) { return "UInt16"; }
    static std::string_view type_name(std::uint32_t) { return "UInt32"; }
    static std::string_view type_name(std::int32_t) { return "Int32"; }
    static std::string_view type_name(std::int64_t) { return "Int64"; }
    static std::string_view type_name(std::uint64_t) { return "UInt64"; }
    static std::string_view type_name(std::uint8_t) { return "UInt8"; }
    void begin_array(std::string_view name, std::string_view type, std::size_t size, int components,
                     bool ids);
    void end_array(std::string_view bytes);

    std::string out_;
    bool compress_;
    bool in_field_ = false;
    bool has_strings_ = true; ///< whether strings are arrays of strings
};

/// Appends the nodes of cells; those of second order follow where there are any.
template <class Cell>
void append_nodes(std::vector<std::int64_t>& out, const std::vector<Cell>& cells) {
    for (const auto& cell : cells) out.insert(out.end(), cell.begin(), cell.end());
}
template <class Cell, class Further>
void append_nodes(std::vector<std::int64_t>& out, const std::vector<Cell>& cells,
                  const std::vector<Further>* further) {
    if (!further) return append_nodes(out, cells);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        out.insert(out.end(), cells[i].begin(), cells[i].end());
        out.insert(out.end(), (*further)[i].begin(), (*further)[i].end());
    }
}

/// Appends count, 2 * count, ..., after the values that are there.
void append_offsets(std::vector<std::int64_t>& out, std::size_t cells, std::int64_t count);

} // namespace terrane::detail
