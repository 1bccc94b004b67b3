// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/choice.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace terrane::kriging::detail {
namespace {

constexpr std::array all_models{VariogramModel::spherical, VariogramModel::exponential,
                                VariogramModel::power, VariogramModel::gaussian};

/// Selects the data that take part in validation, evenly spaced.
std::vector<Point3> thinned(std::span<const Point3> data) {
    const auto count = std::min(data.size(), constants.most_block_data);
    std::vector<Point3> result;
    for (std::size_t k = 0; k < count; ++k) result.push_back(data[k * data.size() / count]);
    return result;
}

/// The data and, for each of some patches, the data sorted by distance from its centre.
class Patches {
public:
    explicit Patches(std::span<const Point3> all) : data_(thinned(all)) {
        for (std::size_t b = 0; b < constants.blocks; ++b) {
            const Point3 middle = data_[(2 * b + 1) * data_.size() / (2 * constants.blocks)];
            const auto off = [&](const Point3& p) {
                return std::hypot(p.x - middle.x, p.y - middle.y);
            };
            auto& order = sorted_.emplace_back(data_);
            std::stable_sort(order.begin(), order.end(),
                             [&](const Point3& p, const Point3& q) { return off(p) < off(q); });
        }
    }

    [[nodiscard]] BlockValidation validate(const Variogram& variogram, unsigned degree) const {
        BlockValidation result;
        const auto left_out = std::max<std::size_t>(data_.size() / constants.block_part, 1);
        double errors = 0, expected = 0;
        for (const auto& order : sorted_) {
            const std::span<const Point3> all(order);
            const Kriging kriging(all.subspan(left_out), variogram, degree);
            for (std::size_t k = 0; k < left_out; ++k) {
                const Estimate e = kriging.at(order[k].x, order[k].y);
                errors += (e.value - order[k].z) * (e.value - order[k].z);
                expected += e.standard_deviation * e.standard_deviation + variogram.nugget;
                ++result.count;
            }
        }
        result.error = std::sqrt(errors / static_cast<double>(result.count));
        result.expected = std::sqrt(expected / static_cast<double>(result.count));
        return result;
    }

    [[nodiscard]] std::size_t size() const { return data_.size(); }

private:
    std::vector<Point3> data_;
    std::vector<std::vector<Point3>> sorted_; ///< per patch
};

/// Keeps the model with the least validated error.
class Chooser {
public:
    Chooser(std::span<const Point3> data, std::span<const std::array<std::uint32_t, 2>> close,
            double longest) :
        patches_(data) {
        for (unsigned degree = 1; degree <= 2; ++degree)
            bins_.push_back(experimental_variogram(residuals(data, degree), close, longest));
    }

    /// Tries one kind of model and keeps it if its error is sufficiently less than the best one's.
    void attempt(unsigned degree, const VariogramFitOptions& options) {
        double share = share_for(degree, options);
        Variogram variogram = fit_variogram(bins_[degree - 1], options);
        const bool smooth = variogram.model == VariogramModel::gaussian && options.most_nugget == 0;
        for (int stretched = 0; stretched < (smooth ? constants.stretches : 1); ++stretched) {
            const auto blocks = patches_.validate(variogram, degree);
            if (best_.blocks.count == 0 || blocks.error < share * best_.blocks.error) {
                best_ = {variogram, degree, blocks};
                options_ = options;
                share = 1;
            }
            variogram.range *= 2; // the same shape near h = 0
            variogram.sill *= 4;
        }
    }

    /// Tries the best model again with anisotropy.
    void attempt_anisotropy() {
        VariogramFitOptions options = options_;
        options.anisotropy = true;
        attempt(best_.degree, options);
    }

    [[nodiscard]] bool few() const { return patches_.size() < constants.least_data; }
    [[nodiscard]] const ModelChoice& best() const { return best_; }

private:
    [[nodiscard]] double share_for(unsigned degree, const VariogramFitOptions& options) const {
        double share = 1;
        if (options.most_nugget == 0 && best_.variogram.nugget > 0)
            share *= constants.worth_no_nugget;
        if (degree > best_.degree) share *= constants.worth_degree_2;
        if (options.model == VariogramModel::gaussian &&
            best_.variogram.model != VariogramModel::gaussian) {
            const double noise = constants.mostly_noise * best_.blocks.error * best_.blocks.error;
            share *= options.most_nugget > noise ? constants.worth_noisy_gaussian
                                                 : constants.worth_gaussian;
        }
        return share;
    }

    Patches patches_;
    std::vector<std::vector<VariogramBin>> bins_; ///< by degree - 1
    ModelChoice best_;
    VariogramFitOptions options_;
};

} // namespace

ModelChoice choose_model(std::span<const Point3> data,
                         std::span<const std::array<std::uint32_t, 2>> close, double longest,
                         double noise, const VariogramFitOptions& options) {
    Chooser chooser(data, close, longest);
    VariogramFitOptions fit = options;
    fit.anisotropy = false;
    const unsigned highest = chooser.few() ? 1 : 2;
    for (const auto model : all_models) {
        if (options.model && *options.model != model) continue;
        fit.model = model;
        for (const bool noisy : {true, false})
            for (unsigned degree = 1; degree <= highest; ++degree) {
                fit.most_nugget = noisy ? std::min(noise, options.most_nugget) : 0;
                chooser.attempt(degree, fit);
            }
    }
    if (options.anisotropy && !chooser.few()) chooser.attempt_anisotropy();
    ModelChoice best = chooser.best();
    if (best.blocks.expected > 0 && best.blocks.error > 0) {
        const double factor = best.blocks.error / best.blocks.expected;
        best.variogram.sill *= factor * factor;
        best.variogram.nugget *= factor * factor;
    }
    return best;
}

} // namespace terrane::kriging::detail
