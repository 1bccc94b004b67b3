// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/kernel/config.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <terrane/kernel/point.hpp>
#include <terrane/kernel/sign.hpp>

namespace terrane {

/// The static filter of orient3d for many points against one plane, whose normal is made once.
///
/// Laws (a test carries each number):
/// (1) A sign that side(p) gives is that of orient3d(a, b, c, p).
/// Right in any rounding mode. The bound is derived at static_orient3d in predicates.cpp: the same
/// operations in the same order.
class PlaneFilter {
public:
    PlaneFilter(const Point3& a, const Point3& b, const Point3& c) : origin_(a) {
        const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z;
        const double cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
        normal_ = {by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx};
        largest_ = {std::max(std::fabs(bx), std::fabs(cx)), std::max(std::fabs(by), std::fabs(cy)),
                    std::max(std::fabs(bz), std::fabs(cz))};
    }

    /// Never Zero.
    [[nodiscard]] std::optional<Sign> side(const Point3& p) const {
        const double dx = p.x - origin_.x, dy = p.y - origin_.y, dz = p.z - origin_.z;
        const double x = std::max(largest_.x, std::fabs(dx));
        const double y = std::max(largest_.y, std::fabs(dy));
        const double z = std::max(largest_.z, std::fabs(dz));
        if (!(std::min(std::min(x, y), z) > 0x1p-320 && std::max(std::max(x, y), z) < 0x1p+330))
            return std::nullopt;
        const double value = normal_.x * dx + normal_.y * dy + normal_.z * dz;
        const double bound = 48 * std::numeric_limits<double>::epsilon() * x * y * z;
        if (value > bound) return Sign::Positive;
        if (value < -bound) return Sign::Negative;
        return std::nullopt;
    }

private:
    Point3 origin_, normal_, largest_;
};

} // namespace terrane
