// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A project of two horizons and a fault in a box, for tests of `terrane build`.
#pragma once

#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace program_test {

/// Two horizons that reach beyond the box.
inline const std::string base_and_top = level("base", "3") + level("top", "5");

/// Three horizons that reach beyond the box, and a fault that ends inside it.
inline const std::string layers = base_and_top + polygon("spare", "-1 -1 6, 9 -1 6, 9 9 6");
inline const std::string fault = polygon("", "4 -1 -1, 4 4 -1, 4 4 9, 4 -1 9");

/// Returns a project of the files in in/, with a box as volume of interest.
inline Json boxed_project() {
    return Json::parse(R"({
        "format": "terrane-project 1",
        "surfaces": [{"file": "layers.obj", "objects": ["base", "top"], "role": "horizon"},
                     {"file": "fault.obj", "name": "F1", "role": "fault"}],
        "volume_of_interest": {"box": {"low": [0, 0, 0], "high": [8, 8, 8]}},
        "outputs": {"surfaces": ["vtp", "msh22"], "blocks": "obj"}})");
}

struct Case {
    Folder folder;

    Case() {
        folder.input("layers.obj", layers);
        folder.input("fault.obj", fault);
    }
    [[nodiscard]] Outcome build(const Json& json, const std::string& arguments = "-o out") const {
        return folder.run("build " + folder.input("p.json", json.dump(2)) + " " + arguments);
    }
    /// Lists a folder, one name a line.
    [[nodiscard]] std::string files(const std::string& in) const {
        const auto listed = folder.shell("LC_ALL=C ls " + in);
        REQUIRE(listed.status == 0);
        return listed.out;
    }
};

} // namespace program_test
