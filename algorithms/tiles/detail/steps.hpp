// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The steps of a distributed arrangement, in their order. Each takes what the one before has sent;
// the comments of the records name their channels.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/rounding/moved_input.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/algorithms/tiles/messages.hpp>
#include <terrane/algorithms/tiles/supersteps.hpp>
#include <terrane/algorithms/tiles/tile.hpp>
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>

namespace terrane::tiles::detail {

/// Reads the surfaces of file i.
using ReadFile = std::function<Result<std::vector<Surface>>(std::size_t file)>;

/// A number of [0, total) has its home in one of `tiles` ranges of equal length.
inline std::uint32_t home_of(std::uint32_t number, std::uint32_t total, std::size_t tiles) {
    const auto share = (total + tiles - 1) / tiles;
    return static_cast<std::uint32_t>(number / std::max<std::size_t>(share, 1));
}
/// Returns the first number whose home is this tile.
inline std::uint32_t home_start(const Tile& b, std::uint32_t total) {
    const auto share = (std::uint64_t{total} + b.count - 1) / b.count;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(total, share * b.index));
}
/// Returns the number of numbers whose home is this tile.
inline std::uint32_t home_size(const Tile& b, std::uint32_t total) {
    const auto share = (std::uint64_t{total} + b.count - 1) / b.count;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(total, share * (b.index + 1))) -
           home_start(b, total);
}

/// Returns the surface of an input triangle.
std::uint32_t surface_of(const Tile& b, std::uint32_t triangle);
/// Returns the box of three points.
Box box_of(const std::array<Point3, 3>& at);
/// Returns the tile that owns a face.
std::uint32_t owner_of_face(const Tile& b, const Face& face);
/// Returns the name of a surface.
std::string name_of_surface(const Tile& b, std::uint32_t surface);
/// Returns the tile that keeps a record of the digest.
std::uint32_t keeper_of(const Tile& b, const Hash& record);
/// Returns the hash of an input triangle, by the digest.
Hash input_hash(const Tile& b, const Face& face);

// Reading (reading.cpp): each file is read in one tile; the others learn the sizes.
Status announce(Tile& b, std::size_t files, const ReadFile& read, Outbox& out);
Status share_out(Tile& b, Inbox& in, Outbox& out);

// Naming of input vertices (naming.cpp): equal points are found where a hash of them points to.
void send_home_vertices(const Tile& b, Outbox& out);
Status receive_share(Tile& b, Inbox& in, Outbox& out);
Status find_first_vertices(Tile& b, Inbox& in, Outbox& out);
Status ask_for_corners(Tile& b, Inbox& in, Outbox& out);
Status tell_corners(Tile& b, Inbox& in, Outbox& out);
Status weigh_cells(Tile& b, Inbox& in, Outbox& out);
Status divide_space(Tile& b, Inbox& in, Outbox& out);
Status distribute_faces(Tile& b, Inbox& in, Outbox& out);

// Pairs (pairs.cpp) and division of faces (divide.cpp).
Status decide_pairs(Tile& b, Inbox& in, Outbox& out, const Run& run);
Status divide_own_faces(Tile& b, Inbox& in, Outbox& out, const Run& run);

// Numbers of points (numbering.cpp): a sample sort in lexicographic order.
Status split_points(Tile& b, Inbox& in, Outbox& out);
Status send_points(Tile& b, Inbox& in, Outbox& out);
Status order_constructed(Tile& b, Inbox& in, Outbox& out);
Status number_points(Tile& b, Inbox& in, Outbox& out);
Status receive_numbers(Tile& b, Inbox& in, Outbox& out);

// The result (settling.cpp): coinciding parts, parents, and triangles of doubles.
void send_overlapping_parts(Tile& b, Outbox& out);
Status unite_parts(Tile& b, Inbox& in, Outbox& out);
Status settle(Tile& b, Inbox& in, Outbox& out);

// The check of the doubles (doubles.cpp).
Status check_doubles(Tile& b, Inbox& in, Outbox& out, const Run& run);

// Edges, regions and numbers of triangles (edges.cpp, regions.cpp).
Status send_shared_edges(Tile& b, Inbox& in, Outbox& out);
Status decide_shared_edges(Tile& b, Inbox& in, Outbox& out);
Status join_within(Tile& b, Inbox& in, Outbox& out);
Status join_across(Tile& b, Inbox& in, Outbox& out);
Status number_regions(Tile& b, Inbox& in, Outbox& out);
Status receive_regions(Tile& b, Inbox& in, Outbox& out);

/// The settings of the repair of few pairs.
struct RepairInput {
    std::uint64_t most_gathered = 0; ///< most triangles, and pairs, that are few
    bool is_moved = false;           ///< whether the input was moved
    double used = 0;                 ///< no surface was moved farther
};

/// The outcome of the repair of few pairs.
struct RepairOfFew {
    bool is_done =
        false; ///< whether the first tile could gather all that it takes, and changes no joints
    RepairInTiles summary;
    /// The input triangles in contact, if it is done and the report is not clean. Only the process of the
    /// first tile has them.
    ParentsInContact in_contact{};
};

/// Repairs doubles that are not conforming, where few pairs are in the way (repairing.cpp). Then
/// report.clean, or nothing has changed. Cost: some steps, in each of which a tile looks at the boxes of
/// its triangles; the process of the first tile holds those near the pairs.
Result<RepairOfFew> repair_few(Supersteps& tiles, TiledReport& report, const RepairInput& input,
                               const Run& run);

/// Moves the input as round_to_doubles() does and arranges it again, where a repair of few pairs found no
/// conforming mesh (moving.cpp). Then report.clean, or the tiles have the input as it was, and nothing
/// else. first: of the input where it lies, by `input`.
Status move_input(Supersteps& tiles, TiledReport& report, RepairOfFew first,
                  const RepairInput& input, const Run& run);

/// Work for all tiles next to some steps of arrange_moved().
struct StepsBeside {
    std::function<void(Tile&, Inbox&, Outbox&)> send_points, order_constructed, number_points;
};
/// Arranges what home_points say, after send_home_vertices() (tiled_arrangement.cpp).
Status arrange_moved(Supersteps& tiles, const StepsBeside& beside, const Run& run);

/// Sums up what the tiles report, without the digest (tiled_arrangement.cpp).
Result<TiledReport> summary_of(Supersteps& tiles);

// Lookups by name, once points are numbered (settling.cpp).
/// Returns the coordinates of a point in doubles.
Point3 doubles_of(const Tile& b, std::uint32_t name);
/// Returns the bound of its distance from the exact point.
double bound_of(const Tile& b, std::uint32_t name);
/// Tells whether several tiles use a point.
bool is_shared(const Tile& b, std::uint32_t name);
/// Returns the number of the vertex through all tiles.
std::uint32_t vertex_number(const Tile& b, std::uint32_t name);
/// Returns the hash of a point.
Hash hash_of_point(const Tile& b, std::uint32_t name);
/// Returns the hash of an input triangle that is a parent here.
const Hash& hash_of_parent(const Tile& b, std::uint32_t id);

// Records of the digest (records.cpp).
void add_records_of_parents(Tile& b, Outbox& out, std::size_t channel);
void add_records_of_vertices(Tile& b, Outbox& out, std::size_t channel);
void send_parents_of_shared(Tile& b, Outbox& out, std::size_t channel);
void decide_shared_vertices(Tile& b, Inbox& in, std::size_t from, Outbox& out, std::size_t to);
void keep_records(Tile& b, Inbox& in, std::size_t channel);
void put_record(const Tile& b, const Hash& record, Outbox& out, std::size_t channel);

} // namespace terrane::tiles::detail
