// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <terrane/io/meshes/gmsh22.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

TEST_CASE("MSH 2.2: a triangle of several surfaces is there once for each", "[io][gmsh]") {
    const auto text = to_msh22(awkward_mesh());
    CHECK(text.starts_with("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                           "$PhysicalNames\n3\n2 1 \"top reservoir\"\n2 2 \"main 'A' fault\"\n"
                           "2 3 \"top reservoir_2\"\n$EndPhysicalNames\n"
                           "$Nodes\n6\n1 0.1 -0 5e-324\n"));
    CHECK(text.ends_with("$Elements\n5\n1 2 2 1 1 1 2 3\n2 2 2 1 1 2 5 3\n3 2 2 2 2 2 5 3\n"
                         "4 2 2 2 2 6 5 1\n5 2 2 3 3 1 1 6\n$EndElements\n"));
}

TEST_CASE("MSH 2.2: tetrahedra by block, then faces", "[io][gmsh]") {
    const auto text = to_msh22(two_tetrahedra());
    CHECK(text.find("$PhysicalNames\n5\n2 1 \"fault & <co>\"\n2 2 \"base\"\n2 3 \"box\"\n"
                    "3 10 \"outside\"\n3 12 \"block 2\"\n$EndPhysicalNames\n") != text.npos);
    CHECK(text.ends_with("$Elements\n5\n1 4 2 10 10 1 2 3 4\n2 4 2 12 12 1 3 2 5\n"
                         "3 2 2 1 1 1 2 3\n4 2 2 2 2 1 2 3\n5 2 2 3 3 1 2 4\n$EndElements\n"));
}
