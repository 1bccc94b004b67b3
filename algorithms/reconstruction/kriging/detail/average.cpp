// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/average.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/flat_cloud.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/system.hpp>
#include <terrane/algorithms/reconstruction/kriging/well_spread.hpp>

namespace terrane::kriging::detail {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// What estimates leave of data on borders that take no part in them: added next to the border, so
/// that the filling has no step there.
class BorderRest {
public:
    BorderRest() = default;
    /// `rest`: data with what was left of them as z; `share`: of it that is no noise; `reach`: where
    /// it has faded.
    BorderRest(std::vector<Point3> rest, double share, double reach) :
        rest_(std::move(rest)), share_(share), reach_(reach) {
        for (const Point3& p : rest_) cloud_.points.push_back({p.x, p.y});
        tree_ = std::make_unique<FlatTree>(2, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(8));
        tree_->buildIndex();
    }
    BorderRest(const BorderRest&) = delete;
    BorderRest& operator=(const BorderRest&) = delete;

    [[nodiscard]] double at(const Point3& p) const {
        constexpr std::size_t near = 8;
        std::array<std::size_t, near> found{};
        std::array<double, near> squares{};
        nanoflann::KNNResultSet<double> result(near);
        result.init(found.data(), squares.data());
        const std::array<double, 2> place{p.x, p.y};
        tree_->findNeighbors(result, place.data(), nanoflann::SearchParams());
        const double distance = std::sqrt(squares[0]);
        if (distance >= reach_) return 0;
        double sum = 0, weights = 0;
        for (std::size_t i = 0; i < result.size(); ++i) {
            const double weight = 1 / std::max(squares[i], 1e-12 * reach_ * reach_);
            sum += weight * rest_[found[i]].z;
            weights += weight;
        }
        return share_ * (1 - distance / reach_) * sum / weights;
    }

private:
    std::vector<Point3> rest_;
    double share_ = 0, reach_ = 0;
    FlatCloud cloud_;
    std::unique_ptr<FlatTree> tree_;
};

/// Selects the data that take part: half of them, or all that there are, from borders.
std::vector<Point3> taking_part(const DataAroundHole& around, std::size_t most) {
    if (around.data.size() <= most) return {around.data.begin(), around.data.end()};
    const auto border = around.data.first(around.border),
               others = around.data.subspan(around.border);
    const auto on_border =
        std::min(around.border, std::max(most / 2, most - std::min(most, others.size())));
    auto result = selected(border, well_spread_in_plane(border, on_border));
    for (const auto i : well_spread_in_plane(others, most - result.size()))
        result.push_back(others[i]);
    return result;
}

} // namespace

struct AveragedHeights::State {
    ModelAverage average;
    double ground = 0; ///< added to heights
    double rounding = 0;
    std::size_t data = 0;
    std::vector<std::unique_ptr<System>> systems, fewer; ///< one per model
    std::unique_ptr<BorderRest> beside_border;

    /// Averages at a few places. `deviating`: the systems of standard deviations; none: no need.
    [[nodiscard]] KnownHeights at(std::span<const Point3> places,
                                  const std::vector<std::unique_ptr<System>>* deviating) const {
        const auto count = static_cast<Index>(places.size());
        VectorXd mean = VectorXd::Zero(count), variance = mean;
        std::vector<VectorXd> values;
        for (std::size_t m = 0; m < systems.size(); ++m) {
            const WeighedModel& model = average.models[m];
            const bool same = deviating == &systems;
            const auto estimates = systems[m]->at(places, same);
            const auto deviations =
                same || !deviating ? estimates : (*deviating)[m]->at(places, true);
            VectorXd& own = values.emplace_back(count);
            for (Index i = 0; i < count; ++i) {
                own[i] = estimates[static_cast<std::size_t>(i)].value;
                const double sd = deviations[static_cast<std::size_t>(i)].standard_deviation;
                variance[i] += model.variance_of(sd * sd, 0);
            }
            mean += model.weight * own;
        }
        for (std::size_t m = 0; m < systems.size(); ++m)
            for (Index i = 0; i < count; ++i)
                variance[i] += average.models[m].variance_of(0, values[m][i] - mean[i]);
        KnownHeights known;
        for (Index i = 0; i < count; ++i) {
            const Point3& p = places[static_cast<std::size_t>(i)];
            known.heights.push_back(ground + mean[i] + (beside_border ? beside_border->at(p) : 0));
            known.expected.push_back(
                average.determined
                    ? std::hypot(average.factor * std::sqrt(std::max(0.0, variance[i])), rounding)
                    : std::numeric_limits<double>::quiet_NaN());
        }
        return known;
    }

    void add_rest(const DataAroundHole& around);

    /// Drops models whose systems have no solution, as long as there are others.
    void drop_unsolved() {
        for (std::size_t m = systems.size(); m-- > 0 && systems.size() > 1;) {
            if (systems[m]->ready() && fewer[m]->ready()) continue;
            const double rest = 1 - average.models[m].weight;
            if (!(rest > 0)) continue;
            const auto at = static_cast<std::ptrdiff_t>(m);
            systems.erase(systems.begin() + at);
            fewer.erase(fewer.begin() + at);
            average.models.erase(average.models.begin() + at);
            for (WeighedModel& model : average.models) model.weight /= rest;
        }
    }
};

/// Keeps what is left of data on borders, if most of it is no noise.
void AveragedHeights::State::add_rest(const DataAroundHole& around) {
    std::vector<Point3> rest(around.data.begin(),
                             around.data.begin() + static_cast<std::ptrdiff_t>(around.border));
    const auto known = at(rest, nullptr);
    double squares = 0, noise = 0, length = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        rest[i].z -= known.heights[i];
        squares += rest[i].z * rest[i].z / static_cast<double>(rest.size());
        const Point3& next = rest[(i + 1) % rest.size()];
        length += std::hypot(next.x - rest[i].x, next.y - rest[i].y);
    }
    for (const WeighedModel& m : average.models) noise += m.weight * m.variogram.nugget;
    if (!(squares > noise)) return;
    const double spacing = length / static_cast<double>(constants.most_at_once / 2);
    beside_border = std::make_unique<BorderRest>(std::move(rest), 1 - noise / squares, spacing);
}

AveragedHeights::AveragedHeights(const DataAroundHole& around, const ModelAverage& average,
                                 const Run& run) :
    state_(std::make_unique<State>()) {
    State& s = *state_;
    s.average = average;
    auto data = taking_part(around, constants.most_at_once);
    std::sort(data.begin(), data.end());
    s.data = data.size();
    // The height of a datum, so that no digit is lost.
    s.ground = data[data.size() / 2].z;
    for (Point3& p : data) p.z -= s.ground;
    std::vector<Point3> some;
    for (const auto i : well_spread_in_plane(data, constants.most_deviations))
        some.push_back(data[i]);
    s.systems.resize(average.models.size());
    s.fewer.resize(average.models.size());
    const auto one = [&](std::size_t m) {
        const auto& [variogram, degree, weight, doubt] = average.models[m];
        s.systems[m] = std::make_unique<System>(data, variogram, degree, run);
        s.fewer[m] = std::make_unique<System>(some, variogram, degree, run);
    };
    with_threads(run, [&] { for_each_index(average.models.size(), one); });
    s.drop_unsolved();
    for (const WeighedModel& m : average.models)
        s.rounding = std::max(s.rounding, rounding_of(around.data, m.degree));
    if (around.data.size() > data.size() && !run.stop.stop_requested()) s.add_rest(around);
}

AveragedHeights::AveragedHeights(AveragedHeights&&) noexcept = default;
AveragedHeights::~AveragedHeights() = default;

KnownHeights AveragedHeights::at(std::span<const Point3> places, const Run& run) const {
    const State& s = *state_;
    const double operations = static_cast<double>(s.data) * static_cast<double>(s.data) *
                              static_cast<double>(places.size()) *
                              static_cast<double>(s.systems.size());
    const auto& deviating = operations > constants.most_operations ? s.fewer : s.systems;
    KnownHeights known{std::vector<double>(places.size()), std::vector<double>(places.size())};
    constexpr std::size_t grain = 64;
    const auto some = [&](std::size_t part) {
        if (run.stop.stop_requested()) return;
        const auto first = part * grain, count = std::min(grain, places.size() - first);
        const auto own = s.at(places.subspan(first, count), &deviating);
        std::copy(own.heights.begin(), own.heights.end(),
                  known.heights.begin() + static_cast<std::ptrdiff_t>(first));
        std::copy(own.expected.begin(), own.expected.end(),
                  known.expected.begin() + static_cast<std::ptrdiff_t>(first));
    };
    if (run.progress) run.progress("kriging", 0);
    with_threads(run, [&] { for_each_index((places.size() + grain - 1) / grain, some); });
    return known;
}

std::vector<ModelShare> AveragedHeights::shares_at(const Point3& place) const {
    const State& s = *state_;
    std::vector<ModelShare> shares;
    for (std::size_t m = 0; m < s.systems.size(); ++m) {
        const auto [value, deviation] = s.systems[m]->at(std::span(&place, 1), true)[0];
        const WeighedModel& model = s.average.models[m];
        shares.push_back({description(model), model.weight, s.ground + value, deviation});
    }
    return shares;
}

} // namespace terrane::kriging::detail
