// SPDX-License-Identifier: LGPL-3.0-or-later
#include "program.hpp"

#include <catch2/catch.hpp>

#include <sstream>

namespace {

using program_test::Folder;
using program_test::Json;

/// Two rectangles that cross.
constexpr auto sheets = R"(o flat
v 0 0 0
v 4 0 0
v 4 4 0
v 0 4 0
f 1 2 3
f 1 3 4
o wall
v 1 -1 -1
v 2 5 -1
v 1.7 2 3
f 5 6 7
)";

/// Tetrahedra that cross; the first can be without a triangle.
std::string solids(double x, bool open = false) {
    const auto at = [&](double dx) { return std::to_string(x + dx); };
    return "OFF\n4 " + std::string(open ? "3" : "4") + " 0\n" + at(0) + " 0 0\n" + at(2) +
           " 0 0\n" + at(0) + " 2 0\n" + at(0) + " 0 2\n3 0 2 1\n3 0 1 3\n3 1 2 3\n" +
           (open ? "" : "3 0 3 2\n");
}

} // namespace

TEST_CASE("judge: a mesh of its inputs holds, another one fails, and the status says so") {
    const Folder folder;
    const auto in = folder.input("sheets.obj", sheets);
    REQUIRE(folder.run("arrange " + in + " -o made.obj --quiet").status == 0);
    auto outcome = folder.run("judge made.obj " + in);
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK(outcome.out.find("topology: holds") != std::string::npos);
    CHECK(outcome.out.find("result: all hold") != std::string::npos);
    outcome = folder.run("judge made.obj " + in + " --json");
    CHECK(outcome.status == 0);
    std::istringstream lines(outcome.out);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line); ++count)
        CHECK(Json::parse(line).at("verdict") == "holds");
    CHECK(count == 8);
    CHECK(folder.run("judge made.obj " + in + " --tags").out ==
          "{\"TAG_NAME\": \"VALID_OUTPUT\", \"TAG\": \"OK\"}\n");

    outcome = folder.run("judge " + in + " " + in + " --tags");
    CHECK(outcome.status == 1);
    CHECK(outcome.out == "{\"TAG_NAME\": \"SELF_INTERSECTING_OUTPUT\", \"TAG\": \"Error\"}\n");
    outcome = folder.run("judge " + in + " " + in);
    CHECK(outcome.out.find("flat triangle 0, wall triangle 0") != std::string::npos);
    const auto flat = folder.input("flat.obj", std::string(sheets).substr(0, 60));
    CHECK(folder.run("judge " + flat + " " + in).status == 1);
}

TEST_CASE("judge: Boolean operations of the solids in files") {
    const Folder folder;
    const auto a = folder.input("a.off", solids(0)), b = folder.input("b.off", solids(0.5)),
               open = folder.input("open.off", solids(0, true)),
               apart = folder.input("apart.off", solids(9));
    CHECK(folder.run("judge " + a + " " + a + " " + apart + " --operation difference").status == 0);
    CHECK(folder.run("judge " + a + " " + a + " " + b + " --operation difference").status == 1);
    CHECK(folder.run("judge " + a + " " + a + " " + a + " --operation intersection").status == 0);
    const auto refused =
        folder.run("judge " + a + " " + open + " " + b + " --operation union --tags");
    CHECK(refused.status == 2);
    CHECK(refused.out.find("INPUT_IS_INVALID") != std::string::npos);
    CHECK(refused.err.find("operand 1: bounds no solid") != std::string::npos);
    const auto none = folder.input("none.off", "OFF\n0 0 0\n"); // an empty mesh
    CHECK(
        folder.run("judge " + none + " " + a + " " + apart + " --operation intersection").status ==
        0);
    CHECK(folder.run("judge " + none + " " + a + " " + b + " --operation intersection").status ==
          1);
    CHECK(folder.run("judge --soup " + none).status == 2);
    CHECK(folder.run("judge --soup " + a).status == 0);
    CHECK(folder.run("judge --soup " + open).out.find("closed: fails") != std::string::npos);
}

TEST_CASE("judge: tetrahedra of a file are judged by the surfaces that they fill") {
    const Folder folder;
    const auto in = folder.input("solid.off", solids(0));
    const std::string start = "# vtk DataFile Version 2.0\n\nASCII\nDATASET "
                              "UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 2 0 0 "
                              "0 2 0 0 0 ",
                      cells = "\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";
    const auto good = folder.input("good.vtk", start + "2" + cells),
               bad = folder.input("bad.vtk", start + "3" + cells);
    auto outcome = folder.run("judge " + good + " " + in);
    CHECK(outcome.status == 0);
    CHECK(outcome.out.find("good.vtk: 1 tetrahedra\npositive: holds") != std::string::npos);
    CHECK(outcome.out.find("labels") == std::string::npos);
    outcome = folder.run("judge " + bad + " " + in + " --json");
    CHECK(outcome.status == 1);
    CHECK(outcome.out.find("\"tetrahedra\":[0]") != std::string::npos);
    CHECK(folder.run("judge " + bad + " " + in).out.find(": tetrahedron 0\n") != std::string::npos);
    // Without triangles it is an empty mesh.
    CHECK(folder.run("judge " + good + " " + in + " --operation union").status == 1);
}

TEST_CASE("judge: bad usage has the status 2, and limits 3") {
    const Folder folder;
    const auto in = folder.input("sheets.obj", sheets);
    CHECK(folder.run("judge " + in).status == 2);
    CHECK(folder.run("judge none.obj " + in).status == 2);
    CHECK(folder.run("judge " + in + " " + in + " --input-format none").status == 2);
    CHECK(folder.run("judge --soup " + in + " " + in).status == 2);
    CHECK(folder.run("judge --soup " + in + " --operation union").status == 2);
    CHECK(folder.run("judge " + in + " " + in + " --operation merge").status == 2);
    const auto late =
        folder.run("judge $D/ringmesh/modelA2.ml $D/ringmesh/modelA2.ml --time 1e-9 --tags");
    CHECK(late.status == 3);
    CHECK(late.out.find("TIMEOUT") != std::string::npos);
    CHECK(late.err.find("--time") != std::string::npos);
}
