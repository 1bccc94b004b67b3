// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/detail/remesher.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/quality/detail/constants.hpp>
#include <terrane/algorithms/quality/detail/thickness.hpp>
#include <terrane/algorithms/quality/quality.hpp>

namespace terrane::quality::detail {
namespace {

/// Computes, for each curve, its tolerance: a share of the least tolerance of the sheets that meet
/// there.
std::vector<double> bounds_of_curves(const WorkMesh& mesh, std::size_t curves,
                                     std::span<const double> bound_of) {
    std::vector<double> bounds(curves, std::numeric_limits<double>::infinity());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t c =
                mesh.curve_at(mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]);
            if (c != none)
                bounds[c] =
                    std::min(bounds[c], constants.curve_tolerance * bound_of[mesh.sheet_of[t]]);
        }
    return bounds;
}

} // namespace

Remesher::Remesher(const RemeshInput& input, LeastQuality least, const Run& run) :
    run_(run), options_(input.options), mesh_(input.mesh, input.features),
    validator_(mesh_, input.reference), context_{mesh_,
                                                 validator_,
                                                 input.reference,
                                                 input.mesh.vertices,
                                                 input.features.curves,
                                                 bounds_of_curves(mesh_,
                                                                  input.features.curves.size(),
                                                                  input.sizes.bound_of),
                                                 run_} {
    mesh_.sizes = input.sizes.of_vertices;
    least_length_ = options_.smallest;
    if (!(least_length_ > 0))
        least_length_ =
            constants.curvature_floor * *std::min_element(mesh_.sizes.begin(), mesh_.sizes.end());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
        mesh_.isolated[t] = static_cast<char>(input.reference.is_isolated(t));
    validator_.set_least_quality(std::move(least));
}

void Remesher::operator()(unsigned passes, double from, double to) {
    const auto report = [&](unsigned pass) {
        if (run_.progress) run_.progress("improve", from + (to - from) * pass / (passes + 1.0));
    };
    validator_.group_again(run_);
    for (unsigned pass = 0; pass < passes && !stopped(); ++pass) {
        report(pass);
        ++passes_;
        if (!one_pass(pass == 0, pass < constants.jitter_passes)) break;
    }
    if (stopped()) return;
    report(passes);
    finish();
    for (const auto& places : options_.refinements) refine(places, passes);
}

/// Changes the finished mesh near places where edges are to be shorter.
void Remesher::refine(std::span<const LocalSize> places, unsigned passes) {
    const std::vector<double> lengths = mesh_.sizes;
    shorten_at(places);
    if (stopped() || mesh_.sizes == lengths) return;
    settle(context_, lengths);
    for (unsigned pass = 0; pass < passes && !stopped(); ++pass) {
        ++passes_;
        const std::size_t before = changes();
        alternate(false);
        if (changes() == before) break;
        shorten_at(places); // at vertices that are new
    }
    if (!stopped()) finish();
}

void Remesher::regroup_if_needed() {
    if (!stopped() && constants.regroup_part * validator_.ungrouped() > mesh_.triangles.size())
        validator_.group_again(run_);
}

/// Removes slivers first, as splitting would only turn them into more slivers.
void Remesher::clean_first() {
    collapse_curves(context_);
    regroup_if_needed();
    collapse_edges(context_);
    regroup_if_needed();
    swap_edges(context_);
    regroup_if_needed();
}

std::size_t Remesher::changes() const {
    return context_.splits + context_.collapses + context_.swaps + context_.moves;
}

/// Makes wanted lengths shorter where surfaces are close. Each pass finds the distances anew, as the
/// first triangles are too large to tell where.
void Remesher::shorten_in_gaps() {
    const double layers = options_.layers_in_gaps;
    if (!(layers > 0)) return;
    std::vector<Triangle> used;
    std::vector<double> reach_of;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        if (!mesh_.in_use(t)) continue;
        double longest = 0;
        for (const std::uint32_t v : mesh_.triangles[t])
            longest = std::max(longest, mesh_.sizes[v]);
        used.push_back(mesh_.triangles[t]);
        reach_of.push_back(layers * longest);
    }
    const auto thickness = thickness_of(mesh_.points, used, reach_of, run_);
    for (std::size_t t = 0; t < used.size(); ++t)
        for (const std::uint32_t v : used[t])
            mesh_.sizes[v] =
                std::min(mesh_.sizes[v], std::max(thickness[t] / layers, least_length_));
    limit_growth(mesh_.points, used, options_.growth, mesh_.sizes);
}

/// Makes wanted lengths shorter round these places.
void Remesher::shorten_at(std::span<const LocalSize> places) {
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v)
        for (const LocalSize& local : places)
            mesh_.sizes[v] = std::min(
                mesh_.sizes[v],
                local.length + options_.growth * length(minus(mesh_.points[v], local.place)));
}

/// Returns whether another pass is worthwhile.
bool Remesher::one_pass(bool is_first, bool with_jitter) {
    const std::size_t before = changes();
    if (is_first)
        clean_first();
    else
        shorten_in_gaps();
    alternate(with_jitter);
    return constants.pass_part * (changes() - before) > mesh_.triangles.size();
}

/// Alternates the four operations.
void Remesher::alternate(bool with_jitter) {
    split_curves(context_);
    collapse_curves(context_);
    slide_curves(context_);
    regroup_if_needed();
    split_edges(context_);
    regroup_if_needed();
    collapse_edges(context_);
    regroup_if_needed();
    if (with_jitter) jitter(context_);
    equalize_valences(context_);
    regroup_if_needed();
    smooth(context_);
    swap_edges(context_);
    regroup_if_needed();
    smooth(context_);
}

/// Improves the few remaining bad triangles one by one.
void Remesher::finish() {
    for (unsigned round = 0; round < constants.finish_rounds && !stopped(); ++round) {
        regroup_if_needed();
        const std::size_t before = context_.collapses + context_.swaps;
        collapse_bad(context_, constants.bad_shape);
        swap_edges(context_);
        slide_curves(context_);
        smooth(context_);
        const std::size_t improved = improve_worst(context_, constants.bad_shape);
        if (context_.collapses + context_.swaps == before && improved == 0) break;
    }
    improve_bad_triangles();
    improve_worst_triangles();
}

/// Improves all triangles that are worse than the result may be.
void Remesher::improve_bad_triangles() {
    const double wanted = least_quality().wanted;
    for (unsigned round = 0; round < constants.bad_rounds && !stopped(); ++round) {
        const auto bad = worse_than(mesh_, wanted);
        if (bad.empty()) break;
        regroup_if_needed();
        std::size_t count = improve_worst(context_, wanted);
        for (const std::uint32_t t : worse_than(mesh_, wanted))
            if (mesh_.in_use(t) && quality_at(t) < wanted) count += improve_triangle(context_, t);
        if (count == 0) break;
    }
}

double Remesher::quality_at(std::uint32_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return quality_of(mesh_.points[a], mesh_.points[b], mesh_.points[c]);
}

double Remesher::limit_at(std::uint32_t t) const {
    return std::max(quality_at(t), shape_of(mesh_, mesh_.triangles[t])) *
           (1 + constants.least_growth);
}

std::uint32_t Remesher::worst() {
    std::uint32_t worst = none;
    double least = 2;
    qualities_.resize(mesh_.triangles.size(), -1);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        if (!mesh_.in_use(t)) continue;
        double& q = qualities_[t];
        if (q < 0 || mesh_.changed_at[t] >= measured_at_) q = quality_at(t);
        if (q < least) worst = t;
        least = std::min(least, q);
    }
    measured_at_ = ++mesh_.now;
    return worst;
}

/// Improves the worst triangle of all as long as an operation helps.
void Remesher::improve_worst_triangles() {
    qualities_.clear();
    tried_all_ = false;
    for (unsigned round = 0; round < constants.worst_rounds && !stopped(); ++round) {
        const std::uint32_t t = worst();
        if (t != none && improve_triangle(context_, t) > 0) continue;
        if (t != none && improve_worst(context_, limit_at(t)) > 0) continue;
        tried_all_ = true;
        break;
    }
}

WorstCause Remesher::cause_of_worst() {
    const std::uint32_t at = worst();
    if (at == none) return WorstCause::none;
    const Triangle t = mesh_.triangles[at];
    std::array<double, 3> lengths{};
    std::array<std::uint32_t, 3> curves{};
    bool all_on_curves = true;
    for (std::size_t i = 0; i < 3; ++i) {
        lengths[i] = mesh_.edge_length(t[i], t[(i + 1) % 3]);
        curves[i] = mesh_.curve_at(t[i], t[(i + 1) % 3]);
        all_on_curves = all_on_curves && mesh_.kinds[t[i]] != VertexKind::inner;
    }
    const auto shortest = static_cast<std::size_t>(
        std::min_element(lengths.begin(), lengths.end()) - lengths.begin());
    // The smallest angle is opposite to the shortest edge, between the other two.
    if (curves[(shortest + 1) % 3] != none && curves[(shortest + 2) % 3] != none)
        return WorstCause::corner_angle;
    if (curves[shortest] != none && mesh_.kinds[t[shortest]] == VertexKind::corner &&
        mesh_.kinds[t[(shortest + 1) % 3]] == VertexKind::corner)
        return WorstCause::short_curve;
    if (all_on_curves) return WorstCause::close_curves;
    if (!tried_all_) return WorstCause::rounds;
    // Nothing helps, so the same trials change nothing; they count the reasons.
    const Refusals before = validator_.refusals();
    context_.improved_at.clear(); // repeats moves that were rejected before
    improve_worst(context_, limit_at(at));
    improve_triangle(context_, at);
    const Refusals& after = validator_.refusals();
    const std::size_t deviation = after.deviation - before.deviation;
    const std::size_t contact = after.contact - before.contact;
    if (deviation == 0 && contact == 0) return WorstCause::shape;
    return deviation >= contact ? WorstCause::deviation : WorstCause::contact;
}

void Remesher::describe(ImproveReport& report) const {
    report.passes = passes_;
    report.splits = context_.splits;
    report.collapses = context_.collapses;
    report.swaps = context_.swaps;
    report.moves = context_.moves;
    const Refusals refused = validator_.refusals();
    report.refused_contact = refused.contact;
    report.refused_deviation = refused.deviation;
    report.refused_shape = refused.shape;
}

} // namespace terrane::quality::detail
