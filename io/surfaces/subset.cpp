// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/surfaces/subset.hpp>

#include <algorithm>

namespace terrane::detail {

namespace {
constexpr auto unused = UINT32_MAX;
constexpr auto used = UINT32_MAX - 1;
} // namespace

Subset::Subset(std::span<const Point3> vertices) :
    whole_(vertices), in_part_(vertices.size(), unused) {}

/// Returns the vertices that the triangles use, ascending, and marks them as used.
std::vector<std::uint32_t> Subset::used_by(const std::vector<Triangle>& triangles) {
    std::vector<std::uint32_t> result;
    for (const auto& triangle : triangles)
        for (const auto vertex : triangle)
            if (in_part_[vertex] == unused) {
                in_part_[vertex] = used;
                result.push_back(vertex);
            }
    if (result.size() < whole_.size() / 16) {
        std::sort(result.begin(), result.end());
        return result;
    }
    result.clear();
    for (std::uint32_t vertex = 0; vertex < whole_.size(); ++vertex)
        if (in_part_[vertex] == used) result.push_back(vertex);
    return result;
}

std::vector<Point3> Subset::cut(std::vector<Triangle>& triangles) {
    const auto vertices = used_by(triangles);
    std::vector<Point3> part;
    part.reserve(vertices.size());
    for (const auto vertex : vertices) {
        in_part_[vertex] = static_cast<std::uint32_t>(part.size());
        part.push_back(whole_[vertex]);
    }
    for (auto& triangle : triangles)
        for (auto& vertex : triangle) vertex = in_part_[vertex];
    for (const auto vertex : vertices) in_part_[vertex] = unused;
    return part;
}

} // namespace terrane::detail
