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

/// Logarithms of the nuggets that are tried, in mean variances of contrasts: 1e-10 and 1e3.
constexpr double least_nugget = -23.02585092994046, most_nugget = 6.907755278982137;

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

TridiagonalKernel::TridiagonalKernel(const MatrixXd& kernel, const VectorXd& contrasts,
                                     std::vector<Index> trends) :
    trends_(std::move(trends)) {
    const Eigen::Tridiagonalization<MatrixXd> form(kernel);
    diagonal_ = form.diagonal();
    beside_ = form.subDiagonal();
    scale_ = std::max(diagonal_.mean(), std::numeric_limits<double>::min());
    MatrixXd columns = MatrixXd::Zero(contrasts.size(), most_columns);
    Index next = trends_.back();
    columns.topLeftCorner(next, next).setIdentity();
    for (const Index trend : trends_)
        columns.col(next++).tail(contrasts.size() - trend) =
            contrasts.tail(contrasts.size() - trend);
    columns.applyOnTheLeft(form.matrixQ().adjoint());
    for (Index i = 0; i < columns.rows(); ++i) rows_.emplace_back(columns.row(i));
}

/// Computes the likelihood of contrasts without those of a trend from that of all: the determinant
/// grows by that of the trend's generalised least squares, whose residual gives the sill.
std::vector<LikelyNugget> TridiagonalKernel::profile(double nugget) const {
    const Index n = diagonal_.size(), most = trends_.back();
    double pivot = 0, logarithms = 0, product = 1;
    Columns carried = Columns::Zero();
    Eigen::Matrix<double, most_columns, most_columns> products;
    products.setZero();
    for (Index i = 0; i < n; ++i) {
        const double ratio = i == 0 ? 0 : beside_[i - 1] / pivot;
        pivot = diagonal_[i] + nugget - (i == 0 ? 0 : ratio * beside_[i - 1]);
        if (!(pivot > 0)) return {};
        carried = rows_[static_cast<std::size_t>(i)] - ratio * carried;
        products.noalias() += (carried / pivot) * carried.transpose();
        product *= pivot;
        if (product < 1e-200 || product > 1e200) { // a logarithm for many pivots at a time
            logarithms += std::log(product);
            product = 1;
        }
    }
    logarithms += std::log(product);
    // The factor of the trends' products, row by row.
    for (Index j = 0; j < most; ++j) {
        products(j, j) = std::sqrt(products(j, j));
        products.row(j).tail(most_columns - j - 1) /= products(j, j);
        for (Index k = j + 1; k < most; ++k)
            products.row(k).tail(most_columns - k) -=
                products(j, k) * products.row(j).tail(most_columns - k);
    }
    std::vector<LikelyNugget> found(trends_.size());
    for (std::size_t t = 0; t < trends_.size(); ++t) {
        const Index trend = trends_[t], column = most + static_cast<Index>(t);
        const auto count = static_cast<double>(n - trend);
        const double squares =
            products(column, column) - products.col(column).head(trend).squaredNorm();
        const double sill = squares / count;
        const double all = logarithms + 2 * products.diagonal().head(trend).array().log().sum();
        if (sill > 0) found[t] = {-(count * std::log(sill) + all) / 2, sill, sill * nugget};
    }
    return found;
}

std::vector<LikelyNugget> TridiagonalKernel::most_likely() const {
    std::vector<LikelyNugget> best(trends_.size());
    std::vector<double> best_at(trends_.size());
    const auto attempt = [&](double exponent) {
        const auto found = profile(scale_ * std::exp(exponent));
        for (std::size_t t = 0; t < found.size(); ++t) {
            if (!(found[t].likelihood > best[t].likelihood)) continue;
            best[t] = found[t];
            best_at[t] = exponent;
        }
    };
    constexpr int steps = 48, halvings = 3;
    double step = (most_nugget - least_nugget) / steps;
    for (int k = 0; k <= steps; ++k) attempt(least_nugget + k * step);
    for (int k = 0; k < halvings; ++k) {
        step /= 2;
        for (const double middle : std::vector(best_at)) {
            attempt(std::max(least_nugget, middle - step));
            attempt(middle + step);
        }
    }
    return best;
}

double TridiagonalKernel::nugget_leaving(double squares) const {
    const Index n = diagonal_.size(), column = trends_.back();
    const auto left = [&](double nugget) { // nugget times the weights, by elimination
        std::vector<double> pivots, carried;
        for (Index i = 0; i < n; ++i) {
            const double ratio = i == 0 ? 0 : beside_[i - 1] / pivots.back();
            pivots.push_back(diagonal_[i] + nugget - (i == 0 ? 0 : ratio * beside_[i - 1]));
            carried.push_back(rows_[static_cast<std::size_t>(i)][column] -
                              (i == 0 ? 0 : ratio * carried.back()));
        }
        double sum = 0, weight = 0;
        for (Index i = n; i-- > 0;) {
            const auto k = static_cast<std::size_t>(i);
            weight = (carried[k] - (i + 1 < n ? beside_[i] * weight : 0)) / pivots[k];
            sum += nugget * nugget * weight * weight;
        }
        return sum;
    };
    double low = least_nugget, high = most_nugget;
    for (int k = 0; k < 40; ++k) {
        const double middle = (low + high) / 2;
        (left(scale_ * std::exp(middle)) < squares ? low : high) = middle;
    }
    return scale_ * std::exp(high);
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

MatrixXd inverse_of_factor(const MatrixXd& factor) {
    constexpr Index panel = 32;
    const Index n = factor.rows();
    MatrixXd inverse = MatrixXd::Identity(n, n);
    for (Index k = 0; k < n; k += panel) { // columns are 0 above their diagonal
        Eigen::Ref<MatrixXd> columns = inverse.block(k, k, n - k, std::min(panel, n - k));
        factor.bottomRightCorner(n - k, n - k).triangularView<Eigen::Lower>().solveInPlace(columns);
    }
    return inverse;
}

} // namespace terrane
