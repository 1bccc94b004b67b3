// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates written by the producer for OBJ files that exist in memory only.
#pragma once

#include <catch2/catch.hpp>

#include <set>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/sha256.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/files.hpp>

namespace certificate_cases {

using namespace terrane;

struct File {
    std::string name, contents;
};

inline std::vector<Surface> surfaces_of(const File& file) {
    auto surfaces = parse_surfaces(file.contents, file.name, Format::obj);
    REQUIRE(surfaces);
    return std::move(surfaces).value();
}

inline std::vector<InputFile> input_files(const std::vector<File>& files) {
    std::vector<InputFile> result;
    for (const File& file : files) result.push_back(input_file(file.contents, surfaces_of(file)));
    return result;
}

inline std::string certificate_of(const std::vector<File>& files, bool with_doubles = true) {
    std::vector<InputRecord> records;
    std::vector<Surface> all;
    for (const File& file : files) {
        const auto surfaces = surfaces_of(file);
        records.push_back(
            {file.name, hexadecimal(sha256(file.contents)), file.contents.size(), surfaces.size()});
        all.insert(all.end(), surfaces.begin(), surfaces.end());
    }
    const auto exact = arrange(all);
    REQUIRE(exact);
    const auto rounded = round_to_doubles(exact.value());
    REQUIRE(rounded);
    return to_certificate({records, all, exact.value(), with_doubles ? &rounded.value() : nullptr});
}

/// Returns the violated rules, as "R5 R7", or the error if the text is not a certificate.
inline std::string verdict(const std::vector<InputFile>& files, const std::string& text) {
    const auto certificate = parse_certificate(text, "c.json");
    if (!certificate) return certificate.error().message();
    std::set<std::pair<Rule, std::string>> rules;
    for (const Violation& v : verify_certificate(files, certificate.value()).violations)
        rules.insert({v.rule, name_of(v.rule)});
    std::string result;
    for (const auto& [rule, name] : rules) result += (result.empty() ? "" : " ") + name;
    return result;
}

/// Returns two triangles, one of which pierces the other; the ends of the intersection are not
/// representable as doubles.
inline std::vector<File> pierced() {
    return {{"plane.obj", "v 0 0 0\nv 7 1 0\nv 1 9 0\ng plane\nf 1 2 3\n"},
            {"wall.obj", "v 2 1 -3\nv 3 7 -1\nv 2.5 3 5\ng wall\nf 1 2 3\n"}};
}

/// Returns two surfaces that cross, and a third one apart from them.
inline std::vector<File> with_a_third() {
    auto files = pierced();
    files.push_back({"apart.obj", "v 20 0 0\nv 24 0 0\nv 24 4 1\nv 20 4 1\n"
                                  "g apart\nf 1 2 3\nf 1 3 4\n"});
    return files;
}

/// Returns surfaces with an overlap in a plane, a duplicate, a triangle without area and a wall;
/// all points of the arrangement are doubles.
inline std::vector<File> overlapping() {
    return {{"model.obj", "v 0 0 0\nv 8 0 0\nv 0 8 0\nv 4 0 0\n"
                          "v 2 2 0\nv 10 2 0\nv 2 10 0\n"
                          "v 3 1 -2\nv 3 7 -2\nv 3 4 2\n"
                          "g a\nf 1 2 3\nf 1 4 2\ng b\nf 5 6 7\nf 6 5 7\ng c\nf 8 9 10\n"}};
}

} // namespace certificate_cases
