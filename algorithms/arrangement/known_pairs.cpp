// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/arrangement/known_pairs.hpp>

#include <algorithm>
#include <atomic>
#include <utility>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/point_table.hpp>
#include <terrane/algorithms/mesh/triangle_table.hpp>

namespace terrane {

/// The triangles and pairs of an arrangement.
struct KnownPairs::Kept {
    std::vector<Point3> points;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> patches;
    std::vector<CandidatePair> candidates; ///< sorted
    std::vector<char> apart;               ///< per candidate: whether it is not near
};

namespace {

/// New triangles with more pairs than this on average are found anew with all others, as the search
/// can then find pencils and leave out most of their pairs.
constexpr std::size_t most_pairs = 256;

/// Returns for each point the first of the old ones with its coordinates, or no_index.
std::vector<std::uint32_t> old_points(std::span<const Point3> old, std::span<const Point3> points) {
    PointTable table(old.size());
    std::vector<std::uint32_t> first(old.size());
    for (std::uint32_t v = 0; v < old.size(); ++v) first[v] = table.enter(old, v);
    std::vector<std::uint32_t> found(points.size());
    std::size_t next = 0; // most points follow in the same order
    for (std::size_t v = 0; v < points.size(); ++v) {
        const bool follows = next < old.size() && old[next] == points[v];
        found[v] = follows ? first[next] : table.find(old, points[v]);
        if (found[v] != no_index) next = (follows ? next : found[v]) + 1;
    }
    return found;
}

/// Returns for each triangle the old one with the same corners in the same order, or no_index.
std::vector<std::uint32_t> old_triangles(std::span<const Triangle> old,
                                         std::span<const Triangle> triangles,
                                         std::span<const std::uint32_t> old_point) {
    TriangleTable table(old.size());
    for (std::uint32_t t = 0; t < old.size(); ++t) table.enter(old, t);
    std::vector<std::uint32_t> found(triangles.size(), no_index);
    std::uint32_t next = 0; // most triangles follow in the same order
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto& [a, b, c] = triangles[t];
        const Triangle wanted{old_point[a], old_point[b], old_point[c]};
        if (std::ranges::count(wanted, no_index) > 0) continue;
        found[t] = next < old.size() && old[next] == wanted ? next : table.find(old, wanted);
        if (found[t] != no_index) next = found[t] + 1;
    }
    return found;
}

/// Strikes out the triangles of which pairs within a patch were left out, but may not be left out
/// now.
void keep_patches(std::span<const std::uint32_t> old_patches,
                  std::span<const std::uint32_t> patches, std::vector<std::uint32_t>& old_of) {
    std::vector<std::uint32_t> patch_now(old_patches.size() + 1, no_index); // of each old patch
    for (std::size_t t = 0; t < old_of.size(); ++t) {
        if (old_of[t] == no_index) continue;
        const std::uint32_t before = old_patches[old_of[t]];
        if (before == no_group) continue;
        if (patch_now[before] == no_index) patch_now[before] = patches[t];
        if (patches[t] == no_group || patches[t] != patch_now[before]) old_of[t] = no_index;
    }
}

/// A candidate that was one before.
struct KnownPair {
    CandidatePair pair;
    char apart;
};

/// Merges known candidates with those of new triangles.
Candidates merged(std::span<const KnownPair> known, std::span<const CandidatePair> found) {
    Candidates all;
    all.pairs.reserve(known.size() + found.size());
    all.known_apart.reserve(known.size() + found.size());
    const auto add = [&](const CandidatePair& pair, char apart) {
        all.pairs.push_back(pair);
        all.known_apart.push_back(apart);
    };
    auto next = known.begin();
    for (const CandidatePair& p : found) {
        for (; next != known.end() && next->pair < p; ++next) add(next->pair, next->apart);
        add(p, 0);
    }
    for (; next != known.end(); ++next) add(next->pair, next->apart);
    return all;
}

} // namespace

KnownPairs::KnownPairs() = default;
KnownPairs::~KnownPairs() = default;

void KnownPairs::keep(std::vector<Point3> points, std::span<const Triangle> triangles,
                      std::span<const std::uint32_t> patches, std::vector<CandidatePair> candidates,
                      std::span<const CandidatePair> near) {
    auto kept = std::make_unique<Kept>();
    kept->points = std::move(points);
    kept->triangles.assign(triangles.begin(), triangles.end());
    kept->patches.assign(patches.begin(), patches.end());
    kept->apart.resize(candidates.size());
    auto next = near.begin();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const bool is_near = next != near.end() && *next == candidates[k];
        kept->apart[k] = is_near ? 0 : 1;
        if (is_near) ++next;
    }
    kept->candidates = std::move(candidates);
    const std::scoped_lock lock(mutex_);
    kept_ = std::move(kept);
}

std::optional<Candidates>
KnownPairs::candidates(const Soup& soup, std::span<const std::uint32_t> patches, const Run& run) {
    std::unique_ptr<const Kept> kept;
    {
        const std::scoped_lock lock(mutex_);
        kept = std::move(kept_);
    }
    if (!kept || !crowded_vertices(soup.points.size(), soup.triangles).empty()) return std::nullopt;
    auto old_of =
        old_triangles(kept->triangles, soup.triangles, old_points(kept->points, soup.points));
    keep_patches(kept->patches, patches, old_of);
    std::vector<std::uint32_t> new_ones, new_of(kept->triangles.size(), no_index);
    for (std::uint32_t t = 0; t < old_of.size(); ++t)
        if (old_of[t] == no_index)
            new_ones.push_back(t);
        else
            new_of[old_of[t]] = t;
    if (2 * new_ones.size() > soup.triangles.size()) return std::nullopt;

    std::vector<KnownPair> known;
    known.reserve(kept->candidates.size());
    for (std::size_t k = 0; k < kept->candidates.size(); ++k) {
        const std::uint32_t t = new_of[kept->candidates[k].first],
                            u = new_of[kept->candidates[k].second];
        if (t == no_index || u == no_index) continue;
        if (patches[t] != no_group && patches[t] == patches[u]) continue;
        known.push_back({{std::min(t, u), std::max(t, u)}, kept->apart[k]});
    }
    if (!std::ranges::is_sorted(known, {}, &KnownPair::pair))
        std::ranges::sort(known, {}, &KnownPair::pair);
    const std::size_t most_found = most_pairs * (new_ones.size() + most_pairs);
    std::atomic<std::size_t> count{0};
    const auto is_within_limit = [&](const CandidatePair&) {
        return count.fetch_add(1, std::memory_order_relaxed) < most_found;
    };
    const auto found =
        candidate_pairs_of({soup.points, soup.triangles}, new_ones, patches, is_within_limit, run);
    if (count > most_found) return std::nullopt;

    return merged(known, found);
}

} // namespace terrane
