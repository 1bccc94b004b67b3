// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <terrane/io/meshes/abaqus.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

TEST_CASE("Abaqus: surfaces are element sets", "[io][abaqus]") {
    const auto text = to_abaqus(awkward_mesh());
    CHECK(text.find("*NODE\n1, 0.1, -0, 5e-324\n2, 4234567.123456789, ") != text.npos);
    CHECK(text.ends_with("*ELEMENT, TYPE=S3\n1, 1, 2, 3\n2, 2, 5, 3\n3, 6, 5, 1\n4, 1, 1, 6\n"
                         "*ELSET, ELSET=TOP_RESERVOIR\n1, 2\n"
                         "*ELSET, ELSET=MAIN__A__FAULT\n2, 3\n"
                         "*ELSET, ELSET=TOP_RESERVOIR_2\n4\n"));
}

TEST_CASE("Abaqus: blocks are element sets, surfaces node sets and sides", "[io][abaqus]") {
    const auto text = to_abaqus(two_tetrahedra());
    CHECK(text.ends_with("** outside\n*ELEMENT, TYPE=C3D4, ELSET=OUTSIDE\n1, 1, 2, 3, 4\n"
                         "** block 2\n*ELEMENT, TYPE=C3D4, ELSET=BLOCK_2\n2, 1, 3, 2, 5\n"
                         "*NSET, NSET=FAULT____CO_\n1, 2, 3\n"
                         "*SURFACE, TYPE=ELEMENT, NAME=FAULT____CO__FRONT\n1, S1\n"
                         "*SURFACE, TYPE=ELEMENT, NAME=FAULT____CO__BACK\n2, S1\n"
                         "*NSET, NSET=BASE\n1, 2, 3\n"
                         "*SURFACE, TYPE=ELEMENT, NAME=BASE_FRONT\n1, S1\n"
                         "*SURFACE, TYPE=ELEMENT, NAME=BASE_BACK\n2, S1\n"
                         "*NSET, NSET=BOX\n1, 2, 4\n"
                         "*SURFACE, TYPE=ELEMENT, NAME=BOX_BACK\n1, S2\n"));
}

TEST_CASE("Abaqus: element sets are called after blocks, where those have names", "[io][abaqus]") {
    auto mesh = two_tetrahedra();
    const std::vector<std::string> names{"outside", "", "Outside"};
    const auto text = to_abaqus(mesh, names);
    CHECK(text.find("** outside\n*ELEMENT, TYPE=C3D4, ELSET=OUTSIDE\n1, ") != text.npos);
    CHECK(text.find("** block 2: Outside\n*ELEMENT, TYPE=C3D4, ELSET=OUTSIDE_2\n2, ") != text.npos);
    mesh.block_of = {1, 2};
    const std::vector<std::string> blocks{"outside", "top/base|box", "top/base|box 2\nx"};
    const auto of_blocks = to_abaqus(mesh, blocks);
    CHECK(of_blocks.find("** block 1: top/base|box\n*ELEMENT, TYPE=C3D4, ELSET=TOP_BASE_BOX\n") !=
          text.npos);
    CHECK(of_blocks.find("** block 2: top/base|box 2 x\n"
                         "*ELEMENT, TYPE=C3D4, ELSET=TOP_BASE_BOX_2_X\n") != text.npos);
}

TEST_CASE("Abaqus: nodes on both sides of a cut are listed pair by pair", "[io][abaqus]") {
    const auto text = to_abaqus(cut_tetrahedra());
    CHECK(text.find("*SURFACE, TYPE=ELEMENT, NAME=BASE_FRONT\n1, S1\n"
                    "*SURFACE, TYPE=ELEMENT, NAME=BASE_BACK\n2, S1\n"
                    "*NSET, NSET=BASE_PAIRS_FRONT, UNSORTED\n2, 3\n"
                    "*NSET, NSET=BASE_PAIRS_BACK, UNSORTED\n6, 7\n") != text.npos);
}

TEST_CASE("Abaqus: sets have at most 16 numbers in a line", "[io][abaqus]") {
    Mesh mesh;
    mesh.surfaces = {{"a", Role::unknown}};
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (int i = 0; i < 17; ++i) {
        mesh.triangles.push_back({0, 1, 2});
        mesh.surfaces_of.push_back(std::vector<std::uint32_t>{0});
    }
    CHECK(to_abaqus(mesh).ends_with(
        "ELSET=A\n1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16\n17\n"));
}
