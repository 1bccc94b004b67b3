// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds intersection edges. An edge with an end that only one tile uses has all its triangles there;
// the others are decided where a hash of their ends points.
#include <algorithm>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/tiles/detail/edges.hpp>
#include <terrane/algorithms/tiles/detail/hashes.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>

namespace terrane::tiles::detail {

namespace {

struct FaceStart {
    std::uint32_t face = 0, start = 0;
};

/// A triangle at a shared edge. The surfaces of its distinct parents follow in a channel of their
/// own.
struct EdgeTriangle {
    std::array<std::uint32_t, 2> ends{};
    std::uint32_t triangle = 0;  ///< in its tile
    std::uint32_t signature = 0; ///< number of distinct parents
};

/// Calls visit(parent) for each distinct parent of a triangle: repeated ones count once in a surface.
std::vector<std::uint32_t> signature_of(const Tile& b, std::uint32_t t) {
    const auto parents = b.parents_of[t];
    if (parents.size() == 1) return {surface_of(b, parents[0])};
    std::vector<std::array<std::uint32_t, 2>> distinct; // surface, first with the same corners
    for (const std::uint32_t p : parents) distinct.push_back({surface_of(b, p), first_same(b, p)});
    sort_unique(distinct);
    std::vector<std::uint32_t> surfaces;
    for (const auto& d : distinct) surfaces.push_back(d[0]);
    return surfaces;
}

/// Takes the numbers of the triangles.
void take_numbers(Tile& b, Inbox& in) {
    b.ids.assign(b.triangles.size(), 0);
    in.take<FaceStart>(0, [&](std::uint32_t, const FaceStart& f) {
        const auto begin = std::lower_bound(b.face_of.begin(), b.face_of.end(), f.face);
        std::uint32_t id = f.start;
        for (auto t = begin; t != b.face_of.end() && *t == f.face; ++t)
            b.ids[static_cast<std::size_t>(t - b.face_of.begin())] = id++;
    });
}

} // namespace

std::vector<EdgeSide> sides_of(const Tile& b) {
    std::vector<EdgeSide> sides;
    sides.reserve(3 * b.triangles.size());
    for (std::uint32_t t = 0; t < b.triangles.size(); ++t)
        for (unsigned i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(b.triangles[t][i], b.triangles[t][(i + 1) % 3]);
            sides.push_back({{low, high}, t});
        }
    std::sort(sides.begin(), sides.end());
    return sides;
}

bool agree(const Tile& b, std::uint32_t s, std::uint32_t t) {
    return signature_of(b, s) == signature_of(b, t);
}

std::uint32_t first_in(std::span<const std::array<std::uint32_t, 2>> repeated,
                       std::uint32_t triangle) {
    const auto found =
        std::lower_bound(repeated.begin(), repeated.end(), triangle,
                         [](const auto& pair, std::uint32_t t) { return pair[0] < t; });
    return found != repeated.end() && (*found)[0] == triangle ? (*found)[1] : triangle;
}

std::uint32_t first_same(const Tile& b, std::uint32_t triangle) {
    return first_in(b.repeated, triangle);
}

/// Channel 1: EdgeTriangle and channel 2: its surfaces, to where a hash of the ends points.
void send_sides(const Tile& b, Outbox& out) {
    for (const EdgeSide& s : sides_of(b)) {
        if (!is_shared(b, s.ends[0]) || !is_shared(b, s.ends[1])) continue;
        const std::size_t to = keeper_of_edge(b, s.ends);
        const auto signature = signature_of(b, s.triangle);
        out.put(to, 1,
                EdgeTriangle{s.ends, s.triangle, static_cast<std::uint32_t>(signature.size())});
        for (const std::uint32_t surface : signature) out.put(to, 2, surface);
    }
}

/// Channel 0: FaceStart, to the owners; channels 1 and 2: see send_sides; channel 3: parents at shared
/// vertices.
Status send_shared_edges(Tile& b, Inbox& in, Outbox& out) {
    std::uint32_t start = 0;
    in.take<TileVerdict>(0, [&](std::uint32_t from, const TileVerdict& v) {
        b.unclean += v.unclean;
        b.deviation = std::max(b.deviation, v.deviation);
        if (from < b.index) start += static_cast<std::uint32_t>(v.triangles);
        b.result_triangles += v.triangles;
    });
    const std::uint32_t first = home_start(b, b.triangle_total());
    for (std::uint32_t k = 0; k < b.home_count.size(); ++k) {
        if (b.home_count[k] > 0) out.put(b.home_owner[k], 0, FaceStart{first + k, start});
        start += b.home_count[k];
    }
    release(b.home_owner);
    send_sides(b, out);
    if (b.wants_digest) send_parents_of_shared(b, out, 3);
    return Done{};
}

void decide_edges(Inbox& in, Outbox& out) {
    struct Side {
        EdgeTriangle at;
        std::uint32_t tile;
        std::size_t surfaces; ///< where its signature begins
    };
    std::vector<Side> sides;
    std::size_t at = 0;
    in.take<EdgeTriangle>(1, [&](std::uint32_t from, const EdgeTriangle& e) {
        sides.push_back({e, from, at});
        at += e.signature;
    });
    const auto surfaces = in.all<std::uint32_t>(2);
    std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
        return std::tie(s.at.ends, s.tile, s.at.triangle) <
               std::tie(t.at.ends, t.tile, t.at.triangle);
    });
    const auto same_signature = [&](const Side& s, const Side& t) {
        const auto begin = surfaces.begin();
        const auto of = [&](const Side& side) {
            return std::pair(begin + static_cast<std::ptrdiff_t>(side.surfaces),
                             begin +
                                 static_cast<std::ptrdiff_t>(side.surfaces + side.at.signature));
        };
        return std::equal(of(s).first, of(s).second, of(t).first, of(t).second);
    };
    for (std::size_t k = 0, end = 0; k < sides.size(); k = end) {
        while (end < sides.size() && sides[end].at.ends == sides[k].at.ends) ++end;
        const bool is_pair = end - k == 2;
        if (end - k == 1) continue; // a border
        if (!is_pair || !same_signature(sides[k], sides[k + 1])) {
            out.put(sides[k].tile, 0, DecidedEdge{sides[k].at.ends});
            continue;
        }
        const Side &s = sides[k], &t = sides[k + 1];
        out.put(s.tile, 1, Neighbour{s.at.triangle, t.tile, t.at.triangle});
    }
}

/// Channel 0: DecidedEdge, to the tiles of its triangles; channel 1: Neighbour, to the tile of the
/// first of two triangles that are in one region; channel 3: records of the digest.
Status decide_shared_edges(Tile& b, Inbox& in, Outbox& out) {
    take_numbers(b, in);
    decide_edges(in, out);
    if (b.wants_digest) decide_shared_vertices(b, in, 3, out, 3);
    return Done{};
}

} // namespace terrane::tiles::detail
