// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/improve_report.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/cli/reports/pair_report.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/quantities.hpp>
#include <terrane/cli/session/styles.hpp>
#include <terrane/io/report_members.hpp>
#include <terrane/io/text/histogram_svg.hpp>

namespace terrane::cli {
namespace {

std::string quality_row(const char* name, const QualityReport& q) {
    return fmt::format("  {:<7} {:>9}  {:.4f}  {:.4f}  {:>6.2f}  {:>8.3f}  {:>8.3f}  {}, {}, {}\n",
                       name, q.triangles, q.q.mean, q.q.min, 100 * q.share_above_08,
                       q.smallest_angle.min, q.largest_angle.max, figure(q.edge_length.min, 4),
                       figure(q.edge_length.mean, 4), figure(q.edge_length.max, 4));
}

std::string worst_text(const Improved& improved, const Quantities& quantities) {
    const ImproveReport& r = improved.report;
    if (r.after.worst == UINT32_MAX) return {};
    const Mesh& m = improved.mesh;
    const Triangle& t = m.triangles[r.after.worst];
    return fmt::format("worst: triangle {} of {}, q {:.4f}, at {}: {}\n", r.after.worst,
                       one_line(m.surfaces[m.surfaces_of[r.after.worst][0]].name), r.after.q.min,
                       quantities.place(m.vertices[t[0]]), name_of(r.worst_cause));
}

/// Explains why edges may be longer or shorter than wanted.
std::string lengths_text(const ImproveReport& r) {
    if (!r.is_strict) return {};
    return fmt::format("lengths: edges stay where others would make triangles worse than q {:.4f}, "
                       "the worst before; --least-quality allows them\n",
                       r.least_quality);
}

/// Reports the deviation of the surface that comes nearest to its bound.
std::string deviation_text(const ImprovedAndMeasured& measured, const Inputs& inputs) {
    const ImproveReport& r = measured.improved.report;
    const auto& deviations = measured.deviations;
    std::size_t where = 0;
    double share = 0, back = 0;
    for (std::size_t s = 0; s < deviations.size(); ++s) {
        back = std::max(back, deviations[s].back);
        if (!(r.bound_of[s] > 0) || deviations[s].out / r.bound_of[s] < share) continue;
        share = deviations[s].out / r.bound_of[s];
        where = s;
    }
    const Quantities quantities = inputs.quantities();
    return fmt::format("deviation: {} is shown to be within {} of what it was, measured {}; "
                       "the others keep farther below their bounds; from old to new measured {}, "
                       "{}\n{} the improved mesh is conforming, by exact check\n",
                       inputs.labels[where], quantities.length(r.bound_of[where]),
                       quantities.length(deviations[where].out), quantities.length(back),
                       measured.is_near_back() ? "shown to be within the bounds as well"
                                               : "not shown to be within the bounds",
                       good("verified:")) +
           text_of(measured.improved.conforming->pairs());
}

/// The volume of a block before and after.
struct VolumeChange {
    std::size_t block = 0; ///< number in the improved mesh
    double before = 0, after = 0;

    /// Returns the size of the change in percent of the volume before.
    [[nodiscard]] double percent() const {
        return after == before ? 0 : 100 * std::fabs(after / before - 1);
    }
};

void describe(const auto& visit, const VolumeChange& c) {
    visit("block", c.block, "volume_before", c.before, "volume_after", c.after, "change_percent",
          c.percent());
}

/// Lists all blocks; none where the sides of sheets are not kept.
std::vector<VolumeChange> volume_changes(const Improved& improved) {
    std::vector<VolumeChange> changes;
    for (std::size_t b = 1; b < improved.volume_before.size(); ++b)
        changes.push_back({b, improved.volumes_before.measures[improved.volume_before[b]],
                           improved.volumes.measures[b]});
    return changes;
}

/// Reports the volumes of all blocks together and of each block; of many, the one that changed
/// most.
std::string volumes_text(const Improved& improved, const Quantities& quantities) {
    constexpr std::size_t few = 20;
    constexpr int digits = 6;
    auto changes = volume_changes(improved);
    if (changes.empty()) return {};
    std::stable_sort(
        changes.begin(), changes.end(),
        [](const VolumeChange& a, const VolumeChange& b) { return a.percent() > b.percent(); });
    auto text =
        fmt::format("volumes: {}, {} before, {} after{}\n", counted(changes.size(), "block"),
                    quantities.volume(improved.volumes_before.total, digits),
                    quantities.volume(improved.volumes.total, digits),
                    changes.size() > few ? "; those that changed most:" : "");
    if (changes.size() > few) changes.resize(few);
    for (const VolumeChange& c : changes)
        text += fmt::format("  block {}: {} before, {} after, changed by {} %\n", c.block,
                            quantities.volume(c.before, digits), quantities.volume(c.after, digits),
                            figure(c.percent(), 2));
    return text;
}

} // namespace

bool keeps_volumes(const ImprovedAndMeasured& measured, bool strict,
                   const ImproveOptions& options) {
    double largest = 0;
    for (const VolumeChange& c : volume_changes(measured.improved))
        largest = std::max(largest, c.percent());
    const double most = options.max_volume_change;
    if (largest <= most) return true;
    warn(fmt::format("the volume of a block changed by {} %, more than {} %; try a smaller "
                     "deviation",
                     figure(largest, 3), figure(most, 3)));
    return !strict;
}

std::string improve_text(const ImprovedAndMeasured& measured, const Inputs& inputs) {
    const Improved& improved = measured.improved;
    const ImproveReport& r = improved.report;
    std::string text = fmt::format("quality  triangles  mean q   least  % > 0.8  angle min       "
                                   "max  edges min, mean, max{}\n",
                                   inputs.unit.empty() ? "" : ", " + inputs.unit);
    text += quality_row("before", r.before) + quality_row("after", r.after);
    text += worst_text(improved, inputs.quantities());
    text += lengths_text(r);
    text +=
        fmt::format("{} splits, {} collapses, {} swaps, {} moves; {} curves and {} corners kept\n",
                    r.splits, r.collapses, r.swaps, r.moves, r.curves, r.corners);
    return text + volumes_text(improved, inputs.quantities()) + deviation_text(measured, inputs);
}

void add_statistics(Json& json, const ImprovedAndMeasured& measured) {
    add_constants(json, "improve", improve_constants());
    const Improved& improved = measured.improved;
    const ImproveReport& r = improved.report;
    json["output"]["triangles"] = improved.mesh->triangles.size();
    json["output"]["vertices"] = improved.mesh->vertices.size();
    json["output"]["intersection_edges"] = improved.mesh->intersection_edges.size();
    json["improve"] = r;
    json["improve"]["blocks"] = volume_changes(improved);
    json["improve"]["worst_cause"] = r.worst_cause;
    if (const auto& pairs = improved.conforming->pairs()) json["improve"]["pairs"] = *pairs;
    json["quality"] = {{"before", r.before}, {"after", r.after}};
    Json out = Json::array(), back = Json::array();
    for (const Deviation& d : measured.deviations) {
        out.push_back(d.out);
        back.push_back(d.back);
    }
    json["deviation"] = {
        {"bound_of_surfaces", r.bound_of},
        {"measured_of_surfaces", out},
        {"bound_back_of_surfaces", measured.bounds_back}, // null: no bound was proven
        {"measured_back", back}};
}

std::string histogram_of(const ImproveReport& report) {
    const auto title = [](const char* when, const QualityReport& q) {
        return fmt::format("{}: {} triangles, mean {:.3f}, least {:.3f}", when, q.triangles,
                           q.q.mean, q.q.min);
    };
    const std::string before = title("before", report.before), after = title("after", report.after);
    const std::array histograms{Histogram{before, report.before.histogram, report.before.q.mean},
                                Histogram{after, report.after.histogram, report.after.q.mean}};
    return histogram_svg(histograms);
}

} // namespace terrane::cli
