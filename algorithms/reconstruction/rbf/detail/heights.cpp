// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/heights.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/constants.hpp>

namespace terrane::rbf::detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What g is made of.
struct HeightForm {
    RbfKernel kernel = RbfKernel::cubic;
    unsigned degree = 1;
    double nugget = 0; ///< variance of single data, in factors of the kernel
};

std::span<const double> values_of(const VectorXd& vector) {
    return {vector.data(), static_cast<std::size_t>(vector.size())};
}

double kernel_of(RbfKernel kernel, double square) {
    if (kernel == RbfKernel::linear) return -std::sqrt(square);
    if (kernel == RbfKernel::cubic) return square * std::sqrt(square);
    return square > 0 ? square * std::log(square) / 2 : 0;
}

Index terms_of(unsigned degree) {
    return static_cast<Index>((degree + 1) * (degree + 2) / 2);
}

/// The contrasts of some data, and the kernel between them. `places`: x and y are those in the
/// plane, z is the height.
class HeightSystem {
public:
    HeightSystem(std::span<const Point3> places, RbfKernel kernel, unsigned degree) :
        heights_(static_cast<Index>(places.size())) {
        const Index n = heights_.size(), m = terms_of(degree);
        MatrixXd terms(n, m);
        kernels_.resize(n, n);
        for (Index i = 0; i < n; ++i) {
            const Point3& p = places[static_cast<std::size_t>(i)];
            heights_[i] = p.z;
            for (Index j = 0; j <= i; ++j) {
                const Point3& q = places[static_cast<std::size_t>(j)];
                const double du = p.x - q.x, dv = p.y - q.y;
                kernels_(i, j) = kernels_(j, i) = kernel_of(kernel, du * du + dv * dv);
            }
            Index term = 0;
            double up = 1;
            for (unsigned a = 0; a <= degree; ++a, up *= p.x) {
                double both = up;
                for (unsigned b = 0; a + b <= degree; ++b, both *= p.y) terms(i, term++) = both;
            }
        }
        qr_.compute(terms);
        kernels_.applyOnTheLeft(qr_.householderQ().adjoint());
        kernels_.applyOnTheRight(qr_.householderQ());
        heights_.applyOnTheLeft(qr_.householderQ().adjoint());
        m_ = m;
    }

    /// Tells whether the data determine the polynomial.
    [[nodiscard]] bool determined() const {
        const VectorXd r = qr_.matrixQR().diagonal().head(m_).cwiseAbs();
        return r.minCoeff() > constants.singular * r.maxCoeff();
    }
    /// Tells whether the data are the polynomial up to rounding.
    [[nodiscard]] bool polynomial_only() const {
        return !(contrasts().cwiseAbs().maxCoeff() > constants.height_rounding);
    }
    [[nodiscard]] MatrixXd between_contrasts() const {
        const Index k = heights_.size() - m_;
        return kernels_.bottomRightCorner(k, k);
    }
    [[nodiscard]] VectorXd contrasts() const { return heights_.tail(heights_.size() - m_); }

    /// Factorises. Returns false if the matrix is not positive definite or the run is stopped.
    bool factorise(double nugget, const Run& run) {
        factor_ = between_contrasts();
        factor_.diagonal().array() += nugget;
        return cholesky(factor_, run);
    }
    /// The weights of the kernels.
    [[nodiscard]] VectorXd weights() const {
        VectorXd weights = VectorXd::Zero(heights_.size());
        weights.tail(factor_.rows()) = solved();
        weights.applyOnTheLeft(qr_.householderQ());
        return weights;
    }
    /// The factors of the polynomial's terms.
    [[nodiscard]] VectorXd polynomial() const {
        const VectorXd rest =
            heights_.head(m_) - kernels_.topRightCorner(m_, factor_.rows()) * solved();
        return qr_.matrixQR().topLeftCorner(m_, m_).triangularView<Eigen::Upper>().solve(rest);
    }
    /// The matrix P for which P z are the weights.
    [[nodiscard]] MatrixXd projection() const {
        const Index n = heights_.size();
        MatrixXd half = MatrixXd::Zero(n - m_, n);
        half.rightCols(n - m_).setIdentity();
        factor_.triangularView<Eigen::Lower>().solveInPlace(half);
        half.applyOnTheRight(qr_.householderQ().adjoint());
        return half.transpose() * half;
    }
    /// Ratio of the largest and the least entry of the diagonal of the factor, squared: a lower
    /// bound of the condition.
    [[nodiscard]] double condition() const {
        const double ratio = factor_.diagonal().maxCoeff() / factor_.diagonal().minCoeff();
        return ratio * ratio;
    }

private:
    [[nodiscard]] VectorXd solved() const {
        VectorXd solved = contrasts();
        factor_.triangularView<Eigen::Lower>().solveInPlace(solved);
        factor_.transpose().triangularView<Eigen::Upper>().solveInPlace(solved);
        return solved;
    }

    VectorXd heights_; ///< rotated: m for the polynomial, then the contrasts
    MatrixXd kernels_; ///< rotated
    Eigen::HouseholderQR<MatrixXd> qr_;
    MatrixXd factor_;
    Index m_ = 0;
};

using Blocks = std::vector<std::vector<Index>>;

/// Lists what is left out at a time: the data nearer to a place of the border than the hole's
/// radius.
Blocks blocks_of(std::span<const Point3> data, std::span<const Point3> border, double radius) {
    Blocks blocks;
    for (const auto c : well_spread_in_plane(border, constants.height_blocks)) {
        std::vector<Index> block;
        for (std::size_t i = 0; i < data.size(); ++i)
            if (std::hypot(data[i].x - border[c].x, data[i].y - border[c].y) <= radius)
                block.push_back(static_cast<Index>(i));
        const double most = constants.most_of_all * static_cast<double>(data.size());
        if (!block.empty() && static_cast<double>(block.size()) <= most)
            blocks.push_back(std::move(block));
    }
    return blocks;
}

/// Computes the root mean square over blocks of what is missed of them; NaN if there are none.
double missed_blocks(const HeightSystem& system, const Blocks& blocks) {
    const MatrixXd projection = system.projection();
    const VectorXd weights = system.weights();
    double squares = 0, count = 0;
    for (const auto& block : blocks) {
        const VectorXd errors = projection(block, block).partialPivLu().solve(weights(block));
        squares += errors.squaredNorm();
        count += static_cast<double>(block.size());
    }
    return std::sqrt(squares / count);
}

/// A form and how it does with the trial data. Errors are scaled, and NaN if nothing is left out.
struct HeightTrial {
    HeightForm form;
    double likelihood = -HUGE_VAL;
    double sill = 0;
    double missed = std::numeric_limits<double>::quiet_NaN(); ///< of blocks as wide as the hole
    double beside = missed; ///< of the data next to the hole, all of them at once
};

/// All centres, scaled.
struct HeightData {
    std::vector<Point3> places, border;
    std::vector<double> distances; ///< per place: from the border, not scaled
    double radius = 0;             ///< of the hole
    double beside = 0;             ///< data nearer to the border than this are left out at once
};

/// Steps (2) and (3).
class HeightChoice {
public:
    HeightChoice(const HeightData& data, unsigned degree, const Run& run) :
        degree_(degree), run_(run) {
        std::vector<Index> near;
        for (const auto i : well_spread_in_plane(data.places, constants.height_trial)) {
            if (data.distances[i] < data.beside) near.push_back(static_cast<Index>(some_.size()));
            some_.push_back(data.places[i]);
        }
        blocks_ = blocks_of(some_, data.border, data.radius);
        if (!near.empty() && near.size() < some_.size()) beside_.push_back(near);
    }

    HeightTrial operator()() {
        best_.form.degree = std::max(degree_, 1U);
        for (const auto kernel : {RbfKernel::linear, RbfKernel::thin_plate, RbfKernel::cubic}) {
            if (run_.stop.stop_requested()) return best_;
            const auto trial = attempt(kernel, best_.form.degree);
            if (trial && (best_.sill == 0 || trial->likelihood > best_.likelihood)) best_ = *trial;
        }
        if (degree_ == 0 && best_.form.kernel == RbfKernel::cubic) raise_degree();
        return best_;
    }

private:
    [[nodiscard]] std::optional<HeightTrial> attempt(RbfKernel kernel, unsigned degree) const {
        if (static_cast<Index>(some_.size()) < terms_of(degree) + 2) return std::nullopt;
        HeightSystem system(some_, kernel, degree);
        if (!system.determined()) return std::nullopt;
        HeightTrial trial{{kernel, degree, 0}};
        if (!system.polynomial_only()) {
            const TridiagonalKernel form(system.between_contrasts(), system.contrasts());
            const LikelyNugget likely = form.most_likely(HUGE_VAL);
            if (!(likely.sill > 0)) return std::nullopt;
            trial.likelihood = likely.likelihood;
            trial.sill = likely.sill;
            trial.form.nugget = likely.nugget / likely.sill;
        }
        if (!system.factorise(trial.form.nugget, run_)) return std::nullopt;
        trial.missed = missed_blocks(system, blocks_);
        trial.beside = missed_blocks(system, beside_);
        return trial;
    }

    void raise_degree() {
        for (const unsigned degree : constants.degrees) {
            if (degree == 1 || run_.stop.stop_requested()) continue;
            if (static_cast<Index>(constants.centres_per_term) * terms_of(degree) >
                static_cast<Index>(some_.size()))
                return;
            const auto trial = attempt(RbfKernel::cubic, degree);
            if (trial && trial->beside < constants.worth_degree * best_.beside) best_ = *trial;
        }
    }

    unsigned degree_; ///< 0: the best
    const Run& run_;
    std::vector<Point3> some_;
    Blocks blocks_, beside_;
    HeightTrial best_;
};

/// Returns the distance from the border of the data that are left out at once.
double beside_hole(const RbfData& data) {
    const double most = *std::max_element(data.distances.begin(), data.distances.end());
    return std::max(
        std::min(constants.left_out_width * data.radius, most / constants.left_out_part),
        constants.left_out_edges * data.edge);
}

/// Step (1). `heights`: all data in the plane; those on the border are first.
std::vector<std::uint32_t> height_centres(const RbfData& data, std::span<const Point3> heights,
                                          std::size_t most) {
    std::vector<std::uint32_t> centres, others;
    if (heights.size() <= most) {
        for (std::uint32_t i = 0; i < heights.size(); ++i) centres.push_back(i);
        return centres;
    }
    auto distances = data.distances;
    const auto half = distances.begin() + static_cast<std::ptrdiff_t>(most / 2);
    std::nth_element(distances.begin(), half, distances.end());
    constexpr double less = 1 - 1e-9; // distances differ by more than rounding
    for (std::uint32_t i = 0; i < heights.size(); ++i)
        (data.distances[i] < less * *half ? centres : others).push_back(i);
    const auto spread = [&](const std::vector<std::uint32_t>& of, std::size_t count) {
        std::vector<Point3> points;
        for (const auto i : of) points.push_back(heights[i]);
        for (const auto i : well_spread_in_plane(points, count)) centres.push_back(of[i]);
    };
    if (centres.empty()) { // the border alone has more
        for (std::uint32_t i = 0; i < data.next.size(); ++i) others[i] = i;
        spread({others.begin(), others.begin() + static_cast<std::ptrdiff_t>(data.next.size())},
               most / 2);
        others.clear();
        for (auto i = static_cast<std::uint32_t>(data.next.size()); i < heights.size(); ++i)
            others.push_back(i);
    }
    spread(others, most - centres.size());
    std::sort(centres.begin(), centres.end());
    return centres;
}

/// Tells whether two of the points are almost above each other.
bool has_cliff(std::span<const Point3> points) {
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (std::fabs(points[i].z - points[j].z) >
                constants.steepest_graph *
                    std::hypot(points[i].x - points[j].x, points[i].y - points[j].y))
                return true;
    return false;
}

/// Finds the nugget for which the centres are missed by this root mean square.
double nugget_for(const TridiagonalKernel& kernel, double rms, Index count) {
    double low = std::log(1e-13), high = std::log(1e6);
    const double wanted = rms * std::sqrt(static_cast<double>(count));
    for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        (kernel.missed(kernel.scale() * std::exp(middle)) < wanted ? low : high) = middle;
    }
    return kernel.scale() * std::exp(low);
}

/// How far the data may be missed.
struct Smoothing {
    bool wanted = false;
    double rms = 0; ///< 0: as the nugget says
};

/// Step (4): a graph from all centres.
struct GraphSolution {
    VectorXd weights, polynomial;
    double nugget = 0, condition = 0, freedom = 0;
};

std::optional<GraphSolution> solve_graph(std::span<const Point3> places, const HeightForm& form,
                                         const Smoothing& smoothing, const Run& run) {
    HeightSystem system(places, form.kernel, form.degree);
    if (!system.determined()) return std::nullopt;
    GraphSolution solution;
    solution.nugget = form.nugget;
    const auto count = static_cast<Index>(places.size());
    if (smoothing.wanted) {
        const TridiagonalKernel kernel(system.between_contrasts(), system.contrasts());
        if (smoothing.rms > 0) solution.nugget = nugget_for(kernel, smoothing.rms, count);
        solution.freedom =
            static_cast<double>(terms_of(form.degree)) + kernel.freedom(solution.nugget);
    }
    const double scale = system.between_contrasts().diagonal().mean();
    for (double share = constants.least_addition; !system.factorise(solution.nugget, run);
         share *= constants.addition_growth) {
        if (share > constants.most_addition || run.stop.stop_requested()) return std::nullopt;
        solution.nugget += share * scale;
    }
    solution.weights = system.weights();
    solution.polynomial = system.polynomial();
    solution.condition = system.condition();
    return solution;
}

} // namespace

std::optional<std::array<Point3, 3>> graph_axes(const RbfData& data) {
    const auto own = axes_of(data);
    const double up = own[2].z < 0 ? -1 : 1;
    const std::array<Point3, 3> upright{{{1, 0, 0}, {0, up, 0}, {0, 0, up}}};
    if (is_graph_along(data, upright[2])) return upright;
    if (is_graph_along(data, own[2])) return own;
    return std::nullopt;
}

std::optional<HeightFit> fit_heights(const RbfData& data, const std::array<Point3, 3>& axes,
                                     const RbfOptions& options, RbfReport& report, const Run& run) {
    const std::size_t most = options.smoothing
                                 ? std::min(options.most_centres, constants.most_smoothed_heights)
                                 : options.most_centres;
    std::vector<Point3> heights;
    for (const Point3& p : data.points)
        heights.push_back({dot(p, axes[0]), dot(p, axes[1]), dot(p, axes[2])});
    std::vector<Point3> centres;
    HeightData centre_data;
    for (const auto i : height_centres(data, heights, most)) {
        centres.push_back(data.points[i]);
        centre_data.distances.push_back(data.distances[i]);
    }
    HeightFit fit;
    RbfPolynomial basis{options.degree > 0 ? options.degree : 1, axes};
    if (!fit.f.smooth.set_centres(centres, basis)) return std::nullopt;
    const auto scaled = [&](std::span<const Point3> points) {
        std::vector<Point3> places;
        for (const Point3& p : points) {
            const auto [u, v, w] = fit.f.smooth.scaled(p);
            places.push_back({u, v, w});
        }
        return places;
    };
    const double unit = fit.f.smooth.unit();
    centre_data.places = scaled(centres);
    centre_data.border = scaled(std::span(data.points).first(data.next.size()));
    centre_data.radius = data.radius / unit;
    centre_data.beside = beside_hole(data);
    if (has_cliff(centre_data.places)) return std::nullopt;
    const HeightTrial chosen = HeightChoice(centre_data, options.degree, run)();
    Smoothing smoothing{options.smoothing.has_value(), options.smoothing.value_or(0) / unit};
    const auto solution = solve_graph(centre_data.places, chosen.form, smoothing, run);
    if (!solution) return std::nullopt;
    basis.degree = chosen.form.degree;
    fit.f.smooth.set_graph(basis.degree, {chosen.form.kernel, values_of(solution->weights),
                                          values_of(solution->polynomial)});
    fit.kernel = chosen.form.kernel;
    fit.noise = unit * std::sqrt(chosen.form.nugget * chosen.sill);
    fit.validated = unit * chosen.missed;
    report.data = data.points.size();
    report.centres = centres.size();
    report.degree = basis.degree;
    report.freedom = solution->freedom;
    const double unknown = std::numeric_limits<double>::quiet_NaN(); // nothing is refined
    report.solution = {centres.size(), solution->condition, 0, unknown, unknown};
    interpolate_rest(fit.f, data, options, {constants.noise_reach * data.edge, axes[2]}, report,
                     run);
    return fit;
}

} // namespace terrane::rbf::detail
