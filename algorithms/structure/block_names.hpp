// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Names of blocks: those that people gave, where there are any, and others by the surfaces that
// bound them.
//
// (a) The unit of a stratigraphic column. A block is of the unit whose base it lies on; one without
//     a base is of the unit below the lowest base above it. Where an erosive base is below a block,
//     older bases around it do not count. A block of several units, as one of their bases ends
//     inside of it or the block is on both sides of one, is called "first to last". A block below
//     the base of the lowest unit is "below UNIT".
// (b) The block that a file states (StatedBlock).
// (c) "below top, above base": the surfaces above and below it, without the boundary of the model;
//     "inside salt" and "around salt" for a surface that closes around the block, or in it; the
//     surfaces at its sides if there are no others: "west of F1".
// Blocks with the same name are told apart by surfaces at their sides, each time by the one at
// which most of them differ: "Unit A, west of F1". If that does not suffice, a number follows, in
// the order of the blocks: "Unit A, 2". All names are different, and one line long. They do not
// depend on the order of the surfaces if these have different names. Cost: linear, n log n in the
// blocks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

// A stratigraphic column: the units of an area from the top down, and the horizons that bound them.
//
// Convention: the horizon of an entry is the base of its unit, as on a geological map. A unit lies
// on its base, whatever is below that: so a column also holds where layers pinch out, onlap or were
// eroded. Below an erosive base, older horizons go on; above it, parts of them have no meaning.

/// The contact of a unit with the one below.
enum class UnitContact : std::uint8_t { conformable, erosive };

/// A unit of a column.
struct ColumnUnit {
    std::string name;            ///< of the unit; not empty, and in no other entry
    std::string surface{};       ///< name of the horizon at its base; empty: the lowest unit, which
                                 ///< needs none
    std::optional<double> age{}; ///< of its base, in any unit of time before present
    UnitContact contact = UnitContact::conformable; ///< of its base
};

/// The units from the top down. Without units there is no column.
using StratigraphicColumn = std::vector<ColumnUnit>;

/// Checks a column by itself: each unit and each surface is there once, only the lowest unit has no
/// surface, and no base is older than one below it. Errors: bad_option at "column[2].age".
Status check_column(std::span<const ColumnUnit> column);

/// Checks that each surface of the column exists. Errors: bad_option at "column[2].surface".
Status check_column(std::span<const ColumnUnit> column, std::span<const SurfaceInfo> surfaces);

// Blocks that a file states, such as the regions of a GOCAD model, and the blocks that they are.

/// Triangles of a surface that border a stated block.
struct StatedBorder {
    SurfaceId surface{};              ///< of the input
    std::uint32_t first_triangle = 0; ///< number in that surface
    std::uint32_t triangle_count = 0; ///< of triangles that follow each other

    friend auto operator<=>(const StatedBorder&, const StatedBorder&) = default;
};

/// A block that a file states.
struct StatedBlock {
    std::string name;                    ///< as in the file
    std::string layer{};                 ///< name of the layer that it is part of; empty: none
    std::vector<StatedBorder> borders{}; ///< around it; none that has the block on both sides
};

/// Finds for each block the stated one that it is, or a part of: the index of that of whose borders the
/// block's boundary consists, as far as it is a stated border; UINT32_MAX if there is none, for
/// instance for a block of several stated ones. Of several such ones it is the one whose borders
/// have the most in common with the boundary of the block, the first among equals. Files differ in
/// what the front of a border is, so that sides do not count. A hundredth of the area is left to
/// gaps and to the effect of rounding on the file. Cost: linear.
std::vector<std::uint32_t> match_blocks(const Arrangement& arrangement, const Volumes& volumes,
                                        std::span<const StatedBlock> stated);

/// Names that people gave to blocks and units.
struct GivenNames {
    StratigraphicColumn column{};      ///< by surfaces of the mesh; empty: none
    std::vector<std::string> stated{}; ///< per block: the stated one it is; empty: none; or no list
    std::vector<std::string> layers{}; ///< per block: the layer of that one, as above
};

/// Names the blocks of a structure, and sets their units and ages. Surfaces of the column that the
/// mesh does not have are passed over; see check_column().
void name_blocks(const Mesh& mesh, const Volumes& volumes, const GivenNames& given,
                 Structure& structure);

} // namespace terrane
