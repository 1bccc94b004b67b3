// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace terrane {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Reflects data by the k-th Householder vector, whose first component is 1.
void reflect(const MatrixXd& vectors, double factor, Index k, double* data) {
    const Index below = vectors.rows() - k - 1;
    const auto vector = vectors.col(k).tail(below);
    Eigen::Map<VectorXd> rest(data + k + 1, below);
    const double step = factor * (data[k] + vector.dot(rest));
    data[k] -= step;
    rest -= step * vector;
}

} // namespace

Contrasts::Contrasts(MatrixXd terms) : vectors_(std::move(terms)), factors_(vectors_.cols()) {
    for (Index k = 0; k < factors_.size(); ++k) {
        auto column = vectors_.col(k).tail(vectors_.rows() - k);
        const double rest = column.tail(column.size() - 1).squaredNorm();
        factors_[k] = 0;
        if (!(rest > 0)) continue;
        const double head = column[0], norm = std::sqrt(head * head + rest);
        const double diagonal = head > 0 ? -norm : norm;
        factors_[k] = (diagonal - head) / diagonal;
        column.tail(column.size() - 1) /= head - diagonal;
        for (Index j = k + 1; j < factors_.size(); ++j) {
            auto other = vectors_.col(j).tail(column.size());
            column[0] = 1;
            other -= factors_[k] * column.dot(other) * column;
        }
        column[0] = diagonal;
    }
}

bool Contrasts::determined() const {
    const auto diagonal = vectors_.diagonal().cwiseAbs();
    return diagonal.minCoeff() > 1e-10 * diagonal.maxCoeff();
}

void Contrasts::apply_to(double* data) const {
    for (Index k = 0; k < factors_.size(); ++k) reflect(vectors_, factors_[k], k, data);
}

void Contrasts::undo_to(double* data) const {
    for (Index k = factors_.size(); k-- > 0;) reflect(vectors_, factors_[k], k, data);
}

void Contrasts::apply(MatrixXd& columns) const {
    for (Index c = 0; c < columns.cols(); ++c) apply_to(columns.col(c).data());
}

void Contrasts::undo(MatrixXd& columns) const {
    for (Index c = 0; c < columns.cols(); ++c) undo_to(columns.col(c).data());
}

void Contrasts::apply_twice(MatrixXd& symmetric) const {
    apply(symmetric);
    symmetric.transposeInPlace();
    apply(symmetric);
}

VectorXd Contrasts::trend_of(const VectorXd& numbers) const {
    const Index m = terms();
    return vectors_.topLeftCorner(m, m).triangularView<Eigen::Upper>().solve(numbers.head(m));
}

void Contrasts::reproduce(MatrixXd& terms) const {
    const Index m = factors_.size();
    vectors_.topLeftCorner(m, m).transpose().triangularView<Eigen::Lower>().solveInPlace(terms);
}

TridiagonalKernel::TridiagonalKernel(const MatrixXd& kernel, const VectorXd& contrasts) {
    const Eigen::Tridiagonalization<MatrixXd> form(kernel);
    diagonal_ = form.diagonal();
    beside_ = form.subDiagonal();
    values_ = contrasts;
    values_.applyOnTheLeft(form.matrixQ().adjoint());
    scale_ = std::max(diagonal_.mean(), std::numeric_limits<double>::min());
}

TridiagonalKernel::Profile TridiagonalKernel::profile(double nugget) const {
    const Index n = diagonal_.size();
    double pivot = 0, carried = 0, squares = 0, logarithms = 0, product = 1;
    for (Index i = 0; i < n; ++i) {
        const double ratio = i == 0 ? 0 : beside_[i - 1] / pivot;
        pivot = diagonal_[i] + nugget - (i == 0 ? 0 : ratio * beside_[i - 1]);
        if (!(pivot > 0)) return {};
        carried = values_[i] - ratio * carried;
        squares += carried * carried / pivot;
        product *= pivot;
        if (product < 1e-200 || product > 1e200) { // a logarithm for many pivots at a time
            logarithms += std::log(product);
            product = 1;
        }
    }
    logarithms += std::log(product);
    const double sill = squares / static_cast<double>(n);
    if (!(sill > 0)) return {};
    return {-(static_cast<double>(n) * std::log(sill) + logarithms) / 2, sill};
}

LikelyNugget TridiagonalKernel::most_likely() const {
    LikelyNugget best;
    double best_at = 0;
    constexpr double least = 1e-10, most = 1e3; // nuggets in mean variances of contrasts
    const double low = std::log(least), high = std::log(most);
    const auto attempt = [&](double exponent) {
        const double nugget = scale_ * std::exp(exponent);
        const Profile found = profile(nugget);
        if (!(found.likelihood > best.likelihood)) return;
        best = {found.likelihood, found.sill, found.sill * nugget};
        best_at = exponent;
    };
    constexpr int steps = 48, halvings = 3;
    double step = (high - low) / steps;
    for (int k = 0; k <= steps; ++k) attempt(low + k * step);
    for (int k = 0; k < halvings; ++k) {
        step /= 2;
        const double middle = best_at;
        attempt(std::max(low, middle - step));
        attempt(middle + step);
    }
    return best;
}

bool cholesky(MatrixXd& matrix, const Run& run) {
    constexpr Index panel = 128;
    const Index n = matrix.rows();
    for (Index k = 0; k < n; k += panel) {
        if (run.stop.stop_requested()) return false;
        const Index width = std::min(panel, n - k), rest = n - k - width;
        Eigen::Ref<MatrixXd> corner = matrix.block(k, k, width, width);
        const Eigen::LLT<Eigen::Ref<MatrixXd>> in_place(corner);
        if (in_place.info() != Eigen::Success) return false;
        if (rest == 0) break;
        Eigen::Ref<MatrixXd> below = matrix.block(k + width, k, rest, width);
        corner.transpose().triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(below);
        matrix.bottomRightCorner(rest, rest).selfadjointView<Eigen::Lower>().rankUpdate(below, -1);
    }
    return true;
}

void divide_by_factor(const MatrixXd& factor, MatrixXd& columns) {
    factor.triangularView<Eigen::Lower>().solveInPlace(columns);
}

void divide_by_transposed(const MatrixXd& factor, MatrixXd& columns) {
    factor.transpose().triangularView<Eigen::Upper>().solveInPlace(columns);
}

MatrixXd squared(const MatrixXd& matrix) {
    MatrixXd result = MatrixXd::Zero(matrix.cols(), matrix.cols());
    result.selfadjointView<Eigen::Lower>().rankUpdate(matrix.transpose());
    result.triangularView<Eigen::StrictlyUpper>() = result.transpose();
    return result;
}

MatrixXd inverse_of(MatrixXd matrix) {
    if (!cholesky(matrix, {})) return {};
    MatrixXd half = MatrixXd::Identity(matrix.rows(), matrix.cols());
    divide_by_factor(matrix, half);
    return squared(half);
}

} // namespace terrane
