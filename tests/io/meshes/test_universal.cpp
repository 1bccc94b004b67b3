// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Universal files and grids of FLAC3D; read_back.py reads them with Gmsh and meshio.
#include <catch2/catch.hpp>

#include <string>

#include <terrane/io/meshes/flac3d.hpp>
#include <terrane/io/meshes/universal.hpp>

#include "support/samples.hpp"

namespace universal_test {

using namespace terrane;
using namespace test_support;

TEST_CASE("UNV: columns are those of the datasets", "[io][unv]") {
    const auto text = to_universal(two_tetrahedra());
    REQUIRE(text);
    CHECK(text->starts_with("    -1\n  2411\n"
                            "         1         1         1        11\n"
                            "   0.0000000000000000D+00   0.0000000000000000D+00"
                            "   0.0000000000000000D+00\n"));
    CHECK(text->find("         1       111         1         1         7         4\n"
                     "         1         2         3         4\n") != std::string::npos);
    CHECK(text->find("         3        91         2         2         7         3\n"
                     "         1         2         3\n") != std::string::npos);
    CHECK(text->ends_with("         5         0         0         0         0         0         0"
                          "         1\nbox\n"
                          "         8         4         0         0\n    -1\n"));
}

TEST_CASE("UNV: long names are cut, and stay different", "[io][unv]") {
    auto mesh = awkward_mesh();
    const std::string start(39, 'a'), other = std::string(37, 'a').append("\xc3\xa9z\xc3\xa9");
    mesh.surfaces = {{start + "bb", Role::unknown}, {other, Role::unknown}, {"c", Role::fault}};
    const auto text = to_universal(mesh).value();
    CHECK(text.find("\n" + std::string(38, 'a') + "~1\n") != std::string::npos);
    CHECK(text.find("\n" + std::string(37, 'a') + "~2\n") != std::string::npos);
    CHECK(text.find("\nc\n") != std::string::npos);
}

TEST_CASE("FLAC3D: groups of a face have slots of their own", "[io][flac3d]") {
    const auto text = to_flac3d(two_tetrahedra());
    CHECK(text.find("* ZONES\nZ T4 1 1 2 3 4\nZ T4 2 1 3 2 5\n") != std::string::npos);
    CHECK(text.find("FGROUP \"fault_co\" SLOT 1\n1\nFGROUP \"base\" SLOT 2\n1\n"
                    "FGROUP \"box\" SLOT 3\n2\n") != std::string::npos);
}

} // namespace universal_test
