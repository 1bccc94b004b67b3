// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Hard and soft layers: horizons that were picked apart and interpenetrate become a stack. Where a
// soft horizon is on the wrong side of a harder one it is replaced by the harder one's own
// triangles.
//
// Steps:
//   (1) the exact arrangement of all horizons (with the copies of (4)), and of walls: upright
//   sheets
//       on the free borders. So each triangle of it is in its whole above, below, on or beside each
//       horizon, seen along z, and never two of them;
//   (2) which of them is decided exactly, per pair of triangles whose projections overlap;
//   (3) from the hardest horizon to the softest: its triangles below the nearest harder one that it
//       belongs above (above the nearest harder one that it belongs below) are dropped, and those
//       of the harder one over (under) them are taken;
//   (4) with a minimum thickness D, a soft horizon keeps it from the harder ones: they take part as
//       copies moved up or down by D. Where two harder ones leave less room than D below, the soft
//       one lies on the upper one;
//   (5) the result is rounded to doubles and checked exactly (rounding.hpp).
// Guarantees: a result surface is, at each place of its own outline that a harder one covers, the
// highest (lowest) of the two, so no two of them cross; where they coincide they share triangles;
// those of the hardest horizon are its own. Where a harder one ends over or under a soft one, the
// soft one goes on as it was, with a step: report.
// Not handled, and refused: horizons with upright triangles, and places where a horizon lies both
// above and below another along one vertical: overturned folds.
// Cost: the arrangement, and exact tests for pairs of triangles that overlap along z.
// Source: the paper, 4.2.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace terrane {

/// A horizon of a stack. Of two with the same hardness the upper one counts as harder.
struct Layer {
    std::uint32_t surface = 0; ///< which one
    double hardness = 0;       ///< no unit; more is harder; finite
};

/// Options of stack_layers() and harden().
struct LayerOptions {
    double min_thickness = 0; ///< D, along z, unit of the surfaces; >= 0
    unsigned max_rounds = 8;  ///< of snapping, see rounding.hpp
};

/// What became of one horizon. Areas are true ones, squared unit, in floating point.
struct LayerReport {
    std::uint32_t surface = 0; ///< of the input
    std::size_t dropped = 0;   ///< triangles of the arrangement that were its own
    std::size_t taken = 0;     ///< triangles of harder ones that it has instead
    std::size_t parts = 0;     ///< connected parts of what was dropped: regions
    double dropped_area = 0;   ///< of `dropped`
    double taken_area = 0;     ///< of `taken`
    double largest_move = 0; ///< along z, of a corner of what was dropped, to the harder one there
    double step_length = 0; ///< of borders between what stays and what was dropped where the harder
                            ///< one ends
};

/// A stack of layers.
struct Layered {
    RoundedMesh rounded; ///< its surfaces are those of `order`, in that order. Triangles where
                         ///< layers coincide have several. If report.clean is false, don't use it
    std::vector<LayerReport> reports; ///< in the order of `order`
};

/// `order`: horizons from the top down, each at most once; others are left out.
/// Errors: bad_number, bad_index; bad_option (order or options); nothing_to_do (no layers);
/// unsupported (a horizon that is no graph, with the place); interrupted, out_of_memory.
Result<Layered> stack_layers(std::span<const Surface> surfaces, std::span<const Layer> order,
                             const LayerOptions& options = {}, const Run& run = {});

/// A soft surface stays above the hard one, or below.
enum class Keep : std::uint8_t { upper, lower };

/// Two layers: stack_layers with the soft one on top (upper: it becomes the pointwise maximum along
/// z) or below (lower: the minimum). Surfaces of the result are from the top down as well; in the
/// report the hard one is surface 0, the soft one 1.
Result<Layered> harden(const Surface& hard, const Surface& soft, Keep keep,
                       const LayerOptions& options = {}, const Run& run = {});

} // namespace terrane
