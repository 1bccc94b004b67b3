// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The readers of output.hpp for binary STL, and PLY, which may be text as well.
#include <bit>
#include <cstring>
#include <type_traits>
#include <utility>

#include <terrane/algorithms/verify/detail/line_scanner.hpp>
#include <terrane/algorithms/verify/detail/output.hpp>
#include <terrane/algorithms/verify/stoppable.hpp>

namespace terrane::verifier {

namespace {

/// Reads numbers in little-endian order. All functions throw a Difference if the bytes go on
/// otherwise.
class ByteScanner {
public:
    explicit ByteScanner(std::string_view bytes) : bytes_(bytes) {}

    [[noreturn]] void fail(std::string sentence) const {
        throw Difference{"byte " + std::to_string(at_), std::move(sentence)};
    }
    template <class T>
    T take() {
        look_for_stop();
        if (bytes_.size() - at_ < sizeof(T)) fail("the file ends too early");
        std::make_unsigned_t<T> value = 0;
        for (std::size_t i = sizeof(T); i-- > 0;)
            value = static_cast<std::make_unsigned_t<T>>(
                (sizeof(T) > 1 ? value << 8U : 0U) | static_cast<unsigned char>(bytes_[at_ + i]));
        at_ += sizeof(T);
        return static_cast<T>(value);
    }
    template <class T>
    void expect(T expected, const char* what) {
        const std::size_t start = at_;
        if (take<T>() == expected) return;
        at_ = start;
        fail(std::string("another ") + what + " than in the certificate");
    }
    void expect_text(std::string_view text) {
        if (!bytes_.substr(at_).starts_with(text)) fail("another header is needed");
        at_ += text.size();
    }
    void end() const {
        if (at_ != bytes_.size()) fail("the file has more bytes than it should");
    }

private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

} // namespace

void compare_stl(std::string_view contents, const ExpectedMesh& expected) {
    ByteScanner in(contents);
    std::string header = "Terrane: coordinates rounded to float32";
    header.resize(80, ' ');
    in.expect_text(header);
    in.expect(static_cast<std::uint32_t>(expected.mesh.triangles.size()), "number of triangles");
    for (const Triangle& triangle : expected.mesh.triangles) {
        for (int i = 0; i < 3; ++i) (void)in.take<std::uint32_t>(); // the normal
        for (const std::uint32_t corner : triangle) {
            const Point3& p = expected.mesh.vertices[corner];
            for (const double c : {p.x, p.y, p.z})
                in.expect(std::bit_cast<std::uint32_t>(static_cast<float>(c)), "coordinate");
        }
        in.expect(std::uint16_t(0), "attribute");
    }
    in.end();
}

namespace {

std::string ply_header(const ExpectedMesh& expected, const std::string& format) {
    std::string text = "ply\nformat " + format + " 1.0\n";
    for (const SurfaceInfo& surface : expected.surfaces) {
        std::string name = surface.name;
        for (char& c : name)
            if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
        const std::size_t first = name.find_first_not_of(' ');
        name = first == std::string::npos
                   ? ""
                   : name.substr(first, name.find_last_not_of(' ') - first + 1);
        text += "comment terrane surface " + std::string(name_of(surface.role)) + " " + name + "\n";
    }
    text += "element vertex " + std::to_string(expected.mesh.vertices.size()) + "\n";
    for (const char axis : {'x', 'y', 'z'}) text += std::string("property double ") + axis + "\n";
    text += "element face " + std::to_string(expected.mesh.triangles.size()) + "\n";
    return text + "property list uchar int vertex_indices\nproperty int surface\n"
                  "property list uint int surfaces\nend_header\n";
}

/// Reads PLY as text. The header is that of the binary file but for its second line; each vertex
/// and each face is a line.
void compare_ply_text(std::string_view contents, const ExpectedMesh& expected) {
    LineScanner in(contents);
    const std::string header = ply_header(expected, "ascii");
    for (std::size_t at = 0, end = 0; at < header.size(); at = end + 1) {
        end = header.find('\n', at);
        in.expect(header.substr(at, end - at));
    }
    for (const Point3& p : expected.mesh.vertices) {
        in.next();
        in.expect_point(p);
        in.end_line();
    }
    for (std::size_t t = 0; t < expected.mesh.triangles.size(); ++t) {
        const auto surfaces = expected.mesh.surfaces_of[t];
        in.next();
        in.expect_word("3");
        for (const std::uint32_t corner : expected.mesh.triangles[t])
            in.expect_word(std::to_string(corner));
        in.expect_word(std::to_string(surfaces[0]));
        in.expect_word(std::to_string(surfaces.size()));
        for (const std::uint32_t surface : surfaces) in.expect_word(std::to_string(surface));
        in.end_line();
    }
    in.end();
}

} // namespace

void compare_ply(std::string_view contents, const ExpectedMesh& expected) {
    if (contents.starts_with("ply\nformat ascii ")) return compare_ply_text(contents, expected);
    ByteScanner in(contents);
    in.expect_text(ply_header(expected, "binary_little_endian"));
    for (const Point3& p : expected.mesh.vertices)
        for (const double c : {p.x, p.y, p.z})
            in.expect(std::bit_cast<std::uint64_t>(c), "coordinate");
    for (std::size_t t = 0; t < expected.mesh.triangles.size(); ++t) {
        in.expect(std::uint8_t(3), "number of corners");
        for (const std::uint32_t corner : expected.mesh.triangles[t]) in.expect(corner, "corner");
        const auto surfaces = expected.mesh.surfaces_of[t];
        in.expect(surfaces[0], "surface");
        in.expect(static_cast<std::uint32_t>(surfaces.size()), "number of surfaces");
        for (const std::uint32_t surface : surfaces) in.expect(surface, "surface");
    }
    in.end();
}

} // namespace terrane::verifier
