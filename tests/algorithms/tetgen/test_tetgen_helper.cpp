// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests where TetGen's helper program is looked for.
#include <terrane/algorithms/tetgen/tetrahedra.hpp>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <catch2/catch.hpp>

#include "support/impostor.hpp"

using namespace terrane;
using namespace impostor;

namespace {

Mesh flat_square() {
    Mesh mesh{.surfaces = {{"sheet", Role::unknown}},
              .vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
              .triangles = {{0, 1, 2}, {0, 2, 3}},
              .surfaces_of = {},
              .regions_of = {},
              .parents_of = {},
              .intersection_edges = {}};
    for (int t = 0; t < 2; ++t) mesh.surfaces_of.push_back(std::array{0U});
    return mesh;
}

/// Sets an environment variable and restores it at the end.
class Variable {
public:
    Variable(const char* name, const std::string& value) : name_(name) {
        setenv(name, value.c_str(), 1);
    }
    ~Variable() { unsetenv(name_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    const char* name_;
};

} // namespace

TEST_CASE("TetGen's helper: it is found beside the program, by a variable, or by the option",
          "[tetrahedra][helper]") {
    const auto usual = find_tetgen_helper();
    REQUIRE(usual);
    CHECK(usual.value().filename() == "terrane-tetgen");
    CHECK(find_tetgen_helper("/bin/sh").value() == "/bin/sh");
    const Variable variable("TERRANE_TETGEN", "/bin/sh");
    CHECK(find_tetgen_helper().value() == "/bin/sh");
    CHECK(find_tetgen_helper(usual.value()).value() == usual.value()); // the option comes first
    const Variable empty("TERRANE_TETGEN", "");
    CHECK(find_tetgen_helper().value() == usual.value());
}

TEST_CASE("TetGen's helper: what is named but can't be run is an error, not passed over",
          "[tetrahedra][helper]") {
    for (const std::string bad : {"/nowhere/terrane-tetgen", "/tmp", "/etc/passwd"}) {
        const auto given = find_tetgen_helper(bad);
        REQUIRE_FALSE(given);
        CHECK(given.error().code == ErrorCode::cannot_open);
        CHECK(given.error().place == bad);
        CHECK(contains(given.error().sentence, "option helper"));
        const auto made = tetrahedralize(flat_square(), {.helper = bad}, {});
        REQUIRE_FALSE(made);
        CHECK(made.error().message() == given.error().message());
        const Variable variable("TERRANE_TETGEN", bad);
        const auto by_variable = find_tetgen_helper();
        REQUIRE_FALSE(by_variable);
        CHECK(by_variable.error().place == bad);
        CHECK(contains(by_variable.error().sentence, "TERRANE_TETGEN"));
    }
}

TEST_CASE("TetGen's helper: where it vanishes after it was found, the error names it",
          "[tetrahedra][helper]") {
    TetgenInput input = cube_input();
    input.helper = "/nowhere/terrane-tetgen";
    const auto output = run_mesher(input, {});
    REQUIRE_FALSE(output);
    CHECK(output.error().code == ErrorCode::cannot_open);
    CHECK(output.error().message() ==
          "/nowhere/terrane-tetgen: TetGen's helper can't be run: No such file or directory");
}
