// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/height_errors.hpp>

#include <array>
#include <cmath>
#include <limits>

#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/choice.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/direction_doubt.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/kriging.hpp>

namespace terrane {

using namespace kriging::detail;

struct HeightErrors::State {
    State(std::span<const Point3> data, std::size_t border, double radius, const Run& run) :
        choice(choose_model({data, border, radius}, {}, run)),
        kriging(error_data(data, border, choice.variogram), choice.variogram, choice.degree, run,
                choice.validation.noise_share),
        doubt(error_data(data, border, choice.variogram), choice, run),
        rounding(rounding_of(data, choice.degree)) {}

    ModelChoice choice;
    Kriging kriging;
    DirectionDoubt doubt;
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
    const auto doubts = s.doubt.at(heights, run);
    std::vector<double> errors;
    for (std::size_t i = 0; i < heights.size(); ++i)
        errors.push_back(std::hypot(estimates[i].standard_deviation,
                                    estimates[i].value - heights[i].z,
                                    std::hypot(s.rounding, doubts[i])));
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

std::array<double, 2> HeightErrors::anisotropy() const {
    const Variogram& v = state_->choice.variogram;
    if (v.model == VariogramModel::gaussian) return {0, 1};
    return {v.angle, v.ratio};
}

} // namespace terrane
