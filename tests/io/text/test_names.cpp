// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <terrane/io/text/names.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

TEST_CASE("names of one word are different, also without capital letters", "[io][names]") {
    detail::WordNames names;
    const auto word = [&](const std::string& name) { return names.add(name, "surface"); };
    CHECK(word("below top, above base") == "below_top_above_base");
    CHECK(word(" F-1 / F 2 (west)") == "F-1_F_2_west");
    CHECK(word("f-1_f_2_WEST") == "f-1_f_2_WEST_2");
    CHECK(word("f-1_f_2_west_2") == "f-1_f_2_west_2_2");
    CHECK(word("") == "surface");
    CHECK(word("../--") == "surface_2");
    CHECK(word("7th") == "surface_7th");
    CHECK(word("\xc3\xa9t\xc3\xa9") == "\xc3\xa9t\xc3\xa9");
    CHECK(word("a\xff\xff"
               "b") == "a_b"); // no UTF-8
    CHECK(word(std::string(300, 'x')).size() == 200);
    CHECK(word(std::string(199, 'y') + "\xc3\xa9").size() == 199); // no half of a character
}

TEST_CASE("Abaqus: labels are short, capital and different", "[io][abaqus]") {
    const auto labels = [](const std::vector<std::string>& names) {
        std::vector<SurfaceInfo> surfaces;
        for (const auto& name : names) surfaces.push_back({name, Role::unknown});
        return detail::label_names(surfaces);
    };
    CHECK(
        labels({"top reservoir", "Top-Reservoir", "", "7th", "\xc3\xa9t\xc3\xa9"}) ==
        std::vector<std::string>{"TOP_RESERVOIR", "TOP_RESERVOIR_2", "SURFACE", "S7TH", "S__T__"});
    CHECK(labels({std::string(100, 'x')})[0].size() == 60);
}
