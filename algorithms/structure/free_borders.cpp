// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/relations.hpp>

#include <algorithm>
#include <climits>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/surface_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane {

namespace {

int decade_of(double distance) {
    return distance > 0 ? static_cast<int>(std::floor(std::log10(distance))) : INT_MIN;
}

/// A point of the border and the surface nearest to it.
struct Sample {
    Point3 place{};
    NearestSurface nearest{};
};

/// Samples a border at its vertices and the midpoints of its edges; empty if there is no other
/// surface.
std::vector<Sample> samples_along(const Mesh& mesh, const ModelLine& line,
                                  const SurfaceTree& tree) {
    std::vector<Sample> samples;
    const auto add = [&](const Point3& p) {
        double bound = std::numeric_limits<double>::infinity();
        if (!samples.empty()) { // the triangle inequality, but for rounding
            const auto& [before, nearest] = samples.back();
            bound = 1.001 * (nearest.distance + length_between(before, p));
        }
        auto found = tree.nearest(p, line.surfaces, bound);
        if (!found && !samples.empty())
            found = tree.nearest(p, line.surfaces, std::numeric_limits<double>::infinity());
        if (found) samples.push_back({p, *found});
    };
    for (std::size_t i = 0; i < line.vertices.size(); ++i) {
        const Point3& p = mesh.vertices[line.vertices[i]];
        add(p);
        if (i + 1 == line.vertices.size()) break;
        const Point3& q = mesh.vertices[line.vertices[i + 1]];
        add(middle_of(p, q));
    }
    return samples;
}

std::vector<BorderGap> gaps_along(const Mesh& mesh, const ModelLine& line,
                                  const SurfaceTree& tree) {
    const auto samples = samples_along(mesh, line, tree);
    std::map<std::pair<int, std::uint32_t>, BorderGap> gaps;
    for (std::size_t i = 0; i + 2 < samples.size(); i += 2) {
        const Sample& far = *std::max_element(
            samples.begin() + static_cast<std::ptrdiff_t>(i),
            samples.begin() + static_cast<std::ptrdiff_t>(i) + 3,
            [](const auto& a, const auto& b) { return a.nearest.distance < b.nearest.distance; });
        const auto& [surface, distance, reach] = far.nearest;
        const Point3 &p = samples[i].place, &q = samples[i + 2].place;
        const int decade = decade_of(distance);
        const BorderGap fresh{SurfaceId(surface), decade, 0, distance, distance, far.place};
        BorderGap& gap = gaps.try_emplace({decade, surface}, fresh).first->second;
        gap.length += distance_between(q, p);
        gap.least = std::min(gap.least, distance);
        if (distance <= gap.largest) continue;
        gap.largest = distance;
        gap.place = far.place;
    }
    std::vector<BorderGap> sorted;
    for (const auto& [key, gap] : gaps) sorted.push_back(gap);
    return sorted;
}

} // namespace

std::vector<FreeBorder> find_free_borders(const Mesh& mesh, const Structure& structure) {
    const StandardArithmetic guard;
    const SurfaceTree tree({mesh.vertices, mesh.triangles, mesh.surfaces_of});
    std::vector<FreeBorder> borders;
    for (std::uint32_t l = 0; l < structure.lines.size(); ++l) {
        const ModelLine& line = structure.lines[l];
        if (line.kind != LineKind::free_border) continue;
        borders.push_back({l, line.surfaces, line.length,
                           line.vertices.front() == line.vertices.back(),
                           gaps_along(mesh, line, tree)});
    }
    return borders;
}

void Leak::add(const BorderGap& gap) {
    const bool first = borders == 0;
    ++borders;
    length += gap.length;
    least = first ? gap.least : std::min(least, gap.least);
    if (!first && gap.largest <= largest) return;
    largest = gap.largest;
    place = gap.place;
}

std::vector<Leak> leaks_of(std::span<const FreeBorder> borders) {
    std::map<std::tuple<int, std::uint32_t, std::uint32_t>, Leak> leaks;
    for (const FreeBorder& border : borders)
        for (const std::uint32_t from : border.surfaces)
            for (const BorderGap& gap : border.gaps)
                leaks
                    .try_emplace({gap.decade, from, gap.surface},
                                 Leak{SurfaceId(from), gap.surface, gap.decade})
                    .first->second.add(gap);
    std::vector<Leak> all;
    for (const auto& [key, leak] : leaks) all.push_back(leak);
    return all;
}

} // namespace terrane
