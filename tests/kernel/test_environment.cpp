// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks the floating-point arithmetic that the filters rely on in this very program. It shows
// wrong compiler flags and start-up code of linked libraries (-ffast-math in one of them turns
// denormals off for all).
#include <terrane/kernel/numbers.hpp>

#include <catch2/catch.hpp>

#include <cfenv>
#include <limits>

namespace {

// Hides a value from the optimiser.
double opaque(double d) {
    volatile double v = d;
    return v;
}

} // namespace

TEST_CASE("doubles are IEEE doubles, rounded to nearest even at each operation") {
    CHECK(std::numeric_limits<double>::is_iec559);
    CHECK(std::fegetround() == FE_TONEAREST);
    const double one = opaque(1), half_ulp = opaque(0x1p-53);
    CHECK(one + half_ulp == 1);
    CHECK(one + opaque(0x1.8p-53) == 1 + 0x1p-52);
    CHECK((one + opaque(0x1p-52)) + half_ulp == 1 + 0x1p-51); // the tie goes to even, upward
    CHECK((one + half_ulp) - one == 0);                       // not reassociated
    CHECK(opaque(0.1) * opaque(10) - one == 0); // not contracted to a fused multiply-add
    CHECK(opaque(0.0) / opaque(0.0) != opaque(0.0) / opaque(0.0));
}

TEST_CASE("denormals are neither flushed nor taken for zero") {
    const double a = opaque(0x1.8p-1022), b = opaque(0x1p-1022);
    CHECK(a - b == 0x1p-1023);
    CHECK(a - b != 0);
    CHECK(opaque(5e-324) + opaque(5e-324) == 1e-323);
    CHECK(opaque(5e-324) * opaque(0x1p1000) == 0x1p-74);
}

TEST_CASE("the rounding mode is honoured, and restored") {
    // Each division has operands of its own: compilers may move or share others across the guard.
    const double third = opaque(1) / opaque(3);
    {
        const terrane::UpwardRounding guard;
        CHECK(opaque(1) / opaque(3) > third);
        CHECK(-(opaque(-1) / opaque(3)) == third);
        CHECK(opaque(1) + opaque(0x1p-80) == 1 + 0x1p-52);
    }
    CHECK(std::fegetround() == FE_TONEAREST);
    CHECK(opaque(1) / opaque(3) == third);
}
