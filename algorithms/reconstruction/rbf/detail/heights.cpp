// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/heights.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/height_system.hpp>

namespace terrane::rbf::detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::span<const double> values_of(const VectorXd& vector) {
    return {vector.data(), static_cast<std::size_t>(vector.size())};
}

using Blocks = std::vector<std::vector<Index>>;

/// All centres, scaled.
struct HeightData {
    std::vector<Point3> places, border;
    std::vector<double> distances; ///< per place: from the border, not scaled
    double radius = 0;             ///< of the hole
    double beside = 0;             ///< data nearer to the border than this are left out at once
    double stretch = 1;            ///< of places across the main direction; 1 / that along it

    /// Tells whether places are no farther from each other than the hole's radius.
    [[nodiscard]] bool are_near(const Point3& p, const Point3& q) const {
        return length_in_plane((p.x - q.x) * stretch, (p.y - q.y) / stretch) <= radius;
    }
};

/// Lists what is left out at a time: the data nearer to a place of the border than the hole's
/// radius.
Blocks blocks_of(std::span<const Point3> data, const HeightData& of) {
    Blocks blocks;
    for (const auto c : well_spread_in_plane(of.border, constants.height_blocks)) {
        std::vector<Index> block;
        for (std::size_t i = 0; i < data.size(); ++i)
            if (of.are_near(data[i], of.border[c])) block.push_back(static_cast<Index>(i));
        const double most = constants.most_of_all * static_cast<double>(data.size());
        if (!block.empty() && static_cast<double>(block.size()) <= most)
            blocks.push_back(std::move(block));
    }
    return blocks;
}

/// Computes what is missed of a block: its heights without what the other data predict.
VectorXd missed_of(const std::vector<Index>& block, const MatrixXd& projection,
                   const VectorXd& weights) {
    return projection(block, block).partialPivLu().solve(weights(block));
}

/// Computes the root mean square of the errors at blocks; NaN without blocks.
double missed_blocks(const MatrixXd& projection, const VectorXd& weights, const Blocks& blocks) {
    double squares = 0, count = 0;
    for (const auto& block : blocks) {
        squares += missed_of(block, projection, weights).squaredNorm();
        count += static_cast<double>(block.size());
    }
    return std::sqrt(squares / count);
}

/// A form and how it does with the trial data. Errors are scaled, and NaN if nothing is left out.
struct HeightTrial {
    HeightForm form;
    double likelihood = -HUGE_VAL;
    double sill = 0;
    /// Root mean square error of the data next to the hole, all of them left out at once.
    double beside = std::numeric_limits<double>::quiet_NaN();
    double missed = beside; ///< the same of blocks as wide as the hole, left out in turn
};

/// Steps (2) and (3).
class HeightChoice {
public:
    HeightChoice(const HeightData& data, unsigned degree, const Run& run) :
        degree_(degree), run_(run) {
        std::vector<Index> near;
        for (const auto i :
             well_spread_pairs(data.places, constants.height_trial, constants.height_pairs)
                 .chosen) {
            if (data.distances[i] < data.beside) near.push_back(static_cast<Index>(some_.size()));
            some_.push_back(data.places[i]);
        }
        if (!near.empty() && near.size() < some_.size()) beside_.push_back(near);
        blocks_ = blocks_of(some_, data);
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
            // The data may as well be noise about the polynomial.
            const NoiseAlone alone(system.contrasts());
            const double share = alone.probability_of(likely, 1);
            trial.sill = std::max(share, constants.least_share) * likely.sill;
            trial.form.nugget = (share * likely.nugget + (1 - share) * alone.variance) / trial.sill;
        }
        if (!system.factorise(trial.form.nugget, run_)) return std::nullopt;
        const MatrixXd projection = system.projection();
        const VectorXd weights = system.weights();
        trial.beside = missed_blocks(projection, weights, beside_);
        trial.missed = missed_blocks(projection, weights, blocks_);
        return trial;
    }

    void raise_degree() {
        for (const unsigned degree : constants.degrees) {
            if (degree == 1 || run_.stop.stop_requested()) continue;
            if (static_cast<Index>(constants.centres_per_term) * terms_of(degree) >
                static_cast<Index>(some_.size()))
                return;
            const auto trial = attempt(RbfKernel::cubic, degree);
            if (trial && trial->beside < constants.worth_degree * best_.beside &&
                !(trial->missed > best_.missed)) // it does not go astray farther off
                best_ = *trial;
        }
    }

    unsigned degree_; ///< 0: the best
    const Run& run_;
    std::vector<Point3> some_;
    Blocks beside_, blocks_;
    HeightTrial best_;
};

/// Well-spread data of which blocks can be left out.
std::optional<HeightSystem> some_heights(const HeightData& data, const HeightForm& form,
                                         const Run& run) {
    std::vector<Point3> some;
    for (const auto i : well_spread_in_plane(data.places, constants.height_validation))
        some.push_back(data.places[i]);
    HeightSystem system(some, form.kernel, form.degree);
    if (!system.determined() || !system.factorise(form.nugget, run)) return std::nullopt;
    return system;
}

/// Validates a fit by blocks of some of its data, left out in turn, and finds the share of its
/// nugget that is noise: the weights have the covariance P if all of it is.
/// `ground` is the height at which scaled heights are 0.
void validate(const HeightData& data, double unit, double ground, HeightFit& fit) {
    if (!fit.some) return;
    const MatrixXd projection = fit.some->projection();
    const VectorXd weights = fit.some->weights();
    const double up = fit.axes[2].z == -1 ? -1 : 1; // heights along -z become those along z
    double squares = 0, count = 0;
    for (const auto& block : blocks_of(fit.some->data(), data)) {
        const VectorXd errors = missed_of(block, projection, weights);
        squares += errors.squaredNorm();
        count += static_cast<double>(block.size());
        for (std::size_t i = 0; i < block.size(); ++i) {
            const double height =
                ground + unit * fit.some->data()[static_cast<std::size_t>(block[i])].z;
            const double error = unit * errors(static_cast<Index>(i));
            fit.left_out.push_back({up * height, up * (height - error)});
        }
    }
    fit.validated = unit * std::sqrt(squares / count);
    const double share = weights.squaredNorm() / (fit.sill * projection.trace());
    if (share < constants.least_noise_share) fit.noise_share = share;
}

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
                    length_in_plane(points[i].x - points[j].x, points[i].y - points[j].y))
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
    HeightSystem system; ///< factorised with the nugget of the form
    VectorXd weights, polynomial;
    double nugget = 0, condition = 0, freedom = 0;
};

/// Factorises a system, with a larger nugget if it is singular. Returns the nugget; none if that
/// does not help or the run is stopped.
std::optional<double> factorised(HeightSystem& system, double nugget, const Run& run) {
    const double scale = system.between_contrasts().diagonal().mean();
    for (double share = constants.least_addition; !system.factorise(nugget, run);
         share *= constants.addition_growth) {
        if (share > constants.most_addition || run.stop.stop_requested()) return std::nullopt;
        nugget += share * scale;
    }
    return nugget;
}

std::optional<GraphSolution> solve_graph(std::span<const Point3> places, const HeightForm& form,
                                         const Smoothing& smoothing, const Run& run) {
    GraphSolution solution{HeightSystem(places, form.kernel, form.degree), {}, {}, form.nugget};
    HeightSystem& system = solution.system;
    if (!system.determined()) return std::nullopt;
    const auto count = static_cast<Index>(places.size());
    if (smoothing.wanted) {
        const TridiagonalKernel kernel(system.between_contrasts(), system.contrasts());
        if (smoothing.rms > 0) solution.nugget = nugget_for(kernel, smoothing.rms, count);
        solution.freedom =
            static_cast<double>(terms_of(form.degree)) + kernel.freedom(solution.nugget);
    }
    const auto nugget = factorised(system, solution.nugget, run);
    if (!nugget) return std::nullopt;
    solution.nugget = *nugget;
    solution.weights = system.weights();
    solution.polynomial = system.polynomial();
    solution.condition = system.condition();
    if (smoothing.rms > 0 && !factorised(system, form.nugget, run)) return std::nullopt;
    return solution;
}

/// Turns the first axis into the main direction of a variogram, and stretches both so that
/// distances across it count for more. An area stays as large.
std::array<Point3, 3> stretched(const std::array<Point3, 3>& axes, double angle, double stretch) {
    const double a = angle * std::numbers::pi / 180, c = std::cos(a), s = std::sin(a);
    const auto sum = [&](double u, double v) {
        return Point3{u * axes[0].x + v * axes[1].x, u * axes[0].y + v * axes[1].y,
                      u * axes[0].z + v * axes[1].z};
    };
    return {sum(c / stretch, s / stretch), sum(-s * stretch, c * stretch), axes[2]};
}

Point3 along_axes(const Point3& p, const std::array<Point3, 3>& axes) {
    return {dot(p, axes[0]), dot(p, axes[1]), dot(p, axes[2])};
}

Point3 scaled(const RbfFunction& f, const Point3& p) {
    const auto [u, v, w] = f.scaled(p);
    return {u, v, w};
}

/// Tells whether expected errors are those of the fit's own model.
bool is_believed(const HeightFit& fit) {
    // The noise of the fit may be roughness across one direction, which the fit does not know.
    if (fit.noise > constants.most_own_noise * fit.kriging->noise() + fit.rounding) return false;
    if (!(fit.kriging->validated() < constants.worth_own * fit.validated)) return true;
    // The errors at blocks are noise for the greater part: the rest counts.
    const double noise = fit.kriging->noise() * fit.kriging->noise();
    const double theirs = fit.kriging->validated() * fit.kriging->validated() - noise;
    const double own = fit.validated * fit.validated - fit.noise * fit.noise;
    return theirs > constants.least_excess * noise &&
           theirs > constants.worth_own * constants.worth_own * own;
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
    for (const Point3& p : data.points) heights.push_back(along_axes(p, axes));
    std::vector<Point3> centres, upright;
    HeightData centre_data;
    for (const auto i : height_centres(data, heights, most)) {
        centres.push_back(data.points[i]);
        upright.push_back(heights[i]);
        centre_data.distances.push_back(data.distances[i]);
    }
    if (has_cliff(upright)) return std::nullopt;
    HeightFit fit;
    fit.axes = axes;
    fit.kriging.emplace(heights, data.next.size(), data.radius, run);
    const auto [angle, ratio] = fit.kriging->anisotropy();
    centre_data.stretch = 1 / std::sqrt(ratio);
    RbfPolynomial basis{options.degree > 0 ? options.degree : 1,
                        stretched(axes, angle, centre_data.stretch)};
    if (!fit.f.smooth.set_centres(centres, basis)) return std::nullopt;
    const double unit = fit.f.smooth.unit();
    for (const Point3& p : centres) centre_data.places.push_back(scaled(fit.f.smooth, p));
    for (const Point3& p : std::span(data.points).first(data.next.size()))
        centre_data.border.push_back(scaled(fit.f.smooth, p));
    centre_data.radius = data.radius / unit;
    centre_data.beside = beside_hole(data);
    // A polynomial of high degree might miss the data by less than is wanted.
    const unsigned degree = options.smoothing.value_or(0) > 0 ? basis.degree : options.degree;
    const HeightTrial chosen = HeightChoice(centre_data, degree, run)();
    Smoothing smoothing{options.smoothing.has_value(), options.smoothing.value_or(0) / unit};
    auto solution = solve_graph(centre_data.places, chosen.form, smoothing, run);
    if (!solution) return std::nullopt;
    basis.degree = chosen.form.degree;
    fit.f.smooth.set_graph(basis.degree, {chosen.form.kernel, values_of(solution->weights),
                                          values_of(solution->polynomial)});
    fit.kernel = chosen.form.kernel;
    fit.noise = unit * std::sqrt(chosen.form.nugget * chosen.sill);
    fit.some = some_heights(centre_data, chosen.form, run);
    fit.sill = chosen.sill;
    validate(centre_data, unit, upright[0].z - unit * centre_data.places[0].z, fit);
    fit.known.emplace(std::move(solution->system));
    fit.rounding = rounding_of(heights);
    report.data = data.points.size();
    report.centres = centres.size();
    report.degree = basis.degree;
    report.freedom = solution->freedom;
    const double unknown = std::numeric_limits<double>::quiet_NaN(); // nothing is refined
    report.solution = {centres.size(), solution->condition, 0, unknown, unknown};
    RbfOptions smoothed = options;
    smoothed.smoothing = 0; // errors are noted, no more
    interpolate_rest(fit.f, data, smoothed, {}, report, run);
    fit.believed = is_believed(fit);
    return fit;
}

void interpolate_noise(HeightFit& fit, const RbfData& data, const RbfOptions& options,
                       RbfReport& report, const Run& run) {
    interpolate_rest(fit.f, data, options, {constants.noise_reach * data.edge, fit.axes[2]}, report,
                     run);
}

std::vector<double> expected_errors(const HeightFit& fit, std::span<const Point3> points,
                                    const Run& run) {
    if (!fit.kriging->determined())
        return std::vector<double>(points.size(), std::numeric_limits<double>::quiet_NaN());
    std::vector<Point3> places;
    if (!fit.believed) {
        for (const Point3& p : points) places.push_back(along_axes(p, fit.axes));
        return fit.kriging->at(places, run);
    }
    for (const Point3& p : points) places.push_back(scaled(fit.f.smooth, p));
    const auto n = static_cast<double>(fit.known->size());
    const bool many = n * n * static_cast<double>(places.size()) > constants.most_operations;
    const auto deviations =
        (many && fit.some ? *fit.some : *fit.known).deviations(places, fit.noise_share, run);
    const auto values = fit.known->values(places);
    const double unit = fit.f.smooth.unit(), root = std::sqrt(fit.sill);
    std::vector<double> errors;
    for (std::size_t i = 0; i < places.size(); ++i)
        errors.push_back(std::hypot(unit * root * deviations[i], unit * (values[i] - places[i].z),
                                    fit.rounding));
    return errors;
}

std::vector<double> heights_of(const HeightFit& fit, std::span<const Point3> places,
                               const Run& run) {
    std::vector<double> heights(places.size());
    for_ranges(
        places.size(), run,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last && !run.stop.stop_requested(); ++i) {
                const Point3 p{places[i].x, places[i].y, 0};
                heights[i] = -fit.f.smooth(p) * fit.axes[2].z; // f is w - g
            }
        },
        4, 64);
    return heights;
}

} // namespace terrane::rbf::detail
