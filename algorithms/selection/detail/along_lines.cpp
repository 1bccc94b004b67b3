// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Lines along an axis through triangles, and where they pass through a surface.
#include <terrane/algorithms/selection/detail/sides.hpp>

#include <algorithm>
#include <optional>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/algorithms/selection/windings.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/polynomials.hpp>

namespace terrane::selection {
namespace {

using InputPoint = polynomial::Coordinates<Exact, polynomial::One>;
using Corners = std::array<PointIndex, 3>;

/// Returns the box around the doubles nearest to three points. Rounding to nearest keeps the order, so that what
/// boxes tell holds for the exact points.
Box box_of(const PointStore& points, const Corners& corners) {
    const Point3 a = points.nearest(corners[0]), b = points.nearest(corners[1]),
                 c = points.nearest(corners[2]);
    return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
            {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

Box flattened(Box box, Axis axis) {
    const auto k = static_cast<std::size_t>(axis);
    box.low[k] = box.high[k] = 0;
    return box;
}

/// Whether the insides of two triangles overlap as seen along an axis: no edge of either has the other one beyond it.
/// One that is seen as a line overlaps what it touches; `other` does not overlap anything then.
bool overlap(UpwardWitness upward, const PointStore& points, Axis axis, const Corners& triangle,
             const Corners& other) {
    const auto turn_of_corners = [&](const Corners& c) {
        return points.orient2d(upward, axis, c[0], c[1], c[2]);
    };
    const Sign own = turn_of_corners(triangle), its = turn_of_corners(other);
    const auto is_beyond = [&](const Corners& corners, const Corners& edges, Sign turn) {
        for (unsigned i = 0; i < 3; ++i)
            if (std::ranges::all_of(corners, [&, a = edges[i], b = edges[(i + 1) % 3]](auto p) {
                    const Sign side = points.orient2d(upward, axis, a, b, p);
                    return own == Sign::Zero ? side == -turn : side != turn;
                }))
                return true;
        return false;
    };
    return its != Sign::Zero && !is_beyond(triangle, other, its) &&
           (own == Sign::Zero || !is_beyond(other, triangle, own));
}

/// Whether a triangle that is seen as a line runs through the inside of another one that it overlaps.
bool runs_through(UpwardWitness upward, const PointStore& points, Axis axis, const Corners& line,
                  const Corners& other) {
    const Sign its = points.orient2d(upward, axis, other[0], other[1], other[2]);
    bool has_corners_on_both_sides = false; // the other one, of the line
    for (unsigned i = 0; i < 3; ++i) {
        const unsigned j = (i + 1) % 3;
        const auto side_of = [&](const Corners& edge, PointIndex p) {
            return points.orient2d(upward, axis, edge[i], edge[j], p);
        };
        if (std::ranges::all_of(line, [&](PointIndex p) { return side_of(other, p) != its; }))
            return false;
        const auto lies = [&](Sign side) {
            return std::ranges::any_of(other,
                                       [&](PointIndex p) { return side_of(line, p) == side; });
        };
        has_corners_on_both_sides |= lies(Sign::Positive) && lies(Sign::Negative);
    }
    return has_corners_on_both_sides;
}

InputPoint input_point(const PointStore& points, PointIndex p) {
    return polynomial::cartesian<Exact>(points.input(p));
}

/// Returns the side of a directed edge on which a point is in the projection; a point on its line is shifted by
/// (e, e^2) for an infinitely small e, or by its opposite. Zero only if the ends coincide.
Sign turn(Axis axis, const InputPoint& a, const InputPoint& b, const ExactPoint& p, bool opposite) {
    if (const Sign s = exact_sign(polynomial::orient2d(axis, a, b, p)); s != Sign::Zero) return s;
    const auto d = polynomial::difference(axis, b, a);
    const Sign first = -exact_sign(d.v);
    const Sign shifted = first != Sign::Zero ? first : exact_sign(d.u);
    return opposite ? -shifted : shifted;
}

/// Whether a convex polygon has area.
bool has_area(const std::vector<ExactPoint>& polygon) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        for (const Axis axis : {Axis::x, Axis::y, Axis::z})
            if (exact_sign(polynomial::orient2d(axis, polygon[0], polygon[i], polygon[i + 1])) !=
                Sign::Zero)
                return true;
    return false;
}

/// Returns a point of a triangle, inside of the part that overlaps another one, of input points. Nothing if this part
/// has no area, as it may be of a triangle that is seen as a line.
std::optional<ExactPoint> point_in_overlap(const PointStore& points, Axis axis,
                                           const Corners& triangle, const Corners& other) {
    std::vector<ExactPoint> part;
    for (const PointIndex p : triangle) part.push_back(points.exact(p));
    const std::array corners{input_point(points, other[0]), input_point(points, other[1]),
                             input_point(points, other[2])};
    const bool is_left = exact_sign(polynomial::orient2d(axis, corners[0], corners[1],
                                                         corners[2])) == Sign::Positive;
    for (unsigned i = 0; i < 3; ++i) { // cuts off what is beyond each edge
        std::vector<Exact> within;
        for (const ExactPoint& p : part) {
            const Exact side = polynomial::orient2d(axis, corners[i], corners[(i + 1) % 3], p);
            within.push_back(is_left ? side : -side);
        }
        std::vector<ExactPoint> left;
        for (std::size_t k = 0; k < part.size(); ++k) {
            const std::size_t next = (k + 1) % part.size();
            const Sign here = exact_sign(within[k]), there = exact_sign(within[next]);
            if (here != Sign::Negative) left.push_back(part[k]);
            if (here != -there || here == Sign::Zero) continue;
            const bool leaves = here == Sign::Positive;
            const std::size_t in = leaves ? k : next, out = leaves ? next : k;
            const Exact &f = within[in], &g = within[out];
            const ExactPoint &p = part[in], &q = part[out];
            left.push_back(
                {f * q.x - g * p.x, f * q.y - g * p.y, f * q.z - g * p.z, f * q.w - g * p.w});
        }
        part = std::move(left);
    }
    if (!has_area(part)) return std::nullopt;
    ExactPoint sum{Exact(0.0), Exact(0.0), Exact(0.0), Exact(1.0)}; // of the corners
    for (const ExactPoint& p : part)
        sum = {sum.x * p.w + p.x * sum.w, sum.y * p.w + p.y * sum.w, sum.z * p.w + p.z * sum.w,
               sum.w * p.w};
    sum.w = sum.w * Exact(double(part.size()));
    return sum;
}

} // namespace

std::uint8_t SidedSurface::along_line(const ExactPoint& place, std::span<const std::uint32_t> near,
                                      bool opposite) const {
    const PointStore& points = exact_.state->points;
    int above = 0, below = 0;
    for (const std::uint32_t p : near) {
        const Triangle& corners = exact_.input_corners()[p];
        const InputPoint a = input_point(points, corners[0]), b = input_point(points, corners[1]),
                         c = input_point(points, corners[2]);
        const Sign side = turn(axis_, a, b, place, opposite);
        if (turn(axis_, b, c, place, opposite) != side ||
            turn(axis_, c, a, place, opposite) != side)
            continue;
        const bool is_above = exact_sign(polynomial::orient3d(a, b, c, place)) != side;
        (is_above ? above : below) += (side == Sign::Positive) == (upper_[p] > 0) ? 1 : -1;
    }
    if (above != 0 && below == 0) return low_side;
    return above == 0 && below != 0 ? high_side : no_side;
}

std::uint8_t SidedSurface::along_lines(std::uint32_t triangle, std::span<const std::uint32_t> near,
                                       bool skips_lines) const {
    const PointStore& points = exact_.state->points;
    const auto& [u, v, w] = exact_.triangles[triangle];
    const Corners corners{exact_.vertices[u], exact_.vertices[v], exact_.vertices[w]};
    const auto k = static_cast<std::size_t>(axis_);
    const Box own = box_of(points, corners);
    std::vector<std::uint32_t> over; // what overlaps the triangle
    unsigned passages = 0;           // bits: up above it, down above it, up below it, down below it
    const unsigned unknown = 0b1111;
    bool is_line = false,
         runs_in = false; // as seen along the axis; inside of a triangle of the surface
    {
        const UpwardRounding upward;
        is_line = points.orient2d(upward, axis_, corners[0], corners[1], corners[2]) == Sign::Zero;
        if (is_line && skips_lines) return no_side;
        for (const std::uint32_t p : near) {
            const Corners other = exact_.input_corners()[p];
            if (!overlap(upward, points, axis_, corners, other)) continue;
            over.push_back(p);
            runs_in = runs_in || !is_line || runs_through(upward, points, axis_, corners, other);
            const Box its = box_of(points, other);
            const bool is_above = its.low[k] > own.high[k], is_below = its.high[k] < own.low[k];
            const bool up = (turn_of(exact_, p, axis_) == Sign::Positive) == (upper_[p] > 0);
            passages |= is_above ? (up ? 1U : 2U) : is_below ? (up ? 4U : 8U) : unknown;
        }
    }
    if (runs_in && (passages == 1 || passages == 2)) return low_side;
    if (runs_in && (passages == 4 || passages == 8)) return high_side;
    std::vector<Box> boxes;
    for (const std::uint32_t p : over)
        boxes.push_back(flattened(box_of(points, exact_.input_corners()[p]), axis_));
    std::vector<std::vector<std::uint32_t>> passed; // per line: what it may pass through
    for (const std::uint32_t p : over) passed.push_back({p});
    for (const auto& [p, q] : candidate_pairs(boxes, {}, Search::automatic)) {
        passed[p].push_back(over[q]);
        passed[q].push_back(over[p]);
    }
    std::uint8_t sides = no_side;
    for (std::size_t i = 0; i < over.size(); ++i)
        if (const auto place =
                point_in_overlap(points, axis_, corners, exact_.input_corners()[over[i]])) {
            unsigned told = along_line(*place, passed[i], false);
            if (is_line) told &= along_line(*place, passed[i], true); // the surface may end there
            sides |= static_cast<std::uint8_t>(told);
        }
    return sides;
}

std::vector<std::uint8_t> SidedSurface::along_lines(const std::vector<std::uint32_t>& triangles,
                                                    bool skips_lines) const {
    std::vector<std::uint8_t> sides(triangles.size(), no_side);
    if (triangles.empty()) return sides;
    const PointStore& points = exact_.state->points;
    std::vector<Box> boxes; // of the triangles, then of the surface
    std::vector<std::uint32_t> inputs;
    for (const std::uint32_t t : triangles) {
        const auto& [u, v, w] = exact_.triangles[t];
        boxes.push_back(flattened(
            box_of(points, {exact_.vertices[u], exact_.vertices[v], exact_.vertices[w]}), axis_));
    }
    for (const std::uint32_t p : inputs_) {
        if (upper_[p] == 0) continue;
        boxes.push_back(flattened(box_of(points, exact_.input_corners()[p]), axis_));
        inputs.push_back(p);
    }
    const auto count = static_cast<std::uint32_t>(triangles.size());
    std::vector<std::uint32_t> groups(boxes.size(), 1);
    std::fill_n(groups.begin(), count, 0);
    std::vector<std::uint32_t> near;
    const auto pairs = candidate_pairs(boxes, groups, Search::automatic);
    for (std::size_t i = 0, end = 0; i < pairs.size(); i = end) {
        near.clear();
        for (; end < pairs.size() && pairs[end].first == pairs[i].first; ++end)
            near.push_back(inputs[pairs[end].second - count]);
        sides[pairs[i].first] = along_lines(triangles[pairs[i].first], near, skips_lines);
    }
    return sides;
}

} // namespace terrane::selection
