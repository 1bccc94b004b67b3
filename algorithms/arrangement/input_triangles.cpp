// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/arrangement/input_triangles.hpp>

#include <algorithm>

namespace terrane {

std::uint32_t InputTriangles::surface_of(std::uint32_t triangle) const {
    return static_cast<std::uint32_t>(std::upper_bound(first.begin(), first.end(), triangle) -
                                      first.begin() - 1);
}

std::uint32_t InputTriangles::first_same(std::uint32_t triangle) const {
    const auto it = std::lower_bound(duplicates.begin(), duplicates.end(), triangle,
                                     [](const auto& d, std::uint32_t t) { return d[0] < t; });
    return it != duplicates.end() && (*it)[0] == triangle ? (*it)[1] : triangle;
}

} // namespace terrane
