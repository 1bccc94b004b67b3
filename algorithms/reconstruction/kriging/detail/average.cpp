// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/average.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/kriging/well_spread.hpp>

namespace terrane::kriging::detail {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

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

AveragedHeights::AveragedHeights(const DataAroundHole& around, ModelAverage average,
                                 const Run& run) :
    average_(std::move(average)),
    data_(taking_part(around, constants.most_at_once)), near_(data_) {
    if (around.near < around.data.size())
        near_.assign(around.data.begin(),
                     around.data.begin() + static_cast<std::ptrdiff_t>(around.near));
    for (auto* data : {&data_, &near_}) std::sort(data->begin(), data->end());
    // The height of a datum near the hole, so that no digit is lost.
    ground_ = near_[near_.size() / 2].z;
    for (auto* data : {&data_, &near_})
        for (Point3& p : *data) p.z -= ground_;
    for (const WeighedModel& m : average_.models)
        rounding_ = std::max(rounding_, rounding_of(around.data, m.degree));
    systems_ = systems_of(data_, run);
    drop_unsolved();
    if (around.data.size() > data_.size() && !run.stop.stop_requested()) add_rest(around);
}

AveragedHeights::Systems AveragedHeights::systems_of(std::span<const Point3> data,
                                                     const Run& run) const {
    std::vector<std::optional<System>> made(average_.models.size());
    const auto one = [&](std::size_t m) {
        const auto& [variogram, degree, weight] = average_.models[m];
        made[m].emplace(data, variogram, degree, run);
        // What more data add to a trend without noise is rounding.
        const bool helps = made[m]->ready() && made[m]->misfit() <= constants.most_misfit &&
                           variogram.sill + variogram.nugget > 0;
        if (!helps && data.size() > near_.size()) made[m].emplace(near_, variogram, degree, run);
    };
    with_threads(run, [&] { for_each_index(made.size(), one); });
    Systems systems;
    for (auto& system : made) systems.push_back(std::move(*system));
    return systems;
}

KnownHeights AveragedHeights::average_at(std::span<const Point3> places,
                                         const Systems* deviating) const {
    const auto count = static_cast<Index>(places.size());
    VectorXd mean = VectorXd::Zero(count), variance = mean;
    std::vector<VectorXd> values;
    for (std::size_t m = 0; m < systems_.size(); ++m) {
        const WeighedModel& model = average_.models[m];
        const bool same = deviating == &systems_ || (deviating && !(*deviating)[m].ready());
        const auto estimates = systems_[m].at(places, same);
        const auto deviations = same || !deviating ? estimates : (*deviating)[m].at(places, true);
        VectorXd& own = values.emplace_back(count);
        for (Index i = 0; i < count; ++i) {
            own[i] = estimates[static_cast<std::size_t>(i)].value;
            const double sd = deviations[static_cast<std::size_t>(i)].standard_deviation;
            variance[i] += model.weight * sd * sd;
        }
        mean += model.weight * own;
    }
    for (std::size_t m = 0; m < systems_.size(); ++m)
        variance.array() += average_.models[m].weight * (values[m] - mean).array().square();
    KnownHeights known;
    for (Index i = 0; i < count; ++i) {
        const Point3& p = places[static_cast<std::size_t>(i)];
        known.heights.push_back(ground_ + mean[i] +
                                (beside_border_ ? (*beside_border_)({p.x, p.y, 0}) : 0));
        known.expected.push_back(
            average_.unknown.empty()
                ? std::hypot(average_.factor * std::sqrt(std::max(0.0, variance[i])), rounding_)
                : NAN);
    }
    return known;
}

/// Drops models whose systems of equations have no solution, and keeps at least one.
void AveragedHeights::drop_unsolved() {
    for (std::size_t m = systems_.size(); m-- > 0 && systems_.size() > 1;) {
        if (systems_[m].ready()) continue;
        const double rest = 1 - average_.models[m].weight;
        if (!(rest > 0)) continue;
        const auto at = static_cast<std::ptrdiff_t>(m);
        systems_.erase(systems_.begin() + at);
        average_.models.erase(average_.models.begin() + at);
        for (WeighedModel& model : average_.models) model.weight /= rest;
    }
}

/// Keeps what is left of data on borders, as far as it is no noise, so that the filling has no step
/// there.
void AveragedHeights::add_rest(const DataAroundHole& around) {
    std::vector<Point3> border(around.data.begin(),
                               around.data.begin() + static_cast<std::ptrdiff_t>(around.border));
    auto rest = average_at(border, nullptr).heights;
    double squares = 0, noise = 0, length = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        rest[i] = border[i].z - rest[i];
        squares += rest[i] * rest[i] / static_cast<double>(rest.size());
        const Point3& next = border[(i + 1) % rest.size()];
        length += std::hypot(next.x - border[i].x, next.y - border[i].y);
    }
    for (const WeighedModel& m : average_.models) noise += m.weight * m.variogram.nugget;
    if (!(squares > noise)) return;
    for (double& r : rest) r *= 1 - noise / squares;
    for (Point3& p : border) p.z = 0;
    const double spacing = 2 * length / static_cast<double>(constants.most_at_once);
    beside_border_ = std::make_unique<NearbyRest>(border, std::move(rest), spacing);
}

KnownHeights AveragedHeights::at(std::span<const Point3> places, const Run& run) const {
    const auto operations = [](std::size_t data, std::size_t at) { return data * data * at; };
    const bool all = operations(data_.size(), places.size() * systems_.size()) <=
                     operations(constants.few_data, constants.most_places);
    if (!all && fewer_.empty())
        fewer_ = systems_of(selected(near_, well_spread_in_plane(near_, constants.few_data)), run);
    KnownHeights known{std::vector<double>(places.size()), std::vector<double>(places.size())};
    constexpr std::size_t grain = 64;
    const auto some = [&](std::size_t part) {
        if (run.stop.stop_requested()) return;
        const auto first = part * grain, count = std::min(grain, places.size() - first);
        const auto own = average_at(places.subspan(first, count), all ? &systems_ : &fewer_);
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
    std::vector<ModelShare> shares;
    for (std::size_t m = 0; m < systems_.size(); ++m) {
        const auto [value, deviation] = systems_[m].at(std::span(&place, 1), true)[0];
        const WeighedModel& model = average_.models[m];
        shares.push_back({description(model), model.weight, ground_ + value, deviation});
    }
    return shares;
}

} // namespace terrane::kriging::detail
