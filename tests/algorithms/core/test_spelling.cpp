// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include <terrane/algorithms/core/spelling.hpp>
#include <terrane/algorithms/mesh/labels.hpp>

using namespace terrane;

TEST_CASE("spelling: the nearest name, if one is near enough", "[core]") {
    const std::vector<std::string> names{"volume", "verify", "fill", "edge-length"};
    const auto near = [&](const char* word) { return nearest_name(word, names).value_or("none"); };
    CHECK(near("volum") == "volume");
    CHECK(near("volmue") == "volume"); // neighbours exchanged count once
    CHECK(near("edge-lenght") == "edge-length");
    CHECK(near("edgelength") == "edge-length");
    CHECK(near("vrfy") == "none"); // 2 of 4 letters are too many
    CHECK(near("fil") == "fill");
    CHECK(near("fi") == "none");
    CHECK(near("") == "none");
    CHECK(near("explode") == "none");
    CHECK(nearest_name("volume", {}) == std::nullopt);
}

TEST_CASE("spelling: a name that nothing has", "[mesh]") {
    const std::vector<std::string> names{"top", "base", "fault 1"};
    CHECK(not_called("surface", "bsae", names) == "no surface is called bsae; did you mean base?");
    CHECK(not_called("surface", "roof", names) ==
          "no surface is called roof; there are top, base, fault 1");
    CHECK(not_called("block", "9", {}) == "no block is called 9");
    const std::vector<std::string> many(12, "a");
    CHECK(not_called("surface", "roof", many) ==
          "no surface is called roof; there are a, a, a, a, a, a, a, a, a, a and 2 more");
}
