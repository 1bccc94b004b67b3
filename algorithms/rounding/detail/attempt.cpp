// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/attempt.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <terrane/algorithms/arrangement/intersection_edges.hpp>
#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/work_hook.hpp>
#include <terrane/algorithms/rounding/detail/places.hpp>
#include <terrane/algorithms/rounding/detail/repair.hpp>
#include <terrane/algorithms/rounding/detail/reports.hpp>
#include <terrane/algorithms/rounding/detail/vanished.hpp>

namespace terrane::rounding::detail {

/// Creates the ConformingMesh that the rounds below prove: they know all pairs that meet
/// improperly, and end without one.
class RoundingProof {
public:
    static ConformingMesh of(const SharedMesh& mesh, const std::optional<PairCounts>& pairs) {
        terrane::detail::announce_work("prove conforming", mesh->vertices, mesh->triangles);
        return {mesh, pairs};
    }
};

void Rounding::to_nearest() {
    const Arrangement& a = arrangement_;
    const auto first_constructed = static_cast<std::size_t>(
        std::lower_bound(a.vertices.begin(), a.vertices.end(), a.state->points.input_count()) -
        a.vertices.begin());
    state_.input_vertices = first_constructed;
    both(
        run_,
        [&] {
            state_.triangles = a.triangles;
            state_.parents_of = a.parents_of;
        },
        [&] {
            state_.points.reserve(a.vertices.size());
            const auto inputs = a.state->points.inputs();
            for (std::size_t v = 0; v < first_constructed; ++v)
                state_.points.push_back(inputs[a.vertices[v]]);
            if (moved_.frame != nullptr)
                for (Point3& p : state_.points) p = given(p);
            state_.points.resize(a.vertices.size());
            state_.move.assign(a.vertices.size(), 0);
            state_.is_dirty.assign(a.vertices.size(), false);
        });
    struct Nothing {};
    const std::size_t constructed = a.vertices.size() - first_constructed;
    for_blocks<Nothing>(constructed, 1024, run_, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) constructed_to_nearest(first_constructed + k);
        return Nothing{};
    });
    // In a frame nothing is known of the doubles, so that all pairs are tested.
    for (std::size_t v = moved_.frame != nullptr ? 0 : first_constructed; v < a.vertices.size();
         ++v)
        state_.is_dirty[v] = moved_.frame != nullptr || state_.move[v] > 0;
    state_.end_round();
    changed_ = state_.tidy(run_);
}

void Rounding::constructed_to_nearest(std::size_t v) {
    const PointStore& points = arrangement_.state->points;
    const PointIndex p = arrangement_.vertices[v];
    state_.points[v] = given(points.nearest(p));
    state_.move[v] = moved_.frame == nullptr
                         ? rounding_bound(points, p)
                         : moved_.frame->error_of(points.nearest(p), points.rounding_errors(p));
}

/// Returns the doubles for a place in the arrangement's frame.
Point3 Rounding::given(const Point3& input) const {
    return moved_.frame == nullptr ? input : moved_.frame->back(input);
}

/// Returns a bound of the distance of surfaces from where they were.
double Rounding::deviation() const {
    return deviation_of(state_, moved_.largest);
}

Error Rounding::too_far() const {
    return {ErrorCode::bad_option,
            fmt::format("the nearest doubles are up to {} from the exact result, which is more "
                        "than the {} allowed; allow more",
                        deviation(), task_.limit),
            "max_move"};
}

/// Returns how many contacts are too many to be repaired.
std::size_t Rounding::left_from() const {
    const std::size_t count = arrangement_.triangles.size();
    return repairs_ == Repairs::sparse ? crowded_from(count) : hopeless_from(count);
}

/// If contacts of the sample are crowded, notes which input triangles are in contact.
bool Rounding::leaves_crowd(std::span<const CandidatePair> sampled) {
    if (!are_sampled_crowded(sampled.size(), arrangement_.triangles.size())) return false;
    out_.report.naive_contacts = sampled.size();
    left_ = parents_in_contact(sampled, state_.parents_of);
    return true;
}

/// Notes which input triangles are in contact.
void Rounding::leave(std::span<const CandidatePair> pairs) {
    if (!crowd_->is_full()) {
        left_ = parents_in_contact(pairs, state_.parents_of);
        return;
    }
    if (!sample_.empty()) {
        left_ = contacts_of_sample();
        return;
    }
    for (const CandidatePair& p : pairs) crowd_->add(p); // the unproven ones are not in it yet
    left_ = crowd_->parents();
}

/// Repairs what is left, and notes whether triangles may have changed.
void Rounding::repair(std::vector<CandidatePair>& pairs) {
    const RepairTask task{task_.kept,
                          task_.limit,
                          moved_.largest,
                          options_.max_rounds,
                          hopeless_from(arrangement_.triangles.size()),
                          arrangement_.state->whole,
                          tests_all(),
                          task_.largest};
    Repair repair(state_, task, run_);
    repair(pairs);
    out_.report.rounds = repair.rounds();
    changed_ = changed_ || repair.has_snapped();
    const bool are_few = pairs.size() < crowded_from(state_.triangles.size());
    if (!task_.repairs_places || pairs.empty() || !are_few || run_.stop.stop_requested()) return;
    pairs = repair_places(state_, task, std::move(pairs), run_);
    ++out_.report.rounds;
    changed_ = true;
}

/// Each vertex is at most as far from where it was as its own moves and that of the input add up
/// to: where the vertex is one of the input, that of the vertex.
void Rounding::report_moves() {
    RoundingReport& r = out_.report;
    r.surface_deviation = deviation();
    r.max_allowed = task_.limit;
    r.vanished_length = state_.total_gaps();
    if (r.vanished_length > 0) // it is a sum over rounds, and each can lose the same needle
        r.vanished_length =
            std::min(r.vanished_length, largest_distance(state_.points, state_.triangles,
                                                         arrangement_.state->points.inputs()));
    r.deviation = r.vanished_length == 0
                      ? r.surface_deviation
                      : (r.surface_deviation + r.vanished_length) * (1 + 0x1p-51);
    std::vector<double> moves = state_.move;
    const auto inputs = arrangement_.state->points.inputs();
    for (std::size_t v = 0; v < state_.points.size(); ++v) {
        if (moves[v] == 0 && moved_.largest == 0 && moved_.frame == nullptr) continue;
        double before = moved_.largest;
        if (v < state_.input_vertices) {
            const Point3& place = inputs[arrangement_.vertices[v]];
            before = moved_.move_of(place);
            r.moved_input_vertices += state_.points[v] != given(place);
        }
        if (before > 0) moves[v] = (moves[v] + before) * (1 + 0x1p-52);
        r.max_move = std::max(r.max_move, moves[v]);
    }
    r.moves = decades_of(moves);
    r.merged_vertices = state_.merged();
    r.collapsed_triangles = state_.collapsed;
}

void Rounding::report_vanished() {
    if (changed_) out_.report.vanished = vanished(arrangement_, state_.parents_of);
}

/// Computes the regions as long as triangles have only moved: they are then those of the
/// arrangement.
void Rounding::find_first_regions() {
    if (changed_) return;
    const StageTimer step(run_, "regions");
    const Arrangement& a = arrangement_;
    regions_ = find_regions(state_.points, state_.triangles, a.surfaces_of, a.state->adjacency,
                            a.intersection_edges, run_);
}

void Rounding::finish(std::span<const CandidatePair> pairs) {
    out_.report.clean = pairs.empty();
    Mesh mesh;
    both(
        run_, [&] { report_moves(); },
        [&] {
            if (!changed_) mesh.surfaces_of = arrangement_.surfaces_of;
        });
    report_vanished();
    if (!is_hopeless_)
        out_.report.pairs =
            count_decisions(state_, arrangement_.triangles, first_search_, options_.check, run_);
    if (changed_) state_.drop_unused_points();
    for (const CandidatePair& p : pairs) {
        const auto contact =
            improper_contact(state_.points, state_.triangles[p.first], state_.triangles[p.second]);
        out_.report.contacts.push_back(
            {{p.first, p.second},
             kind_of(*contact),
             nearest(state_.points, contact->points[contact->point_count - 1u].how)});
    }
    mesh.surfaces = arrangement_.surfaces;
    mesh.vertices = std::move(state_.points);
    mesh.triangles = std::move(state_.triangles);
    mesh.parents_of = std::move(state_.parents_of);
    if (changed_) {
        const StageTimer step(run_, "regions"); // with intersection edges
        const InputTriangles& inputs = arrangement_.inputs;
        mesh.surfaces_of = surfaces_of_parents(inputs, mesh.parents_of, run_);
        const Adjacency adjacency =
            adjacency_of(group_edges(mesh.triangles, mesh.vertices.size(), run_),
                         labels_of(mesh.surfaces_of, mesh.parents_of));
        mesh.intersection_edges = find_intersection_edges(adjacency, inputs, mesh.parents_of);
        regions_ = find_regions(mesh.vertices, mesh.triangles, mesh.surfaces_of, adjacency,
                                mesh.intersection_edges, run_);
    } else {
        mesh.intersection_edges = arrangement_.intersection_edges;
    }
    mesh.regions_of = std::move(regions_->regions_of);
    out_.regions = std::move(regions_->regions);
    out_.mesh = std::move(mesh);
    if (out_.report.clean) out_.conforming = RoundingProof::of(out_.mesh, out_.report.pairs);
}

} // namespace terrane::rounding::detail
