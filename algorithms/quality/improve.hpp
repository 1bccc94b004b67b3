// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Improves the triangles of a conforming mesh of any number of surfaces. The surfaces stay
// conforming along their common curves. Long edges are split, short ones collapsed, edges are
// swapped where that reduces the largest angle, and vertices are smoothed by trapezium drawing.
//
// Guarantees:
// (1) The result is a conforming mesh. A change is made only if exact predicates on the doubles
//     show that it creates no improper contact, and the whole result is checked again at the end.
// (2) Corners do not move. Vertices of curves (edges with other than two triangles, edges between
//     different surfaces or regions, and creases) stay on the original curves. Sheets and curves
//     are only subdivided anew, so surfaces and regions keep their identity. A change that sweeps
//     over a vertex of another sheet is rejected. The volumes on the two sides of each sheet are
//     compared at the end as well; report.sides_kept holds the answer. (Where slivers are attached
//     to a curve, their order around it may change with the curve.)
// (3) Each point of the result is within max_deviation of its part of the original surface, proven
//     with rounding errors included; each edge of a curve is within a third of that distance of the
//     original curve.
// (4) The algorithm terminates: moves and swaps reduce a sum of shapes or the largest angle, and
//     the number of split and collapse passes is bounded.
// (5) The result depends neither on the number of threads nor on time, nor on the order of
//     vertices, triangles and surfaces: it numbers the mesh by place first.
// (6) No triangle of the result has a smaller q than the worst one of the input, or than
//     least_quality if that is less, up to rounding (a relative 1e-12). Where the wanted lengths
//     would leave such triangles, the mesh is improved again, so that triangles near them, or all,
//     never fall below that q.
// (7) Over a triangle of the input at a thin block, the tolerance of (3) is at most the share
//     thickness_share of the distance to the next sheet of about the same direction. Around a block
//     whose volume changes by more than max_volume_change, the tolerance becomes smaller, in up to
//     three more attempts. Cost: some microseconds per triangle and pass, then one exact check of
//     the whole mesh. Source: the paper, section 4. The alternation of the four operations follows
//     Botsch and Kobbelt (2004). Trapezium drawing is named after Semenova, Savchenko and Hagiwara
//     (2004), whose formula was not available. Here, each triangle at a vertex proposes to slide it
//     parallel to the opposite edge until it is above the middle of that edge; the vertex moves by
//     twice the mean of the proposals (each of them only sees the direction of its own edge) and is
//     then projected back to the surface.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <terrane/algorithms/check/conforming.hpp>
#include <terrane/algorithms/core/named_constant.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
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
/// within layers_in_gaps wanted lengths of it; from a thousand on, these are all sheets of a model.
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

/// Returns the least max_deviation that is distinguishable from rounding errors at coordinates of
/// this size (the largest absolute value).
double least_deviation(double largest_coordinate);

/// Estimates the number of triangles that surfaces of this shape have after improve(), from their
/// areas and the wanted lengths alone: without curvature, and without what intersections add.
double expected_triangles(std::span<const Surface> surfaces, const ImproveOptions& options);

/// Improves the mesh. Errors: bad_option; bad_number, bad_index; improper_contact if the mesh is
/// not conforming; nothing_to_do if it has no triangles; interrupted, out_of_memory.
Result<Improved> improve(const Mesh& mesh, const ImproveOptions& options = {}, const Run& run = {});

/// Improves a mesh that is proven conforming already, without another proof.
Result<Improved> improve(const ConformingMesh& mesh, const ImproveOptions& options = {},
                         const Run& run = {});

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> improve_constants();

} // namespace terrane
