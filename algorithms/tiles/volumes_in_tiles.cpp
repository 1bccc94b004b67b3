// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tiles/volumes_in_tiles.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/tiles/tile.hpp>
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>
#include <terrane/algorithms/volumes/exact_volumes.hpp>
#include <terrane/algorithms/volumes/mesh_sheets.hpp>
#include <terrane/algorithms/volumes/radial_sort.hpp>
#include <terrane/algorithms/volumes/shell_nesting.hpp>

namespace terrane::tiles {

using namespace volumes;

namespace {

using Corners = std::array<Point3, 3>;

/// A triangle at a shared edge: its corners from the lower end of the edge, the higher end, the third.
struct RoundEdge {
    std::array<std::uint32_t, 2> ends{}; ///< numbers of vertices through all tiles, low < high
    std::uint32_t triangle = 0;          ///< in its tile
    std::uint32_t is_upward = 0;         ///< 1: its corners run from low to high
    Corners at{};
};
/// A side of the tile that is told, and a side of a tile, which face each other.
struct FacingSides {
    std::uint32_t own = 0, tile = 0, other = 0;
};
/// A side of the tile that is told, and a shell of the tile that tells.
struct JoinedShell {
    std::uint32_t own = 0, other = 0;
};
/// A shell of a tile.
struct OwnShell {
    std::uint32_t shell = 0, unused = 0;
    Point3 least{};
    Corners triangle{}; ///< one of its triangles
};
struct ShellPair {
    std::uint32_t own = 0, tile = 0, other = 0;
};
struct NumberedShell {
    std::uint32_t own = 0, number = 0;
};
/// A triangle that a line meets, with the shells in front of it and behind it.
struct CrossedTriangle {
    std::uint32_t line = 0, front = 0, back = 0, unused = 0;
    Corners at{};
};
struct TiedVertex {
    std::uint32_t volume = 0, unused = 0;
    Point3 at{};
};
/// A side of a triangle: its corners, ascending, and whether they are counterclockwise in that order
/// seen from this side.
struct PlacedSide {
    Corners corners{};
    std::uint32_t is_even = 0, unused = 0;

    friend auto operator<=>(const PlacedSide&, const PlacedSide&) = default;
};
struct TiedSide {
    std::uint32_t volume = 0, unused = 0;
    PlacedSide side{};
};
/// A part of a measure; as many letters follow in a channel of their own.
struct PartOfMeasure {
    std::uint32_t volume = 0, length = 0;
};

Corners corners_of(const Mesh& mesh, const Triangle& t) {
    return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

PlacedSide placed_side(Corners corners, bool is_front) {
    bool even = true;
    for (const auto& [i, j] : {std::pair{0U, 1U}, std::pair{1U, 2U}, std::pair{0U, 1U}})
        if (corners[j] < corners[i]) {
            std::swap(corners[i], corners[j]);
            even = !even;
        }
    return {corners, even == is_front ? 1U : 0U, 0};
}

/// Tiles run in several threads or processes already.
Run one_thread() {
    return {.threads = 1};
}

/// The triangles of a tile, and some more behind them.
class OwnSheets {
public:
    explicit OwnSheets(const Tile& b, std::span<const Corners> more = {}) :
        piece_(piece_of(b)), own_(static_cast<std::uint32_t>(piece_.mesh.triangles.size())) {
        Mesh& mesh = piece_.mesh;
        for (const Corners& corners : more) {
            const auto v = static_cast<std::uint32_t>(mesh.vertices.size());
            mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
            mesh.triangles.push_back({v, v + 1, v + 2});
        }
        sheets_.emplace(mesh.vertices, mesh.triangles, one_thread());
    }

    [[nodiscard]] const TilePiece& piece() const { return piece_; }
    [[nodiscard]] const Mesh& mesh() const { return piece_.mesh; }
    [[nodiscard]] TriangleComplex view() const { return sheets_->view(); }
    /// Returns the number of triangles of the tile.
    [[nodiscard]] std::uint32_t own() const { return own_; }

private:
    TilePiece piece_;
    std::uint32_t own_;
    std::optional<MeshSheets> sheets_;
};

// ---- Shells ------------------------------------------------------------------------------------

/// Channel 0: RoundEdge, to where a hash of the ends points.
Status share_edges(Tile& b, Inbox&, Outbox& out) {
    const TilePiece piece = piece_of(b);
    const auto shared = shared_vertices(b, piece);
    for (std::uint32_t t = 0; t < piece.mesh.triangles.size(); ++t) {
        const Triangle& c = piece.mesh.triangles[t];
        for (unsigned i = 0; i < 3; ++i) {
            std::uint32_t low = c[i], high = c[(i + 1) % 3];
            if (!shared[low] || !shared[high]) continue;
            const bool is_upward = low < high; // vertices of a piece are in the order of numbers
            if (!is_upward) std::swap(low, high);
            const std::array ends{piece.vertex_ids[low], piece.vertex_ids[high]};
            const auto& at = piece.mesh.vertices;
            out.put(
                keeper_of_edge(b, ends), 0,
                RoundEdge{ends, t, is_upward ? 1U : 0U, {at[low], at[high], at[c[(i + 2) % 3]]}});
        }
    }
    return Done{};
}

/// Channel 0: FacingSides, to the tile of the first of two sides.
Status pair_sides(Tile&, Inbox& in, Outbox& out) {
    struct Sent {
        RoundEdge edge;
        std::uint32_t from;
    };
    std::vector<Sent> all;
    in.take<RoundEdge>(0, [&](std::uint32_t from, const RoundEdge& e) {
        all.push_back({e, from});
    });
    std::sort(all.begin(), all.end(), [](const Sent& s, const Sent& t) {
        return std::tie(s.edge.ends, s.from, s.edge.triangle) <
               std::tie(t.edge.ends, t.from, t.edge.triangle);
    });
    // Each edge gets two vertices of its own, and each triangle at it a third one.
    std::vector<Point3> points;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> lows; // per triangle
    for (std::size_t k = 0; k < all.size(); ++k) {
        const RoundEdge& e = all[k].edge;
        if (k == 0 || e.ends != all[k - 1].edge.ends) {
            points.push_back(e.at[0]);
            points.push_back(e.at[1]);
            lows.push_back(static_cast<std::uint32_t>(points.size() - 2));
        } else {
            lows.push_back(lows.back());
        }
        const std::uint32_t low = lows.back(), apex = static_cast<std::uint32_t>(points.size());
        points.push_back(e.at[2]);
        triangles.push_back(e.is_upward != 0 ? Triangle{low, low + 1, apex}
                                             : Triangle{low + 1, low, apex});
    }
    const MeshSheets sheets(points, triangles, one_thread());
    const TriangleComplex view = sheets.view();
    const UpwardRounding guard;
    std::vector<EdgeSides::Side> round;
    for (std::uint32_t k = 0, end = 0; k < all.size(); k = end) {
        round.clear();
        for (; end < all.size() && lows[end] == lows[k]; ++end) round.push_back({lows[k] + 1, end});
        sort_round_edge(guard, view, lows[k], round);
        join_round_edge(view, lows[k], round, [&](std::uint32_t side, std::uint32_t other) {
            const Sent &s = all[side / 2], &t = all[other / 2];
            out.put(s.from, 0,
                    FacingSides{2 * s.edge.triangle + side % 2, t.from,
                                2 * t.edge.triangle + other % 2});
        });
    }
    return Done{};
}

/// Channel 0: JoinedShell, to the tile of the other side.
Status join_shells_within(Tile& b, Inbox& in, Outbox& out) {
    const OwnSheets own(b);
    const TriangleComplex sheets = own.view();
    const auto shared = shared_vertices(b, own.piece());
    DisjointSets sides(2 * std::size_t{own.own()});
    const UpwardRounding guard;
    std::vector<EdgeSides::Side> round;
    sheets.edges.for_each(
        [&](std::uint32_t low, std::uint32_t high, std::span<const EdgeSides::Side> at_edge) {
            if (shared[low] && shared[high]) return;
            round.assign(at_edge.begin(), at_edge.end());
            sort_round_edge(guard, sheets, low, round);
            join_round_edge(sheets, low, round,
                            [&](std::uint32_t s, std::uint32_t t) { sides.join(s, t); });
        });
    const auto facing = in.all<FacingSides>(0);
    for (const FacingSides& f : facing)
        if (f.tile == b.index) sides.join(f.own, f.other);
    b.shell_of = sides.flattened();
    for (const FacingSides& f : facing)
        if (f.tile != b.index) out.put(f.tile, 0, JoinedShell{f.other, b.shell_of[f.own]});
    return Done{};
}

/// To the first tile: channel 0: OwnShell; channel 1: ShellPair; channel 2: the shells in front of and
/// behind a triangle.
Status gather_shells(Tile& b, Inbox& in, Outbox& out) {
    const Mesh mesh = piece_of(b).mesh;
    std::vector<std::array<std::uint32_t, 2>> beside;
    std::map<std::uint32_t, OwnShell> shells;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Corners corners = corners_of(mesh, mesh.triangles[t]);
        const Point3 least = std::min({corners[0], corners[1], corners[2]});
        beside.push_back({b.shell_of[front_of(t)], b.shell_of[back_of(t)]});
        for (const std::uint32_t shell : beside.back()) {
            const auto [at, is_new] = shells.try_emplace(shell, OwnShell{shell, 0, least, corners});
            at->second.least = std::min(at->second.least, least);
        }
    }
    for (const auto& [name, shell] : shells) out.put(0, 0, shell);
    std::vector<std::array<std::uint32_t, 3>> pairs;
    in.take<JoinedShell>(0, [&](std::uint32_t from, const JoinedShell& j) {
        pairs.push_back({b.shell_of[j.own], from, j.other});
    });
    sort_unique(pairs);
    for (const auto& [own, tile, other] : pairs) out.put(0, 1, ShellPair{own, tile, other});
    sort_unique(beside);
    for (const auto& two : beside) out.put(0, 2, two);
    return Done{};
}

// ---- Nesting -----------------------------------------------------------------------------------

/// In the first tile. Channel 0: NumberedShell, back; channel 1: for each line the triangle through
/// which it passes, to all.
Status join_shells_across(Tile& b, Inbox& in, Outbox& out) {
    if (b.index != 0) return Done{};
    struct Shell {
        std::uint32_t tile;
        OwnShell of;
    };
    std::vector<Shell> all;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> place;
    in.take<OwnShell>(0, [&](std::uint32_t from, const OwnShell& s) {
        place[{from, s.shell}] = static_cast<std::uint32_t>(all.size());
        all.push_back({from, s});
    });
    DisjointSets shells(all.size());
    in.take<ShellPair>(1, [&](std::uint32_t from, const ShellPair& p) {
        shells.join(place.at({from, p.own}), place.at({p.tile, p.other}));
    });
    DisjointSets components = shells;
    in.take<std::array<std::uint32_t, 2>>(2, [&](std::uint32_t from, const auto& beside) {
        components.join(place.at({from, beside[0]}), place.at({from, beside[1]}));
    });
    std::vector<std::uint32_t> number(all.size());
    b.least_vertices.clear();
    for (std::uint32_t k = 0; k < all.size(); ++k) {
        const std::uint32_t root = shells.find(k);
        const Point3& least = all[k].of.least;
        if (root == k) { // before the others of its set
            number[k] = static_cast<std::uint32_t>(b.least_vertices.size());
            b.least_vertices.push_back(least);
        }
        number[k] = number[root];
        b.least_vertices[number[k]] = std::min(b.least_vertices[number[k]], least);
        out.put(all[k].tile, 0, NumberedShell{all[k].of.shell, number[k]});
        if (components.find(k) == k) out.put_to_all(1, all[k].of.triangle);
    }
    return Done{};
}

/// Channel 0: CrossedTriangle, to the first tile.
Status cross_lines(Tile& b, Inbox& in, Outbox& out) {
    std::vector<std::uint32_t> number(b.shell_of.size());
    in.take<NumberedShell>(
        0, [&](std::uint32_t, const NumberedShell& s) { number[s.own] = s.number; });
    for (std::uint32_t& shell : b.shell_of) shell = number[shell];
    b.line_triangles = in.all<Corners>(1);
    const OwnSheets own(b, b.line_triangles);
    std::vector<std::uint32_t> through;
    for (std::uint32_t k = 0; k < b.line_triangles.size(); ++k) through.push_back(own.own() + k);
    for (const LineHit& h : find_line_hits(own.view(), through, own.own()))
        out.put(0, 0,
                CrossedTriangle{h.line, b.shell_of[front_of(h.triangle)],
                                b.shell_of[back_of(h.triangle)], 0,
                                corners_of(own.mesh(), own.mesh().triangles[h.triangle])});
    return Done{};
}

/// In the first tile. Channel 0: for each shell its volume, by the lowest shell of the volume, and
/// the number of shells for the outside; channel 1: volumes with a least vertex of others, to all.
Status join_along(Tile& b, Inbox& in, Outbox& out) {
    if (b.index != 0) return Done{};
    std::vector<Point3> points;
    std::vector<Triangle> triangles;
    const auto add = [&](const Corners& corners) {
        const auto v = static_cast<std::uint32_t>(points.size());
        points.insert(points.end(), corners.begin(), corners.end());
        triangles.push_back({v, v + 1, v + 2});
    };
    std::vector<LineHit> hits;
    std::vector<std::uint32_t> shell_of; // per side of a triangle here
    in.take<CrossedTriangle>(0, [&](std::uint32_t, const CrossedTriangle& c) {
        hits.push_back({c.line, static_cast<std::uint32_t>(triangles.size())});
        shell_of.insert(shell_of.end(), {c.front, c.back});
        add(c.at);
    });
    std::vector<std::uint32_t> through;
    for (const Corners& corners : b.line_triangles) {
        through.push_back(static_cast<std::uint32_t>(triangles.size()));
        add(corners);
    }
    const auto count = static_cast<std::uint32_t>(b.least_vertices.size()), outside = count;
    DisjointSets shells(count + std::size_t{1});
    const MeshSheets sheets(points, triangles, one_thread());
    const std::uint32_t beyond = 2 * static_cast<std::uint32_t>(triangles.size());
    join_along_lines(sheets.view(), through, hits, [&](std::uint32_t side, std::uint32_t other) {
        const auto shell = [&](std::uint32_t s) { return s == beyond ? outside : shell_of[s]; };
        shells.join(shell(side), shell(other));
    });
    std::map<Point3, std::vector<std::uint32_t>> volumes_at;
    b.volume_of_shell.clear();
    for (std::uint32_t s = 0; s < count; ++s) {
        const bool is_outside = shells.find(s) == shells.find(outside);
        const std::uint32_t volume = is_outside ? outside : shells.find(s);
        b.volume_of_shell.push_back(volume);
        if (is_outside) continue;
        b.least_vertices[volume] = std::min(b.least_vertices[volume], b.least_vertices[s]);
    }
    for (std::uint32_t s = 0; s < count; ++s) {
        out.put_to_all(0, b.volume_of_shell[s]);
        if (b.volume_of_shell[s] == s) volumes_at[b.least_vertices[s]].push_back(s);
    }
    for (const auto& [least, volumes] : volumes_at)
        if (volumes.size() > 1)
            for (const std::uint32_t v : volumes) out.put_to_all(1, v);
    return Done{};
}

// ---- Numbers -----------------------------------------------------------------------------------

/// To the first tile, of the volumes that share a least vertex: channel 0: TiedVertex; channel 1:
/// TiedSide.
Status tell_tied(Tile& b, Inbox& in, Outbox& out) {
    b.volume_of_shell = in.all<std::uint32_t>(0);
    for (std::uint32_t& shell : b.shell_of) shell = b.volume_of_shell[shell];
    auto tied = in.all<std::uint32_t>(1);
    std::sort(tied.begin(), tied.end());
    if (tied.empty()) return Done{};
    const Mesh mesh = piece_of(b).mesh;
    std::map<std::uint32_t, std::pair<std::vector<Point3>, PlacedSide>> found;
    for (std::uint32_t s = 0; s < b.shell_of.size(); ++s) {
        const std::uint32_t volume = b.shell_of[s];
        if (!std::binary_search(tied.begin(), tied.end(), volume)) continue;
        const Corners corners = corners_of(mesh, mesh.triangles[s / 2]);
        const PlacedSide key = placed_side(corners, s % 2 == 0);
        const auto [at, is_new] = found.try_emplace(volume, std::vector<Point3>(), key);
        auto& [vertices, least] = at->second;
        vertices.insert(vertices.end(), corners.begin(), corners.end());
        least = std::min(least, key);
    }
    for (auto& [volume, boundary] : found) {
        sort_unique(boundary.first);
        for (const Point3& p : boundary.first) out.put(0, 0, TiedVertex{volume, 0, p});
        out.put(0, 1, TiedSide{volume, 0, boundary.second});
    }
    return Done{};
}

/// In the first tile. Channel 0: the volumes in the order of their numbers, to all.
Status number_volumes(Tile& b, Inbox& in, Outbox& out) {
    if (b.index != 0) return Done{};
    std::map<std::uint32_t, std::vector<Point3>> vertices;
    std::map<std::uint32_t, PlacedSide> sides;
    in.take<TiedVertex>(
        0, [&](std::uint32_t, const TiedVertex& v) { vertices[v.volume].push_back(v.at); });
    in.take<TiedSide>(1, [&](std::uint32_t, const TiedSide& s) {
        const auto [at, is_new] = sides.try_emplace(s.volume, s.side);
        at->second = std::min(at->second, s.side);
    });
    for (auto& [volume, all] : vertices) sort_unique(all);
    std::vector<std::uint32_t> volumes;
    for (std::uint32_t s = 0; s < b.volume_of_shell.size(); ++s)
        if (b.volume_of_shell[s] == s) volumes.push_back(s);
    std::sort(volumes.begin(), volumes.end(), [&](std::uint32_t v, std::uint32_t w) {
        if (v == w) return false;
        if (b.least_vertices[v] != b.least_vertices[w])
            return b.least_vertices[v] < b.least_vertices[w];
        return std::tie(vertices.at(v), sides.at(v)) < std::tie(vertices.at(w), sides.at(w));
    });
    for (const std::uint32_t v : volumes) out.put_to_all(0, v);
    return Done{};
}

// ---- Measures ----------------------------------------------------------------------------------

/// To the first tile: channel 0: PartOfMeasure; channel 1: its letters.
Status measure_parts(Tile& b, Inbox& in, Outbox& out) {
    std::vector<std::uint32_t> number(b.volume_of_shell.size() + 1, 0); // the outside stays 0
    std::uint32_t count = 1;
    in.take<std::uint32_t>(0, [&](std::uint32_t, std::uint32_t v) { number[v] = count++; });
    b.volumes_of_sides.clear();
    for (std::size_t t = 0; 2 * t < b.shell_of.size(); ++t)
        b.volumes_of_sides.push_back({number[b.shell_of[2 * t]], number[b.shell_of[2 * t + 1]]});
    release(b.shell_of);
    release(b.volume_of_shell);
    release(b.line_triangles);
    release(b.least_vertices);
    b.measures.assign(count, 0);
    const OwnSheets own(b);
    const auto parts = partial_measures(own.view(), b.volumes_of_sides, count);
    for (std::uint32_t v = 0; v < count; ++v) {
        if (parts[v] == "0") continue;
        out.put(0, 0, PartOfMeasure{v, static_cast<std::uint32_t>(parts[v].size())});
        out.put_text(0, 1, parts[v]);
    }
    return Done{};
}

/// In the first tile. Channel 0: the measures, to all.
Status add_measures(Tile& b, Inbox& in, Outbox& out) {
    if (b.index != 0) return Done{};
    const auto parts = in.all<PartOfMeasure>(0);
    const auto letters = in.all<char>(1);
    std::vector<std::vector<std::string>> parts_of(b.measures.size());
    std::size_t at = 0;
    for (const PartOfMeasure& p : parts) {
        parts_of[p.volume].emplace_back(letters.data() + at, p.length);
        at += p.length;
    }
    for (const auto& of_volume : parts_of) out.put_to_all(0, measure_of_parts(of_volume));
    return Done{};
}

Status receive_measures(Tile& b, Inbox& in, Outbox&) {
    b.measures = in.all<double>(0);
    return Done{};
}

} // namespace

Result<Volumes> find_volumes_in_tiles(Supersteps& tiles) {
    const std::pair<std::string_view, Status (*)(Tile&, Inbox&, Outbox&)> steps[] = {
        {"shells", share_edges},         {"shells", pair_sides},
        {"shells", join_shells_within},  {"nesting", gather_shells},
        {"nesting", join_shells_across}, {"nesting", cross_lines},
        {"nesting", join_along},         {"numbers", tell_tied},
        {"numbers", number_volumes},     {"measures", measure_parts},
        {"measures", add_measures},      {"measures", receive_measures},
    };
    for (const auto& [name, work] : steps)
        if (const auto done = tiles.step(name, work); !done) return done.error();
    const auto bytes = tiles.relay([](Tile& b, Bytes before) {
        if (!before.empty()) return before;
        Bytes all;
        for (const double m : b.measures) append_record(all, m);
        return all;
    });
    if (!bytes) return bytes.error();
    Volumes volumes;
    volumes.measures.resize(bytes->size() / sizeof(double));
    std::memcpy(volumes.measures.data(), bytes->data(), bytes->size());
    volumes.total = std::exchange(volumes.measures[0], Volumes().measures[0]);
    return volumes;
}

} // namespace terrane::tiles
