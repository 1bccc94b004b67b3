// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/function.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <Eigen/QR>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/constants.hpp>

namespace terrane::rbf::detail {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// An unevaluated sum of two doubles, of about 106 bits. It tracks no error bound, unlike
/// DoubleDouble, and takes a third of the time. Source: Dekker (1971).
struct Pair {
    double high = 0, low = 0;
};

/// Adds two doubles without error.
Pair exact_sum(double a, double b) {
    const double s = a + b, t = s - a;
    return {s, (a - (s - t)) + (b - t)};
}

/// Multiplies two doubles without error, unless the product underflows.
Pair exact_product(double a, double b) {
    const double p = a * b;
    return {p, std::fma(a, b, -p)};
}

Pair plus(const Pair& a, const Pair& b) {
    const Pair s = exact_sum(a.high, b.high);
    return exact_sum(s.high, s.low + (a.low + b.low));
}

Pair times(const Pair& a, const Pair& b) {
    const Pair p = exact_product(a.high, b.high);
    return exact_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

struct System {
    Matrix points; ///< n x 3, scaled
    Vector values;
    Matrix terms; ///< n x m: terms of the polynomial at each point
};

/// The kernel of each pair j < i of points, by increasing i and j: to about 100 bits.
using WideKernel = std::vector<Pair>;

WideKernel wide_kernel(const Matrix& points) {
    const Eigen::Index n = points.rows();
    WideKernel kernel;
    kernel.reserve(static_cast<std::size_t>(n * (n - 1) / 2));
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < i; ++j) {
            Pair square;
            for (Eigen::Index k = 0; k < 3; ++k) {
                const Pair d = exact_sum(points(i, k), -points(j, k));
                square = plus(square, times(d, d));
            }
            const double root = std::sqrt(square.high); // followed by one Newton step
            const Pair left = plus(square, exact_product(-root, root));
            kernel.push_back(root > 0 ? times(square, exact_sum(root, left.high / (2 * root)))
                                      : Pair{});
        }
    return kernel;
}

/// Computes values - (kernel weights + polynomial), each entry summed in about 106 bits; something
/// else if the run is stopped.
Vector residual(const System& s, const WideKernel& kernel, const Vector& weights,
                const Vector& polynomial, const Run& run) {
    const Eigen::Index n = s.values.size();
    std::vector<Pair> sums(static_cast<std::size_t>(n));
    const auto subtract = [&](Eigen::Index i, const Pair& product) {
        Pair& sum = sums[static_cast<std::size_t>(i)];
        sum = plus(sum, {-product.high, -product.low});
    };
    for (Eigen::Index i = 0; i < n; ++i) {
        sums[static_cast<std::size_t>(i)] = {s.values[i], 0};
        for (Eigen::Index k = 0; k < polynomial.size(); ++k)
            subtract(i, exact_product(s.terms(i, k), polynomial[k]));
    }
    auto pair = kernel.begin();
    for (Eigen::Index i = 0; i < n && !run.stop.stop_requested(); ++i)
        for (Eigen::Index j = 0; j < i; ++j, ++pair) { // the kernel is symmetric
            subtract(i, times(*pair, {weights[j], 0}));
            subtract(j, times(*pair, {weights[i], 0}));
        }
    Vector result(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const Pair& sum = sums[static_cast<std::size_t>(i)];
        result[i] = sum.high + sum.low;
    }
    return result;
}

Matrix kernel_matrix(const Matrix& points) {
    const Eigen::Index n = points.rows();
    Matrix kernel(n, n);
    for (Eigen::Index j = 0; j < n; ++j)
        for (Eigen::Index i = 0; i <= j; ++i) {
            const double square = (points.row(i) - points.row(j)).squaredNorm();
            kernel(i, j) = kernel(j, i) = square * std::sqrt(square);
        }
    return kernel;
}

/// The factorised system. Its weights are orthogonal to the polynomials.
class Solver {
public:
    Solver(const System& system, Matrix rotated) : qr_(system.terms), m_(system.terms.cols()) {
        const Eigen::Index n = rotated.rows();
        rotated.applyOnTheLeft(qr_.householderQ().transpose());
        rotated.applyOnTheRight(qr_.householderQ());
        rows_ = rotated.topRightCorner(m_, n - m_);
        factor_.compute(rotated.bottomRightCorner(n - m_, n - m_));
    }
    [[nodiscard]] bool ok() const {
        const Vector r = qr_.matrixQR().diagonal().head(m_).cwiseAbs();
        return r.minCoeff() > constants.singular * r.maxCoeff() && factor_.info() == Eigen::Success;
    }
    [[nodiscard]] double condition() const { return 1 / factor_.rcond(); }

    /// Adds the solution for this right-hand side to weights and polynomial.
    void add_solution(const Vector& right, Vector& weights, Vector& polynomial) const {
        Vector rotated = right;
        rotated.applyOnTheLeft(qr_.householderQ().transpose());
        const Eigen::Index n = right.size();
        Vector part = Vector::Zero(n);
        part.tail(n - m_) = factor_.solve(rotated.tail(n - m_));
        const Vector rest = rotated.head(m_) - rows_ * part.tail(n - m_);
        polynomial +=
            qr_.matrixQR().topLeftCorner(m_, m_).triangularView<Eigen::Upper>().solve(rest);
        part.applyOnTheLeft(qr_.householderQ());
        weights += part;
    }

private:
    Eigen::HouseholderQR<Matrix> qr_;
    Eigen::Index m_; ///< number of terms of the polynomial
    Matrix rows_;    ///< of the rotated kernel: from the complement to polynomials
    Eigen::LLT<Matrix> factor_;
};

/// Solves the system and refines the solution while that helps.
void solve(const System& system, const Solver& solver, Vector& weights, Vector& polynomial,
           unsigned most_refinements, RbfSolution& solution, const Run& run) {
    solver.add_solution(system.values, weights, polynomial);
    solution.first_residual = solution.residual = std::numeric_limits<double>::quiet_NaN();
    if (most_refinements == 0) return;
    const WideKernel kernel = wide_kernel(system.points);
    Vector left = residual(system, kernel, weights, polynomial, run);
    solution.first_residual = solution.residual = left.cwiseAbs().maxCoeff();
    for (unsigned k = 0; k < most_refinements && !run.stop.stop_requested(); ++k) {
        if (solution.residual == 0) return;
        Vector better = weights, polynomial_better = polynomial;
        solver.add_solution(left, better, polynomial_better);
        const Vector next = residual(system, kernel, better, polynomial_better, run);
        const double largest = next.cwiseAbs().maxCoeff();
        if (!(largest < solution.residual)) return;
        const bool enough = largest > constants.least_refinement * solution.residual;
        weights = better;
        polynomial = polynomial_better;
        left = next;
        solution.residual = largest;
        ++solution.refinements;
        if (enough) return;
    }
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

Result<RbfFit> fit_rbf(std::span<const Point3> points, std::span<const double> values,
                       const RbfSetting& setting, const Run& run) {
    const auto bad = [](const char* what) { return Error{ErrorCode::bad_option, what, ""}; };
    const RbfPolynomial& basis = setting.polynomial;
    if (basis.degree < 1 || basis.degree > 8) return bad("the degree of the polynomial is 1 to 8");
    const std::size_t m = basis.terms();
    if (points.size() <= m || values.size() != points.size())
        return bad("too few points for radial basis functions");
    RbfFit fit;
    RbfFunction& f = fit.function;
    if (!f.set_centres(points, basis)) return bad("all points are the same");
    const auto n = static_cast<Eigen::Index>(points.size());
    const auto terms = static_cast<Eigen::Index>(m);
    System system{Matrix(n, 3), Vector(n), Matrix(n, terms)};
    Vector row(terms);
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto k = static_cast<std::size_t>(i);
        system.points.row(i) << f.x_[k], f.y_[k], f.z_[k];
        system.values[i] = values[k] / f.scale_;
        f.terms_at({f.x_[k], f.y_[k], f.z_[k]}, row.data());
        system.terms.row(i) = row.transpose();
    }
    const Solver solver(system, kernel_matrix(system.points));
    if (!solver.ok())
        return bad("a polynomial is 0 at all points, or points are too near together");
    Vector weights = Vector::Zero(n), polynomial = Vector::Zero(static_cast<Eigen::Index>(m));
    solve(system, solver, weights, polynomial, setting.most_refinements, fit.solution, run);
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    f.weights_.assign(weights.begin(), weights.end());
    f.polynomial_.assign(polynomial.begin(), polynomial.end());
    fit.solution.centres = points.size();
    fit.solution.condition = solver.condition();
    fit.solution.residual *= f.scale_;
    fit.solution.first_residual *= f.scale_;
    return fit;
}

} // namespace terrane::rbf::detail
