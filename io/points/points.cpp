// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/points/points.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include <terrane/algorithms/triangulation/point_surface.hpp>
#include <terrane/io/gocad/gocad_objects.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

constexpr std::size_t most_columns = 64;

bool is_no_height(double z) {
    return std::abs(z) >= 1e29 || z == -99999 || z == -9999 || z == -999.25;
}

/// Splits a line into its columns and removes quotes.
std::vector<std::string_view> columns_of(std::string_view line) {
    const auto separates = [](char c) { return is_blank(c) || c == ',' || c == ';'; };
    std::vector<std::string_view> columns;
    std::size_t i = 0;
    while (i < line.size() && columns.size() < most_columns) {
        if (separates(line[i])) {
            ++i;
            continue;
        }
        const bool quoted = line[i] == '"';
        const auto begin = quoted ? i + 1 : i;
        auto end = begin;
        while (end < line.size() && (quoted ? line[end] != '"' : !separates(line[end]))) ++end;
        columns.push_back(line.substr(begin, end - begin));
        i = quoted ? end + 1 : end;
    }
    return columns;
}

bool is_number(std::string_view token) {
    double value = 0;
    return parse_double(token, value) != NumberState::not_a_number;
}

class PointReader {
public:
    PointReader(std::string_view contents, std::string_view source) : in_(contents, source) {}

    /// Reads one surface, or one for each text in front of the numbers, in file order.
    MaybeError read(std::vector<Surface>& surfaces) {
        while (in_.next()) {
            const auto line = trimmed(in_.line());
            if (line.empty()) continue;
            if (line == "EOD" || line == "EOB") break;
            if (is_comment(line)) {
                look_for_names(line);
            } else if (auto trouble = read_line(line, surfaces)) {
                return trouble;
            }
        }
        if (surfaces.empty()) return in_.file_error(ErrorCode::nothing_to_do, "there is no point");
        return std::nullopt;
    }

private:
    static bool is_comment(std::string_view line) {
        return line.starts_with('#') || line.starts_with('!') || line.starts_with('@') ||
               line.starts_with("//");
    }

    /// Returns the index of the first of the wanted names that a column has, if any.
    static std::optional<std::size_t> place_of(const std::vector<std::string>& names,
                                               std::initializer_list<std::string_view> wanted) {
        for (const auto name : wanted)
            for (std::size_t i = 0; i < names.size(); ++i)
                if (names[i] == name) return i;
        return std::nullopt;
    }

    void look_for_names(std::string_view line) {
        if (chosen_) return;
        while (!line.empty() && std::string_view("#!@/ \t").find(line[0]) != std::string_view::npos)
            line.remove_prefix(1);
        std::vector<std::string> names;
        for (const auto column : columns_of(line)) names.push_back(lower(column));
        const auto x = place_of(names, {"x", "easting", "x_coord", "inline"});
        const auto y = place_of(names, {"y", "northing", "y_coord", "crossline", "xline"});
        const auto z = place_of(names, {"z", "elevation", "depth", "z_coord"});
        if (x && y && z) named_ = {*x, *y, *z};
    }

    MaybeError read_line(std::string_view line, std::vector<Surface>& surfaces) {
        auto columns = columns_of(line);
        const bool words = !columns.empty() && !is_number(columns[0]);
        if (!chosen_ && words && line[0] != '"') { // a heading
            look_for_names(line);
            return std::nullopt;
        }
        const auto first = std::find_if(columns.begin(), columns.end(), is_number);
        const auto name = words ? columns[0] : std::string_view();
        columns.erase(columns.begin(), first);
        if (!chosen_) choose(columns.size());
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
        if (!ends_line && !is_no_height(p[2]))
            surface_named(name, surfaces).vertices.push_back({p[0], p[1], p[2]});
        return std::nullopt;
    }

    Surface& surface_named(std::string_view name, std::vector<Surface>& surfaces) {
        const auto [at, added] = surface_of_.try_emplace(std::string(name), surfaces.size());
        if (added) surfaces.emplace_back().name = name;
        return surfaces[at->second];
    }

    void choose(std::size_t count) {
        if (named_) {
            chosen_ = named_;
        } else {
            const std::size_t skipped = count == 5 ? 2 : 0;
            chosen_ = {skipped, skipped + 1, skipped + 2};
        }
    }

    LineParser in_;
    std::optional<std::array<std::size_t, 3>> named_;  ///< columns of x, y, z from a heading
    std::optional<std::array<std::size_t, 3>> chosen_; ///< columns in use, set at the first point
    std::map<std::string, std::size_t> surface_of_;    ///< index by the text in front
};

Result<std::vector<Surface>> connected(std::vector<Surface> surfaces, std::string_view source,
                                       const ReadOptions& options) {
    bool any = false;
    for (Surface& s : surfaces) {
        if (options.depth)
            for (Point3& p : s.vertices) p.z = p.z == 0 ? 0 : -p.z;
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
    GocadPointReader(std::string_view contents, std::string_view source) : in_(contents, source) {}

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
            if (auto trouble = read_object(surfaces[line ? *lines : surfaces.size() - 1]))
                return trouble;
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
            return in_.read_point(tokens, keyword, surface.vertices.emplace_back());
        }
        if (keyword.starts_with('#')) return std::nullopt;
        if (keyword == "ZPOSITIVE") {
            depth = same_ignoring_case(unquoted(tokens.rest()), "Depth");
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
    bool again_ = false; ///< the current line is not processed yet
};

template <class Reader>
Result<std::vector<Surface>> read_by(std::string_view contents, std::string_view source,
                                     std::string_view name, const ReadOptions& options) {
    std::vector<Surface> surfaces;
    if (auto trouble = Reader(contents, source).read(surfaces)) return *trouble;
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
