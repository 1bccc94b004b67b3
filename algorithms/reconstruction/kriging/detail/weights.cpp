// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/weights.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/system.hpp>
#include <terrane/algorithms/reconstruction/kriging/well_spread.hpp>

namespace terrane::kriging::detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Returns how many of these blocks count as independent of each other.
double independent(double blocks) {
    return std::min(blocks, static_cast<double>(constants.blocks) / 2);
}

/// Lists the shapes that are wanted, without ranges.
std::vector<Variogram> shapes(const KrigingOptions& options) {
    using enum VariogramModel;
    const auto shape = [](VariogramModel model, double exponent = 1) {
        Variogram v;
        v.model = model;
        v.exponent = exponent;
        return v;
    };
    std::vector<Variogram> all{shape(power),       shape(thin_plate),  shape(cubic),
                               shape(exponential), shape(matern, 1.5), shape(matern, 2.5),
                               shape(gaussian)};
    if (!options.model) return all;
    if (*options.model == spherical) return {shape(spherical)};
    std::erase_if(all, [&](const Variogram& v) { return v.model != *options.model; });
    return all;
}

/// Chooses data for likelihoods: pairs near the hole, which tell noise from roughness, and some
/// farther away, which contradict models that hold near the hole alone.
SpreadPairs fitted(const DataAroundHole& around) {
    auto all = well_spread_pairs(around.data.first(around.near), constants.most_fitted,
                                 constants.most_fitted / 2);
    const auto far = around.data.subspan(around.near);
    for (const auto i : well_spread_in_plane(far, constants.most_fitted / 4))
        all.chosen.push_back(static_cast<std::uint32_t>(around.near) + i);
    return all;
}

/// Computes the likelihood of models.
class Search {
public:
    Search(std::span<const Point3> data, const SpreadPairs& fitted, const KrigingOptions& options,
           const Run& run) :
        options_(options),
        run_(run), likelihood_(selected(data, fitted.chosen)),
        least_range_(fitted.gap > 0 ? constants.gaps_per_range * fitted.gap
                                    : likelihood_.extent()) {}

    /// Returns the likeliest model of each shape, of the two likeliest with anisotropy, and of noise;
    /// the likeliest first. Returns only the trend of least degree that is the data.
    std::vector<Likely> operator()() const {
        auto noise = likelihood_.of_noise();
        if (noise[0].likelihood == HUGE_VAL) return noise;
        std::vector<Likely> found;
        for (const Variogram& shape : shapes(options_)) found.push_back(likeliest(ranged(shape)));
        climb(found);
        sort(found);
        const auto plain = found.size();
        for (std::size_t i = 0; options_.anisotropy && i < std::min<std::size_t>(2, plain); ++i)
            for (const Likely& likely : turned(found[i])) found.push_back(likely);
        found.push_back(*std::max_element(noise.begin(), noise.end(), less_likely));
        sort(found);
        std::erase_if(found, [](const Likely& l) { return l.likelihood == -HUGE_VAL; });
        return found;
    }

private:
    static bool less_likely(const Likely& a, const Likely& b) {
        return a.likelihood < b.likelihood;
    }

    static void sort(std::vector<Likely>& models) {
        std::stable_sort(models.begin(), models.end(),
                         [](const Likely& a, const Likely& b) { return less_likely(b, a); });
    }

    /// Finds trend, nugget and sill of each shape.
    [[nodiscard]] std::vector<Likely> of(std::span<const Variogram> all) const {
        std::vector<Likely> found(all.size());
        if (run_.stop.stop_requested()) return found;
        if (run_.progress) run_.progress("variogram", 0);
        const auto one = [&](std::size_t i) {
            if (run_.stop.stop_requested()) return;
            for (const Likely& likely : likelihood_.at(all[i]))
                if (less_likely(found[i], likely)) found[i] = likely;
        };
        with_threads(run_, [&] { for_each_index(all.size(), one); });
        return found;
    }

    [[nodiscard]] Likely likeliest(std::span<const Variogram> all) const {
        const auto found = of(all);
        return *std::max_element(found.begin(), found.end(), less_likely);
    }

    /// Gives a shape ranges up to the extent at equal ratios, at most e.
    [[nodiscard]] std::vector<Variogram> ranged(Variogram shape) const {
        using enum VariogramModel;
        const double extent = std::max(likelihood_.extent(), 1e-300);
        shape.range = extent;
        if (shape.model == power || shape.model == thin_plate || shape.model == cubic)
            return {shape}; // a mere unit
        const double least = std::numeric_limits<double>::epsilon() * extent;
        const double low = std::log(std::clamp(least_range_, least, extent));
        const double high = std::log(extent);
        const double steps = std::ceil(high - low);
        std::vector<Variogram> all;
        for (double k = 0; k <= steps; ++k) {
            shape.range = std::exp(low + (high - low) * k / std::max(1.0, steps));
            all.push_back(shape);
        }
        return all;
    }

    /// Climbs to the likeliest range of each model. A smooth field without noise is likely only near
    /// its very range; other likelihoods hardly depend on it.
    void climb(std::vector<Likely>& models) const {
        std::vector<Likely*> open;
        for (Likely& m : models)
            if (m.variogram.sill > 0 && ranged(m.variogram).size() > 1) open.push_back(&m);
        for (const double part : {2, 4, 8, 16, 32, 64}) {
            std::vector<Variogram> beside;
            for (const Likely* m : open) {
                const auto all = ranged(m->variogram);
                const double ratio = std::pow(all[1].range / all[0].range, 1 / part);
                beside.insert(beside.end(), 2, m->variogram);
                beside.end()[-2].range *= ratio;
                beside.back().range = std::max(all[0].range, beside.back().range / ratio);
            }
            const auto found = of(beside);
            std::vector<Likely*> still;
            for (std::size_t i = 0; i < open.size(); ++i) {
                const auto [low, high] = std::minmax(found[2 * i], found[2 * i + 1], less_likely);
                const double now = open[i]->likelihood;
                if (now - low.likelihood > 1 || high.likelihood - now > 1) still.push_back(open[i]);
                if (high.likelihood > now) *open[i] = high;
            }
            open = std::move(still);
        }
    }

    /// Gives a model anisotropy, which changes neither the area nor the shape near h = 0. All
    /// directions together count as one model. The two likeliest take part: the longest range may
    /// be between them.
    [[nodiscard]] std::vector<Likely> turned(const Likely& plain) const {
        constexpr int directions = 6, taken = 2;
        if (!(plain.variogram.sill > 0)) return {};
        std::vector<Variogram> all(directions, plain.variogram);
        for (int d = 0; d < directions; ++d) {
            Variogram& v = all[static_cast<std::size_t>(d)];
            v.angle = 180.0 * d / directions;
            v.ratio = constants.turned_ratio;
            v.range /= std::sqrt(v.ratio);
        }
        auto found = of(all);
        for (Likely& likely : found) likely.likelihood -= std::log(directions);
        sort(found);
        return {found.begin(), found.begin() + taken};
    }

    const KrigingOptions& options_;
    const Run& run_;
    Likelihood likelihood_;
    double least_range_ = 0;
};

/// Data that are left out at a time, as indices.
struct LeftOut {
    std::vector<std::vector<Index>> blocks; ///< as wide as the hole, round places of its border
    std::vector<std::vector<Index>> rims;   ///< all round the hole, as if it were wider

    void add(std::vector<std::vector<Index>>& to, std::vector<Index> some, std::size_t all) const {
        if (!some.empty() && 2 * some.size() <= all) to.push_back(std::move(some));
    }
};

LeftOut left_out_of(std::span<const Point3> data, const DataAroundHole& around) {
    LeftOut left;
    const auto border = around.data.first(around.border);
    const auto distance = [](const Point3& p, const Point3& q) {
        return std::hypot(p.x - q.x, p.y - q.y);
    };
    for (const auto b : well_spread_in_plane(border, constants.blocks)) {
        std::vector<Index> block;
        for (std::size_t i = 0; i < data.size(); ++i)
            if (distance(data[i], border[b]) <= around.radius)
                block.push_back(static_cast<Index>(i));
        left.add(left.blocks, std::move(block), data.size());
    }
    std::vector<double> nearest;
    for (const Point3& p : data) {
        nearest.push_back(HUGE_VAL);
        for (const Point3& q : border) nearest.back() = std::min(nearest.back(), distance(p, q));
    }
    for (const double part : {1, 2, 4}) {
        std::vector<Index> rim;
        for (std::size_t i = 0; i < data.size(); ++i)
            if (nearest[i] <= constants.rim / part * around.radius)
                rim.push_back(static_cast<Index>(i));
        left.add(left.rims, std::move(rim), data.size());
    }
    return left;
}

/// By how much a model misses the data of a block, and the variances that it expects, with noise.
struct Missed {
    VectorXd errors, variances;
};

/// A model and what it says of data left out.
struct Judged {
    WeighedModel model;
    std::vector<Missed> blocks{}, rims{};
    double logarithm = -HUGE_VAL; ///< of the weight
};

/// Finds by how much a system misses data that are left out; none if that can't be told.
std::vector<Missed> missed_by(const System& system, const MatrixXd& projection,
                              std::span<const std::vector<Index>> all) {
    std::vector<Missed> result;
    for (const auto& some : all) {
        MatrixXd factor = projection(some, some);
        if (!cholesky(factor, {})) return {};
        const MatrixXd inverse = inverse_of_factor(factor);
        const VectorXd half = inverse * system.weights()(some);
        result.push_back({inverse.transpose() * half,
                          inverse.colwise().squaredNorm().transpose().cwiseMax(1e-300)});
    }
    return result;
}

Judged judged(const Likely& likely, std::span<const Point3> data, const LeftOut& left,
              const Run& run) {
    Judged result{
        {likely.variogram, likely.degree, 0}, {}, {}, likely.likelihood / constants.temper};
    if (left.blocks.empty() && left.rims.empty()) return result;
    const System system(data, likely.variogram, likely.degree, run);
    if (!system.ready()) return {result.model};
    const MatrixXd projection = system.projection();
    result.blocks = missed_by(system, projection, left.blocks);
    result.rims = missed_by(system, projection, left.rims);
    double sum = 0;
    for (const auto& [errors, variances] : result.blocks)
        sum -= (variances.array().log() + errors.array().square() / variances.array()).mean() / 2;
    const auto count = static_cast<double>(std::max<std::size_t>(1, left.blocks.size()));
    result.logarithm += independent(count) / count * sum;
    if (!std::isfinite(result.logarithm)) return {result.model};
    return result;
}

/// Turns logarithms into weights, and drops models that have no say.
void weigh(std::vector<Judged>& all) {
    std::stable_sort(all.begin(), all.end(),
                     [](const Judged& a, const Judged& b) { return a.logarithm > b.logarithm; });
    const double best = all[0].logarithm;
    double sum = 0, kept = 0;
    for (Judged& j : all)
        sum += j.model.weight = std::isfinite(best) ? std::exp(j.logarithm - best) : 1;
    for (Judged& j : all) {
        const bool counts = j.model.weight >= std::min(1.0, constants.least_weight * sum);
        kept += j.model.weight *= counts ? 1 : 0;
    }
    for (Judged& j : all) j.model.weight /= kept;
    std::erase_if(all, [](const Judged& j) { return j.model.weight == 0; });
}

/// Finds by how much the average misses data that are left out.
Missed averaged(std::span<const Judged> all, std::vector<Missed> Judged::*kind, std::size_t k) {
    const Index size = (all[0].*kind)[k].errors.size();
    Missed missed{VectorXd::Zero(size), VectorXd::Zero(size)};
    for (const Judged& j : all) missed.errors += j.model.weight * (j.*kind)[k].errors;
    for (const Judged& j : all) {
        const auto& [errors, variances] = (j.*kind)[k];
        missed.variances += j.model.weight * variances;
        missed.variances.array() += j.model.weight * (errors - missed.errors).array().square();
    }
    return missed;
}

double square_ratio(const Missed& missed) {
    return missed.errors.squaredNorm() / missed.variances.sum();
}

/// Compares what is missed with what is expected.
void calibrate(std::span<const Judged> all, std::span<const Point3> data, const LeftOut& left,
               ModelAverage& average) {
    double ratios = 0, squares = 0, count = 0;
    for (std::size_t b = 0; b < left.blocks.size(); ++b) {
        const Missed missed = averaged(all, &Judged::blocks, b);
        ratios += square_ratio(missed);
        squares += missed.errors.squaredNorm();
        count += static_cast<double>(missed.errors.size());
        for (std::size_t i = 0; i < left.blocks[b].size(); ++i) {
            const double z = data[static_cast<std::size_t>(left.blocks[b][i])].z;
            average.left_out.push_back({z, z - missed.errors[static_cast<Index>(i)]});
        }
    }
    const auto n = static_cast<double>(left.blocks.size());
    const auto trusted = [](double ratio, double blocks) {
        const double counted = independent(blocks);
        return (counted * ratio + constants.block_prior) / (counted + constants.block_prior);
    };
    double square = 0, worst = 0;
    average.blocks = left.blocks.size();
    if (average.blocks > 0) {
        average.error = std::sqrt(squares / count);
        average.ratio = std::sqrt(ratios / n);
        square = trusted(ratios / n, n);
    }
    for (std::size_t r = 0; r < left.rims.size(); ++r)
        worst = std::max(worst, square_ratio(averaged(all, &Judged::rims, r)));
    // What grows by a ratio from outside to the border may do so again to the middle of the hole.
    if (!left.rims.empty()) {
        average.rim_ratio = std::sqrt(worst);
        square = std::max(square, std::pow(trusted(worst, HUGE_VAL), 2));
    }
    if (square > 0) average.factor = std::sqrt(square);
}

} // namespace

std::vector<Point3> selected(std::span<const Point3> data, std::span<const std::uint32_t> chosen) {
    std::vector<Point3> result;
    for (const auto i : chosen) result.push_back(data[i]);
    return result;
}

std::string description(const WeighedModel& model) {
    const auto trend = fmt::format("trend of degree {}, ", model.degree);
    const Variogram& v = model.variogram;
    return trend +
           (v.sill > 0 ? description(v) : fmt::format("noise {}", figure(std::sqrt(v.nugget), 4)));
}

ModelAverage weigh_models(const DataAroundHole& around, const KrigingOptions& options,
                          const Run& run) {
    ModelAverage average;
    if (around.data.size() < constants.least_data) average.unknown = "too few data";
    if (std::ranges::all_of(around.data, [](const Point3& p) { return p.z == 0; }))
        average.unknown = "all heights are 0, which has no unit";
    auto likely = Search(around.data, fitted(around), options, run)();
    if (options.noise)
        for (Likely& l : likely) l.variogram.nugget = *options.noise * *options.noise;
    const auto near = around.data.first(around.near);
    const auto data = selected(near, well_spread_in_plane(near, constants.few_data));
    const auto left = left_out_of(data, around);
    std::vector<Judged> all(likely.size());
    const auto one = [&](std::size_t i) { all[i] = judged(likely[i], data, left, run); };
    with_threads(run, [&] { for_each_index(all.size(), one); });
    if (run.stop.stop_requested()) return average;
    const auto is_complete = [&](const Judged& j) {
        return j.blocks.size() == left.blocks.size() && j.rims.size() == left.rims.size();
    };
    std::erase_if(all, [&](const Judged& j) { return !is_complete(j); });
    if (all.empty()) all.push_back({{likely[0].variogram, likely[0].degree, 0}});
    weigh(all);
    if (is_complete(all[0])) calibrate(all, data, left, average);
    for (const Judged& j : all) average.models.push_back(j.model);
    return average;
}

} // namespace terrane::kriging::detail
