// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Computes an arrangement in tiles, in one process or many.
//
// Guarantees: the triangles of all tiles together are those of arrange() rounded by
// round_to_doubles(), with the same numbers, parents and regions, for any number of tiles; the digest
// is the same. Where the nearest doubles are not a conforming mesh, few pairs in the way are repaired as
// round_to_doubles() repairs them, with the triangles near them; or all tiles move the input as it does,
// and arrange it again. Where pairs are many, none of that helps, or round_to_doubles() may prefer another
// attempt, the report is not clean: that needs the whole model (docs/explanation/scale.md).
// Cost: that of arrange(), divided by the number of tiles as far as they balance, and of the faces
// that overlap several tiles.
// Source: the paper, section 2 (structured grid); Valiant (1990) for the steps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/tiles/supersteps.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::tiles {

/// Reads the surfaces of file i, in the process that has to read it.
using FileReader = std::function<Result<std::vector<Surface>>(std::size_t file)>;

/// Options of arrange_in_tiles().
struct TiledOptions {
    std::size_t files = 0; ///< number of input files
    bool digest = false;   ///< whether the digest is computed, which costs more than all else
    /// The first tile gathers at most this many triangles near the contacts in the way of a mesh of
    /// doubles, or twice the average of a tile.
    std::uint64_t most_gathered = 65'536;
};

/// How doubles in the way were repaired.
struct RepairInTiles {
    std::uint64_t contacts = 0;   ///< pairs of triangles that met improperly
    std::uint64_t triangles = 0;  ///< those that were gathered
    unsigned rounds = 0;          ///< of moving vertices, and of snapping
    double surface_deviation = 0; ///< see RoundingReport
    bool is_moved = false;        ///< whether the input was moved and arranged again
};

/// The result as all processes know it.
struct TiledReport {
    bool clean = false;         ///< the doubles are a conforming mesh, by exact check of all pairs
    std::uint64_t contacts = 0; ///< pairs, points and triangles that are in the way
    double deviation = 0;       ///< no vertex is farther from its exact point; of a moved input no
                                ///< surface is farther from where it was
    double limit = 0;           ///< farthest that is allowed unless the user says otherwise
    std::uint64_t input_vertices = 0, input_triangles = 0;
    std::uint64_t vertices = 0, triangles = 0, intersection_edges = 0, regions = 0;
    std::string digest{};                  ///< if it is wanted
    std::optional<RepairInTiles> repair{}; ///< if the nearest doubles were not conforming, but are
                                           ///< repaired
    std::optional<Volumes> volumes{}; ///< without sides, once they are found (volumes_in_tiles.hpp)
    std::vector<std::string> volume_names{}; ///< likewise (names_in_tiles.hpp); [0] is "outside"
    Work largest{};                          ///< of each count the largest of any tile
    Work total{}; ///< of each count the sum over all tiles; memory: as largest
};

/// The triangles of one tile.
struct TilePiece {
    Mesh mesh;                               ///< without intersection edges
    std::vector<std::uint32_t> vertex_ids;   ///< per vertex: its number through all tiles
    std::vector<std::uint32_t> triangle_ids; ///< per triangle, ascending
    /// Per triangle: the volumes in front of it and behind it, once they are found
    /// (volumes_in_tiles.hpp).
    std::vector<std::array<std::uint32_t, 2>> volumes_of_sides{};
};

/// Arranges. Errors: those of the reader and of arrange(). Throws std::bad_alloc where memory ends between steps, as
/// all other functions for tiles do: a process alone must end all (MPI_Abort), as the others would wait for it.
Result<TiledReport> arrange_in_tiles(Supersteps& tiles, const FileReader& read,
                                     const TiledOptions& options, const Run& run = {});

/// Counts the work again, after steps that follow.
Status count_work(Supersteps& tiles, TiledReport& report);

/// Returns the triangles of a tile after arrange_in_tiles(), with nearest doubles.
TilePiece piece_of(const Tile& tile);
/// Tells, for each vertex of the piece of a tile, whether several tiles use it.
std::vector<bool> shared_vertices(const Tile& tile, const TilePiece& piece);

/// Arranges and rounds all surfaces in the process of the first tile, for a mesh that is not clean. That
/// process then needs the memory and the
/// time of arrange() and round_to_doubles(). Call it after arrange_in_tiles(), in all processes; in
/// others the piece is empty. Errors: those of arrange() and round_to_doubles().
struct RepairedWhole {
    TilePiece piece;       ///< all triangles, in the process of the first tile
    RoundingReport report; ///< the same in all processes, but for its lists
};
Result<RepairedWhole> repair_in_one_process(Supersteps& tiles, const Run& run = {});

} // namespace terrane::tiles
