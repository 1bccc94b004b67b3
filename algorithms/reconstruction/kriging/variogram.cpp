// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/variogram.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>

namespace terrane {
namespace {

using kriging::detail::constants;

constexpr std::array all_models{VariogramModel::spherical, VariogramModel::exponential,
                                VariogramModel::gaussian, VariogramModel::power};

/// Arguments at which the covariance of the matern models is 5 % of the sill.
constexpr double matern_once = 4.743865, matern_twice = 5.918649;

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

/// Returns 1 - exp(-x). For x > 1 the difference loses no digits, and exp() takes half as long as
/// expm1().
double one_less_exp(double x) {
    return x > 1 ? 1 - std::exp(-x) : -std::expm1(-x);
}

/// Evaluates a model without nugget and with sill 1.
double shape(VariogramModel model, double ratio, double exponent) {
    switch (model) {
    case VariogramModel::spherical:
        return ratio >= 1 ? 1 : ratio * (1.5 - 0.5 * ratio * ratio);
    case VariogramModel::exponential:
        return one_less_exp(3 * ratio);
    case VariogramModel::gaussian:
        return one_less_exp(3 * ratio * ratio);
    case VariogramModel::matern: {
        const bool once = exponent < 2;
        const double a = ratio * (once ? matern_once : matern_twice);
        return 1 - (1 + a + (once ? 0 : a * a / 3)) * std::exp(-a);
    }
    case VariogramModel::power:
        break;
    }
    return std::pow(ratio, exponent);
}

/// Sums over the pairs of each class.
class Classes {
public:
    explicit Classes(double longest) :
        longest_(longest), bins_(constants.distance_classes * constants.direction_classes) {}

    void add(const Point3& a, const Point3& b) {
        double dx = b.x - a.x, dy = b.y - a.y;
        if (dx < 0 || (dx == 0 && dy < 0)) {
            dx = -dx;
            dy = -dy;
        }
        const double h = length_in_plane(dx, dy);
        if (!(h > 0) || h > longest_) return;
        const auto at = [](double share, std::size_t classes) {
            return std::min(static_cast<std::size_t>(share * static_cast<double>(classes)),
                            classes - 1);
        };
        const double direction = std::atan2(dy, dx) / std::numbers::pi + 0.5; // in [0, 1]
        VariogramBin& bin =
            bins_[at(h / longest_, constants.distance_classes) * constants.direction_classes +
                  at(direction, constants.direction_classes)];
        bin.dx += dx;
        bin.dy += dy;
        bin.distance += h;
        bin.gamma += (b.z - a.z) * (b.z - a.z) / 2;
        ++bin.pairs;
    }

    std::vector<VariogramBin> means() {
        std::vector<VariogramBin> result;
        for (VariogramBin& bin : bins_) {
            if (bin.pairs == 0) continue;
            const auto n = static_cast<double>(bin.pairs);
            result.push_back({bin.dx / n, bin.dy / n, bin.distance / n, bin.gamma / n, bin.pairs});
        }
        return result;
    }

private:
    double longest_;
    std::vector<VariogramBin> bins_;
};

struct Fit {
    Variogram variogram;
    double misfit = HUGE_VAL;
};

/// Fits models to bins whose distances are measured with one anisotropy.
class Fitter {
public:
    Fitter(std::span<const VariogramBin> bins, double angle, double ratio, double most_nugget) :
        angle_(angle), ratio_(ratio), most_nugget_(most_nugget) {
        Variogram measure;
        measure.angle = angle;
        measure.ratio = ratio;
        for (const VariogramBin& bin : bins) {
            const double along = length_in_plane(bin.dx, bin.dy);
            // The mean of vectors is shorter than the mean length, so only its direction is used.
            const double h =
                along > 0 ? measure.distance(bin.dx, bin.dy) * bin.distance / along : bin.distance;
            // The weight does not depend on the anisotropy, so that misfits are comparable.
            const double weight = static_cast<double>(bin.pairs) / (bin.distance * bin.distance);
            bins_.push_back({h, bin.gamma, weight});
            longest_ = std::max(longest_, h);
        }
    }

    /// Minimises over the one nonlinear parameter: on a grid, then by golden section between its
    /// neighbours.
    [[nodiscard]] Fit best(VariogramModel model) const {
        const bool power = model == VariogramModel::power;
        const double low =
            power ? constants.least_power : std::log(longest_ / constants.range_part);
        const double high =
            power ? constants.most_power : std::log(longest_ * constants.range_factor);
        constexpr int steps = constants.fit_steps;
        const double step = (high - low) / steps;
        Fit found;
        double best_at = low;
        for (int i = 0; i <= steps; ++i)
            if (const Fit fit = at(model, low + i * step); fit.misfit < found.misfit) {
                found = fit;
                best_at = low + i * step;
            }
        double a = std::max(low, best_at - step), b = std::min(high, best_at + step);
        for (int i = 0; i < constants.fit_refinements; ++i) {
            const double c = a + (b - a) * 0.382, d = a + (b - a) * 0.618;
            if (at(model, c).misfit <= at(model, d).misfit)
                b = d;
            else
                a = c;
        }
        const Fit refined = at(model, (a + b) / 2);
        return refined.misfit < found.misfit ? refined : found;
    }

private:
    struct Bin {
        double distance, gamma, weight;
    };

    /// Fits nugget and sill by weighted least squares, neither negative.
    [[nodiscard]] Fit at(VariogramModel model, double parameter) const {
        Fit fit;
        fit.variogram = {model, 0, 0, longest_, 1, angle_, ratio_};
        (model == VariogramModel::power ? fit.variogram.exponent : fit.variogram.range) =
            model == VariogramModel::power ? parameter : std::exp(parameter);
        double w = 0, ws = 0, wss = 0, wg = 0, wsg = 0;
        for (const Bin& bin : bins_) {
            const double s = shape_at(fit.variogram, bin.distance);
            w += bin.weight;
            ws += bin.weight * s;
            wss += bin.weight * s * s;
            wg += bin.weight * bin.gamma;
            wsg += bin.weight * s * bin.gamma;
        }
        const double determinant = w * wss - ws * ws;
        double nugget = determinant > 0 ? (wss * wg - ws * wsg) / determinant : 0;
        double sill = determinant > 0 ? (w * wsg - ws * wg) / determinant : 0;
        if (nugget < 0 || determinant <= 0) {
            nugget = 0;
            sill = wss > 0 ? wsg / wss : 0;
        } else if (sill < 0) {
            sill = 0;
            nugget = wg / w;
        }
        if (nugget > most_nugget_) {
            nugget = most_nugget_;
            sill = wss > 0 ? (wsg - nugget * ws) / wss : 0;
        }
        fit.variogram.nugget = nugget;
        fit.variogram.sill = std::max(sill, 0.0);
        fit.misfit = misfit(fit.variogram);
        return fit;
    }

    static double shape_at(const Variogram& v, double distance) {
        return shape(v.model, distance / v.range, v.exponent);
    }

    [[nodiscard]] double misfit(const Variogram& v) const {
        double sum = 0;
        for (const Bin& bin : bins_) {
            const double off = v.nugget + v.sill * shape_at(v, bin.distance) - bin.gamma;
            sum += bin.weight * off * off;
        }
        return sum;
    }

    double angle_, ratio_, most_nugget_;
    double longest_ = 0;
    std::vector<Bin> bins_;
};

Fit best_model(std::span<const VariogramBin> bins, const VariogramFitOptions& options, double angle,
               double ratio) {
    const Fitter fitter(bins, angle, ratio, options.most_nugget);
    if (options.model) return fitter.best(*options.model);
    Fit best;
    for (const auto model : all_models)
        if (const Fit fit = fitter.best(model); fit.misfit < best.misfit) best = fit;
    return best;
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
    case VariogramModel::power:
        break;
    }
    return "power";
}

std::optional<VariogramModel> variogram_model_named(std::string_view name) {
    for (const auto model : all_models)
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

std::vector<VariogramBin>
experimental_variogram(std::span<const Point3> points,
                       std::span<const std::array<std::uint32_t, 2>> close, double longest) {
    const StandardArithmetic guard;
    Classes classes(longest);
    const auto chosen = std::min(points.size(), constants.most_variogram_points);
    const auto pick = [&](std::size_t k) { return points[k * points.size() / chosen]; };
    for (std::size_t i = 0; i < chosen; ++i)
        for (std::size_t j = i + 1; j < chosen; ++j) classes.add(pick(i), pick(j));
    for (const auto& [a, b] : close) classes.add(points[a], points[b]);
    return classes.means();
}

Variogram fit_variogram(std::span<const VariogramBin> bins, const VariogramFitOptions& options) {
    const StandardArithmetic guard;
    const auto differs = [](const VariogramBin& bin) { return bin.gamma > 0; };
    if (std::none_of(bins.begin(), bins.end(), differs))
        return {options.model.value_or(VariogramModel::spherical)};
    Fit best = best_model(bins, options, 0, 1);
    if (!options.anisotropy) return best.variogram;
    Fit anisotropic;
    for (double angle = 0; angle < 180; angle += constants.anisotropy_step)
        for (const double ratio : constants.anisotropy_ratios)
            if (const Fit fit = best_model(bins, options, angle, ratio);
                fit.misfit < anisotropic.misfit)
                anisotropic = fit;
    return anisotropic.misfit < constants.worth_anisotropy * best.misfit ? anisotropic.variogram
                                                                         : best.variogram;
}

} // namespace terrane
