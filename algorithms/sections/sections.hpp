// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Sections of a model: the parts of its blocks and surfaces that lie in a plane, in a fence of vertical panels, in
// horizontal planes, or in any surface that lines along one of the axes meet once only.
//
// The section surface is one more surface in an exact arrangement of the model's triangles. So
// (1) the block of each part of the section, and where it ends, are decided without an epsilon, also where the
//     section passes through vertices and edges or lies upon triangles;
// (2) polygons cover the section within blocks and upon their boundaries, and do not overlap;
// (3) polygons and lines share vertices: the doubles nearest to the exact points. They have the topology of the
//     exact ones; a part that is thinner than doubles can tell may fold over.
// Cost: that of arrange() and find_volumes() of the model's triangles and the section.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// A part of a section surface, and coordinates in it: a point p is at start + right (p - origin) along the section,
/// and at up (p - origin) across it; unit of the model.
struct SectionSheet {
    Point3 origin;
    Point3 right;     ///< of length 1
    Point3 up;        ///< of length 1
    double start = 0; ///< at the origin
};

/// A surface along which a model is cut. It is seen from its front, where right x up points.
struct SectionSurface {
    Surface surface;
    std::vector<std::uint32_t> sheet_of; ///< per triangle
    std::vector<SectionSheet> sheets;    ///< from left to right
};

/// Returns the plane through a point across a normal, as far as the mesh is wide, seen from where the normal points.
/// Of a vertical plane `up` is the height, and the point is at 0 along the section. The plane is spanned by three
/// points of doubles; it is the one asked for if they are exact, as for a plane across an axis, and otherwise next to it.
/// Errors: bad_option for a normal or a point that is not finite, and for a normal of length 0; nothing_to_do for a
/// mesh without triangles.
Result<SectionSurface> section_plane(const Mesh& mesh, const Point3& point, const Point3& normal);

/// Returns horizontal planes at these heights, seen from above; `along` and `up` are x and y.
/// Errors: bad_option for a height that is not finite, and without heights; nothing_to_do as above.
Result<SectionSurface> section_levels(const Mesh& mesh, std::span<const double> heights);

/// Returns the vertical panels through the corners of a line in the map, seen from the right of its way; `up` is the
/// height. Errors: bad_option for fewer than two corners, and for a line that crosses or touches itself;
/// nothing_to_do as above.
Result<SectionSurface> section_fence(const Mesh& mesh,
                                     std::span<const std::array<double, 2>> corners);

/// Returns a section along a surface, such as a topography or a fault. `along` and `up` are two of its coordinates: x and
/// y, y and z, or x and z: those in which most of it is seen, of those in which it does not fold over.
/// Errors: bad_option if it folds over in all three; those of arrange().
Result<SectionSurface> section_along(const Surface& surface, const Run& run = {});

/// A part of a block in the section, connected through more than points.
struct SectionPolygon {
    BlockId block{}; ///< in front of the section
    BlockId
        behind{}; ///< behind it: another one only where the section lies upon surfaces. Not both are 0
    /// Its borders, by their vertices: the outer one first, counterclockwise as seen from the front, then holes,
    /// clockwise. A ring meets no vertex twice.
    std::vector<std::vector<std::uint32_t>> rings;
    double area = 0; ///< squared unit, in floating point
};

/// A line of a surface in the section. It ends where the surface ends or branches. Where the surface lies in the
/// section, lines are the border of that part.
struct SectionLine {
    SurfaceId surface{};
    std::vector<std::uint32_t> vertices; ///< >= 2; first = last: closed
};

/// A section of a model.
struct Section {
    std::vector<Point3> vertices;            ///< of polygons, lines and triangles
    std::vector<std::array<double, 2>> flat; ///< per vertex: {along, up}
    std::vector<SectionPolygon> polygons;    ///< by block
    std::vector<SectionLine> lines;          ///< by surface
    std::vector<Triangle> triangles;         ///< that the polygons consist of
    std::vector<std::uint32_t> polygon_of;   ///< per triangle
};

/// Cuts a model along a section surface. The mesh is conforming, and has these volumes; without any, there are lines
/// alone. Vertices that lie straight between two others, and where nothing else begins, are left out of rings and lines.
/// Errors: bad_option for a section surface that crosses or touches itself; improper_contact if the mesh is not
/// conforming, or the volumes are not its; those of arrange() and find_volumes().
Result<Section> cut_section(const Mesh& mesh, const Volumes& volumes, const SectionSurface& along,
                            const Run& run = {});

} // namespace terrane
