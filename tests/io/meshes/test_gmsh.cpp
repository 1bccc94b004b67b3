// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <terrane/io/meshes/gmsh.hpp>
#include <terrane/io/meshes/gmsh22.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

TEST_CASE("MSH: a triangle of several surfaces is in an entity of its own", "[io][gmsh]") {
    auto mesh = awkward_mesh();
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}, {1, 1, 0.5}, {0, 0, -1}};
    CHECK(to_msh(mesh) == "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
                          "$PhysicalNames\n3\n2 1 \"top reservoir\"\n2 2 \"main 'A' fault\"\n"
                          "2 3 \"top reservoir_2\"\n$EndPhysicalNames\n"
                          "$Entities\n0 0 4 0\n1 0 0 0 1 1 0 1 1 0\n4 0 0 0 1 1 0.5 2 1 2 0\n"
                          "2 0 0 -1 1 1 0.5 1 2 0\n3 0 0 -1 0 0 0 1 3 0\n$EndEntities\n"
                          "$Nodes\n1 6 1 6\n2 1 0 6\n1\n2\n3\n4\n5\n6\n0 0 0\n1 0 0\n0 1 0\n"
                          "9 9 9\n1 1 0.5\n0 0 -1\n$EndNodes\n"
                          "$Elements\n4 4 1 4\n2 1 2 1\n1 1 2 3\n2 4 2 1\n2 2 5 3\n"
                          "2 2 2 1\n3 6 5 1\n2 3 2 1\n4 1 1 6\n$EndElements\n");
}

TEST_CASE("MSH: tetrahedra by block, then faces", "[io][gmsh]") {
    const auto text = to_msh(two_tetrahedra());
    CHECK(text.find("$PhysicalNames\n5\n2 1 \"fault & <co>\"\n2 2 \"base\"\n2 3 \"box\"\n"
                    "3 10 \"outside\"\n3 12 \"block 2\"\n$EndPhysicalNames\n") != text.npos);
    CHECK(text.find("$Elements\n4 4 1 4\n3 1 4 1\n1 1 2 3 4\n3 3 4 1\n2 1 3 2 5\n"
                    "2 4 2 1\n3 1 2 3\n2 3 2 1\n4 1 2 4\n$EndElements\n") != text.npos);
}

TEST_CASE("MSH: blocks have their names", "[io][gmsh]") {
    const std::vector<std::string> names{"ignored", "", "top/\"base\"|fault"};
    const std::string section = "3 10 \"outside\"\n3 12 \"block 2: top/'base'|fault\"\n$EndPhys";
    CHECK(to_msh(two_tetrahedra(), names).find(section) != std::string::npos);
    CHECK(to_msh22(two_tetrahedra(), names).find(section) != std::string::npos);
    const std::vector<std::string> too_few{"ignored"};
    CHECK(to_msh(two_tetrahedra(), too_few) == to_msh(two_tetrahedra()));
}

TEST_CASE("MSH: sides of a cut are groups, nodes at one place are periodic", "[io][gmsh]") {
    const auto text = to_msh(cut_tetrahedra());
    CHECK(text.find("$PhysicalNames\n9\n2 1 \"fault & <co>\"\n2 2 \"base\"\n2 3 \"box\"\n"
                    "2 4 \"fault & <co> front\"\n2 5 \"fault & <co> back\"\n"
                    "2 6 \"base front\"\n2 7 \"base back\"\n") != text.npos);
    CHECK(text.find("4 0 0 0 1 1 0 2 4 6 0\n5 0 0 0 1 1 0 2 5 7 0\n") != text.npos);
    CHECK(text.ends_with("$Periodic\n1\n2 5 4\n0\n2\n6 2\n7 3\n$EndPeriodic\n"));
    const auto old = to_msh22(cut_tetrahedra());
    CHECK(old.find("3 2 2 4 4 1 2 3\n4 2 2 6 6 1 2 3\n5 2 2 3 3 1 2 4\n"
                   "6 2 2 5 5 1 6 7\n7 2 2 7 7 1 6 7\n") != old.npos);
    CHECK(old.ends_with("$Periodic\n2\n2 5 4\n2\n6 2\n7 3\n2 7 6\n2\n6 2\n7 3\n$EndPeriodic\n"));
}
