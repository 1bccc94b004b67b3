// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/names_in_blocks.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/distribution/distributed_arrangement.hpp>
#include <terrane/algorithms/structure/detail/block_contacts.hpp>

namespace terrane {

using namespace distribution;
using namespace structure::detail;

namespace {

/// The sums over the triangles of a surface at a volume, of one block.
struct SumsOfBlock {
    std::uint32_t volume = 0, surface = 0;
    ContactSums sums;
};

/// Channel 0: the first vertex of all, to all.
Status send_origin(Block& b, Inbox&, Outbox& out) {
    const BlockPiece piece = piece_of(b);
    if (!piece.vertex_ids.empty() && piece.vertex_ids[0] == 0)
        out.put_to_all(0, piece.mesh.vertices[0]);
    return Done{};
}

/// Channel 0: SumsOfBlock, to the first block.
Status send_sums(Block& b, Inbox& in, Outbox& out) {
    const StandardArithmetic guard;
    Point3 origin{};
    in.take<Point3>(0, [&](std::uint32_t, const Point3& p) { origin = p; });
    const BlockPiece piece = piece_of(b);
    std::uint32_t count = 1;
    for (const auto& [front, back] : piece.volumes_of_sides)
        count = std::max(count, std::max(front, back) + 1);
    std::vector<std::map<std::uint32_t, ContactSums>> sums(count);
    add_contacts(piece.mesh, piece.volumes_of_sides, origin, sums);
    for (std::uint32_t v = 1; v < count; ++v)
        for (const auto& [surface, own] : sums[v]) out.put(0, 0, SumsOfBlock{v, surface, own});
    return Done{};
}

/// Names the volumes in the first block. Each name ends with a byte of 0.
Bytes names_in(const Block& b, std::span<const SumsOfBlock> all) {
    const StandardArithmetic guard;
    std::vector<std::map<std::uint32_t, ContactSums>> sums(b.measures.size());
    for (const SumsOfBlock& s : all) sums[s.volume][s.surface].add(s.sums);
    Bytes text;
    for (const std::string& name :
         names_by_contacts(piece_of(b).mesh.surfaces, contacts_of(sums))) {
        for (const char c : name) append_record(text, c);
        append_record(text, '\0');
    }
    return text;
}

} // namespace

Result<std::vector<std::string>> name_volumes_in_blocks(Supersteps& blocks) {
    if (auto sent = blocks.step("names", send_origin); !sent) return sent.error();
    if (auto sent = blocks.step("names", send_sums); !sent) return sent.error();
    Bytes text; // in the process of the first block
    const auto name = [&](Block& b, Inbox& in, Outbox&) -> Status {
        if (b.index == 0) text = names_in(b, in.all<SumsOfBlock>(0));
        return Done{};
    };
    if (auto named = blocks.step("names", name); !named) return named.error();
    const auto bytes = blocks.relay(
        [&](Block& b, Bytes before) { return b.index == 0 ? text : std::move(before); });
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

} // namespace terrane
