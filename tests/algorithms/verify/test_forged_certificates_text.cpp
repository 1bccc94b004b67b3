// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Texts that are nearly a certificate: each is refused with its place.
#include "support/forged.hpp"

namespace {

using namespace forged;

struct Text {
    std::string name;
    std::function<void(std::string&)> change;
    std::string message; ///< of the error, or its end
};

/// Replaces the first occurrence.
std::function<void(std::string&)> replaced(const std::string& old, const std::string& by) {
    return [old, by](std::string& text) {
        const auto at = text.find(old);
        REQUIRE(at != std::string::npos);
        text.replace(at, old.size(), by);
    };
}

void check_texts(const std::vector<Text>& texts) {
    const std::string right = certificate_of(pierced());
    REQUIRE(parse_certificate(right, "c.json"));
    for (const Text& text : texts) {
        INFO(text.name);
        std::string wrong = right;
        text.change(wrong);
        REQUIRE(wrong != right);
        const auto parsed = parse_certificate(wrong, "c.json");
        REQUIRE_FALSE(parsed);
        CHECK(parsed.error().code == ErrorCode::bad_syntax);
        INFO(parsed.error().message());
        CHECK(parsed.error().message().find(text.message) != std::string::npos);
    }
}

} // namespace

TEST_CASE("forged certificates: what stands around the text") {
    check_texts({
        {"byte order mark", [](std::string& t) { t = "\xEF\xBB\xBF" + t; },
         "c.json, line 1, column 1: a byte order mark"},
        {"NUL behind the end", [](std::string& t) { t += '\0'; }, "there is more behind the end"},
        {"NUL before the start", [](std::string& t) { t = std::string(1, '\0') + t; },
         "c.json, line 1, column 1: this is no JSON"},
        {"a second text", [](std::string& t) { t += "{}"; }, "there is more behind the end"},
        {"a word behind the end", [](std::string& t) { t += "valid"; },
         "there is more behind the end"},
        {"a comment", [](std::string& t) { t = "// true\n" + t; },
         "c.json, line 1, column 1: this is no JSON"},
        {"a form feed", [](std::string& t) { t = "\f" + t; }, "this is no JSON"},
        {"cut short", [](std::string& t) { t.erase(t.rfind('}')); }, "a comma or } is needed"},
        {"empty", [](std::string& t) { t.clear(); }, "c.json, line 1, column 1: this is no JSON"},
    });
}

TEST_CASE("forged certificates: keys") {
    check_texts({
        {"twice, of the whole", replaced("\"version\":2", "\"version\":2,\"version\":2"),
         "c.json, line 1, column 45: the key \"version\" is there twice"},
        {"twice, with another value", replaced("\"clean\":true", "\"clean\":false,\"clean\":true"),
         "the key \"clean\" is there twice"},
        {"twice, once with an escape",
         replaced("\"clean\":true", "\"cle\\u0061n\":false,\"clean\":true"),
         "the key \"clean\" is there twice"},
        {"twice, in an input", replaced("\"bytes\":", "\"bytes\":1,\"bytes\":"),
         "the key \"bytes\" is there twice"},
        {"unknown", replaced("\"clean\":", "\"certain\":true,\"clean\":"),
         "c.json, rounded: an unknown key"},
        {"unknown, of the whole", replaced("\"kind\":", "\"note\":\"\",\"kind\":"),
         "c.json: an unknown key"},
        {"missing: regions", replaced("\"regions\":", "\"areas\":"),
         "c.json, rounded: \"regions\" is missing"},
        {"missing: outputs", replaced("\"outputs\":", "\"files\":"),
         "c.json: \"outputs\" is missing"},
        {"missing: vanished", replaced("\"vanished\":", "\"gone\":"),
         "c.json, rounded: \"vanished\" is missing"},
        {"missing: duplicates", replaced("\"duplicates\":", "\"copies\":"),
         "c.json, exact: \"duplicates\" is missing"},
        {"no key", replaced("\"clean\":", ""), "is needed"},
        {"no quotes", replaced("\"clean\":", "clean:"), "a key in quotes is needed"},
        {"a comma too many", replaced("\"duplicates\":[]}", "\"duplicates\":[],}"),
         "a key in quotes is needed"},
        {"version 1", replaced("\"version\":2", "\"version\":1"),
         "c.json, version: version 2 is needed"},
        {"another kind", replaced("\"kind\":\"arrangement\"", "\"kind\":\"proof\""),
         "c.json, kind: this kind of certificate is not known"},
        {"rounded is a list", replaced("\"rounded\":{", "\"rounded\":[],\"x\":{"),
         "c.json: an unknown key"},
    });
}

TEST_CASE("forged certificates: numbers") {
    const auto bytes = [](const std::string& number) {
        return [number](std::string& t) {
            const auto at = t.find("\"bytes\":") + 8;
            t.replace(at, t.find(',', at) - at, number);
        };
    };
    const std::string whole = "a whole number, not negative, is needed";
    check_texts({
        {"fraction", bytes("35.0"), whole},
        {"exponent", bytes("35e0"), whole},
        {"negative", bytes("-35"), whole},
        {"minus zero", bytes("-0"), whole},
        {"plus", bytes("+35"), "this is no JSON"},
        {"leading zero", bytes("035"), whole},
        {"hexadecimal", bytes("0x23"), "a comma or } is needed"},
        {"too large for 64 bits", bytes("18446744073709551616"), "the number is too large"},
        {"too large for an index", replaced("[\"v\",1]", "[\"v\",4294967297]"),
         "c.json, exact.vertices[1][1]: the number is too large"},
        {"in quotes", bytes("\"35\""), "c.json, inputs[0].bytes: " + whole},
        {"not a number", bytes("NaN"), "this is no JSON"},
        {"null", bytes("null"), "c.json, inputs[0].bytes: " + whole},
    });
}

TEST_CASE("forged certificates: decimals") {
    const auto coordinate = [](const std::string& text) {
        return replaced("\"rounded\":{\"vertices\":[[\"0\"", "\"rounded\":{\"vertices\":[[" + text);
    };
    const std::string place = "c.json, rounded.vertices[0][0]: ";
    const std::string finite = place + "a finite number in quotes, in its shortest form";
    check_texts({
        {"no quotes", coordinate("0"), place + "a string is needed"},
        {"empty", coordinate("\"\""), finite},
        {"blank before", coordinate("\" 0\""), finite},
        {"blank behind", coordinate("\"0 \""), finite},
        {"another decimal of the same number", coordinate("\"0.0\""), finite},
        {"plus", coordinate("\"+0\""), finite},
        {"infinite", coordinate("\"inf\""), finite},
        {"beyond doubles", coordinate("\"1e400\""), finite},
        {"not a number", coordinate("\"nan\""), finite},
        {"hexadecimal", coordinate("\"0x0\""), finite},
        {"two numbers", coordinate("\"0,0\""), finite},
        {"a NUL inside", coordinate("\"0\\u0000\""), finite},
    });
}

TEST_CASE("forged certificates: strings") {
    const auto name = [](const std::string& text) {
        return replaced("\"name\":\"plane.obj\"", "\"name\":\"" + text + "\"");
    };
    check_texts({
        {"a line feed", name("a\nb"), "a control character in a string"},
        {"a NUL in the name of a file", name("plane.obj\\u0000.ts"),
         "c.json, inputs[0].name: a zero in a file name"},
        {"a NUL", name(std::string("a\0b", 3)), "a control character in a string"},
        {"no such escape", name("\\x41"), "no escape of this name"},
        {"a short escape", name("\\u41"), "four hexadecimal digits are needed"},
        {"half a surrogate pair", name("\\ud800"), "half of a surrogate pair"},
        {"no second half", name("\\ud800\\ue000"), "half of a surrogate pair"},
        {"two first halves", name("\\ud800\\ud800"), "half of a surrogate pair"},
        {"the other half", name("\\udc00"), "half of a surrogate pair"},
        {"Latin-1", name("caf\xE9"), "this is no UTF-8"},
        {"UTF-8 that is too long", name("\xC0\xAF"), "this is no UTF-8"},
        {"three bytes that are too long", name("\xE0\x80\x80"), "this is no UTF-8"},
        {"four bytes that are too long", name("\xF0\x80\x80\x80"), "this is no UTF-8"},
        {"the first of two bytes", name("\xC3"), "this is no UTF-8"},
        {"two of three bytes", name("\xE2\x82"), "this is no UTF-8"},
        {"three bytes with a letter", name("\xE2(\x80"), "this is no UTF-8"},
        {"three of four bytes", name("\xF0\x9F\x98"), "this is no UTF-8"},
        {"four bytes with a letter", name("\xF0\x9F(\x80"), "this is no UTF-8"},
        {"four bytes with two letters", name("\xF0((\x80"), "this is no UTF-8"},
        {"a surrogate in UTF-8", name("\xED\xA0\x80"), "this is no UTF-8"},
        {"beyond Unicode", name("\xF4\x90\x80\x80"), "this is no UTF-8"},
        {"upper-case hash",
         [](std::string& t) {
             const auto at = t.find("\"sha256\":\"") + 10;
             t.replace(at, 64, std::string(64, 'A'));
         },
         "c.json, inputs[0].sha256: 64 lower-case hexadecimal digits are needed"},
        {"short hash", [](std::string& t) { t.erase(t.find("\"sha256\":\"") + 10, 1); },
         "c.json, inputs[0].sha256: 64 lower-case hexadecimal digits are needed"},
    });
}

TEST_CASE("forged certificates: escapes and blanks change nothing") {
    std::string text = certificate_of(pierced());
    replaced("\"name\":\"plane.obj\"", "\"name\" : \"pl\\u0061ne\\u002eobj\"")(text);
    text = " \r\n\t" + text + "\n\n";
    CHECK(verdict(input_files(pierced()), text) == "");
}

TEST_CASE("forged certificates: each escape is the character that it stands for") {
    std::string text = certificate_of(pierced());
    replaced("\"name\":\"plane.obj\"",
             R"("name":"\"\\\/\b\f\n\r\t\ud834\udd1e\ud800\udc00\udbff\udfff")")(text);
    const auto parsed = parse_certificate(text, "c.json");
    REQUIRE(parsed);
    CHECK(parsed->inputs[0].name == "\"\\/\b\f\n\r\t\U0001D11E\U00010000\U0010FFFF");
}
