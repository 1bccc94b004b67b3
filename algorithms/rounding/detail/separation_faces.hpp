// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Divided faces and their parts as the proof of clearance.hpp looks at them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/rounding/detail/separation.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::rounding::detail {

constexpr std::uint32_t none = UINT32_MAX;
constexpr double unit = std::numeric_limits<double>::epsilon(); ///< of one operation, in any mode
// Lengths between these have squares, and areas of triangles whose squares, are normal doubles; an
// area, and an altitude, is not below the square of the shortest. Range of a type, no tolerance.
constexpr double longest_length = 0x1p+249, shortest_length = 0x1p-249;
constexpr double smallest_area = shortest_length * shortest_length;

/// u(p) = normal . (p - origin).
struct Functional {
    Point3 origin, normal;

    [[nodiscard]] double operator()(const Point3& p) const { return dot(normal, minus(p, origin)); }
};

/// What the proof needs to know of a face and its parts.
struct Face {
    std::array<Point3, 3> corners;
    Point3 normal;                            ///< of length 1
    double functional_error = 0;              ///< of height and beyond, per distance from the face
    double extent = 0;                        ///< longest edge of the face
    std::uint32_t part = 0, part_end = 0;     ///< range in Faces::parts
    std::uint32_t vertex = 0, vertex_end = 0; ///< range in Faces::vertices
    std::array<std::uint32_t, 3> corner_at{none, none, none}; ///< corners, as indices into
                                                              ///< Faces::vertices

    [[nodiscard]] Functional height() const { return {corners[0], normal}; }
    /// The distance beyond edge j.
    [[nodiscard]] Functional beyond(unsigned j) const;
};

/// Of the parts of a face at one vertex.
struct Sizes {
    double altitude = std::numeric_limits<double>::infinity(); ///< a: the least
    double longest = 0;                                        ///< l: the longest edge

    void add(const Sizes& other);
};

/// The faces in pairs and their parts. Cost: linear in all parts of the mesh and of the faces.
struct Faces {
    Faces(const MovedParts& moved, std::span<const CandidatePair> pairs, double move,
          const Run& run);

    /// Whether a vertex is one of a face, too.
    [[nodiscard]] bool has(std::uint32_t face, std::uint32_t vertex) const {
        return find(face, vertices[vertex]) != none;
    }
    /// The vertex of a face at a point, or none.
    [[nodiscard]] std::uint32_t find(std::uint32_t face, std::uint32_t point) const;

    std::vector<std::uint32_t> slot_of; ///< per face of the mesh: index into faces, or none
    std::vector<std::uint32_t> names;   ///< the reverse
    std::vector<Face> faces;
    std::vector<std::uint32_t> parts; ///< by face
    std::vector<Triangle> corners;    ///< per entry of parts: indices into vertices
    // Per vertex of a face, by face, each once:
    std::vector<std::uint32_t> vertices; ///< its point
    std::vector<Point3> places;          ///< where that is
    std::vector<Sizes> sizes;
    std::vector<std::uint32_t> face_at; ///< index into faces
    std::vector<std::uint32_t> before; ///< the vertex of the face before at the same point, or none

    std::vector<std::uint32_t> last_at; ///< per point: the last vertex at it, or none

private:
    void measure_faces(const MovedParts& moved, std::span<const CandidatePair> pairs,
                       const Run& run);
    void collect_parts(const MovedParts& moved, const Run& run);
    void number_vertices(const MovedParts& moved);
    void name_corners(const MovedParts& moved, std::uint32_t face);
    void measure_parts(const Face& face, double move);
};

} // namespace terrane::rounding::detail
