// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A stratigraphic column: the units of an area from the top down, and the horizons that bound them.
//
// Convention: the horizon of an entry is the base of its unit, as on a geological map. A unit lies
// on its base, whatever is below that: so a column also holds where layers pinch out, onlap or were
// eroded. Below an erosive base, older horizons go on; above it, parts of them have no meaning.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

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

} // namespace terrane
