// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The units of a stratigraphic column that blocks are of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/structure/block_contacts.hpp>
#include <terrane/algorithms/structure/block_names.hpp>

namespace terrane::structure::detail {

/// Units that follow each other. The number after the last one of the column stands for all below
/// it.
struct UnitRange {
    std::size_t first = 0; ///< the uppermost, number in the column
    std::size_t last = 0;  ///< the lowest; the same for a block of one unit
};

/// A column whose bases are surfaces of a mesh.
class ColumnInMesh {
public:
    /// Keeps references to both.
    ColumnInMesh(const StratigraphicColumn& column, const Mesh& mesh);

    /// Finds the units of a block from the surfaces around it and those that end inside of it; none
    /// if there is no base among them.
    [[nodiscard]] std::optional<UnitRange> units_of(std::span<const BlockContact> around,
                                                    std::span<const std::uint32_t> inside) const;

    /// Names units: "A", "A to C", "below C".
    [[nodiscard]] std::string name_of(const UnitRange& units) const;

    /// Returns the age of the base of the lowest of them.
    [[nodiscard]] std::optional<double> age_of(const UnitRange& units) const;

private:
    [[nodiscard]] std::string unit(std::size_t number) const;

    const StratigraphicColumn& column_;
    std::vector<std::size_t> base_of_; ///< per surface: the unit of which it is the base, or
                                       ///< the number of units
};

} // namespace terrane::structure::detail
