// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/block_names.hpp>

#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/labels.hpp>

namespace terrane {
namespace {

Error error_at(std::size_t entry, const char* key, std::string sentence) {
    return {ErrorCode::bad_option, std::move(sentence),
            "column[" + std::to_string(entry) + "]." + key};
}

} // namespace

Status check_column(std::span<const ColumnUnit> column) {
    return guarded("for the column", "column", [&]() -> Status {
        std::set<std::string> units, surfaces;
        std::optional<double> age;
        for (std::size_t i = 0; i < column.size(); ++i) {
            const ColumnUnit& unit = column[i];
            if (unit.name.empty()) return error_at(i, "unit", "the unit needs a name");
            if (!units.insert(unit.name).second)
                return error_at(i, "unit", "unit " + unit.name + " is in the column twice");
            if (unit.surface.empty() && i + 1 < column.size())
                return error_at(i, "surface", "only the lowest unit can be without a base");
            if (!unit.surface.empty() && !surfaces.insert(unit.surface).second)
                return error_at(i, "surface",
                                "surface " + unit.surface + " is the base of another unit");
            if (!unit.age) continue;
            if (!std::isfinite(*unit.age)) return error_at(i, "age", "the age must be finite");
            if (age && *unit.age < *age)
                return error_at(i, "age", "the base is younger than one above it");
            age = unit.age;
        }
        return Done{};
    });
}

Status check_column(std::span<const ColumnUnit> column, std::span<const SurfaceInfo> surfaces) {
    return guarded("for the column", "column", [&]() -> Status {
        const auto labels = unique_labels(surfaces);
        for (std::size_t i = 0; i < column.size(); ++i) {
            const std::string& name = column[i].surface;
            if (!name.empty() && surfaces_called(name, surfaces, labels).empty())
                return error_at(i, "surface", not_called("surface", name, labels));
        }
        return Done{};
    });
}

} // namespace terrane
