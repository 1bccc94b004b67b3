// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/surfaces/obj.hpp>

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include <terrane/io/surfaces/parts.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

/// The limit of names on one group line keeps the size of the surfaces linear in that of the file.
constexpr std::size_t max_names = 256;

class ObjReader {
public:
    ObjReader(std::string_view contents, std::string_view source, std::string_view name) :
        in_(contents, source), default_name_(name) {}

    Result<std::vector<Surface>> read();

private:
    /// A vertex that a face named before its definition.
    struct Ahead {
        std::uint32_t vertex;
        std::size_t line;
    };

    std::string_view whole_line();
    MaybeError read_line(std::string_view line);
    MaybeError read_vertex(Tokens tokens);
    MaybeError read_face(Tokens tokens);
    MaybeError read_corner(std::string_view token, std::uint32_t& vertex);
    MaybeError begin_groups(Tokens tokens);
    void begin_group(std::string_view name);
    std::uint32_t group_named(std::string_view name);
    MaybeError check_ahead() const;
    std::vector<Surface> surfaces();

    LineParser in_;
    std::size_t line_number_ = 0; ///< where the current line begins
    std::string joined_;          ///< lines that a backslash joins
    std::string_view default_name_;
    std::vector<Point3> vertices_;
    std::vector<FilePart> groups_; ///< in order of their first line
    std::map<std::string, std::uint32_t, std::less<>> group_of_name_;
    std::vector<std::uint32_t> current_;    ///< groups of the next face; empty: the default group
    std::vector<std::uint32_t> with_faces_; ///< groups in order of their first face
    std::vector<std::uint32_t> corners_;
    std::vector<Ahead> ahead_;
    std::vector<std::string> values_; ///< see Surface
};

std::string_view ObjReader::whole_line() {
    line_number_ = in_.number();
    auto line = in_.line();
    if (!line.ends_with('\\')) return line;
    joined_.clear();
    while (line.ends_with('\\')) {
        line.remove_suffix(1);
        joined_ += line;
        joined_ += ' ';
        line = in_.next() ? in_.line() : std::string_view();
    }
    joined_ += line;
    return joined_;
}

std::uint32_t ObjReader::group_named(std::string_view name) {
    const auto found = group_of_name_.find(name);
    if (found != group_of_name_.end()) return found->second;
    const auto index = static_cast<std::uint32_t>(groups_.size());
    groups_.push_back({std::string(name)});
    group_of_name_.emplace(name, index);
    return index;
}

void ObjReader::begin_group(std::string_view name) {
    current_.clear();
    if (!name.empty()) current_.push_back(group_named(name));
}

MaybeError ObjReader::begin_groups(Tokens tokens) {
    current_.clear();
    for (auto name = tokens.next(); !name.empty() && name != "#"; name = tokens.next()) {
        const auto group = group_named(name);
        if (std::find(current_.begin(), current_.end(), group) != current_.end()) continue;
        if (current_.size() == max_names)
            return in_.error_at(line_number_, ErrorCode::unsupported,
                                fmt::format("a group line with more than {} names", max_names));
        current_.push_back(group);
    }
    return std::nullopt;
}

MaybeError ObjReader::read_corner(std::string_view token, std::uint32_t& vertex) {
    const auto digits = token.substr(0, token.find('/'));
    std::int64_t number = 0;
    if (!parse_integer(digits, number))
        return in_.error_at(line_number_, ErrorCode::bad_syntax,
                            shown(token) + " is not a corner of a face");
    const auto count = static_cast<std::int64_t>(vertices_.size());
    const auto index = number < 0 ? count + number : number - 1;
    if (number == 0 || index < 0 || index >= UINT32_MAX)
        return in_.error_at(line_number_, ErrorCode::bad_index,
                            fmt::format("the face names vertex {}, which does not exist", number));
    vertex = static_cast<std::uint32_t>(index);
    if (index >= count) ahead_.push_back({vertex, line_number_});
    return std::nullopt;
}

/// Reads a vertex. Three numbers after its coordinates are a colour.
MaybeError ObjReader::read_vertex(Tokens tokens) {
    auto trouble = in_.read_point(tokens, "v", vertices_.emplace_back());
    if (trouble || vertices_.size() > 1) return trouble;
    std::size_t more = 0;
    for (auto token = tokens.next(); !token.empty() && token != "#"; token = tokens.next()) ++more;
    if (more >= 3) note_values("colours", values_);
    return std::nullopt;
}

MaybeError ObjReader::read_face(Tokens tokens) {
    corners_.clear();
    for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
        if (token.front() == '#') break;
        if (auto trouble = read_corner(token, corners_.emplace_back())) return trouble;
    }
    if (corners_.size() < 3)
        return in_.error_at(line_number_, ErrorCode::bad_syntax, "a face needs 3 corners");
    if (current_.empty()) current_.push_back(group_named(default_name_));
    for (const auto index : current_) {
        FilePart& group = groups_[index];
        if (group.triangles.empty()) with_faces_.push_back(index);
        append_face(corners_, group);
    }
    return std::nullopt;
}

MaybeError ObjReader::read_line(std::string_view line) {
    Tokens tokens(line);
    const auto keyword = tokens.next();
    if (keyword == "v") return read_vertex(tokens);
    if (keyword == "vt") note_values("texture coordinates", values_);
    if (keyword == "f" || keyword == "fo") return read_face(tokens);
    if (keyword == "g") return begin_groups(tokens);
    if (keyword == "o") begin_group(trimmed(tokens.rest().substr(0, tokens.rest().find(" # "))));
    return std::nullopt;
}

MaybeError ObjReader::check_ahead() const {
    for (const auto& [vertex, line] : ahead_)
        if (vertex >= vertices_.size())
            return in_.error_at(line, ErrorCode::bad_index,
                                fmt::format("the face names vertex {}, which does not exist: "
                                            "there are {}",
                                            std::uint64_t(vertex) + 1, vertices_.size()));
    return std::nullopt;
}

std::vector<Surface> ObjReader::surfaces() {
    std::vector<FilePart> parts;
    for (const auto index : with_faces_) parts.push_back(std::move(groups_[index]));
    return surfaces_of_parts(vertices_, std::move(parts), values_);
}

Result<std::vector<Surface>> ObjReader::read() {
    while (in_.next())
        if (auto trouble = read_line(whole_line())) return *trouble;
    if (auto trouble = check_ahead()) return *trouble;
    if (with_faces_.empty()) return in_.file_error(ErrorCode::nothing_to_do, "there is no face");
    return surfaces();
}

void append_group_line(std::string& out, const std::vector<std::string>& names,
                       std::span<const std::uint32_t> surfaces) {
    out += 'g';
    for (const auto surface : surfaces) {
        out += ' ';
        out += names[surface];
    }
    out += '\n';
}

} // namespace

Result<std::vector<Surface>> read_obj(std::string_view contents, std::string_view source,
                                      std::string_view name) {
    return ObjReader(contents, source, name).read();
}

std::string to_obj(const Mesh& mesh) {
    const auto names = plain_names(mesh.surfaces);
    std::string out;
    out.reserve(mesh.vertices.size() * 48 + mesh.triangles.size() * 24);
    for (const auto& vertex : mesh.vertices) {
        out += "v ";
        append_point(out, vertex);
        out += '\n';
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto surfaces = mesh.surfaces_of[i];
        if (i == 0 || !std::ranges::equal(surfaces, mesh.surfaces_of[i - 1]))
            append_group_line(out, names, surfaces);
        out += 'f';
        for (const auto vertex : mesh.triangles[i]) {
            out += ' ';
            append_number(out, std::uint64_t(vertex) + 1);
        }
        out += '\n';
    }
    return out;
}

} // namespace terrane
