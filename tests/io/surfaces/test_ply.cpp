// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <limits>

#include <terrane/io/surfaces/ply.hpp>
#include <terrane/io/text/bytes.hpp>

#include "support/read.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

constexpr Reader parse_ply{Format::ply, "a.ply"};

/// Returns a header with one vertex element (x y z) and one face element.
std::string header(std::string_view format, int vertices, int faces,
                   std::string_view index_type = "int") {
    return "ply\nformat " + std::string(format) + " 1.0\nelement vertex " +
           std::to_string(vertices) + "\nproperty float x\nproperty float y\nproperty float z\n" +
           "element face " + std::to_string(faces) + "\nproperty list uchar " +
           std::string(index_type) + " vertex_indices\nend_header\n";
}

template <class T>
void store_big(std::string& out, T value) {
    std::string bytes;
    detail::store(bytes, value);
    out.append(bytes.rbegin(), bytes.rend());
}

const std::vector<Point3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Triangle> fan{{0, 1, 2}, {0, 2, 3}};

void check_square(std::string_view bytes) {
    const auto result = parse_ply(bytes);
    REQUIRE(message_of(result) == "no error");
    CHECK(result.value().at(0).name == "a");
    CHECK(result.value()[0].vertices == corners);
    CHECK(result.value()[0].triangles == fan);
}

} // namespace

TEST_CASE("PLY: ASCII with further elements and properties", "[io][ply]") {
    check_square(header("ascii", 4, 1) + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
    check_square("ply\r\nformat ascii 1.0\r\ncomment x\r\nobj_info y\r\nelement camera 1\r\n"
                 "property float f\r\nproperty list int float k\r\nelement vertex 4\r\n"
                 "property uchar red\r\nproperty double z\r\nproperty float64 y\r\n"
                 "property int16 x\r\nelement empty 4000000000\r\nelement face 1\r\n"
                 "property float quality\r\nproperty list uint8 uint32 vertex_index\r\n"
                 "property list uchar float texcoord\r\nelement edge 1\r\nproperty int a\r\n"
                 "end_header\r\n1.5 2 nan inf\r\n255 0 0 0\r\n255 0 0 1\r\n255 0 1 1\r\n"
                 "255 0 1 0\r\nnan 4 0 1 2 3 2 0.5 0.5\r\n7\r\n\r\n");
}

TEST_CASE("PLY: binary of both byte orders", "[io][ply]") {
    auto little = header("binary_little_endian", 4, 1, "ushort");
    auto big = header("binary_big_endian", 4, 1, "ushort");
    for (const auto& p : corners)
        for (const double c : {p.x, p.y, p.z}) {
            detail::store(little, static_cast<float>(c));
            store_big(big, static_cast<float>(c));
        }
    little += '\4';
    big += '\4';
    for (std::uint16_t i = 0; i < 4; ++i) {
        detail::store(little, i);
        store_big(big, i);
    }
    check_square(little);
    check_square(big);
    CHECK(message_of(parse_ply(little + "x")) == "a.ply, byte " + std::to_string(little.size()) +
                                                     ": there is more than the header announces");
    CHECK(message_of(parse_ply(std::string_view(little).substr(0, little.size() - 1))) ==
          "a.ply, byte " + std::to_string(little.size() - 2) + ": the file ends too early");
}

TEST_CASE("PLY: broken files", "[io][ply]") {
    using enum ErrorCode;
    const auto huge = header("ascii", 2000000000, 2000000000) + "0 0 0\n";
    const auto huge_binary = header("binary_little_endian", 2000000000, 2000000000);
    const auto early = std::to_string(huge_binary.size());
    const auto early_message = "a.ply, byte " + early + ": the file ends too early";
    auto infinite = header("binary_little_endian", 1, 1);
    detail::store(infinite, std::numeric_limits<float>::quiet_NaN());
    infinite.append(20, '\0');
    const auto infinite_message = "a.ply, byte " + std::to_string(infinite.size() - 24) +
                                  ": the value is not a finite number";
    const auto one = header("ascii", 1, 1) + "0 0 0\n";
    const auto few = one + "2 0 0\n", half = one + "3 0 0 0.5\n", beyond = one + "3 0 0 1\n",
               negative = one + "3 0 0 -1\n", word = one + "3 0 0 x\n", more = one + "3 0 0 0 0\n",
               minus = one + "-3 0 0 0\n", nan = header("ascii", 1, 1) + "0 0 nan\n",
               none = header("ascii", 1, 0) + "0 0 0\n";
    const Broken cases[] = {
        {"", bad_syntax, "a.ply: not a PLY file: it does not begin with ply"},
        {"plywood\n", bad_syntax, "a.ply: not a PLY file: it does not begin with ply"},
        {"ply\n", bad_syntax, "a.ply:1: the header has no end_header"},
        {"ply\nend_header\n", bad_syntax, "a.ply:2: there is no format line"},
        {"ply\nformat text 1.0\n", bad_syntax, "a.ply:2: \"text\" is not a format of PLY"},
        {"ply\nhello\n", bad_syntax, "a.ply:2: \"hello\" in the header"},
        {"ply\nelement x -1\n", bad_syntax, "a.ply:2: element needs a name and a count"},
        {"ply\nelement x 1\nelement x 1\n", bad_syntax, "a.ply:3: element \"x\" is there twice"},
        {"ply\nproperty int x\n", bad_syntax, "a.ply:2: a property before the first element"},
        {"ply\nelement x 1\nproperty list x\n", bad_syntax,
         "a.ply:3: a list needs the type of its count"},
        {"ply\nelement x 1\nproperty half x\n", bad_syntax,
         "a.ply:3: \"half\" is not a type of PLY"},
        {"ply\nformat ascii 1.0\nelement face 1\nproperty list int int vertex_index\nend_header\n",
         bad_syntax, "a.ply:5: there is no element vertex with x, y and z"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\n"
         "property int z\nelement face 1\nproperty int vertex_index\nend_header\n",
         bad_syntax, "a.ply:9: element face has no list vertex_indices"},
        {"ply\nformat ascii 1.0\nelement tristrips 1\nend_header\n", unsupported,
         "a.ply:4: triangle strips are not read"},
        {none, nothing_to_do, "a.ply: there is no face"},
        {huge, bad_syntax, "a.ply:10: the file ends too early"},
        {huge_binary, bad_syntax, early_message},
        {infinite, bad_number, infinite_message},
        {nan, bad_number, "a.ply:10: \"nan\" is not a finite number"},
        {few, bad_syntax, "a.ply:11: a face needs 3 corners"},
        {half, bad_syntax, "a.ply:11: 0.5 is not an integer"},
        {minus, bad_syntax, "a.ply:11: the list has a negative length"},
        {word, bad_syntax, "a.ply:11: \"x\" is not a number"},
        {more, bad_syntax, "a.ply:11: there is more than the header announces"},
        {beyond, bad_index,
         "a.ply:11: the face names vertex 1, which does not exist: there are 1, counted from 0"},
        {negative, bad_index,
         "a.ply:11: the face names vertex -1, which does not exist: there are 1, counted from 0"},
    };
    for (const auto& [text, code, message] : cases) {
        const auto result = parse_ply(text);
        CHECK(message_of(result) == message);
        if (!result) CHECK(result.error().code == code);
    }
}

TEST_CASE("PLY: written and read back with its surfaces", "[io][ply]") {
    const auto mesh = awkward_mesh();
    const auto result = parse_ply(to_ply(mesh));
    REQUIRE(message_of(result) == "no error");
    const auto expected = split(mesh);
    REQUIRE(result.value().size() == expected.size());
    for (std::size_t s = 0; s < expected.size(); ++s) {
        CHECK(result.value()[s].name == expected[s].name);
        CHECK(result.value()[s].role == expected[s].role);
        CHECK(same_bits(result.value()[s].vertices, expected[s].vertices));
        CHECK(result.value()[s].triangles == expected[s].triangles);
    }
}

TEST_CASE("PLY: a name that must be changed is changed once", "[io][ply]") {
    auto mesh = awkward_mesh();
    mesh.surfaces[0].name = "\x01top\x02 reservoir\x03\x04";
    const auto once = parse_ply(to_ply(mesh));
    REQUIRE(message_of(once) == "no error");
    CHECK(once.value()[0].name == "top  reservoir");
    mesh.surfaces[0].name = once.value()[0].name;
    CHECK(parse_ply(to_ply(mesh)).value()[0].name == once.value()[0].name);
}
