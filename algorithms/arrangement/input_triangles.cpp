// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/arrangement/arrangement.hpp>

#include <algorithm>

namespace terrane {

SurfaceId InputTriangles::surface_of(InputTriangleId triangle) const {
    const auto after = std::upper_bound(first.begin(), first.end(), std::uint32_t{triangle});
    return SurfaceId(static_cast<std::uint32_t>(after - first.begin() - 1));
}

InputTriangleId InputTriangles::first_same(InputTriangleId triangle) const {
    const auto it = std::lower_bound(duplicates.begin(), duplicates.end(), std::uint32_t{triangle},
                                     [](const auto& d, std::uint32_t t) { return d[0] < t; });
    return it != duplicates.end() && (*it)[0] == triangle ? InputTriangleId((*it)[1]) : triangle;
}

} // namespace terrane
