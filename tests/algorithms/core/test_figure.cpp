// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/paths.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <terrane/algorithms/core/figure.hpp>

using namespace terrane;

namespace {

std::string without_commas(std::string text) {
    std::erase(text, ',');
    return text;
}

/// Counts the digits from the first that is not 0 to the last that is not 0.
std::size_t significant_digits(const std::string& text) {
    std::string digits;
    for (const char c : text.substr(0, text.find('e')))
        if (std::isdigit(static_cast<unsigned char>(c)) != 0) digits += c;
    const auto first = digits.find_first_not_of('0');
    return first == std::string::npos ? 0 : digits.find_last_not_of('0') - first + 1;
}

} // namespace

TEST_CASE("figure: the table that report pages and Python obey as well", "[core]") {
    std::ifstream file(test_support::source_dir() + "/tests/algorithms/core/figures.json");
    for (const auto& row : nlohmann::json::parse(file)) {
        CAPTURE(row);
        CHECK(figure(row[0], row[1]) == row[2].get<std::string>());
    }
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK(figure(std::nan("")) == "?");
    CHECK(figure(infinity) == "> 1.8e308");
    CHECK(figure(-infinity) == "< -1.8e308");
}

TEST_CASE("figure: digits, groups and exponents of random numbers", "[core]") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> mantissa(-10, 10), power(-20, 20);
    std::uniform_int_distribution<int> digits_of(1, 6);
    for (int i = 0; i < 20'000; ++i) {
        const int digits = digits_of(random);
        const double value = mantissa(random) * std::pow(10, power(random));
        const auto text = figure(value, digits);
        CAPTURE(value, digits, text);
        CHECK(significant_digits(text) <= static_cast<std::size_t>(digits));
        const double read = std::strtod(without_commas(text).c_str(), nullptr);
        CHECK(std::abs(read - value) <= 0.5001 * std::abs(value) * std::pow(10, 1 - digits));
        const double size = std::abs(read);
        CHECK((text.find('e') != std::string::npos) == (size < 1e-4 || size >= 1e15));
        CHECK((text.find(',') != std::string::npos) == (size >= 1e6 && size < 1e15));
        CHECK(figure(-value, digits) == (value < 0 ? text.substr(1) : "-" + text));
    }
}

TEST_CASE("place_text: as many decimals as the extent of the model needs", "[core]") {
    CHECK(place_text(Point3{1.0 / 3, 0.5, -1e-9}, 1) == "(0.33333, 0.5, 0)");
    CHECK(place_text(Point3{457123.456, 5932123.4567, -300.27}, 12'000) ==
          "(457123.5, 5932123.5, -300.3)");
    CHECK(place_text(Point3{457123.456, 5932123.4567, -300.25}) ==
          "(457123.46, 5932123.46, -300.25)"); // the extent may be 6000
    CHECK(place_text(Point3{}) == "(0, 0, 0)");
    CHECK(place_text(Point3{1e300, 1, 0}, 1e300) == "(1e300, 1, 0)");
    CHECK(place_text(Point3{1e-7, 0, 0}, 1e-6) == "(0.0000001, 0, 0)");
    CHECK(place_text(Point3{1e-20, 0, 0}) == "(1e-20, 0, 0)");
    CHECK(place_text({0.1 + 0.2, 10}) == "(0.3, 10)");
}

TEST_CASE("place_text: a place is found again, to a hundred-thousandth of the extent", "[core]") {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> share(0, 1), power(-3, 8);
    for (int i = 0; i < 20'000; ++i) {
        const double extent = std::pow(10, power(random));
        const double x = (1000 * share(random) - 500) * extent;
        const double known = std::strtod(place_text({x}, extent).c_str() + 1, nullptr);
        const double unknown = std::strtod(place_text({x}).c_str() + 1, nullptr);
        CAPTURE(extent, x, known, unknown);
        CHECK(std::abs(known - x) <= 0.5001e-5 * extent);
        CHECK(std::abs(unknown - x) <= 0.5001e-8 * std::abs(x));
    }
}

TEST_CASE("extent_of: the longest side", "[core]") {
    const std::vector<Point3> places{{0, 0, 0}, {1, -4, 2}, {-1, 3, 2}};
    CHECK(extent_of(places) == 7);
    CHECK(extent_of({}) == 0);
}
