// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>

namespace terrane {
namespace {

using kriging::detail::constants;

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

} // namespace

NoiseAlone::NoiseAlone(const VectorXd& contrasts) {
    const auto n = static_cast<double>(contrasts.size());
    price = std::log(n) / 2;
    variance = contrasts.squaredNorm() / n;
    if (variance > 0) likelihood = -n * std::log(variance) / 2;
}

double NoiseAlone::probability_of(const LikelyNugget& likely, double parameters) const {
    return 1 / (1 + std::exp(likelihood + parameters * price - likely.likelihood));
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

LikelyNugget TridiagonalKernel::most_likely(double most_nugget) const {
    LikelyNugget best;
    double best_at = 0;
    const double low = std::log(constants.least_noise), high = std::log(constants.most_noise);
    const auto attempt = [&](double exponent) {
        const double nugget = scale_ * std::exp(exponent);
        const Profile found = profile(nugget);
        if (!(found.likelihood > best.likelihood)) return;
        if (exponent > low && found.sill * nugget > most_nugget) return;
        best = {found.likelihood, found.sill, found.sill * nugget};
        best_at = exponent;
    };
    double step = (high - low) / constants.noise_steps;
    for (int k = 0; k <= constants.noise_steps; ++k) attempt(low + k * step);
    for (int k = 0; k < constants.noise_halvings; ++k) {
        step /= 2;
        const double middle = best_at;
        attempt(std::max(low, middle - step));
        attempt(middle + step);
    }
    return best;
}

double TridiagonalKernel::missed(double nugget) const {
    const Index n = diagonal_.size();
    VectorXd pivots(n), solved(n);
    for (Index i = 0; i < n; ++i) {
        const double ratio = i == 0 ? 0 : beside_[i - 1] / pivots[i - 1];
        pivots[i] = diagonal_[i] + nugget - (i == 0 ? 0 : ratio * beside_[i - 1]);
        solved[i] = values_[i] - (i == 0 ? 0 : ratio * solved[i - 1]);
    }
    for (Index i = n - 1; i >= 0; --i)
        solved[i] = (solved[i] - (i + 1 == n ? 0 : beside_[i] * solved[i + 1])) / pivots[i];
    return nugget * solved.norm();
}

double TridiagonalKernel::freedom(double nugget) const {
    // The trace of the inverse is the derivative of the logarithm of the determinant.
    double pivot = 0, slope = 0, trace = 0;
    for (Index i = 0; i < diagonal_.size(); ++i) {
        const double square = i == 0 ? 0 : beside_[i - 1] * beside_[i - 1];
        const double before = i == 0 ? 1 : pivot;
        slope = 1 + square * slope / (before * before);
        pivot = diagonal_[i] + nugget - square / before;
        trace += slope / pivot;
    }
    return static_cast<double>(diagonal_.size()) - nugget * trace;
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

std::vector<std::uint32_t> well_spread_in_plane(std::span<const Point3> points, std::size_t count) {
    std::vector<std::uint32_t> chosen;
    if (points.size() <= count) {
        for (std::uint32_t i = 0; i < points.size(); ++i) chosen.push_back(i);
        return chosen;
    }
    Point3 mean;
    for (const Point3& p : points) {
        const auto n = static_cast<double>(points.size());
        mean = {mean.x + p.x / n, mean.y + p.y / n, mean.z + p.z / n};
    }
    // Squares of distances, in a unit in which they can't overflow.
    double extent = 0;
    for (const Point3& p : points)
        extent = std::max({extent, std::abs(p.x - mean.x), std::abs(p.y - mean.y)});
    const int exponent = extent > 0 && std::isfinite(extent) ? std::ilogb(extent) : 0;
    std::vector<double> x, y, distance;
    for (const Point3& p : points) {
        x.push_back(std::ldexp(p.x - mean.x, -exponent));
        y.push_back(std::ldexp(p.y - mean.y, -exponent));
        distance.push_back(x.back() * x.back() + y.back() * y.back());
    }
    constexpr double equal = 1 - 2e-9; // squares differ by more than rounding
    while (chosen.size() < count) {
        const double farthest = *std::max_element(distance.begin(), distance.end());
        if (!(farthest > 0)) break;
        std::uint32_t best = 0;
        double height = -1;
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            if (distance[i] < equal * farthest) continue;
            const double off = std::abs(points[i].z - mean.z);
            if (off <= height) continue;
            best = i;
            height = off;
        }
        if (chosen.empty())
            std::fill(distance.begin(), distance.end(), std::numeric_limits<double>::infinity());
        chosen.push_back(best);
        const double from_x = x[best], from_y = y[best];
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double dx = x[i] - from_x, dy = y[i] - from_y, square = dx * dx + dy * dy;
            distance[i] = square < distance[i] ? square : distance[i];
        }
    }
    return chosen;
}

SpreadPairs well_spread_pairs(std::span<const Point3> points, std::size_t count,
                              std::size_t pairs) {
    SpreadPairs result{well_spread_in_plane(points, count), 0};
    std::vector<bool> taken(points.size(), false);
    for (const auto i : result.chosen) taken[i] = true;
    double mean = 0;
    for (const Point3& p : points) mean += p.z / static_cast<double>(points.size());
    std::vector<double> gaps;
    pairs = std::min(pairs, result.chosen.size());
    for (std::size_t k = 0; k < pairs; ++k) {
        const Point3 p = points[result.chosen[k]];
        constexpr double equal = 1 + 1e-9; // distances differ by more than rounding
        double least = std::numeric_limits<double>::infinity();
        auto best = static_cast<std::uint32_t>(points.size());
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            const double d = length_in_plane(points[i].x - p.x, points[i].y - p.y);
            if (taken[i] || !(d > 0) || d > equal * least) continue;
            const bool better = best == points.size() || d * equal < least ||
                                std::abs(points[i].z - mean) > std::abs(points[best].z - mean);
            least = std::min(least, d);
            if (better) best = i;
        }
        if (best == points.size()) continue;
        taken[best] = true;
        gaps.push_back(least);
        result.chosen.push_back(best);
    }
    if (gaps.empty()) return result;
    const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
    std::nth_element(gaps.begin(), middle, gaps.end());
    result.gap = *middle;
    return result;
}

double rounding_of(std::span<const Point3> data, unsigned degree) {
    double largest = 0;
    for (const Point3& p : data) largest = std::max(largest, std::abs(p.z));
    const double unit = std::nextafter(largest, HUGE_VAL) - largest;
    // Of the true height, of the estimate, and of a sum before it, and as much again for squares; each
    // is spread evenly over a unit. That of the data averages out.
    return unit * std::sqrt(3.0 * degree / 12);
}

} // namespace terrane
