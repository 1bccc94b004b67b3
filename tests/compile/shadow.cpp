// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Shows that the twins of a shadow build (kernel/shadow.hpp) accept sound bounds and refuse others.
// It is always compiled with TERRANE_SHADOW.
#include <terrane/kernel/double_double.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/static_filter_bounds.hpp>

#include <iostream>
#include <random>
#include <stdexcept>

using namespace terrane;

namespace {

int failures = 0;

void require(bool holds, const char* what) {
    if (holds) return;
    std::cout << "does not hold: " << what << '\n';
    ++failures;
}

template <class Work>
bool is_refused(const Work& work) {
    try {
        work();
    } catch (const std::logic_error&) {
        return true;
    }
    return false;
}

void intervals() {
    const Interval third = [] {
        const UpwardRounding guard;
        return Interval(1.0) / Interval(3.0);
    }();
    require(third.inf() < third.sup(), "an inexact quotient has a width");
    const shadow::Twin exact = shadow::Twin(1.0) / shadow::Twin(3.0);
    require(is_refused([&] { Interval(third.sup(), third.sup(), exact); }),
            "a bound above is seen");
    require(is_refused([&] { Interval(third.inf(), third.inf(), exact); }),
            "a bound below is seen");
    // In the wrong rounding mode an interval does not contain its number.
    require(is_refused([] {
                Interval sum(0.0);
                for (int i = 0; i < 100; ++i) sum = sum + Interval(0.1) * Interval(0.7);
            }),
            "intervals without upward rounding are seen");
}

/// Runs operations, each of which checks its own bound.
void running_bounds() {
    DoubleDouble sum(0.0);
    for (int i = 1; i < 50; ++i) sum = sum + DoubleDouble(0.1) / DoubleDouble(3.0 * i);
    require(sum.error() > 0, "a sum of quotients has an error");
}

void static_estimates() {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-1, 1);
    bool some_error = false;
    for (int i = 0; i < 1000; ++i) {
        const auto point = [&] { return Point3{any(random), any(random), any(random)}; };
        const Point3 a = point(), b = point(), c = point(), d = point();
        const auto e = static_filter::Plane(a, b, c).determinant(d).estimate(); // checks itself
        const shadow::Twin value(e.value);
        some_error = some_error || !shadow::orient3d(a, b, c, d).is_near(value, e.bound / 200);
    }
    require(some_error, "a bound 200 times too small is seen");
}

} // namespace

int main() {
    intervals();
    running_bounds();
    static_estimates();
    return failures == 0 ? 0 : 1;
}
