// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Files of simulators as texts; read_simulators.py opens them with other programs' libraries.
#include <catch2/catch.hpp>

#include <algorithm>

#include <terrane/io/meshes/detail/side_sets.hpp>
#include <terrane/io/meshes/geos.hpp>
#include <terrane/io/meshes/opengeosys.hpp>
#include <terrane/io/meshes/pflotran.hpp>
#include <terrane/io/meshes/pylith.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

std::vector<std::string> names_of_files(const SeveralFiles& files) {
    std::vector<std::string> names;
    for (const auto& file : files) names.push_back(file.file);
    return names;
}

/// Returns the contents of a file; it must be there.
std::string contents_of(const SeveralFiles& files, const std::string& name) {
    const auto at = std::find_if(files.begin(), files.end(),
                                 [&](const PartOfMesh& part) { return part.file == name; });
    REQUIRE(at != files.end());
    return at->contents;
}

} // namespace

TEST_CASE("PFLOTRAN: cells, blocks and faces", "[io][simulators]") {
    const std::vector<std::string> blocks{"", "", "top/base 2"};
    const auto files = to_pflotran(two_tetrahedra(), "a", blocks);
    CHECK(names_of_files(files) == std::vector<std::string>{"", "a_outside.txt", "a_top_base_2.txt",
                                                            "a_fault_co_front.ss",
                                                            "a_fault_co_back.ss", "a_base_front.ss",
                                                            "a_base_back.ss", "a_box.ss"});
    CHECK(files[0].contents ==
          "2 5\nT 1 2 3 4\nT 1 3 2 5\n0 0 0\n1 0 0\n0 1 0\n0.1 0.1 -1\n0 0 1\n");
    CHECK(contents_of(files, "a_top_base_2.txt") == "2\n");
    CHECK(contents_of(files, "a_base_front.ss") == "1\nT 1 3 2\n");
    CHECK(contents_of(files, "a_base_back.ss") == "1\nT 1 2 3\n");
}

TEST_CASE("OpenGeoSys: the mesh, and a file for each side of a surface", "[io][simulators]") {
    const auto files = to_opengeosys(cut_tetrahedra(), {"a", false});
    CHECK(names_of_files(files) ==
          std::vector<std::string>{"", "a_fault_co_front.vtu", "a_fault_co_back.vtu",
                                   "a_base_front.vtu", "a_base_back.vtu", "a_box.vtu"});
    CHECK(files[0].contents.find("<!--\nMaterialIDs:\n0 outside\n2 block_2\n-->") !=
          std::string::npos);
    CHECK(files[0].contents.find("NumberOfPoints=\"7\" NumberOfCells=\"2\"") != std::string::npos);
    CHECK(files[5].contents.find("type=\"UInt64\" Name=\"bulk_element_ids\"") != std::string::npos);
}

TEST_CASE("GEOS: a block for each split surface", "[io][simulators]") {
    const auto whole = to_geos(two_tetrahedra(), {"a", false});
    CHECK(names_of_files(whole) == std::vector<std::string>{"", "a_main.vtu"});
    const auto files = to_geos(cut_tetrahedra(), {"a", false});
    CHECK(names_of_files(files) ==
          std::vector<std::string>{"", "a_main.vtu", "a_fault_co.vtu", "a_base.vtu"});
    CHECK(files[0].contents.find(
              "<DataSet index=\"1\" name=\"fault_co\" file=\"a_fault_co.vtu\"/>") !=
          std::string::npos);
    CHECK(
        files[2].contents.find("IdType=\"1\" Name=\"collocated_nodes\" NumberOfComponents=\"2\"") !=
        std::string::npos);
}

TEST_CASE("PyLith: groups of tetrahedra, surfaces and edges of faults", "[io][simulators]") {
    auto mesh = two_tetrahedra();
    const auto text = to_pylith(mesh).value();
    CHECK(text.find("$PhysicalNames\n5\n2 4 \"fault_co\"\n2 5 \"base\"\n2 6 \"box\"\n"
                    "3 3 \"material-id:3\"\n3 2 \"material-id:2\"\n$End") != text.npos);
    CHECK(code_of(to_pylith(cut_tetrahedra())
                      ? Status(Done{})
                      : to_pylith(cut_tetrahedra()).error()) == ErrorCode::unsupported);
}

TEST_CASE("simulators: names of parts differ", "[io][simulators]") {
    auto mesh = two_tetrahedra();
    mesh.surfaces = {{"F", Role::fault}, {"f", Role::fault}, {"f_FRONT", Role::unknown}};
    const std::vector<std::string> blocks{"F", "", "f_back"};
    const auto parts = detail::named_parts(mesh, blocks);
    CHECK(parts.surfaces == std::vector<std::string>{"F", "f_2", "f_FRONT"});
    std::vector<std::string> names;
    for (const auto& set : parts.side_sets) names.push_back(set.name);
    for (const auto& block : parts.blocks) names.push_back(block.name);
    CHECK(names == std::vector<std::string>{"F_front_2", "F_back", "f_2_front", "f_2_back",
                                            "f_FRONT", "F_3", "f_back_2"});
    CHECK(parts.blocks[0].number == 3); // the outside follows the other blocks
    CHECK(parts.blocks[1].number == 2);
}
