// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/detail/block_units.hpp>

#include <algorithm>

#include <terrane/algorithms/mesh/labels.hpp>

namespace terrane::structure::detail {

ColumnInMesh::ColumnInMesh(const StratigraphicColumn& column, const Mesh& mesh) :
    column_(column), base_of_(mesh.surfaces.size(), column.size()) {
    const auto labels = unique_labels(mesh.surfaces);
    for (std::size_t i = 0; i < column.size(); ++i)
        for (const std::uint32_t s : surfaces_called(column[i].surface, mesh.surfaces, labels))
            base_of_[s] = i;
}

std::optional<UnitRange> ColumnInMesh::units_of(std::span<const BlockContact> around,
                                                std::span<const std::uint32_t> inside) const {
    const std::size_t none = column_.size();
    std::size_t floor = none; // the highest base below the block
    for (const BlockContact& c : around)
        if (c.is_floor) floor = std::min(floor, base_of_[c.surface]);
    const bool has_floor = floor != none;
    const bool is_erosive = has_floor && column_[floor].contact == UnitContact::erosive;
    std::optional<std::size_t> below; // the unit below the lowest base above the block
    for (const BlockContact& c : around) {
        const std::size_t base = base_of_[c.surface];
        if (!c.is_roof || base == none || (is_erosive && base > floor)) continue;
        below = std::max(below.value_or(0), base + 1);
    }
    std::optional<UnitRange> units;
    if (has_floor)
        units = UnitRange{floor, std::max(floor, below.value_or(floor))};
    else if (below)
        units = UnitRange{*below, *below};
    for (const std::uint32_t s : inside) {
        const std::size_t base = base_of_[s];
        if (base == none || base < below.value_or(0) || base >= floor) continue;
        if (!units) units = UnitRange{base, base + 1};
        units->first = std::min(units->first, base);
        units->last = std::max(units->last, base + 1);
    }
    return units;
}

std::string ColumnInMesh::name_of(const UnitRange& units) const {
    if (units.first == units.last) return unit(units.first);
    return unit(units.first) + " to " + unit(units.last);
}

std::optional<double> ColumnInMesh::age_of(const UnitRange& units) const {
    return units.last < column_.size() ? column_[units.last].age : std::nullopt;
}

std::string ColumnInMesh::unit(std::size_t number) const {
    return number < column_.size() ? one_line(column_[number].name)
                                   : "below " + one_line(column_.back().name);
}

} // namespace terrane::structure::detail
