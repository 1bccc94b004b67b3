// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Approximation of values (smooth_rbf() of function.hpp): ridge regression in coordinates in which
// the energy is the sum of squares, so that one decomposition serves all amounts of smoothing.
#include <terrane/algorithms/reconstruction/rbf/detail/function.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <terrane/algorithms/reconstruction/rbf/detail/constants.hpp>

namespace terrane::rbf::detail {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// The spectrum of the regression, from which the error of smoothing by any `lambda` follows.
struct Spectrum {
    Vector values;     ///< eigenvalues of the normal matrix, >= 0
    Vector loads;      ///< squares of the right-hand side in the eigenvectors
    double beyond = 0; ///< squared error that no weights can reduce
    double count = 0;  ///< number of values
    double terms = 0;  ///< number of terms of the polynomial

    [[nodiscard]] double squares(double lambda) const {
        double sum = beyond;
        for (Eigen::Index i = 0; i < values.size(); ++i) {
            const double left = lambda / (values[i] + lambda);
            if (values[i] > 0) sum += loads[i] / values[i] * left * left;
        }
        return sum;
    }
    [[nodiscard]] double freedom(double lambda) const {
        return terms + (values.array() / (values.array() + lambda)).sum();
    }
    [[nodiscard]] double rms(double lambda) const { return std::sqrt(squares(lambda) / count); }
};

/// Lists values of lambda from almost no smoothing to the polynomial alone, a quarter of a decade
/// apart.
std::vector<double> degrees_of(const Spectrum& s) {
    const double unit = s.values.size() > 0 ? s.values.maxCoeff() : 1;
    std::vector<double> all;
    for (double e = constants.least_lambda; e <= constants.most_lambda; e += constants.lambda_step)
        all.push_back((unit > 0 ? unit : 1) * std::pow(10.0, e));
    return all;
}

/// Chooses lambda by generalised cross-validation. Each degree of freedom counts 1.4 times, so that
/// noise is hardly ever taken for shape (Kim and Gu 2004).
double cross_validated(const Spectrum& s) {
    double best = degrees_of(s).back(), least = HUGE_VAL;
    for (const double lambda : degrees_of(s)) {
        const double left = s.count - constants.freedom_weight * s.freedom(lambda);
        if (!(left > 0)) continue;
        if (const double score = s.squares(lambda) / (left * left); score < least) {
            least = score;
            best = lambda;
        }
    }
    return best;
}

/// Finds lambda for a given root mean square error by bisection; the error increases with lambda.
double missing_by(const Spectrum& s, double rms) {
    const auto degrees = degrees_of(s);
    double low = std::log(degrees.front()), high = std::log(degrees.back());
    for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        (s.rms(std::exp(middle)) < rms ? low : high) = middle;
    }
    return std::exp(low);
}

double cubed(const std::array<double, 3>& p, const std::array<double, 3>& q) {
    const double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
    const double square = x * x + y * y + z * z;
    return square * std::sqrt(square);
}

/// Computes |p - q|^3 for each p and q.
Matrix kernel_between(const std::vector<std::array<double, 3>>& p,
                      const std::vector<std::array<double, 3>>& q) {
    const auto index = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
    Matrix kernel(index(p.size()), index(q.size()));
    for (std::size_t j = 0; j < q.size(); ++j)
        for (std::size_t i = 0; i < p.size(); ++i) kernel(index(i), index(j)) = cubed(p[i], q[j]);
    return kernel;
}

/// Weights of the centres that are orthogonal to the polynomials, in coordinates s in which the
/// energy is |s|^2.
class Weights {
public:
    Weights(Matrix kernel, const Matrix& terms) :
        terms_(terms), n_(kernel.rows()), m_(terms.cols()) {
        kernel.applyOnTheLeft(terms_.householderQ().transpose());
        kernel.applyOnTheRight(terms_.householderQ());
        energy_.compute(kernel.bottomRightCorner(n_ - m_, n_ - m_));
    }
    [[nodiscard]] bool ok() const { return energy_.info() == Eigen::Success; }
    [[nodiscard]] Vector of(const Vector& s) const {
        Vector weights = Vector::Zero(n_);
        weights.tail(n_ - m_) = energy_.matrixU().solve(s);
        weights.applyOnTheLeft(terms_.householderQ());
        return weights;
    }
    /// Converts columns for weights to columns for s: rows times of(s), for any s.
    [[nodiscard]] Matrix columns_for(Matrix rows) const {
        rows.applyOnTheRight(terms_.householderQ());
        return energy_.matrixU().solve<Eigen::OnTheRight>(rows.rightCols(n_ - m_));
    }

private:
    Eigen::HouseholderQR<Matrix> terms_;
    Eigen::Index n_, m_;
    Eigen::LLT<Matrix> energy_;
};

/// Least squares fit of values by columns and a polynomial, with |s|^2 as penalty for the columns.
class Ridge {
public:
    Ridge(Matrix columns, const Matrix& terms, Vector values) :
        columns_(std::move(columns)), values_(std::move(values)), terms_(terms),
        count_(columns_.rows()), m_(terms.cols()) {
        const Matrix base = terms_.householderQ() * Matrix::Identity(count_, m_);
        const Matrix across = columns_ - base * (base.transpose() * columns_);
        const Vector wanted = values_ - base * (base.transpose() * values_);
        Matrix normal = Matrix::Zero(columns_.cols(), columns_.cols()); // its lower half
        normal.selfadjointView<Eigen::Lower>().rankUpdate(across.transpose());
        directions_.compute(normal);
        right_ = directions_.eigenvectors().transpose() * (across.transpose() * wanted);
        spectrum_ = {directions_.eigenvalues(), right_.cwiseAbs2(), wanted.squaredNorm(),
                     static_cast<double>(count_), static_cast<double>(m_)};
        const double noise = // of the decomposition itself
            constants.eigenvalue_noise * spectrum_.values.maxCoeff();
        for (Eigen::Index i = 0; i < spectrum_.values.size(); ++i) {
            double& value = spectrum_.values[i];
            if (!(value > noise)) value = 0;
            if (value > 0) spectrum_.beyond -= spectrum_.loads[i] / value;
        }
        spectrum_.beyond = std::max(spectrum_.beyond, 0.0);
    }
    [[nodiscard]] bool ok() const { return terms_.rank() == m_; }
    [[nodiscard]] const Spectrum& spectrum() const { return spectrum_; }
    [[nodiscard]] Vector solve(double lambda) const {
        return directions_.eigenvectors() *
               (right_.array() / (spectrum_.values.array() + lambda)).matrix();
    }
    [[nodiscard]] Vector polynomial(const Vector& s) const {
        return terms_.solve(values_ - columns_ * s);
    }

private:
    Matrix columns_;
    Vector values_;
    Eigen::ColPivHouseholderQR<Matrix> terms_;
    Eigen::Index count_, m_;
    Eigen::SelfAdjointEigenSolver<Matrix> directions_;
    Vector right_; ///< of the normal equations, in the eigenvectors
    Spectrum spectrum_;
};

} // namespace

Result<RbfSmoothFit> smooth_rbf(std::span<const Point3> centres, std::span<const Point3> points,
                                std::span<const double> values, const RbfPolynomial& polynomial,
                                double rms, const Run& run) {
    const auto bad = [](const char* what) { return Error{ErrorCode::bad_option, what, ""}; };
    if (polynomial.degree < 1 || polynomial.degree > 8)
        return bad("the degree of the polynomial is 1 to 8");
    if (centres.size() <= polynomial.terms() || points.size() < centres.size() ||
        values.size() != points.size())
        return bad("too few points for radial basis functions");
    RbfSmoothFit fit;
    RbfFunction& f = fit.function;
    if (!f.set_centres(centres, polynomial)) return bad("all points are the same");
    const auto scaled = [&](std::span<const Point3> all) {
        std::vector<std::array<double, 3>> result;
        for (const Point3& p : all) result.push_back(f.scaled(p));
        return result;
    };
    const auto terms = [&](const std::vector<std::array<double, 3>>& at) {
        Matrix transposed(static_cast<Eigen::Index>(polynomial.terms()),
                          static_cast<Eigen::Index>(at.size()));
        for (std::size_t i = 0; i < at.size(); ++i)
            f.terms_at(at[i], transposed.col(static_cast<Eigen::Index>(i)).data());
        return Matrix(transposed.transpose());
    };
    // 1. The functions that the weights can represent at the points.
    const auto centre_places = scaled(centres), places = scaled(points);
    const Weights weights(kernel_between(centre_places, centre_places), terms(centre_places));
    if (!weights.ok()) return bad("points are too near together");
    const Matrix columns = weights.columns_for(kernel_between(places, centre_places));
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    // 2. How much smoothing.
    Vector wanted(static_cast<Eigen::Index>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
        wanted[static_cast<Eigen::Index>(i)] = values[i] / f.scale_;
    const Ridge ridge(columns, terms(places), wanted);
    if (!ridge.ok()) return bad("a polynomial is 0 at all points");
    const Spectrum& spectrum = ridge.spectrum();
    const double lambda =
        rms > 0 ? missing_by(spectrum, rms / f.scale_) : cross_validated(spectrum);
    // 3. The function.
    const Vector s = ridge.solve(lambda), polynomial_part = ridge.polynomial(s);
    const Vector chosen = weights.of(s);
    f.weights_.assign(chosen.begin(), chosen.end());
    f.polynomial_.assign(polynomial_part.begin(), polynomial_part.end());
    fit.rms = f.scale_ * spectrum.rms(lambda);
    fit.freedom = spectrum.freedom(lambda);
    fit.nugget = lambda * f.scale_ * f.scale_ * f.scale_;
    return fit;
}

} // namespace terrane::rbf::detail
