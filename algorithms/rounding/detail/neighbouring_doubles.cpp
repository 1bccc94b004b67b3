// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/neighbouring_doubles.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>
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

/// Returns the double that is `steps` doubles from x; x where a kept plane is there or in between.
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
            for (const std::uint32_t v : vertices_)
                if (around_.at(v).is_new) moved = improve(v) || moved;
            any = any || moved;
            if (moved) state_.end_round(); // so far each vertex has moved once at most
        }
        return any;
    }

private:
    /// The surroundings of a vertex that may move.
    struct Around {
        std::vector<std::uint32_t> star;    ///< its triangles
        std::vector<CandidatePair> pairs;   ///< of one of its triangles with one near it
        std::vector<std::uint32_t> corners; ///< all other corners of these triangles
        bool is_new = true;                 ///< whether anything moved since it did not improve
    };

    void find_vertices(std::span<const CandidatePair> pairs);
    void find_near();
    bool improve(std::uint32_t v);
    std::size_t contacts_in(Around& around, std::size_t most) const;
    [[nodiscard]] bool is_possible(std::uint32_t v, const Around& around) const;
    void note_move(const Around& around);
    [[nodiscard]] bool meet_improperly(std::uint32_t t, std::uint32_t u) const;

    RoundingState& state_;
    const KeptPlanes& kept_;
    const double limit_;
    const Run& run_;
    const std::vector<Steps> steps_;
    std::vector<std::uint32_t> vertices_;    ///< may move: most contacts first
    std::map<std::uint32_t, Around> around_; ///< per vertex that may move
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
                around_[v].star.push_back(t);
                active.push_back(t);
            }
    sort_unique(active);
    const auto near = candidate_pairs_of({state_.points, state_.triangles}, active, {}, {},
                                         without_progress(run_));
    for (const CandidatePair& p : near) {
        std::vector<std::uint32_t> corners;
        for (const std::uint32_t t : {p.first, p.second})
            corners.insert(corners.end(), state_.triangles[t].begin(), state_.triangles[t].end());
        sort_unique(corners);
        for (const std::uint32_t v : corners) {
            if (!may_move[v]) continue;
            Around& around = around_[v];
            around.pairs.push_back(p);
            for (const std::uint32_t w : corners)
                if (w != v) around.corners.push_back(w);
        }
    }
    for (auto& [v, around] : around_) sort_unique(around.corners);
}

bool NeighbourSearch::meet_improperly(std::uint32_t t, std::uint32_t u) const {
    return improper_contact(state_.points, state_.triangles[t], state_.triangles[u]).has_value();
}

/// Returns the number of pairs that meet improperly, or `most` if it is not less. These come first
/// the next time, as pairs that met often still do.
std::size_t NeighbourSearch::contacts_in(Around& around, std::size_t most) const {
    std::size_t count = 0;
    for (std::size_t k = 0; k < around.pairs.size() && count < most; ++k)
        if (meet_improperly(around.pairs[k].first, around.pairs[k].second))
            std::swap(around.pairs[count++], around.pairs[k]);
    return count;
}

/// Tells whether the triangles of v have areas, and no other point near is where v is.
bool NeighbourSearch::is_possible(std::uint32_t v, const Around& around) const {
    const auto& points = state_.points;
    for (const std::uint32_t t : around.star) {
        const Triangle& c = state_.triangles[t];
        if (collinear(points[c[0]], points[c[1]], points[c[2]])) return false;
    }
    return std::none_of(around.corners.begin(), around.corners.end(),
                        [&](std::uint32_t w) { return points[w] == points[v]; });
}

/// Notes that a vertex has moved. Others that are not near would find what they have found before.
void NeighbourSearch::note_move(const Around& around) {
    for (const std::uint32_t w : around.corners)
        if (const auto at = around_.find(w); at != around_.end()) at->second.is_new = true;
}

/// Moves v to the nearest place with the fewest contacts, if there are fewer than now.
bool NeighbourSearch::improve(std::uint32_t v) {
    Around& around = around_.at(v);
    around.is_new = false;
    std::size_t fewest = contacts_in(around, SIZE_MAX);
    if (fewest == 0) return false;
    const Point3 from = state_.points[v];
    std::optional<Point3> best;
    for (const Steps& s : steps_) {
        if (fewest == 0) break;
        const Point3 to{stepped(from.x, s[0], kept_[0]), stepped(from.y, s[1], kept_[1]),
                        stepped(from.z, s[2], kept_[2])};
        if (state_.deviation + distance(from, to) > limit_) continue;
        state_.points[v] = to;
        if (!is_possible(v, around)) continue;
        const std::size_t count = contacts_in(around, fewest);
        if (count >= fewest) continue;
        fewest = count;
        best = to;
    }
    state_.points[v] = from;
    if (!best) return false;
    state_.move_point(v, *best);
    around.is_new = true; // it may gain more from there
    note_move(around);
    return true;
}

} // namespace

bool search_neighbouring_doubles(RoundingState& state, std::span<const CandidatePair> pairs,
                                 const KeptPlanes& kept, double limit, const Run& run) {
    return NeighbourSearch(state, kept, limit, run)(pairs);
}

} // namespace terrane::rounding::detail
