// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/choice.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Dense>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/system.hpp>

namespace terrane::kriging::detail {
namespace {

constexpr unsigned trend_degree = 1, higher_degree = 2;

std::vector<Point3> selected(std::span<const Point3> points,
                             const std::vector<std::uint32_t>& which) {
    std::vector<Point3> result;
    for (const auto i : which) result.push_back(points[i]);
    return result;
}

/// Reduces the sill as far as the data may as well be noise about the trend.
void weigh(const Likelihood& likelihood, double most_nugget, Likely& best) {
    constexpr double parameters = 2; // sill and range
    Variogram& v = best.variogram;
    const NoiseAlone alone = likelihood.noise_alone();
    const double share = alone.probability_of({best.likelihood, v.sill, v.nugget}, parameters);
    v.nugget = share * v.nugget + (1 - share) * std::min(alone.variance, most_nugget);
    v.sill *= std::max(share, constants.least_share);
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

/// Data from which a variogram is chosen.
struct FittedData {
    explicit FittedData(std::span<const Point3> data) {
        const auto pairs = well_spread_pairs(data, constants.most_fitted, constants.close_pairs);
        points = selected(data, pairs.chosen);
        gap = pairs.gap;
    }

    std::vector<Point3> points;
    double gap = 0; ///< median distance of neighbours; 0 if all data are taken
};

/// Searches the most likely variogram.
class Search {
public:
    Search(const FittedData& data, const VariogramFitOptions& options, const Run& run) :
        likelihood_(data.points, trend_degree), least_range_(constants.gaps_per_range * data.gap),
        options_(options), run_(run) {}

    /// Returns the most likely variogram; `plain`: without anisotropy, if that one has it.
    Variogram operator()(std::optional<Variogram>& plain) {
        Variogram none;
        none.model = options_.model.value_or(VariogramModel::spherical);
        none.range = std::max(likelihood_.extent(), std::numeric_limits<double>::min());
        if (likelihood_.trend_only()) return none;
        Likely best;
        const auto all = shapes(options_);
        const auto found = each(all.size(), [&](std::size_t i) { return best_range(all[i]); });
        for (std::size_t i = 0; i < all.size(); ++i) {
            const double margin = all[i].model == VariogramModel::gaussian && !options_.model
                                      ? constants.worth_gaussian
                                      : 0;
            if (found[i].likelihood > best.likelihood + margin) best = found[i];
        }
        const Likely straight = best;
        if (options_.anisotropy) turn(best);
        if (!(best.variogram.sill > 0)) return none;
        if (!options_.model) weigh(likelihood_, options_.most_nugget, best);
        if (best.variogram.ratio != 1) plain = straight.variogram;
        return best.variogram;
    }

private:
    /// Returns what `search` finds for each index, in several threads.
    template <class SearchOne>
    [[nodiscard]] std::vector<Likely> each(std::size_t count, const SearchOne& search) const {
        std::vector<Likely> found(count);
        if (run_.stop.stop_requested()) return found;
        if (run_.progress) run_.progress("variogram", 0);
        const auto one = [&](std::size_t i) { found[i] = search(i); };
        if (run_.threads <= 1)
            for (std::size_t i = 0; i < count; ++i) one(i);
        else
            with_threads(run_, [&] { for_each_index(count, one); });
        return found;
    }

    [[nodiscard]] Likely at(const Variogram& shape) const {
        if (run_.stop.stop_requested()) return {};
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
        const double low = std::log(
                         std::max(constants.least_range * likelihood_.extent(), least_range_)),
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
            attempt(std::max(middle - step, low));
            attempt(std::min(middle + step, high));
        }
        return best;
    }

    /// Tries anisotropy of the best shape with several ranges.
    void turn(Likely& best) const {
        std::vector<Variogram> plain;
        for (const double factor : constants.turned_ranges) {
            plain.push_back(best.variogram);
            plain.back().range *= factor;
            if (factor >= 1 || plain.back().range >= least_range_) continue;
            plain.pop_back();
            break;
        }
        Likely turned;
        for (const Likely& found :
             each(plain.size(), [&](std::size_t i) { return turned_as(plain[i]); }))
            if (found.likelihood > turned.likelihood) turned = found;
        if (turned.likelihood > best.likelihood + constants.worth_turned) best = turned;
    }

    /// Tries every second direction and ratio, then the neighbours of the best one. The ratio
    /// changes neither the area nor the shape near h = 0.
    [[nodiscard]] Likely turned_as(const Variogram& plain) const {
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
        return turned;
    }

    Likelihood likelihood_;
    double least_range_; ///< shorter ones can't be told from noise
    const VariogramFitOptions& options_;
    const Run& run_;
};

/// The data left out at a time: those nearer to a place of the border than the hole's radius.
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

BlockValidation validate(const DataAroundHole& around, const Variogram& variogram, unsigned degree,
                         const Run& run) {
    BlockValidation result;
    const auto data =
        selected(around.data, well_spread_in_plane(around.data, constants.most_block_data));
    const auto border = around.data.first(around.border);
    const auto centres = selected(border, well_spread_in_plane(border, constants.blocks));
    const System system(data, variogram, degree, run);
    if (!system.ready()) return result;
    const Eigen::MatrixXd projection = system.projection();
    // The weights have the covariance P if the nugget is right. Where it is the least one that is
    // tried, the data may have far less noise, and the errors other covariances.
    const double share = system.weights().squaredNorm() / projection.trace();
    if (share < constants.least_noise_share) result.noise_share = share;
    Eigen::MatrixXd told = projection; // covariance of the weights
    if (result.noise_share < 1)
        told -= ((1 - result.noise_share) * variogram.nugget) * (projection * projection);
    double squares = 0, ratios = 0;
    std::size_t count = 0;
    for (const auto& block : blocks_of(data, centres, around.radius)) {
        if (run.stop.stop_requested()) break;
        const Eigen::MatrixXd covariance =
            projection(block, block).inverse(); // of the errors, nugget included
        const Eigen::VectorXd errors = covariance * system.weights()(block);
        const double square = errors.squaredNorm();
        const double expected = result.noise_share < 1
                                    ? (covariance * told(block, block) * covariance).trace()
                                    : covariance.trace();
        if (!(expected > 0) || !std::isfinite(square)) continue;
        result.most = std::max(result.most, square / expected);
        squares += square;
        ratios += square / expected;
        count += block.size();
        ++result.blocks;
        for (std::size_t i = 0; i < block.size(); ++i) {
            const double height = data[static_cast<std::size_t>(block[i])].z;
            result.left_out.push_back({height, height - errors(static_cast<Eigen::Index>(i))});
        }
    }
    if (count == 0) return result;
    result.error = std::sqrt(squares / static_cast<double>(count));
    result.ratio = std::sqrt(ratios / static_cast<double>(result.blocks));
    return result;
}

/// Tells whether blocks are missed by less than a tenth of before, or else by little more than
/// their noise, and what is not noise has shrunk to a tenth of its square.
bool is_far_better(const BlockValidation& now, const BlockValidation& before, double noise) {
    if (now.error < constants.worth_degree * before.error) return true;
    const double left = now.error * now.error - noise, was = before.error * before.error - noise;
    // Noise alone explains neither what was missed before nor a difference below its own size.
    return was > noise && left < noise && left < constants.worth_degree * was;
}

/// Takes a trend of degree 2 if blocks are then missed by far less, as those of a paraboloid.
void raise_degree(const DataAroundHole& around, const FittedData& fitted, double most_nugget,
                  ModelChoice& choice, const Run& run) {
    if (!(choice.variogram.sill > 0) || choice.validation.blocks == 0) return;
    const Likelihood likelihood(fitted.points, higher_degree);
    Variogram variogram = choice.variogram;
    variogram.sill = variogram.nugget = 0;
    if (!likelihood.trend_only()) {
        Likely found = likelihood.at(choice.variogram, most_nugget);
        if (!(found.variogram.sill > 0)) return;
        weigh(likelihood, most_nugget, found);
        variogram = found.variogram;
    }
    const auto validation = validate(around, variogram, higher_degree, run);
    if (validation.blocks < choice.validation.blocks ||
        !is_far_better(validation, choice.validation, variogram.nugget))
        return;
    choice.degree = higher_degree;
    choice.variogram = variogram;
    choice.validation = validation;
}

/// Computes the factor of nugget and sill. Blocks overlap, so that many count as `most_counted`;
/// they are next to the hole, not in it: if they are missed by less than expected, the hole need not
/// be, unless all of them agree.
double calibration(const BlockValidation& validation) {
    const double n = std::min(static_cast<double>(validation.blocks), constants.most_counted);
    const double square = validation.ratio * validation.ratio;
    if (validation.blocks >= constants.least_shrinking && validation.most < constants.shrinking)
        return std::max(validation.most, constants.shrinking);
    return std::max(1.0, (n * square + constants.block_prior) / (n + constants.block_prior));
}

} // namespace

ModelChoice choose_model(const DataAroundHole& around, const VariogramFitOptions& options,
                         const Run& run) {
    ModelChoice choice;
    choice.degree = trend_degree;
    choice.determined = around.data.size() >= constants.least_data;
    VariogramFitOptions fit = options;
    fit.anisotropy = options.anisotropy && choice.determined;
    const FittedData fitted(around.data);
    choice.variogram = Search(fitted, fit, run)(choice.plain);
    choice.validation = validate(around, choice.variogram, choice.degree, run);
    if (choice.plain) {
        const auto plain = validate(around, *choice.plain, choice.degree, run);
        choice.doubt = constants.doubt * std::min(1.0, choice.validation.error / plain.error);
    }
    if (choice.determined) raise_degree(around, fitted, options.most_nugget, choice, run);
    const double factor = calibration(choice.validation);
    choice.variogram.sill *= factor;
    choice.variogram.nugget *= factor;
    return choice;
}

} // namespace terrane::kriging::detail
