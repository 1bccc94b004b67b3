// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/distribution/block.hpp>
#include <terrane/algorithms/distribution/messages.hpp>

namespace terrane::distribution::detail {

/// A side of a triangle of this block, its lower end first.
struct EdgeSide {
    std::array<std::uint32_t, 2> ends{};
    std::uint32_t triangle = 0;

    friend auto operator<=>(const EdgeSide&, const EdgeSide&) = default;
};

/// What a block found in the check of the doubles, and triangles of the result under the input
/// triangles whose home it is.
struct BlockVerdict {
    std::uint64_t unclean = 0, triangles = 0;
    double deviation = 0;
};

/// An intersection edge, told to one block with a triangle at it.
struct DecidedEdge {
    std::array<std::uint32_t, 2> ends{};
};

/// Two triangles in the same regions: one of the block that is told, and one of a block.
struct Neighbour {
    std::uint32_t triangle = 0, block = 0, other = 0;
};

/// Returns the sides of all triangles, by edge.
std::vector<EdgeSide> sides_of(const Block& b);
/// Tells whether two triangles have as many distinct parents in each surface.
bool agree(const Block& b, std::uint32_t s, std::uint32_t t);
/// Returns the first of a triangle that is repeated, in a sorted list of {repeated, first}; otherwise the
/// triangle.
std::uint32_t first_in(std::span<const std::array<std::uint32_t, 2>> repeated,
                       std::uint32_t triangle);
/// Returns the first input triangle with the same corners.
std::uint32_t first_same(const Block& b, std::uint32_t triangle);

/// Sends the sides of shared edges to where they are decided, in channels 1 and 2.
void send_sides(const Block& b, Outbox& out);
/// Decides shared edges. Channel 0: DecidedEdge, to the blocks of its triangles; channel 1: Neighbour, to
/// the block of the first of two triangles that are in one region.
void decide_edges(Inbox& in, Outbox& out);

} // namespace terrane::distribution::detail
