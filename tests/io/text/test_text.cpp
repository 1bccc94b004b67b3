// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include <terrane/io/text/text.hpp>

using namespace terrane;
using namespace terrane::detail;

namespace {

double parsed(std::string_view token) {
    double value = 12345;
    REQUIRE(parse_double(token, value) == NumberState::ok);
    return value;
}

NumberState state(std::string_view token) {
    double value = 0;
    return parse_double(token, value);
}

std::string printed(double value) {
    std::string out;
    append_number(out, value);
    return out;
}

} // namespace

TEST_CASE("decimals become the nearest double", "[io][text]") {
    CHECK(parsed("0.1") == 0.1);
    CHECK(parsed("+5") == 5);
    CHECK(parsed("-.5") == -0.5);
    CHECK(parsed("1.") == 1);
    CHECK(parsed("1e5") == 1e5);
    CHECK(parsed("1E-5") == 1e-5);
    CHECK(parsed("9007199254740993") == 9007199254740992.0); // a tie, rounded to even
    CHECK(parsed("9007199254740993.00000000000000000001") == 9007199254740994.0);
    CHECK(std::signbit(parsed("-0")));
    CHECK(parsed("1.7976931348623158e308") == std::numeric_limits<double>::max());
}

TEST_CASE("numbers too small become denormals and zeros, never errors", "[io][text]") {
    CHECK(parsed("4.9406564584124654e-324") == 5e-324);
    CHECK(parsed("2.5e-324") == 5e-324);
    CHECK(parsed("2.4e-324") == 0);
    CHECK(parsed("2.2250738585072011e-308") == 2.2250738585072011e-308);
    CHECK(parsed("1e-400") == 0);
    CHECK(std::signbit(parsed("-1e-400")));
    CHECK(parsed("0.0001e-99999999999999999999999") == 0);
    CHECK(parsed("0." + std::string(500, '0') + "1") == 0);
    CHECK(parsed("0e99999") == 0);
}

TEST_CASE("what is no finite double is told apart", "[io][text]") {
    for (const auto* token :
         {"nan", "NaN", "inf", "-inf", "Infinity", "1.#INF", "-1.#IND", "1.#QNAN"})
        CHECK(state(token) == NumberState::not_finite);
    for (const auto* token :
         {"1e309", "-1e999", "1.7976931348623159e308", "1e99999999999999999999"})
        CHECK(state(token) == NumberState::too_large);
    CHECK(state("1" + std::string(400, '0')) == NumberState::too_large);
    for (const auto* token : {"", "+", "-", "++1", "+-1", "1e", "0x10", "1,5", "blah", "1 ", "1d5"})
        CHECK(state(token) == NumberState::not_a_number);
}

TEST_CASE("printed doubles are short and read back the same", "[io][text]") {
    CHECK(printed(0.1) == "0.1");
    CHECK(printed(4200000) == "4200000");
    for (const double x : {0.1, 1.0 / 3, 5e-324, 1e300, -0.0, 3.4e38, 4234567.123456789})
        CHECK(std::bit_cast<std::uint64_t>(parsed(printed(x))) == std::bit_cast<std::uint64_t>(x));
}

TEST_CASE("integers fill their token", "[io][text]") {
    std::int64_t value = 0;
    CHECK((parse_integer("-12", value) && value == -12));
    CHECK((parse_integer("+12", value) && value == 12));
    for (const auto* token : {"", "1.5", "1x", "99999999999999999999", "+-1"})
        CHECK_FALSE(parse_integer(token, value));
}

TEST_CASE("lines end with LF, CR LF, or CR alone", "[io][text]") {
    for (const auto* text : {"a\nb\n\nc", "a\r\nb\r\n\r\nc\r\n", "a\rb\r\rc\r",
                             "\xEF\xBB\xBF"
                             "a\nb\n\nc\n"}) {
        LineParser in(text, "x");
        std::string joined;
        while (in.next()) joined += std::string(in.line()) + std::to_string(in.number());
        CHECK(joined == "a1b23c4");
    }
}
