// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/fit.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/holes/flatness.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/constants.hpp>

namespace terrane::rbf::detail {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

Point3 along(const Point3& p, double d, const Point3& direction) {
    return {p.x + d * direction.x, p.y + d * direction.y, p.z + d * direction.z};
}

/// Returns the number of centres with which step (2) starts.
std::size_t start_size(const RbfOptions& options) {
    return std::max(constants.least_start, options.most_centres / constants.start_part);
}

/// Selects up to `count` points, each as far as possible from those before it.
std::vector<std::uint32_t> well_spread(const std::vector<Point3>& points, std::size_t count) {
    std::vector<std::uint32_t> chosen{0};
    std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
    while (chosen.size() < count) {
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            const Point3 d = minus(points[i], points[chosen.back()]);
            distance[i] = std::min(distance[i], dot(d, d));
        }
        const auto farthest = std::max_element(distance.begin(), distance.end());
        if (!(*farthest > 0)) break;
        chosen.push_back(static_cast<std::uint32_t>(farthest - distance.begin()));
    }
    return chosen;
}

/// The data that all forms have in common.
struct Start {
    /// `tree`: of the data's triangles; `count`: of centres.
    Start(const RbfData& data, const TriangleTree& tree, const RbfOptions& options,
          std::size_t count) :
        centres(well_spread(data.points, count)),
        with_offset(std::min(start_size(options), centres.size())),
        offset(std::max(data.radius / constants.offset_part, constants.offset_edges * data.edge)),
        surface(tree) {}

    std::vector<std::uint32_t> centres; ///< well spread, each as far as possible from those before
    std::size_t with_offset;            ///< number of the first centres with offset constraints
    double offset;                      ///< distance of offset constraints
    const TriangleTree& surface;
};

std::vector<double> errors_at_data(const Implicit& f, const RbfData& data, const Run& run) {
    std::vector<double> errors(data.points.size(), 0);
    for_ranges(errors.size(), run, [&](std::size_t a, std::size_t b) {
        for (std::size_t i = a; i < b; ++i) errors[i] = f(data.points[i]);
    });
    return errors;
}

void note_errors(const std::vector<double>& errors, RbfReport& report) {
    double most = 0, squares = 0;
    for (const double e : errors) {
        most = std::max(most, std::fabs(e));
        squares += e * e;
    }
    report.largest_error = most;
    report.rms_error = std::sqrt(squares / static_cast<double>(errors.size()));
}

/// Step (4): adds what is left of the data, if any exceeds the tolerance. With options.smoothing,
/// reports it only.
void add_rest(Implicit& f, const RbfData& data, const RbfOptions& options, RbfReport& report,
              const Run& run) {
    auto errors = errors_at_data(f, data, run);
    note_errors(errors, report);
    report.missed = report.largest_error;
    if (options.smoothing || !(report.missed > data.edge * constants.tolerance)) return;
    for (double& e : errors) e = -e;
    f.rest = std::make_shared<NearbyRest>(data.points, std::move(errors),
                                          constants.rest_reach * data.edge);
    note_errors(errors_at_data(f, data, run), report);
}

/// Steps (2) and (3).
class Fitter {
public:
    Fitter(const RbfData& data, const Start& start, const RbfForm& form, const RbfOptions& options,
           RbfReport& report) :
        data_(data),
        start_(start), form_(form), options_(options), report_(report) {}

    Result<Implicit> operator()(const Run& run) {
        report_.data = data_.points.size();
        report_.centres = start_.centres.size();
        auto smoothing = options_.smoothing;
        if (form_.smoothed && !smoothing) smoothing = 0;
        for (const std::uint32_t i : start_.centres) {
            points_.push_back(data_.points[i]);
            values_.push_back(0);
        }
        // Near noisy data, offset constraints would be dominated by the noise.
        report_.offset = form_.along_axis && smoothing
                             ? std::max(start_.offset, constants.noisy_offset * data_.radius)
                             : start_.offset;
        for (std::size_t k = 0; k < start_.with_offset; ++k)
            for (const double side : {-1.0, 1.0})
                add_offset(start_.centres[k], side * report_.offset);
        if (run.progress) run.progress("rbf", 0);
        auto fitted = RbfFunction::fitted(points_, values_, form_.polynomial, smoothing, run);
        if (!fitted) return fitted.error();
        return Implicit{std::move(*fitted), {}};
    }

private:
    /// Adds the constraint f = d at distance d, if the surface is about as far from there as
    /// expected; otherwise tries shorter distances.
    void add_offset(std::uint32_t i, double d) {
        const Point3& normal = data_.normals[i];
        if (normal == Point3{}) return;
        const Point3 direction = form_.along_axis ? form_.polynomial.axes[2] : normal;
        if (dot(direction, normal) < constants.graph_cosine) return;
        const double share = constants.least_distance * dot(direction, normal);
        for (unsigned k = 0; k < constants.offset_halvings; ++k, d /= 2) {
            const Point3 p = along(data_.points[i], d, direction);
            if (start_.surface.distance(p, std::fabs(d)) < share * std::fabs(d)) continue;
            points_.push_back(p);
            values_.push_back(d);
            ++report_.offsets;
            return;
        }
    }

    const RbfData& data_;
    const Start& start_;
    const RbfForm& form_;
    const RbfOptions& options_;
    RbfReport& report_;
    std::vector<Point3> points_; ///< of the constraints
    std::vector<double> values_;
};

LeftOut leave_out(const RbfData& data) {
    const double most = *std::max_element(data.distances.begin(), data.distances.end());
    LeftOut result;
    result.width =
        std::max(std::min(constants.left_out_width * data.radius, most / constants.left_out_part),
                 constants.left_out_edges * data.edge);
    RbfData& kept = result.kept;
    std::vector<std::uint32_t> name(data.points.size(), UINT32_MAX);
    for (std::uint32_t i = 0; i < data.points.size(); ++i) {
        if (data.distances[i] < result.width) {
            result.points.push_back(i);
            continue;
        }
        name[i] = static_cast<std::uint32_t>(kept.points.size());
        kept.points.push_back(data.points[i]);
        kept.normals.push_back(data.normals[i]);
        kept.distances.push_back(data.distances[i]);
    }
    for (const Triangle& t : data.triangles)
        if (name[t[0]] != UINT32_MAX && name[t[1]] != UINT32_MAX && name[t[2]] != UINT32_MAX)
            kept.triangles.push_back({name[t[0]], name[t[1]], name[t[2]]});
    kept.edge = data.edge;
    kept.radius = data.radius;
    const std::size_t count = result.points.size();
    for (std::size_t k = 0; k < std::min(count, constants.most_judged); ++k)
        result.points[k] = result.points[k * count / std::min(count, constants.most_judged)];
    result.points.resize(std::min(count, constants.most_judged));
    return result;
}

/// The error of a form at the data left out.
struct Trial {
    double missed = no_number;                     ///< root mean square; NaN if the fit failed
    std::vector<std::array<double, 2>> left_out{}; ///< FillReport::left_out
};

/// The data left out, and the data that all trials share.
struct Trials {
    Trials(const RbfData& all, const RbfOptions& given) :
        data(all), left(leave_out(all)), tree(left.kept.points, left.kept.triangles),
        options(given), start(left.kept, tree, options, start_size(options)) {}

    const RbfData& data;
    LeftOut left;
    TriangleTree tree; ///< of the remaining data
    const RbfOptions& options;
    Start start;
};

/// Fits a form and measures its error at the data left out.
Result<Trial> try_form(const Trials& trials, const RbfForm& form, const Run& run) {
    RbfReport unused;
    const RbfData& data = trials.data;
    const auto f = Fitter(trials.left.kept, trials.start, form, trials.options, unused)(run);
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    if (!f) return Trial{};
    Trial trial;
    const Point3 normal = axes_of(data)[2];
    const double up = normal.z < 0 ? -1 : 1;
    std::vector<double> missed;
    for (const std::uint32_t i : trials.left.points) {
        const Point3& p = data.points[i];
        const double slope = length(f.value().smooth.gradient(p));
        missed.push_back(f.value()(p) / std::max(slope, constants.least_slope));
        const double height = dot(p, normal);
        trial.left_out.push_back({up * height, up * (height - missed.back())});
    }
    trial.missed = terrane::detail::root_mean_square(missed);
    return trial;
}

} // namespace

std::array<Point3, 3> axes_of(const RbfData& data) {
    Point3 n;
    for (std::size_t i = 0; i < data.next.size(); ++i) n = along(n, 1, data.normals[i]);
    const double size = length(n);
    if (!(size > constants.least_mean_normal * static_cast<double>(data.next.size())))
        return RbfPolynomial{}.axes;
    n = {n.x / size, n.y / size, n.z / size};
    const Point3 other = std::fabs(n.x) < 0.7 ? Point3{1, 0, 0} : Point3{0, 1, 0};
    Point3 u = cross(other, n);
    const double length_u = length(u);
    u = {u.x / length_u, u.y / length_u, u.z / length_u};
    return {u, cross(n, u), n};
}

namespace {

/// Computes the least cosine between normals and axis, ignoring the worst twentieth: noise tilts
/// few normals, a fold tilts many.
double steepest_slope(const RbfData& data, const Point3& axis) {
    std::vector<double> cosines;
    for (const Point3& n : data.normals)
        if (!(n == Point3{})) cosines.push_back(dot(n, axis));
    if (cosines.empty()) return 0;
    const auto worst =
        cosines.begin() + static_cast<std::ptrdiff_t>(cosines.size() / constants.outlier_part);
    std::nth_element(cosines.begin(), worst, cosines.end());
    return *worst;
}

/// Lists the forms worth a trial, by increasing degree: along the axis only if the data are a graph
/// over its plane; along normals only if they are steep, then also with polynomials in space.
std::vector<RbfForm> forms_for(const RbfData& data, const RbfOptions& options) {
    RbfForm form;
    form.polynomial.axes = axes_of(data);
    const double steepest = steepest_slope(data, form.polynomial.axes[2]);
    const std::size_t centres = std::min(data.points.size(), start_size(options));
    std::vector<RbfForm> forms;
    for (const unsigned degree : constants.degrees) {
        form.polynomial.degree = options.degree > 0 ? options.degree : degree;
        if (degree > 1 && constants.centres_per_term * form.polynomial.terms() > centres) break;
        form.along_axis = true;
        if (steepest > constants.graph_cosine) forms.push_back(form);
        form.along_axis = false;
        if (steepest < constants.steep_cosine) forms.push_back(form);
        if (options.degree > 0) break;
    }
    if (!(steepest < constants.steep_cosine) || options.degree > 0) return forms;
    form.along_axis = false;
    form.polynomial.in_space = true;
    for (const unsigned degree : constants.degrees_in_space) {
        form.polynomial.degree = degree;
        if (form.polynomial.terms() < centres) forms.push_back(form);
    }
    return forms;
}

/// Returns the share of the other form's error below which a form is preferred: the less simple
/// form must be better.
double needed(const RbfPolynomial& form, const RbfPolynomial& other) {
    if (form.in_space && !other.in_space) return constants.worth_in_space;
    return form.degree == other.degree ? 1 : constants.worth_degree;
}

} // namespace

Result<Implicit> fit_hole(const RbfData& data, const TriangleTree& tree, const RbfForm& form,
                          const RbfOptions& options, RbfReport& report, const Run& run) {
    const Start start(data, tree, options, options.most_centres);
    auto f = Fitter(data, start, form, options, report)(run);
    if (f) add_rest(*f, data, options, report, run);
    return f;
}

bool is_graph_along(const RbfData& data, const Point3& axis) {
    return steepest_slope(data, axis) > constants.graph_cosine;
}

Result<RbfChoice> choose_form(const RbfData& data, const RbfOptions& options, const Run& run) {
    auto forms = forms_for(data, options);
    RbfChoice best{forms[0], no_number, {}};
    const Trials trials(data, options);
    if (trials.left.kept.points.size() < constants.least_judged || trials.left.points.empty())
        return best;
    Status status = Done{};
    const auto consider = [&](const RbfForm& form, double share) {
        if (!status.ok() || best.validated < constants.exact * data.radius) return;
        auto trial = try_form(trials, form, run);
        if (!trial) status = trial.error();
        if (!trial || !std::isfinite(trial->missed)) return;
        if (std::isfinite(best.validated) && !(trial->missed < share * best.validated)) return;
        best = {form, trial->missed, std::move(trial->left_out)};
    };
    for (const RbfForm& form : forms) consider(form, needed(form.polynomial, best.form.polynomial));
    if (!options.smoothing) { // noise may be kept out of the hole
        RbfForm smoothed = best.form;
        smoothed.smoothed = true;
        consider(smoothed, constants.worth_smoothing);
    }
    if (!status) return status.error();
    return best;
}

} // namespace terrane::rbf::detail
