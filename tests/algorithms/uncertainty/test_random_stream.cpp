// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests random numbers by name: known answers, the C library as an oracle, and moments.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <string>

#include <terrane/algorithms/uncertainty/random_stream.hpp>

using namespace terrane;

TEST_CASE("random stream: Philox gives the known answers of its authors", "[uncertainty]") {
    using Block = std::array<std::uint32_t, 4>;
    CHECK(philox({0, 0, 0, 0}, {0, 0}) == Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
    const std::uint32_t all = 0xffffffff;
    CHECK(philox({all, all, all, all}, {all, all}) ==
          Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
    CHECK(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
          Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("random stream: logarithm and cosine agree with the C library", "[uncertainty]") {
    RandomStream stream("arguments");
    for (int i = 0; i < 20000; ++i) {
        const double u = stream.uniform();
        CHECK(portable_log(u) == Approx(std::log(u)).epsilon(1e-15).margin(1e-300));
        const double large = u * std::exp2(i % 60 - 30);
        CHECK(portable_log(large) == Approx(std::log(large)).epsilon(1e-15).margin(2e-16));
        const double t = 2 * u - 1;
        CHECK(std::fabs(cos_of_turns(t) - std::cos(2 * std::numbers::pi * t)) < 1.5e-15);
        CHECK(cos_of_turns(1048576 + std::ldexp(std::floor(t * 1024), -10)) ==
              cos_of_turns(std::ldexp(std::floor(t * 1024), -10)));
    }
    CHECK(portable_log(1) == 0);
    CHECK(cos_of_turns(0) == 1);
    CHECK(cos_of_turns(0.5) == -1);
    CHECK(cos_of_turns(0.25) == 0);
}

TEST_CASE("random stream: numbers are normal, and those of different names independent",
          "[uncertainty]") {
    const int n = 200000;
    RandomStream a("1 17 top"), b("1 18 top"), again("1 17 top");
    double sum = 0, squares = 0, fourth = 0, product = 0;
    int beyond = 0;
    for (int i = 0; i < n; ++i) {
        const double x = a.normal(), y = b.normal();
        REQUIRE(again.normal() == x);
        sum += x;
        squares += x * x;
        fourth += x * x * x * x;
        product += x * y;
        beyond += std::fabs(x) > 1.959963984540054 ? 1 : 0;
    }
    const double root = std::sqrt(n); // bounds: five standard errors
    CHECK(std::fabs(sum) / n < 5 / root);
    CHECK(std::fabs(squares / n - 1) < 5 * std::sqrt(2.0) / root);
    CHECK(std::fabs(fourth / n - 3) < 5 * std::sqrt(96.0) / root);
    CHECK(std::fabs(product) / n < 5 / root);
    CHECK(std::fabs(beyond / double(n) - 0.05) < 5 * std::sqrt(0.05 * 0.95) / root);
}
