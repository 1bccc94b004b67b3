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

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// A wanted edge length at a point. It grows with the distance from there, by `growth`.
struct LocalSize {
    Point3 place{};    ///< unit of the mesh
    double length = 0; ///< > 0, unit of the mesh
};

/// Options of improve(). Lengths are in the unit of the mesh, angles in degrees, and
/// max_volume_change in percent. describe() says what each member does.
struct ImproveOptions {
    /// \name Members that describe() describes
    /// @{
    double edge_length = 0;               ///< see describe(), as all members of this group
    std::vector<double> edge_length_of{}; ///< per surface; 0: edge_length; empty: no exceptions
    double max_deviation = 0;
    double curve_length = 0;
    double turn = 0;
    double layers_in_gaps = 0;
    double smallest = 0;
    double growth = 0.3;
    double crease_angle = 50;
    double curve_angle = 45;
    unsigned passes = 6;
    double thickness_share = 0.1;
    double least_quality = 1;
    double max_volume_change = 5;
    double max_triangles = 2e7;
    /// @}
    std::vector<std::vector<LocalSize>>
        refinements{};        ///< lengths wanted near points. Each list in turn makes triangles of
                              ///< the finished mesh smaller near its points, and leaves the others.
                              ///< Each point costs a distance per vertex and pass
    PairCheckOptions check{}; ///< how the improved mesh is checked

    /// Describes the options, see Field. The bound of layers_in_gaps is there since the search for
    /// gaps compares a triangle with the sheets within this many wanted lengths of it: with more
    /// than a thousand, these are all sheets of a model.
    static void describe(const auto& visit, auto& o) {
        constexpr double unlimited = std::numeric_limits<double>::infinity();
        constexpr FieldBounds angle{0, 180}, share{0, 1};
        visit(Field("edge_length", "L", "Wanted length of edges",
                    "each surface keeps about as many triangles as it has", {}, true),
              o.edge_length);
        visit(Field("edge_length_of", "NAME=L", "Wanted length of edges on one surface",
                    "`edge_length`", {}, true),
              o.edge_length_of);
        visit(Field("max_deviation", "D",
                    "No point of a surface moves farther from the original surface than this",
                    "a twentieth of the wanted length", {}, true),
              o.max_deviation);
        visit(Field("curve_length", "L",
                    "Wanted length of edges along curves, where that is shorter", "as elsewhere"),
              o.curve_length);
        visit(
            Field("turn", "DEGREES",
                  "Asks for shorter edges where a surface is curved, so that normals turn by about "
                  "this angle along an edge; not shorter than an eighth of the wanted length",
                  "the same length everywhere", angle),
            o.turn);
        visit(Field("layers_in_gaps", "N",
                    "Where surfaces are close, edges are at most as long as their distance divided "
                    "by this",
                    "distances do not count", {0, 1000}, true),
              o.layers_in_gaps);
        visit(Field("smallest", "L", "`layers_in_gaps` asks for no shorter edges than this",
                    "an eighth of the least wanted length", {}, true),
              o.smallest);
        visit(Field("growth", "G",
                    "Wanted lengths differ by at most this share of the way between them"),
              o.growth);
        visit(Field("crease_angle", "DEGREES",
                    "Edges at which a surface turns by more than this angle are kept", {}, angle),
              o.crease_angle);
        visit(Field("curve_angle", "DEGREES",
                    "Vertices at which a curve turns by more than this angle are kept", {}, angle),
              o.curve_angle);
        visit(Field("passes", "N", "Limits the passes of the four operations", {}, {1, 100, true}),
              o.passes);
        visit(
            Field("thickness_share", "SHARE",
                  "Where blocks are thin, points deviate by at most this share of the distance to "
                  "the next sheet, along the normal"),
            o.thickness_share);
        visit(Field("least_quality", "Q",
                    "No triangle gets worse than the worst before, or than this q if that is less",
                    {}, share),
              o.least_quality);
        visit(
            Field("max_volume_change", "P",
                  "Improves again, with smaller deviations, around blocks whose volumes change by "
                  "more than this percentage, and warns where that does not help",
                  {}, {0, unlimited, true}),
            o.max_volume_change);
        visit(Field("max_triangles", "N",
                    "Refuses to begin where more triangles are to be expected", {}, {0, unlimited}),
              o.max_triangles);
    }
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

/// Checks by the surfaces alone, before they are arranged, what improve() refuses: a max_deviation below the
/// rounding errors of their coordinates, and more than max_triangles. Their number is estimated from
/// areas and wanted lengths, without curvature and what intersections add. Errors: bad_option, with the
/// option as its place.
Status check_improvable(std::span<const Surface> surfaces, const ImproveOptions& options);

/// Improves the mesh. Errors: bad_option; bad_number, bad_index; improper_contact if the mesh is
/// not conforming; nothing_to_do if it has no triangles; interrupted, out_of_memory.
Result<Improved> improve(const Mesh& mesh, const ImproveOptions& options = {}, const Run& run = {});

/// Improves a mesh that is proven conforming already, without another proof.
Result<Improved> improve(const ConformingMesh& mesh, const ImproveOptions& options = {},
                         const Run& run = {});

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> improve_constants();

/// An improved mesh and how far it is from the mesh before, measured by code that shares nothing
/// with the improvement.
struct ImprovedAndMeasured {
    Improved improved;                 ///< the improved mesh, with its report
    std::vector<Deviation> deviations; ///< per surface, measured
    std::vector<double> bounds_back;   ///< per surface: bound of the distance from old to new

    /// Tells whether the mesh before is proven to be within the bounds of the improved one as well.
    [[nodiscard]] bool is_near_back() const;
};

/// Improves a mesh and measures its deviation. Errors: those of improve; interrupted; internal
/// where the measured deviation exceeds the bound.
Result<ImprovedAndMeasured> improve_and_measure(const ConformingMesh& mesh,
                                                const ImproveOptions& options, const Run& run = {});

/// Returns the improved mesh with its vertices at other places, proven conforming again, and measures
/// it again; its report keeps the bounds. None if it is not conforming, or if other volumes are at
/// its triangles. `points`: one per vertex; `check`: how it is proven. Errors: bad_number; interrupted, out_of_memory.
Result<std::optional<ImprovedAndMeasured>> with_vertices_at(const ConformingMesh& before,
                                                            const ImprovedAndMeasured& improved,
                                                            std::vector<Point3> points,
                                                            const PairCheckOptions& check = {},
                                                            const Run& run = {});

} // namespace terrane
