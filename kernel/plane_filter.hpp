// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/kernel/config.hpp>

#include <optional>

#include <terrane/kernel/point.hpp>
#include <terrane/kernel/sign.hpp>
#include <terrane/kernel/static_filter_bounds.hpp>

namespace terrane {

/// Static filter of orient3d for many points against one plane. The normal is computed once.
///
/// Laws (a test carries each number):
/// (1) A sign returned by side(p) is that of orient3d(a, b, c, p), in any rounding mode.
class PlaneFilter {
public:
    PlaneFilter(const Point3& a, const Point3& b, const Point3& c) : plane_(a, b, c) {}

    /// Returns the side of p, never Zero; std::nullopt where the error bound does not decide.
    [[nodiscard]] std::optional<Sign> side(const Point3& p) const {
        const auto determinant = plane_.determinant(p);
        if (!determinant.in_range()) return std::nullopt;
        return determinant.estimate().sign();
    }

private:
    static_filter::Plane plane_;
};

} // namespace terrane
