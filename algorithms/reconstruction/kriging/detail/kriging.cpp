// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/kriging.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_set>

#include <Eigen/Dense>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/choice.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/flat_cloud.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/system.hpp>

namespace terrane::kriging::detail {
namespace {

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

/// Subtracts the least-squares trend.
class Trend {
public:
    Trend(std::span<const Point3> data, unsigned degree) : terms_(data, degree) {
        const Eigen::MatrixXd matrix = terms_.matrix(data);
        Eigen::VectorXd z(matrix.rows());
        for (Eigen::Index i = 0; i < z.size(); ++i) z[i] = data[static_cast<std::size_t>(i)].z;
        factors_ = matrix.householderQr().solve(z);
    }
    [[nodiscard]] double at(double x, double y) const { return terms_.at(x, y).dot(factors_); }

private:
    TrendTerms terms_;
    Eigen::VectorXd factors_;
};

std::vector<Point3> sorted(std::span<const Point3> data) {
    std::vector<Point3> result(data.begin(), data.end());
    std::sort(result.begin(), result.end());
    return result;
}

} // namespace

struct Kriging::State {
    State(std::span<const Point3> points, const Variogram& v, unsigned degree, const Run& run,
          double share) :
        data(sorted(points)),
        trend(data, degree), trend_degree(degree), variogram(v), noise_share(share) {
        for (Point3& p : data) p.z -= trend.at(p.x, p.y);
        const double angle = v.angle * std::numbers::pi / 180;
        cosine = std::cos(angle);
        sine = std::sin(angle);
        build_levels(run.stop);
        if (run.stop.stop_requested()) return; // the caller looks for stop requests, too
        if (data.size() > most_at_once) return;
        auto all = std::make_unique<System>(data, variogram, degree, run);
        if (all->ready()) system = std::move(all);
    }

    /// Transforms a place so that distances are those of the variogram.
    [[nodiscard]] std::array<double, 2> place(double x, double y) const {
        return {cosine * x + sine * y, (cosine * y - sine * x) / variogram.ratio};
    }

    /// Builds levels of thinned data: one datum per cell; cells double in size until few data
    /// remain.
    void build_levels(const std::stop_token& stop) {
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
             levels.back()->size() > constants.least_level * neighbours && !stop.stop_requested();
             cell *= 2) {
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

    /// Estimates a place from its neighbours, without the trend.
    [[nodiscard]] Estimate locally(const Point3& p) const {
        std::vector<Point3> some;
        for (const auto i : near(p.x, p.y, neighbours)) some.push_back(data[i]);
        const System local(some, variogram, 0);
        if (!local.ready()) return {};
        return {local.value(p.x, p.y), local.standard_deviations(std::span(&p, 1))[0]};
    }

    /// Estimates places.
    [[nodiscard]] std::vector<Estimate> at(std::span<const Point3> places,
                                           const System* deviations) const {
        std::vector<Estimate> result;
        const auto together = deviations ? deviations->standard_deviations(places, noise_share)
                                         : std::vector<double>{};
        for (std::size_t i = 0; i < places.size(); ++i) {
            const Point3& p = places[i];
            Estimate e;
            if (system) e.value = system->value(p.x, p.y);
            if (!system || deviations != system.get()) {
                const Estimate local = locally(p);
                if (!system) e.value = local.value;
                e.standard_deviation = local.standard_deviation;
            }
            if (deviations)
                e.standard_deviation = deviations == system.get()
                                           ? together[i]
                                           : std::min(together[i], e.standard_deviation);
            e.value += trend.at(p.x, p.y);
            result.push_back(e);
        }
        return result;
    }

    std::vector<Point3> data; ///< residuals, by ascending place
    Trend trend;
    unsigned trend_degree;
    Variogram variogram;
    double noise_share;
    double cosine = 1, sine = 0;
    double spacing = 0; ///< of the data
    std::vector<std::unique_ptr<Level>> levels;
    std::unique_ptr<System> system; ///< of all data, if they are few enough
};

Kriging::Kriging(std::span<const Point3> data, const Variogram& variogram, unsigned degree,
                 const Run& run, double noise_share) :
    state_(std::make_unique<State>(data, variogram, degree, run, noise_share)) {}

Kriging::Kriging(Kriging&&) noexcept = default;
Kriging::~Kriging() = default;

Estimate Kriging::at(double x, double y) const {
    const Point3 p{x, y, 0};
    return state_->at(std::span(&p, 1), state_->system.get()).front();
}

std::vector<Estimate> Kriging::at(std::span<const Point3> places, const Run& run) const {
    const State& s = *state_;
    const double n = static_cast<double>(s.data.size());
    std::unique_ptr<System> thinned;
    const System* deviations = s.system.get();
    if (s.system && n * n * static_cast<double>(places.size()) > constants.most_operations &&
        s.data.size() > constants.most_deviations) {
        std::vector<Point3> some;
        for (const auto i : well_spread_in_plane(s.data, constants.most_deviations))
            some.push_back(s.data[i]);
        thinned = std::make_unique<System>(some, s.variogram, s.trend_degree, run);
        if (thinned->ready()) deviations = thinned.get();
    }
    std::vector<Estimate> result(places.size());
    constexpr std::size_t grain = 64;
    // Between checks of the stop token, less than a second passes.
    const auto at_most = static_cast<std::size_t>(constants.operations_per_check / (n * n));
    const std::size_t block = std::clamp<std::size_t>(at_most, grain, 64 * grain);
    for (std::size_t first = 0; first < places.size(); first += block) {
        if (run.stop.stop_requested()) break;
        if (run.progress)
            run.progress("kriging",
                         static_cast<double>(first) / static_cast<double>(places.size()));
        const auto count = std::min(block, places.size() - first);
        const auto some = [&](std::size_t part) {
            const auto start = first + part * grain, end = std::min(start + grain, first + count);
            const auto estimates = s.at(places.subspan(start, end - start), deviations);
            std::copy(estimates.begin(), estimates.end(),
                      result.begin() + static_cast<std::ptrdiff_t>(start));
        };
        with_threads(run, [&] { for_each_index((count + grain - 1) / grain, some); });
    }
    return result;
}

std::vector<double> Kriging::values(std::span<const Point3> places, const Run& run) const {
    const State& s = *state_;
    std::vector<double> result(places.size(), 0);
    for (std::size_t i = 0; i < places.size() && s.system && !run.stop.stop_requested(); ++i) {
        const Point3& p = places[i];
        result[i] = s.system->value(p.x, p.y) + s.trend.at(p.x, p.y);
    }
    return result;
}

} // namespace terrane::kriging::detail
