// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/layers/detail/vertical_order.hpp>

#include <utility>

namespace terrane::layers::detail {
namespace {

constexpr auto right = Sign::Negative, left = Sign::Positive;

Sign orientation(UpwardWitness upward, const PointStore& points, PointIndex a, PointIndex b,
                 PointIndex c) {
    return points.orient2d(upward, Axis::z, a, b, c);
}

/// Tells whether an edge of s has all of t on its right or on its line.
bool is_apart(UpwardWitness upward, const PointStore& points, const UpwardTriangle& s,
              const UpwardTriangle& t) {
    for (unsigned i = 0; i < 3; ++i) {
        bool apart = true;
        for (unsigned j = 0; j < 3 && apart; ++j)
            apart = orientation(upward, points, s[i], s[(i + 1) % 3], t[j]) != left;
        if (apart) return true;
    }
    return false;
}

bool is_over(UpwardWitness upward, const PointStore& points, const UpwardTriangle& t,
             PointIndex p) {
    for (unsigned i = 0; i < 3; ++i)
        if (orientation(upward, points, t[i], t[(i + 1) % 3], p) == right) return false;
    return true;
}

/// Returns the side of the first corner of s over or under t that is not on t.
Sign side_of_corners(UpwardWitness upward, const PointStore& points, const UpwardTriangle& s,
                     const UpwardTriangle& t) {
    for (const PointIndex p : s)
        if (is_over(upward, points, t, p))
            if (const Sign side = points.orient3d(upward, t[0], t[1], t[2], p); side != Sign::Zero)
                return side;
    return Sign::Zero;
}

/// Returns the side of s if edges a b of s and c d of t cross in the projection; otherwise Zero.
Sign side_of_edges(UpwardWitness upward, const PointStore& points, PointIndex a, PointIndex b,
                   PointIndex c, PointIndex d) {
    const Sign c_side = orientation(upward, points, a, b, c),
               d_side = orientation(upward, points, a, b, d);
    if (c_side * d_side != Sign::Negative) return Sign::Zero;
    if (orientation(upward, points, c, d, a) * orientation(upward, points, c, d, b) !=
        Sign::Negative)
        return Sign::Zero;
    if (c_side == right) std::swap(c, d);
    // a, b, c turn left: if d is above their plane, c d passes above a b.
    return -points.orient3d(upward, a, b, c, d);
}

} // namespace

std::optional<UpwardTriangle> seen_along_z(UpwardWitness upward, const PointStore& points,
                                           UpwardTriangle corners) {
    const Sign side = orientation(upward, points, corners[0], corners[1], corners[2]);
    if (side == Sign::Zero) return std::nullopt;
    if (side == right) std::swap(corners[1], corners[2]);
    return corners;
}

bool overlap_along_z(UpwardWitness upward, const PointStore& points, const UpwardTriangle& s,
                     const UpwardTriangle& t) {
    return !is_apart(upward, points, s, t) && !is_apart(upward, points, t, s);
}

Sign above_along_z(UpwardWitness upward, const PointStore& points, const UpwardTriangle& s,
                   const UpwardTriangle& t) {
    if (const Sign side = side_of_corners(upward, points, s, t); side != Sign::Zero) return side;
    if (const Sign side = side_of_corners(upward, points, t, s); side != Sign::Zero) return -side;
    for (unsigned i = 0; i < 3; ++i)
        for (unsigned j = 0; j < 3; ++j)
            if (const Sign side =
                    side_of_edges(upward, points, s[i], s[(i + 1) % 3], t[j], t[(j + 1) % 3]);
                side != Sign::Zero)
                return side;
    return Sign::Zero;
}

} // namespace terrane::layers::detail
