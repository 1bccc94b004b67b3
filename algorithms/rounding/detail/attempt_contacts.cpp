// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Searches for pairs of triangles that meet improperly after a rounding.
#include <terrane/algorithms/rounding/detail/attempt.hpp>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <numeric>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/intersection/injective_patches.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/rounding/detail/repair.hpp>
#include <terrane/algorithms/rounding/detail/separation.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::rounding::detail {
namespace {

/// Adds the parts of triangles of which the arrangement's neighbours leave pairs out.
void add_crowded_parts(const Arrangement& a, std::span<const std::uint32_t> among,
                       std::vector<std::uint32_t>& parts) {
    const auto& crowded = a.state->crowded;
    if (crowded.empty()) return;
    for (const std::uint32_t t : among)
        if (std::any_of(a.parents_of[t].begin(), a.parents_of[t].end(), [&](std::uint32_t parent) {
                return std::binary_search(crowded.begin(), crowded.end(), parent);
            }))
            parts.push_back(t);
}

} // namespace

bool Rounding::is_improper(const CandidatePair& p) const {
    return improper_contact(state_.points, state_.triangles[p.first], state_.triangles[p.second])
        .has_value();
}

/// Returns whether a pair that a search finds meets improperly. In a crowd it leaves pairs out that
/// tell nothing new.
bool Rounding::is_found(const CandidatePair& p) {
    if (crowd_ && crowd_->adds_nothing(p)) return false;
    if (!is_improper(p)) return false;
    if (crowd_) {
        crowd_->add(p);
        if (ends_when_full_ && crowd_->is_full()) full_.request_stop();
    }
    return true;
}

/// Finds the contacts of sampled triangles, or somewhat more than can be listed.
std::vector<CandidatePair> Rounding::sampled_contacts() {
    // Each of these contacts has a sampled triangle, and one with a dirty corner.
    const auto is_in_sample = [&](std::uint32_t t) { return is_sampled(state_.parents_of[t][0]); };
    std::vector<std::uint32_t> active;
    for (std::uint32_t t = 0; t < state_.triangles.size(); ++t)
        if (is_in_sample(t)) active.push_back(t);
    auto dirty = state_.dirty_triangles(run_);
    if (dirty.size() < active.size()) active = std::move(dirty);
    std::atomic<std::size_t> count = 0;
    std::stop_source enough;
    const std::stop_callback also(run_.stop, [&] { enough.request_stop(); });
    Run until_enough = quiet_;
    until_enough.stop = enough.get_token();
    const auto improper = [&](const CandidatePair& p) {
        if (!is_in_sample(p.first) && !is_in_sample(p.second)) return false;
        if (!is_improper(p)) return false;
        if (++count > most_sampled) enough.request_stop();
        return true;
    };
    return candidate_pairs_of({state_.points, state_.triangles}, active, {}, improper,
                              until_enough);
}

/// Finds the pairs that meet improperly.
std::vector<CandidatePair> Rounding::contacts(const Run& run) {
    return find_contacts(
        state_, tests_all(), [&](const CandidatePair& p) { return is_found(p); }, run);
}

/// Takes a sample of the parts, where it has less than half of the triangles.
void Rounding::take_sample() {
    const std::size_t inputs = arrangement_.state->corners.size();
    // Otherwise most inputs have few parts, all of which the sample would have.
    if (state_.triangles.size() < rounding_tuning.sampled * inputs) return;
    sample_ = sample_of_parts(state_.parents_of, rounding_tuning.sampled);
    if (2 * sample_.size() > state_.triangles.size()) sample_.clear();
}

/// Finds the first contacts. Where a sample tells enough of a crowd, or nobody asks about it, the
/// search ends as soon as the crowd is full.
std::vector<CandidatePair> Rounding::first_contacts_until_full() {
    const Run run = part_of_stage(run_, "round", 0.2, 0.7);
    if (!crowd_) return first_contacts(run);
    if (repairs_ != Repairs::all) take_sample();
    ends_when_full_ = repairs_ == Repairs::all || !sample_.empty();
    if (!ends_when_full_) return first_contacts(run);
    const std::stop_callback also(run_.stop, [this] { full_.request_stop(); });
    Run until_full = run;
    until_full.stop = full_.get_token();
    return first_contacts(until_full);
}

/// Finds the lowest pairs that meet improperly: as many as asked for, or all.
std::vector<CandidatePair> Rounding::lowest_contacts(std::size_t most) {
    const std::size_t count = state_.triangles.size();
    std::vector<CandidatePair> found;
    for (std::size_t begin = 0, size = 256; begin < count && found.size() < most; size *= 2) {
        const std::size_t end = std::min(begin + size, count);
        std::vector<std::uint32_t> active(end - begin);
        std::iota(active.begin(), active.end(), static_cast<std::uint32_t>(begin));
        auto pairs = candidate_pairs_of(
            {state_.points, state_.triangles}, active, {},
            [&](const CandidatePair& p) {
                return std::min(p.first, p.second) >= begin && is_improper(p);
            },
            quiet_);
        sort_unique(pairs);
        found.insert(found.end(), pairs.begin(), pairs.end());
        begin = end;
    }
    if (found.size() > most) found.resize(most);
    return found;
}

/// Finds the pairs that meet improperly right after rounding to nearest. Only pairs that neither
/// injective patches nor the separation of faces exclude need a test.
std::vector<CandidatePair> Rounding::first_contacts(const Run& run) {
    if (changed_ || tests_all()) return contacts(run);
    if (moved_.frame != nullptr) return contacts_in_frame(run);
    const Arrangement& a = arrangement_;
    const auto& dirty = state_.found_dirty;
    if (dirty.empty()) return {};
    std::vector<bool> holds;         // per patch
    std::uint32_t last = UINT32_MAX; // the parts of a face are consecutive
    Sign last_turn{};
    const auto turn = [&](std::uint32_t t, Axis axis) { // a part is oriented as its parent
        const std::uint32_t parent = a.parents_of[t][0];
        if (parent == last) return last_turn;
        const Triangle& c = a.state->corners[last = parent];
        const auto at = [&](unsigned i) { return a.state->points.input(c[i]); };
        return last_turn = orient2d(axis, at(0), at(1), at(2));
    };
    Unproven unproven;
    both(
        run_,
        [&] {
            holds = recheck_injective_patches(state_.points, state_.triangles, a.state->adjacency,
                                              dirty, state_.is_dirty, turn, a.state->patches);
        },
        [&] { unproven = find_unproven(moved_parts(), a.state->neighbours, run_); });
    std::vector<CandidatePair> pairs;
    {
        const UpwardRounding guard;
        for (const CandidatePair& p : unproven.pairs)
            if (is_improper(p)) pairs.push_back(p);
    }
    sort_unique(pairs);
    const auto patch_of = [&](std::uint32_t t) {
        const std::uint32_t p = a.state->patches.of[t];
        return p != no_group && holds[p] ? p : no_group;
    };
    for (const std::uint32_t t : dirty)
        if (patch_of(t) != a.state->patches.of[t]) unproven.parts.push_back(t);
    const Pools pools = find_pools();
    for (const std::uint32_t t : unproven.ill_conditioned) // parts of one patch meet properly
        if (patch_of(t) == no_group && !pools.has(t)) unproven.parts.push_back(t);
    add_crowded_parts(a, dirty, unproven.parts);
    const bool counts = options_.check.most_counted(arrangement_.triangles.size()) > 0;
    if (unproven.parts.empty() && pools.of.empty() && !counts) return pairs;
    sort_unique(unproven.parts);
    std::vector<std::uint32_t> patches(state_.triangles.size());
    for (std::uint32_t t = 0; t < patches.size(); ++t) patches[t] = patch_of(t);
    if (counts) first_search_ = {unproven.pairs, unproven.parts, dirty, patches, pools};
    if (!unproven.parts.empty()) {
        const auto improper_beyond_pools = [&](const CandidatePair& p) {
            return !pools.has_both(p) && is_found(p);
        };
        const auto more = candidate_pairs_of({state_.points, state_.triangles}, unproven.parts,
                                             patches, improper_beyond_pools, run);
        pairs.insert(pairs.end(), more.begin(), more.end());
    }
    const auto more = contacts_in_pools(pools, patches, without_progress(run));
    pairs.insert(pairs.end(), more.begin(), more.end());
    sort_unique(pairs);
    return pairs;
}

/// Finds the pairs that meet improperly, where any corner may have moved on the way out of a frame.
/// Only pairs that injective patches do not exclude need a test.
std::vector<CandidatePair> Rounding::contacts_in_frame(const Run& run) {
    const auto& triangles = state_.triangles;
    std::vector<std::uint32_t> surface_of;
    surface_of.reserve(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        surface_of.push_back(arrangement_.surfaces_of[t][0]);
    const EdgeSides edges = group_edges(triangles, state_.points.size(), run_);
    auto patches = find_injective_patches(state_.points, triangles, surface_of, edges, run_).of;
    auto pairs = candidate_pairs_of(
        {state_.points, triangles}, state_.found_dirty, patches,
        [&](const CandidatePair& p) { return is_found(p); }, run);
    if (options_.check.most_counted(triangles.size()) > 0)
        first_search_ = {{}, state_.found_dirty, state_.found_dirty, std::move(patches), {}};
    return pairs;
}

MovedParts Rounding::moved_parts() const {
    const Arrangement& a = arrangement_;
    return {a.state->points.inputs(), a.state->corners, a.vertices, state_.points, state_.move,
            state_.triangles,         a.parents_of};
}

/// Returns the pool of each triangle. The triangles must still be those of the arrangement.
Pools Rounding::find_pools() const {
    Pools pools;
    const auto& of_parents = arrangement_.state->pools;
    if (of_parents.empty()) return pools;
    pools.parents_of = &arrangement_.parents_of;
    pools.of.resize(state_.triangles.size());
    std::vector<std::uint32_t> pooled, keys;
    std::uint32_t count = 0;
    for (std::uint32_t t = 0; t < pools.of.size(); ++t) {
        const std::uint32_t pool = pools.of[t] = of_parents[arrangement_.parents_of[t][0]];
        if (pool == no_group) continue;
        pooled.push_back(t);
        keys.push_back(pool);
        count = std::max(count, pool + 1);
    }
    pools.triangles =
        lists_by_key<std::uint32_t>(count, keys, [&](std::size_t i) { return pooled[i]; });
    pools.is_ill_conditioned = ill_conditioned_in_pools(moved_parts(), pools.triangles);
    return pools;
}

/// Finds the pairs within pools that meet improperly right after rounding to nearest.
std::vector<CandidatePair> Rounding::contacts_in_pools(const Pools& pools,
                                                       std::span<const std::uint32_t> patches,
                                                       const Run& run) {
    std::vector<CandidatePair> found;
    for (std::size_t k = 0; k < pools.triangles.size(); ++k) {
        const auto pool = pools.triangles[k];
        std::vector<std::uint32_t> active, groups;
        std::vector<Triangle> triangles;
        for (std::uint32_t i = 0; i < pool.size(); ++i) {
            const Triangle& c = state_.triangles[pool[i]];
            if (state_.is_dirty[c[0]] || state_.is_dirty[c[1]] || state_.is_dirty[c[2]])
                active.push_back(i);
            triangles.push_back(c);
            groups.push_back(patches[pool[i]]);
        }
        const auto of_mesh = [&](const CandidatePair& p) -> CandidatePair {
            return {pool[p.first], pool[p.second]};
        };
        const auto improper = [&](const CandidatePair& p) {
            return pools.need_test(of_mesh(p)) && is_found(of_mesh(p));
        };
        const auto pairs =
            candidate_pairs_of({state_.points, triangles}, active, groups, improper, run);
        for (const CandidatePair& p : pairs) found.push_back(of_mesh(p));
    }
    return found;
}

/// Returns the parents of contacts between the parts of the sample.
ParentsInContact Rounding::contacts_of_sample() const {
    CrowdedContacts among(state_.parents_of, arrangement_.state->corners.size(), 0);
    std::vector<Triangle> triangles;
    for (const std::uint32_t t : sample_) triangles.push_back(state_.triangles[t]);
    std::vector<std::uint32_t> all(sample_.size());
    std::iota(all.begin(), all.end(), 0U);
    const auto collect = [&](const CandidatePair& p) {
        const CandidatePair parts{sample_[p.first], sample_[p.second]};
        if (!among.adds_nothing(parts) && is_improper(parts)) among.add(parts);
        return false; // none is listed
    };
    (void)candidate_pairs_of({state_.points, triangles}, all, {}, collect, quiet_);
    return among.parents();
}

} // namespace terrane::rounding::detail
