// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/free_borders.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <terrane/algorithms/triangle_tree.hpp>

namespace terrane {
namespace {

/// The nearest surface to a point, and how far it is.
struct Nearest {
    std::uint32_t surface = 0;
    double distance = 0;
};

class SurfaceTrees {
public:
    explicit SurfaceTrees(const Mesh& mesh) {
        std::vector<std::vector<Triangle>> triangles(mesh.surfaces.size());
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            for (const std::uint32_t s : mesh.surfaces_of[t])
                triangles[s].push_back(mesh.triangles[t]);
        for (auto& of_surface : triangles) {
            filled_.push_back(!of_surface.empty());
            trees_.emplace_back(mesh.vertices, std::move(of_surface));
        }
    }

    /// Of all surfaces but those listed (ascending); the first among equals.
    [[nodiscard]] std::optional<Nearest> nearest(const Point3& p,
                                                 std::span<const std::uint32_t> but) const {
        std::optional<Nearest> best;
        double bound = std::numeric_limits<double>::infinity();
        for (std::uint32_t s = 0; s < trees_.size(); ++s) {
            if (!filled_[s] || std::binary_search(but.begin(), but.end(), s)) continue;
            const double d = trees_[s].distance(p, bound);
            if (best && d >= bound) continue;
            bound = d;
            best = {s, d};
        }
        return best;
    }

private:
    std::vector<TriangleTree> trees_; ///< per surface
    std::vector<bool> filled_;
};

void add(std::map<std::uint32_t, BorderGap>& gaps, const Nearest& at, const Point3& p) {
    const BorderGap first{at.surface, 0, at.distance, at.distance, p};
    BorderGap& gap = gaps.try_emplace(at.surface, first).first->second;
    gap.least = std::min(gap.least, at.distance);
    if (at.distance <= gap.largest) return;
    gap.largest = at.distance;
    gap.place = p;
}

std::vector<BorderGap> gaps_along(const Mesh& mesh, const ModelLine& line,
                                  const SurfaceTrees& trees) {
    std::vector<Nearest> nearest;
    for (const std::uint32_t v : line.vertices) {
        const auto found = trees.nearest(mesh.vertices[v], line.surfaces);
        if (!found) return {};
        nearest.push_back(*found);
    }
    std::map<std::uint32_t, BorderGap> by_surface;
    for (std::size_t i = 0; i + 1 < nearest.size(); ++i) {
        const std::size_t far = nearest[i].distance >= nearest[i + 1].distance ? i : i + 1;
        const Point3 &p = mesh.vertices[line.vertices[i]], &q = mesh.vertices[line.vertices[i + 1]];
        for (const std::size_t end : {i, i + 1})
            if (nearest[end].surface == nearest[far].surface)
                add(by_surface, nearest[end], end == i ? p : q);
        by_surface[nearest[far].surface].length += std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
    }
    std::vector<BorderGap> gaps;
    for (const auto& [surface, gap] : by_surface) gaps.push_back(gap);
    std::stable_sort(gaps.begin(), gaps.end(),
                     [](const BorderGap& a, const BorderGap& b) { return a.length > b.length; });
    return gaps;
}

} // namespace

std::vector<FreeBorder> find_free_borders(const Mesh& mesh, const Structure& structure) {
    const SurfaceTrees trees(mesh);
    std::vector<FreeBorder> borders;
    for (std::uint32_t l = 0; l < structure.lines.size(); ++l) {
        const ModelLine& line = structure.lines[l];
        if (line.kind != LineKind::free_border) continue;
        borders.push_back({l, line.surfaces, line.length,
                           line.vertices.front() == line.vertices.back(),
                           gaps_along(mesh, line, trees)});
    }
    return borders;
}

std::vector<Leak> leaks_of(std::span<const FreeBorder> borders) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, Leak> leaks;
    for (const FreeBorder& border : borders)
        for (const std::uint32_t from : border.surfaces)
            for (const BorderGap& gap : border.gaps) {
                Leak& leak = leaks[{from, gap.surface}];
                const bool fresh = leak.borders == 0;
                leak.from = from;
                leak.to = gap.surface;
                ++leak.borders;
                leak.length += gap.length;
                leak.least = fresh ? gap.least : std::min(leak.least, gap.least);
                if (!fresh && gap.largest <= leak.largest) continue;
                leak.largest = gap.largest;
                leak.place = gap.place;
            }
    std::vector<Leak> all;
    for (const auto& [pair, leak] : leaks) all.push_back(leak);
    return all;
}

} // namespace terrane
