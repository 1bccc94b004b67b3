// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/surfaces/off.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <terrane/io/surfaces/parts.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

class OffReader {
public:
    OffReader(std::string_view contents, std::string_view source) : in_(contents, source) {}

    MaybeError read(Surface& surface);

private:
    bool next_line();
    MaybeError check_keyword(std::string_view keyword) const;
    MaybeError read_header();
    MaybeError read_counts(Tokens tokens);
    MaybeError read_vertices(std::vector<Point3>& vertices);
    MaybeError read_corner(std::string_view token, std::uint32_t& vertex) const;
    MaybeError read_face(FilePart& part);
    MaybeError read_faces(FilePart& part);
    [[nodiscard]] Error ends_early(std::size_t have, std::int64_t want,
                                   std::string_view what) const;

    LineParser in_;
    std::string_view line_;              ///< the current line without its comment
    std::vector<std::uint32_t> corners_; ///< of the current face
    std::int64_t vertex_count_ = 0;
    std::int64_t face_count_ = 0;
    bool has_colours_ = false;
};

/// Goes to the next line that is not blank.
bool OffReader::next_line() {
    while (in_.next()) {
        line_ = trimmed(in_.line().substr(0, in_.line().find('#')));
        if (!line_.empty()) return true;
    }
    return false;
}

Error OffReader::ends_early(std::size_t have, std::int64_t want, std::string_view what) const {
    return in_.error(ErrorCode::bad_syntax,
                     fmt::format("the file ends after {} of {} {}", have, want, what));
}

MaybeError OffReader::check_keyword(std::string_view keyword) const {
    const auto prefix = keyword.substr(0, keyword.size() - 3);
    if (prefix.find_first_not_of("STCN4n") != std::string_view::npos)
        return in_.error(ErrorCode::bad_syntax, shown(keyword) + " is not an OFF keyword");
    if (prefix.find_first_of("4n") != std::string_view::npos)
        return in_.error(ErrorCode::unsupported,
                         fmt::format("{}: vertices do not have 3 coordinates", keyword));
    return std::nullopt;
}

MaybeError OffReader::read_header() {
    if (!next_line()) return in_.file_error(ErrorCode::nothing_to_do, "the file is empty");
    Tokens tokens(line_);
    const auto keyword = tokens.next();
    if (!keyword.ends_with("OFF")) return read_counts(Tokens(line_)); // the keyword is optional
    if (auto trouble = check_keyword(keyword)) return trouble;
    has_colours_ = keyword.find('C') != std::string_view::npos;
    if (tokens.rest().starts_with("BINARY"))
        return in_.error(ErrorCode::unsupported, "binary OFF is not read");
    if (!tokens.rest().empty()) return read_counts(tokens);
    if (!next_line()) return in_.error(ErrorCode::bad_syntax, "the counts are missing");
    return read_counts(Tokens(line_));
}

MaybeError OffReader::read_counts(Tokens tokens) {
    for (auto* count : {&vertex_count_, &face_count_})
        if (!parse_integer(tokens.next(), *count) || *count < 0)
            return in_.error(ErrorCode::bad_syntax,
                             "expected the numbers of vertices and faces, found " + shown(line_));
    return std::nullopt;
}

MaybeError OffReader::read_vertices(std::vector<Point3>& vertices) {
    const auto fit = in_.bytes_left() / 6 + 1; // "0 0 0\n"
    vertices.reserve(std::min(static_cast<std::size_t>(vertex_count_), fit));
    for (std::int64_t i = 0; i < vertex_count_; ++i) {
        if (!next_line()) return ends_early(vertices.size(), vertex_count_, "vertices");
        Tokens tokens(line_);
        if (auto trouble = in_.read_point(tokens, "a vertex", vertices.emplace_back()))
            return trouble;
    }
    return std::nullopt;
}

MaybeError OffReader::read_corner(std::string_view token, std::uint32_t& vertex) const {
    std::int64_t number = 0;
    if (token.empty())
        return in_.error(ErrorCode::bad_syntax, "the face has fewer corners than it says");
    if (!parse_integer(token, number))
        return in_.error(ErrorCode::bad_syntax, shown(token) + " is not a vertex number");
    if (number < 0 || number >= vertex_count_)
        return in_.error(
            ErrorCode::bad_index,
            fmt::format("the face names vertex {}, which does not exist: there are {}, "
                        "counted from 0",
                        number, vertex_count_));
    vertex = static_cast<std::uint32_t>(number);
    return std::nullopt;
}

MaybeError OffReader::read_face(FilePart& part) {
    Tokens tokens(line_);
    std::int64_t count = 0;
    if (!parse_integer(tokens.next(), count) || count < 3)
        return in_.error(ErrorCode::bad_syntax,
                         "a face begins with its number of corners, at least 3: " + shown(line_));
    corners_.clear();
    for (std::int64_t i = 0; i < count; ++i)
        if (auto trouble = read_corner(tokens.next(), corners_.emplace_back())) return trouble;
    append_face(corners_, part);
    return std::nullopt;
}

MaybeError OffReader::read_faces(FilePart& part) {
    part.triangles.reserve(
        std::min(static_cast<std::size_t>(face_count_), in_.bytes_left() / 8 + 1));
    for (std::int64_t i = 0; i < face_count_; ++i) {
        if (!next_line()) return ends_early(static_cast<std::size_t>(i), face_count_, "faces");
        if (auto trouble = read_face(part)) return trouble;
    }
    if (next_line())
        return in_.error(ErrorCode::bad_syntax,
                         fmt::format("there is more than the {} faces stated", face_count_));
    return std::nullopt;
}

MaybeError OffReader::read(Surface& surface) {
    if (auto trouble = read_header()) return trouble;
    if (auto trouble = read_vertices(surface.vertices)) return trouble;
    FilePart part;
    if (auto trouble = read_faces(part)) return trouble;
    surface.flawed_faces = divide_faces(surface.vertices, part);
    if (has_colours_) surface.values.emplace_back("colours");
    surface.triangles = std::move(part.triangles);
    if (surface.triangles.empty())
        return in_.file_error(ErrorCode::nothing_to_do, "there is no face");
    return std::nullopt;
}

} // namespace

Result<std::vector<Surface>> read_off(std::string_view contents, std::string_view source,
                                      std::string_view name) {
    std::vector<Surface> surfaces(1);
    surfaces[0].name = name;
    if (auto trouble = OffReader(contents, source).read(surfaces[0])) return *trouble;
    return surfaces;
}

std::string to_off(const Mesh& mesh) {
    std::string out = fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
    out.reserve(mesh.vertices.size() * 48 + mesh.triangles.size() * 24);
    for (const auto& vertex : mesh.vertices) {
        append_point(out, vertex);
        out += '\n';
    }
    for (const auto& triangle : mesh.triangles) {
        out += '3';
        for (const auto vertex : triangle) {
            out += ' ';
            append_number(out, std::uint64_t(vertex));
        }
        out += '\n';
    }
    return out;
}

} // namespace terrane
