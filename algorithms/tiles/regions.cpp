// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds the regions of the result: sets of triangles of one surface, joined within each tile, then
// across tiles. The first tile joins the sets and numbers them; it holds one entry per region and
// tile, and one per pair of sets that touch.
#include <algorithm>
#include <map>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/tiles/detail/edges.hpp>
#include <terrane/algorithms/tiles/detail/hashes.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>

namespace terrane::tiles::detail {

namespace {

/// The set of slot `own` of the tile that is told, or of its triangle `triangle`, and the set
/// `other` of another tile are one region.
struct JoinedSets {
    std::uint32_t triangle = 0, nth = 0, other = 0;
};
/// A set of a tile.
struct RegionSet {
    std::uint32_t slot = 0, surface = 0, first_triangle = 0;
};
struct SetPair {
    std::uint32_t own = 0, tile = 0, other = 0;
};
struct NumberedSet {
    std::uint32_t slot = 0, region = 0;
};

Hash record_of_edge(const Tile& b, const std::array<std::uint32_t, 2>& ends) {
    return tagged_hash("edge", {hash_of_point(b, ends[0]), hash_of_point(b, ends[1])});
}

} // namespace

/// Channel 0: JoinedSets, to the tile of the other triangle; channel 3: records of the digest.
Status join_within(Tile& b, Inbox& in, Outbox& out) {
    DisjointSets sets(b.surfaces_of.values.size());
    const auto& offsets = b.surfaces_of.offsets;
    const auto join = [&](std::uint32_t t, std::uint32_t u) {
        for (std::uint32_t k = 0; k < b.surfaces_of[t].size(); ++k)
            sets.join(offsets[t] + k, offsets[u] + k);
    };
    const auto note = [&](const std::array<std::uint32_t, 2>& ends) {
        ++b.edges;
        if (b.wants_digest) put_record(b, record_of_edge(b, ends), out, 3);
    };
    const auto sides = sides_of(b);
    for (std::size_t k = 0, end = 0; k < sides.size(); k = end) {
        while (end < sides.size() && sides[end].ends == sides[k].ends) ++end;
        if (end - k == 1) continue;
        if (is_shared(b, sides[k].ends[0]) && is_shared(b, sides[k].ends[1])) continue;
        if (end - k == 2 && agree(b, sides[k].triangle, sides[k + 1].triangle))
            join(sides[k].triangle, sides[k + 1].triangle);
        else
            note(sides[k].ends);
    }
    in.take<DecidedEdge>(0, [&](std::uint32_t, const DecidedEdge& e) { note(e.ends); });
    const auto neighbours = in.all<Neighbour>(1);
    for (const Neighbour& n : neighbours)
        if (n.tile == b.index) join(n.triangle, n.other);
    b.component_of = sets.flattened();
    for (const Neighbour& n : neighbours) {
        if (n.tile == b.index) continue;
        for (std::uint32_t k = 0; k < b.surfaces_of[n.triangle].size(); ++k)
            out.put(n.tile, 0, JoinedSets{n.other, k, b.component_of[offsets[n.triangle] + k]});
    }
    keep_records(b, in, 3);
    if (b.wants_digest) add_records_of_vertices(b, out, 3);
    release(b.parent_hashes);
    return Done{};
}

/// Channel 0: RegionSet, channel 1: SetPair, to the first tile.
Status join_across(Tile& b, Inbox& in, Outbox& out) {
    keep_records(b, in, 3);
    for (std::uint32_t t = 0; t < b.triangles.size(); ++t)
        for (std::uint32_t s = b.surfaces_of.offsets[t]; s < b.surfaces_of.offsets[t + 1]; ++s)
            if (b.component_of[s] == s)
                out.put(0, 0, RegionSet{s, b.surfaces_of.values[s], b.ids[t]});
    std::vector<std::array<std::uint32_t, 3>> pairs;
    in.take<JoinedSets>(0, [&](std::uint32_t from, const JoinedSets& j) {
        pairs.push_back({b.component_of[b.surfaces_of.offsets[j.triangle] + j.nth], from, j.other});
    });
    sort_unique(pairs);
    for (const auto& [own, tile, other] : pairs) out.put(0, 1, SetPair{own, tile, other});
    return Done{};
}

/// Channel 0: NumberedSet, from the first tile back; channel 1: the number of regions, to all.
Status number_regions(Tile& b, Inbox& in, Outbox& out) {
    if (b.index != 0) return Done{};
    struct Set {
        std::uint32_t tile, slot, surface, first_triangle;
    };
    std::vector<Set> all;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> place;
    in.take<RegionSet>(0, [&](std::uint32_t from, const RegionSet& s) {
        place[{from, s.slot}] = static_cast<std::uint32_t>(all.size());
        all.push_back({from, s.slot, s.surface, s.first_triangle});
    });
    DisjointSets joined(all.size());
    in.take<SetPair>(1, [&](std::uint32_t from, const SetPair& p) {
        joined.join(place.at({from, p.own}), place.at({p.tile, p.other}));
    });
    const auto& root = joined.flattened();
    std::vector<std::array<std::uint32_t, 3>> order; // surface, lowest triangle, root
    std::vector<std::uint32_t> lowest(all.size(), UINT32_MAX);
    for (std::size_t k = 0; k < all.size(); ++k)
        lowest[root[k]] = std::min(lowest[root[k]], all[k].first_triangle);
    for (std::uint32_t k = 0; k < all.size(); ++k)
        if (root[k] == k) order.push_back({all[k].surface, lowest[k], k});
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> number(all.size());
    for (std::uint32_t r = 0; r < order.size(); ++r) number[order[r][2]] = r;
    for (std::size_t k = 0; k < all.size(); ++k)
        out.put(all[k].tile, 0, NumberedSet{all[k].slot, number[root[k]]});
    out.put_to_all(1, static_cast<std::uint64_t>(order.size()));
    return Done{};
}

Status receive_regions(Tile& b, Inbox& in, Outbox&) {
    std::vector<std::uint32_t> number(b.component_of.size());
    in.take<NumberedSet>(0,
                         [&](std::uint32_t, const NumberedSet& s) { number[s.slot] = s.region; });
    in.take<std::uint64_t>(1, [&](std::uint32_t, std::uint64_t n) { b.regions = n; });
    b.region_of.resize(b.component_of.size());
    for (std::size_t s = 0; s < b.component_of.size(); ++s)
        b.region_of[s] = number[b.component_of[s]];
    release(b.component_of);
    std::sort(b.records.begin(), b.records.end());
    return Done{};
}

} // namespace terrane::tiles::detail
