// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The state of one tile between steps. It consists of arrays of plain values, so that it can be
// written to disk and read back.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/sha256.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/tiles/grid.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::tiles {

/// An input triangle with area as it travels. Its corners are named by the first input vertex at
/// their place, through all surfaces.
struct Face {
    std::uint32_t id = 0;                   ///< number of the input triangle
    std::array<std::uint32_t, 3> corners{}; ///< first input vertices
    std::array<Point3, 3> at{};             ///< their coordinates
};

/// A pair of faces that meet improperly.
struct MeetingFaces {
    Face first, second;        ///< first.id < second.id
    std::uint32_t overlap = 0; ///< 1: they are coplanar and have an area in common
    std::uint32_t unused = 0;
};

/// A part of a face. A corner is a name: an input vertex, or (number of input vertices) + a
/// constructed point: by the tile's own number until points are numbered through all tiles.
struct Part {
    std::uint32_t face = 0; ///< the lowest face that is known here to contain it
    std::array<std::uint32_t, 3> corners{};
};

/// A constructed point of this tile.
struct OwnPoint {
    Point3 nearest{};
    double bound = 0;         ///< of its distance from `nearest`
    std::uint32_t number = 0; ///< through all tiles, in lexicographic order
    std::uint32_t shared = 0; ///< 1: several tiles use it
    Hash hash{};              ///< of its exact coordinates, if a digest is wanted
};

/// An input vertex that the triangles of this tile use.
struct UsedVertex {
    std::uint32_t id = 0;     ///< first input vertex
    std::uint32_t number = 0; ///< among all that are in use
    std::uint32_t shared = 0; ///< 1: several tiles use it
    std::uint32_t unused = 0;
    Point3 at{};
};

/// A part of a divided face, in doubles.
struct DoubleFace {
    std::array<std::uint32_t, 3> corners{}; ///< names
    std::uint32_t is_dirty = 0;             ///< 1: a corner is not at its exact place
    std::array<Point3, 3> at{};
};

/// A corner of triangles of doubles that meet improperly or have no area, or a point that is where
/// another one is.
struct UncleanPoint {
    std::uint32_t name = 0, unused = 0;
    Point3 at{};
};

/// The hash of an input triangle, by the digest.
struct ParentHash {
    std::uint32_t id = 0;
    Hash hash{};
};

/// Counts of the work of a tile, for the cost model.
struct Work {
    std::uint64_t homes = 0;         ///< input triangles that it read its share of
    std::uint64_t faces = 0;         ///< faces whose boxes overlap the tile
    std::uint64_t owned = 0;         ///< faces of which it is the owner
    std::uint64_t candidates = 0;    ///< pairs of boxes that it decides
    std::uint64_t improper = 0;      ///< those that meet improperly
    std::uint64_t divided = 0;       ///< faces that it divides
    std::uint64_t predicates = 0;    ///< signs
    std::uint64_t constructed = 0;   ///< points that it constructs
    std::uint64_t triangles = 0;     ///< of the result
    std::uint64_t rounded_pairs = 0; ///< pairs of triangles of doubles that it tests
    std::uint64_t near_boxes = 0;    ///< boxes that it compares to find triangles near what is in
                                     ///< the way of a mesh of doubles
    std::uint64_t messages = 0;      ///< to other tiles, not empty
    std::uint64_t bytes = 0;         ///< in these
    std::uint64_t memory = 0;        ///< most bytes of its state and its messages in any step
};

/// The file and place of a surface in it, and its size.
struct SurfaceEntry {
    std::uint32_t file = 0, surface = 0, vertices = 0, triangles = 0, role = 0, name_length = 0;
};

/// Frees the memory of an array; `array = {}` would keep it.
template <class T>
void release(std::vector<T>& array) {
    std::vector<T>().swap(array);
}

/// The state of one tile. The functions that compute the members of a group explain them.
struct Tile {
    std::uint32_t index = 0, count = 1; ///< of tiles
    bool wants_digest = false;
    Work work;

    // Surfaces, the same in all tiles (reading.cpp).
    std::vector<SurfaceEntry> entries; ///< by file and place
    std::vector<char> names;           ///< of all surfaces, one after the other
    std::vector<std::uint32_t> first_vertex, first_triangle; ///< per surface, then the total
    std::vector<Point3> read_vertices;     ///< of the files that it reads, until shared
    std::vector<Triangle> read_triangles;  ///< likewise
    std::vector<std::uint32_t> read_files; ///< entries of these surfaces, by file and place

    // The share of input vertices and triangles by number, whose home is this tile (naming.cpp).
    std::vector<Point3> home_points;            ///< of the first vertex at the same place
    std::vector<std::uint32_t> home_first;      ///< that vertex
    std::vector<Triangle> home_triangles;       ///< corners as read
    std::vector<Face> home_faces;               ///< those with area, until distributed
    std::vector<std::uint32_t> home_degenerate; ///< input triangles without area, ascending
    std::vector<Hash> degenerate_records;       ///< of the digest
    std::vector<std::uint32_t> home_owner;      ///< per triangle: the tile that owns it
    std::vector<std::uint32_t> home_count;      ///< per triangle: triangles of the result under it

    // The input before it was moved (moving.cpp).
    bool is_moved = false;
    std::vector<Point3> home_given;                           ///< home_points
    std::vector<std::uint32_t> home_given_first;              ///< home_first
    std::vector<std::uint32_t> home_flat;                     ///< home_degenerate
    std::vector<std::array<std::uint32_t, 2>> home_repeated;  ///< of home triangles: {repeated,
                                                              ///< first}, sorted
    std::vector<std::array<std::uint32_t, 2>> given_repeated; ///< of faces that this tile owns
    bool is_in_frame = false; ///< faces are in a frame, and the doubles in none (frames.cpp)
    TileGrid given_grid;      ///< `grid`, for the doubles of a frame
    std::vector<std::uint64_t> given_splitters;      ///< likewise
    std::vector<std::array<double, 3>> point_errors; ///< per constructed point of a frame, per axis

    // Space (grid.hpp).
    TileGrid grid;
    std::vector<std::uint64_t> splitters; ///< per tile but the last: the first cell beyond it
    double largest = 0;                   ///< coordinate of any triangle

    // Faces (pairs.cpp).
    std::vector<Face> faces; ///< distinct ones whose boxes overlap the tile, by number
    std::vector<std::array<std::uint32_t, 2>>
        duplicates; ///< of own faces: {repeated, first}, by first

    std::vector<std::array<std::uint32_t, 2>> repeated; ///< of parents: {repeated, first}, sorted

    // Division (divide.cpp).
    std::vector<std::uint32_t> touched;      ///< own faces that meet others improperly, ascending
    std::vector<std::uint32_t> overlapped;   ///< those that have an area in common with another
    std::vector<Part> parts;                 ///< of touched faces
    IndexLists<std::uint32_t> own_faces_of;  ///< per part: own faces that contain it, ascending
    std::vector<OwnPoint> points;            ///< constructed, of these parts
    std::vector<Construction> constructions; ///< per point, until numbered
    std::vector<Face> geometry;              ///< faces that the constructions name

    // Numbers (numbering.cpp).
    std::vector<double> point_splitters; ///< x beyond which points are ordered by the next tile
    std::vector<UsedVertex> used;        ///< input vertices of own triangles, by id
    std::vector<std::array<std::uint32_t, 3>> requests;  ///< {tile, its point, place here}
    std::vector<std::array<std::uint32_t, 2>> used_here; ///< {home vertex, tile that uses it}
    std::uint32_t ordered = 0;           ///< distinct constructed points ordered here
    std::uint32_t used_total = 0;        ///< input vertices in use, in all tiles
    std::uint32_t constructed_total = 0; ///< distinct constructed points in all tiles

    // The result (settling.cpp, regions.cpp).
    std::vector<Triangle> triangles;      ///< corners by name; by first parent, then as parts
    std::vector<std::uint32_t> face_of;   ///< per triangle: its first parent
    std::vector<std::uint32_t> ids;       ///< per triangle: its number through all tiles
    IndexLists<std::uint32_t> parents_of; ///< as of Arrangement
    IndexLists<std::uint32_t> surfaces_of;
    std::vector<std::uint32_t> region_of;    ///< per value of surfaces_of
    std::vector<ParentHash> parent_hashes;   ///< by id, of all parents, if a digest is wanted
    std::vector<std::uint32_t> component_of; ///< per value of surfaces_of: the first one here that
                                             ///< is in the same region
    std::vector<Hash> records;               ///< of the digest, in the range of this tile
    std::uint64_t unclean = 0;               ///< pairs and triangles of doubles that are not proper
    std::vector<UncleanPoint> unclean_points; ///< by name
    std::uint64_t result_triangles = 0;       ///< of all tiles
    double deviation = 0;                     ///< largest move of a point, in all tiles
    std::uint64_t edges = 0;                  ///< intersection edges that this tile counts
    std::uint64_t regions = 0;                ///< number of regions of the whole

    // Repair of the doubles (repairing.cpp).
    std::vector<std::uint32_t> removed; ///< points that no triangle has any more, by name, of all
                                        ///< tiles
    std::uint32_t added = 0;            ///< points that are new, in all tiles

    // Volumes (algorithms/tiles/volumes_in_tiles.cpp).
    std::vector<std::uint32_t> shell_of; ///< per side: the first one here of its shell; then the
        ///< number of the shell, then that of a shell of its volume
    std::vector<std::array<Point3, 3>> line_triangles;          ///< through which the lines pass
    std::vector<Point3> least_vertices;                         ///< per shell, in the first tile
    std::vector<std::uint32_t> volume_of_shell;                 ///< the lowest shell of the volume
    std::vector<std::array<std::uint32_t, 2>> volumes_of_sides; ///< as Volumes::of_sides
    std::vector<double> measures;                               ///< per volume of the whole

    [[nodiscard]] std::uint32_t vertex_total() const { return first_vertex.back(); }
    [[nodiscard]] std::uint32_t triangle_total() const { return first_triangle.back(); }

    /// Calls use(array) for each array of the state.
    template <class Use>
    void for_each_array(const Use& use) {
        use(entries), use(names), use(first_vertex), use(first_triangle);
        use(read_vertices), use(read_triangles), use(read_files);
        use(home_points), use(home_first), use(home_triangles), use(home_faces);
        use(home_degenerate), use(degenerate_records), use(home_owner), use(home_count);
        use(home_given), use(home_given_first), use(home_flat), use(home_repeated);
        use(given_repeated), use(given_splitters), use(point_errors);
        use(splitters), use(faces), use(duplicates), use(touched), use(overlapped), use(parts);
        use(own_faces_of.offsets), use(own_faces_of.values), use(points), use(constructions);
        use(geometry), use(point_splitters), use(used), use(requests), use(used_here);
        use(triangles), use(face_of), use(ids), use(parents_of.offsets), use(parents_of.values);
        use(surfaces_of.offsets), use(surfaces_of.values), use(region_of), use(records);
        use(parent_hashes), use(component_of), use(repeated), use(unclean_points), use(removed);
        use(shell_of), use(line_triangles), use(least_vertices), use(volume_of_shell);
        use(volumes_of_sides), use(measures);
    }
    /// Returns the bytes of all arrays.
    [[nodiscard]] std::size_t size() {
        std::size_t sum = 0;
        for_each_array([&](const auto& array) { sum += array.size() * sizeof(array[0]); });
        return sum;
    }
};

/// Returns the tile that decides a shared edge, by a hash of its ends.
inline std::size_t keeper_of_edge(const Tile& b, const std::array<std::uint32_t, 2>& ends) {
    return ((ends[0] * 0x9e3779b97f4a7c15U ^ ends[1]) * 0x9e3779b97f4a7c15U >> 32) % b.count;
}

} // namespace terrane::tiles
