// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Stacks hard and soft layers: horizons that were picked separately and interpenetrate become a
// stack. Where a soft horizon is on the wrong side of a harder one, it is replaced by triangles of
// the harder one.
//
// Steps:
//   (1) the exact arrangement of all horizons (with the copies of (4)) and of walls, which are
//       vertical surfaces on the free borders. Each of its triangles is as a whole above, below, on
//       or next to each horizon, seen along z;
//   (2) an exact test decides which, for each pair of triangles whose projections overlap;
//   (3) from the hardest horizon to the softest: at each place, the nearest harder one that exists
//       there decides, among those that it belongs above (below). Its triangles below (above) that
//       one are dropped, and those of the harder one above (below) them are taken;
//   (4) with a minimum thickness D, a soft horizon keeps this distance from harder ones, which take
//       part as copies moved up or down by D. Where two harder ones leave less room than D, the
//       soft one coincides with the upper one. Copies are rounded, so layers may come out of order
//       by rounding errors; such a stack is made once more, of heights and a thickness rounded to
//       multiples of a power of two, the spacing of doubles at the largest height or twice that;
//   (5) the result is rounded to doubles and checked exactly (rounding.hpp);
//   (6) other code checks the doubles exactly for layers above others that are higher in the order,
//       over each place (order_check.hpp).
// Guarantees: no horizon of the result is anywhere above one that is higher in the order, however
// many of them end in between; where they coincide, they share triangles; the hardest
// horizon consists of its own triangles. Where a harder horizon ends above or below a soft one, the
// soft one continues as the next harder ones there allow, with a step that is reported. A step has
// both heights over its line; in doubles that line is a strip about as wide as the spacing of the
// doubles, and the order is not claimed there.
// Not supported, and refused: horizons with vertical triangles, and horizons that are both above
// and below another one along one vertical (overturned folds). Cost: the arrangement, and exact
// tests for pairs of triangles that overlap along z. Source: the paper, 4.2.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace terrane {

/// A horizon of a stack. Of two horizons of equal hardness, the upper one counts as harder.
struct Layer {
    SurfaceId surface{}; ///< index
    double hardness = 0; ///< dimensionless; larger is harder; finite
};

/// Options of stack_layers() and harden().
struct LayerOptions {
    double min_thickness = 0;         ///< D, along z, unit of the surfaces; >= 0
    unsigned max_rounds = 8;          ///< of snapping, see rounding.hpp
    PairCheckOptions check{};         ///< how the doubles are checked
    std::optional<double> max_move{}; ///< see rounding.hpp
};

/// Describes the changes of one horizon. Areas are true areas, squared unit, in floating point.
struct LayerReport {
    SurfaceId surface{};     ///< index in the input
    std::size_t dropped = 0; ///< triangles of the arrangement that it lost
    std::size_t taken = 0;   ///< triangles of harder horizons that it got instead
    std::size_t parts = 0;   ///< connected parts of the dropped triangles
    double dropped_area = 0; ///< of `dropped`
    double taken_area = 0;   ///< of `taken`
    double largest_move = 0; ///< along z, of a corner of a dropped triangle, to the harder one
    double step_length = 0;  ///< length of the borders between kept and dropped triangles where the
                             ///< harder horizon ends
};

/// Two triangles of a mesh of layers over one place in the wrong order.
struct OutOfOrder {
    std::uint32_t upper = 0; ///< the layer that is higher in the order: index into it
    std::uint32_t lower = 0; ///< the other layer
    std::array<std::uint32_t, 2> triangles{}; ///< of upper, of lower
    Point3 place{};   ///< on the first triangle where the second one is farthest above it, rounded
    double depth = 0; ///< by how much, along z, rounded; > 0
};

/// A stack of layers.
struct Layered {
    RoundedMesh rounded; ///< its surfaces are those of `order`, in that order. Triangles where
                         ///< layers coincide belong to several. Must not be used unless is_stack
    std::vector<LayerReport> reports; ///< in the order of `order`
    double step_width = 0; ///< over strips of this width along steps the order is not claimed; a
                           ///< few spacings of the doubles, unit of the surfaces
    std::vector<OutOfOrder> out_of_order; ///< pairs that are out of order in doubles elsewhere
    double min_thickness = 0;             ///< D in use: rounded where the stack was made once more
    double height_error = 0; ///< of copies that were moved by multiples of D and rounded, at most

    /// Tells whether the doubles are a conforming mesh of layers in their order, by exact checks.
    [[nodiscard]] bool is_stack() const { return rounded.report.clean && out_of_order.empty(); }
};

/// Stacks horizons given from the top down, each at most once; other surfaces are ignored. Errors:
/// bad_number, bad_index; bad_option (order or options); nothing_to_do (no layers); unsupported (a
/// horizon that is no graph, with the place); interrupted, out_of_memory.
Result<Layered> stack_layers(std::span<const Surface> surfaces, std::span<const Layer> order,
                             const LayerOptions& options = {}, const Run& run = {});

/// Whether a soft surface stays above the hard one or below.
enum class Keep : std::uint8_t { upper, lower };

/// Stacks two layers: the soft one on top (upper: the result is the pointwise maximum along z) or
/// below (lower: the minimum). Surfaces of the result are ordered from the top down as well; in the
/// reports the hard surface is 0, the soft one 1.
Result<Layered> harden(const Surface& hard, const Surface& soft, Keep keep,
                       const LayerOptions& options = {}, const Run& run = {});

} // namespace terrane
