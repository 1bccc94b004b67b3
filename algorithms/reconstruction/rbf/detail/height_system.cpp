// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/height_system.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/constants.hpp>

namespace terrane::rbf::detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double kernel_of(RbfKernel kernel, double square) {
    if (kernel == RbfKernel::linear) return -std::sqrt(square);
    if (kernel == RbfKernel::cubic) return square * std::sqrt(square);
    return square > 0 ? square * std::log(square) / 2 : 0;
}

double kernel_between(RbfKernel kernel, const Point3& p, const Point3& q) {
    const double du = p.x - q.x, dv = p.y - q.y;
    return kernel_of(kernel, du * du + dv * dv);
}

/// Evaluates the terms of a polynomial at a place.
VectorXd terms_at(const Point3& p, unsigned degree) {
    VectorXd terms(terms_of(degree));
    Index term = 0;
    double up = 1;
    for (unsigned a = 0; a <= degree; ++a, up *= p.x) {
        double both = up;
        for (unsigned b = 0; a + b <= degree; ++b, both *= p.y) terms[term++] = both;
    }
    return terms;
}

} // namespace

HeightSystem::HeightSystem(std::span<const Point3> data, RbfKernel kernel, unsigned degree) :
    data_(data.begin(), data.end()), kernel_(kernel), degree_(degree),
    heights_(static_cast<Index>(data.size())), m_(terms_of(degree)) {
    const Index n = heights_.size();
    MatrixXd terms(n, m_);
    kernels_.resize(n, n);
    for (Index i = 0; i < n; ++i) {
        const Point3& p = data_[static_cast<std::size_t>(i)];
        heights_[i] = p.z;
        for (Index j = 0; j <= i; ++j)
            kernels_(i, j) = kernels_(j, i) =
                kernel_between(kernel, p, data_[static_cast<std::size_t>(j)]);
        terms.row(i) = terms_at(p, degree);
    }
    qr_.compute(terms);
    kernels_.applyOnTheLeft(qr_.householderQ().adjoint());
    kernels_.applyOnTheRight(qr_.householderQ());
    heights_.applyOnTheLeft(qr_.householderQ().adjoint());
}

bool HeightSystem::determined() const {
    const VectorXd r = qr_.matrixQR().diagonal().head(m_).cwiseAbs();
    return r.minCoeff() > constants.singular * r.maxCoeff();
}

bool HeightSystem::polynomial_only() const {
    return !(contrasts().cwiseAbs().maxCoeff() > constants.height_rounding);
}

MatrixXd HeightSystem::between_contrasts() const {
    const Index k = heights_.size() - m_;
    return kernels_.bottomRightCorner(k, k);
}

VectorXd HeightSystem::contrasts() const {
    return heights_.tail(heights_.size() - m_);
}

bool HeightSystem::factorise(double nugget, const Run& run) {
    nugget_ = nugget;
    factor_ = between_contrasts();
    factor_.diagonal().array() += nugget;
    return cholesky(factor_, run);
}

VectorXd HeightSystem::weights() const {
    VectorXd weights = VectorXd::Zero(heights_.size());
    weights.tail(factor_.rows()) = solved();
    weights.applyOnTheLeft(qr_.householderQ());
    return weights;
}

VectorXd HeightSystem::polynomial() const {
    const VectorXd rest =
        heights_.head(m_) - kernels_.topRightCorner(m_, factor_.rows()) * solved();
    return qr_.matrixQR().topLeftCorner(m_, m_).triangularView<Eigen::Upper>().solve(rest);
}

MatrixXd HeightSystem::projection() const {
    const Index n = heights_.size();
    MatrixXd half = MatrixXd::Zero(n - m_, n);
    half.rightCols(n - m_).setIdentity();
    factor_.triangularView<Eigen::Lower>().solveInPlace(half);
    half.applyOnTheRight(qr_.householderQ().adjoint());
    return half.transpose() * half;
}

double HeightSystem::condition() const {
    const double ratio = factor_.diagonal().maxCoeff() / factor_.diagonal().minCoeff();
    return ratio * ratio;
}

VectorXd HeightSystem::solved() const {
    VectorXd solved = contrasts();
    factor_.triangularView<Eigen::Lower>().solveInPlace(solved);
    factor_.transpose().triangularView<Eigen::Upper>().solveInPlace(solved);
    return solved;
}

std::vector<double> HeightSystem::values(std::span<const Point3> places) const {
    const VectorXd factors = weights(), terms = polynomial();
    std::vector<double> result;
    for (const Point3& p : places) {
        double sum = terms_at(p, degree_).dot(terms);
        for (std::size_t i = 0; i < data_.size(); ++i)
            sum += factors[static_cast<Index>(i)] * kernel_between(kernel_, data_[i], p);
        result.push_back(sum);
    }
    return result;
}

std::vector<double> HeightSystem::some_deviations(std::span<const Point3> places,
                                                  double noise_share) const {
    const Index n = heights_.size(), count = static_cast<Index>(places.size());
    MatrixXd k(n, count), share(m_, count);
    for (Index c = 0; c < count; ++c) {
        const Point3& p = places[static_cast<std::size_t>(c)];
        for (Index i = 0; i < n; ++i)
            k(i, c) = kernel_between(kernel_, data_[static_cast<std::size_t>(i)], p);
        share.col(c) = terms_at(p, degree_);
    }
    // The weights of the data are a share of the polynomial, which any unbiased estimate has, and
    // contrasts. The share is noisy, too.
    qr_.matrixQR().topLeftCorner(m_, m_).triangularView<Eigen::Upper>().transpose().solveInPlace(
        share);
    k.applyOnTheLeft(qr_.householderQ().adjoint());
    const auto top = kernels_.topLeftCorner(m_, m_);
    const auto beside = kernels_.topRightCorner(m_, n - m_);
    MatrixXd left = k.bottomRows(n - m_) - beside.transpose() * share;
    factor_.triangularView<Eigen::Lower>().solveInPlace(left);
    const MatrixXd own = top * share;
    MatrixXd weights;
    if (noise_share < 1) weights = factor_.transpose().triangularView<Eigen::Upper>().solve(left);
    std::vector<double> result;
    for (Index c = 0; c < count; ++c) {
        const double open = share.col(c).dot(own.col(c) - 2 * k.col(c).head(m_)) +
                            nugget_ * share.col(c).squaredNorm(),
                     told = left.col(c).squaredNorm();
        double noise = 0; // that the data do not have
        if (noise_share < 1)
            noise = (1 - noise_share) * nugget_ *
                    (share.col(c).squaredNorm() + weights.col(c).squaredNorm());
        // Less than the rounding of this difference would be no more than luck.
        const double least = std::numeric_limits<double>::epsilon() * told;
        result.push_back(std::sqrt(std::max(open - told - noise, least)));
    }
    return result;
}

std::vector<double> HeightSystem::deviations(std::span<const Point3> places, double noise_share,
                                             const Run& run) const {
    constexpr std::size_t most_columns = 64; // that the factor meets at once
    std::vector<double> result(places.size());
    for_ranges((places.size() + most_columns - 1) / most_columns, run,
               [&](std::size_t first, std::size_t last) {
                   for (std::size_t k = first; k < last && !run.stop.stop_requested(); ++k) {
                       const std::size_t start = k * most_columns;
                       const auto some = some_deviations(
                           places.subspan(start, std::min(most_columns, places.size() - start)),
                           noise_share);
                       std::copy(some.begin(), some.end(),
                                 result.begin() + static_cast<std::ptrdiff_t>(start));
                   }
               },
               4, 1);
    return result;
}

} // namespace terrane::rbf::detail
