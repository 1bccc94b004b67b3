// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tiles/names_in_tiles.hpp>

#include <algorithm>
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

/// Channel 0: the first vertex of all, to all.
Status send_origin(Tile& b, Inbox&, Outbox& out) {
    const TilePiece piece = piece_of(b);
    if (!piece.vertex_ids.empty() && piece.vertex_ids[0] == 0)
        out.put_to_all(0, piece.mesh.vertices[0]);
    return Done{};
}

/// Channel 0: SumsOfTile, to the first tile.
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
    return Done{};
}

/// Names the volumes in the first tile. Each name ends with a byte of 0.
Bytes names_in(const Tile& b, std::span<const SumsOfTile> all) {
    const StandardArithmetic guard;
    std::vector<std::map<std::uint32_t, ContactSums>> sums(b.measures.size());
    for (const SumsOfTile& s : all) sums[s.volume][s.surface].add(s.sums);
    Bytes text;
    for (const std::string& name :
         names_by_contacts(piece_of(b).mesh.surfaces, contacts_of(sums))) {
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
        if (b.index == 0) text = names_in(b, in.all<SumsOfTile>(0));
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
