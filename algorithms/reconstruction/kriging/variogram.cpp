// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/variogram.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane {
namespace {

/// Those that a user can ask for by name.
constexpr std::array named_models{VariogramModel::spherical, VariogramModel::exponential,
                                  VariogramModel::gaussian, VariogramModel::power,
                                  VariogramModel::matern};

/// Arguments at which the covariance of the matern models is 5 % of the sill.
constexpr double matern_once = 4.743865, matern_twice = 5.918649;

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

/// Returns e^-x; 0 where even its product with x^2 is lost beside 1. Underflow would take longer.
double decay(double x) {
    return x > 50 ? 0 : std::exp(-x);
}

/// Evaluates a model without nugget and with sill 1.
double shape(VariogramModel model, double ratio, double exponent) {
    switch (model) {
    case VariogramModel::spherical:
        return ratio >= 1 ? 1 : ratio * (1.5 - 0.5 * ratio * ratio);
    case VariogramModel::exponential:
        return 1 - decay(3 * ratio);
    case VariogramModel::gaussian:
        return 1 - decay(3 * ratio * ratio);
    case VariogramModel::matern: {
        const bool once = exponent < 2;
        const double a = ratio * (once ? matern_once : matern_twice);
        return 1 - (1 + a + (once ? 0 : a * a / 3)) * decay(a);
    }
    case VariogramModel::thin_plate:
        return ratio > 0 ? -ratio * ratio * std::log(ratio) : 0;
    case VariogramModel::cubic:
        return -ratio * ratio * ratio;
    case VariogramModel::power:
        break;
    }
    return exponent == 1 ? ratio : std::pow(ratio, exponent);
}

} // namespace

std::string_view name_of(VariogramModel model) {
    switch (model) {
    case VariogramModel::spherical:
        return "spherical";
    case VariogramModel::exponential:
        return "exponential";
    case VariogramModel::gaussian:
        return "gaussian";
    case VariogramModel::matern:
        return "matern";
    case VariogramModel::thin_plate:
        return "thin plate";
    case VariogramModel::cubic:
        return "cubic";
    case VariogramModel::power:
        break;
    }
    return "power";
}

std::optional<VariogramModel> variogram_model_named(std::string_view name) {
    for (const auto model : named_models)
        if (name_of(model) == name) return model;
    return std::nullopt;
}

double Variogram::distance(double dx, double dy) const {
    if (ratio == 1) return length_in_plane(dx, dy);
    const double c = std::cos(radians(angle)), s = std::sin(radians(angle));
    return length_in_plane(c * dx + s * dy, (c * dy - s * dx) / ratio);
}

double Variogram::at(double distance) const {
    return nugget + sill * shape(model, distance / range, exponent);
}

std::string description(const Variogram& v) {
    auto text = fmt::format("{} model, range {}, sill {}, nugget {}", name_of(v.model),
                            figure(v.range, 4), figure(v.sill, 4), figure(v.nugget, 4));
    if (v.model == VariogramModel::power || v.model == VariogramModel::matern)
        text += fmt::format(", exponent {}", figure(v.exponent, 3));
    if (v.ratio < 1)
        text += fmt::format("; longest at {:.0f} degrees from x, {} of it across", v.angle,
                            figure(v.ratio, 2));
    return text;
}

std::vector<std::array<double, 2>> experimental_variogram(std::span<const Point3> points,
                                                          const Variogram& model, double longest) {
    const StandardArithmetic guard;
    constexpr std::size_t classes = 15, most_points = 1500;
    std::array<std::array<double, 3>, classes> sums{}; // of distances, of gamma, and of pairs
    const auto chosen = std::min(points.size(), most_points);
    const auto pick = [&](std::size_t k) { return points[k * points.size() / chosen]; };
    for (std::size_t i = 0; i < chosen; ++i)
        for (std::size_t j = i + 1; j < chosen; ++j) {
            const Point3 p = pick(i), q = pick(j);
            const double h = model.distance(q.x - p.x, q.y - p.y);
            if (!(h > 0) || h > longest) continue;
            const auto at = static_cast<std::size_t>(double(classes) * h / longest);
            auto& [distance, gamma, pairs] = sums[std::min(at, classes - 1)];
            distance += h;
            gamma += (q.z - p.z) * (q.z - p.z) / 2;
            ++pairs;
        }
    std::vector<std::array<double, 2>> result;
    for (const auto& [distance, gamma, pairs] : sums)
        if (pairs > 0) result.push_back({distance / pairs, gamma / pairs});
    return result;
}

} // namespace terrane
