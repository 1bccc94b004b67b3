// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/arrangement/known_triangles.hpp>

#include <algorithm>
#include <atomic>
#include <utility>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/point_table.hpp>
#include <terrane/algorithms/mesh/triangle_table.hpp>

namespace terrane {

struct KeptTriangles {
    std::vector<Point3> points;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> starts; ///< of surfaces, see starts_of()
    EdgeSides edges;
    InjectivePatches patches;
    Candidates candidates;
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

/// Lists where the triangles of each surface begin, and at last where they end.
std::vector<std::uint32_t> starts_of(std::span<const std::uint32_t> surface_of) {
    std::vector<std::uint32_t> starts;
    for (std::uint32_t t = 0; t < surface_of.size(); ++t)
        if (t == 0 || surface_of[t] != surface_of[t - 1]) starts.push_back(t);
    starts.push_back(static_cast<std::uint32_t>(surface_of.size()));
    return starts;
}

/// Finds the patches of some surfaces of a soup, and adds them to those of the others. triangles:
/// ascending, all of these surfaces.
void add_patches(const Soup& soup, std::span<const std::uint32_t> triangles,
                 InjectivePatches& patches, const Run& run) {
    std::vector<Triangle> corners;
    std::vector<std::uint32_t> surface_of;
    std::vector<Sign> turns;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        const std::uint32_t t = triangles[k];
        corners.push_back(soup.triangles[t]);
        turns.push_back(soup.turns[t]);
        const bool is_next = k > 0 && soup.surface_of[t] != soup.surface_of[triangles[k - 1]];
        surface_of.push_back(k == 0 ? 0 : surface_of.back() + (is_next ? 1 : 0));
    }
    const auto edges = group_edges(corners, soup.points.size(), run);
    const auto found = find_injective_patches(soup.points, corners, surface_of, edges, run, turns);
    const auto first = static_cast<std::uint32_t>(patches.axis.size());
    for (std::size_t k = 0; k < triangles.size(); ++k)
        if (found.of[k] != no_group) patches.of[triangles[k]] = first + found.of[k];
    patches.axis.insert(patches.axis.end(), found.axis.begin(), found.axis.end());
    patches.turn.insert(patches.turn.end(), found.turn.begin(), found.turn.end());
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
struct KnownCandidate {
    CandidatePair pair;
    std::uint32_t outcome;
};

/// Merges known candidates with those of new triangles. contacts: those of the former. names: per old
/// point: its index now.
Candidates merged(std::span<const KnownCandidate> known, const ContactList& contacts,
                  std::span<const std::uint32_t> names, std::span<const CandidatePair> found) {
    Candidates all;
    all.pairs.reserve(known.size() + found.size());
    all.tested.outcomes.reserve(known.size() + found.size());
    const auto add = [&](const CandidatePair& pair, std::uint32_t outcome) {
        if (outcome >= TestedPairs::first_contact) {
            const std::uint32_t contact = outcome - TestedPairs::first_contact;
            outcome =
                TestedPairs::first_contact + static_cast<std::uint32_t>(all.tested.contacts.size());
            all.tested.contacts.add_renamed(contacts, contact, names);
        }
        all.pairs.push_back(pair);
        all.tested.outcomes.push_back(outcome);
    };
    auto next = known.begin();
    for (const CandidatePair& p : found) {
        for (; next != known.end() && next->pair < p; ++next) add(next->pair, next->outcome);
        add(p, TestedPairs::untested);
    }
    for (; next != known.end(); ++next) add(next->pair, next->outcome);
    return all;
}

} // namespace

KnownInSoup::KnownInSoup(std::unique_ptr<const KeptTriangles> kept, const Soup& soup) :
    kept_(std::move(kept)), soup_(soup) {
    find_again();
}

KnownInSoup::~KnownInSoup() = default;

void KnownInSoup::find_again() {
    old_of_ =
        old_triangles(kept_->triangles, soup_.triangles, old_points(kept_->points, soup_.points));
}

EdgeSides KnownInSoup::edges(const Run& run) const {
    const RenamedTriangles renamed(kept_->triangles, kept_->points.size(), soup_.triangles,
                                   old_of_);
    if (2 * renamed.others.size() > soup_.triangles.size())
        return group_edges(soup_.triangles, soup_.points.size(), run);
    return edges_after(kept_->edges, renamed, soup_.triangles, soup_.points.size(), run);
}

/// Returns the first old triangle of the surface that had the triangles [first, last), in this order
/// and no others; or no_index.
std::uint32_t KnownInSoup::old_surface(std::uint32_t first, std::uint32_t last) const {
    const std::uint32_t old = old_of_[first];
    const auto start = std::ranges::lower_bound(kept_->starts, old);
    if (old == no_index || *start != old || *(start + 1) != old + (last - first)) return no_index;
    for (std::uint32_t t = first; t < last; ++t)
        if (old_of_[t] != old + (t - first)) return no_index;
    return old;
}

// A proof of injectivity depends on the triangles of its surface alone: on how they turn, on which edges
// they share, and on the corners of their border.
InjectivePatches KnownInSoup::patches(const Run& run) const {
    InjectivePatches patches{std::vector<std::uint32_t>(old_of_.size(), no_group),
                             kept_->patches.axis, kept_->patches.turn};
    std::vector<std::uint32_t> others;
    const auto starts = starts_of(soup_.surface_of);
    for (std::size_t s = 0; s + 1 < starts.size(); ++s) {
        const std::uint32_t first = starts[s], last = starts[s + 1];
        const std::uint32_t old = old_surface(first, last);
        for (std::uint32_t t = first; t < last; ++t)
            if (old == no_index)
                others.push_back(t);
            else
                patches.of[t] = kept_->patches.of[old + (t - first)];
    }
    if (!others.empty()) add_patches(soup_, others, patches, run);
    number_by_first_triangle(patches);
    return patches;
}

std::optional<Candidates> KnownInSoup::candidates(std::span<const std::uint32_t> patches,
                                                  const Run& run) const {
    const Soup& soup = soup_;
    if (!crowded_vertices(soup.points.size(), soup.triangles).empty()) return std::nullopt;
    auto old_of = old_of_;
    keep_patches(kept_->patches.of, patches, old_of);
    std::vector<std::uint32_t> new_ones, new_of(kept_->triangles.size(), no_index);
    for (std::uint32_t t = 0; t < old_of.size(); ++t)
        if (old_of[t] == no_index)
            new_ones.push_back(t);
        else
            new_of[old_of[t]] = t;
    if (2 * new_ones.size() > soup.triangles.size()) return std::nullopt;

    const auto& [kept_pairs, tested] = kept_->candidates;
    std::vector<KnownCandidate> known;
    known.reserve(kept_pairs.size());
    for (std::size_t k = 0; k < kept_pairs.size(); ++k) {
        const auto& [f, g] = kept_pairs[k];
        const std::uint32_t t = new_of[f], u = new_of[g];
        if (t == no_index || u == no_index) continue;
        if (patches[t] != no_group && patches[t] == patches[u]) continue;
        const bool is_same = tested.outcomes[k] < TestedPairs::first_contact ||
                             (t < u && have_same_order({kept_->triangles[f], kept_->triangles[g]},
                                                       {soup.triangles[t], soup.triangles[u]}));
        known.push_back({{std::min(t, u), std::max(t, u)},
                         is_same ? tested.outcomes[k] : TestedPairs::untested});
    }
    if (!std::ranges::is_sorted(known, {}, &KnownCandidate::pair))
        std::ranges::sort(known, {}, &KnownCandidate::pair);
    const std::size_t most_found = most_pairs * (new_ones.size() + most_pairs);
    std::atomic<std::size_t> count{0};
    const auto is_within_limit = [&](const CandidatePair&) {
        return count.fetch_add(1, std::memory_order_relaxed) < most_found;
    };
    const auto found =
        candidate_pairs_of({soup.points, soup.triangles}, new_ones, patches, is_within_limit, run);
    if (count > most_found) return std::nullopt;
    return merged(known, tested.contacts, point_names(), found);
}

/// Returns the index of each old point that a triangle of the soup has.
std::vector<std::uint32_t> KnownInSoup::point_names() const {
    std::vector<std::uint32_t> names(kept_->points.size(), no_index);
    for (std::size_t t = 0; t < old_of_.size(); ++t)
        for (unsigned i = 0; i < 3 && old_of_[t] != no_index; ++i)
            names[kept_->triangles[old_of_[t]][i]] = soup_.triangles[t][i];
    return names;
}

KnownTriangles::KnownTriangles() = default;
KnownTriangles::~KnownTriangles() = default;

std::unique_ptr<KnownInSoup> KnownTriangles::find_in(const Soup& soup) {
    std::unique_ptr<const KeptTriangles> kept;
    {
        const std::scoped_lock lock(mutex_);
        kept = std::move(kept_);
    }
    return kept ? std::make_unique<KnownInSoup>(std::move(kept), soup) : nullptr;
}

void KnownTriangles::keep(std::vector<Point3> points, const Soup& soup,
                          const InjectivePatches& patches, Candidates candidates) {
    auto kept = std::make_unique<KeptTriangles>();
    kept->points = std::move(points);
    kept->triangles.assign(soup.triangles.begin(), soup.triangles.end());
    kept->starts = starts_of(soup.surface_of);
    kept->edges = soup.edges;
    kept->patches = patches;
    kept->candidates = std::move(candidates);
    const std::scoped_lock lock(mutex_);
    kept_ = std::move(kept);
}

} // namespace terrane
