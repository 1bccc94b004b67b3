// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/tiles/messages.hpp>
#include <terrane/algorithms/tiles/tile.hpp>

namespace terrane::tiles::detail {

/// A side of a triangle of this tile, its lower end first.
struct EdgeSide {
    std::array<std::uint32_t, 2> ends{};
    std::uint32_t triangle = 0;

    friend auto operator<=>(const EdgeSide&, const EdgeSide&) = default;
};

/// The findings of a tile in the check of the doubles, and triangles of the result under the input
/// triangles whose home it is.
struct TileVerdict {
    std::uint64_t unclean = 0, triangles = 0;
    double deviation = 0;
};

/// An intersection edge, told to one tile with a triangle at it.
struct DecidedEdge {
    std::array<std::uint32_t, 2> ends{};
};

/// Two triangles in the same regions: one of the tile that is told, and one of a tile.
struct Neighbour {
    std::uint32_t triangle = 0, tile = 0, other = 0;
};

/// Returns the sides of all triangles, by edge.
std::vector<EdgeSide> sides_of(const Tile& b);
/// Tells whether two triangles have as many distinct parents in each surface.
bool agree(const Tile& b, std::uint32_t s, std::uint32_t t);
/// Returns the first of a triangle that is repeated, in a sorted list of {repeated, first}; otherwise the
/// triangle.
std::uint32_t first_in(std::span<const std::array<std::uint32_t, 2>> repeated,
                       std::uint32_t triangle);
/// Returns the first input triangle with the same corners.
std::uint32_t first_same(const Tile& b, std::uint32_t triangle);

/// Sends the sides of shared edges to where they are decided, in channels 1 and 2.
void send_sides(const Tile& b, Outbox& out);
/// Decides shared edges. Channel 0: DecidedEdge, to the tiles of its triangles; channel 1: Neighbour, to
/// the tile of the first of two triangles that are in one region.
void decide_edges(Inbox& in, Outbox& out);

} // namespace terrane::tiles::detail
