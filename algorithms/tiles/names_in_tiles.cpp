// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tiles/names_in_tiles.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/structure/block_contacts.hpp>
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>

namespace terrane::tiles {

using namespace structure;

namespace {

/// The sums over the triangles of a surface at a volume, of one tile.
struct SumsOfTile {
    std::uint32_t volume = 0, surface = 0;
    ContactSums sums;
};

/// A surface of a triangle between two blocks. Those of one triangle follow each other.
struct CrossingOfTile {
    std::array<std::uint32_t, 2> blocks{};
    std::uint32_t surface = 0;
};

/// The sum over the edges of a surface in one tile.
struct EdgesOfTile {
    std::uint32_t surface = 0;
    BlockSides::EdgeSum sum{};
};

/// Channel 0: the first vertex of all, to all.
Status send_origin(Tile& b, Inbox&, Outbox& out) {
    const TilePiece piece = piece_of(b);
    if (!piece.vertex_ids.empty() && piece.vertex_ids[0] == 0)
        out.put_to_all(0, piece.mesh.vertices[0]);
    return Done{};
}

/// Channels 0 to 2: SumsOfTile, CrossingOfTile and EdgesOfTile, to the first tile.
Status send_sums(Tile& b, Inbox& in, Outbox& out) {
    const StandardArithmetic guard;
    Point3 origin{};
    in.take<Point3>(0, [&](std::uint32_t, const Point3& p) { origin = p; });
    const TilePiece piece = piece_of(b);
    std::uint32_t count = 1;
    for (const auto& [front, back] : piece.volumes_of_sides)
        count = std::max(count, std::max(front, back) + 1);
    std::vector<std::map<std::uint32_t, ContactSums>> sums(count);
    add_contacts(piece.mesh, piece.volumes_of_sides, origin, sums);
    for (std::uint32_t v = 1; v < count; ++v)
        for (const auto& [surface, own] : sums[v]) out.put(0, 0, SumsOfTile{v, surface, own});
    BlockSides sides;
    sides.add(piece.mesh, piece.volumes_of_sides);
    for (const auto& [blocks, surfaces] : sides.crossings())
        for (const std::uint32_t s : surfaces) out.put(0, 1, CrossingOfTile{blocks, s});
    for (const auto& [surface, sum] : sides.edge_sums()) out.put(0, 2, EdgesOfTile{surface, sum});
    return Done{};
}

/// Names the volumes in the first tile. Each name ends with a byte of 0.
Bytes names_in(const Tile& b, Inbox& in) {
    const StandardArithmetic guard;
    std::vector<std::map<std::uint32_t, ContactSums>> sums(b.measures.size());
    for (const SumsOfTile& s : in.all<SumsOfTile>(0)) sums[s.volume][s.surface].add(s.sums);
    BlockSides sides;
    const auto crossings = in.all<CrossingOfTile>(1);
    for (std::size_t i = 0, end = 0; i < crossings.size(); i = end) {
        std::vector<std::uint32_t> surfaces;
        for (; end < crossings.size() && crossings[end].blocks == crossings[i].blocks &&
               (surfaces.empty() || surfaces.back() < crossings[end].surface);
             ++end)
            surfaces.push_back(crossings[end].surface);
        sides.add_crossing(crossings[i].blocks, surfaces);
    }
    for (const EdgesOfTile& e : in.all<EdgesOfTile>(2)) sides.add_edges(e.surface, e.sum);
    Bytes text;
    for (const std::string& name :
         names_by_contacts(piece_of(b).mesh.surfaces, contacts_of(sums, sides))) {
        for (const char c : name) append_record(text, c);
        append_record(text, '\0');
    }
    return text;
}

} // namespace

Result<std::vector<std::string>> name_volumes_in_tiles(Supersteps& tiles) {
    if (auto sent = tiles.step("names", send_origin); !sent) return sent.error();
    if (auto sent = tiles.step("names", send_sums); !sent) return sent.error();
    Bytes text; // in the process of the first tile
    const auto name = [&](Tile& b, Inbox& in, Outbox&) -> Status {
        if (b.index == 0) text = names_in(b, in);
        return Done{};
    };
    if (auto named = tiles.step("names", name); !named) return named.error();
    const auto bytes =
        tiles.relay([&](Tile& b, Bytes before) { return b.index == 0 ? text : std::move(before); });
    if (!bytes) return bytes.error();
    std::vector<std::string> names(1);
    for (const std::byte c : *bytes)
        if (c == std::byte{0})
            names.emplace_back();
        else
            names.back() += static_cast<char>(c);
    names.pop_back();
    return names;
}

} // namespace terrane::tiles
