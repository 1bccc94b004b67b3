// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Output files that are not what their certificate says, with right hashes: each is refuted.
#include "support/forged.hpp"

#include <array>
#include <cctype>
#include <charconv>
#include <cstring>
#include <string_view>

namespace {

using namespace forged;

const std::vector<std::string> all_formats{"obj", "off",       "ply", "stl",
                                           "ts",  "stl-ascii", "vtp", "vtp-plain"};

/// Surfaces with names that formats must change, and triangles of two surfaces.
std::vector<File> named() {
    return {{"model.obj", "v 0 0 0\nv 8 0 0\nv 0 8 0\nv 2 2 0\nv 10 2 0\nv 2 10 0\n"
                          "v 3 1 -2\nv 3.25 7 -2.5\nv 3 4 2.125\n"
                          "g top#1\nf 1 2 3\ng base\nf 4 5 6\ng wall\nf 7 8 9\n"}};
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

/// Takes numbers from binary PLY, little endian.
class PlyBytes {
public:
    explicit PlyBytes(std::string_view bytes) : bytes_(bytes) {}

    template <class T>
    std::string take() {
        T value{};
        std::memcpy(&value, bytes_.data(), sizeof value);
        bytes_.remove_prefix(sizeof value);
        std::array<char, 64> digits{};
        return {digits.data(), std::to_chars(digits.data(), digits.data() + 64, value).ptr};
    }

private:
    std::string_view bytes_;
};

/// Returns a binary PLY file as text.
std::string ply_text(const std::string& binary, std::size_t vertices, std::size_t faces) {
    const std::string end = "end_header\n";
    const std::size_t header = binary.find(end) + end.size();
    std::string text = replaced(binary.substr(0, header), "binary_little_endian", "ascii");
    PlyBytes in(std::string_view(binary).substr(header));
    for (std::size_t v = 0; v < vertices; ++v) {
        for (int i = 0; i < 3; ++i) text += (i > 0 ? " " : "") + in.take<double>();
        text += "\n";
    }
    for (std::size_t f = 0; f < faces; ++f) {
        text += in.take<std::int8_t>();
        for (int i = 0; i < 4; ++i) text += " " + in.take<std::int32_t>(); // corners, surface
        const std::string count = in.take<std::uint32_t>();
        text += " " + count;
        for (int i = 0; i < std::stoi(count); ++i) text += " " + in.take<std::uint32_t>();
        text += "\n";
    }
    return text;
}

struct FileForgery {
    std::string name, old, by, sentence;
};

void check_files(const std::string& format, const std::vector<FileForgery>& forgeries) {
    const Subject s = subject(named(), {format});
    REQUIRE(judged(s) == "");
    for (const FileForgery& f : forgeries) {
        INFO(format << ": " << f.name);
        const auto sentence = judged_as(s, replaced(s.contents[0], f.old, f.by));
        INFO(sentence);
        CHECK(contains(sentence, f.sentence));
    }
}

} // namespace

TEST_CASE("verify_output: files of all formats that it reads") {
    for (const auto& files : {pierced(), overlapping(), named()}) {
        const Subject s = subject(files, all_formats);
        CHECK(judged(s) == "");
        const auto certificate = parse_certificate(s.certificate.dump(), "c");
        REQUIRE(certificate);
        for (std::size_t i = 0; i < all_formats.size(); ++i) {
            INFO(all_formats[i]);
            const auto verdict = verify_output(s.contents[i], certificate.value(), i);
            CHECK(verdict.violations.empty());
            CHECK(verdict.renamed.empty());
            const bool narrow = all_formats[i] == "stl";
            CHECK(verdict.check == (narrow ? OutputCheck::float32 : OutputCheck::doubles));
        }
    }
}

TEST_CASE("verify_output: formats without a reader are compared by their hash only") {
    const Subject s = subject(pierced(), {"msh", "poly"});
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

TEST_CASE("forged output files: each digit of text formats, with a new hash") {
    for (const std::string format : {"obj", "off", "ts", "stl-ascii"}) {
        const Subject s = subject(pierced(), {format});
        const std::string& right = s.contents[0];
        for (std::size_t at = 0; at < right.size(); ++at) {
            if (std::isdigit(static_cast<unsigned char>(right[at])) == 0) continue;
            const auto line = right.rfind('\n', at) + 1; // normals follow from the corners
            if (right.compare(line, 5, "facet") == 0) continue;
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
            const bool normal = format == "stl" && at >= 84 && (at - 84) % 50 < 12;
            if (normal) continue; // it follows from the corners
            std::string wrong = right;
            wrong[at] = static_cast<char>(wrong[at] ^ 1);
            INFO(format << " byte " << at);
            CHECK(judged_as(s, wrong) != "");
        }
    }
}

TEST_CASE("output files: PLY as text, to the last bit") {
    const auto with_text = [](const std::vector<File>& files) {
        Subject s = subject(files, {"ply"});
        const auto certificate = parse_certificate(s.certificate.dump(), "c");
        REQUIRE(certificate);
        s.contents[0] = ply_text(s.contents[0], certificate->rounded->vertices.size(),
                                 certificate->rounded->triangles.size());
        seal(s);
        return s;
    };
    for (const auto& files : {named(), pierced(), overlapping()})
        CHECK(judged(with_text(files)) == "");
    const Subject s = with_text(overlapping());
    const std::string& right = s.contents[0];
    for (std::size_t at = 0; at < right.size(); ++at) {
        if (std::isdigit(static_cast<unsigned char>(right[at])) == 0) continue;
        std::string wrong = right;
        wrong[at] = wrong[at] == '9' ? '0' : static_cast<char>(wrong[at] + 1);
        INFO("byte " << at);
        CHECK(judged_as(s, wrong) != "");
    }
    const std::string vertex = "\n8 0 0\n";
    for (const std::string wrong : {"\n8 0 -0\n", "\n8.0 0 0\n", "\n8 0 5e-324\n", "\n8 0\n",
                                    "\n8 0 0 0\n", "\n8  0 0\n", "\n8 0 0\n8 0 0\n", "\n"}) {
        INFO(wrong);
        CHECK(judged_as(s, replaced(right, vertex, wrong)) != "");
    }
    CHECK(judged_as(s, replaced(right, "ascii", "binary_little_endian")) != "");
    CHECK(judged_as(s, right + "3 0 1 2 0 1 0\n") != "");
    CHECK(judged_as(s, right.substr(0, right.size() - 1)) != "");
}

TEST_CASE("forged output files: each character of VTP that is not compressed") {
    for (const std::string format : {"vtp-plain"}) {
        const Subject s = subject(pierced(), {format});
        const std::string& right = s.contents[0];
        for (std::size_t at = 0; at < right.size(); ++at) {
            std::string wrong = right;
            wrong[at] = wrong[at] == 'B' ? 'C' : 'B';
            if (wrong == right) continue;
            INFO(format << " byte " << at);
            CHECK(judged_as(s, wrong) != "");
        }
    }
}

TEST_CASE("forged output files: OBJ") {
    check_files("obj",
                {
                    {"another coordinate", "v 8 0 0", "v 8 0 1", "another coordinate"},
                    {"minus zero", "v 0 0 0", "v 0 -0 0", "another coordinate"},
                    {"another decimal of the same number", "v 8 0 0", "v 8.0 0 0", "shortest form"},
                    {"another exponent", "v 8 0 0", "v 8e0 0 0", "shortest form"},
                    {"a vertex too many", "v 8 0 0\n", "v 8 0 0\nv 8 0 0\n", "another coordinate"},
                    {"a vertex less", "v 8 0 0\n", "", "another coordinate"},
                    {"a weight", "v 8 0 0\n", "v 8 0 0 1\n", "more words"},
                    {"a comment", "g top", "# top\ng top", "is needed"},
                    {"two blanks", "v 8 0 0", "v  8 0 0", "shortest form"},
                    {"another group", "g base", "g top_1", "\"g base\" is needed"},
                    {"two groups exchanged", "g top_1\n", "g base\n", "is needed"},
                    {"a group less", "g base\n", "", "is needed"},
                    {"a normal", "\nf ", "\nvn 0 0 1\nf ", "is needed"},
                    {"a face too many", "\nf ", "\nf 1 2 3\nf ", "another corner"},
                    {"carriage returns", "v 8 0 0\n", "v 8 0 0\r\n", "shortest form"},
                });
    const Subject s = subject(named(), {"obj"});
    CHECK(contains(judged_as(s, s.contents[0] + "f 1 2 3\n"), "more lines"));
    CHECK(contains(judged_as(s, s.contents[0] + "v 1 1 1\n"), "more lines"));
    CHECK(contains(judged_as(s, ""), "line 1: the file ends too early"));
    CHECK(contains(judged_as(s, s.contents[0].substr(0, s.contents[0].size() - 1)),
                   "the file ends too early"));
}

TEST_CASE("forged output files: OFF, STL as text, TSurf, VTP") {
    check_files("off", {{"another count", "OFF\n", "OFF\n# 1\n", "is needed"},
                        {"another corner", "\n3 0 ", "\n4 0 ", "is needed"},
                        {"with colours", "OFF\n", "COFF\n", "\"OFF\" is needed"}});
    check_files("stl-ascii",
                {{"another name", "solid base", "solid wall", "is needed"},
                 {"another corner", "vertex 8 0 0", "vertex 8 0 0.5", "another coordinate"},
                 {"a facet less", "endfacet\n", "", "is needed"}});
    check_files("ts", {{"depth", "ZPOSITIVE Elevation", "ZPOSITIVE Depth", "is needed"},
                       {"another name", "name: base", "name: top", "is needed"},
                       {"a role", "TFACE", "GEOLOGICAL_TYPE fault\nTFACE", "is needed"},
                       {"another vertex", "VRTX 1 0 0 0", "VRTX 1 0 0 1", "another coordinate"}});
    check_files("vtp", {{"another name", "116 111 112 35 49 0", "116 111 112 35 50 0", "is needed"},
                        {"another role", "117 110 107 110 111 119 110 0", "102 97 117 108 116 0",
                         "is needed"},
                        {"an array too many", "<Points>",
                         "<DataArray type=\"Int32\"></DataArray>\n<Points>", "is needed"}});
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
