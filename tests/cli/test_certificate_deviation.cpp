// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates that `terrane verify` refuses unless an option allows their deviation: the commands
// that write them say so, with the option.
#include <catch2/catch.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

/// Returns what follows a text, up to the next blank.
std::string word_after(const std::string& text, const std::string& before) {
    const auto at = text.find(before);
    if (at == std::string::npos) return "";
    const auto from = at + before.size();
    return text.substr(from, text.find_first_of(" ,\n", from) - from);
}

} // namespace

TEST_CASE("cli: certificates: a deviation that verify does not accept is warned of",
          "[cli][once]") {
    for (const std::string name :
         {"regression/012-tip-of-needle-vanished.obj", "rounding/re1000070.obj",
          "regression/019-needle-without-area-once-moved.obj"}) {
        INFO(name);
        const Folder folder;
        const auto made = folder.run("arrange $D/" + name + " -o out.vtp --certificate c.json");
        INFO(made.err);
        CHECK(made.status == 0);
        CHECK(contains(made.err, "terrane: warning: c.json states a deviation of "));
        const auto stated = word_after(made.err, "a deviation of ");
        const auto cap = word_after(made.err, "accepts at most ");
        const auto given = word_after(made.err, "--max-deviation ");
        REQUIRE_FALSE(stated.empty());
        CHECK(std::stod(stated) ==
              Catch::Detail::Approx(std::stod(given)).epsilon(1e-5)); // for people
        CHECK(contains(folder.read("c.json"), "\"deviation\":\"" + given + "\""));
        CHECK(std::stod(stated) > std::stod(cap));

        const auto refused = folder.run("verify --folder / c.json");
        CHECK(refused.status == 1);
        CHECK(contains(refused.out + refused.err, cap)); // the same number
        CHECK(folder.run("verify --folder / c.json --max-deviation " + cap).status == 1);
        CHECK(folder.run("verify --folder / c.json --max-deviation " + given).status == 0);
    }
}

TEST_CASE("cli: certificates: no warning of a deviation that verify accepts", "[cli]") {
    const Folder folder;
    folder.input("a.obj", crossing);
    for (const std::string command :
         {"arrange in/a.obj -o out.obj",
          "arrange $D/regression/020-needle-moved-onto-what-it-missed.obj -o out.obj",
          "arrange in/a.obj -o out.obj --box 0,0,-1,2,2,1", "improve in/a.obj -o out.obj",
          "volume in/a.obj -o out"}) {
        INFO(command);
        const auto made = folder.run(command + " --certificate c.json");
        CHECK(made.status == 0);
        CHECK_FALSE(contains(made.err, "deviation"));
        CHECK(folder.run("verify --folder / c.json").status == 0);
    }
}
