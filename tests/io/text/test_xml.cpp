// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/text/xml.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <pugixml.hpp>

#include "support/paths.hpp"

using namespace terrane;

TEST_CASE("XML: a reader gets each character back, in an element and in an attribute", "[io]") {
    std::string text = "a]]>b<!--&amp;-->\"'";
    for (int c = 1; c < 128; ++c) text += static_cast<char>(c);
    text += "\u00e9\u20ac\U0001f30d";
    std::string utf8 = text + "\ufffd\ufffd.";
    std::replace_if(
        utf8.begin(), utf8.end(), [](unsigned char c) { return c < ' '; }, ' ');
    const std::string xml = xml_escaped(text + "\xe9\x80."); // Latin-1
    pugi::xml_document read;
    const auto in = "<e a=\"" + xml + "\">" + xml + "</e>";
    REQUIRE(read.load_buffer(in.data(), in.size(), pugi::parse_default, pugi::encoding_utf8));
    CHECK(read.child("e").attribute("a").value() == utf8);
    CHECK(read.child("e").child_value() == utf8);
    CHECK(xml_escaped("") == "");
    CHECK(xml_escaped("a\tb\nc") == "a b c");
}

TEST_CASE("XML: text is escaped in one place of the sources only", "[io]") {
    std::vector<std::string> found;
    for (const std::string folder : {"kernel", "algorithms", "io", "cli"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(
                 std::filesystem::path(test_support::source_dir()) / folder)) {
            if (!entry.is_regular_file()) continue;
            std::ifstream file(entry.path());
            const std::string contents{std::istreambuf_iterator<char>(file), {}};
            if (contents.find("&lt;") != std::string::npos)
                found.push_back(entry.path().filename().string());
        }
    CHECK(found == std::vector<std::string>{"xml.cpp"});
}
