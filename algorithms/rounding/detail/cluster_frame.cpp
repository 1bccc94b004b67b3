// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/cluster_frame.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/rounding/detail/separation_bounds.hpp>
#include <terrane/algorithms/rounding/detail/state.hpp>

namespace terrane::rounding::detail {
namespace {

/// Least step of a lattice, in tolerances: a random number is a multiple of it by chance in about
/// one case of thirty.
constexpr double least_step = 64;
constexpr double most_steps = 1 << 20; ///< of a lattice along an axis

Point3 times(const Point3& v, double factor) {
    return {v.x * factor, v.y * factor, v.z * factor};
}

Point3 unit_vector(const Point3& v) {
    return times(v, 1 / length(v));
}

/// Returns a unit vector across n.
Point3 any_across(const Point3& n) {
    const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
    const Point3 least = x <= y && x <= z ? Point3{1, 0, 0}
                         : y <= z         ? Point3{0, 1, 0}
                                          : Point3{0, 0, 1};
    return unit_vector(cross(n, least));
}

/// Returns the largest length of which both numbers are multiples, but for errors.
double common_length(double a, double b, double error) {
    a = std::fabs(a);
    b = std::fabs(b);
    while (b > error) {
        const double rest = std::fabs(a - std::nearbyint(a / b) * b);
        a = b;
        b = rest;
    }
    return a;
}

} // namespace

void ClusterFrame::Axis::find_groups(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    for (const double v : values) {
        if (groups.empty() || v - groups.back().least > 2 * tolerance) groups.push_back({v, v, 0});
        groups.back().largest = v;
    }
    const auto middle = [](const Group& g) { return g.least + (g.largest - g.least) / 2; };
    for (const Group& g : groups) // the origin is one of the points
        if (g.least <= 0 && g.largest >= 0) base = middle(g);
    for (Group& g : groups) g.coordinate = middle(g) - base;
}

/// Makes the coordinates integers if all are multiples of one length.
void ClusterFrame::Axis::number_lattice() {
    double common = 0, farthest = 0;
    for (const Group& g : groups) {
        common = common_length(common, g.coordinate, 8 * tolerance);
        if (std::fabs(g.coordinate) > std::fabs(farthest)) farthest = g.coordinate;
    }
    const double steps = std::fabs(std::nearbyint(farthest / common));
    if (!(common > least_step * tolerance && steps <= most_steps)) return;
    common = std::fabs(farthest) / steps; // the farthest one says it best
    for (const Group& g : groups)
        if (std::fabs(g.coordinate - std::nearbyint(g.coordinate / common) * common) > tolerance)
            return;
    for (Group& g : groups) g.coordinate = std::nearbyint(g.coordinate / common) + 0.0;
    unit = common;
    is_lattice = true;
}

double ClusterFrame::Axis::coordinate_of(double value) const {
    const auto at = std::partition_point(groups.begin(), groups.end(), [&](const Group& g) {
        return g.largest + tolerance < value;
    });
    if (at != groups.end() && at->least - tolerance <= value) return at->coordinate;
    const double coordinate = (value - base) / unit, number = std::nearbyint(coordinate);
    const bool is_of_lattice = is_lattice && std::fabs(number) <= most_steps &&
                               std::fabs(value - base - number * unit) <= tolerance;
    return (is_of_lattice ? number : coordinate) + 0.0; // never -0
}

std::optional<ClusterFrame> ClusterFrame::of_chosen(std::span<const Point3> points,
                                                    std::span<const Point3> normals,
                                                    double tolerance) {
    if (points.empty() || normals.empty()) return std::nullopt;
    ClusterFrame frame;
    frame.origin_ = points.front();
    std::vector<Point3> all(normals.begin(), normals.end());
    if (all.size() == 1) all.push_back(any_across(all[0]));
    if (all.size() == 2) all.push_back(unit_vector(cross(all[0], all[1])));
    for (unsigned k = 0; k < 3; ++k) {
        Axis& axis = frame.axes_[k];
        axis.normal = all[k];
        axis.tolerance = tolerance;
        std::vector<double> values;
        for (const Point3& p : points) values.push_back(dot(axis.normal, minus(p, frame.origin_)));
        axis.find_groups(std::move(values));
        axis.number_lattice();
    }
    frame.set_steps();
    return frame;
}

std::optional<ClusterFrame> ClusterFrame::of(std::span<const Point3> points,
                                             const std::vector<bool>& chosen,
                                             std::span<const Point3> normals, double tolerance) {
    auto frame = of_chosen(chosen_of(points, chosen), normals, tolerance);
    if (!frame) return std::nullopt;
    frame->keep_places(points);
    if (!std::isfinite(frame->largest_error_)) return std::nullopt;
    return frame;
}

/// Solves normal_i * step_k = unit_k if i = k, else 0. Rounding errors of the steps are no errors of
/// the frame, which is what these steps make it.
void ClusterFrame::set_steps() {
    const Point3 &a = axes_[0].normal, &b = axes_[1].normal, &c = axes_[2].normal;
    const double volume = dot(a, cross(b, c));
    axes_[0].step = times(cross(b, c), axes_[0].unit / volume);
    axes_[1].step = times(cross(c, a), axes_[1].unit / volume);
    axes_[2].step = times(cross(a, b), axes_[2].unit / volume);
    for (Axis& axis : axes_) axis.shift = axis.base / axis.unit;
}

void ClusterFrame::keep_places(std::span<const Point3> points) {
    for (const Point3& p : points) {
        const Point3 place = into(p);
        const Point3& given = given_.try_emplace(place, p).first->second;
        largest_error_ = std::max(
            {largest_error_, error_between(place, p, {}), error_between(place, given, {})});
        if (std::isnan(largest_error_)) break;
    }
}

Point3 ClusterFrame::into(const Point3& p) const {
    const Point3 d = minus(p, origin_);
    return {axes_[0].coordinate_of(dot(axes_[0].normal, d)),
            axes_[1].coordinate_of(dot(axes_[1].normal, d)),
            axes_[2].coordinate_of(dot(axes_[2].normal, d))};
}

Point3 ClusterFrame::back(const Point3& q) const {
    if (const auto at = given_.find(q); at != given_.end()) return at->second;
    const auto along = [&](auto member) {
        return axes_[0].step.*member * (q.x + axes_[0].shift) +
               axes_[1].step.*member * (q.y + axes_[1].shift) +
               axes_[2].step.*member * (q.z + axes_[2].shift);
    };
    return {origin_.x + along(&Point3::x), origin_.y + along(&Point3::y),
            origin_.z + along(&Point3::z)};
}

/// Bounds the distance between given and the exact place of a point within `errors` of q. Each of
/// the operations on a coordinate errs by at most 2^-52 of its result, in any rounding mode.
double ClusterFrame::error_between(const Point3& q, const Point3& given,
                                   const std::array<double, 3>& errors) const {
    constexpr double unit = frame_error_factor * std::numeric_limits<double>::epsilon(),
                     least = std::numeric_limits<double>::denorm_min();
    const auto most = [&](auto member) {
        const std::array<double, 3> step{axes_[0].step.*member, axes_[1].step.*member,
                                         axes_[2].step.*member};
        const std::array<double, 3> terms{step[0] * (q.x + axes_[0].shift),
                                          step[1] * (q.y + axes_[1].shift),
                                          step[2] * (q.z + axes_[2].shift)};
        const double from_origin = given.*member - origin_.*member;
        double size = std::fabs(from_origin), moved = 0;
        for (unsigned k = 0; k < 3; ++k) {
            size += std::fabs(terms[k]) + std::fabs(step[k] * axes_[k].shift);
            moved += std::fabs(step[k]) * errors[k];
        }
        return std::fabs(terms[0] + terms[1] + terms[2] - from_origin) + unit * size +
               moved * (1 + unit) + 8 * least;
    };
    return length_bound(most(&Point3::x), most(&Point3::y), most(&Point3::z)) * (1 + unit);
}

double ClusterFrame::error_of(const Point3& q, const std::array<double, 3>& errors) const {
    return error_between(q, back(q), errors);
}

} // namespace terrane::rounding::detail
