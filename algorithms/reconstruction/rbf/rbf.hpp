// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A hole filled from the data round it by radial basis functions: any surface, folds too.
//
// Steps:
//   (1) data: the vertices within `reach` times the hole's radius of its border along the surface,
//       and the first `rings` rings in any case, with normals (rbf_data.hpp);
//   (2) constraints: f = 0 at centres; at some of them, spread evenly, also f = +-d at a distance d
//       off the surface, where no other part of it is as near: along the axis of the hole where the
//       surface is a graph over its plane, so that f is a height of which the polynomial part takes
//       much, else along normals;
//   (3) centres: a well-spread start, then again and again the data that f misses most, until it
//       misses none by more than `tolerance` or there are `most_centres` (rbf_function.hpp). With
//       smoothing, and where it is the better by a quarter: the well-spread ones alone, their
//       weights from all data by penalised least squares (rbf_smooth.cpp);
//   (4) what f then still misses at the data, be they millions, is made up for by a partition of
//       unity: small patches with a function |p - q| of their own, blended, and fading away into
//       the hole (rbf_patches.hpp). So every datum is met, whatever the number of centres; not with
//       options.smoothing;
//   (5) the zero level over the hole and a margin beyond it as triangles (zero_level.hpp).
// The polynomial part (along the hole's plane, or in space for what turns away from any plane), its
// degree, the direction of (2) and the way of (3) are those that predict best the data left out
// when the hole is made wider by a quarter of its radius. What they miss of these, in units of the
// power function there, times the power function in the hole, is the expected error
// (rbf_error.hpp). Guarantees: the same bytes for any number of threads. The filling
// goes at least two edge lengths beyond the border where the surface does; it is to be joined
// (join.hpp). Cost: n^3 / 3 for n constraints, at most 2000; n per lattice point of (5). Source:
// the paper, 4.1, equation (10); Carr et al. (2001) for (2) and (3); Ohtake et al. (2003) for (4).
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/reconstruction/holes/filling.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/function.hpp>

namespace terrane {

struct RbfOptions {
    double reach = 1;               ///< of the data, in radii of a disk with the hole's area
    unsigned rings = 4;             ///< of vertices, at least
    std::size_t most_centres = 800; ///< on the surface, 10 to 2000
    double offset = 0; ///< d, unit of the surface; 0: a 20th of the radius or half a border edge,
                       ///< the larger; less where the surface comes near to itself
    double tolerance = 0; ///< unit of the surface; 0: a thousandth of the median border edge
    double size = 0;      ///< edge length of the filling; 0: the median border edge, more where
                          ///< the hole would take more than most_vertices, down to a quarter
                          ///< where triangles of that size would cut corners at the border, or be
                          ///< farther off the level, for being flat, than that is off the truth
    std::size_t most_vertices = 50'000;
    unsigned degree = 0; ///< of the polynomial part along the hole: 1 is the paper's, up to 8; 0:
                         ///< the one of these that predicts best
    std::optional<double> smoothing{}; ///< none: every datum is met. Else data may be missed by so
                                       ///< much, root mean square over all constraints, unit of
                                       ///< the surface; 0: by as much as generalised
                                       ///< cross-validation says
    std::span<const BorderLoop> loops{}; ///< all of the surface: islands in the hole are data, too
    bool long_edges = false; ///< points on edges near the border that are longer than one and a
                             ///< half of its median edges are data, too: a function that meets
                             ///< vertices alone may swing far from a cliff's triangles
};

/// What happened, for people. Lengths in the unit of the surface.
struct RbfReport {
    std::size_t data = 0, centres = 0, offsets = 0; ///< on the surface; constraints off it
    unsigned degree = 0;                            ///< of the polynomial part
    std::size_t patches = 0;                        ///< of step (4); 0 where step (3) sufficed
    double missed = 0;                              ///< largest |f| at the data after step (3)
    double largest_error = 0; ///< the same at the end: the interpolation error
    double rms_error = 0;
    double freedom = 0; ///< degrees of it that smoothing leaves; 0 where every datum is met
    double offset = 0, size = 0; ///< as used
    RbfSolution solution;
};

/// The zero level, made by steps (1) to (5).
/// Errors: bad_option, bad_index, bad_number; unsupported (an island that touches the border in a
/// vertex; too large a level for its edge length); nothing_to_do; interrupted, out_of_memory.
Result<Filling> fill_by_rbf(const Surface& surface, const BorderLoop& loop,
                            const RbfOptions& options = {}, const Run& run = {});

/// The same, with what happened.
Result<Filling> fill_by_rbf(const Surface& surface, const BorderLoop& loop,
                            const RbfOptions& options, RbfReport& report, const Run& run);

} // namespace terrane
