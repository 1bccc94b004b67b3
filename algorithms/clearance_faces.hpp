// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Divided faces and their parts as the proof of clearance.hpp looks at them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <terrane/algorithms/clearance.hpp>
#include <terrane/algorithms/run.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/algorithms/vectors.hpp>

namespace terrane::clearance {

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

/// Coordinates of points in or close to a face, from its first corner: two of those in space, and
/// how far off its plane along the third, in which it is steepest. A box of them is tight however
/// the face is turned.
struct Frame {
    Point3 origin;
    unsigned axis = 2;               ///< the third
    double slope_u = 0, slope_v = 0; ///< of the plane along the others; any numbers are right

    [[nodiscard]] Point3 operator()(const Point3& p) const {
        Point3 q = turned(minus(p, origin));
        q.z -= slope_u * q.x + slope_v * q.y;
        return q;
    }
    [[nodiscard]] Point3 turned(const Point3& p) const {
        return axis == 2 ? p : axis == 0 ? Point3{p.y, p.z, p.x} : Point3{p.z, p.x, p.y};
    }
};

/// A functional of points that are given in a frame.
struct FramedFunctional {
    Point3 factor;
    double at_origin = 0;

    FramedFunctional() = default;
    FramedFunctional(const Functional& u, const Frame& frame) :
        factor(frame.turned(u.normal)), at_origin(u(frame.origin)) {
        factor.x += frame.slope_u * factor.z;
        factor.y += frame.slope_v * factor.z;
    }
    [[nodiscard]] double operator()(const Point3& framed) const {
        return dot(factor, framed) + at_origin;
    }
};

/// What the lemma needs to know of a face and its parts.
struct Face {
    std::array<Point3, 3> corners;
    Frame frame;
    Functional height;                ///< above its plane
    std::array<Functional, 3> beyond; ///< each edge
    double functional_error = 0; ///< of this and those of the edges, per distance from the face
    double extent = 0;           ///< longest edge of the face
    std::uint32_t part = 0, part_end = 0;     ///< range in Faces::parts
    std::uint32_t cell = 0, cell_end = 0;     ///< range in Faces::cells
    std::uint32_t vertex = 0, vertex_end = 0; ///< range in Faces::vertices
};

/// Faces without the ranges.
struct Measured {
    Measured(const MovedParts& moved, std::span<const CandidatePair> pairs, const Run& run);

    [[nodiscard]] const Face& operator[](std::uint32_t f) const { return faces[slot_of[f]]; }

    std::vector<std::uint32_t> slot_of; ///< per face of the mesh: index into faces, or none
    std::vector<std::uint32_t> names;   ///< of the faces in pairs, each once
    std::vector<Face> faces;            ///< per name
};

/// Of the parts of a face at one vertex.
struct Sizes {
    double altitude = std::numeric_limits<double>::infinity(); ///< a: the least
    double longest = 0;                                        ///< l: the longest edge
};

/// Parts of a face that lie close together, in a box.
struct Cell {
    std::uint32_t part = 0, part_end = 0;     ///< range in Faces::parts
    std::uint32_t corner = 0, corner_end = 0; ///< range in Faces::places
    Point3 centre, half;                      ///< of the box, in the frame of the face; nothing
                                              ///< where the face has no other cell
};

/// The faces in pairs and their parts. Cost: linear in all parts of the mesh and of the faces.
struct Faces {
    Faces(const MovedParts& moved, Measured measured, std::span<const CandidatePair> pairs,
          double move, const Run& run);

    std::vector<std::uint32_t> slot_of; ///< per face of the mesh: index into faces, or none
    std::vector<Face> faces;
    std::vector<Cell> cells;                  ///< by face
    std::vector<std::uint32_t> parts;         ///< by face, then by cell
    std::vector<std::array<std::uint16_t, 3>> ///< per entry of parts: corners, counted in those
        corners;                              ///< of the cell
    std::vector<Point3> places;               ///< of the corners of a cell, each once, by cell
    std::vector<std::uint32_t> vertex_at;     ///< per place: index into vertices
    std::vector<std::uint32_t> vertices;      ///< by face, each once: points
    std::vector<Sizes> sizes;                 ///< of vertices

private:
    template <class Visit>
    void for_faces(const Run& run, const Visit& visit);
    void choose(Measured measured, std::span<const CandidatePair> pairs);
    void collect_parts(const MovedParts& moved, const Run& run);
    void sort_into_cells(const MovedParts& moved, const Run& run);
    void number_vertices(const MovedParts& moved);
    void measure_parts(const Cell& cell, double move);
    void enclose(Cell& cell, const Frame& frame) const;
};

} // namespace terrane::clearance
