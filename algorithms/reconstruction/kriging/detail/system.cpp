// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/system.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>

namespace terrane::kriging::detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd heights_of(std::span<const Point3> data) {
    VectorXd z(static_cast<Index>(data.size()));
    for (Index i = 0; i < z.size(); ++i) z[i] = data[static_cast<std::size_t>(i)].z;
    return z;
}

double flat_extent_of(std::span<const Point3> data) {
    Point3 low = data[0], high = data[0];
    for (const Point3& p : data) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), 0};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), 0};
    }
    return std::hypot(high.x - low.x, high.y - low.y);
}

TrendTerms::TrendTerms(std::span<const Point3> data, unsigned degree) {
    const auto n = static_cast<double>(data.size());
    for (const Point3& p : data) {
        x0_ += p.x / n;
        y0_ += p.y / n;
    }
    for (const Point3& p : data)
        scale_ = std::max({scale_, std::abs(p.x - x0_), std::abs(p.y - y0_)});
    if (!(scale_ > 0)) scale_ = 1;
    for (;; --degree) {
        size_ = terms_of(degree);
        if (degree == 0) break;
        if (size_ < static_cast<Index>(data.size()) && Contrasts(matrix(data)).determined()) break;
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
    if (!factorise(rotated, run)) return;
    VectorXd z = heights_of(data);
    contrasts_.apply(z);
    MatrixXd solved = z.tail(n - m);
    divide_by_factor(factor_, solved);
    misfit_ = solved.squaredNorm() / static_cast<double>(std::max<Index>(1, n - m));
    divide_by_transposed(factor_, solved);
    weights_ = VectorXd::Zero(n);
    weights_.tail(n - m) = solved;
    polynomial_ = contrasts_.trend_of(z.head(m) - top_.rightCols(n - m) * solved);
    contrasts_.undo(weights_);
    ready_ = true;
}

bool System::factorise(const MatrixXd& rotated, const Run& run) {
    const Index m = rotated.rows() - terms_.size();
    const double scale = m > 0 ? rotated.diagonal().tail(m).mean() : 0;
    const double unit = scale > 0 ? scale : 1;
    // In sills: first 1e-12, at most 1e-6, by which data are hardly smoothed.
    for (double addition = 1e-12; addition < 1e-5 && !run.stop.stop_requested(); addition *= 100) {
        factor_ = rotated.bottomRightCorner(m, m);
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
    MatrixXd all = MatrixXd::Zero(n, n);
    all.bottomRightCorner(n - m, n - m) = squared(inverse_of_factor(factor_));
    contrasts_.undo(all);
    all.transposeInPlace();
    contrasts_.undo(all);
    return all;
}

Likelihood::Likelihood(std::span<const Point3> data) :
    data_(data.begin(), data.end()), terms_(data, highest_degree), basis_(terms_.matrix(data)),
    numbers_(heights_of(data)), extent_(flat_extent_of(data)) {
    rounding_ = static_cast<double>(data.size()) * std::numeric_limits<double>::epsilon() *
                numbers_.cwiseAbs().maxCoeff();
    numbers_.array() -= numbers_.mean();
    spread_ = std::log(2 * std::numbers::pi * numbers_.squaredNorm());
    basis_.apply(numbers_);
}

Index Likelihood::left_by(unsigned degree) const {
    return numbers_.size() - terms_of(degree);
}

double Likelihood::constant_of(unsigned degree) const {
    return -(static_cast<double>(left_by(degree)) * (1 + std::log(2 * std::numbers::pi)) +
             static_cast<double>(terms_of(degree) - 1) * spread_) /
           2;
}

std::vector<Likely> Likelihood::of_noise() const {
    std::vector<Likely> all;
    for (unsigned degree = 0; terms_of(degree) <= terms_.size(); ++degree) {
        const VectorXd left = numbers_.tail(left_by(degree));
        const auto n = static_cast<double>(left.size());
        Variogram noise;
        noise.range = extent_ > 0 ? extent_ : 1;
        if (left.size() == 0 || !(left.cwiseAbs().maxCoeff() > rounding_))
            return {{HUGE_VAL, noise, degree}};
        noise.nugget = left.squaredNorm() / n;
        all.push_back({constant_of(degree) - n * std::log(noise.nugget) / 2, noise, degree});
    }
    return all;
}

std::vector<Likely> Likelihood::at(const Variogram& shape) const {
    const unsigned least = least_degree(shape.model);
    std::vector<Index> trends;
    for (unsigned degree = least; terms_of(degree) <= terms_.size() && left_by(degree) > 1;
         ++degree)
        trends.push_back(terms_of(degree) - terms_of(least));
    if (trends.empty()) return {};
    Variogram unit = shape;
    unit.nugget = 0;
    unit.sill = 1;
    const auto n = static_cast<Index>(data_.size());
    MatrixXd kernel = MatrixXd::Zero(n, n);
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < j; ++i) {
            const Point3 &p = data_[static_cast<std::size_t>(i)],
                         &q = data_[static_cast<std::size_t>(j)];
            const double h = unit.distance(p.x - q.x, p.y - q.y);
            kernel(i, j) = kernel(j, i) = h > 0 ? -unit.at(h) : 0;
        }
    basis_.apply_twice(kernel);
    const Index m = left_by(least);
    const auto found =
        TridiagonalKernel(kernel.bottomRightCorner(m, m), numbers_.tail(m), trends).most_likely();
    std::vector<Likely> all;
    for (unsigned t = 0; t < found.size(); ++t) {
        if (!(found[t].sill > 0)) continue;
        all.push_back({constant_of(least + t) + found[t].likelihood, unit, least + t});
        all.back().variogram.sill = found[t].sill;
        all.back().variogram.nugget = found[t].nugget;
    }
    return all;
}

} // namespace terrane::kriging::detail
