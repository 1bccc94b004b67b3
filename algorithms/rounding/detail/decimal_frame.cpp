// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/decimal_frame.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <terrane/algorithms/rounding/detail/state.hpp>
#include <terrane/algorithms/rounding/detail/tuning.hpp>

namespace terrane::rounding::detail {
namespace {

constexpr double no_bound = std::numeric_limits<double>::infinity();
constexpr double ulp_of_1 = std::numeric_limits<double>::epsilon();
constexpr double least_double = std::numeric_limits<double>::denorm_min();

// All powers that are doubles. A quotient of an integer and one of them is the nearest double.
constexpr std::array<double, 23> powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                               1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                               1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

double coordinate(const Point3& p, unsigned axis) {
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// Returns the integer k for which x is k / factor, or a double next to it.
std::optional<double> decimal(double x, double factor) {
    const double k = std::nearbyint(x * factor), nearest = k / factor;
    if (nearest == x || std::nextafter(x, no_bound) == nearest ||
        std::nextafter(x, -no_bound) == nearest)
        return k;
    return std::nullopt;
}

/// Returns the least power of ten that makes all of `values` integers. Decimals must be many
/// doubles apart, as else each double is near one.
std::optional<double> factor_for(std::span<const double> values) {
    double largest = 0;
    for (const double x : values) largest = std::max(largest, std::fabs(x));
    for (const double factor : powers_of_ten) {
        if (!(largest * factor * ulp_of_1 < rounding_tuning.decimal_share)) return std::nullopt;
        if (std::ranges::all_of(values, [&](double x) { return decimal(x, factor).has_value(); }))
            return factor;
    }
    return std::nullopt;
}

} // namespace

double DecimalFrame::Axis::into(double x) const {
    if (factor == 1) return x;
    return decimal(x, factor).value_or(x * factor) + 0.0; // never -0
}

double DecimalFrame::Axis::back(double x) const {
    if (factor == 1) return x;
    const auto not_below =
        std::ranges::lower_bound(places, x, {}, [](const Place& p) { return p.in_frame; });
    if (not_below != places.end() && not_below->in_frame == x) return not_below->given;
    double given = x / factor;
    if (not_below != places.end()) given = std::min(given, not_below->given);
    if (not_below != places.begin()) given = std::max(given, not_below[-1].given);
    return given;
}

// The computed quotient errs by half a unit of its last place at most, the difference by less.
double DecimalFrame::Axis::error(double x, double given) const {
    if (factor == 1) return std::fabs(x - given);
    const double quotient = x / factor;
    return std::fabs(quotient - given) * (1 + ulp_of_1) + std::fabs(quotient) * (ulp_of_1 / 2) +
           least_double;
}

std::optional<DecimalFrame> DecimalFrame::of_chosen(std::span<const Point3> points) {
    DecimalFrame frame;
    bool is_other = false;
    for (unsigned axis = 0; axis < 3; ++axis) {
        std::vector<double> values;
        for (const Point3& p : points) values.push_back(coordinate(p, axis));
        frame.axes_[axis].factor = factor_for(values).value_or(1);
        is_other = is_other || frame.axes_[axis].factor != 1;
    }
    if (!is_other) return std::nullopt;
    return frame;
}

std::optional<DecimalFrame> DecimalFrame::of(std::span<const Point3> points,
                                             const std::vector<bool>& chosen,
                                             const KeptPlanes& kept) {
    auto frame = of_chosen(chosen_of(points, chosen));
    if (!frame) return std::nullopt;
    std::array<double, 3> largest{};
    for (const Point3& p : points) {
        const auto errors = frame->errors_of(p);
        for (unsigned axis = 0; axis < 3; ++axis)
            largest[axis] = std::max(largest[axis], errors[axis]);
    }
    frame->state_largest_errors(largest);
    for (unsigned axis = 0; axis < 3; ++axis) {
        if (frame->is_as_given(axis)) continue;
        std::vector<Place> places;
        for (const Point3& p : points) {
            const double x = coordinate(p, axis);
            places.push_back(
                {frame->axes_[axis].into(x), x, std::ranges::binary_search(kept[axis], x)});
        }
        frame->keep_places(axis, std::move(places));
    }
    return frame;
}

// Of the coordinates that become the same, a kept one or the lowest is where they go back.
void DecimalFrame::keep_places(unsigned axis, std::vector<Place> places) {
    std::ranges::sort(places, [](const Place& p, const Place& q) {
        return std::tuple(p.in_frame, !p.is_kept, p.given) <
               std::tuple(q.in_frame, !q.is_kept, q.given);
    });
    places.erase(
        std::unique(places.begin(), places.end(),
                    [](const Place& p, const Place& q) { return p.in_frame == q.in_frame; }),
        places.end());
    axes_[axis].places = std::move(places);
}

void DecimalFrame::state_largest_errors(const std::array<double, 3>& errors) {
    largest_error_ = length_bound(errors[0], errors[1], errors[2]);
}

std::array<double, 3> DecimalFrame::errors_of(const Point3& p) const {
    std::array<double, 3> errors{};
    for (unsigned axis = 0; axis < 3; ++axis) {
        const double x = coordinate(p, axis);
        if (!is_as_given(axis)) errors[axis] = axes_[axis].error(axes_[axis].into(x), x);
    }
    return errors;
}

Point3 DecimalFrame::into(const Point3& p) const {
    return {axes_[0].into(p.x), axes_[1].into(p.y), axes_[2].into(p.z)};
}

Point3 DecimalFrame::back(const Point3& q) const {
    return {axes_[0].back(q.x), axes_[1].back(q.y), axes_[2].back(q.z)};
}

double DecimalFrame::error_of(const Point3& q, const std::array<double, 3>& errors) const {
    const Point3 given = back(q);
    std::array<double, 3> most{};
    for (unsigned axis = 0; axis < 3; ++axis)
        most[axis] = axes_[axis].error(coordinate(q, axis), coordinate(given, axis)) +
                     errors[axis] / axes_[axis].factor * (1 + ulp_of_1);
    return length_bound(most[0], most[1], most[2]) * (1 + ulp_of_1);
}

} // namespace terrane::rounding::detail
