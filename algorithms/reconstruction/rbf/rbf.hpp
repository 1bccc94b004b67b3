// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Fills a hole from the data around it by an implicit function of space, for any surface, including
// folds. Graphs are filled by kriging (rbf_join.hpp).
//
// Steps:
//   (1) data: the vertices within `reach` times the hole's radius of its border, measured along the
//       surface, and at least the first `rings` rings, with normals (detail/data.hpp);
//   (2) constraints: f = 0 at centres; at some of them, well spread, also f = +-d at a distance d
//       off the surface along normals, where no other part of it is as near;
//   (3) centres: at most `most_centres`, well spread (detail/function.hpp). With smoothing, and
//       where it is better by a quarter, they are approximated only, as is likeliest for data with
//       noise. The polynomial part (along the hole's plane, or in space), its degree and the variant
//       are chosen by validation: data nearest to the hole are left out, as if it were wider by a
//       quarter of its radius, and predicted;
//   (4) what is left of the data, even of millions, is added next to them, and fades into the hole
//       (kriging/nearby_rest.hpp). So every datum is interpolated, whatever the number of centres
//       and the noise; not with options.smoothing;
//   (5) the zero level over the hole and a margin beyond it as triangles (detail/zero_level.hpp).
// The expected error is unknown. Guarantees: the same bytes for any number of threads. The filling
// extends at least two edge lengths beyond the border where the surface does; it must be joined
// (join.hpp). Cost: n^3 / 3 for n constraints, at most 2000; n per lattice point of (5).
// Source: the paper, 4.1, equation (10), Carr et al. (2001) for (2) and (3).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/reconstruction/holes/filling.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>

namespace terrane {

/// Options of fill_by_rbf().
struct RbfOptions {
    double reach = 1;               ///< of the data, in radii of a disk with the hole's area
    unsigned rings = 4;             ///< least number of rings of vertices that are data
    std::size_t most_centres = 800; ///< on the surface, 10 to 2000
    double size = 0; ///< edge length of the filling; 0: the median border edge. That is
                     ///< enlarged if the hole would need more than most_vertices, and reduced,
                     ///< down to a quarter, if the triangles would cut corners at the border
                     ///< or be farther from the zero level than it is from data left out
    std::size_t most_vertices = 50'000; ///< of the filling
    unsigned degree = 0; ///< of the polynomial part along the hole, up to 8 (1 in the paper); 0:
                         ///< the one of least validation error
    std::optional<double> smoothing{};   ///< none: every datum is interpolated. Otherwise the root
                                         ///< mean square error over all constraints, unit of the
                                         ///< surface; 0: as is likeliest
    std::span<const BorderLoop> loops{}; ///< all loops of the surface: islands in the hole are
                                         ///< data, too
    bool long_edges = false; ///< points on edges near the border that are longer than one and a
                             ///< half median border edges are data, too: a function that
                             ///< interpolates vertices alone may deviate far from the triangles of
                             ///< a cliff
};

/// Describes a fit. Lengths are in the unit of the surface.
struct RbfReport {
    std::size_t data = 0;     ///< points of the surface and of islands
    std::size_t centres = 0;  ///< centres on the surface
    std::size_t offsets = 0;  ///< constraints off the surface
    unsigned degree = 0;      ///< of the polynomial part
    double missed = 0;        ///< largest |f| at the data before step (4)
    double largest_error = 0; ///< largest |f| at the data at the end: the interpolation error
    double rms_error = 0;     ///< root mean square of f at the data at the end
    double offset = 0;        ///< as used
    double size = 0;          ///< edge length as used
};

/// Checks options. Errors: bad_option.
Status validate_options(const RbfOptions& options);

/// Fills a hole by steps (1) to (5), and describes the fit in `report`, if any. Errors: bad_option,
/// bad_index, bad_number; unsupported (an island that touches the border in a vertex; a zero level
/// too large for its edge length); nothing_to_do; interrupted, out_of_memory.
Result<Filling> fill_by_rbf(const Surface& surface, const BorderLoop& loop,
                            const RbfOptions& options = {}, const Run& run = {},
                            RbfReport* report = nullptr);

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> rbf_constants();

} // namespace terrane
