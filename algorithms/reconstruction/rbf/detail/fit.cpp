// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/fit.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/error.hpp>

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

/// The data that all forms have in common.
struct Start {
    /// `tree`: of the data's triangles.
    Start(const RbfData& data, const TriangleTree& tree, const RbfOptions& options) :
        centres(well_spread(data.points, start_size(options),
                            std::vector<bool>(data.points.size(), true))),
        offset(options.offset > 0 ? options.offset
                                  : std::max(data.radius / constants.offset_part,
                                             constants.offset_edges * data.edge)),
        surface(tree) {
        for (const std::uint32_t i : centres) {
            double least = std::numeric_limits<double>::infinity();
            for (const std::uint32_t j : centres)
                if (j != i) least = std::min(least, length(minus(data.points[i], data.points[j])));
            spacing = std::max(spacing, least);
        }
    }

    std::vector<std::uint32_t> centres; ///< a well-spread quarter of those allowed
    double spacing = 0;                 ///< largest distance of a centre from its nearest one
    double offset;                      ///< distance of offset constraints
    const TriangleTree& surface;
};

double tolerance_of(const RbfData& data, const RbfOptions& options) {
    return options.tolerance > 0 ? options.tolerance : data.edge / 1000;
}

/// Computes the errors at each `step`th datum; 0 at the others.
std::vector<double> errors_at_data(const Implicit& f, const RbfData& data, std::size_t step,
                                   const Run& run) {
    std::vector<double> errors(data.points.size(), 0);
    for_ranges((errors.size() + step - 1) / step, run, [&](std::size_t a, std::size_t b) {
        for (std::size_t i = a; i < b; ++i) errors[i * step] = f(data.points[i * step]);
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

class Fitter {
public:
    Fitter(const RbfData& data, const Start& start, const RbfForm& form, const RbfOptions& options,
           RbfReport& report, const Run& run) :
        data_(data),
        start_(start), form_(form), options_(options), report_(report), run_(run) {}

    /// Fits by steps (2) to (4); without step (4) unless `whole`.
    Result<Implicit> operator()(bool whole) {
        report_.data = data_.points.size();
        choose_start();
        if (options_.smoothing || form_.smoothed) return smoothed(whole);
        Implicit f;
        for (;;) {
            if (run_.stop.stop_requested())
                return Error{ErrorCode::interrupted, "stopped on request", ""};
            auto fit = fit_rbf(points_, values_, {form_.polynomial, 0}, run_);
            if (!fit) return fit.error();
            f.smooth = std::move(fit.value().function);
            if (run_.progress)
                run_.progress("rbf", 0.5 * static_cast<double>(centres_) /
                                         static_cast<double>(options_.most_centres));
            // With many data, a sample first tells where centres are needed.
            if (add_missed(errors_of(f, some()))) continue;
            if (!whole) return f;
            fit = fit_rbf(points_, values_, {form_.polynomial}, run_);
            if (!fit) return fit.error();
            f.smooth = std::move(fit.value().function);
            report_.solution = fit.value().solution;
            report_.centres = centres_;
            if (some() > 1 && add_missed(errors_of(f))) continue;
            interpolate_rest(f, data_, options_, report_, run_);
            return f;
        }
    }

    /// Fits without refinement and without step (4).
    Result<Implicit> quick() {
        choose_start();
        if (options_.smoothing) return smoothed(false);
        Implicit f;
        auto fit = fit_rbf(points_, values_, {form_.polynomial, 0}, run_);
        if (!fit) return fit.error();
        f.smooth = std::move(fit.value().function);
        return f;
    }

private:
    /// Step (2): sets centres and offset constraints.
    void choose_start() {
        is_centre_.assign(data_.points.size(), false);
        for (const std::uint32_t i : start_.centres) add_centre(i);
        // Near noisy data, offset constraints would be dominated by the noise.
        const bool noisy = form_.along_axis && (form_.smoothed || options_.smoothing);
        const double d = noisy && !(options_.offset > 0)
                             ? std::max(start_.offset, constants.noisy_offset * data_.radius)
                             : start_.offset;
        report_.offset = d;
        for (const std::uint32_t i : start_.centres)
            for (const double side : {-1.0, 1.0}) add_offset(i, side * d);
        spacing_ = start_.spacing;
    }

    void add_centre(std::uint32_t i) {
        is_centre_[i] = true;
        points_.push_back(data_.points[i]);
        values_.push_back(0);
        ++centres_;
    }

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

    /// Steps (3) and (4) with smoothing: all data, or a sufficient sample, determine the weights of
    /// the centres of step (2).
    Result<Implicit> smoothed(bool whole) {
        std::vector<Point3> points(points_.begin(), points_.end());
        std::vector<double> values(values_.begin(), values_.end());
        const std::size_t count = std::min(constants.most_smoothed_data, data_.points.size());
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t i = k * data_.points.size() / count;
            if (is_centre_[i]) continue; // already contained
            points.push_back(data_.points[i]);
            values.push_back(0);
        }
        auto fit = smooth_rbf(points_, points, values, form_.polynomial,
                              options_.smoothing.value_or(0), run_);
        if (!fit) return fit.error();
        Implicit f;
        f.smooth = std::move(fit.value().function);
        f.nugget = fit.value().nugget;
        report_.centres = centres_;
        report_.freedom = fit.value().freedom;
        if (whole) interpolate_rest(f, data_, options_, report_, run_);
        return f;
    }

    [[nodiscard]] std::vector<double> errors_of(const Implicit& f, std::size_t step = 1) const {
        return errors_at_data(f, data_, step, run_);
    }

    /// Returns the step at which a sample of data suffices for a trial or for more centres.
    [[nodiscard]] std::size_t some() const {
        return std::max<std::size_t>(1, data_.points.size() / constants.enough_data);
    }

    /// Step (3): turns the data of largest error into centres, no two of them near each other.
    /// Returns false if all errors are tolerable or the centres are used up.
    bool add_missed(const std::vector<double>& errors) {
        std::vector<std::uint32_t> missed;
        for (std::uint32_t i = 0; i < errors.size(); ++i)
            if (!is_centre_[i] && std::fabs(errors[i]) > tolerance_of(data_, options_))
                missed.push_back(i);
        if (missed.empty() || centres_ >= options_.most_centres) return false;
        std::sort(missed.begin(), missed.end(), [&](std::uint32_t a, std::uint32_t b) {
            const double x = std::fabs(errors[a]), y = std::fabs(errors[b]);
            return x > y || (x == y && a < b);
        });
        const std::size_t most =
            std::min(options_.most_centres, constants.centre_growth * centres_) - centres_;
        std::vector<std::uint32_t> taken;
        for (const std::uint32_t i : missed) {
            if (taken.size() == most) break;
            const bool crowded = std::any_of(taken.begin(), taken.end(), [&](std::uint32_t j) {
                return length(minus(data_.points[i], data_.points[j])) <
                       constants.crowded * spacing_;
            });
            if (!crowded) taken.push_back(i);
        }
        for (const std::uint32_t i : taken) add_centre(i);
        spacing_ *= constants.crowded;
        return true;
    }

    const RbfData& data_;
    const Start& start_;
    const RbfForm& form_;
    const RbfOptions& options_;
    RbfReport& report_;
    const Run& run_;
    std::vector<Point3> points_; ///< of the constraints
    std::vector<double> values_;
    std::vector<bool> is_centre_; ///< per datum
    std::size_t centres_ = 0;
    double spacing_ = 0;
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

double rms(const std::vector<double>& values) {
    double squares = 0;
    for (const double v : values) squares += v * v;
    return std::sqrt(squares / static_cast<double>(values.size()));
}

/// The error of a form at the data left out.
struct Trial {
    double missed = no_number; ///< root mean square; NaN if the fit failed
    double nugget = 0;
    std::vector<std::array<double, 2>> left_out{}; ///< FillReport::left_out
};

/// The data left out, and the data that all trials share.
struct Trials {
    Trials(const RbfData& all, const RbfOptions& given) :
        data(all), left(leave_out(all)), tree(left.kept.points, left.kept.triangles),
        options(fewer(given)), start(left.kept, tree, options) {}

    /// Limits the number of centres to what distinguishes forms.
    static RbfOptions fewer(RbfOptions options) {
        const std::size_t enough =
            options.smoothing ? constants.trial_centres_smoothed : constants.trial_centres;
        options.most_centres = std::min(constants.trial_growth * options.most_centres, enough);
        return options;
    }

    const RbfData& data;
    LeftOut left;
    TriangleTree tree; ///< of the remaining data
    RbfOptions options;
    Start start;
};

/// Fits a form and measures its error at the data left out. `quick`: without step (3).
Result<Trial> try_form(const Trials& trials, const RbfForm& form, bool quick, const Run& run) {
    RbfReport unused;
    const RbfData& data = trials.data;
    Fitter fitter(trials.left.kept, trials.start, form, trials.options, unused, run);
    const auto f = quick ? fitter.quick() : fitter(false);
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    if (!f) return Trial{};
    Trial trial{no_number, f.value().nugget, {}};
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
    trial.missed = rms(missed);
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

std::vector<std::uint32_t> well_spread(const std::vector<Point3>& points, std::size_t count,
                                       const std::vector<bool>& of) {
    const auto first = std::find(of.begin(), of.end(), true);
    if (first == of.end() || count == 0) return {};
    std::vector<std::uint32_t> chosen{static_cast<std::uint32_t>(first - of.begin())};
    std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
    while (chosen.size() < count) {
        std::uint32_t farthest = chosen[0];
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            if (!of[i]) continue;
            const Point3 d = minus(points[i], points[chosen.back()]);
            distance[i] = std::min(distance[i], dot(d, d));
            if (distance[i] > distance[farthest]) farthest = i;
        }
        if (!(distance[farthest] > 0)) break;
        chosen.push_back(farthest);
    }
    return chosen;
}

void interpolate_rest(Implicit& f, const RbfData& data, const RbfOptions& options,
                      RbfReport& report, const Run& run) {
    auto errors = errors_at_data(f, data, 1, run);
    note_errors(errors, report);
    report.missed = report.largest_error;
    if (options.smoothing || report.missed <= tolerance_of(data, options)) return;
    auto wanted = errors;
    for (double& e : wanted) e = -e;
    f.rest = RbfPatches(data.points, wanted);
    report.patches = f.rest.size();
    for_ranges(errors.size(), run, [&](std::size_t a, std::size_t b) {
        for (std::size_t i = a; i < b; ++i) errors[i] += f.rest(data.points[i]);
    });
    note_errors(errors, report);
}

Result<Implicit> fit_hole(const RbfData& data, const TriangleTree& tree, const RbfForm& form,
                          const RbfOptions& options, RbfReport& report, const Run& run) {
    return Fitter(data, Start(data, tree, options), form, options, report, run)(true);
}

bool is_graph_along(const RbfData& data, const Point3& axis) {
    return steepest_slope(data, axis) > constants.graph_cosine;
}

Result<RbfChoice> choose_form(const RbfData& data, const RbfOptions& options, const Run& run) {
    const auto forms = forms_for(data, options);
    RbfChoice best{forms[0], no_number, {}, no_number};
    const Trials trials(data, options);
    const RbfData& kept = trials.left.kept;
    if (kept.points.size() < constants.least_judged || trials.left.points.empty()) return best;
    Trial least;
    const auto consider = [&](const RbfForm& form, const Trial& trial, double share) {
        if (!std::isfinite(trial.missed)) return;
        if (std::isfinite(least.missed) && !(trial.missed < share * least.missed)) return;
        best.form = form;
        least = trial;
    };
    for (const RbfForm& form : forms) {
        if (least.missed < constants.exact * data.radius) break;
        const auto trial = try_form(trials, form, true, run);
        if (!trial) return trial.error();
        consider(form, trial.value(), needed(form.polynomial, best.form.polynomial));
    }
    if (!options.smoothing &&
        !(least.missed <
          constants.exact * data.radius)) { // with step (3), and with noise kept out of the
                                            // hole
        for (const bool smoothed : {false, true}) {
            RbfForm form = best.form;
            form.smoothed = smoothed;
            const auto trial = try_form(trials, form, false, run);
            if (!trial) return trial.error();
            if (!smoothed) least = trial.value();
            consider(form, trial.value(), constants.worth_smoothing);
        }
    }
    best.validated = least.missed;
    best.left_out = least.left_out;
    if (!std::isfinite(best.validated)) return best;
    std::vector<Point3> places;
    for (const std::uint32_t i : trials.left.points) places.push_back(data.points[i]);
    const RbfError error(kept, best.form.polynomial, trials.left.width, least.nugget);
    const double foreseen = rms(error.at(places, least.nugget > 0, run));
    if (foreseen > 0) best.expected = best.validated / foreseen;
    return best;
}

} // namespace terrane::rbf::detail
