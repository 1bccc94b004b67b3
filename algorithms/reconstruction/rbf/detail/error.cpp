// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/error.hpp>

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/fit.hpp>

namespace terrane::rbf::detail {
namespace {

double cubed_distance(const Point3& a, const Point3& b) {
    const Point3 d = minus(a, b);
    const double square = dot(d, d);
    return square * std::sqrt(square);
}

/// Chooses half of the points near the border, the others anywhere.
std::vector<std::uint32_t> chosen(const RbfData& data, double margin) {
    std::vector<bool> near, far;
    for (const double d : data.distances)
        near.push_back(d <= margin + constants.error_near * data.radius);
    auto points = well_spread(data.points, constants.most_error_points / 2, near);
    far.assign(data.points.size(), true);
    for (const std::uint32_t i : points) far[i] = false;
    const auto others = well_spread(data.points, constants.most_error_points - points.size(), far);
    points.insert(points.end(), others.begin(), others.end());
    return points;
}

} // namespace

RbfError::RbfError(const RbfData& data, const RbfPolynomial& polynomial, double margin,
                   double nugget) :
    basis_(polynomial) {
    basis_.in_space = false; // only directions along the surface matter
    const auto indices = chosen(data, margin);
    for (const std::uint32_t i : indices) {
        const Point3& p = data.points[i];
        const auto share = 1 / static_cast<double>(indices.size());
        middle_ = {middle_.x + share * p.x, middle_.y + share * p.y, middle_.z + share * p.z};
    }
    scale_ = data.radius > 0 ? data.radius : 1;
    for (const std::uint32_t i : indices) {
        const Point3 d = minus(data.points[i], middle_);
        points_.push_back({d.x / scale_, d.y / scale_, d.z / scale_});
    }
    // Each chosen datum represents its share of all data.
    nugget_ = nugget * static_cast<double>(points_.size()) /
              static_cast<double>(std::max<std::size_t>(data.points.size(), 1)) /
              (scale_ * scale_ * scale_);
    const auto n = static_cast<Eigen::Index>(points_.size()),
               m = static_cast<Eigen::Index>(terms());
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + m, n + m);
    Eigen::VectorXd row(m);
    for (Eigen::Index i = 0; i < n; ++i) {
        const Point3& p = points_[static_cast<std::size_t>(i)];
        for (Eigen::Index j = 0; j < i; ++j)
            system(i, j) = system(j, i) = cubed_distance(p, points_[static_cast<std::size_t>(j)]);
        system(i, i) = nugget_;
        terms_at(p, row.data());
        system.block(i, n, 1, m) = row.transpose();
        system.block(n, i, m, 1) = row;
    }
    const Eigen::MatrixXd inverse = system.partialPivLu().inverse();
    inverse_.assign(inverse.data(), inverse.data() + inverse.size());
}

/// Evaluates monomials along the surface; across it, all data may be 0.
void RbfError::terms_at(const Point3& p, double* terms) const {
    const double u = dot(p, basis_.axes[0]), v = dot(p, basis_.axes[1]);
    double up = 1;
    for (unsigned i = 0; i <= basis_.degree; ++i, up *= u) {
        double both = up;
        for (unsigned j = 0; i + j <= basis_.degree; ++j, both *= v) *terms++ = both;
    }
}

std::vector<double> RbfError::at(std::span<const Point3> places, bool measured,
                                 const Run& run) const {
    std::vector<double> result(places.size());
    const std::size_t n = points_.size();
    const auto size = static_cast<Eigen::Index>(n + terms());
    const Eigen::Map<const Eigen::MatrixXd> inverse(inverse_.data(), size, size);
    const double unit = scale_ * scale_ * scale_;
    constexpr std::size_t most_columns = 64; // columns per matrix product, so that the inverse
                                             // stays in cache
    const std::size_t blocks = (places.size() + most_columns - 1) / most_columns;
    const auto fill_blocks = [&](std::size_t first, std::size_t last) {
        Eigen::MatrixXd right, solved;
        for (std::size_t b = first; b < last; ++b) {
            const std::size_t k = b * most_columns;
            const std::size_t count = std::min(most_columns, places.size() - k);
            right.resize(size, static_cast<Eigen::Index>(count));
            for (std::size_t c = 0; c < count; ++c) {
                double* const column = right.col(static_cast<Eigen::Index>(c)).data();
                const Point3 d = minus(places[k + c], middle_);
                const Point3 p{d.x / scale_, d.y / scale_, d.z / scale_};
                for (std::size_t i = 0; i < n; ++i) column[i] = cubed_distance(p, points_[i]);
                terms_at(p, column + n);
            }
            solved.noalias() = inverse * right;
            for (std::size_t c = 0; c < count; ++c) {
                const auto column = static_cast<Eigen::Index>(c);
                const double variance =
                    -right.col(column).dot(solved.col(column)) + (measured ? nugget_ : 0);
                result[k + c] = std::sqrt(std::max(variance, 0.0) * unit);
            }
        }
    };
    for_ranges(blocks, run, fill_blocks, 4, 128);
    return result;
}

} // namespace terrane::rbf::detail
