// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include <terrane/algorithms/verify/detail/rational.hpp>

namespace terrane::verifier {

/// The exact box around points with w = 1.
struct Extent {
    bool any = false;
    std::array<mpz_class, 3> low, high;

    void add(const Vector4& point) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (!any || point[i] < low[i]) low[i] = point[i];
            if (!any || point[i] > high[i]) high[i] = point[i];
        }
        any = true;
    }
    /// Tells whether a point is in the box, widened by a limit on all sides.
    [[nodiscard]] bool has(const Vector4& point, const mpz_class& limit) const {
        for (std::size_t i = 0; i < 3; ++i)
            if (point[i] > high[i] + limit || point[i] < low[i] - limit) return false;
        return any;
    }
    /// Returns the square of the diagonal.
    [[nodiscard]] mpz_class size() const {
        mpz_class sum = 0;
        for (std::size_t i = 0; i < 3; ++i) sum += (high[i] - low[i]) * (high[i] - low[i]);
        return sum;
    }
};

} // namespace terrane::verifier
