// SPDX-License-Identifier: MIT
#include <terrane/fuzzing/files.hpp>

#include <cstdio>
#include <utility>

namespace terrane::fuzzing {

namespace {

/// Writes lines, which bytes make untidy.
class Writer {
public:
    /// `comment` is what a comment begins with; empty: the format has none.
    Writer(Bytes& bytes, std::string comment) :
        bytes_(bytes), comment_(std::move(comment)), end_(bytes.flag() ? "\r\n" : "\n") {}

    /// Appends a line; each blank of it may become several, or tabs.
    void line(const std::string& words) {
        if (!comment_.empty() && one_of(8)) text_ += comment_ + " f 1 2 3, no face" + end_;
        if (one_of(8)) text_ += one_of(2) ? end_ : " \t" + end_;
        if (one_of(6)) text_ += blank();
        for (const char c : words) text_ += c == ' ' ? blank() : std::string(1, c);
        if (one_of(6)) text_ += blank();
        text_ += end_;
    }
    /// Appends a line as it is.
    void plain(const std::string& words) { text_ += words + end_; }

    /// Spells a number in one of several ways that stand for the same double.
    std::string number(double x) {
        static constexpr std::array<const char*, 5> spellings{"%.17g", "%.17e", "%.17E", "%.25g",
                                                              "%#.17g"};
        char text[80];
        std::snprintf(text, sizeof text, spellings[bytes_.below(5)], x);
        return text;
    }
    std::string point(const Point& p) {
        const std::string x = number(p.x), y = number(p.y);
        return x + " " + y + " " + number(p.z);
    }
    bool one_of(unsigned count) { return bytes_.byte() % count == count - 1; }

    [[nodiscard]] std::string text() const { return text_; }
    /// Leaves out the last end of line.
    void end_without_line() { text_.erase(text_.size() - end_.size()); }

private:
    std::string blank() {
        static constexpr std::array<const char*, 5> blanks{" ", " ", "  ", "\t", " \t "};
        return blanks[bytes_.below(5)];
    }

    Bytes& bytes_;
    std::string comment_, end_, text_;
};

std::string text_of(std::uint32_t v) {
    return std::to_string(v);
}

void write_obj(Writer& to, Bytes& bytes, const Part& part) {
    const bool colours = to.one_of(3);
    const unsigned attributes = bytes.below(4); // none, v/vt, v//vn, v/vt/vn
    const bool negative = to.one_of(3);
    if (to.one_of(3)) to.line("mtllib none.mtl");
    if (to.one_of(2)) to.line("o an object");
    for (const Point& p : part.points) to.line("v " + to.point(p) + (colours ? " 0.5 0.5 1" : ""));
    to.line("vt 0 1");
    to.line("vn 0 0 1");
    for (const Triangle& t : part.triangles) {
        if (to.one_of(8)) to.line("usemtl red");
        if (to.one_of(8)) to.line("s off");
        std::string face = "f";
        for (const std::uint32_t v : t) {
            const auto count = static_cast<std::uint32_t>(part.points.size());
            face += negative ? " -" + text_of(count - v) : " " + text_of(v + 1);
            static constexpr std::array<const char*, 4> ends{"", "/1", "//1", "/1/1"};
            face += ends[attributes];
        }
        to.line(face);
    }
}

void write_off(Writer& to, Bytes& bytes, const Part& part) {
    const std::string counts = text_of(static_cast<std::uint32_t>(part.points.size())) + " " +
                               text_of(static_cast<std::uint32_t>(part.triangles.size())) + " " +
                               text_of(bytes.byte());
    const bool colours = to.one_of(3);
    if (to.one_of(2)) {
        to.line("OFF " + counts);
    } else {
        to.line("OFF");
        to.line(counts);
    }
    for (const Point& p : part.points) to.line(to.point(p));
    for (const Triangle& t : part.triangles)
        to.line("3 " + text_of(t[0]) + " " + text_of(t[1]) + " " + text_of(t[2]) +
                (colours ? " 255 0 0" : ""));
}

void write_stl(Writer& to, Bytes& bytes, const Part& part) {
    const std::string name = bytes.flag() ? " a solid, facet normal" : "";
    to.line("solid" + name);
    for (const Triangle& t : part.triangles) {
        to.line(bytes.flag() ? "facet normal 0 0 0" : "facet normal 0.6 -8e-1 0");
        to.line("outer loop");
        for (const std::uint32_t v : t) to.line("vertex " + to.point(part.points[v]));
        to.line("endloop");
        to.line("endfacet");
    }
    to.line("endsolid" + name);
}

void write_ply(Writer& to, Bytes& bytes, const Part& part) {
    const bool before = bytes.flag(), after = bytes.flag(), edges = bytes.flag();
    to.plain("ply");
    to.plain("format ascii 1.0");
    if (bytes.flag()) to.plain("comment element vertex 7");
    to.plain("element vertex " + text_of(static_cast<std::uint32_t>(part.points.size())));
    if (before) to.plain("property uchar red");
    for (const char* axis : {"x", "y", "z"})
        to.plain(std::string(bytes.flag() ? "property double " : "property float64 ") + axis);
    if (edges) {
        to.plain("element edge 1");
        to.plain("property int vertex1");
        to.plain("property int vertex2");
    }
    to.plain("element face " + text_of(static_cast<std::uint32_t>(part.triangles.size())));
    const std::string types = bytes.flag() ? "uchar int " : "uint8 uint32 ";
    to.plain("property list " + types + (bytes.flag() ? "vertex_indices" : "vertex_index"));
    if (after) to.plain("property list uchar float texcoord");
    to.plain("end_header");
    for (const Point& p : part.points) to.plain((before ? "255 " : "") + to.point(p));
    if (edges) to.plain("0 0");
    for (const Triangle& t : part.triangles)
        to.plain("3 " + text_of(t[0]) + " " + text_of(t[1]) + " " + text_of(t[2]) +
                 (after ? " 2 0.5 0.5" : ""));
}

void write_ts(Writer& to, Bytes& bytes, const Part& part) {
    const std::uint32_t first = bytes.byte();
    const bool properties = to.one_of(3);
    to.plain("GOCAD TSurf 1");
    to.plain("HEADER {");
    to.plain("name: a surface");
    if (to.one_of(2)) to.plain("*solid*color: 1 0.5 0 1");
    to.plain("}");
    if (properties) {
        to.plain("PROPERTIES thickness");
        to.plain("ESIZES 1");
        to.plain("NO_DATA_VALUES -99999");
    }
    to.line("TFACE");
    for (std::uint32_t v = 0; v < part.points.size(); ++v)
        to.line((properties ? "PVRTX " : "VRTX ") + text_of(first + v) + " " +
                to.point(part.points[v]) + (properties ? " -99999" : ""));
    for (const Triangle& t : part.triangles)
        to.line("TRGL " + text_of(first + t[0]) + " " + text_of(first + t[1]) + " " +
                text_of(first + t[2]));
    to.line("END");
}

} // namespace

std::string dirty_file(Bytes& bytes, const Part& part, TextFormat format) {
    const bool has_comments = format != TextFormat::stl && format != TextFormat::ply;
    Writer to(bytes, has_comments ? "#" : "");
    switch (format) {
    case TextFormat::obj:
        write_obj(to, bytes, part);
        break;
    case TextFormat::off:
        write_off(to, bytes, part);
        break;
    case TextFormat::stl:
        write_stl(to, bytes, part);
        break;
    case TextFormat::ply:
        write_ply(to, bytes, part);
        break;
    case TextFormat::ts:
        write_ts(to, bytes, part);
        break;
    }
    if (to.one_of(4)) to.end_without_line();
    return to.text();
}

} // namespace terrane::fuzzing
