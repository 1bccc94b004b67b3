// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/selection/expression.hpp>

#include <catch2/catch.hpp>

#include <bitset>
#include <string>

using terrane::parse_expression;

namespace {

/// Returns the values of an expression for all ways in which points can be inside of a, b, c, d.
std::bitset<16> table_of(const std::string& text) {
    const auto parsed = parse_expression(text);
    REQUIRE(parsed);
    std::bitset<16> table;
    for (unsigned in = 0; in < 16; ++in)
        table[in] = parsed->value([&](std::uint32_t k) {
            return (in >> static_cast<unsigned>(parsed->operands[k].name[0] - 'a') & 1U) != 0;
        });
    return table;
}

std::string flaw_of(const std::string& text) {
    const auto parsed = parse_expression(text);
    REQUIRE(!parsed);
    CHECK(parsed.error().code == terrane::ErrorCode::bad_option);
    return parsed.error().message();
}

} // namespace

TEST_CASE("expression: operators bind as in Python") {
    const auto a = table_of("a"), b = table_of("b"), c = table_of("c"), d = table_of("d");
    CHECK(table_of("a | b ^ c & d") == (a | (b ^ (c & d))));
    CHECK(table_of("a & b | c & d") == ((a & b) | (c & d)));
    CHECK(table_of("a ^ b | c") == ((a ^ b) | c));
    CHECK(table_of("a & b ^ c") == ((a & b) ^ c));
    CHECK(table_of("a | b - c") == (a | (b & ~c)));
    CHECK(table_of("a - b - c") == (a & ~b & ~c));
    CHECK(table_of("a - (b - c)") == (a & ~(b & ~c)));
    CHECK(table_of("a ^ b - c") == (a ^ (b & ~c)));
    CHECK(table_of("~a & b") == (~a & b));
    CHECK(table_of("~~a - ~(b|c)") == (a & (b | c)));
    CHECK(table_of("(a | b) - c & ~inside(d)") == ((a | b) & ~c & ~d));
    CHECK(table_of("inside(a|b)") == (a | b));
}

TEST_CASE("expression: names may be quoted and are listed once, in their order") {
    const auto parsed = parse_expression("\"top (2)\" - salt_1.5 | \"top (2)\" & größe");
    REQUIRE(parsed);
    using Operands = std::vector<terrane::Expression::Operand>;
    CHECK(parsed->operands == Operands{{"top (2)"}, {"salt_1.5"}, {"größe"}});
    using Kind = terrane::Expression::Kind;
    const auto functions =
        parse_expression("a & inside(a | b) | hull( a ) ^ above(a) - west(\"a\") - below(a)");
    REQUIRE(functions);
    CHECK(functions->operands == Operands{{"a", Kind::inside},
                                          {"b", Kind::inside},
                                          {"a", Kind::enclosed},
                                          {"a", Kind::low_side, terrane::Axis::z},
                                          {"a", Kind::low_side, terrane::Axis::x}});
}

TEST_CASE("expression: flaws are named with their column") {
    CHECK(flaw_of("") == "expression, column 1: expected a name, '(' or '~', not the end");
    CHECK(flaw_of("a | ") == "expression, column 5: expected a name, '(' or '~', not the end");
    CHECK(flaw_of("a b") == "expression, column 3: expected an operator: | ^ & -, not 'b'");
    CHECK(flaw_of("(a | b") == "expression, column 7: expected an operator or ')', not the end");
    CHECK(flaw_of("a) - b") == "expression, column 2: expected an operator: | ^ & -, not ')'");
    CHECK(flaw_of("a + b") == "expression, column 3: expected an operator: | ^ & -, not '+'");
    CHECK(flaw_of("a & \"b") == "expression, column 5: this quote has no end");
    CHECK(flaw_of("a & \"\"") == "expression, column 5: a name may not be empty");
    CHECK(flaw_of("a & near(b)") == "expression, column 5: there is no function near(); there are "
                                    "inside(), hull(), below(), above(), "
                                    "west(), east(), south(), north(), block() and unit()");
    CHECK(flaw_of("volume < b") == "expression, column 10: expected a number, not 'b'");
    CHECK(flaw_of("below(a | b)") ==
          "expression, column 9: expected ')': below() takes the name of one surface, not '|'");
    CHECK(flaw_of("hull()") == "expression, column 6: expected a name, '(' or '~', not ')'");
    CHECK(flaw_of(std::string(100000, '(')).find("nested more than 1000 times") !=
          std::string::npos);
    CHECK(flaw_of(std::string(100000, '~')).find("nested more than 1000 times") !=
          std::string::npos);
}
