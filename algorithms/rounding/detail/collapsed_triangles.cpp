// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/collapsed_triangles.hpp>

#include <algorithm>

#include <terrane/algorithms/core/disjoint_sets.hpp>

namespace terrane::rounding::detail {

Side side_of(const Triangle& t, unsigned i) {
    const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
    return {low, high};
}

CollapsedTriangles::CollapsedTriangles(std::span<const Point3> points,
                                       std::span<const Triangle> triangles,
                                       std::span<const std::uint32_t> lost) :
    points_(points) {
    if (lost.empty()) return;
    is_corner_.assign(points.size(), false);
    DisjointSets lines(lost.size());
    for (std::uint32_t k = 0; k < lost.size(); ++k)
        for (unsigned i = 0; i < 3; ++i) {
            const Side side = side_of(triangles[lost[k]], i);
            is_corner_[side[0]] = is_corner_[side[1]] = true;
            if (side[0] != side[1]) lines.join(line_of_.emplace(side, k).first->second, k);
        }
    corners_on_.resize(lost.size());
    for (auto& [side, line] : line_of_) {
        line = lines.find(line);
        corners_on_[line].insert(corners_on_[line].end(), side.begin(), side.end());
    }
    const auto before = [&](std::uint32_t a, std::uint32_t b) { return points[a] < points[b]; };
    for (auto& corners : corners_on_) {
        std::sort(corners.begin(), corners.end(), before);
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    }
}

PointsInSides CollapsedTriangles::within(const Triangle& t) const {
    PointsInSides result;
    if (is_corner_.empty()) return result;
    for (unsigned i = 0; i < 3; ++i) {
        if (!is_concerned(t, i)) continue;
        const auto points = inside(t[i], t[(i + 1) % 3]);
        result[i].assign(points.begin(), points.end());
        if (points_[t[(i + 1) % 3]] < points_[t[i]])
            std::reverse(result[i].begin(), result[i].end());
    }
    return result;
}

std::size_t CollapsedTriangles::count_within(const Triangle& t) const {
    std::size_t count = 0;
    for (unsigned i = 0; i < 3 && !is_corner_.empty(); ++i)
        if (is_concerned(t, i)) count += inside(t[i], t[(i + 1) % 3]).size();
    return count;
}

/// The lexicographic order of points on a line is their order along it.
std::span<const std::uint32_t> CollapsedTriangles::inside(std::uint32_t from,
                                                          std::uint32_t to) const {
    const auto line = line_of_.find({std::min(from, to), std::max(from, to)});
    if (line == line_of_.end()) return {};
    const auto& corners = corners_on_[line->second];
    const auto before = [&](std::uint32_t a, std::uint32_t b) { return points_[a] < points_[b]; };
    const auto [first, last] = std::minmax(from, to, before);
    return {std::upper_bound(corners.begin(), corners.end(), first, before),
            std::lower_bound(corners.begin(), corners.end(), last, before)};
}

/// Cuts the triangle from the first point to the opposite corner, then divides both halves.
void divide_at(const Triangle& t, const PointsInSides& within, std::vector<Triangle>& out) {
    unsigned i = 0;
    while (i < 3 && within[i].empty()) ++i;
    if (i == 3) {
        out.push_back(t);
        return;
    }
    const unsigned next = (i + 1) % 3, last = (i + 2) % 3;
    const std::uint32_t cut = within[i].front();
    divide_at({t[i], cut, t[last]}, {{{}, {}, within[last]}}, out);
    divide_at({cut, t[next], t[last]},
              {{{within[i].begin() + 1, within[i].end()}, within[next], {}}}, out);
}

} // namespace terrane::rounding::detail
