// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/vtp_reader.hpp>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <pugixml.hpp>

#include <terrane/io/meshes/detail/vtk_cells.hpp>
#include <terrane/io/meshes/detail/vtk_data.hpp>
#include <terrane/io/meshes/detail/vtk_structured.hpp>
#include <terrane/io/surfaces/parts.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

using Integers = std::vector<std::int64_t>;
using Corners = std::vector<std::uint32_t>;

constexpr std::size_t most_vertices = UINT32_MAX;

std::string without_blanks(std::string_view text) {
    std::string kept;
    for (const char c : text)
        if (!is_blank(c) && c != '\n') kept += c;
    return kept;
}

/// Which surfaces a polygon belongs to, as to_vtp() writes it.
struct Ownership {
    Integers surface; ///< per polygon: its surface, or the first of several
    Integers lists;   ///< surfaces of all polygons, one after the other; empty if each has one
    Integers offsets; ///< per polygon: where its part of `lists` ends
    [[nodiscard]] bool empty() const { return surface.empty(); }
};

/// Reads PolyData, or the faces of an UnstructuredGrid.
class VtkXmlReader {
public:
    VtkXmlReader(std::string_view contents, std::string_view source, std::string_view name,
                 std::string_view type) :
        contents_(contents),
        source_(source), name_(name), type_(type) {}

    Result<std::vector<Surface>> read() {
        if (auto trouble = read_pieces()) return *trouble;
        auto surfaces = surfaces_of_parts(vertices_, std::move(parts_), values_);
        if (surfaces.empty()) return no_triangle_among(other_cells_, source_);
        return surfaces;
    }

    Result<LabelledTetrahedra> read_tetrahedra() {
        for_tetrahedra_ = true;
        if (auto trouble = read_pieces()) return *trouble;
        if (tetrahedra_.tetrahedra.empty())
            return Error{ErrorCode::nothing_to_do, "there is no tetrahedron", std::string(source_)};
        if (tetrahedra_.labels.size() < tetrahedra_.tetrahedra.size())
            tetrahedra_.labels.clear(); // some piece has none
        tetrahedra_.vertices = std::move(vertices_);
        return std::move(tetrahedra_);
    }

private:
    MaybeError read_pieces() {
        if (auto trouble = parse()) return trouble;
        if (auto trouble = read_header()) return trouble;
        const pugi::xml_node data = root_.child(std::string(type_).c_str());
        if (!data)
            return error(root_, ErrorCode::bad_syntax,
                         fmt::format("there is no element {}", type_));
        if (auto trouble = read_names(data)) return trouble;
        if (parts_.empty()) parts_.push_back({std::string(name_)});
        for (const pugi::xml_node piece : data.children("Piece"))
            if (auto trouble = read_piece(data, piece)) return trouble;
        return std::nullopt;
    }

    [[nodiscard]] std::string place(std::ptrdiff_t offset) const {
        const auto end = std::min(contents_.size(),
                                  static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
        const auto line =
            1 + std::count(contents_.begin(), contents_.begin() + static_cast<std::ptrdiff_t>(end),
                           '\n');
        return fmt::format("{}:{}", source_, line);
    }
    [[nodiscard]] Error error(const pugi::xml_node& at, ErrorCode code, std::string what) const {
        return {code, std::move(what), place(at.offset_debug())};
    }

    /// Parses the file but its appended data, which need not be XML.
    MaybeError parse() {
        const auto appended = contents_.find("<AppendedData");
        std::string text(contents_.substr(0, appended));
        if (appended != std::string_view::npos) {
            const auto tag_end = contents_.find('>', appended);
            const auto start = contents_.find('_', tag_end);
            if (start == std::string_view::npos)
                return Error{ErrorCode::bad_syntax, "the appended data have no beginning",
                             place(static_cast<std::ptrdiff_t>(appended))};
            const auto tag = contents_.substr(appended, tag_end - appended);
            appended_is_base64_ = tag.find("base64") != std::string_view::npos;
            appended_ = contents_.substr(start + 1);
            if (appended_is_base64_)
                appended_text_ = without_blanks(appended_.substr(0, appended_.find('<')));
            text += "</VTKFile>";
        }
        const auto parsed = document_.load_buffer(text.data(), text.size());
        if (parsed.status == pugi::status_out_of_memory) throw std::bad_alloc();
        if (!parsed)
            return Error{ErrorCode::bad_syntax,
                         std::string("this is not well-formed XML: ") + parsed.description(),
                         place(parsed.offset)};
        root_ = document_.child("VTKFile");
        if (!root_) return Error{ErrorCode::bad_syntax, "there is no element VTKFile", place(0)};
        return std::nullopt;
    }

    MaybeError read_header() {
        const std::string_view type = root_.attribute("type").value();
        if (type != type_)
            return error(root_, ErrorCode::unsupported,
                         fmt::format("the file has {}; only {} is read", shown(type), type_));
        const std::string_view name = root_.attribute("compressor").value();
        const auto compressor = vtk_compressor(name);
        if (!compressor)
            return error(root_, ErrorCode::unsupported,
                         fmt::format("{} is not read by this build", shown(name)));
        encoding_.compressor = *compressor;
        const std::string_view order = root_.attribute("byte_order").value();
        encoding_.order = order == "BigEndian" ? std::endian::big : std::endian::little;
        const std::string_view header = root_.attribute("header_type").value();
        encoding_.wide_headers = header == "UInt64";
        return std::nullopt;
    }

    /// Decodes the bytes of an array that is not text.
    MaybeError bytes_of(const pugi::xml_node& array, std::string& bytes) {
        const std::string_view format = array.attribute("format").value();
        std::optional<std::string> flaw;
        if (format == "appended") {
            const auto offset = array.attribute("offset").as_ullong(UINT64_MAX);
            const std::string_view text =
                appended_is_base64_ ? std::string_view(appended_text_) : appended_;
            flaw = offset > text.size()
                       ? "the array begins beyond the appended data"
                       : decode_vtk(text, appended_is_base64_, offset, encoding_, bytes, used_);
        } else {
            const auto text = without_blanks(array.child_value());
            flaw = decode_vtk(text, true, 0, encoding_, bytes, used_);
        }
        // Arrays that share their data would make the work grow faster than the file.
        if (!flaw && used_ > 2 * contents_.size() + 64) flaw = "the data of the arrays overlap";
        if (flaw) return error(array, ErrorCode::bad_syntax, *flaw);
        return std::nullopt;
    }

    MaybeError append_value(const pugi::xml_node& array, std::string_view token,
                            Integers& values) const {
        if (parse_integer(token, values.emplace_back())) return std::nullopt;
        return error(array, ErrorCode::bad_number, shown(token) + " is not an integer");
    }
    MaybeError append_value(const pugi::xml_node& array, std::string_view token,
                            std::vector<double>& values) const {
        const auto state = parse_double(token, values.emplace_back());
        if (state != NumberState::not_a_number) return std::nullopt; // the user of the array judges
        return error(array, ErrorCode::bad_number, shown(token) + " is not a number");
    }

    template <class Number>
    MaybeError values_of(const pugi::xml_node& array, std::vector<Number>& values) {
        values.clear();
        if (std::string_view(array.attribute("format").value()) == "ascii") {
            std::string text = array.child_value();
            std::replace(text.begin(), text.end(), '\n', ' ');
            used_ += text.size();
            Tokens tokens(text);
            for (auto token = tokens.next(); !token.empty(); token = tokens.next())
                if (auto trouble = append_value(array, token, values)) return trouble;
            return std::nullopt;
        }
        std::string bytes;
        if (auto trouble = bytes_of(array, bytes)) return trouble;
        const std::string_view type = array.attribute("type").value();
        if (auto flaw = convert_vtk(bytes, type, encoding_.order, values))
            return error(array, ErrorCode::bad_syntax, *flaw);
        return std::nullopt;
    }

    /// Reads strings, each ended by a 0.
    MaybeError strings_of(const pugi::xml_node& array, std::vector<std::string>& strings) {
        Integers codes;
        if (std::string_view(array.attribute("format").value()) == "ascii") {
            if (auto trouble = values_of(array, codes)) return trouble;
        } else {
            std::string bytes;
            if (auto trouble = bytes_of(array, bytes)) return trouble;
            codes.assign(bytes.begin(), bytes.end());
        }
        std::string text;
        for (const std::int64_t code : codes) {
            if (code != 0)
                text += static_cast<char>(code & 255);
            else
                strings.push_back(std::exchange(text, {}));
        }
        return std::nullopt;
    }

    static pugi::xml_node array_named(const pugi::xml_node& parent, std::string_view name) {
        for (const pugi::xml_node array : parent.children())
            if (name == array.attribute("Name").value()) return array;
        return {};
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
    MaybeError add_polygon(const pugi::xml_node& piece, const Ownership& of, std::size_t k,
                           const Corners& corners) {
        const auto add_to = [&](std::int64_t s) -> MaybeError {
            if (s < 0 || s >= static_cast<std::int64_t>(parts_.size()))
                return error(piece, ErrorCode::bad_index,
                             fmt::format("polygon {} is of surface {}, but there are {}", k, s,
                                         parts_.size()));
            append_face(corners, parts_[static_cast<std::size_t>(s)]);
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
        for (const auto* data_of : {"PointData", "CellData"})
            for (const pugi::xml_node array : piece.child(data_of).children())
                note_values(array.attribute("Name").value(), values_);
        if (type_ == "UnstructuredGrid") return read_grid_cells(data, piece, points);
        if (type_ == "StructuredGrid") return read_structured(piece, points);
        if (auto trouble = read_ownership(data, piece, of)) return trouble;
        const auto polygon = [&](std::size_t k, const Corners& corners) {
            return add_polygon(piece, of, k, corners);
        };
        const auto strip = [&](std::size_t, const Corners& corners) -> MaybeError {
            append_strip(corners, parts_[0].triangles);
            return std::nullopt;
        };
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
        append_structured(*size, vertices_.size() - points, hidden, parts_[0]);
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
            if (kinds[k] == CellKind::polygon) return add_polygon(piece, of, polygons++, corners);
            if (kinds[k] == CellKind::strip) append_strip(corners, parts_[0].triangles);
            if (kinds[k] == CellKind::pixel && corners.size() == 4)
                append_face(Corners{corners[0], corners[1], corners[3], corners[2]}, parts_[0]);
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

    std::string_view contents_, source_, name_;
    bool for_tetrahedra_ = false;   ///< instead of surfaces
    LabelledTetrahedra tetrahedra_; ///< without vertices
    std::string_view type_;         ///< of the data that are read: PolyData or UnstructuredGrid
    std::size_t other_cells_ = 0;   ///< cells of a grid that are no faces
    pugi::xml_document document_;
    pugi::xml_node root_;
    VtkEncoding encoding_;
    std::string_view appended_;
    std::string appended_text_; ///< without blanks, if it is base64
    bool appended_is_base64_ = false;
    std::size_t used_ = 0; ///< bytes of the file that arrays have read
    std::vector<Point3> vertices_;
    std::vector<FilePart> parts_;
    std::vector<std::string> values_; ///< see Surface
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
