// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/repair.hpp>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <numeric>
#include <stop_token>
#include <utility>

#include <terrane/algorithms/arrangement/retriangulation.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/intersection/pencils.hpp>
#include <terrane/algorithms/mesh/work_hook.hpp>
#include <terrane/algorithms/rounding/detail/neighbouring_doubles.hpp>
#include <terrane/algorithms/rounding/detail/parents_in_contact.hpp>
#include <terrane/algorithms/rounding/detail/tuning.hpp>

namespace terrane::rounding::detail {

std::size_t crowded_from(std::size_t triangles) {
    return std::max(rounding_tuning.many, triangles / rounding_tuning.crowded + 1);
}

std::size_t hopeless_from(std::size_t triangles) {
    return std::max(ParentsInContact::most_contacts + 1, rounding_tuning.hopeless * triangles);
}

std::vector<CandidatePair> find_contacts(RoundingState& state, bool tests_all,
                                         const PairFilter& is_improper, const Run& run) {
    state.search_dirty();
    std::vector<std::uint32_t> active;
    if (tests_all) {
        active.resize(state.triangles.size());
        std::iota(active.begin(), active.end(), 0U);
    } else {
        active = state.dirty_triangles(run);
    }
    if (active.empty()) return {};
    terrane::detail::announce_work("search contacts", state.points, state.triangles);
    auto pairs = candidate_pairs_of({state.points, state.triangles}, active, {}, is_improper, run);
    state.only_dirty(pairs);
    return pairs;
}

/// Tells whether each of these boxes is within a covered one, and notes those that are not.
bool Repair::has_all_in(std::span<const Box> boxes) {
    if (task_.covered == nullptr) return true;
    for (const Box& box : boxes)
        if (!task_.covered->contains(box, compared_)) missing_.push_back(box);
    return missing_.empty();
}

/// Tells whether all triangles are here that overlap one with a dirty corner. So all triangles at its
/// corners are, too.
bool Repair::has_all_near_dirty() {
    if (task_.covered == nullptr) return true;
    std::vector<Box> boxes;
    for (const std::uint32_t t : state_.dirty_triangles(run_))
        boxes.push_back(box_of(state_.points, state_.triangles[t]));
    return has_all_in(boxes);
}

bool Repair::tidy() {
    if (!has_all_near_dirty()) return false;
    state_.tidy(run_);
    return true;
}

std::vector<CandidatePair> Repair::contacts(std::size_t most) {
    if (!has_all_near_dirty()) return {};
    std::atomic<std::size_t> count = 0;
    std::stop_source enough;
    const std::stop_callback also(run_.stop, [&] { enough.request_stop(); });
    Run until_enough = quiet_;
    until_enough.stop = enough.get_token();
    const auto is_improper = [&](const CandidatePair& p) {
        if (!improper_contact(state_.points, state_.triangles[p.first], state_.triangles[p.second]))
            return false;
        if (++count > most) enough.request_stop();
        return true;
    };
    auto pairs = find_contacts(state_, task_.tests_all, is_improper, until_enough);
    if (count > most)
        pairs.resize(std::max(pairs.size(), most + 1)); // a stopped search may lose some
    return pairs;
}

std::optional<SnapGrid> Repair::grid(int digits) const {
    return grid_of_digits(state_.points, digits, task_.limit - deviation(), task_.kept,
                          task_.largest);
}

void Repair::operator()(std::vector<CandidatePair>& pairs) {
    std::vector<int> grids(rounding_tuning.fine_digits.begin(), rounding_tuning.fine_digits.end());
    if (!task_.is_whole)
        grids.insert(grids.end(), rounding_tuning.coarse_digits.begin(),
                     rounding_tuning.coarse_digits.end());
    for (auto digits = grids.begin(); digits != grids.end();) {
        if (pairs.size() <= rounding_tuning.few) search_nearby(pairs);
        if (pairs.empty() || rounds_ == task_.max_rounds || is_stuck()) return;
        const auto grid = this->grid(*digits);
        if (!grid) return;
        ++rounds_;
        const RoundingState before = state_;
        const std::size_t count = pairs.size();
        auto left = snap_round(pairs, *grid) ? contacts(count - 1) : pairs;
        if (is_stuck()) return;
        if (left.size() < count && deviation() <= task_.limit)
            pairs = std::move(left);
        else
            state_ = before;
        if (pairs.empty()) return;
        if (task_.is_whole && rounding_tuning.shrinking * pairs.size() > count) return;
        if (task_.is_whole || pairs.size() == count) ++digits;
    }
}

bool Repair::on_grid(const SnapGrid& grid) {
    auto pairs = contacts();
    const std::size_t most = 2 * pairs.size() + rounding_tuning.sampled;
    for (unsigned round = 0; round < rounding_tuning.place_rounds && !pairs.empty(); ++round) {
        if (grid.reach() > task_.limit - deviation() || !snap_round(pairs, grid)) return false;
        pairs = contacts(most);
        if (is_stuck() || deviation() > task_.limit || pairs.size() > most) return false;
    }
    return pairs.empty() && !is_stuck();
}

/// Moves few vertices to doubles nearby, as one round, if that leaves fewer contacts.
void Repair::search_nearby(std::vector<CandidatePair>& pairs) {
    if (rounds_ == task_.max_rounds || !has_all_near_dirty()) return;
    const RoundingState before = state_;
    if (!search_neighbouring_doubles(state_, pairs, task_.kept, task_.limit - task_.used, run_))
        return;
    auto left = contacts();
    if (left.size() < pairs.size() && deviation() <= task_.limit) {
        ++rounds_;
        pairs = std::move(left);
    } else {
        state_ = before;
    }
}

/// Performs one round. Returns false if snapping multiplied the contacts, or their division the
/// triangles, so much that the round is not worthwhile, or left hopelessly many.
bool Repair::snap_round(std::span<const CandidatePair> pairs, const SnapGrid& grid) {
    has_snapped_ = true;
    if (!snap_corners(pairs, grid) || !tidy()) return false;
    if (state_.is_torn ||
        !divide_again(std::min(rounding_tuning.multiplied * pairs.size(), task_.hopeless)))
        return false;
    state_.end_round();
    return tidy() && !state_.is_torn;
}

/// Snaps the corners of these pairs, and all vertices in the same cells. Returns false if some of
/// these may be missing.
bool Repair::snap_corners(std::span<const CandidatePair> pairs, const SnapGrid& grid) {
    std::vector<std::uint32_t> corners;
    for (const CandidatePair& p : pairs)
        for (const std::uint32_t t : {p.first, p.second})
            corners.insert(corners.end(), state_.triangles[t].begin(), state_.triangles[t].end());
    sort_unique(corners);
    std::vector<Point3> cells;
    std::vector<Box> boxes;
    for (const std::uint32_t v : corners) {
        const Point3& c = cells.emplace_back(grid.snap(state_.points[v]));
        const auto& d = grid.step;
        boxes.push_back(
            {{c.x - d[0], c.y - d[1], c.z - d[2]}, {c.x + d[0], c.y + d[1], c.z + d[2]}});
    }
    if (!has_all_in(boxes)) return false;
    state_.move_into(cells, [&](const Point3& p) { return grid.snap(p); });
    return true;
}

/// Divides the triangles that still cross, exactly, and rounds the new points to the nearest
/// doubles. Doubles are much finer than the grid, so most parts stay clear of each other. Where more
/// than most_pairs pairs cross, or division would multiply the triangles, it divides nothing and
/// returns false.
bool Repair::divide_again(std::size_t most_pairs) {
    const auto pairs = contacts(most_pairs);
    if (pairs.size() > most_pairs) return false;
    if (pairs.empty()) return true;
    Retriangulation division = retriangulate(state_.points, state_.triangles, pairs, {}, quiet_);
    if (run_.stop.stop_requested()) return true;
    if (division.triangles.size() + state_.triangles_elsewhere >
        rounding_tuning.multiplied * state_.all_triangles())
        return false;
    const auto first_new = static_cast<std::uint32_t>(state_.points.size());
    std::vector<std::uint32_t> name_of(division.points.size());
    for (const PointIndex p : division.ascending) {
        name_of[p] = static_cast<std::uint32_t>(state_.points.size());
        state_.add_point(division.points.nearest(p), rounding_bound(division.points, p));
    }
    for (Triangle& t : division.triangles)
        for (std::uint32_t& v : t)
            if (v >= first_new) v = name_of[v];
    state_.replace_triangles(std::move(division.triangles), division.faces_of);
    return true;
}

} // namespace terrane::rounding::detail
