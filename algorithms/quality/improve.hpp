// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Better triangles for a conforming mesh of any number of surfaces, which stay conforming along
// their common curves: nodes are smoothed by trapezium drawing, edges swapped where that lessens
// the largest angle, short ones collapsed, long ones split.
//
// Guarantees:
// (1) The result is a conforming mesh: each change was allowed only where exact predicates on the
//     doubles show that no two triangles meet improperly by it, and all is tested again at the end.
// (2) Corners stay where they are. Curves (where other than two triangles meet, or two of different
//     surfaces or regions, and creases) keep their vertices on the curves as they were. Sheets and
//     curves are only ever re-divided, so surfaces and regions keep their identity. A change that
//     sweeps over a vertex of another sheet is not made. The volumes on both sides of each sheet
//     are compared at the end all the same: report.sides_kept says so. (Where triangles of next to
//     no height hang on a curve, their order round it may change with the curve.)
// (3) Each point of the result is within max_deviation of its part of the surface as it was, shown
//     with rounding errors counted in; each edge of a curve within a third of that.
// (4) It ends: moves and swaps lower a sum of shapes or the largest angle, splits and collapses are
//     done in a bounded number of passes.
// (5) The result depends on neither threads nor time.
// Cost: some microseconds per triangle and pass, then one exact test of the whole.
// Source: the paper, section 4; the alternation of the four as in Botsch and Kobbelt (2004).
// Trapezium drawing is named after Semenova, Savchenko and Hagiwara (2004), whose formula was not
// at hand: here a node slides parallel to the opposite edge until above its middle, by twice the
// mean of all triangles at it (each sees the way along its own edge only), and then back onto the
// surface.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/quality/quality.hpp>

namespace terrane {

/// Lengths: unit of the mesh. Angles: degrees.
struct ImproveOptions {
    double edge_length = 0; ///< wanted; 0: each surface's that of equilateral triangles, as many
                            ///< as it has
    std::vector<double> edge_length_of{}; ///< per surface, 0: as above; or no list at all
    double max_deviation = 0;             ///< 0: a twentieth of the wanted length, of each surface
    double curve_length = 0; ///< wanted along curves, where that is less; 0: as elsewhere
    double turn = 0; ///< normals turn by this along an edge where the surface is curved: shorter
                     ///< edges there, down to an eighth; 0: the same length everywhere
    double growth = 0.3;      ///< wanted lengths differ by at most this share of the way between
    double crease_angle = 50; ///< edges at which a surface turns by more are curves
    double curve_angle = 45;  ///< vertices at which a curve turns by more are corners
    unsigned passes = 6;      ///< of the four operations, 1 to 100
};

/// What keeps the worst triangle from being better; the first that holds.
enum class WorstCause : std::uint8_t {
    none,         ///< there is no triangle
    corner_angle, ///< curves meet in its smallest angle
    short_curve,  ///< a curve between two corners is as short as its shortest edge
    close_curves, ///< all its corners are on curves
    deviation,    ///< better ones are not shown to be within max_deviation
    contact,      ///< better ones would meet other triangles
    shape,        ///< no operation makes it better
};

/// "fixed corner angle", "short curve", ...
std::string_view name_of(WorstCause cause);

struct ImproveReport {
    QualityReport before, after;
    std::vector<double> bound_of; ///< per surface: no point of it is farther from what it was
    std::size_t corners = 0, curves = 0, sheets = 0;
    std::size_t splits = 0, collapses = 0, swaps = 0, moves = 0;
    std::size_t refused_contact = 0, refused_deviation = 0, refused_shape = 0; ///< changes
    unsigned passes = 0;
    bool sides_kept = false; ///< each sheet has the same volumes on its sides as before: exactly
    WorstCause worst_cause = WorstCause::none; ///< of after.worst
};

struct Improved {
    /// Vertices and triangles in a new order; surfaces, regions and intersection edges as before.
    /// No parents_of: a triangle is in no input triangle any more. Triangles of a sheet are wound
    /// as its first one was.
    Mesh mesh;
    std::vector<std::uint32_t> near_of; ///< per triangle: one of the mesh before, near its middle,
                                        ///< in the same sheet
    ImproveReport report;
};

/// Errors: bad_option; bad_number, bad_index; improper_contact where the mesh is not conforming;
/// nothing_to_do without triangles; interrupted, out_of_memory.
Result<Improved> improve(const Mesh& mesh, const ImproveOptions& options = {}, const Run& run = {});

} // namespace terrane
