// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/points/points.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <terrane/algorithms/triangulation/point_surface.hpp>
#include <terrane/io/gocad/gocad_objects.hpp>
#include <terrane/io/gocad/vertex_properties.hpp>
#include <terrane/io/points/detail/column_values.hpp>
#include <terrane/io/points/detail/heading.hpp>
#include <terrane/io/points/detail/point_lines.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/units.hpp>

namespace terrane {

using namespace detail;
using namespace points::detail;

namespace {

class PointReader {
public:
    PointReader(std::string_view contents, std::string_view source, const ReadOptions& options) :
        stated_(options.columns), commas_(meaning_of_commas(contents)),
        with_points_(with_points(contents)),
        in_(commas_ == Commas::decimal ? std::string_view(with_points_) : contents, source) {}

    /// Reads one surface, or one for each text in front of the numbers, in file order.
    MaybeError read(std::vector<Surface>& surfaces) {
        if (commas_ == Commas::unclear)
            return in_.file_error(
                ErrorCode::bad_syntax,
                "the commas in numbers may be decimal points or divide thousands; "
                "separate columns by semicolons, or write points");
        while (in_.next()) {
            const auto line = trimmed(in_.line());
            if (line.empty()) continue;
            if (ends_points(line)) break;
            if (names_columns(line)) continue;
            if (is_comment(line)) {
                look_for_names(line);
            } else if (auto trouble = read_line(line, surfaces)) {
                return trouble;
            }
        }
        if (surfaces.empty()) return in_.file_error(ErrorCode::nothing_to_do, "there is no point");
        for (std::size_t s = 0; s < surfaces.size(); ++s) values_[s].end(surfaces[s]);
        return std::nullopt;
    }

private:
    /// Replaces decimal commas by points; returns nothing where commas separate columns.
    [[nodiscard]] std::string with_points(std::string_view contents) const {
        std::string text;
        if (commas_ != Commas::decimal) return text;
        text = contents;
        std::ranges::replace(text, ',', '.');
        return text;
    }

    /// Takes a line that names one column: "# Field: 3 z meters" of EarthVision, or a line between
    /// BEGIN HEADER and END HEADER of Petrel, "INT,Inline". Tells whether it is one of these lines.
    bool names_columns(std::string_view line) {
        if (chosen_) return false;
        Tokens tokens(line);
        const auto first = tokens.next();
        if (in_header_ || first == "BEGIN") {
            if (line == "BEGIN HEADER" || line == "END HEADER") {
                in_header_ = line == "BEGIN HEADER";
                if (in_header_) fields_.clear();
                return true;
            }
            if (in_header_) fields_.emplace_back(trimmed(line.substr(line.rfind(',') + 1)));
            return in_header_;
        }
        std::int64_t number = 0;
        if (first != "#" || tokens.next() != "Field:" || !parse_integer(tokens.next(), number) ||
            number != static_cast<std::int64_t>(fields_.size()) + 1)
            return false;
        const auto name = tokens.next(), unit = tokens.next();
        fields_.push_back(metres_in(unit_named(unit)) ? fmt::format("{} ({})", name, unit)
                                                      : std::string(name));
        return true;
    }

    void look_for_names(std::string_view line) {
        if (chosen_) return;
        while (!line.empty() && std::string_view("#!@/ \t").find(line[0]) != std::string_view::npos)
            line.remove_prefix(1);
        if (stated_.are_numbers()) return;
        if (auto heading = read_heading(line, stated_)) heading_ = std::move(heading);
    }

    MaybeError read_line(std::string_view line, std::vector<Surface>& surfaces) {
        if (chosen_ && by_heading_) return read_cells(line, surfaces);
        if (stated_.are_numbers()) {
            heading_ = stated_.heading_of_cells(line);
            if (!heading_) return std::nullopt; // a line before the points
            by_heading_ = true;
            chosen_ = heading_->xyz;
            return read_cells(line, surfaces);
        }
        auto columns = columns_of(line);
        const bool words = !columns.empty() && !is_number(columns[0]);
        if (!chosen_ && !fields_.empty() && std::ranges::any_of(columns, is_number)) {
            heading_ = heading_of(fields_, stated_);
            if (!heading_)
                return in_.error(ErrorCode::bad_syntax,
                                 fmt::format("the header names the columns {}{}",
                                             fmt::join(fields_, ", "), which_are_xyz()));
            fields_.clear();
        }
        if (!chosen_ && fits_heading(line)) {
            by_heading_ = true;
            chosen_ = heading_->xyz;
            return read_cells(line, surfaces);
        }
        if (!chosen_ && words && (line[0] != '"' || std::ranges::none_of(columns, is_number))) {
            look_for_names(line);
            last_words_ = line;
            return std::nullopt;
        }
        if (!chosen_ && !heading_ && !last_words_.empty())
            if (const auto named = unclear_columns(last_words_, line))
                return in_.error(
                    ErrorCode::bad_syntax,
                    fmt::format("the heading names the columns {}{}", *named, which_are_xyz()));
        if (!chosen_ && !heading_ && stated_.are_stated())
            return in_.error(ErrorCode::bad_syntax, "no heading" + which_are_xyz());
        const auto first = std::find_if(columns.begin(), columns.end(), is_number);
        const auto name = words ? columns[0] : std::string_view();
        columns.erase(columns.begin(), first);
        if (!chosen_) choose(columns.size());
        return read_point(columns, name, surfaces);
    }

    /// Tells whether a line has all columns of a heading that names surfaces or has cells, and is a
    /// point.
    [[nodiscard]] bool fits_heading(std::string_view line) const {
        if (!heading_) return false;
        const auto cells = cells_under_heading(line);
        if (cells.size() != heading_->columns) return false;
        return std::ranges::all_of(heading_->xyz,
                                   [&](std::size_t i) {
                                       return cells[i].empty() ? heading_->delimiter != ' '
                                                               : is_number(cells[i]);
                                   }) &&
               is_number(cells[heading_->xyz[0]]);
    }

    [[nodiscard]] std::vector<std::string_view> cells_under_heading(std::string_view line) const {
        return heading_->delimiter == ' ' ? columns_of(line) : cells_of(line, heading_->delimiter);
    }

    /// Reads a line with the columns of the heading. A point without a height is skipped.
    MaybeError read_cells(std::string_view line, std::vector<Surface>& surfaces) {
        const auto cells = cells_under_heading(line);
        const bool empty = chosen_->at(2) < cells.size() && cells[chosen_->at(2)].empty();
        if (empty) return std::nullopt;
        const auto name = heading_->name && *heading_->name < cells.size() ? cells[*heading_->name]
                                                                           : std::string_view();
        return read_point(cells, name, surfaces);
    }

    MaybeError read_point(const std::vector<std::string_view>& columns, std::string_view name,
                          std::vector<Surface>& surfaces) {
        std::array<double, 3> p{};
        for (std::size_t i = 0; i < 3; ++i) {
            if (chosen_->at(i) >= columns.size())
                return in_.error(
                    ErrorCode::bad_syntax,
                    fmt::format("a point needs {} numbers",
                                *std::max_element(chosen_->begin(), chosen_->end()) + 1));
            if (auto trouble = in_.read_number(columns[chosen_->at(i)], p[i])) return trouble;
        }
        const bool ends_line = p[0] == 999 && p[1] == 999 && p[2] == 999;
        if (ends_line || is_no_height(p[2])) return std::nullopt;
        Surface& surface = surface_named(name, surfaces);
        surface.vertices.push_back({p[0], p[1], p[2]});
        if (heading_ && by_heading_)
            values_[static_cast<std::size_t>(&surface - surfaces.data())].add(columns);
        return std::nullopt;
    }

    Surface& surface_named(std::string_view name, std::vector<Surface>& surfaces) {
        const auto [at, added] = surface_of_.try_emplace(std::string(name), surfaces.size());
        if (added) {
            Surface& surface = surfaces.emplace_back();
            surface.name = name;
            if (heading_) surface.frame = heading_->frame;
            values_.push_back(heading_ ? ColumnValues(*heading_) : ColumnValues());
            if (heading_ && by_heading_ && !name.empty()) surface.role = heading_->role;
        }
        return surfaces[at->second];
    }

    void choose(std::size_t count) {
        if (heading_) {
            chosen_ = heading_->xyz;
        } else {
            const std::size_t skipped = count == 5 ? 2 : 0;
            chosen_ = {skipped, skipped + 1, skipped + 2};
        }
    }

    /// Ends a sentence about columns that are not found.
    [[nodiscard]] std::string which_are_xyz() const {
        if (stated_.are_stated())
            return fmt::format(" that names {}", fmt::join(stated_.names(), ", "));
        return ", and not which of them are x, y and z: state them (--columns 3,4,5 or their "
               "names), or call them so, or easting, northing, elevation, depth";
    }

    const StatedColumns stated_;
    Commas commas_;
    std::string with_points_; ///< the contents, where commas are decimal points
    LineParser in_;
    bool in_header_ = false;
    std::vector<std::string> fields_;                  ///< columns that lines of their own name
    std::string last_words_;                           ///< the last line of words before the points
    std::optional<Heading> heading_;                   ///< the last one before the points
    bool by_heading_ = false;                          ///< lines have the columns of the heading
    std::optional<std::array<std::size_t, 3>> chosen_; ///< columns in use, set at the first point
    std::map<std::string, std::size_t> surface_of_;    ///< index by the text in front
    std::vector<ColumnValues> values_;                 ///< per surface
};

Result<std::vector<Surface>> connected(std::vector<Surface> surfaces, std::string_view source,
                                       const ReadOptions& options) {
    bool any = false;
    for (Surface& s : surfaces) {
        if (options.depth) {
            for (Point3& p : s.vertices) p.z = p.z == 0 ? 0 : -p.z;
            s.frame.vertical_axis = VerticalAxis::down;
            s.frame.column_of_depths = false;
        }
        auto triangles = connect_points(s.vertices, {.max_edge = options.max_edge});
        if (!triangles) {
            Error error = triangles.error();
            error.place = error.place.empty() ? std::string(source)
                                              : fmt::format("{}, {}", source, error.place);
            return error;
        }
        s.triangles = std::move(triangles).value();
        any = any || !s.triangles.empty();
    }
    if (!any)
        return Error{ErrorCode::nothing_to_do,
                     "no three of the points are near enough to make a triangle",
                     std::string(source)};
    return surfaces;
}

/// Reads the points of the VSet and PLine objects of a file.
class GocadPointReader {
public:
    GocadPointReader(std::string_view contents, std::string_view source, const ReadOptions&) :
        in_(contents, source) {}

    MaybeError read(std::vector<Surface>& surfaces) {
        in_.allow_d_exponents();
        std::optional<std::size_t> lines; // the surface of all PLine objects
        bool found = false;
        while (again_ || in_.next()) {
            again_ = false;
            Tokens tokens(in_.line());
            if (tokens.next() != "GOCAD") continue;
            found = true;
            const auto type = tokens.next();
            const bool line = same_ignoring_case(type, "PLine");
            if (!line && !same_ignoring_case(type, "VSet")) continue;
            if (!line || !lines) {
                if (line) lines = surfaces.size();
                surfaces.emplace_back();
            }
            Surface& surface = surfaces[line ? *lines : surfaces.size() - 1];
            properties_ = {};
            if (auto trouble = read_object(surface)) return trouble;
            if (line) // of several objects, which may have others
                properties_.end_unread(surface);
            else
                properties_.end(surface);
        }
        if (!found)
            return in_.file_error(ErrorCode::bad_syntax,
                                  "not a GOCAD file: no line begins with GOCAD");
        if (surfaces.empty())
            return in_.file_error(ErrorCode::nothing_to_do, "there is no VSet and no PLine");
        return std::nullopt;
    }

private:
    MaybeError read_object(Surface& surface) {
        const auto begin = in_.number();
        const auto first = surface.vertices.size();
        bool depth = false;
        while (again_ || in_.next()) {
            again_ = false;
            Tokens tokens(in_.line());
            const auto keyword = tokens.next();
            if (keyword == "END") {
                if (depth)
                    for (auto i = first; i < surface.vertices.size(); ++i)
                        surface.vertices[i].z =
                            surface.vertices[i].z == 0 ? 0 : -surface.vertices[i].z;
                return std::nullopt;
            }
            if (keyword == "GOCAD") break;
            if (auto trouble = read_line(keyword, tokens, surface, depth)) return trouble;
        }
        return no_end(in_, begin);
    }

    MaybeError read_line(std::string_view keyword, Tokens tokens, Surface& surface, bool& depth) {
        if (keyword == "VRTX" || keyword == "PVRTX") {
            std::int64_t id = 0;
            if (!parse_integer(tokens.next(), id) || id < 0)
                return in_.error(ErrorCode::bad_syntax, fmt::format("{} needs an id", keyword));
            if (auto trouble = in_.read_point(tokens, keyword, surface.vertices.emplace_back()))
                return trouble;
            properties_.read_vertex(in_, tokens);
            return std::nullopt;
        }
        properties_.read_header(keyword, tokens.rest());
        if (keyword.starts_with('#')) return std::nullopt;
        if (keyword == "ZPOSITIVE") {
            depth = same_ignoring_case(unquoted(tokens.rest()), "Depth");
            surface.frame.vertical_axis = depth ? VerticalAxis::down : VerticalAxis::up;
            if (!depth && !same_ignoring_case(unquoted(tokens.rest()), "Elevation"))
                return in_.error(ErrorCode::bad_syntax,
                                 "ZPOSITIVE must be Elevation or Depth, not " +
                                     shown(tokens.rest()));
        }
        if (in_.line().find('{') != std::string_view::npos) {
            GocadNames names;
            const bool header = keyword.starts_with("HEADER");
            again_ = read_block(in_, names);
            if (header && surface.name.empty()) surface.name = names.name;
        }
        return std::nullopt;
    }

    LineParser in_;
    bool again_ = false;          ///< the current line is not processed yet
    VertexProperties properties_; ///< of the current object
};

template <class Reader>
Result<std::vector<Surface>> read_by(std::string_view contents, std::string_view source,
                                     std::string_view name, const ReadOptions& options) {
    std::vector<Surface> surfaces;
    if (auto trouble = Reader(contents, source, options).read(surfaces)) return *trouble;
    for (Surface& s : surfaces)
        if (s.name.empty()) s.name = name;
    return connected(std::move(surfaces), source, options);
}

} // namespace

Result<std::vector<Surface>> read_points(std::string_view contents, std::string_view source,
                                         std::string_view name, const ReadOptions& options) {
    return read_by<PointReader>(contents, source, name, options);
}

Result<std::vector<Surface>> read_gocad_points(std::string_view contents, std::string_view source,
                                               std::string_view name, const ReadOptions& options) {
    return read_by<GocadPointReader>(contents, source, name, options);
}

} // namespace terrane
