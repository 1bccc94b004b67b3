// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/kernel/config.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <terrane/kernel/point.hpp>
#include <terrane/kernel/static_filter_bounds.hpp>

namespace terrane {

/// Static filter that separates many triangles from one. It succeeds for triangles on one side of
/// the plane of the one, or in a projection on the outer side of one of its edges, at such a
/// distance that the points of both triangles may be rounded to the nearest doubles.
///
/// Laws (a test carries each number):
/// (1) If is_beside, is_beyond or is_apart holds for a triangle, its distance from this one is at least
///     2^-51 (M + N), where M and N are the largest absolute coordinates of the two triangles, in
///     any rounding mode. Rounding to nearest moves a point of a triangle by at most
///     sqrt(3) 2^-53 M.
/// The bounds of static_filter_bounds.hpp are enlarged by that distance, times the length of the
/// normal or of the edge, which is bounded from above. kernel/proofs/separation_*.g are proofs that
/// Gappa checks.
class SeparationFilter {
public:
    SeparationFilter(const Point3& a, const Point3& b, const Point3& c) :
        at_{a, b, c}, plane_(a, b, c) {
        const Point3& n = plane_.normal();
        length_ = std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z) + plane_.normal_error();
        size_ = std::max({size_of(a), size_of(b), size_of(c)});
    }

    /// Whether p, q, r lie on one side of the plane, far enough by law (1).
    [[nodiscard]] bool is_beside(const Point3& p, const Point3& q, const Point3& r) const {
        const double room = room_for(p, q, r);
        const int side = side_of_plane(p, room);
        return side != 0 && side_of_plane(q, room) == side && side_of_plane(r, room) == side;
    }

    /// Whether p, q, r lie on the outer side of an edge in a projection, far enough by law (1).
    [[nodiscard]] bool is_beyond(const Point3& p, const Point3& q, const Point3& r) const {
        const Axis axis = steepest();
        const std::array<Uv, 3> corners{static_filter::project(axis, at_[0]),
                                        static_filter::project(axis, at_[1]),
                                        static_filter::project(axis, at_[2])};
        const int turn = side_of_line(corners[0], corners[1], corners[2], 0);
        if (turn == 0) return false;
        const std::array<Uv, 3> others{static_filter::project(axis, p),
                                       static_filter::project(axis, q),
                                       static_filter::project(axis, r)};
        const double room = room_for(p, q, r);
        for (unsigned j = 0; j < 3; ++j) {
            const Uv &from = corners[j], &to = corners[(j + 1) % 3];
            if (std::all_of(others.begin(), others.end(),
                            [&](const Uv& o) { return side_of_line(from, to, o, room) == -turn; }))
                return true;
        }
        return false;
    }

    /// Whether this filter or that of p, q, r shows by law (1) that the two triangles are apart.
    [[nodiscard]] bool is_apart(const Point3& p, const Point3& q, const Point3& r) const {
        if (is_beside(p, q, r)) return true;
        const SeparationFilter other(p, q, r);
        const auto& [a, b, c] = at_;
        return other.is_beside(a, b, c) || is_beyond(p, q, r) || other.is_beyond(a, b, c);
    }

    static constexpr double least_distance = 0x1p-51; ///< of law (1), per M + N
    static constexpr double share = 0x1p-50; ///< what the bounds are enlarged by, per M + N

private:
    using Uv = static_filter::Uv;

    [[nodiscard]] double room_for(const Point3& p, const Point3& q, const Point3& r) const {
        return share * (size_ + std::max({size_of(p), size_of(q), size_of(r)}));
    }
    static double size_of(const Point3& p) {
        return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
    /// Chooses the axis of the projection. Any axis is correct; a long normal separates more.
    [[nodiscard]] Axis steepest() const {
        const Point3& n = plane_.normal();
        const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
        return z >= x && z >= y ? Axis::z : x >= y ? Axis::x : Axis::y;
    }

    /// Returns the sign as 1 or -1; 0 where the value does not exceed its bound by more than
    /// `room`.
    static int sign_with_room(const static_filter::Estimate& e, double room) {
        const double bound = e.bound + room;
        return e.value > bound ? 1 : e.value < -bound ? -1 : 0;
    }
    [[nodiscard]] int side_of_plane(const Point3& p, double room) const {
        const auto determinant = plane_.determinant(p);
        if (!determinant.in_range()) return 0;
        return sign_with_room(determinant.estimate(), length_ * room);
    }
    static int side_of_line(const Uv& a, const Uv& b, const Uv& p, double room) {
        const static_filter::Turn2d turn(a, b, a, p);
        if (!turn.in_range()) return 0;
        return sign_with_room(turn.estimate(), turn.length() * room);
    }

    std::array<Point3, 3> at_;
    static_filter::Plane plane_;
    double length_, size_; ///< at least the L1 norm of the true normal; largest absolute
                           ///< coordinate
};

} // namespace terrane
