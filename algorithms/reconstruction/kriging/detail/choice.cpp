// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/choice.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Dense>

#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/system.hpp>

namespace terrane::kriging::detail {
namespace {

constexpr unsigned trend_degree = 1;

std::vector<Point3> selected(std::span<const Point3> points,
                             const std::vector<std::uint32_t>& which) {
    std::vector<Point3> result;
    for (const auto i : which) result.push_back(points[i]);
    return result;
}

/// The shapes of an automatic choice, each rougher than the next.
std::vector<Variogram> shapes(const VariogramFitOptions& options) {
    const auto shape = [](VariogramModel model, double exponent) {
        Variogram v;
        v.model = model;
        v.exponent = exponent;
        return v;
    };
    if (!options.model)
        return {shape(VariogramModel::exponential, 1), shape(VariogramModel::matern, 1.5),
                shape(VariogramModel::matern, 2.5), shape(VariogramModel::gaussian, 1)};
    if (*options.model == VariogramModel::matern)
        return {shape(VariogramModel::matern, 1.5), shape(VariogramModel::matern, 2.5)};
    if (*options.model != VariogramModel::power) return {shape(*options.model, 1)};
    std::vector<Variogram> powers;
    for (const double exponent : constants.powers)
        powers.push_back(shape(VariogramModel::power, exponent));
    return powers;
}

/// Searches the most likely variogram.
class Search {
public:
    Search(std::span<const Point3> data, const VariogramFitOptions& options, const Run& run) :
        likelihood_(data, trend_degree), options_(options), run_(run) {}

    Variogram operator()() {
        Variogram none;
        none.model = options_.model.value_or(VariogramModel::spherical);
        none.range = std::max(likelihood_.extent(), std::numeric_limits<double>::min());
        if (likelihood_.trend_only()) return none;
        Likely best;
        for (const Variogram& shape : shapes(options_)) {
            const Likely found = best_range(shape);
            const double margin = shape.model == VariogramModel::gaussian && !options_.model
                                      ? constants.worth_gaussian
                                      : 0;
            if (found.likelihood > best.likelihood + margin) best = found;
        }
        if (options_.anisotropy) turn(best);
        return best.variogram.sill > 0 ? best.variogram : none;
    }

private:
    [[nodiscard]] Likely at(const Variogram& shape) const {
        if (run_.stop.stop_requested()) return {};
        if (run_.progress) run_.progress("variogram", 0);
        return likelihood_.at(shape, options_.most_nugget);
    }

    /// Tries ranges at equal ratios, then between the best one and its neighbours.
    [[nodiscard]] Likely best_range(Variogram shape) const {
        Likely best;
        double best_at = 0;
        const auto attempt = [&](double exponent) {
            shape.range = std::exp(exponent);
            const Likely found = at(shape);
            if (!(found.likelihood > best.likelihood)) return;
            best = found;
            best_at = exponent;
        };
        const double most = shape.model == VariogramModel::gaussian ? constants.most_smooth_range
                                                                    : constants.most_range;
        const double low = std::log(constants.least_range * likelihood_.extent()),
                     high = std::log(most * likelihood_.extent());
        if (shape.model == VariogramModel::power) { // its range is a mere unit
            attempt(std::log(likelihood_.extent()));
            return best;
        }
        double step = (high - low) / (constants.range_steps - 1);
        for (int k = 0; k < constants.range_steps; ++k) attempt(low + k * step);
        for (int k = 0; k < constants.range_halvings; ++k) {
            step /= 2;
            const double middle = best_at;
            attempt(middle - step);
            attempt(std::min(middle + step, high));
        }
        return best;
    }

    /// Tries anisotropy of the best shape: every second direction and ratio, then the neighbours of
    /// the best one. The ratio changes neither the area nor the shape near h = 0.
    void turn(Likely& best) const {
        const Variogram plain = best.variogram;
        Likely turned;
        std::array<std::size_t, 2> at_best{};
        const auto& ratios = constants.anisotropy_ratios;
        const auto directions = static_cast<std::size_t>(180 / constants.anisotropy_step);
        const auto attempt = [&](std::size_t direction, std::size_t k) {
            Variogram shape = plain;
            shape.angle = static_cast<double>(direction % directions) * constants.anisotropy_step;
            shape.ratio = ratios[k];
            shape.range = plain.range / std::sqrt(shape.ratio);
            const Likely found = at(shape);
            if (!(found.likelihood > turned.likelihood)) return;
            turned = found;
            at_best = {direction, k};
        };
        for (std::size_t d = 0; d < directions; d += 2)
            for (std::size_t k = 1; k < ratios.size(); k += 2) attempt(d, k);
        const auto [d, k] = at_best;
        for (const auto other : {d + 1, d + directions - 1}) attempt(other, k);
        for (const auto other : {k - 1, k + 1})
            if (other < ratios.size()) attempt(at_best[0], other);
        if (turned.likelihood > best.likelihood + constants.worth_turned) best = turned;
    }

    Likelihood likelihood_;
    const VariogramFitOptions& options_;
    const Run& run_;
};

/// What is left out at a time: the data nearer to a place of the border than the hole's radius.
std::vector<std::vector<Eigen::Index>> blocks_of(std::span<const Point3> data,
                                                 std::span<const Point3> centres, double radius) {
    std::vector<std::vector<Eigen::Index>> blocks;
    for (const Point3& c : centres) {
        std::vector<Eigen::Index> block;
        for (std::size_t i = 0; i < data.size(); ++i)
            if (std::hypot(data[i].x - c.x, data[i].y - c.y) <= radius)
                block.push_back(static_cast<Eigen::Index>(i));
        const auto most = constants.most_of_all * static_cast<double>(data.size());
        if (!block.empty() && static_cast<double>(block.size()) <= most)
            blocks.push_back(std::move(block));
    }
    return blocks;
}

BlockValidation validate(const DataAroundHole& around, const Variogram& variogram, const Run& run) {
    BlockValidation result;
    const auto data = selected(around.data, well_spread(around.data, constants.most_block_data));
    const auto border = around.data.first(around.border);
    const auto centres = selected(border, well_spread(border, constants.blocks));
    const System system(data, variogram, trend_degree, run);
    if (!system.ready()) return result;
    const Eigen::MatrixXd projection = system.projection();
    double squares = 0, ratios = 0;
    std::size_t count = 0;
    for (const auto& block : blocks_of(data, centres, around.radius)) {
        if (run.stop.stop_requested()) break;
        const Eigen::MatrixXd covariance =
            projection(block, block).inverse(); // of the errors, nugget included
        const Eigen::VectorXd errors = covariance * system.weights()(block);
        const double square = errors.squaredNorm(), expected = covariance.trace();
        if (!(expected > 0) || !std::isfinite(square)) continue;
        squares += square;
        ratios += square / expected;
        count += block.size();
        ++result.blocks;
    }
    if (count == 0) return result;
    result.error = std::sqrt(squares / static_cast<double>(count));
    result.ratio = std::sqrt(ratios / static_cast<double>(result.blocks));
    return result;
}

} // namespace

std::vector<std::uint32_t> well_spread(std::span<const Point3> points, std::size_t count) {
    std::vector<std::uint32_t> chosen;
    if (points.size() <= count) {
        for (std::uint32_t i = 0; i < points.size(); ++i) chosen.push_back(i);
        return chosen;
    }
    Point3 mean;
    for (const Point3& p : points) {
        const auto n = static_cast<double>(points.size());
        mean = {mean.x + p.x / n, mean.y + p.y / n, mean.z + p.z / n};
    }
    std::vector<double> distance;
    for (const Point3& p : points) distance.push_back(std::hypot(p.x - mean.x, p.y - mean.y));
    constexpr double equal = 1 - 1e-9; // distances differ by more than rounding
    while (chosen.size() < count) {
        const double farthest = *std::max_element(distance.begin(), distance.end());
        if (!(farthest > 0)) break;
        std::uint32_t best = 0;
        double height = -1;
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            const double off = std::abs(points[i].z - mean.z);
            if (distance[i] < equal * farthest || off <= height) continue;
            best = i;
            height = off;
        }
        if (chosen.empty())
            std::fill(distance.begin(), distance.end(), std::numeric_limits<double>::infinity());
        chosen.push_back(best);
        for (std::uint32_t i = 0; i < points.size(); ++i)
            distance[i] = std::min(distance[i], std::hypot(points[i].x - points[best].x,
                                                           points[i].y - points[best].y));
    }
    return chosen;
}

ModelChoice choose_model(const DataAroundHole& around, const VariogramFitOptions& options,
                         const Run& run) {
    ModelChoice choice;
    choice.degree = trend_degree;
    choice.determined = around.data.size() >= constants.least_data;
    VariogramFitOptions fit = options;
    fit.anisotropy = options.anisotropy && choice.determined;
    const auto some = selected(around.data, well_spread(around.data, constants.most_fitted));
    choice.variogram = Search(some, fit, run)();
    choice.validation = validate(around, choice.variogram, run);
    const auto n = static_cast<double>(choice.validation.blocks);
    const double square = choice.validation.ratio * choice.validation.ratio;
    const double factor =
        std::max(1.0, (n * square + constants.block_prior) / (n + constants.block_prior));
    choice.variogram.sill *= factor;
    choice.variogram.nugget *= factor;
    return choice;
}

} // namespace terrane::kriging::detail
