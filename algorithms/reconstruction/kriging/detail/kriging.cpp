// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/kriging.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_set>

#include <Eigen/Dense>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/flat_cloud.hpp>

namespace terrane::kriging::detail {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Least-squares polynomial in x and y, which are shifted and scaled to [-1, 1].
class Trend {
public:
    Trend(std::span<const Point3> data, unsigned degree) : degree_(degree) {
        for (const Point3& p : data) {
            x0_ += p.x / static_cast<double>(data.size());
            y0_ += p.y / static_cast<double>(data.size());
        }
        for (const Point3& p : data)
            scale_ = std::max({scale_, std::abs(p.x - x0_), std::abs(p.y - y0_)});
        if (!(scale_ > 0)) scale_ = 1;
        MatrixXd terms(data.size(), terms_at(0, 0).size());
        VectorXd z(data.size());
        for (Eigen::Index i = 0; i < z.size(); ++i) {
            const Point3& p = data[static_cast<std::size_t>(i)];
            terms.row(i) = terms_at(p.x, p.y);
            z[i] = p.z;
        }
        factors_ = terms.colPivHouseholderQr().solve(z);
    }

    [[nodiscard]] double at(double x, double y) const { return terms_at(x, y).dot(factors_); }

private:
    [[nodiscard]] VectorXd terms_at(double x, double y) const {
        const double u = (x - x0_) / scale_, v = (y - y0_) / scale_;
        VectorXd terms(degree_ == 0 ? 1 : degree_ == 1 ? 3 : 6);
        terms[0] = 1;
        if (degree_ >= 1) terms.segment<2>(1) << u, v;
        if (degree_ >= 2) terms.segment<3>(3) << u * u, u * v, v * v;
        return terms;
    }

    unsigned degree_;
    double x0_ = 0, y0_ = 0, scale_ = 0;
    VectorXd factors_;
};

/// A search tree over some of the data, with x and y transformed so that distances are those of the
/// variogram.
class Level {
public:
    Level(FlatCloud cloud, std::vector<std::uint32_t> numbers) :
        cloud_(std::move(cloud)), numbers_(std::move(numbers)),
        tree_(2, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(8)) {
        tree_.buildIndex();
    }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

    /// Returns the indices of the nearest data, by ascending distance.
    [[nodiscard]] std::vector<std::uint32_t> nearest(const std::array<double, 2>& p,
                                                     std::size_t count) const {
        count = std::min(count, numbers_.size());
        std::vector<std::size_t> found(count);
        std::vector<double> squares(count);
        nanoflann::KNNResultSet<double> result(count);
        result.init(found.data(), squares.data());
        tree_.findNeighbors(result, p.data(), nanoflann::SearchParams());
        std::vector<std::uint32_t> numbers(result.size());
        for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = numbers_[found[i]];
        return numbers;
    }

    [[nodiscard]] std::size_t size() const { return numbers_.size(); }

private:
    FlatCloud cloud_;
    std::vector<std::uint32_t> numbers_;
    FlatTree tree_;
};

/// The system of ordinary kriging for some data, in terms of covariances.
class System {
public:
    System(std::span<const Point3> data, std::vector<std::uint32_t> numbers,
           const Variogram& model) :
        data_(data),
        numbers_(std::move(numbers)), model_(model) {
        const auto n = static_cast<Eigen::Index>(numbers_.size());
        z_.resize(n);
        double farthest = 0;
        MatrixXd gamma(n, n);
        for (Eigen::Index i = 0; i < n; ++i) {
            z_[i] = datum(i).z;
            gamma(i, i) = 0;
            for (Eigen::Index j = 0; j < i; ++j) {
                const double h = model_.distance(datum(i).x - datum(j).x, datum(i).y - datum(j).y);
                gamma(i, j) = gamma(j, i) = smooth(h);
                farthest = std::max(farthest, gamma(i, j));
            }
        }
        // Weights do not depend on the constant; this one makes the matrix positive definite.
        const bool bounded = model_.model != VariogramModel::power;
        constant_ = bounded ? model_.sill : 2 * farthest;
        const double scale = constant_ > 0 ? constant_ : 1;
        for (double addition = constants.least_addition;; addition *= constants.addition_growth) {
            MatrixXd covariance = (constant_ - gamma.array()).matrix();
            covariance.diagonal().array() += model_.nugget + addition * scale;
            factor_.compute(covariance);
            if (factor_.info() == Eigen::Success || addition >= constants.most_addition) break;
            if (!bounded) constant_ *= 2;
        }
        solved_ones_ = factor_.solve(VectorXd::Ones(n));
        ones_ = solved_ones_.sum();
        mean_ = solved_ones_.dot(z_) / ones_;
        dual_ = factor_.solve((z_.array() - mean_).matrix());
    }

    [[nodiscard]] double value(double x, double y) const {
        return mean_ + covariances(x, y).dot(dual_);
    }

    [[nodiscard]] double standard_deviation(double x, double y) const {
        const VectorXd c = covariances(x, y);
        const VectorXd half = factor_.matrixL().solve(c);
        const double off = 1 - solved_ones_.dot(c);
        const double variance = constant_ - half.squaredNorm() + off * off / ones_;
        return std::sqrt(std::max(variance, 0.0));
    }

private:
    [[nodiscard]] const Point3& datum(Eigen::Index i) const {
        return data_[numbers_[static_cast<std::size_t>(i)]];
    }
    /// Evaluates the variogram without the nugget, which is noise of the data and not of the
    /// surface.
    [[nodiscard]] double smooth(double h) const { return h > 0 ? model_.at(h) - model_.nugget : 0; }

    [[nodiscard]] VectorXd covariances(double x, double y) const {
        VectorXd c(z_.size());
        for (Eigen::Index i = 0; i < c.size(); ++i)
            c[i] = constant_ - smooth(model_.distance(datum(i).x - x, datum(i).y - y));
        return c;
    }

    std::span<const Point3> data_;
    std::vector<std::uint32_t> numbers_;
    Variogram model_;
    double constant_ = 0, ones_ = 0, mean_ = 0;
    VectorXd z_, solved_ones_, dual_;
    Eigen::LLT<MatrixXd> factor_;
};

} // namespace

struct Kriging::State {
    State(std::span<const Point3> points, const Variogram& v, unsigned degree) :
        trend(points, degree), variogram(v) {
        data.assign(points.begin(), points.end());
        for (Point3& p : data) p.z -= trend.at(p.x, p.y);
        const double angle = v.angle * std::numbers::pi / 180;
        cosine = std::cos(angle);
        sine = std::sin(angle);
        build_levels();
        if (data.size() <= most_at_once) {
            std::vector<std::uint32_t> all(data.size());
            std::iota(all.begin(), all.end(), 0U);
            system = std::make_unique<System>(data, std::move(all), variogram);
        }
    }

    /// Transforms a place so that distances are those of the variogram.
    [[nodiscard]] std::array<double, 2> place(double x, double y) const {
        return {cosine * x + sine * y, (cosine * y - sine * x) / variogram.ratio};
    }

    /// Builds levels of thinned data: one datum per cell; cells double in size until few data
    /// remain.
    void build_levels() {
        FlatCloud all;
        std::vector<std::uint32_t> numbers(data.size());
        std::array<double, 2> low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
        for (std::uint32_t i = 0; i < data.size(); ++i) {
            numbers[i] = i;
            all.points.push_back(place(data[i].x, data[i].y));
            for (unsigned k = 0; k < 2; ++k) {
                low[k] = std::min(low[k], all.points[i][k]);
                high[k] = std::max(high[k], all.points[i][k]);
            }
        }
        const double area = std::max((high[0] - low[0]) * (high[1] - low[1]), 0.0);
        spacing = std::sqrt(area / static_cast<double>(data.size()));
        levels.push_back(std::make_unique<Level>(all, numbers));
        if (!(spacing > 0)) return;
        for (double cell = constants.first_spacing * spacing;
             levels.back()->size() > constants.least_level * neighbours; cell *= 2) {
            FlatCloud kept;
            std::vector<std::uint32_t> kept_numbers;
            std::unordered_set<std::uint64_t> taken;
            for (std::uint32_t i = 0; i < data.size(); ++i) {
                const auto column = static_cast<std::uint64_t>((all.points[i][0] - low[0]) / cell);
                const auto row = static_cast<std::uint64_t>((all.points[i][1] - low[1]) / cell);
                if (!taken.insert(column << 32U | row).second) continue;
                kept.points.push_back(all.points[i]);
                kept_numbers.push_back(i);
            }
            levels.push_back(std::make_unique<Level>(std::move(kept), std::move(kept_numbers)));
        }
    }

    /// Returns the nearest data of the level whose thinning suits the distance from the nearest
    /// datum.
    [[nodiscard]] std::vector<std::uint32_t> near(double x, double y, std::size_t count) const {
        const auto p = place(x, y);
        const auto closest = levels[0]->nearest(p, 1).at(0);
        const double distance = variogram.distance(data[closest].x - x, data[closest].y - y);
        std::size_t level = 0;
        for (double cell = constants.first_spacing * spacing;
             level + 1 < levels.size() && cell <= constants.spacing_per_distance * distance;
             cell *= 2)
            ++level;
        return levels[level]->nearest(p, count);
    }

    Trend trend;
    Variogram variogram;
    std::vector<Point3> data; ///< residuals
    double cosine = 1, sine = 0;
    double spacing = 0; ///< of the data
    std::vector<std::unique_ptr<Level>> levels;
    std::unique_ptr<System> system; ///< of all data, if they are few enough
};

Kriging::Kriging(std::span<const Point3> data, const Variogram& variogram, unsigned degree) :
    state_(std::make_unique<State>(data, variogram, degree)) {}

Kriging::Kriging(Kriging&&) noexcept = default;
Kriging::~Kriging() = default;

std::vector<Point3> residuals(std::span<const Point3> data, unsigned degree) {
    const Trend trend(data, degree);
    std::vector<Point3> result(data.begin(), data.end());
    for (Point3& p : result) p.z -= trend.at(p.x, p.y);
    return result;
}

Estimate Kriging::at(double x, double y) const {
    const State& s = *state_;
    const double trend = s.trend.at(x, y);
    if (s.system) return {trend + s.system->value(x, y), s.system->standard_deviation(x, y)};
    const System local(s.data, s.near(x, y, neighbours), s.variogram);
    return {trend + local.value(x, y), local.standard_deviation(x, y)};
}

std::vector<Estimate> Kriging::at(std::span<const Point3> places, const Run& run) const {
    const State& s = *state_;
    const double n = static_cast<double>(s.data.size());
    const bool quick =
        s.system && n * n * static_cast<double>(places.size()) > constants.most_operations;
    std::vector<Estimate> result(places.size());
    const auto one = [&](std::size_t i) {
        const Point3& p = places[i];
        if (!quick) return at(p.x, p.y);
        const System local(s.data, s.near(p.x, p.y, neighbours), s.variogram);
        return Estimate{s.trend.at(p.x, p.y) + s.system->value(p.x, p.y),
                        local.standard_deviation(p.x, p.y)};
    };
    constexpr std::size_t block = 4096; // places between checks of the stop token
    for (std::size_t first = 0; first < places.size(); first += block) {
        if (run.stop.stop_requested()) break;
        if (run.progress)
            run.progress("kriging",
                         static_cast<double>(first) / static_cast<double>(places.size()));
        const auto count = std::min(block, places.size() - first);
        const auto some = [&](const tbb::blocked_range<std::size_t>& range) {
            for (auto i = range.begin(); i != range.end(); ++i) result[i] = one(i);
        };
        with_threads(run,
                     [&] { tbb::parallel_for(tbb::blocked_range(first, first + count), some); });
    }
    return result;
}

Kriging::Validation Kriging::validate(std::size_t most) const {
    const State& s = *state_;
    Validation result;
    const auto count = std::min(most, s.data.size());
    double errors = 0, expected = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const auto i = static_cast<std::uint32_t>(k * s.data.size() / count);
        const Point3& p = s.data[i];
        auto others = s.levels[0]->nearest(s.place(p.x, p.y), neighbours + 1);
        std::erase_if(others, [&](std::uint32_t j) { return j == i; });
        if (others.empty()) continue;
        const System local(s.data, others, s.variogram);
        const double missed = local.value(p.x, p.y) - p.z,
                     deviation = local.standard_deviation(p.x, p.y);
        errors += missed * missed;
        expected += deviation * deviation + s.variogram.nugget;
        ++result.count;
    }
    const auto n = static_cast<double>(std::max<std::size_t>(result.count, 1));
    result.error = std::sqrt(errors / n);
    result.expected = std::sqrt(expected / n);
    return result;
}

} // namespace terrane::kriging::detail
