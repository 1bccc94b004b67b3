// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Output files that are not what their certificate says, with right hashes: each is refuted.
#include "support/forged.hpp"

#include <cctype>

namespace {

using namespace forged;

const std::vector<std::string> all_formats{"obj", "off",       "ply", "stl",   "ts", "stl-ascii",
                                           "vtp", "vtp-plain", "msh", "msh22", "inp"};

/// Surfaces with names that formats must change, and triangles of two surfaces.
std::vector<File> named() {
    return {{"model.obj", "v 0 0 0\nv 8 0 0\nv 0 8 0\nv 2 2 0\nv 10 2 0\nv 2 10 0\n"
                          "v 3 1 -2\nv 3.25 7 -2.5\nv 3 4 2.125\n"
                          "g top#1\nf 1 2 3\ng base\nf 4 5 6\ng wall\nf 7 8 9\n"}};
}

/// A strip of more triangles than sets of Abaqus have on a line, with a name that is nearly a label.
std::vector<File> long_strip() {
    std::string vertices, faces;
    for (int i = 0; i <= 17; ++i) {
        vertices += "v " + std::to_string(i) + " 0 0\nv " + std::to_string(i) + " 1 0\n";
        if (i < 17)
            faces += "f " + std::to_string(2 * i + 1) + " " + std::to_string(2 * i + 3) + " " +
                     std::to_string(2 * i + 2) + "\n";
    }
    return {{"strip.obj", vertices + "g Z9-a[{@`\n" + faces}};
}

std::string judged_file(const Subject& s, std::size_t i) {
    const auto certificate = parse_certificate(s.certificate.dump(), "c");
    REQUIRE(certificate);
    const auto verdict = verify_output(s.contents[i], certificate.value(), i);
    return verdict.violations.empty() ? "" : verdict.violations[0].sentence;
}

/// Changes the contents of output 0, seals the certificate, and returns what is said of it.
std::string judged_as(Subject s, const std::string& contents) {
    s.contents[0] = contents;
    seal(s);
    return judged_file(s, 0);
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string replaced(std::string text, const std::string& old, const std::string& by) {
    const auto at = text.find(old);
    INFO(old);
    REQUIRE(at != std::string::npos);
    return text.replace(at, old.size(), by);
}

/// A change of a file, and the place where the verifier sees it.
struct FileForgery {
    std::string name, old, by, place;
};

void check_files(const std::string& format, const std::vector<FileForgery>& forgeries) {
    const Subject s = subject(named(), {format});
    REQUIRE(judged(s) == "");
    for (const FileForgery& f : forgeries) {
        INFO(format << ": " << f.name);
        const auto sentence = judged_as(s, replaced(s.contents[0], f.old, f.by));
        INFO(sentence);
        CHECK(contains(sentence, format + ", " + f.place));
    }
}

} // namespace

TEST_CASE("verify_output: files of all formats that it writes") {
    for (const auto& files : {pierced(), overlapping(), named(), long_strip()}) {
        const Subject s = subject(files, all_formats);
        CHECK(judged(s) == "");
        const auto certificate = parse_certificate(s.certificate.dump(), "c");
        REQUIRE(certificate);
        for (std::size_t i = 0; i < all_formats.size(); ++i) {
            INFO(all_formats[i]);
            const auto verdict = verify_output(s.contents[i], certificate.value(), i);
            CHECK(verdict.violations.empty());
            CHECK(verdict.renamed.empty());
            CHECK(verdict.check == (all_formats[i] == "stl"   ? OutputCheck::float32
                                    : all_formats[i] == "vtp" ? OutputCheck::inflated
                                                              : OutputCheck::every_byte));
        }
    }
}

TEST_CASE("verify_output: formats without a writer are compared by their hash only") {
    const Subject s = subject(pierced(), {"poly"});
    const auto certificate = parse_certificate(s.certificate.dump(), "c");
    REQUIRE(certificate);
    const auto verdict = verify_output(s.contents[0], certificate.value(), 0);
    CHECK(verdict.check == OutputCheck::hash_only);
    CHECK(verdict.violations.empty());
    CHECK_FALSE(verify_output(s.contents[0] + " ", certificate.value(), 0).violations.empty());
}

TEST_CASE("verify_output: each byte of each format, without a new hash") {
    const Subject s = subject(pierced(), all_formats);
    const auto certificate = parse_certificate(s.certificate.dump(), "c");
    REQUIRE(certificate);
    for (std::size_t i = 0; i < all_formats.size(); ++i)
        for (std::size_t at = 0; at < s.contents[i].size(); at += 3) {
            std::string wrong = s.contents[i];
            wrong[at] = static_cast<char>(wrong[at] ^ 1);
            INFO(all_formats[i] << " byte " << at);
            CHECK_FALSE(verify_output(wrong, certificate.value(), i).violations.empty());
        }
}

TEST_CASE("forged output files: a byte altered, deleted or inserted, with a new hash") {
    for (const auto& files : {named(), overlapping()}) check_each_byte(subject(files, all_formats));
}

TEST_CASE("forged output files: each digit of text formats, with a new hash") {
    for (const std::string format : {"obj", "off", "ts", "stl-ascii", "msh", "msh22"}) {
        const Subject s = subject(pierced(), {format});
        const std::string& right = s.contents[0];
        for (std::size_t at = 0; at < right.size(); ++at) {
            if (std::isdigit(static_cast<unsigned char>(right[at])) == 0) continue;
            std::string wrong = right;
            wrong[at] = wrong[at] == '9' ? '0' : static_cast<char>(wrong[at] + 1);
            INFO(format << " byte " << at);
            CHECK(judged_as(s, wrong) != "");
        }
    }
}

TEST_CASE("forged output files: each byte of binary formats, with a new hash") {
    for (const std::string format : {"ply", "stl"}) {
        const Subject s = subject(pierced(), {format});
        const std::string& right = s.contents[0];
        for (std::size_t at = 0; at < right.size(); ++at) {
            std::string wrong = right;
            wrong[at] = static_cast<char>(wrong[at] ^ 1);
            INFO(format << " byte " << at);
            CHECK(judged_as(s, wrong) != "");
        }
    }
}

TEST_CASE("forged output files: each character of VTP that is not compressed") {
    const Subject s = subject(pierced(), {"vtp-plain"});
    const std::string& right = s.contents[0];
    for (std::size_t at = 0; at < right.size(); ++at) {
        std::string wrong = right;
        wrong[at] = wrong[at] == 'B' ? 'C' : 'B';
        INFO("byte " << at);
        CHECK(judged_as(s, wrong) != "");
    }
}

TEST_CASE("forged output files: OBJ") {
    check_files("obj", {{"another coordinate", "v 8 0 0", "v 8 0 1", "line 2, byte 15: \"0\""},
                        {"minus zero", "v 0 0 0", "v 0 -0 0", "line 1, byte 5: \"0\""},
                        {"another decimal of the same number", "v 8 0 0", "v 8.0 0 0", "line 2"},
                        {"a vertex too many", "v 8 0 0\n", "v 8 0 0\nv 8 0 0\n", "line 3"},
                        {"a vertex less", "v 8 0 0\n", "", "line 2"},
                        {"a weight", "v 8 0 0\n", "v 8 0 0 1\n", "line 2"},
                        {"a comment", "g top", "# top\ng top", "line 15"},
                        {"two blanks", "v 8 0 0", "v  8 0 0", "line 2"},
                        {"another group", "g base", "g top_1", "line 25, byte "},
                        {"a group less", "g base\n", "", "line 25"},
                        {"a normal", "\nf ", "\nvn 0 0 1\nf ", "line 16"},
                        {"carriage returns", "v 8 0 0\n", "v 8 0 0\r\n",
                         "line 2, byte 16: the line must end here"}});
    const Subject s = subject(named(), {"obj"});
    CHECK(contains(judged_as(s, s.contents[0] + "f 1 2 3\n"), "the file must end here"));
    CHECK(contains(judged_as(s, ""), "line 1, byte 1: the file ends too early"));
    CHECK(contains(judged_as(s, s.contents[0].substr(0, s.contents[0].size() - 1)),
                   "the file ends too early"));
}

TEST_CASE("forged output files: OFF, STL as text, TSurf, VTP") {
    check_files("off", {{"a comment", "OFF\n", "OFF\n# 1\n", "line 2"},
                        {"another corner", "\n3 0 ", "\n4 0 ", "line 17"},
                        {"with colours", "OFF\n", "COFF\n", "line 1, byte 1: \"OFF\" is needed"}});
    check_files("stl-ascii", {{"another name", "solid base", "solid wall", "line "},
                              {"a normal", "normal 0 0 1", "normal 0 0 2", "line 2"},
                              {"a facet less", "endfacet\n", "", "line 8"}});
    check_files("ts", {{"depth", "ZPOSITIVE Elevation", "ZPOSITIVE Depth", "line 8"},
                       {"another name", "name: base", "name: top", "line "},
                       {"a role", "TFACE", "GEOLOGICAL_TYPE fault\nTFACE", "line 10"}});
    check_files("vtp", {{"another name", "116 111 112 35 49 0", "116 111 112 35 50 0", "line 6"},
                        {"another role", "117 110 107 110 111 119 110 0", "102 97 117 108 116 0",
                         "line 11"},
                        {"an array too many", "<Points>",
                         "<DataArray type=\"Int32\"></DataArray>\n<Points>", "line "},
                        {"a second piece in a line of names", "</FieldData>",
                         "<Array type=\"String\" Name=\"block_name\"/></FieldData><Piece/>\n"
                         "0\n</Array>\n</FieldData>",
                         "line "}});
}

TEST_CASE("forged output files: files of another mesh") {
    const Subject s = subject(named(), all_formats);
    const Subject other = subject(pierced(), all_formats);
    for (std::size_t i = 0; i < all_formats.size(); ++i) {
        INFO(all_formats[i]);
        Subject wrong = s;
        wrong.contents[i] = other.contents[i];
        seal(wrong);
        CHECK(judged(wrong) == "R21");
        wrong.contents[i] = s.contents[(i + 2) % all_formats.size()];
        seal(wrong);
        CHECK(judged(wrong) == "R21");
        wrong.contents[i].clear();
        seal(wrong);
        CHECK(judged(wrong) == "R21");
        wrong.contents[i] = s.contents[i] + s.contents[i];
        seal(wrong);
        CHECK(judged(wrong) == "R21");
    }
}

TEST_CASE("forged output files: what the certificate says about them") {
    const Subject s = subject(named(), {"obj"});
    check_forgeries(
        s, {{"as STL", [](Json& c) { c["outputs"][0]["format"] = "stl"; }, "R21"},
            {"as TSurf", [](Json& c) { c["outputs"][0]["format"] = "ts"; }, "R21"},
            {"a surface less", [](Json& c) { c["outputs"][0]["surfaces"].erase(0); }, "R21"},
            {"no surfaces", [](Json& c) { c["outputs"][0]["surfaces"] = Json::array(); }, "R21"},
            {"two names exchanged",
             [](Json& c) {
                 std::swap(c["outputs"][0]["surfaces"][0], c["outputs"][0]["surfaces"][1]);
             },
             "R21"}});
    Subject wrong = s;
    wrong.certificate["outputs"][0]["sha256"] = std::string(64, '0');
    CHECK(contains(judged_file(wrong, 0), "another SHA-256"));
    wrong = s;
    wrong.certificate["outputs"][0]["bytes"] = 1;
    CHECK(contains(judged_file(wrong, 0), "another SHA-256 or size"));
}

TEST_CASE("verify_output names surfaces that the file calls otherwise") {
    Subject s = subject(named(), {"obj"});
    s.certificate["outputs"][0]["surfaces"][1]["name"] = "floor";
    s.contents[0] = replaced(s.contents[0], "g base", "g floor");
    while (contains(s.contents[0], "base"))
        s.contents[0] = replaced(s.contents[0], "base", "floor");
    seal(s);
    const auto certificate = parse_certificate(s.certificate.dump(), "c");
    REQUIRE(certificate);
    const auto verdict = verify_output(s.contents[0], certificate.value(), 0);
    CHECK(verdict.violations.empty());
    CHECK(verdict.renamed == std::vector<std::uint32_t>{1});
}

TEST_CASE("verify_output: a mesh that is conforming in doubles, but not in float32") {
    // The second sheet is so near that float32 cannot tell it from the first, but for one corner.
    const std::vector<File> files{{"near.obj", "v 0 0 1\nv 8 0 1\nv 0 8 1\n"
                                               "v 0 0 1.00000001\nv 8 0 1.00000001\nv 1 9 1.5\n"
                                               "g a\nf 1 2 3\ng b\nf 4 5 6\n"}};
    const Subject s = subject(files, {"stl", "stl-ascii"});
    const auto certificate = parse_certificate(s.certificate.dump(), "c");
    REQUIRE(certificate);
    REQUIRE(verify_certificate(s.inputs, certificate.value()).violations.empty());
    const auto verdict = verify_output(s.contents[1], certificate.value(), 1);
    CHECK(verdict.violations.empty());
    const auto narrow = verify_output(s.contents[0], certificate.value(), 0);
    CHECK(narrow.float32_move > 0.99e-8);
    CHECK(narrow.float32_move < 1.01e-8);
}
