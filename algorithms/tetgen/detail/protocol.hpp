// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The messages between the library and the helper programs of the meshers TetGen and Gmsh, which run
// on the same machine.
//
// Request: RequestHeader; points as 3 doubles each; facets + 1 offsets into the corners (uint32);
// corners (uint32); per facet a bound on the area of its faces, infinite for no bound, or no bounds
// at all (double); blocks as x, y, z and the largest volume of a tetrahedron (double); per facet the
// blocks on both its sides, or none at all (uint32).
//
// Reply: ReplyHeader. If its status is `done`, there follow: points as 3 doubles each; tetrahedra
// as 4 corners each (uint32); faces on facets as 3 corners each (uint32); per face 1 + its facet
// (uint32).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace terrane::tetgen::detail {

/// The first bytes of each message. They read as another number in another byte order.
inline constexpr std::uint64_t request_mark = 0x7467'7265'7175'6573;
inline constexpr std::uint64_t reply_mark = 0x7467'7265'706c'7931;

/// The version of the messages, to be raised with each change. A helper of another version is
/// refused.
inline constexpr std::uint32_t protocol_version = 2;

/// The most items of a kind. TetGen counts in int, and up to 4 corners per item.
inline constexpr std::uint64_t most_items = std::numeric_limits<std::int32_t>::max() / 4;

/// Bits of RequestHeader::flags.
enum RequestFlag : std::uint32_t {
    keep_facets_flag = 1,
    improve_flag = 2,
    sort_points_flag = 4,
    max_volume_flag = 8,         ///< max_volume has a value
    radius_edge_ratio_flag = 16, ///< radius_edge_ratio has a value
    parallel_delaunay_flag = 32, ///< Gmsh: its newer algorithm (HXT)
};
inline constexpr std::uint32_t all_flags = 63;

struct RequestHeader {
    std::uint64_t mark = request_mark;
    std::uint32_t version = protocol_version;
    std::uint32_t flags = 0;
    std::uint64_t points = 0;
    std::uint64_t facets = 0;
    std::uint64_t corners = 0;
    std::uint64_t area_bounds = 0; ///< 0 or as many as facets
    std::uint64_t blocks = 0;
    std::uint64_t sides = 0; ///< 0 or as many as facets
    double max_volume = 0;
    double radius_edge_ratio = 0;
};

struct ReplyHeader {
    std::uint64_t mark = reply_mark;
    std::uint32_t version = protocol_version;
    std::int32_t status = 0; ///< `done`, or why there is no result
    std::uint64_t points = 0;
    std::uint64_t tetrahedra = 0;
    std::uint64_t faces = 0;
};

// Values of ReplyHeader::status: 0, the code that TetGen threw (1 memory, 2 internal, 3
// self-intersection, 4 feature too small, 5 facets too close, 10 input), or one of the helper's
// own.
inline constexpr std::int32_t done = 0;
inline constexpr std::int32_t tetgen_out_of_memory = 1;
inline constexpr std::int32_t unknown_exception = 100;
inline constexpr std::int32_t bad_request = 101;
inline constexpr std::int32_t other_version = 102;
inline constexpr std::int32_t mesher_failed = 103;

using Coordinates = std::array<double, 3>;
using BlockRecord = std::array<double, 4>;        ///< x, y, z, largest volume of a tetrahedron
using SidesRecord = std::array<std::uint32_t, 2>; ///< blocks in front of a facet and behind it

/// The side of a facet that is outside of the whole domain.
inline constexpr std::uint32_t no_block = std::numeric_limits<std::uint32_t>::max();

static_assert(sizeof(RequestHeader) == 80 && sizeof(ReplyHeader) == 40); // no padding
static_assert(sizeof(Coordinates) == 24 && sizeof(BlockRecord) == 32);
static_assert(sizeof(int) == sizeof(std::uint32_t) && std::numeric_limits<double>::is_iec559);

} // namespace terrane::tetgen::detail
