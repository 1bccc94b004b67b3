// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/direction_doubt.hpp>

#include <algorithm>
#include <cmath>

#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>

namespace terrane::kriging::detail {

std::vector<Point3> error_data(std::span<const Point3> data, std::size_t border,
                               const Variogram& variogram) {
    const bool noisy = variogram.nugget > constants.noisy * variogram.sill;
    const std::size_t most = noisy ? constants.most_noisy_data : constants.most_error_data;
    if (data.size() <= most) return {data.begin(), data.end()};
    const auto near = data.first(border), far = data.subspan(border);
    std::vector<Point3> some;
    for (const auto i : well_spread_in_plane(near, std::min(most / 2, border)))
        some.push_back(near[i]);
    for (const auto i : well_spread_in_plane(far, most - some.size())) some.push_back(far[i]);
    return some;
}

DirectionDoubt::DirectionDoubt(std::span<const Point3> data, const ModelChoice& choice,
                               const Run& run) :
    share_(choice.doubt) {
    if (!choice.plain || !(share_ > 0)) return;
    turned_.emplace(data, choice.variogram, choice.degree, run);
    plain_.emplace(data, *choice.plain, choice.degree, run);
}

std::vector<double> DirectionDoubt::at(std::span<const Point3> places, const Run& run) const {
    std::vector<double> result(places.size(), 0);
    if (!turned_) return result;
    const auto a = turned_->values(places, run), b = plain_->values(places, run);
    for (std::size_t i = 0; i < places.size(); ++i) result[i] = share_ * std::abs(a[i] - b[i]);
    return result;
}

} // namespace terrane::kriging::detail
