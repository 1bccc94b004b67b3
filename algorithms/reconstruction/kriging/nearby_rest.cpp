// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/nearby_rest.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace terrane {
namespace {

Cloud cloud_of(std::span<const Point3> points) {
    Cloud cloud;
    for (const Point3& p : points) cloud.points.push_back({p.x, p.y, p.z});
    return cloud;
}

} // namespace

NearbyRest::NearbyRest(std::span<const Point3> points, std::vector<double> values, double reach) :
    cloud_(cloud_of(points)), values_(std::move(values)), reach_(reach),
    tree_(3, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(8)) {
    tree_.buildIndex();
}

double NearbyRest::operator()(const Point3& p) const {
    constexpr std::size_t near = 8;
    std::array<std::size_t, near> found{};
    std::array<double, near> squares{};
    nanoflann::KNNResultSet<double> result(near);
    result.init(found.data(), squares.data());
    const std::array<double, 3> place{p.x, p.y, p.z};
    tree_.findNeighbors(result, place.data(), nanoflann::SearchParams());
    const double distance = std::sqrt(squares[0]);
    if (distance >= reach_) return 0;
    double sum = 0, weights = 0;
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double square = std::max(squares[i] / (reach_ * reach_), 1e-20);
        const double weight = 1 / (square * square);
        sum += weight * values_[found[i]];
        weights += weight;
    }
    return (1 - distance / reach_) * sum / weights;
}

} // namespace terrane
