// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures divided faces and their parts for the proof of separation.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/rounding/detail/moved_parts.hpp>
#include <terrane/algorithms/rounding/detail/separation_bounds.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::rounding::detail {

constexpr std::uint32_t none = UINT32_MAX;
/// Relative error of one operation, in any rounding mode.
constexpr double unit = std::numeric_limits<double>::epsilon();
// Squares of lengths between these bounds are normal doubles, and so are squares of the areas of
// triangles with such edges. Areas and altitudes must not be less than the square of the shortest
// length. The bounds follow from the range of double; they are no tolerances.
constexpr double longest_length = 0x1p+249, shortest_length = 0x1p-249;
constexpr double smallest_area = shortest_length * shortest_length;

/// u(p) = normal . (p - origin).
struct Functional {
    Point3 origin, normal;

    [[nodiscard]] double operator()(const Point3& p) const { return dot(normal, minus(p, origin)); }
};

/// A face with the measures and the parts that the proof needs.
struct Face {
    std::array<Point3, 3> corners;
    Point3 normal;                            ///< of length 1
    double functional_error = 0;              ///< error of height and beyond, per distance
    double extent = 0;                        ///< longest edge of the face
    std::uint32_t part = 0, part_end = 0;     ///< range in Faces::parts
    std::uint32_t vertex = 0, vertex_end = 0; ///< range in Faces::vertices
    std::array<std::uint32_t, 3> corner_at{none, none, none}; ///< corners, as indices into
                                                              ///< Faces::vertices
    std::uint32_t clusters = none;                            ///< index into Faces::clusters

    /// Returns the height above the plane.
    [[nodiscard]] Functional height() const { return {corners[0], normal}; }
    /// Returns the distance beyond edge j.
    [[nodiscard]] Functional beyond(unsigned j) const;
};

/// The sizes of the parts of a face at one vertex.
struct Sizes {
    double altitude = std::numeric_limits<double>::infinity(); ///< a: the least altitude
    double longest = 0;                                        ///< l: the longest edge

    void add(const Sizes& other);
    /// Whether a^2 >= 64 d l. Returns false if anything has underflowed.
    [[nodiscard]] bool is_well_conditioned(double d) const {
        return altitude > smallest_area && altitude * altitude >= condition_factor * d * longest;
    }
};

/// Returns the sizes of a part with these moved corners. They bound its altitudes and edges before
/// the move, too, if no corner moved farther than `move`.
Sizes sizes_of_part(const std::array<Point3, 3>& corners, double move);

/// Faces with fewer parts are neither clustered nor counted as costly.
constexpr std::uint32_t many_parts = 128;

/// A vertex of a face, as an index into Faces::vertices.
struct VertexOfFace {
    std::uint32_t face, vertex;
};

/// A ball that contains the members of a cluster.
struct Ball {
    Point3 centre;
    double radius = 0;
};

/// Clusters of neighbouring vertices, or of neighbouring parts, of one face.
struct PlaceClusters {
    IndexLists<std::uint32_t> members; ///< as indices into Faces::vertices or Faces::parts
    std::vector<Ball> balls;           ///< per cluster
};

/// The clusters of a face with many parts. A plane meets few of their balls; the members of all
/// other clusters lie on one side of it.
struct FaceClusters {
    PlaceClusters vertices, parts;
};

/// The faces in pairs and their parts. Cost: linear in all parts of the mesh and of the faces.
struct Faces {
    Faces(const MovedParts& moved, std::span<const CandidatePair> pairs, double most_move,
          const Run& run);

    /// Whether a vertex (of any face) is also a vertex of this face.
    [[nodiscard]] bool has(std::uint32_t face, std::uint32_t vertex) const {
        return find(face, vertices[vertex]) != none;
    }
    /// Returns the vertex of a face at a point, or none.
    [[nodiscard]] std::uint32_t find(std::uint32_t face, std::uint32_t point) const;
    /// Returns the d of statements (3) and (4) for parts of f and the functionals of g, with room
    /// for errors in both directions.
    [[nodiscard]] double margin(const Face& f, const Face& g) const {
        return margin_factor * (move + (f.extent + g.extent) * g.functional_error);
    }
    [[nodiscard]] std::uint32_t part_count(std::uint32_t face) const {
        return faces[face].part_end - faces[face].part;
    }
    /// Clusters these faces, each named once, but for those with few parts. Cost: linear.
    void cluster(std::span<const std::uint32_t> slots, const Run& run);

    double move;                        ///< d: the largest move
    std::vector<std::uint32_t> slot_of; ///< per face of the mesh: index into faces, or none
    std::vector<std::uint32_t> names;   ///< per entry of faces: its face of the mesh
    std::vector<Face> faces;
    std::vector<std::uint32_t> parts; ///< by face
    std::vector<Triangle> corners;    ///< per entry of parts: indices into vertices
    // The following arrays have an entry for each vertex of each face, sorted by face.
    std::vector<std::uint32_t> vertices; ///< its point
    std::vector<Point3> places;          ///< the coordinates of that point
    std::vector<Sizes> sizes;

    IndexLists<VertexOfFace> at; ///< per point: the vertices at it, ascending
    std::vector<FaceClusters> clusters;

private:
    void measure_faces(const MovedParts& moved, std::span<const CandidatePair> pairs,
                       const Run& run);
    void collect_parts(const MovedParts& moved, const Run& run);
    void number_vertices(const MovedParts& moved);
    void list_vertices(std::size_t points);
    void name_corners(const MovedParts& moved, std::uint32_t face);
    void measure_parts(const Face& face);
    [[nodiscard]] FaceClusters clusters_of(const Face& face) const;
};

} // namespace terrane::rounding::detail
