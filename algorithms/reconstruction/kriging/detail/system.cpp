// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/system.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>

namespace terrane::kriging::detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd heights_of(std::span<const Point3> data) {
    VectorXd z(static_cast<Index>(data.size()));
    for (Index i = 0; i < z.size(); ++i) z[i] = data[static_cast<std::size_t>(i)].z;
    return z;
}

} // namespace

TrendTerms::TrendTerms(std::span<const Point3> data, unsigned degree) {
    const auto n = static_cast<double>(data.size());
    for (const Point3& p : data) {
        x0_ += p.x / n;
        y0_ += p.y / n;
    }
    for (const Point3& p : data)
        scale_ = std::max({scale_, std::abs(p.x - x0_), std::abs(p.y - y0_)});
    if (!(scale_ > 0)) scale_ = 1;
    for (size_ = degree == 0 ? 1 : degree == 1 ? 3 : 6; size_ > 1; size_ = size_ == 6 ? 3 : 1) {
        if (size_ >= static_cast<Index>(data.size())) continue;
        if (Contrasts(matrix(data)).determined()) break;
    }
}

VectorXd TrendTerms::at(double x, double y) const {
    const double u = (x - x0_) / scale_, v = (y - y0_) / scale_;
    VectorXd terms(size_);
    terms[0] = 1;
    if (size_ >= 3) terms.segment<2>(1) << u, v;
    if (size_ >= 6) terms.segment<3>(3) << u * u, u * v, v * v;
    return terms;
}

MatrixXd TrendTerms::matrix(std::span<const Point3> data) const {
    MatrixXd terms(static_cast<Index>(data.size()), size_);
    for (Index i = 0; i < terms.rows(); ++i) {
        const Point3& p = data[static_cast<std::size_t>(i)];
        terms.row(i) = at(p.x, p.y);
    }
    return terms;
}

System::System(std::span<const Point3> data, const Variogram& model, unsigned degree,
               const Run& run) :
    model_(model),
    terms_(data, degree), contrasts_(terms_.matrix(data)) {
    const double angle = model.angle * std::numbers::pi / 180;
    cosine_ = std::cos(angle);
    sine_ = std::sin(angle);
    for (const Point3& p : data) places_.push_back(place(p.x, p.y));
    const auto n = static_cast<Index>(data.size()), m = terms_.size();
    MatrixXd rotated = kernels();
    contrasts_.apply_twice(rotated);
    top_ = rotated.topRows(m);
    const double scale = n > m ? rotated.diagonal().tail(n - m).mean() : 0;
    if (!factorise(rotated.bottomRightCorner(n - m, n - m), scale, run)) return;
    VectorXd z = heights_of(data);
    contrasts_.apply(z);
    MatrixXd solved = z.tail(n - m);
    divide_by_factor(factor_, solved);
    divide_by_transposed(factor_, solved);
    weights_ = VectorXd::Zero(n);
    weights_.tail(n - m) = solved;
    polynomial_ = contrasts_.trend_of(z.head(m) - top_.rightCols(n - m) * solved);
    contrasts_.undo(weights_);
    ready_ = true;
}

bool System::factorise(const MatrixXd& contrasts, double scale, const Run& run) {
    const double unit = scale > 0 ? scale : 1;
    // In sills: first 1e-12, at most 1e-6, by which data are hardly smoothed.
    for (double addition = 1e-12; addition < 1e-5 && !run.stop.stop_requested(); addition *= 100) {
        factor_ = contrasts;
        factor_.diagonal().array() += addition * unit;
        if (cholesky(factor_, run)) return true;
    }
    return false;
}

System::Place System::place(double x, double y) const {
    const auto [x0, y0] = terms_.centre();
    const double dx = x - x0, dy = y - y0;
    return {cosine_ * dx + sine_ * dy, (cosine_ * dy - sine_ * dx) / model_.ratio};
}

/// Evaluates minus the variogram without the nugget, which is noise of the data and not of the
/// surface. The constant that would make it a covariance does not matter to contrasts.
double System::kernel(const Place& p, const Place& q) const {
    const double dx = p[0] - q[0], dy = p[1] - q[1], h = std::sqrt(dx * dx + dy * dy);
    return h > 0 ? model_.nugget - model_.at(h) : 0;
}

MatrixXd System::kernels() const {
    const auto n = static_cast<Index>(places_.size());
    MatrixXd all(n, n);
    for (Index j = 0; j < n; ++j) {
        const Place& q = places_[static_cast<std::size_t>(j)];
        for (Index i = 0; i < j; ++i)
            all(i, j) = all(j, i) = kernel(places_[static_cast<std::size_t>(i)], q);
        all(j, j) = model_.nugget;
    }
    return all;
}

std::vector<Estimate> System::at(std::span<const Point3> places, bool deviations) const {
    constexpr std::size_t most_columns = 64; // that the factor meets at once
    const auto n = static_cast<Index>(places_.size()), m = terms_.size();
    std::vector<Estimate> result(places.size());
    for (std::size_t first = 0; first < places.size(); first += most_columns) {
        const auto count = static_cast<Index>(std::min(most_columns, places.size() - first));
        MatrixXd k(n, count), share(m, count);
        for (Index c = 0; c < count; ++c) {
            const Point3& p = places[first + static_cast<std::size_t>(c)];
            const Place at = place(p.x, p.y);
            for (Index i = 0; i < n; ++i)
                k(i, c) = kernel(places_[static_cast<std::size_t>(i)], at);
            share.col(c) = terms_.at(p.x, p.y);
            result[first + static_cast<std::size_t>(c)].value =
                share.col(c).dot(polynomial_) + k.col(c).dot(weights_);
        }
        if (!deviations) continue;
        // The weights are a share of the trend, which any unbiased estimate has, and contrasts.
        contrasts_.reproduce(share);
        contrasts_.apply(k);
        MatrixXd left = k.bottomRows(n - m) - top_.rightCols(n - m).transpose() * share;
        divide_by_factor(factor_, left);
        const MatrixXd own = top_.leftCols(m) * share;
        for (Index c = 0; c < count; ++c) {
            const double open = share.col(c).dot(own.col(c) - 2 * k.col(c).head(m)),
                         known = left.col(c).squaredNorm();
            // Less than the rounding of this difference would be no more than luck.
            const double least = std::numeric_limits<double>::epsilon() * known;
            result[first + static_cast<std::size_t>(c)].standard_deviation =
                std::sqrt(std::max(open - known, least));
        }
    }
    return result;
}

MatrixXd System::projection() const {
    const auto n = static_cast<Index>(places_.size()), m = terms_.size();
    MatrixXd inverse = MatrixXd::Identity(n - m, n - m);
    divide_by_factor(factor_, inverse);
    MatrixXd all = MatrixXd::Zero(n, n);
    all.bottomRightCorner(n - m, n - m) = squared(inverse);
    contrasts_.undo(all);
    all.transposeInPlace();
    contrasts_.undo(all);
    return all;
}

Likelihood::Likelihood(std::span<const Point3> data, unsigned degree) :
    data_(data.begin(), data.end()), terms_(data, degree), basis_(terms_.matrix(data)),
    degree_(degree) {
    VectorXd z = heights_of(data);
    const double largest = z.size() > 0 ? z.cwiseAbs().maxCoeff() : 0;
    z.array() -= z.size() > 0 ? z.mean() : 0;
    const double squares = 2 * std::numbers::pi * z.squaredNorm();
    basis_.apply(z);
    contrasts_ = z.tail(z.size() - terms_.size());
    const auto count = static_cast<double>(contrasts_.size());
    constant_ = -(count * (1 + std::log(2 * std::numbers::pi)) +
                  static_cast<double>(terms_.size() - 1) * std::log(squares)) /
                2;
    trend_only_ = contrasts_.size() == 0 ||
                  !(contrasts_.cwiseAbs().maxCoeff() > constants.trend_rounding * largest);
    Point3 low = data[0], high = data[0];
    for (const Point3& p : data) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), 0};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), 0};
    }
    extent_ = std::hypot(high.x - low.x, high.y - low.y);
}

Likely Likelihood::of_noise() const {
    const auto n = static_cast<double>(contrasts_.size());
    Variogram noise;
    noise.range = extent_ > 0 ? extent_ : 1;
    noise.nugget = n > 0 ? contrasts_.squaredNorm() / n : 0;
    if (trend_only_) noise.nugget = 0;
    return {trend_only_ ? HUGE_VAL : constant_ - n * std::log(noise.nugget) / 2, noise, degree_};
}

Likely Likelihood::at(const Variogram& shape) const {
    Variogram unit = shape;
    unit.nugget = 0;
    unit.sill = 1;
    const auto n = static_cast<Index>(data_.size());
    const double angle = shape.angle * std::numbers::pi / 180, c = std::cos(angle),
                 s = std::sin(angle);
    const auto [x0, y0] = terms_.centre();
    std::vector<std::array<double, 2>> places;
    for (const Point3& p : data_) {
        const double dx = p.x - x0, dy = p.y - y0;
        places.push_back({c * dx + s * dy, (c * dy - s * dx) / shape.ratio});
    }
    MatrixXd kernel = MatrixXd::Zero(n, n);
    for (std::size_t j = 0; j < places.size(); ++j)
        for (std::size_t i = 0; i < j; ++i) {
            const double dx = places[i][0] - places[j][0], dy = places[i][1] - places[j][1];
            const double h = std::sqrt(dx * dx + dy * dy);
            const double value = h > 0 ? -unit.at(h) : 0;
            kernel(static_cast<Index>(i), static_cast<Index>(j)) = value;
            kernel(static_cast<Index>(j), static_cast<Index>(i)) = value;
        }
    basis_.apply_twice(kernel);
    const Index m = n - terms_.size();
    if (m < 2) return {};
    const LikelyNugget found =
        TridiagonalKernel(kernel.bottomRightCorner(m, m), contrasts_).most_likely();
    if (!(found.sill > 0)) return {};
    Likely best{constant_ + found.likelihood, unit, degree_};
    best.variogram.sill = found.sill;
    best.variogram.nugget = found.nugget;
    return best;
}

} // namespace terrane::kriging::detail
