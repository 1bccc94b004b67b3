// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/structure.hpp>

#include <algorithm>
#include <climits>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/surface_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane {

namespace {

int decade_of(double distance) {
    return distance > 0 ? static_cast<int>(std::floor(std::log10(distance))) : INT_MIN;
}

/// The parts of surfaces that hang together by common vertices. Those of a surface are consecutive.
class SurfaceParts {
public:
    SurfaceParts(const Mesh& mesh, const Structure& structure);

    /// Per triangle: the part of each of its surfaces, ascending.
    [[nodiscard]] const IndexLists<std::uint32_t>& of_triangles() const { return of_triangles_; }
    [[nodiscard]] std::uint32_t surface_of(std::uint32_t part) const { return surface_of_[part]; }
    /// Returns the parts that a border belongs to, ascending.
    [[nodiscard]] std::vector<std::uint32_t> of_border(const ModelLine& line) const {
        std::vector<std::uint32_t> parts;
        for (const std::uint32_t s : line.surfaces)
            parts.push_back(at_border_.at({s, line.vertices.front()}));
        return parts;
    }

private:
    IndexLists<std::uint32_t> of_triangles_;
    std::vector<std::uint32_t> surface_of_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>
        at_border_; ///< by surface and first vertex of a border
};

SurfaceParts::SurfaceParts(const Mesh& mesh, const Structure& structure) {
    for (const ModelLine& line : structure.lines)
        if (line.kind == LineKind::free_border)
            for (const std::uint32_t s : line.surfaces)
                at_border_.emplace(std::pair(s, line.vertices.front()), no_index);
    of_triangles_ = mesh.surfaces_of;
    const auto& surfaces = of_triangles_.values;
    std::vector<std::uint32_t> triangle_of; // per entry of the lists
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        triangle_of.insert(triangle_of.end(), mesh.surfaces_of[t].size(), t);
    const auto entries =
        lists_by_key<std::uint32_t>(mesh.surfaces.size(), surfaces,
                                    [](std::size_t i) { return static_cast<std::uint32_t>(i); });
    std::vector<std::uint32_t> owner(mesh.vertices.size(), no_index); // the last surface there
    std::vector<std::uint32_t> local(mesh.vertices.size());           // its number for the vertex
    std::vector<std::uint32_t> part_of_entry(surfaces.size());
    for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
        DisjointSets sets(3 * entries[s].size());
        std::uint32_t count = 0;
        for (const std::uint32_t e : entries[s]) {
            const Triangle& corners = mesh.triangles[triangle_of[e]];
            for (const std::uint32_t v : corners)
                if (std::exchange(owner[v], s) != s) local[v] = count++;
            sets.join(local[corners[0]], local[corners[1]]);
            sets.join(local[corners[0]], local[corners[2]]);
        }
        std::vector<std::uint32_t> part_of(count, no_index); // by representative
        for (const std::uint32_t e : entries[s]) {
            std::uint32_t& part = part_of[sets.find(local[mesh.triangles[triangle_of[e]][0]])];
            if (part == no_index) {
                part = static_cast<std::uint32_t>(surface_of_.size());
                surface_of_.push_back(s);
            }
            part_of_entry[e] = part;
        }
        for (auto at = at_border_.lower_bound({s, 0});
             at != at_border_.end() && at->first.first == s; ++at)
            at->second = part_of[sets.find(local[at->first.second])];
    }
    of_triangles_.values = std::move(part_of_entry);
}

/// A point of the border and the part of a surface nearest to it.
struct Sample {
    Point3 place{};
    NearestSurface nearest{};
};

/// Samples a border at its vertices and the midpoints of its edges; empty if there are only its own
/// parts of surfaces.
std::vector<Sample> samples_along(const Mesh& mesh, const ModelLine& line,
                                  std::span<const std::uint32_t> own, const SurfaceTree& tree) {
    std::vector<Sample> samples;
    const auto add = [&](const Point3& p) {
        double bound = std::numeric_limits<double>::infinity();
        if (!samples.empty()) { // the triangle inequality, but for rounding
            const auto& [before, nearest] = samples.back();
            bound = 1.001 * (nearest.distance + length_between(before, p));
        }
        auto found = tree.nearest(p, own, bound);
        if (!found && !samples.empty())
            found = tree.nearest(p, own, std::numeric_limits<double>::infinity());
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
                                  const SurfaceParts& parts, const SurfaceTree& tree) {
    const auto samples = samples_along(mesh, line, parts.of_border(line), tree);
    std::map<std::pair<int, std::uint32_t>, BorderGap> gaps;
    for (std::size_t i = 0; i + 2 < samples.size(); i += 2) {
        const Sample& far = *std::max_element(
            samples.begin() + static_cast<std::ptrdiff_t>(i),
            samples.begin() + static_cast<std::ptrdiff_t>(i) + 3,
            [](const auto& a, const auto& b) { return a.nearest.distance < b.nearest.distance; });
        const auto& [part, distance, reach] = far.nearest;
        const std::uint32_t surface = parts.surface_of(part);
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
    const auto is_free = [](const ModelLine& line) { return line.kind == LineKind::free_border; };
    if (std::ranges::none_of(structure.lines, is_free)) return {}; // closed surfaces need no tree
    const StandardArithmetic guard;
    const SurfaceParts parts(mesh, structure);
    const SurfaceTree tree({mesh.vertices, mesh.triangles, parts.of_triangles()});
    std::vector<FreeBorder> borders;
    for (std::uint32_t l = 0; l < structure.lines.size(); ++l) {
        const ModelLine& line = structure.lines[l];
        if (!is_free(line)) continue;
        borders.push_back({l, line.surfaces, line.length,
                           line.vertices.front() == line.vertices.back(),
                           gaps_along(mesh, line, parts, tree)});
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
