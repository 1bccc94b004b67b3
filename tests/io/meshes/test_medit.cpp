// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <terrane/io/meshes/medit.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

TEST_CASE("MEDIT: references tell surfaces, also where there are several", "[io][medit]") {
    const auto text = to_medit(awkward_mesh());
    CHECK(text.starts_with("MeshVersionFormatted 2\n# references of triangles\n"
                           "# 1: top reservoir\n# 2: main 'A' fault\n# 3: top reservoir_2\n"
                           "# 4: top reservoir, main 'A' fault\n\nDimension 3\n\nVertices\n6\n"
                           "0.1 -0 5e-324 0\n"));
    CHECK(text.ends_with("\nTriangles\n4\n1 2 3 1\n2 5 3 4\n6 5 1 2\n1 1 6 3\n\nEnd\n"));
}

TEST_CASE("MEDIT: the reference of a tetrahedron is its block", "[io][medit]") {
    CHECK(to_medit(two_tetrahedra())
              .ends_with("\nTriangles\n2\n1 2 3 4\n1 2 4 3\n\n"
                         "Tetrahedra\n2\n1 2 3 4 0\n1 3 2 5 2\n\nEnd\n"));
}

TEST_CASE("MEDIT: sides of a cut have references, pairs of nodes are comments", "[io][medit]") {
    const auto text = to_medit(cut_tetrahedra());
    CHECK(text.find("# 4: fault & <co> front, base front\n# 5: fault & <co> back, base back\n") !=
          text.npos);
    CHECK(text.ends_with("\nTriangles\n3\n1 2 3 4\n1 2 4 3\n1 6 7 5\n\n"
                         "Tetrahedra\n2\n1 2 3 4 0\n1 7 6 5 2\n\n"
                         "# vertices in front and back of fault & <co>\n# 2 6\n# 3 7\n\n"
                         "# vertices in front and back of base\n# 2 6\n# 3 7\n\nEnd\n"));
}
