// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/diffusion.hpp>

namespace terrane {

std::vector<std::uint32_t> regions_of_polygons(const IndexLists<std::uint32_t>& polygons,
                                               std::span<const Edge> stops) {
    std::vector<CellFacet<2>> sides;
    sides.reserve(polygons.values.size());
    for (std::uint32_t p = 0; p < polygons.size(); ++p) {
        const auto corners = polygons[p];
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto ends = std::minmax(corners[i], corners[(i + 1) % corners.size()]);
            sides.push_back({{ends.first, ends.second}, p});
        }
    }
    return diffuse<2>(polygons.size(), std::move(sides), stops);
}

} // namespace terrane
