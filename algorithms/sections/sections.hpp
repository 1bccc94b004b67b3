// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Sections of a model, logs of wells, and blocks in the cells of a grid. Sections are the parts of blocks and surfaces
// that lie in a plane, in a fence of vertical panels, in horizontal planes, or in any surface that lines along one of
// the axes meet once only.
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
#include <cstddef>
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
#include <terrane/kernel/point.hpp>

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
/// points of doubles; it is the one asked for if they are exact, as for a plane across an axis, and otherwise next to
/// it.
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

/// Returns a section along a surface, such as a topography or a fault. `along` and `up` are two of its coordinates: x
/// and y, y and z, or x and z: those in which most of it is seen, of those in which it does not fold over.
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
/// alone. Vertices that lie straight between two others, and where nothing else begins, are left out of rings and
/// lines.
/// Errors: bad_option for a section surface that crosses or touches itself; improper_contact if the mesh is not
/// conforming, or the volumes are not its; those of arrange() and find_volumes().
Result<Section> cut_section(const Mesh& mesh, const Volumes& volumes, const SectionSurface& along,
                            const Run& run = {});

// Logs of wells. A path is a polyline between points of doubles, and is compared with the triangles of the mesh:
// (4) which triangles a path meets, in which order, and in which block it runs between them are decided exactly, also
//     where it passes through vertices and along edges, or runs in a surface;
// (5) intervals cover the path without gaps; each begins at the depth and the point at which the one before ends;
// (6) points and depths are the doubles nearest to the exact ones. Depths are linear between the points of a path.
// No arrangement is needed. Cost: n log n for n triangles; per segment log n and the triangles in its box.

/// The path of a well, from its head on.
struct WellPath {
    std::string name;
    std::vector<Point3>
        points; ///< >= 2, of a polyline, unit of the model; repeated ones count once
    /// Per point: its measured depth, ascending. No list: the length of the path, from 0 on.
    std::vector<double> depths{};
};

/// A station of a deviation survey.
struct WellStation {
    double depth = 0;       ///< measured along the well, unit of the model
    double inclination = 0; ///< in degrees: 0 is down, 90 is level
    double azimuth = 0;     ///< in degrees, clockwise from y
};

/// Returns the path through the stations of a survey by the method of minimum curvature: between two stations the well
/// is the arc that has their directions. The path is the polyline through the stations. The head is at depth 0; above
/// a first station that is deeper the well begins vertically. Errors: bad_option without stations, for numbers that
/// are not finite, depths that do not ascend or are below 0, inclinations outside of 0 to 180, and stations that
/// point against each other.
Result<WellPath> surveyed_path(std::string name, const Point3& head,
                               std::span<const WellStation> stations);

/// A part of a path in one block, or upon the same surfaces.
struct WellInterval {
    double from = 0; ///< measured depth
    double to = 0;   ///< measured depth
    Point3 entry;    ///< point of the path at `from`
    Point3 exit;     ///< point of the path at `to`
    std::vector<std::uint32_t>
        blocks; ///< sorted: the block, 0 outside; upon surfaces all those around it
    std::vector<std::uint32_t> surfaces; ///< sorted: surfaces in which it runs; mostly none
};

/// A point in which a path meets a surface, or from which on it runs in one.
struct WellMarker {
    double depth = 0; ///< measured
    Point3 point;
    SurfaceId surface{};
    std::uint32_t before = 0; ///< number of the interval above; at the head, the first one
    std::uint32_t after =
        0; ///< number of the interval below: the same one if the block does not change
};

/// What a well meets on its way.
struct WellLog {
    std::string name; ///< of the path
    std::vector<WellInterval>
        intervals;                   ///< >= 1, by depth; neighbours differ in blocks or surfaces
    std::vector<WellMarker> markers; ///< by depth, then by surface
};

/// Logs wells: where each path enters and leaves blocks, and where it meets surfaces. The mesh is conforming, and has
/// these volumes; without any, all is outside. Wells are logged on several threads.
/// Errors: bad_option for a path with fewer than two different points or with numbers that are not finite, and for
/// depths that do not fit to the points; improper_contact if the volumes are not those of the mesh; interrupted.
Result<std::vector<WellLog>> log_wells(const Mesh& mesh, const Volumes& volumes,
                                       std::span<const WellPath> paths, const Run& run = {});

// The blocks in the cells of a rectilinear grid.
//
// (1) The block of a centre is decided exactly, as locate_points() decides it.
// (2) A block has a share in a cell if and only if it has volume there. That is decided exactly.
// (3) Each fraction is the double nearest to the exact volume of the block within the cell, divided by that of the
//     cell. So the fractions of a cell add up to 1, and those of a block to its volume, but for that rounding.
// (4) It is checked that the fractions of each block add up to its volume in the grid as a whole, which is computed
//     from the triangles once more, and where the grid contains the mesh, to its measure.
//
// Each triangle is cut by the planes of the grid, without an epsilon: a corner of a part is named by the edges and
// planes that meet there, and predicates tell on which side of a plane it is. Along a vertical, the length of a block
// within a cell is the height of the cell for each triangle above it that has the block below, less that for each that
// has it above, and likewise the height of a triangle within the cell. Integrated over the cell in the map, these are
// the areas and moments of parts of triangles. They are summed with about 106 bits and an error bound, from the nearest
// cell above that no triangle divides; where this does not decide the rounding, rationals do.
// Cost: that of sorting the parts of triangles in cells, and of locating a point in each divided cell.

/// A rectilinear grid of cells, by the planes between them. Cell (i, j, k) is at (k ny + j) nx + i.
struct RectilinearGrid {
    std::vector<double> x; ///< ascending, each once, >= 2; unit of the mesh
    std::vector<double> y; ///< likewise
    std::vector<double> z; ///< likewise

    /// Returns the number of cells along x, y and z. Precondition: each axis has a plane.
    [[nodiscard]] std::array<std::size_t, 3> counts() const {
        return {x.size() - 1, y.size() - 1, z.size() - 1};
    }
    /// Returns the number of all cells.
    [[nodiscard]] std::size_t size() const {
        const auto [nx, ny, nz] = counts();
        return nx * ny * nz;
    }
    /// Returns the middle of a cell, each coordinate rounded once.
    [[nodiscard]] Point3 centre(std::size_t cell) const;
};

/// Returns the cells whose planes are at multiples of these steps along x, y and z, as few as contain the mesh.
/// Errors: bad_option for a step that is not positive or too small for the coordinates, and for more than 10^9 cells;
/// nothing_to_do for a mesh without triangles.
Result<RectilinearGrid> cells_with_steps(const Mesh& mesh, const std::array<double, 3>& steps);

/// Returns these numbers of cells along x, y and z, of one size but for rounding, that fill the least box around the
/// mesh.
/// Errors: bad_option for a number of 0, cells thinner than doubles can tell, and more than 10^9 cells; nothing_to_do
/// for a mesh without triangles.
Result<RectilinearGrid> cells_by_count(const Mesh& mesh,
                                       const std::array<std::uint32_t, 3>& counts);

/// The part of a cell that a block fills.
struct BlockShare {
    BlockId block{};     ///< 0: the outside
    double fraction = 0; ///< of the cell, > 0
};

/// The blocks in the cells of a grid.
struct BlocksInCells {
    std::vector<BlockId> block_of; ///< per cell: the block that contains its centre; 0: the outside
    std::vector<std::size_t>
        first; ///< per cell its first share, and one more: the number of shares
    std::vector<BlockShare> shares; ///< of one cell after the other, by block
    std::vector<double> fractions;  ///< per block: the part of the whole grid that it fills

    /// Returns the part of a cell that a block fills.
    [[nodiscard]] double fraction(std::size_t cell, BlockId block) const;
};

/// Finds the blocks in the cells of a grid. The mesh is conforming, and has these volumes.
/// Errors: bad_option for a grid without cells, planes that are not ascending or finite, and more than 10^9 cells;
/// interrupted; out_of_memory; internal if the mesh is not conforming, or the volumes are not its.
Result<BlocksInCells> blocks_in_cells(const Mesh& mesh, const Volumes& volumes,
                                      const RectilinearGrid& grid, const Run& run = {});

} // namespace terrane
