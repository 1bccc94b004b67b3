// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/uncertainty_maps.hpp>

#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/io/files.hpp>

namespace terrane {

Result<std::vector<std::optional<Surface>>> read_uncertainty_maps(const Project& project) {
    return guarded("to read the maps", "uncertainty",
                   [&]() -> Result<std::vector<std::optional<Surface>>> {
                       std::vector<std::optional<Surface>> maps;
                       for (std::size_t i = 0; i < project.uncertainty.size(); ++i) {
                           const auto& field = project.uncertainty[i].field;
                           maps.emplace_back();
                           if (!field || field->map.empty()) continue;
                           auto read = read_surfaces(field->map);
                           if (!read) return read.error();
                           if (read->size() != 1 || read->front().triangles.empty())
                               return at_key(project, fmt::format("uncertainty[{}].field.map", i),
                                             "must be a file of one grid with values");
                           maps.back() = std::move(read->front());
                       }
                       return maps;
                   });
}

} // namespace terrane
