// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/rounding.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/arrangement/intersection_edges.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/is_external.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/rounding/detail/attempt.hpp>
#include <terrane/algorithms/rounding/detail/closed_parts.hpp>
#include <terrane/algorithms/rounding/detail/contact_clusters.hpp>
#include <terrane/algorithms/rounding/detail/moved_attempts.hpp>
#include <terrane/algorithms/rounding/detail/parents_in_contact.hpp>
#include <terrane/algorithms/rounding/detail/reports.hpp>
#include <terrane/algorithms/rounding/detail/snapped_input.hpp>
#include <terrane/algorithms/rounding/detail/tuning.hpp>
#include <terrane/algorithms/rounding/detail/vanished.hpp>

namespace terrane {

using namespace rounding::detail;

namespace {

double largest_coordinate(const Point3& p) {
    return std::max(std::max(std::fabs(p.x), std::fabs(p.y)), std::fabs(p.z));
}

/// Returns the largest absolute coordinate of the input triangles.
double largest_coordinate(const Arrangement& a) {
    const auto points = a.state->points.inputs();
    const auto& triangles = a.state->corners;
    if (triangles.empty()) return 0;
    std::uint32_t farthest = 0;
    double largest = 0;
    for (std::uint32_t v = 0; v < points.size(); ++v)
        if (const double c = largest_coordinate(points[v]); c > largest) {
            largest = c;
            farthest = v;
        }
    const auto is_of = [&](const Triangle& t) {
        return t[0] == farthest || t[1] == farthest || t[2] == farthest;
    };
    if (std::any_of(triangles.begin(), triangles.end(), is_of)) return largest;
    largest = 0; // no triangle has the farthest point
    for (const Triangle& t : triangles)
        for (const std::uint32_t v : t) largest = std::max(largest, largest_coordinate(points[v]));
    return largest;
}

/// Makes the arrangement of the snapped input one of the original input: triangles that have the
/// same points only because they were snapped do not count as duplicates.
void name_input(const Arrangement& a, Arrangement& snapped) {
    snapped.surfaces = a.surfaces;
    snapped.inputs.duplicates = a.inputs.duplicates;
    snapped.intersection_edges =
        find_intersection_edges(snapped.state->adjacency, snapped.inputs, snapped.parents_of);
}

/// Returns the input triangles of a conforming mesh that are ill-joined.
ParentsInContact parents_ill_joined(const Arrangement& a, const RoundedMesh& rounded) {
    ParentsInContact found;
    const RoundingReport& report = rounded.report;
    if (report.rounds + report.merged_vertices + report.collapsed_triangles == 0) return found;
    for (const auto& [p, q] :
         ill_joined(rounded.mesh->triangles, rounded.mesh->parents_of, a.state->corners)) {
        found.pairs.emplace_back(p, q);
        found.all.insert(found.all.end(), {p, q});
    }
    sort_unique(found.all);
    return found;
}

/// An attempt to round a moved input.
struct Attempt {
    std::optional<RoundedMesh> rounded; ///< nothing where a boundary was not closed
    ParentsInContact in_contact{};      ///< if it is not conforming
};

/// Arranges a moved input and rounds that.
Result<Attempt> arrange_again(const Arrangement& a, const std::vector<Surface>& surfaces,
                              const MovedInput& moved, const Task& task) {
    auto again = arrange(surfaces, {}, task.run);
    if (!again) return again.error();
    name_input(a, again.value());
    if (a.state->restrict_again) {
        again = a.state->restrict_again(std::move(again).value(), task.run);
        if (!again && is_external(again.error().code)) return again.error();
        if (!again) return {Attempt{}};
    }
    Rounding rounding(again.value(), moved, Repairs::possible, task);
    auto rounded = rounding();
    if (!rounded) return rounded.error();
    auto in_contact = rounding.left() ? *rounding.left() : parents_in_contact(rounded.value());
    return {Attempt{std::move(rounded).value(), std::move(in_contact)}};
}

/// An arrangement whose input is moved.
class MovedWhole final : public MovableInput {
public:
    /// Takes the first rounding, with the parents that are in contact after it.
    MovedWhole(const Arrangement& a, RoundedMesh first, ParentsInContact in_contact,
               const Task& task) :
        arrangement_(a),
        task_(task), first_(std::move(first)), in_contact_(std::move(in_contact)), input_(a) {
        input_.choose(in_contact_.all);
        // A part of an arrangement has been repaired in place as far as that goes, and begins anew.
        rounds_ = a.state->whole ? first_.report.rounds : 0;
    }

    /// Returns the first rounding that is conforming, or the one before any was attempted.
    Result<RoundedMesh> operator()() {
        const unsigned most = task_.most_attempts;
        const auto done = attempt_moves(*this, task_.limit, most > rounds_ ? most - rounds_ : 0);
        if (!done) return done.error();
        return found_ ? std::move(*found_) : std::move(first_);
    }

private:
    Result<std::optional<DecimalFrame>> decimal_frame() override;
    Result<std::optional<ClusterFrame>> cluster_frame() override;
    [[nodiscard]] std::optional<SnapGrid> grid(int digits, double limit) const override {
        return grid_of_digits(inputs(), digits, limit, task_.kept, task_.largest);
    }
    Result<Attempted> attempt(const DecimalFrame& frame) override {
        return attempt(input_.surfaces(frame));
    }
    Result<Attempted> attempt(const ClusterFrame& frame) override {
        return attempt(input_.surfaces(frame));
    }
    Result<Attempted> attempt(const SnapGrid& grid) override {
        return attempt(input_.surfaces(grid));
    }
    Result<bool> choose_more() override { return input_.choose(last_.all); }

    Result<Attempted> attempt(const std::vector<Surface>& surfaces);
    [[nodiscard]] std::span<const Point3> inputs() const {
        return arrangement_.state->points.inputs();
    }

    const Arrangement& arrangement_;
    const Task& task_;
    RoundedMesh first_;
    const ParentsInContact in_contact_; ///< after the first rounding
    SnappedInput input_;
    unsigned rounds_ = 0;
    std::optional<RoundedMesh> found_; ///< conforming
    ParentsInContact last_;            ///< after the last attempt
};

/// Arranges and rounds the moved input.
Result<Attempted> MovedWhole::attempt(const std::vector<Surface>& surfaces) {
    auto done = arrange_again(arrangement_, surfaces, input_.how(), task_);
    if (!done) return done.error();
    ++rounds_;
    auto& [rounded, in_contact] = done.value();
    last_ = std::move(in_contact);
    if (!rounded) return Attempted::torn;
    if (!rounded->report.clean || rounded->report.surface_deviation > task_.limit)
        return Attempted::in_contact;
    add_to_report(input_.how(), arrangement_, first_.report, *rounded);
    rounded->report.rounds += rounds_;
    if (task_.spare != nullptr) {
        auto ill_joined = parents_ill_joined(arrangement_, *rounded);
        const bool is_worse =
            rounded->mesh->triangles.empty() && (*task_.spare || first_.report.clean);
        if (is_worse || !ill_joined.all.empty() || are_parted(arrangement_, *rounded)) {
            last_ = std::move(ill_joined);
            if (!*task_.spare && !is_worse) *task_.spare = std::move(rounded);
            return Attempted::in_contact;
        }
    }
    found_ = std::move(rounded);
    return Attempted::conforming;
}

/// Comparisons of lengths can't be repeated in a frame.
Result<std::optional<DecimalFrame>> MovedWhole::decimal_frame() {
    const ExactState& state = *arrangement_.state;
    if (state.restrict_again && state.measures) return std::optional<DecimalFrame>();
    return DecimalFrame::of(inputs(), input_.chosen(), task_.kept);
}

/// The axes of such a frame are inclined, so that they can't keep the planes of a volume of interest.
Result<std::optional<ClusterFrame>> MovedWhole::cluster_frame() {
    if (!arrangement_.state->whole) return std::optional<ClusterFrame>();
    const double tolerance = cluster_tolerance(largest_coordinate(arrangement_));
    const auto normals =
        cluster_directions(arrangement_.state->corners, inputs(), in_contact_, tolerance);
    return ClusterFrame::of(inputs(), input_.chosen(), normals, tolerance);
}

/// Rounds where the surfaces lie, then with a moved input.
Result<RoundedMesh> round_once(const Arrangement& a, const Task& task) {
    // Arranging the input again would restore triangles that were removed from the arrangement.
    const bool may_move_input =
        (a.state->whole || a.state->restrict_again) && task.options.max_rounds > 0;
    const MovedInput unmoved;
    const auto first = task.repairs_places ? Repairs::possible : Repairs::sparse;
    Rounding where_it_lies(a, unmoved, may_move_input && a.state->whole ? first : Repairs::all,
                           task);
    auto rounded = where_it_lies();
    const auto is_unclean = [&] { return rounded && !rounded.value().report.clean; };
    ParentsInContact in_contact;
    if (rounded && may_move_input)
        in_contact = where_it_lies.left()           ? *where_it_lies.left()
                     : rounded.value().report.clean ? parents_ill_joined(a, rounded.value())
                                                    : parents_in_contact(rounded.value());
    if (may_move_input && (is_unclean() || !in_contact.all.empty())) {
        rounded = MovedWhole(a, std::move(rounded).value(), std::move(in_contact), task)();
    }
    if (is_unclean() && where_it_lies.left()) rounded = Rounding(a, unmoved, Repairs::all, task)();
    return rounded;
}

/// Gives all grids of a task one spacing on all axes. Those with a spacing for each axis hardly move the smaller
/// coordinates, such as depths beside map coordinates, as far as the limit allows.
void use_one_spacing(const Arrangement& a, Task& task) {
    task.largest.fill(largest_coordinate(a));
    task.most_attempts *= rounding_tuning.more_attempts;
}

/// Rounds within the limit of the task: where nothing is conforming, once more with one spacing on all axes, then
/// with a repair of places, too. Only then takes a mesh that is ill-joined or parted.
Result<RoundedMesh> round_within(const Arrangement& a, Task task) {
    std::optional<RoundedMesh> spare;
    task.spare = &spare;
    auto rounded = round_once(a, task);
    const auto is_unclean = [&] { return rounded && !rounded->report.clean; };
    if (is_unclean()) use_one_spacing(a, task);
    for (const bool repairs_places : {false, true}) {
        if (!is_unclean() || task.options.max_rounds == 0) break;
        task.repairs_places = repairs_places;
        auto again = round_once(a, task);
        if (!again || again->report.clean) rounded = std::move(again);
    }
    if (is_unclean() && spare) rounded = std::move(*spare);
    return rounded;
}

/// Returns the least limit, a power of two times that of the task, with which the mesh is conforming; 0: it is with
/// none of those that were tried. A rounding within that limit makes the same attempts.
Result<double> sufficient_limit(const Arrangement& a, Task task) {
    const double limit = task.limit;
    use_one_spacing(a, task);
    const auto suffices = [&](int digits) -> Result<bool> {
        task.limit = std::ldexp(limit, digits);
        const auto rounded = round_once(a, task); // without a repair of places, which takes longer
        if (!rounded) return rounded.error();
        return rounded->report.clean;
    };
    const int step = rounding_tuning.limit_digits;
    for (int digits = step; digits <= 6 * step; digits += step) {
        auto done = suffices(digits);
        if (!done) return done.error();
        if (!*done) continue;
        int least = digits - step;
        while (digits - least > 1) {
            const int middle = least + (digits - least) / 2;
            done = suffices(middle);
            if (!done) return done.error();
            (*done ? digits : least) = middle;
        }
        return std::ldexp(limit, digits);
    }
    return 0.0;
}

Result<RoundedMesh> round_all(const Arrangement& a, const RoundingOptions& options,
                              const Run& run) {
    const Task task{options, options.max_move.value_or(default_max_move(a)), a.state->kept_planes,
                    run};
    auto rounded = round_within(a, task);
    if (rounded && !rounded->report.clean && options.max_rounds > 0 && !options.max_move) {
        const auto limit = sufficient_limit(a, task);
        if (!limit) return limit.error();
        rounded->report.sufficient_limit = *limit;
    }
    if (!rounded) return rounded;
    const RoundingReport& report = rounded->report;
    if (!report.vanished.empty()) {
        if (rounded->mesh->triangles.empty()) return nothing_left();
        state_vanished_length(a, *rounded, run);
    }
    if (report.collapsed_triangles > 0 || !report.vanished.empty())
        report_vanished_regions(a, *rounded);
    return rounded;
}

} // namespace

Result<RoundedMesh> round_to_doubles(const Arrangement& arrangement, const RoundingOptions& options,
                                     const Run& run) {
    return guarded("for the rounding", "rounding", [&]() -> Result<RoundedMesh> {
        Result<RoundedMesh> rounded = Error{};
        const StageTimer timer(run, "round");
        const Run inner = timer.inside();
        with_threads(run, [&] { rounded = round_all(arrangement, options, inner); });
        return rounded;
    });
}

double default_max_move(const Arrangement& a) {
    return default_max_move(largest_coordinate(a));
}

double default_max_move(double largest) {
    return spacing_at(largest, rounding_tuning.allowed_digits);
}

std::vector<NamedConstant> rounding_constants() {
    return rounding::detail::rounding_tuning.listed();
}

} // namespace terrane
