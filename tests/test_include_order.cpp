// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks what public headers and the verifier may include, and how includes are written.
// tests/test_include_graph.py checks which folder may include which.
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "support/paths.hpp"

namespace fs = std::filesystem;

namespace {

const fs::path root = test_support::source_dir();

/// Returns the text between the brackets or quotes of each include, in order.
std::vector<std::string> includes_of(const fs::path& file) {
    static const std::regex directive(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
    std::vector<std::string> result;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);)
        if (std::smatch found; std::regex_search(line, found, directive))
            result.push_back(found[1]);
    return result;
}

/// Returns "kernel/point.hpp" for <terrane/kernel/point.hpp>, and nothing for headers of others.
std::string ours(const std::string& include) {
    const std::string prefix = "terrane/";
    return include.starts_with(prefix) ? include.substr(prefix.size()) : "";
}

bool is_source(const fs::path& path) {
    return path.extension() == ".hpp" || path.extension() == ".cpp";
}

std::vector<fs::path> sources_in(const std::string& folder) {
    std::vector<fs::path> result;
    if (fs::exists(root / folder))
        for (const auto& entry : fs::recursive_directory_iterator(root / folder))
            if (is_source(entry.path())) result.push_back(entry.path());
    return result;
}

bool is_verifier(const std::string& file) {
    return file.starts_with("algorithms/verify/");
}

/// Returns the installed headers of C++: the two tiers and what they include.
std::set<std::string> public_headers() {
    std::set<std::string> result{"terrane.hpp", "advanced.hpp"};
    for (const char* tier : {"terrane.hpp", "advanced.hpp"})
        for (const std::string& include : includes_of(root / tier)) result.insert(ours(include));
    return result;
}

/// Tells a standard header by its name, which has neither a folder nor an extension.
bool is_standard(const std::string& include) {
    return include.find_first_of("./") == std::string::npos;
}

} // namespace

TEST_CASE("includes: all that is ours is included by its installed name", "[once]") {
    for (const std::string folder : {"fuzzing", "kernel", "algorithms", "io", "capi", "cli"})
        for (const fs::path& file : sources_in(folder))
            for (const std::string& include : includes_of(file)) {
                INFO(file << " includes " << include);
                CHECK_FALSE(fs::exists(file.parent_path() / include));
                if (const std::string target = ours(include); !target.empty())
                    CHECK(fs::exists(root / target));
            }
}

TEST_CASE("includes: public headers include public headers and the standard library only",
          "[once]") {
    const auto listed = public_headers();
    REQUIRE(listed.size() > 40);
    for (const std::string& header : listed) {
        REQUIRE(fs::exists(root / header));
        CHECK(fs::path(header).parent_path().filename() != "detail");
        for (const std::string& include : includes_of(root / header)) {
            INFO(header << " includes " << include);
            const std::string target = ours(include);
            if (target.empty())
                CHECK((is_standard(include) || include == "malloc.h")); // of the C library
            else
                CHECK(listed.count(target) == 1);
        }
    }
}

TEST_CASE("includes: a reader of the API finds few headers in each tier", "[once]") {
    CHECK(includes_of(root / "terrane.hpp").size() <= 15);
    CHECK(includes_of(root / "advanced.hpp").size() <= 35);
    CHECK(public_headers().size() <= 50);
}

TEST_CASE("includes: the producer does not use the verifier", "[once]") {
    // A library of its own.
    const std::string judging = "io/judgement/";
    for (const std::string folder : {"kernel", "algorithms", "io"})
        for (const fs::path& file : sources_in(folder)) {
            const auto name = fs::relative(file, root).generic_string();
            if (is_verifier(name) || name.starts_with(judging)) continue;
            for (const std::string& include : includes_of(file)) {
                INFO(file << " includes " << include);
                CHECK_FALSE(is_verifier(ours(include)));
                CHECK_FALSE(ours(include).starts_with(judging));
            }
        }
}

TEST_CASE("includes: the verifier sees value types, StandardArithmetic, GMP, nettle, zlib and "
          "nlohmann/json only, however far one looks",
          "[once]") {
    const std::set<std::string> value_types{"algorithms/core/index_lists.hpp",
                                            "algorithms/core/result.hpp",
                                            "algorithms/core/standard_arithmetic.hpp",
                                            "algorithms/mesh/mesh.hpp",
                                            "algorithms/mesh/surface.hpp",
                                            "kernel/point.hpp"};
    const std::set<std::string> others{"gmpxx.h", "nettle/sha2.h", "nlohmann/json.hpp", "zlib.h"};
    std::vector<std::string> todo;
    for (const fs::path& file : sources_in("algorithms"))
        if (const auto name = fs::relative(file, root).generic_string(); is_verifier(name))
            todo.push_back(name);
    REQUIRE(todo.size() > 10);
    std::set<std::string> seen(todo.begin(), todo.end());
    while (!todo.empty()) {
        const std::string file = todo.back();
        todo.pop_back();
        for (const std::string& include : includes_of(root / file)) {
            INFO(file << " includes " << include);
            const std::string target = ours(include);
            if (target.empty())
                CHECK((is_standard(include) || others.count(include) == 1));
            else
                CHECK((is_verifier(target) || value_types.count(target) == 1));
            if (!target.empty() && seen.insert(target).second) todo.push_back(target);
        }
    }
}
