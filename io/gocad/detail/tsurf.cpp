// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/gocad/gocad_objects.hpp>
#include <terrane/io/gocad/vertex_properties.hpp>

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

#include <terrane/io/text/units.hpp>

namespace terrane::detail {

namespace {

/// Maps ids of vertices to indices. Consecutive ids, which are the rule, need no table.
class IdMap {
public:
    /// Returns false if the id exists already.
    bool add(std::int64_t id, std::uint32_t index) {
        if (count_ == 0) first_ = id;
        if (dense_ && index == count_ && id - first_ == count_) return ++count_ != 0;
        if (dense_) spread();
        return indices_.emplace(id, index).second;
    }

    [[nodiscard]] std::optional<std::uint32_t> find(std::int64_t id) const {
        if (dense_) {
            const bool inside = id >= first_ && id - first_ < count_;
            return inside ? std::optional(static_cast<std::uint32_t>(id - first_)) : std::nullopt;
        }
        const auto found = indices_.find(id);
        return found == indices_.end() ? std::nullopt : std::optional(found->second);
    }

private:
    void spread() {
        dense_ = false;
        for (std::uint32_t i = 0; i < count_; ++i) indices_.emplace(first_ + i, i);
    }

    std::int64_t first_ = 0;
    std::uint32_t count_ = 0; ///< while dense_: id first_ + i is mapped to i
    bool dense_ = true;
    std::unordered_map<std::int64_t, std::uint32_t> indices_;
};

/// Tells whether a name in a coordinate system says nothing about it: GOCAD gives such names to
/// systems of its own, after how an object was made ("from_Shape") or the program ("gocad Local").
bool says_nothing(std::string_view name) {
    const auto text = lower(trimmed(name));
    for (const char* nothing : {"", "default", "unknown", "undefined", "none", "local",
                                "gocad local", "skua local", "pdgm_epic local"})
        if (text == nothing) return true;
    return text.starts_with("from_");
}

class TsurfReader {
public:
    TsurfReader(LineParser& in, TsurfObject& object) : in_(in), object_(object) {}

    MaybeError read();

private:
    /// A corner of a triangle whose id is not defined yet.
    struct Ahead {
        std::int64_t id;
        std::size_t triangle;
        std::size_t corner;
        std::size_t line;
    };
    /// An ATOM whose vertex is not defined yet.
    struct Atom {
        std::int64_t target;
        std::size_t line;
    };

    MaybeError read_line(std::string_view keyword, Tokens tokens);
    MaybeError read_attribute(std::string_view keyword, const Tokens& tokens);
    MaybeError read_zpositive(std::string_view value);
    MaybeError read_vertex(std::string_view keyword, Tokens tokens);
    MaybeError read_atom(std::string_view keyword, Tokens tokens);
    MaybeError read_triangle(Tokens tokens);
    MaybeError read_id(std::string_view token, std::string_view keyword, std::int64_t& id) const;
    MaybeError add_id(std::int64_t id, std::uint32_t index);
    MaybeError resolve_atom(std::int64_t id);
    MaybeError resolve_all();
    [[nodiscard]] Error no_vertex(std::size_t line, std::int64_t id) const;
    void read_names();
    void read_units(Tokens tokens);
    void read_system(std::string_view keyword, std::string_view value);
    void turn_z_up();

    LineParser& in_;
    TsurfObject& object_;
    bool again_ = false; ///< the current line is not processed yet
    IdMap ids_;
    VertexProperties properties_;
    std::map<std::int64_t, Atom> atoms_;
    std::vector<Ahead> ahead_;
};

MaybeError TsurfReader::read() {
    while (again_ || in_.next()) {
        again_ = false;
        Tokens tokens(in_.line());
        const auto keyword = tokens.next();
        if (keyword == "END") {
            if (auto trouble = resolve_all()) return trouble;
            turn_z_up();
            properties_.end(object_.surface);
            return std::nullopt;
        }
        if (keyword == "GOCAD") break;
        if (auto trouble = read_line(keyword, tokens)) return trouble;
    }
    return no_end(in_, object_.line);
}

MaybeError TsurfReader::read_line(std::string_view keyword, Tokens tokens) {
    if (keyword == "TRGL") return read_triangle(tokens);
    if (keyword == "VRTX" || keyword == "PVRTX") return read_vertex(keyword, tokens);
    if (keyword == "ATOM" || keyword == "PATOM") return read_atom(keyword, tokens);
    if (keyword == "TFACE") {
        object_.part_begins.push_back(static_cast<std::uint32_t>(object_.surface.triangles.size()));
        return std::nullopt;
    }
    if (keyword.starts_with('#')) return std::nullopt;
    if (in_.line().find('{') != std::string_view::npos) read_names();
    return read_attribute(keyword, tokens);
}

/// Reads a block; takes the names from it if it is a header.
void TsurfReader::read_names() {
    const bool header = Tokens(in_.line()).next().starts_with("HEADER");
    GocadNames names;
    again_ = read_block(in_, names);
    if (!header) return;
    if (!names.name.empty()) object_.surface.name = names.name;
    if (!names.name_in_model.empty()) object_.name_in_model = names.name_in_model;
}

MaybeError TsurfReader::read_attribute(std::string_view keyword, const Tokens& tokens) {
    if (keyword == "GEOLOGICAL_TYPE") object_.surface.role = role_of_feature(tokens.rest());
    if (keyword == "ZPOSITIVE") return read_zpositive(tokens.rest());
    if (keyword == "AXIS_UNIT") read_units(tokens);
    properties_.read_header(keyword, tokens.rest());
    read_system(keyword, tokens.rest());
    return std::nullopt;
}

void TsurfReader::read_units(Tokens tokens) {
    object_.units.clear();
    std::vector<std::string> units;
    for (auto unit = tokens.next(); !unit.empty(); unit = tokens.next()) {
        units.push_back(unquoted(unit));
        object_.units += (object_.units.empty() ? "" : " ") + units.back();
    }
    CoordinateFrame& frame = object_.surface.frame;
    if (!units.empty()) frame.horizontal_unit = unit_named(units[0]);
    if (units.size() > 2) frame.vertical_unit = unit_named(units[2]);
}

/// Takes NAME, PROJECTION and DATUM within the coordinate system, unless they say nothing.
void TsurfReader::read_system(std::string_view keyword, std::string_view value) {
    if (keyword == "GOCAD_ORIGINAL_COORDINATE_SYSTEM") object_.in_system = true;
    if (keyword == "END_ORIGINAL_COORDINATE_SYSTEM") object_.in_system = false;
    if (!object_.in_system || (keyword != "NAME" && keyword != "PROJECTION" && keyword != "DATUM"))
        return;
    const auto text = unquoted(value);
    if (says_nothing(text)) return;
    object_.surface.frame.system += (object_.surface.frame.system.empty() ? "" : ", ") + text;
}

MaybeError TsurfReader::read_zpositive(std::string_view value) {
    const bool depth = same_ignoring_case(unquoted(value), "Depth");
    object_.surface.frame.vertical_axis = depth ? VerticalAxis::down : VerticalAxis::up;
    if (depth || same_ignoring_case(unquoted(value), "Elevation")) return std::nullopt;
    return in_.error(ErrorCode::bad_syntax,
                     "ZPOSITIVE must be Elevation or Depth, not " + shown(value));
}

MaybeError TsurfReader::read_id(std::string_view token, std::string_view keyword,
                                std::int64_t& id) const {
    if (parse_integer(token, id) && id >= 0) return std::nullopt;
    if (token.empty())
        return in_.error(ErrorCode::bad_syntax, fmt::format("{} needs {}", keyword,
                                                            keyword == "TRGL"           ? "3 ids"
                                                            : keyword.ends_with("ATOM") ? "2 ids"
                                                                                        : "an id"));
    return in_.error(ErrorCode::bad_syntax, shown(token) + " is not an id");
}

MaybeError TsurfReader::add_id(std::int64_t id, std::uint32_t index) {
    if (!atoms_.contains(id) && ids_.add(id, index)) return std::nullopt;
    return in_.error(ErrorCode::bad_syntax, fmt::format("vertex {} is defined twice", id));
}

MaybeError TsurfReader::read_vertex(std::string_view keyword, Tokens tokens) {
    std::int64_t id = 0;
    if (auto trouble = read_id(tokens.next(), keyword, id)) return trouble;
    auto& vertices = object_.surface.vertices;
    if (auto trouble = add_id(id, static_cast<std::uint32_t>(vertices.size()))) return trouble;
    if (auto trouble = in_.read_point(tokens, keyword, vertices.emplace_back())) return trouble;
    properties_.read_vertex(in_, tokens);
    return std::nullopt;
}

MaybeError TsurfReader::read_atom(std::string_view keyword, Tokens tokens) {
    std::int64_t id = 0;
    std::int64_t target = 0;
    if (auto trouble = read_id(tokens.next(), keyword, id)) return trouble;
    if (auto trouble = read_id(tokens.next(), keyword, target)) return trouble;
    if (const auto index = ids_.find(target)) return add_id(id, *index);
    if (ids_.find(id) || !atoms_.emplace(id, Atom{target, in_.number()}).second)
        return in_.error(ErrorCode::bad_syntax, fmt::format("vertex {} is defined twice", id));
    return std::nullopt;
}

MaybeError TsurfReader::read_triangle(Tokens tokens) {
    auto& triangles = object_.surface.triangles;
    auto& triangle = triangles.emplace_back();
    for (std::size_t corner = 0; corner < 3; ++corner) {
        std::int64_t id = 0;
        if (auto trouble = read_id(tokens.next(), "TRGL", id)) return trouble;
        if (const auto index = ids_.find(id))
            triangle[corner] = *index;
        else
            ahead_.push_back({id, triangles.size() - 1, corner, in_.number()});
    }
    return std::nullopt;
}

Error TsurfReader::no_vertex(std::size_t line, std::int64_t id) const {
    return in_.error_at(line, ErrorCode::bad_index,
                        fmt::format("vertex {} is not defined in this object", id));
}

/// Follows a chain of ATOMs to its vertex, then defines every ATOM of the chain.
MaybeError TsurfReader::resolve_atom(std::int64_t id) {
    std::vector<std::int64_t> chain;
    auto index = ids_.find(id);
    while (!index) {
        const auto atom = atoms_.find(id);
        if (atom == atoms_.end()) return no_vertex(atoms_.at(chain.back()).line, id);
        if (chain.size() == atoms_.size())
            return in_.error_at(atom->second.line, ErrorCode::bad_index,
                                fmt::format("ATOM {} refers to itself", id));
        chain.push_back(id);
        id = atom->second.target;
        index = ids_.find(id);
    }
    for (const auto atom : chain) ids_.add(atom, *index);
    return std::nullopt;
}

MaybeError TsurfReader::resolve_all() {
    for (const auto& [id, atom] : atoms_)
        if (auto trouble = resolve_atom(id)) return trouble;
    for (const auto& [id, triangle, corner, line] : ahead_) {
        const auto index = ids_.find(id);
        if (!index) return no_vertex(line, id);
        object_.surface.triangles[triangle][corner] = *index;
    }
    return std::nullopt;
}

void TsurfReader::turn_z_up() {
    if (object_.surface.frame.vertical_axis != VerticalAxis::down) return;
    for (auto& vertex : object_.surface.vertices) vertex.z = vertex.z == 0 ? 0 : -vertex.z;
}

} // namespace

MaybeError read_tsurf(LineParser& in, TsurfObject& object) {
    return TsurfReader(in, object).read();
}

} // namespace terrane::detail
