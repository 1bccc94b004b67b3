// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Counts the work of the verifier.
#pragma once

#include <cstdint>
#include <functional>

#include <catch2/catch.hpp>

#include <terrane/algorithms/verify/stoppable.hpp>

namespace verify_work {

using namespace terrane;

/// Returns how many exact numbers are computed for a task.
inline std::uint64_t work_of(const std::function<void()>& task) {
    std::uint64_t looks = 0;
    REQUIRE(stoppable(
        {},
        [&]() -> Result<bool> {
            task();
            return true;
        },
        &looks));
    return looks;
}

/// Checks that work grows in proportion to a size, but for logarithms.
inline void check_growth(const std::function<void(int)>& task) {
    const auto at = [&](int n) { return work_of([&] { task(n); }); };
    const std::uint64_t once = at(1000), twice = at(2000), four_times = at(4000);
    INFO(once << " " << twice << " " << four_times);
    CHECK(twice < once * 5 / 2);
    CHECK(four_times < twice * 5 / 2);
}

} // namespace verify_work
