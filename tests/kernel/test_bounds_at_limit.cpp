// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Static filters at their bounds: inputs whose exact or computed value lies within one percent of
// the error bound, of both signs, with sizes from all of the admissible range, in all rounding
// modes. Rationals judge.
#include "support/filter_limits.hpp"

#include <catch2/catch.hpp>

namespace {

using namespace test_support;

/// |value - exact|, in bounds.
double error_in_bounds(const Estimate& e, const mpq_class& exact) {
    const mpq_class share = (mpq_class(e.value) - exact) / mpq_class(e.bound);
    return std::fabs(share.get_d());
}

/// Scales each axis by a power of two, so that sizes come from all of the range; the circle needs
/// one for both. Sizes stay within it where they were between 2^-6 and 4.
Coordinates scaled(Random& random, const Filter& f, Coordinates x) {
    const int low = std::ilogb(f.range.low) + 7, high = std::ilogb(f.range.high) - 3;
    std::array<int, 3> shift{};
    for (int& s : shift) {
        const int where = random_int(random, 0, 3);
        s = where == 0 ? low : where == 1 ? high : random_int(random, low, high);
    }
    if (&f == &circle) shift[1] = shift[0];
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::ldexp(x[i], shift[i % f.dimension]);
    return x;
}

struct Tally {
    int exact_at_limit = 0;    ///< |exact| within one percent of the bound
    int computed_at_limit = 0; ///< |value| within one percent of it
    double largest_error = 0;  ///< in bounds
};

void judge(const Filter& f, const Coordinates& x, int mode, Tally& tally) {
    std::optional<Estimate> e;
    std::vector<std::optional<Sign>> signs;
    {
        const Mode set(mode);
        e = f.estimate(x);
        signs = f.signs(x);
    }
    if (!e) return;
    const mpq_class exact = f.exact(x);
    const Sign sign = sign_of(exact);
    signs.push_back(e->sign());
    for (const auto& claimed : signs)
        if (claimed) REQUIRE(*claimed == sign);
    const auto is_at_limit = [&](double v) { return std::fabs(v - 1) <= 0.01; };
    const double error = error_in_bounds(*e, exact);
    REQUIRE(error <= 1);
    tally.largest_error = std::max(tally.largest_error, error);
    tally.exact_at_limit += is_at_limit(mpq_class(abs(exact) / mpq_class(e->bound)).get_d());
    tally.computed_at_limit += is_at_limit(std::fabs(e->value / e->bound));
}

/// Tunes random inputs to either side of the bound and to both sides of zero, for each mode.
Tally judge_at_limit(const Filter& f, int count, std::uint64_t seed) {
    Random random(seed);
    Tally tally;
    for (int i = 0; i < cases(count); ++i) {
        const Coordinates start = scaled(random, f, nearly_zero(random, f));
        const int mode = modes[static_cast<std::size_t>(i) % modes.size()];
        const auto e = f.estimate(start);
        if (!e) continue;
        const double share = 1 + 0.009 * minus_one_to_one(random);
        for (const double sign : {1.0, -1.0}) {
            Coordinates x = start;
            const mpq_class target = mpq_class(sign * share) * mpq_class(e->bound);
            tune(f, x, target);
            judge(f, x, mode, tally);
            std::optional<Estimate> computed;
            {
                const Mode set(mode);
                computed = f.estimate(x);
            }
            if (!computed) continue;
            tune(f, x, target + f.exact(x) - mpq_class(computed->value));
            judge(f, x, mode, tally);
        }
    }
    return tally;
}

/// Added to a number between 1 and 2, it is lost when sums are rounded towards minus infinity;
/// taken away, it counts as twice that. It is almost a unit.
constexpr double almost_unit = 0x1.fffff8p-53;

} // namespace

TEST_CASE("filters at their bounds: turn2d never claims a wrong sign") {
    const Tally tally = judge_at_limit(turn, 4'000, 11);
    CAPTURE(tally.exact_at_limit, tally.computed_at_limit, tally.largest_error);
    CHECK(tally.exact_at_limit > cases(4'000));
    CHECK(tally.computed_at_limit > cases(2'000));
    CHECK(tally.largest_error > 0.05);
}

TEST_CASE("filters at their bounds: orient3d never claims a wrong sign") {
    const Tally tally = judge_at_limit(side, 4'000, 12);
    CAPTURE(tally.exact_at_limit, tally.computed_at_limit, tally.largest_error);
    CHECK(tally.exact_at_limit > cases(3'000));
    CHECK(tally.computed_at_limit > cases(2'000));
    CHECK(tally.largest_error > 0.05);
}

TEST_CASE("filters at their bounds: in_circle never claims a wrong sign") {
    const Tally tally = judge_at_limit(circle, 4'000, 13);
    CAPTURE(tally.exact_at_limit, tally.computed_at_limit, tally.largest_error);
    CHECK(tally.exact_at_limit > cases(3'000));
    CHECK(tally.computed_at_limit > cases(2'000));
    CHECK(tally.largest_error > 0.01);
}

TEST_CASE("filters at their bounds: errors come near the bounds") {
    // Each difference errs by almost a unit, and the signs make the errors of all products add up.
    Random random(20);
    const auto largest_of = [&](const Filter& f, const Coordinates& signs) {
        double largest = 0;
        for (int i = 0; i < cases(20'000); ++i) {
            const double width = std::ldexp(1, -random_int(random, 4, 18));
            Coordinates x = signs;
            for (double& c : x)
                c = c == 0 ? -almost_unit : c * (1 + (one_to_two(random) - 1) * width);
            std::optional<Estimate> e;
            {
                const Mode down(FE_DOWNWARD);
                e = f.estimate(x);
            }
            REQUIRE(e);
            largest = std::max(largest, error_in_bounds(*e, f.exact(x)));
        }
        REQUIRE(largest <= 1);
        return largest;
    };
    CHECK(largest_of(turn, {0, 0, 1, -1, -1, 1}) > 0.5);
    CHECK(largest_of(side, {0, 0, 0, -1, 1, 1, 1, -1, 1, 1, 1, -1}) > 0.4);
    CHECK(largest_of(circle, {1, -1, -1, 1, -1, -1, 0, 0}) > 0.2);
}

TEST_CASE("filters at their bounds: half the bound of turn2d would give wrong signs") {
    Random random(14);
    int wrong = 0;
    double largest = 0;
    for (int i = 0; i < 2'000; ++i) {
        // Each difference errs by almost a unit, those of the second product towards larger
        // numbers.
        const double a = 1 + (one_to_two(random) - 1) / 20, b = 1 + (one_to_two(random) - 1) / 20;
        const double c = 1 + (one_to_two(random) - 1) / 20;
        double d = b * c / a;
        for (int step = 0; step < 8; ++step) d = std::nextafter(d, 0);
        for (int step = 0; step < 8; ++step) {
            d = std::nextafter(d, 2);
            const Coordinates x{-almost_unit, -almost_unit, a, -b, -c, d};
            std::optional<Estimate> e;
            {
                const Mode down(FE_DOWNWARD);
                e = turn.estimate(x);
            }
            REQUIRE(e);
            const mpq_class exact = turn.exact(x);
            largest = std::max(largest, error_in_bounds(*e, exact));
            if (const auto whole = e->sign()) REQUIRE(*whole == sign_of(exact));
            const auto half = Estimate{e->value, e->bound / 2}.sign();
            wrong += half && *half != sign_of(exact);
        }
    }
    CAPTURE(largest);
    CHECK(largest > 0.5);
    CHECK(wrong > 0);
}
