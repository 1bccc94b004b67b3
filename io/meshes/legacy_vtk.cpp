// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/legacy_vtk.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <terrane/io/meshes/detail/legacy_vtk_arrays.hpp>
#include <terrane/io/meshes/detail/legacy_vtk_scanner.hpp>
#include <terrane/io/meshes/detail/vtk_cells.hpp>
#include <terrane/io/meshes/detail/vtk_structured.hpp>
#include <terrane/io/surfaces/parts.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

/// Cells of one section: where each ends in the list of corners.
struct LegacyCells {
    std::size_t at = 0; ///< of the section, for messages
    std::vector<std::int64_t> corners, ends;
};

class LegacyVtkReader {
public:
    LegacyVtkReader(std::string_view contents, std::string_view source, std::string_view name) :
        in_(contents, source), name_(name) {}

    Result<std::vector<Surface>> read() {
        std::string section;
        if (auto trouble = read_geometry(section)) return *trouble;
        if (auto trouble = read_names(section)) return *trouble;
        if (auto trouble = make_triangles()) return *trouble;
        auto surfaces =
            surfaces_of_parts(vertices_, std::move(parts_), arrays_.left_out(), arrays_.values());
        if (surfaces.empty()) return no_triangle_among(other_cells_, in_.source());
        return surfaces;
    }

    Result<LabelledTetrahedra> read_tetrahedra() {
        for_tetrahedra_ = true;
        std::string section;
        if (auto trouble = read_geometry(section)) return *trouble;
        (void)read_attributes(section); // up to what is not known; the geometry is complete
        for (const auto name : label_arrays)
            if (labels_.empty()) labels_ = arrays_.of_cells(name);
        if (auto trouble = make_triangles()) return *trouble;
        if (tetrahedra_.tetrahedra.empty())
            return Error{ErrorCode::nothing_to_do, "there is no tetrahedron",
                         std::string(in_.source())};
        tetrahedra_.vertices = std::move(vertices_);
        return std::move(tetrahedra_);
    }

private:
    /// Reads up to the section that follows the geometry.
    MaybeError read_geometry(std::string& section) {
        if (auto trouble = read_header()) return trouble;
        for (auto keyword = in_.token(); !keyword.empty(); keyword = in_.token()) {
            section = lower(keyword);
            if (section == "cell_data" || section == "point_data")
                break; // the geometry is complete
            if (auto trouble = read_section(section)) return trouble;
            section.clear();
        }
        return std::nullopt;
    }

    MaybeError read_header() {
        if (!lower(in_.line()).starts_with("# vtk datafile version"))
            return in_.error(ErrorCode::bad_syntax,
                             "the first line is not \"# vtk DataFile Version\"");
        in_.line(); // the title
        const auto encoding = lower(in_.token());
        if (encoding != "ascii" && encoding != "binary")
            return in_.error(ErrorCode::bad_syntax, "the third line is neither ASCII nor BINARY");
        if (!same_ignoring_case(in_.token(), "dataset"))
            return in_.error(ErrorCode::bad_syntax, "DATASET is needed here");
        const auto kind = in_.token();
        is_grid_ = same_ignoring_case(kind, "unstructured_grid");
        is_structured_ = same_ignoring_case(kind, "structured_grid");
        if (!is_grid_ && !is_structured_ && !same_ignoring_case(kind, "polydata"))
            return in_.error(ErrorCode::unsupported,
                             fmt::format("the file has {}; only POLYDATA, UNSTRUCTURED_GRID and "
                                         "STRUCTURED_GRID are read",
                                         shown(kind)));
        if (encoding == "binary") in_.set_binary();
        return std::nullopt;
    }

    MaybeError read_section(const std::string& section) {
        if (section == "points") return read_points();
        if (section == "metadata") {
            in_.skip_paragraph();
            return std::nullopt;
        }
        if (section == "field") return arrays_.read_field();
        if (is_structured_ && section == "dimensions") return read_dimensions();
        if (is_grid_) {
            if (section == "cells") return read_cells(polygons_.emplace_back());
            if (section == "cell_types") return read_types();
            return in_.error(ErrorCode::bad_syntax,
                             fmt::format("{} is no section of UNSTRUCTURED_GRID", shown(section)));
        }
        if (section == "polygons") return read_cells(polygons_.emplace_back());
        if (section == "triangle_strips") return read_cells(strips_.emplace_back());
        if (section == "vertices" || section == "lines") {
            LegacyCells unused;
            auto trouble = read_cells(unused);
            other_polydata_ += unused.ends.size();
            return trouble;
        }
        return in_.error(ErrorCode::bad_syntax,
                         fmt::format("{} is no section of {}", shown(section),
                                     is_structured_ ? "STRUCTURED_GRID" : "POLYDATA"));
    }

    MaybeError read_dimensions() {
        std::array<std::size_t, 3> points{};
        for (std::size_t& count : points)
            if (auto trouble = in_.read_count(count)) return trouble;
        structured_ = structured_surface(points);
        if (!structured_) return in_.error(ErrorCode::unsupported, structured_volume);
        return std::nullopt;
    }

    MaybeError add_structured() {
        if (!structured_ || !is_of(*structured_, vertices_.size()))
            return in_.error(ErrorCode::bad_syntax,
                             fmt::format("DIMENSIONS do not fit the {} points", vertices_.size()));
        append_structured(*structured_, 0, 0, {}, parts_[0]);
        return std::nullopt;
    }

    MaybeError read_points() {
        std::size_t count = 0;
        LegacyType type{};
        if (auto trouble = in_.read_count(count)) return trouble;
        if (auto trouble = in_.read_type(type)) return trouble;
        if (!vertices_.empty()) return in_.error(ErrorCode::bad_syntax, "there are POINTS twice");
        if (count >= UINT32_MAX)
            return in_.error(ErrorCode::unsupported, "there are more than 4294967294 points");
        std::vector<double> values;
        if (auto trouble = in_.read_numbers(3 * count, type, values)) return trouble;
        for (std::size_t i = 0; i < count; ++i) {
            const Point3 p{values[3 * i], values[3 * i + 1], values[3 * i + 2]};
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                return in_.error(
                    ErrorCode::bad_number,
                    fmt::format("point {} has a coordinate that is not a finite number", i));
            vertices_.push_back(p);
        }
        return std::nullopt;
    }

    /// Reads cells: "3 0 1 2" one after the other, or, from version 5 on, OFFSETS and CONNECTIVITY.
    MaybeError read_cells(LegacyCells& cells) {
        cells.at = in_.place();
        std::size_t first = 0, second = 0;
        if (auto trouble = in_.read_count(first)) return trouble;
        if (auto trouble = in_.read_count(second)) return trouble;
        if (in_.takes("offsets")) return read_offsets(first, second, cells);
        std::vector<std::int64_t> numbers;
        if (auto trouble = in_.read_numbers(second, legacy_int, numbers)) return trouble;
        std::size_t at = 0;
        for (std::size_t c = 0; c < first; ++c) {
            if (at >= numbers.size() || numbers[at] < 0 ||
                static_cast<std::size_t>(numbers[at]) >= numbers.size() - at)
                return in_.error_at(cells.at, ErrorCode::bad_index,
                                    fmt::format("cell {} is not within the {} numbers", c, second));
            const auto start = numbers.begin() + static_cast<std::ptrdiff_t>(at) + 1;
            cells.corners.insert(cells.corners.end(), start, start + numbers[at]);
            cells.ends.push_back(static_cast<std::int64_t>(cells.corners.size()));
            at += 1 + static_cast<std::size_t>(numbers[at]);
        }
        return std::nullopt;
    }

    MaybeError read_offsets(std::size_t offsets, std::size_t corners, LegacyCells& cells) {
        LegacyType type{};
        if (auto trouble = in_.read_type(type)) return trouble;
        if (auto trouble = in_.read_numbers(offsets, type, cells.ends)) return trouble;
        if (!same_ignoring_case(in_.token(), "connectivity"))
            return in_.error(ErrorCode::bad_syntax, "CONNECTIVITY is needed here");
        if (auto trouble = in_.read_type(type)) return trouble;
        if (auto trouble = in_.read_numbers(corners, type, cells.corners)) return trouble;
        std::int64_t last = 0;
        for (const std::int64_t end : cells.ends) {
            if (end < last || end > static_cast<std::int64_t>(cells.corners.size()))
                return in_.error_at(
                    cells.at, ErrorCode::bad_index,
                    fmt::format("the offset {} is not in the data of the cells", end));
            last = end;
        }
        if (!cells.ends.empty() && cells.ends.front() == 0) cells.ends.erase(cells.ends.begin());
        return std::nullopt;
    }

    /// Reads the types of the cells of a grid, as kinds. Fails at cells with curved sides.
    MaybeError read_types() {
        const auto at = in_.place();
        std::size_t count = 0;
        std::vector<std::int64_t> types;
        if (auto trouble = in_.read_count(count)) return trouble;
        if (auto trouble = in_.read_numbers(count, legacy_int, types)) return trouble;
        for (const std::int64_t type : types) {
            kinds_.push_back(kind_of_cell(type));
            if (kinds_.back() == CellKind::passed_over || kinds_.back() == CellKind::tetrahedron)
                ++other_cells_;
            if (kinds_.back() == CellKind::curved && !for_tetrahedra_)
                return in_.error_at(at, ErrorCode::unsupported,
                                    fmt::format("cell {} is of type {}, with curved sides, which "
                                                "is not read",
                                                kinds_.size() - 1, type));
        }
        return std::nullopt;
    }

    [[nodiscard]] std::size_t cell_count() const {
        std::size_t count = other_polydata_ + (structured_ ? cells_of(*structured_) : 0);
        for (const auto* sections : {&polygons_, &strips_})
            for (const LegacyCells& cells : *sections) count += cells.ends.size();
        return count;
    }

    /// Reads the arrays of cells and points, of which the first section is the current one.
    MaybeError read_attributes(const std::string& section) {
        return arrays_.read(section, vertices_.size(), cell_count());
    }

    /// Reads names, and of which surfaces polygons are; `section`: the first after the geometry, or empty.
    MaybeError read_names(const std::string& section) {
        const auto names = arrays_.texts("surface_name"), roles = arrays_.texts("surface_role");
        for (std::size_t s = 0; s < names.size(); ++s) {
            FilePart& part = parts_.emplace_back();
            part.name = names[s].empty() ? std::string(name_) : names[s];
            for (std::size_t r = 0; r < role_names.size(); ++r)
                if (s < roles.size() && roles[s] == role_names[r]) part.role = Role(r);
        }
        if (parts_.empty()) {
            parts_.push_back({std::string(name_)});
            (void)read_attributes(section); // the geometry is complete
            return std::nullopt;
        }
        has_lists_ = arrays_.has_field("surfaces") || arrays_.has_field("surfaces_offset");
        if (has_lists_) { // the array of cells has nothing to add
            (void)read_attributes(section);
            return std::nullopt;
        }
        if (auto trouble = read_attributes(section)) return trouble;
        if (!arrays_.has_of_cells("surface")) return std::nullopt;
        surface_of_ = arrays_.of_cells("surface");
        std::size_t kept = 0; // of a grid only polygons count
        for (std::size_t c = 0; c < std::min(kinds_.size(), surface_of_.size()); ++c)
            if (kinds_[c] == CellKind::polygon) surface_of_[kept++] = surface_of_[c];
        if (is_grid_) surface_of_.resize(kept);
        has_numbers_ = true;
        return std::nullopt;
    }

    MaybeError make_triangles() {
        if (is_structured_ && !for_tetrahedra_) return add_structured();
        cells_ = other_polydata_;
        for (const LegacyCells& cells : polygons_)
            if (auto trouble = add(cells, CellKind::polygon)) return trouble;
        for (const LegacyCells& cells : strips_)
            if (auto trouble = add(cells, CellKind::strip)) return trouble;
        return std::nullopt;
    }

    /// Adds cells: those of a grid by their kinds, others as `kind`.
    MaybeError add(const LegacyCells& cells, CellKind kind) {
        std::size_t polygons = 0;
        if (is_grid_)
            polygons = static_cast<std::size_t>(std::ranges::count(kinds_, CellKind::polygon));
        else if (kind == CellKind::polygon)
            polygons = cells.ends.size();
        if (kind == CellKind::polygon && has_lists_ && !lists_are_sound(polygons))
            return Error{ErrorCode::bad_index, "the lists of surfaces do not fit the triangles",
                         std::string(in_.source())};
        std::vector<std::uint32_t> corners;
        std::int64_t start = 0;
        std::size_t polygon = 0;
        const std::size_t first = cells_; // of the section, among all cells
        cells_ += cells.ends.size();
        for (std::size_t c = 0; c < cells.ends.size(); ++c) {
            if (auto trouble = read_corners(cells, c, start, corners)) return trouble;
            start = cells.ends[c];
            if (is_grid_ && c >= kinds_.size())
                return in_.error_at(cells.at, ErrorCode::bad_index,
                                    fmt::format("CELL_TYPES has no type for cell {}", c));
            if (for_tetrahedra_) {
                if (auto trouble = add_tetrahedron(c, cells.at, corners)) return trouble;
            } else if (auto trouble = add_cell(is_grid_ ? kinds_[c] : kind, cells.at, polygon,
                                               static_cast<std::uint32_t>(first + c), corners)) {
                return trouble;
            }
        }
        return std::nullopt;
    }

    MaybeError read_corners(const LegacyCells& cells, std::size_t c, std::int64_t start,
                            std::vector<std::uint32_t>& corners) const {
        corners.clear();
        for (; start < cells.ends[c]; ++start) {
            const std::int64_t v = cells.corners[static_cast<std::size_t>(start)];
            if (v < 0 || v >= static_cast<std::int64_t>(vertices_.size()))
                return in_.error_at(cells.at, ErrorCode::bad_index,
                                    fmt::format("cell {} names point {}, but there are {}", c, v,
                                                vertices_.size()));
            corners.push_back(static_cast<std::uint32_t>(v));
        }
        return std::nullopt;
    }

    /// Adds a cell to its surfaces; `polygon` is its number, if it is a polygon, and is counted on; `cell`: its
    /// number among all cells.
    MaybeError add_cell(CellKind kind, std::size_t at, std::size_t& polygon, std::uint32_t cell,
                        const std::vector<std::uint32_t>& corners) {
        FilePart& first = parts_[0];
        if (kind == CellKind::strip) append_strip(corners, first, cell);
        if (kind == CellKind::pixel && corners.size() == 4)
            append_face(std::array{corners[0], corners[1], corners[3], corners[2]}, first, cell);
        if (kind != CellKind::polygon) return std::nullopt;
        const std::size_t k = polygon++;
        if (has_lists_) return add_to_lists(at, k, cell, corners);
        if (!has_numbers_) {
            append_face(corners, first, cell);
            return std::nullopt;
        }
        if (k >= surface_of_.size())
            return in_.error_at(at, ErrorCode::bad_index,
                                fmt::format("the array surface has no value for polygon {}", k));
        const double s = surface_of_[k];
        if (!(s >= 0 && s < static_cast<double>(parts_.size())))
            return in_.error_at(
                at, ErrorCode::bad_index,
                fmt::format("polygon {} is of surface {}, but there are {}", k, s, parts_.size()));
        append_face(corners, parts_[static_cast<std::size_t>(s)], cell);
        return std::nullopt;
    }

    MaybeError add_tetrahedron(std::size_t c, std::size_t at,
                               const std::vector<std::uint32_t>& corners) {
        if (!is_grid_ || kinds_[c] != CellKind::tetrahedron) return std::nullopt;
        append_tetrahedron(corners, tetrahedra_);
        if (labels_.empty()) return std::nullopt;
        if (c < labels_.size() && append_label(labels_[c], tetrahedra_)) return std::nullopt;
        return in_.error_at(at, ErrorCode::bad_number,
                            fmt::format("the label of cell {} is no number of 32 bits", c));
    }

    /// Tells whether the lists of surfaces fit this number of polygons.
    [[nodiscard]] bool lists_are_sound(std::size_t polygons) {
        const auto& offsets = arrays_.field("surfaces_offset");
        const auto& lists = arrays_.field("surfaces");
        bool sound = offsets.size() == polygons + 1 && offsets.front() == 0 &&
                     offsets.back() == static_cast<double>(lists.size()) &&
                     std::is_sorted(offsets.begin(), offsets.end());
        for (const double offset : offsets)
            sound = sound && offset >= 0 && offset <= static_cast<double>(lists.size());
        for (const double s : lists)
            sound = sound && s >= 0 && s < static_cast<double>(parts_.size());
        return sound;
    }

    /// Gives a polygon to the surfaces in its list.
    MaybeError add_to_lists(std::size_t at, std::size_t k, std::uint32_t cell,
                            const std::vector<std::uint32_t>& corners) {
        const auto& offsets = arrays_.field("surfaces_offset");
        const auto& lists = arrays_.field("surfaces");
        const auto begin = static_cast<std::size_t>(offsets[k]),
                   end = static_cast<std::size_t>(offsets[k + 1]);
        // Larger polygons in many surfaces each would make more triangles than the file has data.
        if (corners.size() > 3 && end > begin + 1)
            return in_.error_at(
                at, ErrorCode::unsupported,
                fmt::format("polygon {} is of several surfaces, but no triangle", k));
        for (std::size_t i = begin; i < end; ++i)
            append_face(corners, parts_[static_cast<std::size_t>(lists[i])], cell);
        return std::nullopt;
    }

    LegacyVtkScanner in_;
    LegacyVtkArrays arrays_{in_};
    std::string_view name_;
    bool for_tetrahedra_ = false;   ///< instead of surfaces
    LabelledTetrahedra tetrahedra_; ///< without vertices
    std::vector<double> labels_;    ///< per cell; or none
    bool is_grid_ = false, is_structured_ = false;
    std::optional<StructuredSize> structured_; ///< points of a structured surface
    std::size_t other_polydata_ = 0; ///< points and lines of POLYDATA, whose values come first
    std::size_t cells_ = 0;          ///< whose triangles are made
    std::vector<Point3> vertices_;
    std::vector<LegacyCells> polygons_, strips_; ///< of a grid: all cells, and none
    std::vector<CellKind> kinds_;                ///< of the cells of a grid
    std::size_t other_cells_ = 0;                ///< of a grid: points, lines and volumes
    std::vector<FilePart> parts_;
    std::vector<double> surface_of_;               ///< per polygon
    bool has_lists_ = false, has_numbers_ = false; ///< that tell the surfaces of polygons
};

} // namespace

Result<std::vector<Surface>> read_vtk(std::string_view contents, std::string_view source,
                                      std::string_view name) {
    return LegacyVtkReader(contents, source, name).read();
}

Result<LabelledTetrahedra> read_vtk_tetrahedra(std::string_view contents, std::string_view source) {
    return LegacyVtkReader(contents, source, "").read_tetrahedra();
}

} // namespace terrane
