// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <terrane/io/text/names.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

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
