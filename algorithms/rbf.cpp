// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rbf.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/edges.hpp>
#include <terrane/algorithms/parallel.hpp>
#include <terrane/algorithms/rbf_data.hpp>
#include <terrane/algorithms/rbf_patches.hpp>
#include <terrane/algorithms/triangle_tree.hpp>
#include <terrane/algorithms/vectors.hpp>
#include <terrane/algorithms/zero_level.hpp>

namespace terrane {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

double length(const Point3& a) {
    return std::hypot(a.x, a.y, a.z);
}

Point3 along(const Point3& p, double d, const Point3& direction) {
    return {p.x + d * direction.x, p.y + d * direction.y, p.z + d * direction.z};
}

/// The function of steps (1) to (4).
struct Implicit {
    RbfFunction smooth;
    RbfPatches rest;

    [[nodiscard]] double operator()(const Point3& p) const {
        return rest.size() == 0 ? smooth(p) : smooth(p) + rest(p);
    }
};

/// Points of the data, each as far as can be from those before it, the first one given.
std::vector<std::uint32_t> well_spread(const std::vector<Point3>& points, std::size_t count) {
    std::vector<std::uint32_t> chosen{0};
    std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
    while (chosen.size() < std::min(count, points.size())) {
        std::uint32_t farthest = 0;
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            distance[i] = std::min(distance[i], length(minus(points[i], points[chosen.back()])));
            if (distance[i] > distance[farthest]) farthest = i;
        }
        if (!(distance[farthest] > 0)) break;
        chosen.push_back(farthest);
    }
    return chosen;
}

class Fitter {
public:
    Fitter(const HoleData& data, const RbfOptions& options, const RbfPolynomial& polynomial,
           RbfReport& report, const Run& run) :
        data_(data),
        options_(options), polynomial_(polynomial), report_(report), run_(run) {}

    Result<Implicit> operator()() {
        report_.data = data_.points.size();
        choose_start();
        Implicit f;
        for (;;) {
            if (run_.stop.stop_requested())
                return Error{ErrorCode::interrupted, "stopped on request", ""};
            auto fit = fit_rbf(points_, values_, {polynomial_, 0}, run_);
            if (!fit) return fit.error();
            f.smooth = std::move(fit.value().function);
            if (run_.progress)
                run_.progress("rbf", 0.5 * static_cast<double>(centres_) /
                                         static_cast<double>(options_.most_centres));
            if (!add_missed(errors_of(f))) break;
        }
        auto fit = fit_rbf(points_, values_, {polynomial_, refinements_}, run_);
        if (!fit) return fit.error();
        f.smooth = std::move(fit.value().function);
        report_.solution = fit.value().solution;
        report_.centres = centres_;
        make_up(f);
        return f;
    }

    /// Without refinement and step (4).
    Result<Implicit> quick() {
        choose_start();
        Implicit f;
        auto fit = fit_rbf(points_, values_, {polynomial_, 0}, run_);
        if (!fit) return fit.error();
        f.smooth = std::move(fit.value().function);
        return f;
    }

private:
    /// Step (2): a well-spread quarter of the centres, with constraints off the surface.
    void choose_start() {
        constexpr std::size_t share = 4;
        const auto start =
            well_spread(data_.points, std::max<std::size_t>(10, options_.most_centres / share));
        is_centre_.assign(data_.points.size(), false);
        for (const std::uint32_t i : start) add_centre(i);
        const TriangleTree tree(data_.points, data_.triangles);
        const double wanted =
            options_.offset > 0 ? options_.offset : std::max(data_.radius / 20, data_.edge / 2);
        report_.offset = wanted;
        for (const std::uint32_t i : start)
            for (const double side : {-1.0, 1.0}) add_offset(tree, i, side * wanted);
        spacing_ = 0;
        for (const std::uint32_t i : start) {
            double least = std::numeric_limits<double>::infinity();
            for (const std::uint32_t j : start)
                if (j != i)
                    least = std::min(least, length(minus(data_.points[i], data_.points[j])));
            spacing_ = std::max(spacing_, least);
        }
    }

    void add_centre(std::uint32_t i) {
        is_centre_[i] = true;
        points_.push_back(data_.points[i]);
        values_.push_back(0);
        ++centres_;
    }

    /// f = d at a distance d along the normal, if the surface is no nearer there; else less of it.
    void add_offset(const TriangleTree& tree, std::uint32_t i, double d) {
        if (data_.normals[i] == Point3{}) return;
        constexpr double enough = 0.95; // the surface may curve towards the point a little
        constexpr int halvings = 3;
        for (int k = 0; k < halvings; ++k, d /= 2) {
            const Point3 p = along(data_.points[i], d, data_.normals[i]);
            if (tree.distance(p, std::fabs(d)) < enough * std::fabs(d)) continue;
            points_.push_back(p);
            values_.push_back(d);
            ++report_.offsets;
            return;
        }
    }

    [[nodiscard]] std::vector<double> errors_of(const Implicit& f) const {
        std::vector<double> errors(data_.points.size());
        for_ranges(errors.size(), run_, [&](std::size_t a, std::size_t b) {
            for (std::size_t i = a; i < b; ++i) errors[i] = f(data_.points[i]);
        });
        return errors;
    }

    [[nodiscard]] double tolerance() const {
        return options_.tolerance > 0 ? options_.tolerance : data_.edge / 1000;
    }

    /// Step (3): the data missed most become centres, no two of them near each other. False where
    /// none is missed by too much, or there are centres enough.
    bool add_missed(const std::vector<double>& errors) {
        std::vector<std::uint32_t> missed;
        for (std::uint32_t i = 0; i < errors.size(); ++i)
            if (!is_centre_[i] && std::fabs(errors[i]) > tolerance()) missed.push_back(i);
        if (missed.empty() || centres_ >= options_.most_centres) return false;
        std::sort(missed.begin(), missed.end(), [&](std::uint32_t a, std::uint32_t b) {
            const double x = std::fabs(errors[a]), y = std::fabs(errors[b]);
            return x > y || (x == y && a < b);
        });
        const std::size_t most = std::min(options_.most_centres, 2 * centres_) - centres_;
        std::vector<std::uint32_t> taken;
        for (const std::uint32_t i : missed) {
            if (taken.size() == most) break;
            const bool crowded = std::any_of(taken.begin(), taken.end(), [&](std::uint32_t j) {
                return length(minus(data_.points[i], data_.points[j])) < spacing_ / 2;
            });
            if (!crowded) taken.push_back(i);
        }
        for (const std::uint32_t i : taken) add_centre(i);
        spacing_ /= 2;
        return true;
    }

    /// Step (4), where step (3) left errors.
    void make_up(Implicit& f) {
        auto errors = errors_of(f);
        const auto largest = [&] {
            double most = 0;
            for (const double e : errors) most = std::max(most, std::fabs(e));
            return most;
        };
        report_.missed = largest();
        if (report_.missed > tolerance()) {
            for (double& e : errors) e = -e;
            f.rest = RbfPatches(data_.points, errors);
            report_.patches = f.rest.size();
            errors = errors_of(f);
        }
        report_.largest_error = largest();
        double squares = 0;
        for (const double e : errors) squares += e * e;
        report_.rms_error = std::sqrt(squares / static_cast<double>(errors.size()));
    }

    const HoleData& data_;
    const RbfOptions& options_;
    const RbfPolynomial& polynomial_;
    RbfReport& report_;
    const Run& run_;
    std::vector<Point3> points_; ///< of the constraints
    std::vector<double> values_;
    std::vector<bool> is_centre_; ///< per datum
    std::size_t centres_ = 0;
    double spacing_ = 0;
    unsigned refinements_ = 6;
};

/// The data without those nearest to the hole, as if it were larger.
struct LeftOut {
    HoleData kept;
    std::vector<std::uint32_t> points; ///< left out
};

LeftOut leave_out(const HoleData& data) {
    const double most = *std::max_element(data.distances.begin(), data.distances.end());
    const double width = std::max(std::min(data.radius / 4, most / 3), 1.5 * data.edge);
    LeftOut result;
    HoleData& kept = result.kept;
    std::vector<std::uint32_t> name(data.points.size(), UINT32_MAX);
    for (std::uint32_t i = 0; i < data.points.size(); ++i) {
        if (data.distances[i] < width) {
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
    return result;
}

/// How far a fit to what was kept is from what was left out, root mean square; NaN for no fit.
double error_of(const HoleData& data, const LeftOut& left, const RbfOptions& options,
                const RbfPolynomial& polynomial, const Run& run) {
    RbfReport unused;
    RbfOptions fewer = options;
    fewer.most_centres = std::min<std::size_t>(4 * options.most_centres, 800);
    Fitter fitter(left.kept, fewer, polynomial, unused, run);
    const auto f = fitter.quick();
    if (!f) return no_number;
    double squares = 0;
    for (const std::uint32_t i : left.points) {
        const double slope = length(f.value().smooth.gradient(data.points[i]));
        const double off = f.value()(data.points[i]) / std::max(slope, 0.1);
        squares += off * off;
    }
    return std::sqrt(squares / static_cast<double>(left.points.size()));
}

/// Axes along and across the hole: the last along the mean normal of its border.
std::array<Point3, 3> axes_of(const HoleData& data) {
    Point3 n;
    for (std::size_t i = 0; i < data.next.size(); ++i) n = along(n, 1, data.normals[i]);
    const double size = length(n);
    if (!(size > 0.1 * static_cast<double>(data.next.size()))) return RbfPolynomial{}.axes;
    n = {n.x / size, n.y / size, n.z / size};
    const Point3 other = std::fabs(n.x) < 0.7 ? Point3{1, 0, 0} : Point3{0, 1, 0};
    Point3 u = cross(other, n);
    const double length_u = length(u);
    u = {u.x / length_u, u.y / length_u, u.z / length_u};
    return {u, cross(n, u), n};
}

/// The degree whose fit predicts best what was left out: a higher one must be better by a tenth.
RbfPolynomial choose_polynomial(const HoleData& data, const RbfOptions& options, double& error,
                                const Run& run) {
    RbfPolynomial best;
    best.axes = axes_of(data);
    best.degree = options.degree > 0 ? options.degree : 1;
    const LeftOut left = leave_out(data);
    error = no_number;
    if (left.kept.points.size() < 10 || left.points.empty()) return best;
    error = error_of(data, left, options, best, run);
    constexpr unsigned most = 4;
    constexpr double worth = 0.9;
    for (unsigned degree = 2; options.degree == 0 && degree <= most; ++degree) {
        RbfPolynomial next = best;
        next.degree = degree;
        const double other = error_of(data, left, options, next, run);
        if (!(other < worth * error)) continue;
        best = next;
        error = other;
    }
    return best;
}

/// The edge length of the filling: equilateral triangles of that size, as many as are allowed.
double size_for(const HoleData& data, const BorderLoop& loop, const RbfOptions& options) {
    if (options.size > 0) return options.size;
    const double per_vertex = std::sqrt(3.0) / 2; // area, in squares of the edge
    const double least =
        std::sqrt(loop.area / (per_vertex * static_cast<double>(options.most_vertices)));
    return std::max(data.edge, least);
}

/// The edges at which the data end, but for the border of the hole, as triangles without area.
std::vector<Triangle> rim_of(const HoleData& data) {
    std::vector<Triangle> rim;
    group_edges(data.triangles, data.points.size())
        .for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            const bool of_hole =
                high < data.next.size() && (data.next[low] == high || data.next[high] == low);
            if (sides.size() == 1 && !of_hole) rim.push_back({low, high, high});
        });
    return rim;
}

/// What lies under the surface away from the border, or beyond where the data end.
class Outside {
public:
    Outside(const HoleData& data, double size) :
        size_(size), surface_(data.points, data.triangles), rim_(data.points, rim_of(data)),
        border_(data.points, border_edges(data)) {}

    [[nodiscard]] bool operator()(const Point3& p) const {
        const double margin = 3 * size_, under = 1.5 * size_;
        const double border = border_.distance(p, std::numeric_limits<double>::infinity());
        if (border < margin) return false;
        const double surface = surface_.distance(p, border);
        if (surface < under) return true;
        // Beyond the data the nearest of them is on their rim, as it is on no other limb of a fold.
        return surface < border && rim_.distance(p, border) <= surface;
    }

private:
    static std::vector<Triangle> border_edges(const HoleData& data) {
        std::vector<Triangle> edges;
        for (std::uint32_t i = 0; i < data.next.size(); ++i)
            edges.push_back({i, data.next[i], data.next[i]});
        return edges;
    }

    double size_;
    TriangleTree surface_, rim_, border_;
};

/// Step (5).
Result<Surface> mesh_zero_level(const Implicit& f, const HoleData& data, double size,
                                const Run& run) {
    const Outside outside(data, size);
    ZeroLevelOptions options;
    options.size = size;
    options.seeds = std::span(data.points).first(data.next.size());
    options.leave = [&](const Point3& p) { return outside(p); };
    const SpaceFunction function{[&](const Point3& p) { return f(p); },
                                 [&](const Point3& p) { return f.smooth.gradient(p); }};
    return zero_level(function, options, run);
}

double area_of(const Surface& s) {
    double sum = 0;
    for (const Triangle& t : s.triangles)
        sum += length(cross(minus(s.vertices[t[1]], s.vertices[t[0]]),
                            minus(s.vertices[t[2]], s.vertices[t[0]]))) /
               2;
    return sum;
}

std::string describe(const RbfReport& r) {
    return fmt::format(
        "degree {}, {} of {} data are centres, {} constraints {:.4g} off the surface; condition "
        "{:.2g}, residual {:.2g} after {} refinements; data missed by {:.2g} at most, "
        "{} patches, then by {:.2g}",
        r.degree, r.centres, r.data, r.offsets, r.offset, r.solution.condition, r.solution.residual,
        r.solution.refinements, r.missed, r.patches, r.largest_error);
}

Status validate_options(const RbfOptions& o) {
    const auto bad = [](const char* what) { return Error{ErrorCode::bad_option, what, ""}; };
    const auto length_or_zero = [](double x) { return x >= 0 && std::isfinite(x); };
    if (!length_or_zero(o.reach)) return bad("the reach of the data is no number of radii");
    if (o.most_centres < 10 || o.most_centres > 2000) return bad("centres: 10 to 2000");
    if (!length_or_zero(o.offset) || !length_or_zero(o.tolerance) || !length_or_zero(o.size))
        return bad("offset, tolerance and size are lengths");
    if (o.degree > 6) return bad("the degree of the polynomial is 1 to 6, or 0 for the best");
    if (o.most_vertices < 1) return bad("at least one vertex");
    return Done{};
}

Result<Filling> fill_valid(const Surface& surface, const BorderLoop& loop,
                           const RbfOptions& options, RbfReport& report, const Run& run) {
    const auto data = data_round(surface, loop, options.loops, {options.reach, options.rings});
    if (!data) return data.error();
    double validated = no_number;
    const auto polynomial = choose_polynomial(data.value(), options, validated, run);
    report.degree = polynomial.degree;
    const auto f = Fitter(data.value(), options, polynomial, report, run)();
    if (!f) return f.error();
    report.size = size_for(data.value(), loop, options);
    auto level = mesh_zero_level(f.value(), data.value(), report.size, run);
    if (!level) return level.error();
    Filling filling;
    filling.surface = std::move(level).value();
    filling.surface.name = surface.name;
    filling.surface.role = surface.role;
    filling.deviation.assign(filling.surface.vertices.size(), no_number);
    filling.report.data = report.data;
    filling.report.invented = filling.surface.vertices.size();
    filling.report.area = area_of(filling.surface);
    filling.report.expected_error = no_number;
    filling.report.validated_error = validated;
    filling.report.model = describe(report);
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    return filling;
}

} // namespace

Result<Filling> fill_by_rbf(const Surface& surface, const BorderLoop& loop,
                            const RbfOptions& options, RbfReport& report, const Run& run) {
    report = {};
    if (const auto good = validate_options(options); !good) return good.error();
    try {
        return fill_valid(surface, loop, options, report, run);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::out_of_memory, "not enough memory", ""};
    }
}

Result<Filling> fill_by_rbf(const Surface& surface, const BorderLoop& loop,
                            const RbfOptions& options, const Run& run) {
    RbfReport report;
    return fill_by_rbf(surface, loop, options, report, run);
}

} // namespace terrane
