// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Hashes that the digest consists of (arrangement/arrangement.hpp).
#include <algorithm>

#include <terrane/algorithms/tiles/detail/hashes.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>
#include <terrane/kernel/fraction.hpp>

namespace terrane::tiles::detail {

Hash hash_of_coordinates(const std::array<std::string, 3>& xyz) {
    Sha256 state;
    state.feed(xyz[0]);
    state.feed(" ");
    state.feed(xyz[1]);
    state.feed(" ");
    state.feed(xyz[2]);
    return state.finish();
}

Hash hash_of_input(const Point3& p) {
    const Exact one(1);
    return hash_of_coordinates({fraction(Exact(p.x), one, 16), fraction(Exact(p.y), one, 16),
                                fraction(Exact(p.z), one, 16)});
}

Hash tagged_hash(std::string_view tag, std::vector<Hash> list, std::string_view tail) {
    std::sort(list.begin(), list.end());
    Sha256 state;
    state.feed(tag);
    state.feed(list);
    state.feed(tail);
    return state.finish();
}

Hash input_hash(const Tile& b, const Face& face) {
    return tagged_hash(
        "input", {hash_of_input(face.at[0]), hash_of_input(face.at[1]), hash_of_input(face.at[2])},
        name_of_surface(b, surface_of(b, face.id)));
}

std::uint32_t keeper_of(const Tile& b, const Hash& record) {
    const std::uint64_t high = std::uint64_t{record[0]} << 24 | std::uint64_t{record[1]} << 16 |
                               std::uint64_t{record[2]} << 8 | record[3];
    return static_cast<std::uint32_t>(high * b.count >> 32);
}

} // namespace terrane::tiles::detail
