// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares nearest_quotient with integers: no double is nearer, and ties go to even.
#include "support/effort.hpp"
#include "support/oracle.hpp"
#include "support/points.hpp"

#include <terrane/kernel/nearest.hpp>

#include <catch2/catch.hpp>

#include <cfenv>

namespace {

using namespace terrane;
using namespace test_support;
using limits = std::numeric_limits<double>;

/// Tells whether a b / (c d) is rounded correctly; c and d are not 0.
bool rounds_right(double a, double b, double c, double d) {
    const double result = nearest_quotient(Exact(a) * Exact(b), Exact(c) * Exact(d));
    const auto part = [](double x) { return oracle::Binary(x); };
    oracle::Int n = oracle::Int(long(part(a).mantissa)) * oracle::Int(long(part(b).mantissa));
    oracle::Int m = oracle::Int(long(part(c).mantissa)) * oracle::Int(long(part(d).mantissa));
    if (n == 0) return result == 0;
    if (m < 0) n = -n, m = -m;
    const int exponent = part(a).exponent + part(b).exponent - part(c).exponent - part(d).exponent;
    return oracle::is_nearest(result, n, m, exponent);
}

double quotient(double n, double d) {
    return nearest_quotient(Exact(n), Exact(d));
}

double nonzero(Random& random) {
    for (;;)
        if (const double d = any_double(random); d != 0) return d;
}

/// Returns a double with few or many bits, of an exponent near `exponent`.
double near_exponent(Random& random, int exponent) {
    const double mantissa =
        random_int(random, 0, 1) ? random_int(random, 1, 63) : random_real(random, 1, 2);
    return std::ldexp(random_int(random, 0, 1) ? mantissa : -mantissa,
                      exponent + random_int(random, -5, 5));
}

} // namespace

TEST_CASE("nearest_quotient: pinned values") {
    CHECK(quotient(1, 3) == 1.0 / 3.0);
    CHECK(quotient(-1, 3) == -1.0 / 3.0);
    CHECK(quotient(1, -3) == -1.0 / 3.0);
    CHECK(quotient(-1, -3) == 1.0 / 3.0);
    CHECK(quotient(0, -3) == 0);
    CHECK(quotient(6, 3) == 2);
    CHECK(quotient(limits::max(), 1) == limits::max());
    CHECK(quotient(limits::denorm_min(), 1) == limits::denorm_min());
}

TEST_CASE("nearest_quotient: exact ties go to even") {
    for (const double odd : {3.0, 0x1.0000000000001p53, 0x1.ffffffffffffdp53}) {
        const double down = quotient(std::nextafter(odd, 0), 1);
        CHECK(down < odd);
    }
    // Ties between 2^53 + 2 k and 2^53 + 2 k + 2: the numerator 2^53 + 2 k + 1 is not a double.
    const Exact big(0x1p53), one(1);
    CHECK(nearest_quotient(big + one, one) == 0x1p53);
    CHECK(nearest_quotient(big + Exact(3), one) == 0x1p53 + 4);
    CHECK(nearest_quotient((big + one) * Exact(7), Exact(-7)) == -0x1p53);
    // Just off the tie, by far less than doubles can resolve.
    CHECK(nearest_quotient(big + one + Exact(0x1p-900), one) == 0x1p53 + 2);
    CHECK(nearest_quotient(big + Exact(3) - Exact(0x1p-900), one) == 0x1p53 + 2);
}

TEST_CASE("nearest_quotient: denormals and their ties") {
    const double least = limits::denorm_min();
    CHECK(quotient(least, 2) == 0);
    CHECK(quotient(3 * least, 2) == 2 * least);
    CHECK(quotient(5 * least, 2) == 2 * least);
    CHECK(quotient(least, 3) == 0);
    CHECK(quotient(2 * least, 3) == least);
    CHECK(nearest_quotient(Exact(least) + Exact(least) * Exact(0x1p-500), Exact(2)) == least);
    CHECK(quotient(-3 * least, 2) == -2 * least);
    const double normal = limits::min();
    CHECK(nearest_quotient(Exact(normal) * Exact(2) - Exact(least), Exact(2)) == normal);
    CHECK(nearest_quotient(Exact(normal) * Exact(2) - Exact(3 * least), Exact(2)) ==
          normal - 2 * least);
}

TEST_CASE("nearest_quotient: infinity from half an ulp beyond the largest double") {
    const double max = limits::max(), half_ulp = 0x1p970;
    CHECK(nearest_quotient(Exact(max) + Exact(half_ulp), Exact(1)) == limits::infinity());
    CHECK(nearest_quotient(Exact(max) + Exact(std::nextafter(half_ulp, 0)), Exact(1)) == max);
    CHECK(nearest_quotient(Exact(max) * Exact(max), Exact(-1)) == -limits::infinity());
    CHECK(nearest_quotient(Exact(max) * Exact(max), Exact(max)) == max);
    CHECK(quotient(limits::denorm_min(), max) == 0);
}

TEST_CASE("nearest_quotient agrees with exact integers over all exponents") {
    Random random(31);
    for (int i = 0; i < cases(100'000); ++i)
        REQUIRE(
            rounds_right(any_double(random), any_double(random), nonzero(random), nonzero(random)));
}

TEST_CASE("nearest_quotient agrees with exact integers near denormals, overflow and ties") {
    Random random(32);
    for (const int exponent : {-1130, -1074, -1050, -1022, -1000, 0, 1000, 1023, 1030})
        for (int i = 0; i < cases(10'000); ++i) {
            const double d = near_exponent(random, 0);
            REQUIRE(rounds_right(near_exponent(random, exponent / 2),
                                 near_exponent(random, exponent - exponent / 2), d,
                                 random_int(random, 0, 1) ? 1.0 : near_exponent(random, 0)));
            // A tie, if the product of an odd 54-bit number and d were exact: (2 m + 1) d / (2 d).
            const double m = std::ldexp(random_real(random, 1, 2), 53);
            const Exact odd = (Exact(m) + Exact(m)) + Exact(1);
            const double tie = nearest_quotient(odd * Exact(d), Exact(d) * Exact(2));
            REQUIRE(tie == m);
        }
}

TEST_CASE("nearest_quotient does not depend on the rounding mode, and keeps it") {
    Random random(33);
    const int callers = std::fegetround();
    for (int i = 0; i < cases(5'000); ++i) {
        const Exact n = Exact(any_double(random)) * Exact(any_double(random));
        const Exact d = Exact(nonzero(random)) * Exact(nonzero(random));
        const double expected = nearest_quotient(n, d);
        for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
            std::fesetround(mode);
            const double result = nearest_quotient(n, d);
            const bool kept = std::fegetround() == mode;
            std::fesetround(callers);
            REQUIRE(kept);
            REQUIRE(result == expected);
        }
    }
}
