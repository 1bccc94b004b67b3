// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/neighbouring_doubles.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/rounding/detail/tuning.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::rounding::detail {
namespace {

/// Steps along the axes, in doubles.
using Steps = std::array<int, 3>;

/// Returns all steps but none at all, short ones first.
std::vector<Steps> all_steps() {
    constexpr int most = rounding_tuning.search_steps;
    std::vector<Steps> all;
    for (int i = -most; i <= most; ++i)
        for (int j = -most; j <= most; ++j)
            for (int k = -most; k <= most; ++k)
                if (i != 0 || j != 0 || k != 0) all.push_back({i, j, k});
    std::stable_sort(all.begin(), all.end(), [](const Steps& a, const Steps& b) {
        const auto square = [](const Steps& s) { return s[0] * s[0] + s[1] * s[1] + s[2] * s[2]; };
        return square(a) < square(b);
    });
    return all;
}

/// Returns the double so many steps from x; x where a kept plane is there or in between.
double stepped(double x, int steps, std::span<const double> planes) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double to = x;
    for (; steps > 0; --steps) to = std::nextafter(to, infinity);
    for (; steps < 0; ++steps) to = std::nextafter(to, -infinity);
    const auto plane = std::lower_bound(planes.begin(), planes.end(), std::min(x, to));
    return plane != planes.end() && *plane <= std::max(x, to) ? x : to;
}

double distance(const Point3& p, const Point3& q) {
    return distance_bound({{p.x, p.y, p.z}, {p.x, p.y, p.z}}, q);
}

class NeighbourSearch {
public:
    NeighbourSearch(RoundingState& state, const KeptPlanes& kept, double limit, const Run& run) :
        state_(state), kept_(kept), limit_(limit), run_(run), steps_(all_steps()) {}

    bool operator()(std::span<const CandidatePair> pairs) {
        find_vertices(pairs);
        find_near();
        const UpwardRounding guard;
        bool any = false;
        for (bool moved = true; moved && !run_.stop.stop_requested();) {
            moved = false;
            for (const std::uint32_t v : vertices_) moved = improve(v) || moved;
            any = any || moved;
            if (moved) state_.end_round(); // so far each vertex has moved once at most
        }
        return any;
    }

private:
    void find_vertices(std::span<const CandidatePair> pairs);
    void find_near();
    bool improve(std::uint32_t v);
    [[nodiscard]] std::size_t contacts_at(std::uint32_t v, std::size_t most) const;
    [[nodiscard]] bool is_possible(std::uint32_t v) const;
    [[nodiscard]] bool meet_improperly(std::uint32_t t, std::uint32_t u) const;

    RoundingState& state_;
    const KeptPlanes& kept_;
    const double limit_;
    const Run& run_;
    const std::vector<Steps> steps_;
    std::vector<std::uint32_t> vertices_;                       ///< may move: most contacts first
    std::map<std::uint32_t, std::vector<std::uint32_t>> stars_; ///< their triangles
    std::map<std::uint32_t, std::vector<CandidatePair>>
        around_; ///< per vertex: pairs of one of its
                 ///< triangles with one near it
};

void NeighbourSearch::find_vertices(std::span<const CandidatePair> pairs) {
    std::map<std::uint32_t, std::size_t> contacts;
    for (const CandidatePair& p : pairs)
        for (const std::uint32_t t : {p.first, p.second})
            for (const std::uint32_t v : state_.triangles[t])
                if (v >= state_.input_vertices) ++contacts[v];
    for (const auto& [v, count] : contacts) vertices_.push_back(v);
    std::stable_sort(vertices_.begin(), vertices_.end(), [&](std::uint32_t v, std::uint32_t w) {
        return contacts.at(v) > contacts.at(w);
    });
}

void NeighbourSearch::find_near() {
    std::vector<bool> may_move(state_.points.size(), false);
    for (const std::uint32_t v : vertices_) may_move[v] = true;
    std::vector<std::uint32_t> active;
    for (std::uint32_t t = 0; t < state_.triangles.size(); ++t)
        for (const std::uint32_t v : state_.triangles[t])
            if (may_move[v]) {
                stars_[v].push_back(t);
                active.push_back(t);
            }
    sort_unique(active);
    const auto near = candidate_pairs_of({state_.points, state_.triangles}, active, {}, {},
                                         without_progress(run_));
    for (const CandidatePair& p : near) {
        std::vector<std::uint32_t> corners;
        for (const std::uint32_t t : {p.first, p.second})
            for (const std::uint32_t v : state_.triangles[t])
                if (may_move[v]) corners.push_back(v);
        sort_unique(corners);
        for (const std::uint32_t v : corners) around_[v].push_back(p);
    }
}

bool NeighbourSearch::meet_improperly(std::uint32_t t, std::uint32_t u) const {
    return improper_contact(state_.points, state_.triangles[t], state_.triangles[u]).has_value();
}

/// Returns the number of pairs round v that meet improperly, or `most` if it is not less.
std::size_t NeighbourSearch::contacts_at(std::uint32_t v, std::size_t most) const {
    const auto at = around_.find(v);
    if (at == around_.end()) return 0;
    std::size_t count = 0;
    for (const CandidatePair& p : at->second) {
        if (count >= most) break;
        count += meet_improperly(p.first, p.second) ? 1 : 0;
    }
    return count;
}

/// Tells whether the triangles of v have areas, and no other point near is where v is.
bool NeighbourSearch::is_possible(std::uint32_t v) const {
    const auto& points = state_.points;
    for (const std::uint32_t t : stars_.at(v)) {
        const Triangle& c = state_.triangles[t];
        if (collinear(points[c[0]], points[c[1]], points[c[2]])) return false;
    }
    const auto at = around_.find(v);
    if (at == around_.end()) return true;
    return std::all_of(at->second.begin(), at->second.end(), [&](const CandidatePair& p) {
        for (const std::uint32_t t : {p.first, p.second})
            for (const std::uint32_t w : state_.triangles[t])
                if (w != v && points[w] == points[v]) return false;
        return true;
    });
}

/// Moves v to the nearest place with the fewest contacts, if there are fewer than now.
bool NeighbourSearch::improve(std::uint32_t v) {
    std::size_t fewest = contacts_at(v, SIZE_MAX);
    if (fewest == 0) return false;
    const Point3 from = state_.points[v];
    std::optional<Point3> best;
    for (const Steps& s : steps_) {
        if (fewest == 0) break;
        const Point3 to{stepped(from.x, s[0], kept_[0]), stepped(from.y, s[1], kept_[1]),
                        stepped(from.z, s[2], kept_[2])};
        if (state_.deviation + distance(from, to) > limit_) continue;
        state_.points[v] = to;
        if (!is_possible(v)) continue;
        const std::size_t count = contacts_at(v, fewest);
        if (count >= fewest) continue;
        fewest = count;
        best = to;
    }
    state_.points[v] = from;
    if (best) state_.move_point(v, *best);
    return best.has_value();
}

} // namespace

bool search_neighbouring_doubles(RoundingState& state, std::span<const CandidatePair> pairs,
                                 const KeptPlanes& kept, double limit, const Run& run) {
    return NeighbourSearch(state, kept, limit, run)(pairs);
}

} // namespace terrane::rounding::detail
