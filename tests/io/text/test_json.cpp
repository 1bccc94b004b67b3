// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Trees of JSON values, against those of nlohmann/json.
#include <terrane/io/text/json.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace {

using terrane::detail::Json;
using terrane::detail::parse_json_text;
using terrane::detail::ParsedJson;
using Other = nlohmann::ordered_json;

std::string nested(std::size_t levels) {
    return std::string(levels, '[') + std::string(levels, ']');
}

} // namespace

TEST_CASE("JSON: texts are read and written as by nlohmann/json") {
    for (const char* text :
         {"null", "true", "[]", "{}", "[1,-1,0,18446744073709551615,-9223372036854775808]",
          "[0.1,1.0,-0.0,1e-300,1e+300,5e-324,123456789012345678901234567890]",
          R"({"b":{"a":[{"c":null}],"":false},"a":["x","é€😀","\u0000\u001f\"\\"]})",
          "  [ 1 ,\n { \"k\" : [ ] } ] "}) {
        INFO(text);
        const auto parsed = parse_json_text(text);
        REQUIRE(parsed.state == ParsedJson::State::good);
        const auto other = Other::parse(text);
        CHECK(parsed.value.dump() == other.dump());
        CHECK(parsed.value.dump(2) == other.dump(2));
        CHECK(parsed.value.dump(-1, true) == other.dump(-1, ' ', true));
    }
}

TEST_CASE("JSON: braces make what they make in nlohmann/json") {
    const std::vector<std::array<double, 2>> list{{1, 2}, {3, 4.5}};
    const Json json{{"number", 1U},
                    {"pair", {"text", -2}},
                    {"none", nullptr},
                    {"list", list},
                    {"deep", {{"a", true}, {"b", {1, 2, 3}}}}};
    const Other other{{"number", 1U},
                      {"pair", {"text", -2}},
                      {"none", nullptr},
                      {"list", list},
                      {"deep", {{"a", true}, {"b", {1, 2, 3}}}}};
    CHECK(json.dump() == other.dump());
    Json grown;
    grown["x"]["y"].push_back({{"z", Json::array()}});
    grown["x"]["y"].push_back({"one", Json::object()});
    CHECK(grown.dump() == R"({"x":{"y":[{"z":[]},["one",{}]]}})");
    grown.update({{"x", 1}, {"w", 2}});
    CHECK(grown.dump() == R"({"x":1,"w":2})");
    grown.erase("x");
    CHECK(grown.dump() == R"({"w":2})");
    CHECK_FALSE(grown.contains("x"));
    CHECK(static_cast<const Json&>(grown)["x"].is_null());
}

TEST_CASE("JSON: what can't be written is replaced") {
    CHECK(Json("a\xff").dump() == "\"a\xEF\xBF\xBD\"");
    CHECK(Json(std::numeric_limits<double>::infinity()).dump() == "1.7976931348623157e+308");
    CHECK(Json(-std::numeric_limits<double>::infinity()).dump() == "-1.7976931348623157e+308");
    CHECK(Json(std::nan("")).dump() == "null");
}

TEST_CASE("JSON: what is no JSON, too large or too deep is told, with its place") {
    CHECK(parse_json_text("[1,\n2,]").state == ParsedJson::State::no_json);
    CHECK(parse_json_text("[1,\n2,]").byte == 7);
    CHECK(parse_json_text("").state == ParsedJson::State::no_json);
    CHECK(parse_json_text("[1e999]").state == ParsedJson::State::number_too_large);
    CHECK(parse_json_text(nested(100)).state == ParsedJson::State::good);
    CHECK(parse_json_text(nested(101)).state == ParsedJson::State::nested_too_deeply);
    CHECK(parse_json_text(nested(1'000'000)).state == ParsedJson::State::nested_too_deeply);
}

TEST_CASE("JSON: a key that is there twice is named, and the last value counts") {
    const auto parsed = parse_json_text(R"({"a":{"k":1,"j":2,"k":3},"k":4,"j":5,"j":6})");
    CHECK(parsed.repeated == "k");
    CHECK(parsed.value.dump() == R"({"a":{"k":3,"j":2},"k":4,"j":6})");
    CHECK(parse_json_text(R"({"a":{"k":1},"k":4})").repeated.empty());
}
