// SPDX-License-Identifier: LGPL-3.0-or-later
//
// An improved mesh, its report, and the options that decide it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <terrane/algorithms/check/conforming.hpp>
#include <terrane/algorithms/check/pair_check.hpp>
#include <terrane/algorithms/mesh/shared_mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// A wanted edge length at a point. It grows with the distance from there, by `growth`.
struct LocalSize {
    Point3 place{};    ///< unit of the mesh
    double length = 0; ///< > 0, unit of the mesh
};

/// Bounds ImproveOptions::layers_in_gaps. The search for gaps compares a triangle with the sheets
/// within so many wanted lengths of it. With more than a thousand, these are all sheets of a model.
inline constexpr double most_layers_in_gaps = 1000;

/// Options of improve(). Lengths are in the unit of the mesh, angles in degrees.
struct ImproveOptions {
    double edge_length = 0; ///< target edge length; 0: for each surface, that of as many
                            ///< equilateral triangles of the same area
    std::vector<double> edge_length_of{}; ///< per surface; 0: edge_length; empty: no exceptions
    double max_deviation = 0;             ///< 0: a twentieth of the target length of each surface
    double curve_length = 0; ///< target length along curves, if smaller; 0: as elsewhere
    double turn = 0; ///< normals may turn by this angle along an edge: edges become shorter where
                     ///< the surface is curved, down to an eighth; 0: no adaptation
    double layers_in_gaps = 0; ///< where surfaces are close, edges are at most as long as their
                               ///< distance divided by this; no unit, at most
                               ///< most_layers_in_gaps; 0: no adaptation
    double smallest = 0;       ///< layers_in_gaps asks for no shorter edges than this; 0: an eighth
                               ///< of the target length
    std::vector<std::vector<LocalSize>>
        refinements{};   ///< lengths wanted near points. Each list in turn makes triangles of the
                         ///< finished mesh smaller near its points, and leaves the others. Each
                         ///< point costs a distance per vertex and pass
    double growth = 0.3; ///< target lengths at two points differ by at most this multiple of
                         ///< their distance; no unit
    double crease_angle = 50; ///< edges at which a surface turns by more are curves
    double curve_angle = 45;  ///< vertices at which a curve turns by more are corners
    unsigned passes = 6;      ///< rounds of the four operations, 1 to 100
    double thickness_share =
        0.1; ///< where blocks are thin, points deviate by at most this share of
             ///< the distance to the next sheet, along the normal; > 0
    double least_quality =
        1; ///< no triangle becomes worse than the worst one of the input, or than
           ///< this q if that is less; (0, 1]
    double max_volume_change =
        5;                      ///< percent; where the volume of a block changes by more, the mesh
                                ///< is improved again, with smaller bounds around that block
    double max_triangles = 2e7; ///< refuses to begin where more are to be expected
    PairCheckOptions check{};   ///< how the improved mesh is checked
};

/// The reason why the worst triangle can't be improved; the first one that applies.
enum class WorstCause : std::uint8_t {
    none,         ///< no triangle; or vertices moved afterwards, and another one is the worst
    corner_angle, ///< its smallest angle lies between two curves
    short_curve,  ///< its shortest edge is a curve between two corners
    close_curves, ///< all its corners lie on curves
    deviation,    ///< better triangles are not proven to be within max_deviation
    contact,      ///< better triangles would meet others
    shape,        ///< collapses, swaps and moves at its corners were tried; none improves it
    rounds,       ///< the number of changes made for worst triangles is limited
};

/// Names the cause as reports print it: "fixed corner angle", "short curve", ...
std::string_view name_of(WorstCause cause);

/// Describes the improvement of a mesh.
struct ImproveReport {
    QualityReport before;            ///< of the given mesh
    QualityReport after;             ///< of the improved mesh
    std::vector<double> bound_of;    ///< per surface: upper bound of its distance from the original
    std::size_t corners = 0;         ///< vertices that stay
    std::size_t curves = 0;          ///< from corner to corner, or closed
    std::size_t sheets = 0;          ///< parts of surfaces between curves
    std::size_t splits = 0;          ///< edges divided
    std::size_t collapses = 0;       ///< edges removed
    std::size_t swaps = 0;           ///< edges exchanged for the other diagonal
    std::size_t moves = 0;           ///< vertices moved, each time counted
    std::size_t refused_contact = 0; ///< changes rejected since triangles would meet improperly
    std::size_t refused_deviation = 0; ///< changes rejected since they are not proven to be near
    std::size_t refused_shape = 0;     ///< changes rejected since they would fold, degenerate or
                                       ///< be worse than the worst triangle of the input
    double least_quality = 0;          ///< no triangle may have a smaller q, see guarantee (6)
    unsigned attempts = 1;  ///< times that the mesh was improved from the start, for guarantee (6)
                            ///< and for the volumes of blocks
    bool is_strict = false; ///< guarantee (6) needed more than one attempt
    std::size_t held_blocks = 0;    ///< blocks around which bounds were reduced for their volumes
    std::size_t thin_triangles = 0; ///< input triangles over which thickness_share limits the bound
    unsigned passes = 0;            ///< rounds of the four operations
    bool sides_kept = false; ///< exact: each sheet has the same volumes on its sides as before
    WorstCause worst_cause = WorstCause::none; ///< of the triangle after.worst
};

/// An improved mesh.
struct Improved {
    /// The improved mesh: vertices and triangles in a new order; surfaces, regions and intersection
    /// edges as before. parents_of is empty, as triangles no longer lie in input triangles. All
    /// triangles of a sheet have the orientation of its first input triangle.
    SharedMesh mesh;
    std::optional<ConformingMesh> conforming{}; ///< the same mesh with its proof; always there;
                                                ///< pairs() where options.check counts them
    Volumes volumes{};                          ///< of the mesh, found for report.sides_kept
    Volumes volumes_before{};                   ///< of the mesh before
    std::vector<std::uint32_t> volume_before; ///< per volume of the mesh: the volume before that it
                                              ///< is; empty unless report.sides_kept
    std::vector<std::uint32_t> near_of; ///< per triangle: an input triangle of the same sheet, near
                                        ///< its centroid
    ImproveReport report;               ///< quality, changes and bounds
};

} // namespace terrane
