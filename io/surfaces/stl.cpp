// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/surfaces/stl.hpp>

#include <array>
#include <cmath>
#include <initializer_list>

#include <fmt/format.h>

#include <terrane/io/surfaces/detail/point_numbering.hpp>
#include <terrane/io/text/bytes.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

constexpr std::size_t header_size = 80;
constexpr std::size_t facets_begin = header_size + 4;
constexpr std::size_t facet_size = 50;

/// Returns the length of a binary file with this count of triangles; UINT64_MAX if the contents end
/// before the count.
std::uint64_t binary_size(std::string_view contents) {
    if (contents.size() < facets_begin) return UINT64_MAX;
    const auto count = load<std::uint32_t>(contents.data() + header_size);
    return facets_begin + std::uint64_t(count) * facet_size;
}

bool looks_like_text(std::string_view contents) {
    LineParser in(contents, "");
    while (in.next())
        if (const auto word = Tokens(in.line()).next(); !word.empty())
            return same_ignoring_case(word, "solid");
    return false;
}

class BinaryStlReader {
public:
    BinaryStlReader(std::string_view contents, std::string_view source) :
        contents_(contents), source_(source) {}

    MaybeError read(Surface& surface) {
        if (contents_.size() != binary_size(contents_)) return wrong_size();
        PointNumbering points;
        surface.triangles.reserve((contents_.size() - facets_begin) / facet_size);
        for (auto at = facets_begin; at < contents_.size(); at += facet_size)
            if (auto trouble = read_facet(at, points, surface.triangles.emplace_back()))
                return trouble;
        surface.vertices = points.take();
        return std::nullopt;
    }

private:
    [[nodiscard]] Error wrong_size() const {
        const auto size = contents_.size();
        if (size < facets_begin)
            return {ErrorCode::bad_syntax, "neither ASCII nor binary STL", std::string(source_)};
        const auto count = load<std::uint32_t>(contents_.data() + header_size);
        return {ErrorCode::bad_syntax,
                fmt::format("{} triangles call for {} bytes, but the file has {}", count,
                            binary_size(contents_), size),
                fmt::format("{}, byte {}", source_, header_size)};
    }

    MaybeError read_facet(std::size_t at, PointNumbering& points, Triangle& triangle) const {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            std::array<double, 3> xyz{};
            for (std::size_t i = 0; i < 3; ++i) {
                const auto place = at + 12 + 12 * corner + 4 * i;
                xyz[i] = load<float>(contents_.data() + place);
                if (!std::isfinite(xyz[i]))
                    return Error{ErrorCode::bad_number, "the coordinate is not a finite number",
                                 fmt::format("{}, byte {}", source_, place)};
            }
            triangle[corner] = points.number({xyz[0], xyz[1], xyz[2]});
        }
        return std::nullopt;
    }

    std::string_view contents_;
    std::string_view source_;
};

class AsciiStlReader {
public:
    AsciiStlReader(std::string_view contents, std::string_view source, std::string_view name) :
        in_(contents, source), default_name_(name) {}

    MaybeError read(std::vector<Surface>& surfaces) {
        while (next_word()) {
            if (auto trouble = check("solid")) return trouble;
            Surface surface;
            surface.name = tokens_.rest();
            tokens_ = Tokens("");
            if (surface.name.empty()) surface.name = default_name_;
            if (auto trouble = read_solid(surface)) return trouble;
            if (!surface.triangles.empty()) surfaces.push_back(std::move(surface));
        }
        return std::nullopt;
    }

private:
    /// Goes to the next word, on the next lines if need be; returns false at the end of the file.
    bool next_word() {
        for (word_ = tokens_.next(); word_.empty(); word_ = tokens_.next()) {
            if (!in_.next()) return false;
            tokens_ = Tokens(in_.line());
        }
        return true;
    }

    [[nodiscard]] MaybeError check(std::string_view wanted) const {
        if (same_ignoring_case(word_, wanted)) return std::nullopt;
        const auto found = word_.empty() ? "the end of the file" : shown(word_);
        return in_.error(ErrorCode::bad_syntax,
                         fmt::format("expected {}, found {}", wanted, found));
    }

    MaybeError expect(std::initializer_list<std::string_view> words) {
        for (const auto wanted : words) {
            next_word();
            if (auto trouble = check(wanted)) return trouble;
        }
        return std::nullopt;
    }

    MaybeError read_solid(Surface& surface) {
        PointNumbering points;
        while (next_word() && !same_ignoring_case(word_, "endsolid")) {
            if (auto trouble = check("facet")) return trouble;
            if (auto trouble = read_facet(points, surface.triangles.emplace_back())) return trouble;
        }
        if (auto trouble = check("endsolid")) return trouble;
        tokens_ = Tokens(""); // its name
        surface.vertices = points.take();
        return std::nullopt;
    }

    MaybeError read_facet(PointNumbering& points, Triangle& triangle) {
        while (next_word() && !same_ignoring_case(word_, "outer")) {
        } // the normal
        if (auto trouble = check("outer")) return trouble;
        if (auto trouble = expect({"loop"})) return trouble;
        for (auto& corner : triangle) {
            if (auto trouble = expect({"vertex"})) return trouble;
            Point3 point;
            for (double* coordinate : {&point.x, &point.y, &point.z}) {
                if (!next_word()) return in_.error(ErrorCode::bad_syntax, "vertex needs 3 numbers");
                if (auto trouble = in_.read_number(word_, *coordinate)) return trouble;
            }
            corner = points.number(point);
        }
        return expect({"endloop", "endfacet"});
    }

    LineParser in_;
    Tokens tokens_{""};
    std::string_view word_;
    std::string_view default_name_;
};

std::array<double, 3> normal(const Point3& a, const Point3& b, const Point3& c) {
    const std::array u{b.x - a.x, b.y - a.y, b.z - a.z};
    const std::array v{c.x - a.x, c.y - a.y, c.z - a.z};
    const std::array n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                       u[0] * v[1] - u[1] * v[0]};
    const double length = std::hypot(n[0], n[1], n[2]);
    if (!std::isfinite(length) || length == 0) return {0, 0, 0};
    return {n[0] / length, n[1] / length, n[2] / length};
}

MaybeError check_range(const Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        for (const double c : {mesh.vertices[i].x, mesh.vertices[i].y, mesh.vertices[i].z})
            if (!std::isfinite(static_cast<float>(c)))
                return Error{ErrorCode::bad_number,
                             fmt::format("vertex {}: {} does not fit in the float32 of STL", i, c),
                             ""};
    return std::nullopt;
}

void append_facet(std::string& out, const Mesh& mesh, const Triangle& triangle) {
    const auto& v = mesh.vertices;
    out += "facet normal";
    for (const double n : normal(v[triangle[0]], v[triangle[1]], v[triangle[2]])) {
        out += ' ';
        append_number(out, static_cast<float>(n));
    }
    out += "\nouter loop\n";
    for (const auto vertex : triangle) {
        out += "vertex ";
        append_point(out, v[vertex]);
        out += '\n';
    }
    out += "endloop\nendfacet\n";
}

} // namespace

Result<std::vector<Surface>> read_stl(std::string_view contents, std::string_view source,
                                      std::string_view name) {
    std::vector<Surface> surfaces;
    if (contents.size() != binary_size(contents) && looks_like_text(contents)) {
        if (auto trouble = AsciiStlReader(contents, source, name).read(surfaces)) return *trouble;
    } else {
        auto& surface = surfaces.emplace_back();
        surface.name = name;
        if (auto trouble = BinaryStlReader(contents, source).read(surface)) return *trouble;
    }
    if (surfaces.empty() || surfaces[0].triangles.empty())
        return Error{ErrorCode::nothing_to_do, "there is no facet", std::string(source)};
    return surfaces;
}

Result<std::string> to_stl(const Mesh& mesh) {
    if (auto trouble = check_range(mesh)) return *trouble;
    std::string out = "Terrane: coordinates rounded to float32";
    out.resize(header_size, ' ');
    store(out, static_cast<std::uint32_t>(mesh.triangles.size()));
    out.reserve(facets_begin + mesh.triangles.size() * facet_size);
    const auto& v = mesh.vertices;
    for (const auto& t : mesh.triangles) {
        for (const double n : normal(v[t[0]], v[t[1]], v[t[2]])) store(out, static_cast<float>(n));
        for (const auto vertex : t)
            for (const double c : {v[vertex].x, v[vertex].y, v[vertex].z})
                store(out, static_cast<float>(c));
        store(out, std::uint16_t(0));
    }
    return out;
}

std::string to_stl_ascii(const Mesh& mesh) {
    std::vector<std::string> bodies(mesh.surfaces.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const auto surface : mesh.surfaces_of[i])
            append_facet(bodies[surface], mesh, mesh.triangles[i]);
    const auto names = plain_names(mesh.surfaces);
    std::string out;
    for (std::size_t s = 0; s < bodies.size(); ++s)
        if (!bodies[s].empty())
            out += "solid " + names[s] + '\n' + bodies[s] + "endsolid " + names[s] + '\n';
    return out;
}

} // namespace terrane
