// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/height_errors.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/choice.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/kriging.hpp>

namespace terrane {

using namespace kriging::detail;

namespace {

using kriging::detail::constants;

/// Keeps up to `most_error_data`, half of them on the border.
std::vector<Point3> some_of(std::span<const Point3> data, std::size_t border) {
    const std::size_t most = constants.most_error_data;
    if (data.size() <= most) return {data.begin(), data.end()};
    const auto near = data.first(border), far = data.subspan(border);
    std::vector<Point3> some;
    for (const auto i : well_spread_in_plane(near, std::min(most / 2, border)))
        some.push_back(near[i]);
    for (const auto i : well_spread_in_plane(far, most - some.size())) some.push_back(far[i]);
    return some;
}

} // namespace

struct HeightErrors::State {
    State(std::span<const Point3> data, std::size_t border, double radius, const Run& run) :
        choice(choose_model({data, border, radius}, {}, run)),
        kriging(some_of(data, border), choice.variogram, choice.degree, run),
        rounding(rounding_of(data)) {}

    ModelChoice choice;
    Kriging kriging;
    double rounding = 0; ///< least expected error
};

HeightErrors::HeightErrors(std::span<const Point3> data, std::size_t border, double radius,
                           const Run& run) :
    state_(std::make_unique<State>(data, border, radius, run)) {}

HeightErrors::HeightErrors(HeightErrors&&) noexcept = default;
HeightErrors& HeightErrors::operator=(HeightErrors&&) noexcept = default;
HeightErrors::~HeightErrors() = default;

std::vector<double> HeightErrors::at(std::span<const Point3> heights, const Run& run) const {
    const State& s = *state_;
    if (!s.choice.determined)
        return std::vector<double>(heights.size(), std::numeric_limits<double>::quiet_NaN());
    const auto estimates = s.kriging.at(heights, run);
    std::vector<double> errors;
    for (std::size_t i = 0; i < heights.size(); ++i)
        errors.push_back(std::hypot(estimates[i].standard_deviation,
                                    estimates[i].value - heights[i].z, s.rounding));
    return errors;
}

double HeightErrors::validated() const {
    const BlockValidation& validation = state_->choice.validation;
    return validation.blocks > 0 ? validation.error : std::numeric_limits<double>::quiet_NaN();
}

bool HeightErrors::determined() const {
    return state_->choice.determined;
}

double HeightErrors::noise() const {
    return std::sqrt(state_->choice.variogram.nugget);
}

} // namespace terrane
