// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/vtp_reader.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <pugixml.hpp>

#include <terrane/io/meshes/detail/vtk_cells.hpp>
#include <terrane/io/meshes/detail/vtk_data.hpp>
#include <terrane/io/meshes/detail/vtk_structured.hpp>
#include <terrane/io/meshes/detail/vtk_xml_file.hpp>
#include <terrane/io/surfaces/parts.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/values.hpp>

namespace terrane {

using namespace detail;

namespace {

using Corners = std::vector<std::uint32_t>;

constexpr std::size_t most_vertices = UINT32_MAX;

/// Which surfaces a polygon belongs to, as to_vtp() writes it.
struct Ownership {
    Integers surface; ///< per polygon: its surface, or the first of several
    Integers lists;   ///< surfaces of all polygons, one after the other; empty if each has one
    Integers offsets; ///< per polygon: where its part of `lists` ends
    [[nodiscard]] bool empty() const { return surface.empty(); }
};

/// Reads PolyData, or the faces of an UnstructuredGrid.
class VtkXmlReader : VtkXmlFile {
public:
    VtkXmlReader(std::string_view contents, std::string_view source, std::string_view name,
                 std::string_view type) :
        VtkXmlFile(contents, source, type),
        name_(name) {}

    Result<std::vector<Surface>> read() {
        if (auto trouble = read_pieces()) return *trouble;
        auto surfaces = surfaces_of_parts(vertices_, std::move(parts_), values_, arrays_);
        if (surfaces.empty()) return no_triangle_among(other_cells_, source());
        return surfaces;
    }

    Result<LabelledTetrahedra> read_tetrahedra() {
        for_tetrahedra_ = true;
        if (auto trouble = read_pieces()) return *trouble;
        if (tetrahedra_.tetrahedra.empty())
            return Error{ErrorCode::nothing_to_do, "there is no tetrahedron",
                         std::string(source())};
        if (tetrahedra_.labels.size() < tetrahedra_.tetrahedra.size())
            tetrahedra_.labels.clear(); // some piece has none
        tetrahedra_.vertices = std::move(vertices_);
        return std::move(tetrahedra_);
    }

private:
    MaybeError read_pieces() {
        pugi::xml_node data;
        if (auto trouble = open(data)) return trouble;
        if (auto trouble = read_names(data)) return trouble;
        if (parts_.empty()) parts_.push_back({std::string(name_)});
        for (const pugi::xml_node piece : data.children("Piece")) {
            if (auto trouble = read_piece(data, piece)) return trouble;
            if (for_tetrahedra_) continue;
            read_arrays(piece.child("PointData"), false, vertices_.size() - points_before_);
            read_arrays(piece.child("CellData"), true, cells_ - cells_before_);
            points_before_ = vertices_.size();
            cells_before_ = cells_;
        }
        if (!arrays_.empty()) read_descriptions(data.child("FieldData"));
        return std::nullopt;
    }

    /// Reads the numbers of an array of values. Texts become codes. Returns whether it could.
    bool read_numbers(const pugi::xml_node& node, ValueArray& array) {
        const std::string_view name = node.attribute("type").value();
        if (name == "String") {
            std::vector<std::string> texts;
            if (strings_of(node, texts)) return false;
            set_texts(texts, array);
            return true;
        }
        const auto type = number_type_named(name);
        if (!type) return false;
        array.type = *type;
        if (array.type <= NumberType::float32) return !values_of(node, array.numbers.emplace<0>());
        return !values_of(node, array.numbers.emplace<1>());
    }

    /// Reads the values of a piece on points, or on cells; those that are not in all pieces, or do not have
    /// `count` values, are only named.
    void read_arrays(const pugi::xml_node& data, bool on_cells, std::size_t count) {
        constexpr std::size_t most_arrays = 64; // a point may be in many surfaces
        if (count == 0) return;
        std::vector<ValueArray> here;
        for (const pugi::xml_node node : data.children()) {
            ValueArray array{.name = node.attribute("Name").value(), .on_triangles = on_cells};
            array.components = node.attribute("NumberOfComponents").as_uint(1);
            const std::string name = array.name;
            if (is_reserved(name)) continue;
            if (here.size() == most_arrays || !read_numbers(node, array) ||
                !add_array(std::move(array), count, here))
                note_values(name, values_);
        }
        if (std::exchange(has_arrays_[on_cells ? 1 : 0], true))
            append_piece(here, on_cells, arrays_, values_);
        else
            std::ranges::move(here, std::back_inserter(arrays_));
    }

    /// Reads units and numbers without value, as Terrane writes them.
    void read_descriptions(const pugi::xml_node& field) {
        ArrayDescriptions all;
        const auto names = array_named(field, "value_name"),
                   units = array_named(field, "value_unit"),
                   no_data = array_named(field, "value_no_data");
        if (names && units && no_data && !strings_of(names, all.names) &&
            !strings_of(units, all.units) && !values_of(no_data, all.no_data))
            describe_arrays(all, arrays_);
    }

    /// Reads the names and roles of surfaces, if the file has them.
    MaybeError read_names(const pugi::xml_node& data) {
        const pugi::xml_node field = data.child("FieldData");
        const auto names_node = array_named(field, "surface_name");
        if (!names_node) return std::nullopt;
        std::vector<std::string> names, roles;
        if (auto trouble = strings_of(names_node, names)) return trouble;
        if (const auto node = array_named(field, "surface_role"))
            if (auto trouble = strings_of(node, roles)) return trouble;
        for (std::size_t s = 0; s < names.size(); ++s) {
            FilePart& part = parts_.emplace_back();
            part.name = names[s].empty() ? std::string(name_) : names[s];
            for (std::size_t r = 0; r < role_names.size(); ++r)
                if (s < roles.size() && roles[s] == role_names[r]) part.role = Role(r);
        }
        has_names_ = !parts_.empty();
        return std::nullopt;
    }

    MaybeError read_points(const pugi::xml_node& piece, std::size_t& count) {
        const pugi::xml_node array = piece.child("Points").child("DataArray");
        if (!array) return std::nullopt;
        std::vector<double> values;
        if (auto trouble = values_of(array, values)) return trouble;
        count = values.size() / 3;
        const auto stated = piece.attribute("NumberOfPoints").as_ullong(count);
        if (values.size() % 3 != 0 || stated != count)
            return error(array, ErrorCode::bad_syntax,
                         fmt::format("{} points call for {} numbers, but there are {}", stated,
                                     3 * stated, values.size()));
        if (count > most_vertices - vertices_.size())
            return error(array, ErrorCode::unsupported, "there are more than 4294967295 points");
        for (std::size_t i = 0; i < values.size(); ++i)
            if (!std::isfinite(values[i]))
                return error(
                    array, ErrorCode::bad_number,
                    fmt::format("point {} has a coordinate that is not a finite number", i / 3));
        for (std::size_t i = 0; i < values.size(); i += 3)
            vertices_.push_back({values[i], values[i + 1], values[i + 2]});
        return std::nullopt;
    }

    /// Calls use(k, corners) for each cell of <Polys> or <Strips>.
    template <class Use>
    MaybeError for_each_cell(const pugi::xml_node& cells, std::size_t points, const Use& use) {
        if (!cells) return std::nullopt;
        Integers connectivity, offsets;
        const auto corners_node = array_named(cells, "connectivity"),
                   ends_node = array_named(cells, "offsets");
        if (!corners_node && !ends_node) return std::nullopt;
        if (auto trouble = values_of(corners_node, connectivity)) return trouble;
        if (auto trouble = values_of(ends_node, offsets)) return trouble;
        const std::size_t first = vertices_.size() - points;
        std::int64_t start = 0;
        Corners corners;
        for (std::size_t k = 0; k < offsets.size(); ++k) {
            const std::int64_t end = offsets[k];
            if (end < start || end > static_cast<std::int64_t>(connectivity.size()))
                return error(ends_node, ErrorCode::bad_index,
                             fmt::format("cell {} ends at {}, which is not in its data", k, end));
            corners.clear();
            for (std::int64_t i = start; i < end; ++i) {
                const std::int64_t v = connectivity[static_cast<std::size_t>(i)];
                if (v < 0 || v >= static_cast<std::int64_t>(points))
                    return error(
                        corners_node, ErrorCode::bad_index,
                        fmt::format("cell {} names point {}, but there are {}", k, v, points));
                corners.push_back(static_cast<std::uint32_t>(first + static_cast<std::size_t>(v)));
            }
            start = end;
            if (auto trouble = use(k, corners)) return trouble;
        }
        cells_ += offsets.size();
        return std::nullopt;
    }

    /// Reads which surfaces the polygons of a piece are of, where the file says it. Where cells have
    /// `kinds`, only polygons among them count.
    MaybeError read_ownership(const pugi::xml_node& data, const pugi::xml_node& piece,
                              Ownership& of, const std::vector<CellKind>& kinds = {}) {
        if (!has_names_) return std::nullopt;
        const auto surface = array_named(piece.child("CellData"), "surface");
        if (!surface) return std::nullopt;
        if (auto trouble = values_of(surface, of.surface)) return trouble;
        if (!kinds.empty()) {
            std::size_t kept = 0;
            for (std::size_t k = 0; k < std::min(kinds.size(), of.surface.size()); ++k)
                if (kinds[k] == CellKind::polygon) of.surface[kept++] = of.surface[k];
            of.surface.resize(kept);
        }
        const auto lists = array_named(data.child("FieldData"), "surfaces"),
                   offsets = array_named(data.child("FieldData"), "surfaces_offset");
        if (!lists || !offsets) return std::nullopt;
        if (auto trouble = values_of(lists, of.lists)) return trouble;
        if (auto trouble = values_of(offsets, of.offsets)) return trouble;
        bool sound = of.offsets.size() == of.surface.size() + 1 && of.offsets.front() >= 0;
        for (std::size_t k = 1; sound && k < of.offsets.size(); ++k)
            sound = of.offsets[k - 1] <= of.offsets[k];
        if (sound && of.offsets.back() <= static_cast<std::int64_t>(of.lists.size()))
            return std::nullopt;
        return error(offsets, ErrorCode::bad_index,
                     "the lists of surfaces do not fit the polygons");
    }

    /// Adds a polygon to its surfaces.
    /// `cell`: its number among the cells of all pieces.
    MaybeError add_polygon(const pugi::xml_node& piece, const Ownership& of, std::size_t k,
                           std::size_t cell, const Corners& corners) {
        const auto add_to = [&](std::int64_t s) -> MaybeError {
            if (s < 0 || s >= static_cast<std::int64_t>(parts_.size()))
                return error(piece, ErrorCode::bad_index,
                             fmt::format("polygon {} is of surface {}, but there are {}", k, s,
                                         parts_.size()));
            append_face(corners, parts_[static_cast<std::size_t>(s)],
                        static_cast<std::uint32_t>(cell));
            return std::nullopt;
        };
        if (of.empty()) return add_to(0);
        if (k >= of.surface.size())
            return error(piece, ErrorCode::bad_index,
                         fmt::format("the array surface has no value for polygon {}", k));
        if (of.offsets.empty()) return add_to(of.surface[k]);
        // Larger polygons in many surfaces each would make more triangles than the file has data.
        if (corners.size() > 3 && of.offsets[k + 1] - of.offsets[k] > 1)
            return error(piece, ErrorCode::unsupported,
                         fmt::format("polygon {} is of several surfaces, but no triangle", k));
        for (std::int64_t i = of.offsets[k]; i < of.offsets[k + 1]; ++i)
            if (auto trouble = add_to(of.lists[static_cast<std::size_t>(i)])) return trouble;
        return std::nullopt;
    }

    MaybeError read_piece(const pugi::xml_node& data, const pugi::xml_node& piece) {
        std::size_t points = 0;
        Ownership of;
        if (auto trouble = read_points(piece, points)) return trouble;
        if (type() == "UnstructuredGrid") return read_grid_cells(data, piece, points);
        if (type() == "StructuredGrid") return read_structured(piece, points);
        if (auto trouble = read_ownership(data, piece, of)) return trouble;
        const auto passed_over = [](std::size_t, const Corners&) -> MaybeError {
            return std::nullopt;
        };
        const auto polygon = [&](std::size_t k, const Corners& corners) {
            return add_polygon(piece, of, k, cells_ + k, corners);
        };
        const auto strip = [&](std::size_t k, const Corners& corners) -> MaybeError {
            append_strip(corners, parts_[0], static_cast<std::uint32_t>(cells_ + k));
            return std::nullopt;
        };
        for (const auto* other : {"Verts", "Lines"}) // their values come first
            if (piece.child("CellData").first_child())
                if (auto trouble = for_each_cell(piece.child(other), points, passed_over))
                    return trouble;
        if (auto trouble = for_each_cell(piece.child("Polys"), points, polygon)) return trouble;
        return for_each_cell(piece.child("Strips"), points, strip);
    }

    /// Reads a piece of a structured grid.
    MaybeError read_structured(const pugi::xml_node& piece, std::size_t points) {
        const auto counts = points_of_extent(piece.attribute("Extent").value(), points);
        if (!counts)
            return error(piece, ErrorCode::bad_syntax,
                         fmt::format("Extent is none of {} points", points));
        const auto size = structured_surface(*counts);
        if (!size) return error(piece, ErrorCode::unsupported, structured_volume);
        HiddenParts hidden;
        if (const auto array = array_named(piece.child("PointData"), "vtkGhostType"))
            if (auto trouble = values_of(array, hidden.points)) return trouble;
        if (const auto array = array_named(piece.child("CellData"), "vtkGhostType"))
            if (auto trouble = values_of(array, hidden.cells)) return trouble;
        append_structured(*size, vertices_.size() - points, cells_, hidden, parts_[0]);
        cells_ += cells_of(*size);
        return std::nullopt;
    }

    /// Reads the types of the cells of a grid, as kinds. Fails at cells with curved sides.
    MaybeError read_kinds(const pugi::xml_node& cells, std::vector<CellKind>& kinds) {
        const auto node = array_named(cells, "types");
        Integers types;
        if (!node) return std::nullopt;
        if (auto trouble = values_of(node, types)) return trouble;
        for (const std::int64_t type : types) {
            kinds.push_back(kind_of_cell(type));
            if (kinds.back() == CellKind::passed_over || kinds.back() == CellKind::tetrahedron)
                ++other_cells_;
            if (kinds.back() == CellKind::curved && !for_tetrahedra_)
                return error(node, ErrorCode::unsupported,
                             fmt::format("cell {} is of type {}, with curved sides, which is not "
                                         "read",
                                         kinds.size() - 1, type));
        }
        return std::nullopt;
    }

    /// Reads the faces of a grid.
    MaybeError read_grid_cells(const pugi::xml_node& data, const pugi::xml_node& piece,
                               std::size_t points) {
        const auto cells = piece.child("Cells");
        std::vector<CellKind> kinds;
        Ownership of;
        if (auto trouble = read_kinds(cells, kinds)) return trouble;
        if (for_tetrahedra_) return read_grid_tetrahedra(piece, points, kinds);
        if (auto trouble = read_ownership(data, piece, of, kinds)) return trouble;
        std::size_t polygons = 0;
        const auto use = [&](std::size_t k, const Corners& corners) -> MaybeError {
            if (k >= kinds.size())
                return error(cells, ErrorCode::bad_index,
                             fmt::format("the array types has no value for cell {}", k));
            const auto cell = static_cast<std::uint32_t>(cells_ + k);
            if (kinds[k] == CellKind::polygon)
                return add_polygon(piece, of, polygons++, cell, corners);
            if (kinds[k] == CellKind::strip) append_strip(corners, parts_[0], cell);
            if (kinds[k] == CellKind::pixel && corners.size() == 4)
                append_face(Corners{corners[0], corners[1], corners[3], corners[2]}, parts_[0],
                            cell);
            return std::nullopt;
        };
        return for_each_cell(cells, points, use);
    }

    MaybeError read_grid_tetrahedra(const pugi::xml_node& piece, std::size_t points,
                                    const std::vector<CellKind>& kinds) {
        Integers labels;
        for (const auto name : label_arrays)
            if (const auto array = array_named(piece.child("CellData"), name);
                array && labels.empty())
                if (auto trouble = values_of(array, labels)) return trouble;
        const auto use = [&](std::size_t k, const Corners& corners) -> MaybeError {
            if (k >= kinds.size() || kinds[k] != CellKind::tetrahedron) return std::nullopt;
            append_tetrahedron(corners, tetrahedra_);
            if (k >= labels.size() || append_label(labels[k], tetrahedra_)) return std::nullopt;
            return error(piece, ErrorCode::bad_number,
                         fmt::format("the label of cell {} is no number of 32 bits", k));
        };
        return for_each_cell(piece.child("Cells"), points, use);
    }

    std::string_view name_;
    bool for_tetrahedra_ = false;   ///< instead of surfaces
    LabelledTetrahedra tetrahedra_; ///< without vertices
    std::size_t other_cells_ = 0;   ///< cells of a grid that are no faces
    std::vector<Point3> vertices_;
    std::vector<FilePart> parts_;
    std::vector<ValueArray> arrays_;  ///< over all points and cells of the pieces so far
    std::vector<std::string> values_; ///< see Surface
    std::size_t cells_ = 0;           ///< number of cells in the pieces so far
    std::size_t points_before_ = 0, cells_before_ = 0; ///< without those of the current piece
    std::array<bool, 2> has_arrays_{};                 ///< whether a piece had points, and cells
    bool has_names_ = false;
};

} // namespace

Result<std::vector<Surface>> read_vtp(std::string_view contents, std::string_view source,
                                      std::string_view name) {
    return VtkXmlReader(contents, source, name, "PolyData").read();
}

Result<std::vector<Surface>> read_vtu(std::string_view contents, std::string_view source,
                                      std::string_view name) {
    return VtkXmlReader(contents, source, name, "UnstructuredGrid").read();
}

Result<std::vector<Surface>> read_vts(std::string_view contents, std::string_view source,
                                      std::string_view name) {
    return VtkXmlReader(contents, source, name, "StructuredGrid").read();
}

Result<LabelledTetrahedra> read_vtu_tetrahedra(std::string_view contents, std::string_view source) {
    return VtkXmlReader(contents, source, "", "UnstructuredGrid").read_tetrahedra();
}

} // namespace terrane
