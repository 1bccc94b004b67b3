// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <terrane/io/surfaces/obj.hpp>

#include "support/read.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

constexpr Reader parse_obj{Format::obj, "a.obj"};

constexpr std::string_view four = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::vector<Surface> faces(std::string_view text) {
    const auto result = parse_obj(std::string(four) + std::string(text));
    REQUIRE(message_of(result) == "no error");
    return result.value();
}

} // namespace

TEST_CASE("OBJ: what follows a # between blanks is a comment on lines of groups, too",
          "[io][obj]") {
    const auto read = read_obj(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\ng top # main\nf 1 2 3\no #5 fault # old\nf 1 3 2\n", "a", "a");
    REQUIRE(read);
    REQUIRE(read->size() == 2);
    CHECK(read->at(0).name == "top");
    CHECK(read->at(1).name == "#5 fault");
}

TEST_CASE("OBJ: all ways to write a face", "[io][obj]") {
    for (const auto* face : {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//2 3//3", "f 1/1/1 2/2/2 3/3/3",
                             "f -4 -3 -2", "f 1 2\\\n 3", "f\t1  2 3 # why", "f +1 2 3\r"}) {
        const auto surfaces = faces(face);
        REQUIRE(surfaces.size() == 1);
        CHECK(surfaces[0].name == "a");
        CHECK(surfaces[0].vertices == std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
        CHECK(surfaces[0].triangles == std::vector<Triangle>{{0, 1, 2}});
    }
}

TEST_CASE("OBJ: polygons become fans", "[io][obj]") {
    CHECK(faces("f 2 3 4 1")[0].triangles == std::vector<Triangle>{{1, 2, 3}, {1, 3, 0}});
}

TEST_CASE("OBJ: a face may come before its vertices", "[io][obj]") {
    const auto result = parse_obj("f 1 2 3\nv 0 0 0\nv 1 0 0 1.0\nv 0 1 0 0.5 0.5 0.5\n");
    REQUIRE(result);
    CHECK(result.value()[0].vertices.size() == 3);
}

TEST_CASE("OBJ: groups and objects are surfaces, materials are not", "[io][obj]") {
    const auto surfaces = faces("mtllib m\no my object \nusemtl x\nf 1 2 3\nusemtl y\nf 1 2 4\n"
                                "g empty\ng b c b\nf 2 3 4\ng\nf 1 3 4\ng b\nf 1 2 3\n");
    REQUIRE(surfaces.size() == 4);
    CHECK(surfaces[0].name == "my object");
    CHECK(surfaces[0].triangles.size() == 2);
    CHECK(surfaces[1].name == "b");
    CHECK(surfaces[1].vertices == std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(surfaces[1].triangles == std::vector<Triangle>{{1, 2, 3}, {0, 1, 2}});
    CHECK(surfaces[2].name == "c");
    CHECK(surfaces[2].vertices == std::vector<Point3>{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(surfaces[2].triangles == std::vector<Triangle>{{0, 1, 2}});
    CHECK(surfaces[3].name == "a");
}

TEST_CASE("OBJ: broken files", "[io][obj]") {
    std::string many = "g";
    for (int i = 0; i < 257; ++i) many += " n" + std::to_string(i);
    const auto crowd = many + "\nf 1 1 1\n";
    using enum ErrorCode;
    const Broken cases[] = {
        {"", nothing_to_do, "a.obj: there is no face"},
        {"v 0 0 0\ng a\n", nothing_to_do, "a.obj: there is no face"},
        {"v 0 0\n", bad_syntax, "a.obj:1: v needs 3 numbers"},
        {"\nv 0 x 0\n", bad_syntax, "a.obj:2: \"x\" is not a number"},
        {"v 0 nan 0\n", bad_number, "a.obj:1: \"nan\" is not a finite number"},
        {"v 0 1e999 0\n", bad_number, "a.obj:1: \"1e999\" does not fit in a double"},
        {"v 1d5 0 0\n", bad_syntax, "a.obj:1: \"1d5\" is not a number"},
        {"v 0 0 0\nf 1 1\n", bad_syntax, "a.obj:2: a face needs 3 corners"},
        {"v 0 0 0\nf 1 1 x/1\n", bad_syntax, "a.obj:2: \"x/1\" is not a corner of a face"},
        {"v 0 0 0\nf 1 1 0\n", bad_index, "a.obj:2: the face names vertex 0, which does not exist"},
        {"v 0 0 0\nf 1 1 -2\n", bad_index,
         "a.obj:2: the face names vertex -2, which does not exist"},
        {"v 0 0 0\n\nf 1 1 \\\n2\nf 1 1 1\n", bad_index,
         "a.obj:3: the face names vertex 2, which does not exist: there are 1"},
        {"f 1 1 99999999999\n", bad_index,
         "a.obj:1: the face names vertex 99999999999, which does not exist"},
        {crowd, unsupported, "a.obj:1: a group line with more than 256 names"},
    };
    for (const auto& [text, code, message] : cases) {
        const auto result = parse_obj(text);
        CHECK(message_of(result) == message);
        if (!result) CHECK(result.error().code == code);
    }
}

TEST_CASE("OBJ: the writer groups triangles by their surfaces", "[io][obj]") {
    auto mesh = awkward_mesh();
    mesh.vertices.assign(6, {1, 2.5, -0.0});
    CHECK(to_obj(mesh) == "v 1 2.5 -0\nv 1 2.5 -0\nv 1 2.5 -0\nv 1 2.5 -0\nv 1 2.5 -0\nv 1 2.5 -0\n"
                          "g top_reservoir\nf 1 2 3\n"
                          "g top_reservoir main_\"A\"_fault\nf 2 5 3\n"
                          "g main_\"A\"_fault\nf 6 5 1\n"
                          "g top_reservoir_2\nf 1 1 6\n");
}
