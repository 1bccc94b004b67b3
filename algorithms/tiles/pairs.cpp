// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Decides which faces meet improperly. A pair of boxes belongs to the tile with the lowest corner
// of their common part, so each pair is decided once.
#include <algorithm>
#include <array>
#include <optional>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/intersection/injective_patches.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/tiles/detail/soup_of_faces.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>
#include <terrane/kernel/predicate_counts.hpp>
#include <terrane/kernel/separation_filter.hpp>

namespace terrane::tiles::detail {

namespace {

/// Takes the faces that repeat an earlier one out of b.faces, and notes those of own faces.
void set_repeated_aside(Tile& b, Outbox& out) {
    struct Key {
        std::array<std::uint32_t, 3> corners{};
        std::uint32_t face = 0;
        auto operator<=>(const Key&) const = default;
    };
    std::vector<Key> keys(b.faces.size());
    for (std::uint32_t f = 0; f < b.faces.size(); ++f) {
        keys[f] = {b.faces[f].corners, f};
        std::sort(keys[f].corners.begin(), keys[f].corners.end());
    }
    std::sort(keys.begin(), keys.end());
    std::vector<bool> repeats(b.faces.size(), false);
    bool any = false;
    for (std::size_t k = 1, lead = 0; k < keys.size(); ++k) {
        if (keys[k].corners != keys[lead].corners) {
            lead = k;
            continue;
        }
        const Face& face = b.faces[keys[k].face];
        repeats[keys[k].face] = any = true;
        if (owner_of_face(b, face) != b.index) continue;
        b.duplicates.push_back({face.id, b.faces[keys[lead].face].id});
        out.put(home_of(face.id, b.triangle_total(), b.count), 1, face.id);
    }
    std::sort(b.duplicates.begin(), b.duplicates.end(), [](const auto& d, const auto& e) {
        return std::pair(d[1], d[0]) < std::pair(e[1], e[0]);
    });
    if (!any) return;
    std::size_t at = 0;
    std::erase_if(b.faces, [&](const Face&) -> bool { return repeats[at++]; });
}

/// Groups triangles of one surface in which no point is touched by the border twice, so that the
/// proof of injectivity does not fail at the ragged rim of the tile. Others get groups of their own.
std::vector<std::uint32_t> smooth_groups(const Tile& b, const SoupOfFaces& soup,
                                         const EdgeSides& edges) {
    const auto surfaces = static_cast<std::uint32_t>(b.entries.size());
    std::vector<std::uint32_t> group(soup.triangles.size());
    for (std::size_t f = 0; f < group.size(); ++f) group[f] = surface_of(b, soup.ids[f]);
    constexpr unsigned most_rounds = 16;
    for (unsigned round = 0; round < most_rounds; ++round) {
        std::vector<std::array<std::uint32_t, 2>> border; // {vertex, group}: once per border edge
        edges.for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            for (const auto& s : sides) {
                const std::uint32_t g = group[s.triangle];
                std::size_t same = 0;
                for (const auto& t : sides) same += group[t.triangle] == g;
                if (same != 1) continue;
                border.push_back({low, g});
                border.push_back({high, g});
            }
        });
        std::sort(border.begin(), border.end());
        std::vector<std::array<std::uint32_t, 2>> pinched;
        for (std::size_t i = 0, end = 0; i < border.size(); i = end) {
            while (end < border.size() && border[end] == border[i]) ++end;
            if (end - i > 2 && border[i][1] < surfaces) pinched.push_back(border[i]);
        }
        if (pinched.empty()) break;
        for (std::size_t f = 0; f < group.size(); ++f)
            for (const std::uint32_t v : soup.triangles[f])
                if (group[f] < surfaces &&
                    std::binary_search(pinched.begin(), pinched.end(), std::array{v, group[f]})) {
                    group[f] += surfaces;
                    break;
                }
    }
    return group;
}

/// Tests candidates of this tile.
class PairTest {
public:
    PairTest(const Tile& b, const SoupOfFaces& soup) : b_(b), soup_(soup) {}

    [[nodiscard]] bool is_own(const CandidatePair& p) const {
        const Box f = box(p.first), g = box(p.second);
        return owner_of(b_.grid, b_.splitters,
                        {std::max(f.low[0], g.low[0]), std::max(f.low[1], g.low[1]),
                         std::max(f.low[2], g.low[2])}) == b_.index;
    }

    /// Returns the contact of a pair, if it is improper.
    [[nodiscard]] std::optional<Contact> operator()(const CandidatePair& p) const {
        const Triangle &t = soup_.triangles[p.first], &u = soup_.triangles[p.second];
        const auto at = [&](std::uint32_t v) -> const Point3& { return soup_.points[v]; };
        const bool joined = std::any_of(t.begin(), t.end(), [&](std::uint32_t v) {
            return v == u[0] || v == u[1] || v == u[2];
        });
        if (!joined &&
            SeparationFilter(at(t[0]), at(t[1]), at(t[2])).is_apart(at(u[0]), at(u[1]), at(u[2])))
            return std::nullopt;
        return improper_contact(soup_.points, t, u, joined ? Filters::all : Filters::none);
    }

private:
    [[nodiscard]] Box box(std::uint32_t f) const {
        return terrane::box_of(soup_.points, soup_.triangles[f]);
    }

    const Tile& b_;
    const SoupOfFaces& soup_;
};

std::vector<CandidatePair> own_candidates(const Tile& b, const SoupOfFaces& soup, const Run& run) {
    const EdgeSides edges = group_edges(soup.triangles, soup.points.size(), run);
    const auto groups = smooth_groups(b, soup, edges);
    const auto patches = find_injective_patches(soup.points, soup.triangles, groups, edges, run);
    auto candidates = candidate_pairs({soup.points, soup.triangles}, patches.of, Search::automatic,
                                      without_progress(run));
    const PairTest test(b, soup);
    std::erase_if(candidates, [&](const CandidatePair& p) { return !test.is_own(p); });
    return candidates;
}

struct Found {
    CandidatePair pair{};
    bool overlap = false;
};

/// Returns the candidates that meet improperly. Nothing else is computed under the rounding mode
/// that the test needs, as cells of the grid depend on it.
std::vector<Found> improper_pairs(Tile& b, const SoupOfFaces& soup,
                                  std::span<const CandidatePair> candidates, const Run& run) {
    struct Some {
        std::vector<Found> found;
        PredicateCounts predicates;
    };
    const PairTest test(b, soup);
    const auto parts =
        for_blocks<Some>(candidates.size(), 1024, run, [&](std::size_t first, std::size_t last) {
            Some some;
            const PredicateCounts before = predicate_counts();
            for (std::size_t k = first; k < last; ++k)
                if (const auto contact = test(candidates[k]))
                    some.found.push_back({candidates[k], contact->overlap});
            some.predicates = predicate_counts() - before;
            return some;
        });
    std::vector<Found> all;
    for (const Some& some : parts) {
        all.insert(all.end(), some.found.begin(), some.found.end());
        b.work.predicates +=
            some.predicates.static_filter + some.predicates.interval + some.predicates.exact;
    }
    return all;
}

} // namespace

/// Channel 0: MeetingFaces, to the owners of both; channel 1: repeated faces, to their homes.
Status decide_pairs(Tile& b, Inbox& in, Outbox& out, const Run& run) {
    b.faces = in.all<Face>(0);
    b.given_repeated = in.all<std::array<std::uint32_t, 2>>(1);
    sort_unique(b.given_repeated);
    std::sort(b.faces.begin(), b.faces.end(),
              [](const Face& f, const Face& g) { return f.id < g.id; });
    b.work.faces = b.faces.size();
    set_repeated_aside(b, out);
    for (const Face& f : b.faces) b.work.owned += owner_of_face(b, f) == b.index;
    if (b.faces.empty()) return Done{};
    const SoupOfFaces soup = soup_of(b.faces);
    const auto candidates = own_candidates(b, soup, run);
    b.work.candidates = candidates.size();
    for (const Found& found : improper_pairs(b, soup, candidates, run)) {
        ++b.work.improper;
        const MeetingFaces pair{b.faces[found.pair.first], b.faces[found.pair.second],
                                found.overlap ? 1U : 0U};
        const std::uint32_t first = owner_of_face(b, pair.first),
                            second = owner_of_face(b, pair.second);
        out.put(first, 0, pair);
        if (second != first) out.put(second, 0, pair);
    }
    return Done{};
}

} // namespace terrane::tiles::detail
