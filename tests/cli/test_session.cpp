// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The parts of the progress line and of tables; terminal.py judges how they look on a terminal.
#include <catch2/catch.hpp>

#include <clocale>
#include <string>
#include <utility>
#include <vector>

#include <terrane/cli/session/quantities.hpp>
#include <terrane/cli/session/styles.hpp>
#include <terrane/cli/session/text_width.hpp>
#include <terrane/cli/session/time_left.hpp>

using namespace terrane::cli;

TEST_CASE("time left: nothing is said before enough is known") {
    TimeLeft left;
    left.update(0.5, 1); // too early
    CHECK_FALSE(left.after(1));
    left.update(0.6, 3);
    REQUIRE(left.after(3));
    CHECK(*left.after(3) == Approx(2));
    TimeLeft little;
    little.update(0.01, 10); // too little
    CHECK_FALSE(little.after(10));
    little.update(0, 20);
    CHECK_FALSE(little.after(20));
}

TEST_CASE("time left: it never rises, and is never negative") {
    TimeLeft left;
    double said = 1e300;
    unsigned spoken = 0;
    // quick at first, then slow, then stuck, and quick again
    const auto share_at = [](double t) {
        return t < 10 ? t / 20 : t < 30 ? 0.5 + (t - 10) / 200 : t < 60 ? 0.6 : 0.6 + (t - 60) / 50;
    };
    for (double t = 0; t < 80; t += 0.25) {
        left.update(share_at(t), t);
        const auto now = left.after(t);
        if (!now) continue;
        ++spoken;
        CHECK(*now <= said);
        CHECK(*now >= 0.5);
        said = *now;
    }
    CHECK(spoken > 20);
    CHECK(said < 20);
}

TEST_CASE("time left: an estimate that rises to more than twice what was said is withheld") {
    TimeLeft left;
    left.update(0.5, 4);
    CHECK(*left.after(4) == Approx(4));
    left.update(0.55, 8);               // 6.5 s would be left: it was said to be 4
    CHECK(*left.after(8) == Approx(4)); // the last value stays
    left.update(0.56, 20);              // 15.7 s would be left
    CHECK_FALSE(left.after(20));
    left.update(0.9, 22); // 2.4 s
    CHECK(*left.after(22) == Approx(22 / 0.9 - 22));
}

TEST_CASE("time left: a smaller share begins anew, and time overtakes an estimate") {
    TimeLeft left;
    left.update(0.9, 9);
    CHECK(*left.after(9) == Approx(1));
    CHECK_FALSE(left.after(9.9)); // less than half a second
    CHECK_FALSE(left.after(100));
    left.update(0.1, 10);
    CHECK(*left.after(10) == Approx(90));
}

TEST_CASE("durations are said in the unit that fits") {
    CHECK(duration(0.4) == "0 s");
    CHECK(duration(99) == "99 s");
    CHECK(duration(100) == "2 min");
    CHECK(duration(5999) == "100 min");
    CHECK(duration(9000) == "2.5 h");
}

TEST_CASE("widths: those of a terminal, in any script") {
    CHECK(width_of("fault 1") == 7);
    CHECK(width_of("砂岩") == 4);
    CHECK(width_of("e\u0301tage") == 5);
    CHECK(width_of("\u200fב") == 7); // the mark is written as its code
    CHECK(width_of("") == 0);
    CHECK(width_of("\xff\xfe") == 2);  // no UTF-8
    CHECK(width_of("a\xe7\xa0") == 3); // a sequence cut short
    CHECK(width_of(std::string(10000, 'x')) == 10000);
    CHECK(padded("砂岩", 6) == "砂岩  ");
    CHECK(padded("longer", 3) == "longer");
    CHECK(cut_to("砂岩 layer", 5) == "砂岩 ");
    CHECK(cut_to("砂岩", 3) == "砂");
    CHECK(column_width(std::vector<std::string>{"砂岩砂岩", "top"}, 7) == 8);
    CHECK(column_width(std::vector<std::string>{std::string(61, 'x'), "top"}, 7) == 7);
}

TEST_CASE("widths: the locale of the process stays") {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    CHECK(width_of("砂岩") == 4);
    CHECK(std::setlocale(LC_ALL, nullptr) == before);
    CHECK(MB_CUR_MAX == 1); // that of the thread as well
}

TEST_CASE("styles: marks become colours, or nothing") {
    const std::string text = good("verified:") + " all\n" + heading("a  b") + "\n";
    CHECK(rendered(text, true) == "\033[32mverified:\033[0m all\n\033[1ma  b\033[0m\n");
    CHECK(rendered(text, false) == "verified: all\na  b\n");
    CHECK(without_marks(text) == "verified: all\na  b\n");
    CHECK(rendered(with_headings("Options:\n  -h\nExit: 1\n"), true) ==
          "\033[1mOptions:\033[0m\n  -h\nExit: 1\n");
}

TEST_CASE("styles: no text has other control characters than ours") {
    CHECK(rendered("a\x1b[31mb\r\b\x07\x7f\tc\n", true) ==
          "a\\u001b[31mb\\u000d\\u0008\\u0007\\u007f\tc\n");
    CHECK(rendered("\xc2\x9b"
                   "31m \x9b"
                   "31m",
                   true) == "\\u009b31m \\x9b31m");
    CHECK(rendered("砂é\u200d\xf0\x9f\x8c\x8b", true) == "砂é\u200d\xf0\x9f\x8c\x8b");
    CHECK(rendered(bad("a\x05\x01z"), true) == "\033[31ma  z\033[0m");
    CHECK(rendered("a\x02z\nb", true) == "a\033[31mz\033[0m\nb"); // ends with its line
    CHECK(is_plain("a ~\tz\n"));
    for (const std::string_view text : {"\x1b", "\x01", "\x7f", "\r", "é"})
        CHECK_FALSE(is_plain(text));
    CHECK(rendered("\x02z", true) == "\033[31mz\033[0m");
    CHECK(rendered("\xe7\x9b", false) == "\xe7\\x9b"); // a sequence cut short
}

TEST_CASE("styles: no name turns the text behind it round") {
    CHECK(rendered("a\u202eb\u2066c\u2069\u2028d", true) == "a\\u202eb\\u2066c\\u2069\\u2028d");
    // All that Unicode names as Bidi_Control, and the separators of lines and paragraphs.
    for (const auto& [given, code] :
         std::vector<std::pair<std::string, std::string>>{{"\u061c", "061c"},
                                                          {"\u200e", "200e"},
                                                          {"\u200f", "200f"},
                                                          {"\u2028", "2028"},
                                                          {"\u2029", "2029"},
                                                          {"\u202a", "202a"},
                                                          {"\u202b", "202b"},
                                                          {"\u202c", "202c"},
                                                          {"\u202d", "202d"},
                                                          {"\u202e", "202e"},
                                                          {"\u2066", "2066"},
                                                          {"\u2067", "2067"},
                                                          {"\u2068", "2068"},
                                                          {"\u2069", "2069"}}) {
        CHECK(rendered(given, true) == "\\u" + code);
        CHECK(rendered(given, false) == "\\u" + code);
        CHECK(width_of(given) == 6);
    }
    for (const std::string_view kept :
         {"\u061b", "\u200c", "\u200d", "\u2010", "\u2027", "\u202f", "\u2065", "\u206a"})
        CHECK(rendered(kept, true) == kept); // letters, joiners and blanks
    CHECK(width_of("a\u202eb") == width_of(rendered("a\u202eb", false)));
    CHECK(padded("\u2067", 8) == "\u2067  ");
    CHECK(cut_to("\u2067ab", 7) == "\u2067a");
}

TEST_CASE("quantities: metres become kilometres, other units stay", "[cli]") {
    const Quantities metres("m", 12'000), feet("ft"), unknown("");
    CHECK(metres.length(9999) == "9999 m");
    CHECK(metres.length(12345.6) == "12.35 km");
    CHECK(metres.lengths(7, 12'000, 2) == "0.007 to 12 km");
    CHECK(metres.area(123456) == "0.1235 km2");
    CHECK(metres.volume(12345678) == "12,345,700 m3");
    CHECK(metres.volume(123456789) == "0.123457 km3");
    CHECK(feet.length(12345.6) == "12350 ft");
    CHECK(feet.volume(-123456789) == "-123,457,000 ft3");
    CHECK(unknown.area(1e6) == "1,000,000");
    CHECK(metres.place({457123.456, 5932123.4567, 0}) == "(457123.5, 5932123.5, 0)");
}
