// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/kernel/config.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <terrane/kernel/point.hpp>

namespace terrane {

/// A static filter that tells many triangles from one: those that lie beyond its plane, or in a
/// projection beyond one of its edges, with room for all vertices on them to go to nearest doubles.
///
/// Laws (a test carries each number):
/// (1) Of a triangle that leaves_clear tells from this one no point is nearer to this one than
///     2^-51 (M + N), M and N the largest absolute coordinates of both. The points of a triangle
///     are at most sqrt(3) 2^-53 M off when they are rounded.
/// Right in any rounding mode. The bounds without room are derived at static_orient3d and
/// static_turn2d in predicates.cpp: the same operations in the same order.
class SeparationFilter {
public:
    SeparationFilter(const Point3& a, const Point3& b, const Point3& c) : at_{a, b, c} {
        const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z;
        const double cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
        normal_ = {by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx};
        largest_ = {std::max(std::fabs(bx), std::fabs(cx)), std::max(std::fabs(by), std::fabs(cy)),
                    std::max(std::fabs(bz), std::fabs(cz))};
        length_ = std::fabs(normal_.x) + std::fabs(normal_.y) + std::fabs(normal_.z);
        size_ = std::max({size_of(a), size_of(b), size_of(c)});
    }

    /// Whether the plane shows it.
    [[nodiscard]] bool is_beside(const Point3& p, const Point3& q, const Point3& r) const {
        const int side = side_of_plane(p);
        return side != 0 && side_of_plane(q) == side && side_of_plane(r) == side;
    }

    /// Whether an edge shows it.
    [[nodiscard]] bool is_beyond(const Point3& p, const Point3& q, const Point3& r) const {
        const unsigned axis = steepest();
        const std::array<Uv, 3> corners{project(axis, at_[0]), project(axis, at_[1]),
                                        project(axis, at_[2])};
        const int turn = side_of_line(corners[0], corners[1], corners[2], 0);
        if (turn == 0) return false;
        const std::array<Uv, 3> others{project(axis, p), project(axis, q), project(axis, r)};
        const double room = share * (size_ + std::max({size_of(p), size_of(q), size_of(r)}));
        for (unsigned j = 0; j < 3; ++j) {
            const Uv &from = corners[j], &to = corners[(j + 1) % 3];
            if (std::all_of(others.begin(), others.end(),
                            [&](const Uv& o) { return side_of_line(from, to, o, room) == -turn; }))
                return true;
        }
        return false;
    }

private:
    static constexpr double unit = std::numeric_limits<double>::epsilon();
    static constexpr double share = 0x1p-50; ///< of the sizes: the room

    struct Uv {
        double u, v;
    };

    static double size_of(const Point3& p) {
        return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
    static Uv project(unsigned axis, const Point3& p) {
        return axis == 2 ? Uv{p.x, p.y} : axis == 0 ? Uv{p.y, p.z} : Uv{p.z, p.x};
    }
    /// A guess; any axis is right.
    [[nodiscard]] unsigned steepest() const {
        const double x = std::fabs(normal_.x), y = std::fabs(normal_.y), z = std::fabs(normal_.z);
        return z >= x && z >= y ? 2 : x >= y ? 0 : 1;
    }

    /// 1, -1, or 0 where it is not sure, or not by enough.
    [[nodiscard]] int side_of_plane(const Point3& p) const {
        const Point3& a = at_[0];
        const double dx = p.x - a.x, dy = p.y - a.y, dz = p.z - a.z;
        const double x = std::max(largest_.x, std::fabs(dx));
        const double y = std::max(largest_.y, std::fabs(dy));
        const double z = std::max(largest_.z, std::fabs(dz));
        if (!(std::min(std::min(x, y), z) > 0x1p-320 && std::max(std::max(x, y), z) < 0x1p+330))
            return 0;
        const double value = normal_.x * dx + normal_.y * dy + normal_.z * dz;
        const double bound = 48 * unit * x * y * z + length_ * (share * (size_ + size_of(p)));
        return value > bound ? 1 : value < -bound ? -1 : 0;
    }

    static int side_of_line(const Uv& a, const Uv& b, const Uv& p, double room) {
        const double bu = b.u - a.u, bv = b.v - a.v, du = p.u - a.u, dv = p.v - a.v;
        const double u = std::max(std::fabs(bu), std::fabs(du));
        const double v = std::max(std::fabs(bv), std::fabs(dv));
        if (!(std::min(u, v) > 0x1p-480 && std::max(u, v) < 0x1p+500)) return 0;
        const double value = bu * dv - bv * du;
        const double bound = 9 * unit * u * v + (std::fabs(bu) + std::fabs(bv)) * room;
        return value > bound ? 1 : value < -bound ? -1 : 0;
    }

    std::array<Point3, 3> at_;
    Point3 normal_, largest_; ///< largest absolute differences from the first corner
    double length_, size_;    ///< at least that of the normal; of the largest absolute coordinate
};

} // namespace terrane
