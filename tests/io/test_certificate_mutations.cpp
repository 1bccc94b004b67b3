// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The verifier refutes each way of breaking a valid certificate, by the rule that is broken, and
// refuses each text that is not a certificate, with the place of the error.
#include "support/certificate_cases.hpp"

#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>
#include <functional>

namespace {

using namespace certificate_cases;
using Json = nlohmann::json;

struct Mutation {
    std::string name;
    std::function<void(Json&)> breaks;
    std::string rule;
};

/// Checks that the violations include the named rule; other rules may be broken as well.
void check_mutations(const std::vector<File>& files, const std::vector<Mutation>& mutations) {
    const auto inputs = input_files(files);
    const Json right = Json::parse(certificate_of(files));
    REQUIRE(verdict(inputs, right.dump()).empty());
    for (const Mutation& mutation : mutations) {
        INFO(mutation.name);
        Json wrong = right;
        mutation.breaks(wrong);
        REQUIRE(wrong != right);
        const auto rules = " " + verdict(inputs, wrong.dump()) + " ";
        INFO(rules);
        CHECK(rules.find(" " + mutation.rule + " ") != std::string::npos);
    }
}

double number(const Json& text) {
    const auto& s = text.get_ref<const std::string&>();
    double value = 0;
    std::from_chars(s.data(), s.data() + s.size(), value);
    return value;
}

/// Moves a number to the next double away from 0.
void step(Json& text) {
    const double value = number(text);
    char buffer[64];
    const auto end = std::to_chars(buffer, buffer + 64, std::nextafter(value, 2 * value)).ptr;
    text = std::string(buffer, end);
}

template <class List>
void swap_items(List& list, std::size_t i, std::size_t j) {
    const Json first = list[i];
    list[i] = list[j];
    list[j] = first;
}

} // namespace

TEST_CASE("certificate: the exact part, broken") {
    check_mutations(
        pierced(),
        {{"triangle dropped",
          [](Json& c) { c["exact"]["triangles"].erase(0), c["exact"]["parents"].erase(0); }, "R6"},
         {"parents swapped", [](Json& c) { swap_items(c["exact"]["parents"], 0, 7); }, "R6"},
         {"points merged",
          [](Json& c) {
              for (auto& t : c["exact"]["triangles"])
                  for (auto& v : t)
                      if (v == 7) v = 6;
          },
          "R6"},
         {"a point named by another line", [](Json& c) { c["exact"]["vertices"][6][1] = 4; }, "R6"},
         {"corner out of range", [](Json& c) { c["exact"]["triangles"][0][0] = 8; }, "R1"},
         {"parent out of range", [](Json& c) { c["exact"]["parents"][0][0] = 2; }, "R1"},
         {"too few parents", [](Json& c) { c["exact"]["parents"].erase(0); }, "R1"},
         {"no such input vertex", [](Json& c) { c["exact"]["vertices"][6][1] = 6; }, "R1"},
         {"line within the plane",
          [](Json& c) { c["exact"]["vertices"][6] = {"lp", 0, 1, 0, 1, 2}; }, "R2"},
         {"one point twice",
          [](Json& c) { c["exact"]["vertices"].push_back(c["exact"]["vertices"][6]); }, "R3"},
         {"one triangle twice",
          [](Json& c) {
              c["exact"]["triangles"].push_back(c["exact"]["triangles"][0]);
              c["exact"]["parents"].push_back(c["exact"]["parents"][0]);
          },
          "R4"},
         {"no area", [](Json& c) { c["exact"]["triangles"][0][0] = c["exact"]["triangles"][0][1]; },
          "R4"},
         {"undivided",
          [](Json& c) {
              c["exact"]["triangles"] = {{0, 1, 2}, {3, 4, 5}};
              c["exact"]["parents"] = {{0}, {1}};
              c["exact"]["vertices"].erase(7);
              c["exact"]["vertices"].erase(6);
              c["exact"]["intersection_edges"] = Json::array();
          },
          "R5"},
         {"intersection edge missing",
          [](Json& c) { c["exact"]["intersection_edges"] = Json::array(); }, "R7"},
         {"intersection edge too many",
          [](Json& c) {
              c["exact"]["intersection_edges"] = {{0, 1}, {6, 7}};
          },
          "R7"},
         {"digest of something else",
          [](Json& c) { c["digest"] = "sha256:" + std::string(64, '0'); }, "R17"},
         {"vertices renamed", [](Json& c) { swap_items(c["exact"]["vertices"], 6, 7); }, "R6"}});
}

TEST_CASE("certificate: what was set aside, broken") {
    check_mutations(
        overlapping(),
        {{"degenerate not listed", [](Json& c) { c["exact"]["degenerate"] = Json::array(); }, "R8"},
         {"degenerate too many",
          [](Json& c) {
              c["exact"]["degenerate"] = {1, 4};
          },
          "R8"},
         {"duplicate not listed", [](Json& c) { c["exact"]["duplicates"] = Json::array(); }, "R8"},
         {"duplicate of another", [](Json& c) { c["exact"]["duplicates"][0][1] = 0; }, "R8"},
         {"a duplicate is no parent",
          [](Json& c) {
              for (auto& parents : c["exact"]["parents"])
                  if (parents.back() == 3) parents.erase(parents.size() - 1);
          },
          "R6"},
         {"one of two coplanar parents missing",
          [](Json& c) {
              for (auto& parents : c["exact"]["parents"])
                  if (parents.size() == 3) parents = {0};
          },
          "R6"}});
}

TEST_CASE("certificate: the inputs, broken") {
    check_mutations(
        pierced(),
        {{"hash", [](Json& c) { c["inputs"][0]["sha256"] = std::string(64, 'a'); }, "R9"},
         {"hashes swapped",
          [](Json& c) { std::swap(c["inputs"][0]["sha256"], c["inputs"][1]["sha256"]); }, "R9"},
         {"size", [](Json& c) { c["inputs"][1]["bytes"] = 1; }, "R9"},
         {"name of a surface", [](Json& c) { c["inputs"][0]["surfaces"][0]["name"] = "b"; }, "R9"},
         {"role", [](Json& c) { c["inputs"][0]["surfaces"][0]["role"] = "fault"; }, "R9"},
         {"count", [](Json& c) { c["inputs"][0]["surfaces"][0]["triangles"] = 2; }, "R9"},
         {"surface missing", [](Json& c) { c["inputs"][0]["surfaces"].erase(0); }, "R9"},
         {"file missing", [](Json& c) { c["inputs"].erase(1); }, "R9"}});
}

TEST_CASE("certificate: an input file that was edited") {
    const auto text = certificate_of(pierced());
    auto edited = pierced();
    edited[1].contents.replace(edited[1].contents.find("2.5"), 3, "2.4");
    CHECK(verdict(input_files(edited), text) == "R9");
    edited = pierced();
    edited[0].contents += "\n";
    CHECK(verdict(input_files(edited), text) == "R9");
    std::swap(edited[0], edited[1]);
    CHECK(verdict(input_files(edited), text) == "R9");
}

TEST_CASE("certificate: the doubles, broken") {
    check_mutations(
        pierced(),
        {{"an input vertex moved a little",
          [](Json& c) { c["rounded"]["vertices"][1][0] = "7.00000000000001"; }, "R14"},
         {"and so the deviation is exceeded",
          [](Json& c) { c["rounded"]["vertices"][1][0] = "7.00000000000001"; }, "R13"},
         {"a vertex moved by a thousandth",
          [](Json& c) { c["rounded"]["vertices"][5][2] = "5.001"; }, "R13"},
         {"largest move too small", [](Json& c) { c["rounded"]["max_move"] = "1e-18"; }, "R14"},
         {"deviation too small", [](Json& c) { c["rounded"]["deviation"] = "1e-18"; }, "R13"},
         {"largest move beyond the deviation", [](Json& c) { c["rounded"]["max_move"] = "1"; },
          "R14"},
         {"negative deviation", [](Json& c) { c["rounded"]["deviation"] = "-1"; }, "R10"},
         {"clean flag flipped", [](Json& c) { c["rounded"]["clean"] = false; }, "R11"},
         {"vertices merged",
          [](Json& c) { c["rounded"]["vertices"][7] = c["rounded"]["vertices"][6]; }, "R11"},
         {"triangle dropped",
          [](Json& c) {
              for (const char* list : {"triangles", "parents", "regions"})
                  c["rounded"][list].erase(0);
          },
          "R18"},
         {"all triangles of a parent dropped, and not listed",
          [](Json& c) {
              for (std::size_t t = c["rounded"]["parents"].size(); t-- > 0;)
                  if (c["rounded"]["parents"][t][0] == 1)
                      for (const char* list : {"triangles", "parents", "regions"})
                          c["rounded"][list].erase(t);
          },
          "R12"},
         {"parents swapped", [](Json& c) { swap_items(c["rounded"]["parents"], 0, 7); }, "R13"},
         {"listed as vanished", [](Json& c) { c["rounded"]["vanished"] = {0}; }, "R12"},
         {"vanished out of range", [](Json& c) { c["rounded"]["vanished"] = {2}; }, "R10"},
         {"corner out of range", [](Json& c) { c["rounded"]["triangles"][0][0] = 8; }, "R10"},
         {"intersection edge missing",
          [](Json& c) { c["rounded"]["intersection_edges"] = Json::array(); }, "R15"},
         {"intersection edge too many",
          [](Json& c) {
              c["rounded"]["intersection_edges"] = {{0, 1}, {6, 7}};
          },
          "R15"},
         {"regions of two surfaces joined",
          [](Json& c) {
              for (auto& region : c["rounded"]["regions"]) region = {0};
          },
          "R16"},
         {"region divided", [](Json& c) { c["rounded"]["regions"][0] = {77}; }, "R16"},
         {"too few regions", [](Json& c) { c["rounded"]["regions"].erase(0); }, "R16"}});
}

TEST_CASE("certificate: the doubles with coplanar parents, broken") {
    check_mutations(overlapping(), {{"moved by one step",
                                     [](Json& c) { step(c["rounded"]["vertices"][1][0]); }, "R14"},
                                    {"a triangle without area as parent",
                                     [](Json& c) {
                                         c["rounded"]["parents"][0] = {0, 1};
                                     },
                                     "R12"},
                                    {"a duplicate is no parent",
                                     [](Json& c) {
                                         for (auto& parents : c["rounded"]["parents"])
                                             if (parents.back() == 3)
                                                 parents.erase(parents.size() - 1);
                                     },
                                     "R12"}});
}

TEST_CASE("certificate: what is no certificate is refused with its place") {
    struct Case {
        std::function<void(Json&)> breaks;
        std::string message;
    };
    const std::vector<Case> cases{
        {[](Json& c) { c["format"] = "else"; }, "c.json, format: this is no terrane-certificate"},
        {[](Json& c) { c["version"] = 1; }, "c.json, version: version 2 is needed"},
        {[](Json& c) { c["kind"] = "else"; },
         "c.json, kind: this kind of certificate is not known"},
        {[](Json& c) { c.erase("digest"); }, "c.json: \"digest\" is missing"},
        {[](Json& c) { c["exact"]["more"] = 1; }, "c.json, exact: an unknown key"},
        {[](Json& c) {
             c["exact"]["triangles"][2] = {1, 2};
         },
         "c.json, exact.triangles[2]: an array of 3 is needed"},
        {[](Json& c) { c["exact"]["triangles"][2][1] = -1; },
         "c.json, line 1, column 231: a whole number, not negative, is needed"},
        {[](Json& c) { c["exact"]["triangles"][2][1] = 1.5; },
         "c.json, line 1, column 231: a whole number, not negative, is needed"},
        {[](Json& c) { c["exact"]["triangles"][2][1] = 5'000'000'000; },
         "c.json, exact.triangles[2][1]: the number is too large"},
        {[](Json& c) { c["exact"]["vertices"][6][0] = "pl"; },
         "c.json, exact.vertices[6][0]: no construction of this name"},
        {[](Json& c) { c["exact"]["vertices"][6] = {"ll", 1, 2, 3, 4, "w"}; },
         "c.json, exact.vertices[6][5]: no axis of this name"},
        {[](Json& c) { c["exact"]["vertices"][6].erase(1); },
         "c.json, exact.vertices[6]: an array of 6 is needed"},
        {[](Json& c) { c["rounded"]["vertices"][0][2] = "nan"; },
         "c.json, rounded.vertices[0][2]: a finite number in quotes, in its shortest form, is "
         "needed"},
        {[](Json& c) { c["rounded"]["vertices"][0][2] = "0x1"; },
         "c.json, rounded.vertices[0][2]: a finite number in quotes, in its shortest form, is "
         "needed"},
        {[](Json& c) { c["rounded"]["vertices"][0][2] = 1; },
         "c.json, rounded.vertices[0][2]: a string is needed"},
        {[](Json& c) { c["rounded"]["clean"] = 1; },
         "c.json, rounded.clean: true or false is needed"},
        {[](Json& c) { c["inputs"][0]["surfaces"][0]["role"] = "sea"; },
         "c.json, inputs[0].surfaces[0].role: no role of this name"},
        {[](Json& c) { c["inputs"] = "all"; }, "c.json, inputs: an array is needed"},
        {[](Json& c) { c = Json::array(); }, "c.json: an object is needed"},
    };
    const auto inputs = input_files(pierced());
    const Json right = Json::parse(certificate_of(pierced()));
    for (const Case& broken : cases) {
        Json wrong = right;
        broken.breaks(wrong);
        CHECK(verdict(inputs, wrong.dump()) == broken.message);
    }
}
