// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Selects a region of space by an expression over surfaces, such as "(a | b) - c", and returns its boundary:
// Booleans of any number of solids, in one exact arrangement. Or selects a part of an open surface, such as
// "fault & below(top)".
//
// (1) Each closed surface of the expression may cross, touch, overlap and contain itself and others. A point is
//     inside of it by its winding number, which is exact.
// (2) The region is a set of volumes of the arrangement; its boundary are the triangles between a volume in it
//     and one that is not. So it is closed: at each edge, as many triangles run one way as the other. Triangles
//     face outwards.
// (3) An open surface divides what the rest of the expression leaves open into parts, each on one of its sides:
//     detail/sides.hpp says on which. If it does not divide them, as it ends inside of one, that is an error.
// (4) Where the expression has one name without a function, beside functions such as inside() and below(), and the
//     surface of this name is open, the part of that surface is selected. What lies on a solid's boundary counts as
//     inside of it, what lies on a surface as below, west or south of it.
// (5) The same region has the same boundary, to the last byte, however the expression says it, if this names the
//     same surfaces.
// (6) The result is rounded to doubles by round_to_doubles(), with its guarantee. Volumes are exact.
// Cost: that of arrange() of the surfaces in the expression, find_volumes(), and rounding the boundary; if this is not
// one surface, also find_volumes() of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace terrane {

/// The winding numbers of points inside of a closed surface.
enum class InsideRule : std::uint8_t {
    nonzero,  ///< all but 0
    positive, ///< 1, 2, ...: a surface that faces inwards has no inside
    odd,      ///< ..., -1, 1, 3, ...: facing does not matter
};

/// "nonzero", "positive" or "odd".
std::string_view name_of(InsideRule rule);
/// Returns the rule of a name.
std::optional<InsideRule> inside_rule_named(std::string_view name);

/// Options of select().
struct SelectOptions {
    InsideRule rule = InsideRule::nonzero; ///< what is inside of each surface
    bool fractions = false;                ///< whether volumes are given as fractions as well
    ArrangeOptions arrange{};              ///< for the arrangement of the surfaces
    RoundingOptions rounding{};            ///< for the boundary
};

/// A part of the region that is connected through more than edges and points.
struct SelectedPiece {
    double volume = 0;          ///< the double nearest to the exact one, cubic unit of the input
    std::string exact_volume{}; ///< as a reduced fraction, if asked for
    std::size_t triangles = 0;  ///< of `mesh` that bound it; 0: it was too thin for doubles
};

/// A region of space, or a part of a surface.
struct Selected {
    /// Its boundary, or the part of a surface. Surfaces and parents are those of the input, counted through all
    /// surfaces.
    Mesh mesh;
    std::vector<std::uint32_t> piece_of; ///< per triangle: the piece that it bounds; or no list
    std::vector<SelectedPiece> pieces;   ///< from the one with the least vertex on
    std::size_t cavities = 0;            ///< bounded parts of space without the region
    double volume = 0;             ///< the double nearest to the exact one, cubic unit of the input
    std::string exact_volume{};    ///< as a reduced fraction, if asked for
    RoundingReport rounding;       ///< of the boundary; `mesh` is conforming if it is clean
    ArrangeStatistics arrangement; ///< of the surfaces in the expression
    /// Whether a part of an open surface is selected, which has no volume and no pieces. Its triangles face as
    /// they did, and `mesh` has regions.
    bool is_surface = false;
    std::size_t regions = 0; ///< of the part of a surface

    /// Returns the boundary of a piece.
    [[nodiscard]] Mesh piece(std::uint32_t number) const;
};

/// Selects a region by an expression over the surfaces, by their names; surfaces with one name are one operand.
/// expression.hpp describes expressions: a | b (union), a & b (intersection), a - b (difference), a ^ b (symmetric
/// difference), ~a (complement), below(s), above(s), west(s), east(s), south(s), north(s) (sides of a surface), hull(s)
/// (all that it keeps from infinity), brackets, and names in double quotes. A region without points has an empty mesh.
/// Errors: bad_option with the column (syntax, an unknown name) or if the region has no end; not_closed, with the
/// place, for a closed operand that bounds no solid, and for an open one that ends inside a part; those of
/// arrange(), find_volumes() and round_to_doubles().
Result<Selected> select(std::span<const Surface> surfaces, std::string_view expression,
                        const SelectOptions& options = {}, const Run& run = {});

struct Model; // model.hpp

/// Selects a region of a model by an expression over its blocks, its surfaces as they are in the mesh, and other
/// surfaces: "unit(sand) & above(contact)". Its operands are those above, and block(b), a block by its name or
/// number; unit(u), all blocks of a unit; volume < 1e6 and age > 66, all blocks with such a volume in the model, or
/// of a unit whose base has such an age. Surfaces of the model and `others` with one name are one operand. Surfaces
/// of the result are those of the model, then `others`; parents are triangles of the mesh, then of `others`.
/// Errors: bad_option for a block or a unit that is not there; those of select() of surfaces.
Result<Selected> select(const Model& model, std::string_view expression,
                        std::span<const Surface> others = {}, const SelectOptions& options = {},
                        const Run& run = {});

} // namespace terrane
