// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/function.hpp>

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>

namespace terrane::rbf::detail {
namespace {

/// Computes the kernel between all pairs of points, whose coordinates are rows.
Eigen::MatrixXd kernel_of(const Eigen::MatrixXd& points) {
    const Eigen::Index n = points.cols();
    Eigen::MatrixXd kernel(n, n);
    for (Eigen::Index j = 0; j < n; ++j)
        for (Eigen::Index i = 0; i <= j; ++i) {
            const double square = (points.col(i) - points.col(j)).squaredNorm();
            kernel(i, j) = kernel(j, i) = square * std::sqrt(square);
        }
    return kernel;
}

/// Finds the nugget with which values are missed by this root mean square, or the likeliest if it is
/// 0.
double nugget_for(double missed, const Eigen::MatrixXd& kernel, const Eigen::VectorXd& contrasts,
                  std::size_t values) {
    const TridiagonalKernel form(kernel, contrasts, {0});
    if (missed > 0) return form.nugget_leaving(missed * missed * static_cast<double>(values));
    const auto likely = form.most_likely()[0];
    return likely.sill > 0 ? likely.nugget / likely.sill : 0;
}

/// Calls use(i, j, k) for each term u^i v^j w^k.
template <class Use>
void for_each_term(const RbfPolynomial& basis, const Use& use) {
    const unsigned most = basis.in_space ? basis.degree : 0;
    for (unsigned k = 0; k <= most; ++k)
        for (unsigned i = 0; i + k <= basis.degree; ++i)
            for (unsigned j = 0; i + j + k <= basis.degree; ++j) use(i, j, k);
    if (!basis.in_space) use(0U, 0U, 1U);
}

/// The powers 0 to 8 of each coordinate.
struct Powers {
    explicit Powers(const std::array<double, 3>& p) {
        for (unsigned c = 0; c < 3; ++c) {
            of[c][0] = 1;
            for (unsigned e = 1; e < 9; ++e) of[c][e] = of[c][e - 1] * p[c];
        }
    }
    std::array<std::array<double, 9>, 3> of;
};

} // namespace

std::array<double, 3> RbfFunction::scaled(const Point3& p) const {
    const Point3 d{(p.x - middle_.x) / scale_, (p.y - middle_.y) / scale_,
                   (p.z - middle_.z) / scale_};
    return {dot(d, basis_.axes[0]), dot(d, basis_.axes[1]), dot(d, basis_.axes[2])};
}

bool RbfFunction::set_centres(std::span<const Point3> centres, const RbfPolynomial& basis) {
    basis_ = basis;
    Point3 low = centres[0], high = centres[0];
    for (const Point3& p : centres) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    middle_ = {(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2};
    scale_ = std::max({high.x - low.x, high.y - low.y, high.z - low.z}) / 2;
    if (!(scale_ > 0)) return false;
    for (const Point3& p : centres) {
        const auto [u, v, w] = scaled(p);
        x_.push_back(u);
        y_.push_back(v);
        z_.push_back(w);
    }
    return true;
}

void RbfFunction::terms_at(const std::array<double, 3>& p, double* terms) const {
    const auto powers = Powers(p).of;
    for_each_term(basis_, [&](unsigned i, unsigned j, unsigned k) {
        *terms++ = powers[0][i] * powers[1][j] * powers[2][k];
    });
}

double RbfFunction::operator()(const Point3& p) const {
    if (polynomial_.empty()) return 0;
    const auto [u, v, w] = scaled(p);
    using Array = Eigen::Map<const Eigen::ArrayXd>;
    const auto n = static_cast<Eigen::Index>(x_.size());
    const Array cx(x_.data(), n), cy(y_.data(), n), cz(z_.data(), n), c(weights_.data(), n);
    const auto square = (cx - u).square() + (cy - v).square() + (cz - w).square();
    double sum = (c * square * square.sqrt()).sum();
    const auto powers = Powers({u, v, w}).of;
    auto factor = polynomial_.begin();
    for_each_term(basis_, [&](unsigned i, unsigned j, unsigned k) {
        sum += *factor++ * (powers[0][i] * powers[1][j] * powers[2][k]);
    });
    return scale_ * sum;
}

Point3 RbfFunction::gradient(const Point3& p) const {
    if (polynomial_.empty()) return {};
    const auto [u, v, w] = scaled(p);
    using Array = Eigen::Map<const Eigen::ArrayXd>;
    const auto n = static_cast<Eigen::Index>(x_.size());
    const Array cx(x_.data(), n), cy(y_.data(), n), cz(z_.data(), n), c(weights_.data(), n);
    const auto square = (cx - u).square() + (cy - v).square() + (cz - w).square();
    const Eigen::ArrayXd slopes = 3 * c * square.sqrt();
    std::array<double, 3> g{(slopes * (u - cx)).sum(), (slopes * (v - cy)).sum(),
                            (slopes * (w - cz)).sum()};
    const auto powers = Powers({u, v, w}).of;
    auto factor = polynomial_.begin();
    for_each_term(basis_, [&](unsigned i, unsigned j, unsigned k) {
        const double a = *factor++;
        if (i > 0) g[0] += a * i * (powers[0][i - 1] * powers[1][j] * powers[2][k]);
        if (j > 0) g[1] += a * j * (powers[0][i] * powers[1][j - 1] * powers[2][k]);
        if (k > 0) g[2] += a * k * (powers[0][i] * powers[1][j] * powers[2][k - 1]);
    });
    const auto& axes = basis_.axes;
    return {g[0] * axes[0].x + g[1] * axes[1].x + g[2] * axes[2].x,
            g[0] * axes[0].y + g[1] * axes[1].y + g[2] * axes[2].y,
            g[0] * axes[0].z + g[1] * axes[1].z + g[2] * axes[2].z};
}

Result<RbfFunction> RbfFunction::fitted(std::span<const Point3> points,
                                        std::span<const double> values,
                                        const RbfPolynomial& polynomial,
                                        std::optional<double> smoothing, const Run& run) {
    const auto bad = [](const char* what) { return Error{ErrorCode::bad_option, what, ""}; };
    if (polynomial.degree < 1 || polynomial.degree > 8)
        return bad("the degree of the polynomial is 1 to 8");
    if (points.size() <= polynomial.terms() || values.size() != points.size())
        return bad("too few points for radial basis functions");
    RbfFunction f;
    if (!f.set_centres(points, polynomial)) return bad("all points are the same");
    const auto n = static_cast<Eigen::Index>(points.size()),
               m = static_cast<Eigen::Index>(polynomial.terms());
    Eigen::MatrixXd places(3, n), terms(m, n);
    Eigen::VectorXd numbers(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto k = static_cast<std::size_t>(i);
        places.col(i) << f.x_[k], f.y_[k], f.z_[k];
        f.terms_at({f.x_[k], f.y_[k], f.z_[k]}, terms.col(i).data());
        numbers[i] = values[k] / f.scale_;
    }
    const Contrasts basis(terms.transpose());
    if (!basis.determined()) return bad("a polynomial is 0 at all points");
    Eigen::MatrixXd kernel = kernel_of(places);
    basis.apply_twice(kernel);
    basis.apply(numbers);
    Eigen::MatrixXd factor = kernel.bottomRightCorner(n - m, n - m);
    if (smoothing)
        factor.diagonal().array() +=
            nugget_for(*smoothing / f.scale_, factor, numbers.tail(n - m), points.size());
    const bool solvable = cholesky(factor, run);
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    const Eigen::VectorXd pivots = factor.diagonal();
    if (!solvable || !(pivots.minCoeff() > 1e-8 * pivots.maxCoeff()))
        return bad("points are too near together");
    Eigen::MatrixXd solved = numbers.tail(n - m);
    divide_by_factor(factor, solved);
    divide_by_transposed(factor, solved);
    const Eigen::VectorXd trend =
        basis.trend_of(numbers.head(m) - kernel.topRightCorner(m, n - m) * solved);
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(n);
    weights.tail(n - m) = solved;
    basis.undo(weights);
    f.weights_.assign(weights.begin(), weights.end());
    f.polynomial_.assign(trend.begin(), trend.end());
    return f;
}

} // namespace terrane::rbf::detail
