// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/places.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <unordered_set>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/rounding/detail/tuning.hpp>

namespace terrane::rounding::detail {
namespace {

/// Where triangles meet improperly, and what a repair looks at.
struct Place {
    std::vector<std::uint32_t> corners;   ///< of the triangles in contact, ascending
    std::vector<Box> covered;             ///< all triangles that overlap one of these are needed
    std::vector<std::uint32_t> triangles; ///< these, ascending
    unsigned widenings = 0;
};

/// A repaired place.
struct Mended {
    RoundingState state; ///< of its triangles; their origins are positions in Place::triangles
    std::vector<std::uint32_t> points; ///< the first points of `state`, in the mesh
};

/// What became of an attempt.
struct Attempt {
    std::optional<Mended> mended;
    std::vector<Box>
        missing; ///< if it is not mended: what has to be covered, too; empty: it can't be
};

class Places {
public:
    Places(RoundingState& state, const RepairTask& task, const Run& run) :
        state_(state), task_(task), run_(run), quiet_(without_progress(run)),
        largest_(task.largest) {
        quiet_.threads = 1;
        for (const Point3& p : state_.points)
            largest_ = {std::max(largest_[0], std::fabs(p.x)),
                        std::max(largest_[1], std::fabs(p.y)),
                        std::max(largest_[2], std::fabs(p.z))};
    }

    std::vector<CandidatePair> operator()(std::vector<CandidatePair> pairs) {
        for (unsigned sweep = 0;
             sweep < rounding_tuning.place_repeats && !pairs.empty() && !stopped(); ++sweep) {
            if (!mend(places_of(pairs))) break;
            pairs = find_contacts(state_, task_.tests_all, is_improper(), quiet_);
        }
        return pairs;
    }

private:
    [[nodiscard]] bool stopped() const { return run_.stop.stop_requested(); }
    [[nodiscard]] PairFilter is_improper() const {
        return [this](const CandidatePair& p) {
            return improper_contact(state_.points, state_.triangles[p.first],
                                    state_.triangles[p.second])
                .has_value();
        };
    }

    std::vector<Place> places_of(std::span<const CandidatePair> pairs) const;
    void gather(std::span<Place> places) const;
    bool mend(std::vector<Place> places);
    [[nodiscard]] std::size_t hash_of(const Place& place) const;
    [[nodiscard]] Attempt attempt(const Place& place) const;
    [[nodiscard]] RoundingState part_of(const Place& place,
                                        std::vector<std::uint32_t>& points) const;
    void put_back(std::span<const Place> places, std::vector<std::optional<Mended>>& mended);
    [[nodiscard]] Box widened(Box box) const;

    RoundingState& state_;
    const RepairTask& task_;
    const Run& run_;
    Run quiet_;
    std::array<double, 3> largest_;
    std::unordered_set<std::size_t> hopeless_; ///< hashes of places that can't be mended
};

/// Returns a number for the triangles of a place, with their coordinates.
std::size_t Places::hash_of(const Place& place) const {
    std::size_t hash = place.triangles.size();
    const PointHash of_point;
    for (const std::uint32_t t : place.triangles)
        for (const std::uint32_t v : state_.triangles[t])
            hash = hash * 0x9e3779b97f4a7c15U + of_point(state_.points[v]);
    return hash;
}

/// Makes a box larger by what snapping moves, so that it need not be asked for again after a move.
Box Places::widened(Box box) const {
    constexpr int digits = rounding_tuning.fine_digits.back() + 2;
    for (unsigned k = 0; k < 3; ++k) {
        const double room =
            std::ldexp(std::max(largest_[k], std::numeric_limits<double>::min()), digits - 52);
        box.low[k] -= room;
        box.high[k] += room;
    }
    return box;
}

std::vector<Place> Places::places_of(std::span<const CandidatePair> pairs) const {
    DisjointSets sets(state_.points.size());
    std::vector<std::uint32_t> corners;
    for (const CandidatePair& p : pairs)
        for (const std::uint32_t t : {p.first, p.second})
            for (const std::uint32_t v : state_.triangles[t]) {
                sets.join(v, state_.triangles[p.first][0]);
                corners.push_back(v);
            }
    sort_unique(corners);
    std::map<std::uint32_t, std::uint32_t> number; // of the place with this root
    std::vector<Place> places;
    std::vector<std::uint32_t> place_of(state_.points.size(), UINT32_MAX);
    for (const std::uint32_t v : corners) {
        const auto [at, is_new] =
            number.try_emplace(sets.find(v), static_cast<std::uint32_t>(places.size()));
        if (is_new) places.emplace_back();
        places[at->second].corners.push_back(v);
        place_of[v] = at->second;
    }
    for (const Triangle& t : state_.triangles)
        for (const std::uint32_t v : t)
            if (place_of[v] != UINT32_MAX)
                places[place_of[v]].covered.push_back(widened(box_of(state_.points, t)));
    return places;
}

/// Finds the triangles that the places need.
void Places::gather(std::span<Place> places) const {
    std::vector<Box> boxes;
    std::vector<std::uint32_t> owner;
    for (std::uint32_t p = 0; p < places.size(); ++p) {
        places[p].covered = united(std::move(places[p].covered));
        places[p].triangles.clear();
        for (const Box& box : places[p].covered) {
            boxes.push_back(box);
            owner.push_back(p);
        }
    }
    const auto first = static_cast<std::uint32_t>(boxes.size());
    std::vector<std::uint32_t> active(first);
    std::iota(active.begin(), active.end(), 0U);
    for (const Triangle& t : state_.triangles) boxes.push_back(box_of(state_.points, t));
    std::vector<std::uint32_t> groups(boxes.size(), no_group);
    std::fill_n(groups.begin(), first, 0U);
    for (const CandidatePair& p : candidate_pairs_of(boxes, active, groups, {}, quiet_))
        places[owner[p.first]].triangles.push_back(p.second - first);
    for (Place& place : places) sort_unique(place.triangles);
}

/// Mends the places, several at a time if they have no triangle in common. Returns whether one was mended.
bool Places::mend(std::vector<Place> places) {
    bool any = false;
    while (!places.empty() && !stopped()) {
        gather(places);
        std::vector<bool> is_taken(state_.triangles.size());
        std::vector<Place> now, later;
        for (Place& place : places) {
            if (hopeless_.contains(hash_of(place))) continue;
            const bool is_free =
                std::ranges::none_of(place.triangles, [&](std::uint32_t t) { return is_taken[t]; });
            if (is_free)
                for (const std::uint32_t t : place.triangles) is_taken[t] = true;
            (is_free ? now : later).push_back(std::move(place));
        }
        auto attempts = for_blocks<std::optional<Attempt>>(
            now.size(), 1, run_, [&](std::size_t k, std::size_t) { return attempt(now[k]); });
        std::vector<std::optional<Mended>> mended(now.size());
        for (std::size_t k = 0; k < now.size(); ++k) {
            if (!attempts[k]) continue; // stopped
            if (!attempts[k]->missing.empty() &&
                ++now[k].widenings < rounding_tuning.place_repeats) {
                Place wider = now[k];
                wider.covered.insert(wider.covered.end(), attempts[k]->missing.begin(),
                                     attempts[k]->missing.end());
                later.push_back(std::move(wider));
            }
            mended[k] = std::move(attempts[k]->mended);
            if (!mended[k] && attempts[k]->missing.empty()) hopeless_.insert(hash_of(now[k]));
            any = any || mended[k].has_value();
        }
        put_back(now, mended);
        places = std::move(later);
    }
    return any;
}

RoundingState Places::part_of(const Place& place, std::vector<std::uint32_t>& points) const {
    for (const std::uint32_t t : place.triangles)
        points.insert(points.end(), state_.triangles[t].begin(), state_.triangles[t].end());
    sort_unique(points);
    const auto here = [&](std::uint32_t v) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(points, v) - points.begin());
    };
    RoundingState part;
    part.input_vertices = here(static_cast<std::uint32_t>(state_.input_vertices));
    for (const std::uint32_t v : points) {
        part.points.push_back(state_.points[v]);
        part.move.push_back(state_.move[v]);
        part.is_dirty.push_back(std::ranges::binary_search(place.corners, v));
    }
    for (const std::uint32_t t : place.triangles) {
        const Triangle& c = state_.triangles[t];
        part.triangles.push_back({here(c[0]), here(c[1]), here(c[2])});
        part.parents_of.push_back(state_.parents_of[t]);
    }
    part.origins.resize(part.triangles.size());
    std::iota(part.origins.begin(), part.origins.end(), 0U);
    part.triangles_elsewhere = state_.triangles.size() - part.triangles.size();
    part.deviation = state_.deviation;
    part.gaps = state_.gaps;
    return part;
}

/// Repairs a place on the first grid that leaves nothing in contact.
Attempt Places::attempt(const Place& place) const {
    Mended mended;
    const RoundingState before = part_of(place, mended.points);
    const BoxCover covered(place.covered);
    RepairTask task = task_;
    task.largest = largest_;
    task.covered = &covered;
    Attempt out;
    double last = 0;
    for (const int digits : rounding_tuning.place_digits) {
        mended.state = before;
        Repair repair(mended.state, task, quiet_);
        const auto grid = repair.grid(digits);
        if (!grid || grid->reach() == last) break; // coarser ones are as fine
        last = grid->reach();
        if (repair.on_grid(*grid)) {
            out.mended = std::move(mended);
            return out;
        }
        for (const Box& box : repair.missing()) out.missing.push_back(widened(box));
        if (!out.missing.empty()) break;
    }
    return out;
}

/// Puts the triangles of mended places back into the mesh.
void Places::put_back(std::span<const Place> places, std::vector<std::optional<Mended>>& mended) {
    constexpr std::uint32_t none = UINT32_MAX;
    std::vector<std::uint32_t> owner(state_.triangles.size(), none);
    std::vector<std::vector<std::uint32_t>> name_of(places.size()); // points in the mesh
    double deviation = state_.deviation, gaps = state_.gaps;
    for (std::uint32_t k = 0; k < places.size(); ++k) {
        if (!mended[k]) continue;
        for (const std::uint32_t t : places[k].triangles) owner[t] = k;
        const RoundingState& part = mended[k]->state;
        name_of[k] = mended[k]->points;
        for (std::size_t v = 0; v < part.points.size(); ++v) {
            if (v == name_of[k].size()) {
                name_of[k].push_back(static_cast<std::uint32_t>(state_.points.size()));
                state_.add_point(part.points[v], part.move[v]);
            }
            const std::uint32_t there = name_of[k][v];
            // Others may be the corners of another place, which is still to be repaired.
            if (state_.points[there] != part.points[v] || v >= mended[k]->points.size() ||
                std::ranges::binary_search(places[k].corners, there))
                state_.is_dirty[there] = false;
            state_.points[there] = part.points[v];
            state_.move[there] = part.move[v];
            if (v < part.was_searched.size() && part.was_searched[v]) {
                state_.was_searched.resize(
                    std::max(state_.was_searched.size(), state_.points.size()));
                state_.was_searched[there] = true;
            }
            if (v < part.is_merged.size() && part.is_merged[v]) {
                state_.is_merged.resize(std::max(state_.is_merged.size(), state_.points.size()));
                state_.is_merged[there] = true;
            }
        }
        deviation = std::max(deviation, part.deviation);
        gaps = std::max(gaps, part.total_gaps());
        state_.collapsed += part.collapsed;
    }
    std::vector<Triangle> triangles;
    IndexLists<std::uint32_t> parents_of;
    std::vector<std::uint32_t> next(places.size()), position(places.size()), origins;
    for (std::uint32_t t = 0; t < state_.triangles.size(); ++t) {
        const std::uint32_t k = owner[t];
        if (k == none) {
            triangles.push_back(state_.triangles[t]);
            parents_of.push_back(state_.parents_of[t]);
            if (!state_.origins.empty()) origins.push_back(state_.origins[t]);
            continue;
        }
        const RoundingState& part = mended[k]->state;
        const std::uint32_t here = position[k]++;
        for (std::uint32_t& n = next[k]; n < part.triangles.size() && part.origins[n] == here;
             ++n) {
            const Triangle& c = part.triangles[n];
            triangles.push_back({name_of[k][c[0]], name_of[k][c[1]], name_of[k][c[2]]});
            parents_of.push_back(part.parents_of[n]);
            if (!state_.origins.empty()) origins.push_back(state_.origins[t]);
        }
    }
    state_.triangles = std::move(triangles);
    state_.parents_of = std::move(parents_of);
    state_.origins = std::move(origins);
    state_.deviation = deviation;
    state_.gaps = gaps;
    state_.found_dirty.clear();
}

} // namespace

std::vector<CandidatePair> repair_places(RoundingState& state, const RepairTask& task,
                                         std::vector<CandidatePair> pairs, const Run& run) {
    return Places(state, task, run)(std::move(pairs));
}

} // namespace terrane::rounding::detail
