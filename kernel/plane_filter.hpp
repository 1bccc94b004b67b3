// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/kernel/config.hpp>

#include <optional>

#include <terrane/kernel/point.hpp>
#include <terrane/kernel/sign.hpp>
#include <terrane/kernel/static_filter_bounds.hpp>

namespace terrane {

/// The static filter of orient3d for many points against one plane, whose normal is made once.
///
/// Laws (a test carries each number):
/// (1) A sign that side(p) gives is that of orient3d(a, b, c, p).
/// Right in any rounding mode.
class PlaneFilter {
public:
    PlaneFilter(const Point3& a, const Point3& b, const Point3& c) : plane_(a, b, c) {}

    /// Never Zero.
    [[nodiscard]] std::optional<Sign> side(const Point3& p) const {
        const auto determinant = plane_.determinant(p);
        if (!determinant.in_range()) return std::nullopt;
        return determinant.estimate().sign();
    }

private:
    static_filter::Plane plane_;
};

} // namespace terrane
