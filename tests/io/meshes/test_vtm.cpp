// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/vtm.hpp>

#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <pugixml.hpp>

using namespace terrane;

TEST_CASE("VTM: groups and names", "[io][vtk]") {
    const std::vector<FileGroup> groups{{"blocks", {{"a & <b>", "b/1.vtp"}, {"c", "b/2.vtp"}}},
                                        {"empty", {}}};
    pugi::xml_document xml;
    REQUIRE(xml.load_string(to_vtm(groups).c_str()));
    const auto sets = xml.child("VTKFile").child("vtkMultiBlockDataSet");
    const auto first = sets.child("Block");
    CHECK(std::string(first.attribute("name").value()) == "blocks");
    CHECK(std::string(first.child("DataSet").attribute("name").value()) == "a & <b>");
    CHECK(std::string(first.last_child().attribute("file").value()) == "b/2.vtp");
    CHECK(first.last_child().attribute("index").as_int() == 1);
    CHECK(sets.last_child().attribute("index").as_int() == 1);
    CHECK_FALSE(sets.last_child().first_child());
}
