// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <string>

#include <terrane/io/files.hpp>

using namespace terrane;

namespace {

const std::string dxf_entities = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n0\nENDSEC\n"
                                 "0\nSECTION\n2\nENTITIES\n";
const std::string dxf_triangle = "0\n3DFACE\n8\ntop\n10\n0\n20\n0\n30\n1\n11\n2\n21\n0\n31\n1\n"
                                 "12\n0\n22\n2\n32\n1.5\n13\n0\n23\n2\n33\n1.5\n";
const std::string dxf_square =
    "  0\r\n3DFACE\r\n  8\r\nfault 1\r\n 10\r\n0.0\r\n 20\r\n0.0\r\n 30\r\n"
    "0.0\r\n 11\r\n1.0\r\n 21\r\n0.0\r\n 31\r\n0.0\r\n 12\r\n1.0\r\n 22\r\n"
    "1.0\r\n 32\r\n0.0\r\n 13\r\n0.0\r\n 23\r\n1.0\r\n 33\r\n0.0\r\n";
const std::string dxf_end = "0\nENDSEC\n0\nEOF\n";

std::string dxf_message(const std::string& contents) {
    const auto read = parse_surfaces(contents, "a", Format::dxf);
    REQUIRE_FALSE(read);
    return read.error().message();
}

} // namespace

TEST_CASE("DXF: a surface for each layer", "[io][dxf]") {
    const auto read =
        parse_surfaces(dxf_entities + dxf_triangle + "0\nLINE\n8\nother\n10\n5\n20\n5\n30\n5\n" +
                           dxf_square + dxf_triangle + dxf_end,
                       "a", Format::dxf);
    REQUIRE(read);
    REQUIRE(read->size() == 2);
    CHECK(read->at(0).name == "top");
    CHECK(read->at(0).vertices == std::vector<Point3>{{0, 0, 1}, {2, 0, 1}, {0, 2, 1.5}});
    CHECK(read->at(0).triangles == std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}});
    CHECK(read->at(1).name == "fault 1");
    CHECK(read->at(1).triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("DXF: faces of blocks that are not inserted are passed over", "[io][dxf]") {
    const std::string blocks =
        "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nb\n" + dxf_triangle + "0\nENDBLK\n0\nENDSEC\n";
    const auto read =
        parse_surfaces(blocks + dxf_entities + dxf_square + dxf_end, "a", Format::dxf);
    REQUIRE(read);
    CHECK(read->size() == 1);
    CHECK(dxf_message(blocks + dxf_entities + dxf_end) ==
          "a: there is no face: no 3DFACE, polyface, polygon mesh or MESH");
}

TEST_CASE("DXF: polyfaces, polygon meshes and MESH", "[io][dxf]") {
    const auto vertex = [](const std::string& x, const std::string& y, const std::string& z,
                           const std::string& flags) {
        return "0\nVERTEX\n8\nsalt\n10\n" + x + "\n20\n" + y + "\n30\n" + z + "\n70\n" + flags +
               "\n";
    };
    const std::string polyface =
        "0\nPOLYLINE\n8\nsalt\n66\n1\n70\n64\n" + vertex("0", "0", "1", "192") +
        vertex("2", "0", "1", "192") + vertex("2", "2", "1", "192") + vertex("0", "2", "1", "192") +
        "0\nVERTEX\n8\nsalt\n70\n128\n71\n1\n72\n-2\n73\n3\n" +
        "0\nVERTEX\n8\nsalt\n70\n128\n71\n1\n72\n3\n73\n4\n74\n0\n0\nSEQEND\n";
    const std::string mesh =
        "0\nPOLYLINE\n8\ngrid\n66\n1\n70\n16\n71\n2\n72\n3\n" + vertex("0", "0", "0", "64") +
        vertex("1", "0", "0", "64") + vertex("2", "0", "0", "64") + vertex("0", "1", "0", "64") +
        vertex("1", "1", "0", "64") + vertex("2", "1", "0", "64") + "0\nSEQEND\n";
    const std::string subdivided =
        "0\nMESH\n8\nbody\n91\n0\n92\n4\n10\n0\n20\n0\n30\n0\n10\n4\n20\n0\n30\n0\n10\n1\n20\n1\n"
        "30\n0\n10\n0\n20\n4\n30\n0\n93\n5\n90\n4\n90\n0\n90\n1\n90\n2\n90\n3\n94\n1\n90\n0\n90\n1"
        "\n";
    const auto read = parse_surfaces(
        dxf_entities + dxf_triangle + polyface + mesh + subdivided + dxf_end, "a", Format::dxf);
    REQUIRE(read);
    REQUIRE(read->size() == 4);
    CHECK(read->at(1).name == "salt");
    CHECK(read->at(1).triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
    CHECK(read->at(1).vertices == std::vector<Point3>{{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}});
    CHECK(read->at(2).name == "grid");
    CHECK(read->at(2).triangles.size() == 4);
    CHECK(read->at(2).vertices.size() == 6);
    CHECK(read->at(3).name == "body"); // a concave face, divided at its inner corner
    CHECK(read->at(3).triangles.size() == 2);
    CHECK(dxf_message(dxf_entities +
                      "0\nPOLYLINE\n70\n64\n0\nVERTEX\n70\n128\n71\n1\n72\n2\n73\n3\n0\nSEQEND\n" +
                      dxf_end)
              .ends_with("a face names a vertex that does not exist: there are 0"));
    CHECK(dxf_message(dxf_entities + "0\nPOLYLINE\n70\n16\n71\n2\n72\n2\n0\nSEQEND\n" + dxf_end)
              .ends_with("a polygon mesh of 2 times 2 vertices has 0"));
}

TEST_CASE("DXF: blocks where they are inserted: moved, turned, scaled, in rows, in each other",
          "[io][dxf]") {
    const auto block = [](const std::string& name, const std::string& base,
                          const std::string& entities) {
        return "0\nBLOCK\n2\n" + name + "\n10\n" + base + "\n20\n0\n30\n0\n" + entities +
               "0\nENDBLK\n";
    };
    const auto insert = [](const std::string& name, const std::string& more) {
        return "0\nINSERT\n8\nsite\n2\n" + name + "\n" + more;
    };
    // a triangle on layer 0, with its corners at (1, 0, 0), (3, 0, 0) and (1, 1, 2)
    const std::string triangle = "0\n3DFACE\n8\n0\n10\n1\n20\n0\n30\n0\n11\n3\n21\n0\n31\n0\n"
                                 "12\n1\n22\n1\n32\n2\n";
    const auto placed = [&](const std::string& blocks, const std::string& inserts) {
        const auto read = parse_surfaces("0\nSECTION\n2\nBLOCKS\n" + blocks + "0\nENDSEC\n" +
                                             dxf_entities + inserts + dxf_end,
                                         "a", Format::dxf);
        REQUIRE(read);
        REQUIRE(read->size() == 1);
        CHECK(read->at(0).name == "site");
        return read->at(0).vertices;
    };
    using Points = std::vector<Point3>;
    const std::string t = block("t", "1", triangle); // its base is the first corner
    CHECK(placed(t, insert("t", "10\n100\n20\n0\n30\n5\n")) ==
          Points{{100, 0, 5}, {102, 0, 5}, {100, 1, 7}});
    CHECK(placed(t, insert("t", "10\n100\n20\n0\n30\n5\n41\n2\n42\n3\n43\n4\n50\n90\n")) ==
          Points{{100, 0, 5}, {100, 4, 5}, {97, 0, 13}});
    CHECK(placed(t, insert("t", "10\n0\n20\n0\n30\n0\n70\n2\n44\n10\n71\n2\n45\n20\n")).size() ==
          12);
    // seen from below, x goes the other way
    CHECK(placed(t, insert("t", "10\n7\n20\n0\n30\n0\n210\n0\n220\n0\n230\n-1\n")) ==
          Points{{-7, 0, 0}, {-9, 0, 0}, {-7, 1, -2}});
    const std::string twice = block("u", "0", insert("t", "10\n10\n20\n0\n30\n0\n50\n90\n"));
    CHECK(placed(t + twice, insert("u", "10\n0\n20\n1\n30\n0\n50\n90\n")) ==
          Points{{0, 11, 0}, {-2, 11, 0}, {0, 10, 2}});
    CHECK(dxf_message("0\nSECTION\n2\nBLOCKS\n" + block("v", "0", insert("v", "")) + "0\nENDSEC\n" +
                      dxf_entities + insert("v", "") + dxf_end)
              .ends_with("blocks are inserted in each other more than 32 times"));
    std::string growing = t;
    for (char name = 'A'; name < 'Z'; ++name)
        growing +=
            block(std::string(1, name), "0",
                  insert(std::string(1, static_cast<char>(name + 1)), "10\n1\n") +
                      insert(name + 1 == 'Z' ? "t" : std::string(1, static_cast<char>(name + 1)),
                             "10\n2\n"));
    growing += block("Z", "0", insert("t", ""));
    CHECK(dxf_message("0\nSECTION\n2\nBLOCKS\n" + growing + "0\nENDSEC\n" + dxf_entities +
                      insert("A", "") + dxf_end)
              .ends_with("make more faces than the file has bytes"));
}

TEST_CASE("DXF: what can't be read is named with its line", "[io][dxf]") {
    CHECK(dxf_message("AutoCAD Binary DXF\r\n\x1a") ==
          "a: binary DXF is not read; save it as ASCII");
    CHECK(dxf_message("x\n") == "a:1: \"x\" is no group code");
    CHECK(dxf_message("0") == "a:1: the file ends after a group code");
    CHECK(dxf_message(dxf_entities + dxf_triangle) ==
          "a:42: the file ends within the section ENTITIES");
    CHECK(dxf_message(dxf_entities + "0\n3DFACE\n10\nabc\n" + dxf_end) ==
          "a:18: \"abc\" is not a number");
    CHECK(dxf_message(dxf_entities + "0\n3DFACE\n10\n1\n20\n1\n" + dxf_end) ==
          "a:16: corner 2 of the 3DFACE has no x and y");
}

TEST_CASE("DXF: what is written is read back, also names", "[io][dxf]") {
    Mesh mesh;
    mesh.surfaces = {{"top: A/B", Role::horizon}, {"top_ A_B", Role::fault}};
    mesh.vertices = {
        {0.1, -0.0, 5e-324}, {4234567.123456789, 0, 0}, {0, 1.0 / 3, -1e300}, {1, 1, 1}};
    mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
    mesh.surfaces_of.push_back(std::vector<std::uint32_t>{0});
    mesh.surfaces_of.push_back(std::vector<std::uint32_t>{0, 1});
    const auto text = format_mesh(mesh, Format::dxf);
    REQUIRE(text);
    const auto read = parse_surfaces(*text, "a", Format::dxf);
    if (!read) FAIL(read.error().message());
    REQUIRE(read->size() == 2);
    CHECK(read->front().name == "top__A_B");
    CHECK(read->back().name == "top__A_B_2");
    CHECK(read->front().vertices == mesh.vertices);
    CHECK(read->front().triangles == mesh.triangles);
    CHECK(read->back().triangles == std::vector<Triangle>{{0, 1, 2}});
}
