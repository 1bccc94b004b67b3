// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <unordered_map>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/sections/detail/parts.hpp>
#include <terrane/kernel/assertion.hpp>

namespace terrane::sections {
namespace {

using Ring = std::vector<std::uint32_t>;

/// The order of vertices from left to right: of sheets, then along the sheet, then across it.
class SectionOrder {
public:
    SectionOrder(const Cut& cut, const SectionSurface& along) :
        exact_(cut.exact), sheet_(cut.exact.vertices.size(), no_index) {
        for (const SectionSheet& sheet : along.sheets) ways_.push_back(way_of(sheet));
        for (const CutTriangle& t : cut.triangles)
            for (const std::uint32_t v : t.corners) sheet_[v] = std::min(sheet_[v], t.sheet);
    }

    [[nodiscard]] bool operator()(std::uint32_t v, std::uint32_t w) const {
        if (sheet_[v] != sheet_[w]) return sheet_[v] < sheet_[w];
        const Way& way = ways_[sheet_[v]];
        for (const unsigned c : way.coordinates) {
            const auto order =
                exact_.state->points.compare(c, exact_.vertices[v], exact_.vertices[w]);
            if (order != std::strong_ordering::equal)
                return (order == std::strong_ordering::less) != way.descends;
        }
        return false;
    }

private:
    /// Two coordinates that tell the points of a sheet apart, and whether they are to descend.
    struct Way {
        std::array<unsigned, 2> coordinates;
        bool descends;
    };

    static Way way_of(const SectionSheet& sheet) {
        const Point3 n = cross(sheet.right, sheet.up);
        const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
        if (z >= x && z >= y) return {{0, 1}, sheet.right.x < 0};
        if (x >= y) return {{1, 2}, sheet.right.y < 0};
        return {{0, 2}, sheet.right.x < 0};
    }

    const Arrangement& exact_;
    std::vector<std::uint32_t> sheet_; ///< per vertex: the first of its triangles in the section
    std::vector<Way> ways_;            ///< per sheet
};

/// The edges between different regions, each as an edge of a triangle of a region.
class Borders {
public:
    Borders(const Cut& cut, const std::vector<std::uint32_t>& region_of) :
        cut_(cut), region_of_(region_of), seen_(3 * cut.triangles.size()) {}

    /// Appends the rings at a triangle that were not met before. A ring runs along the region, which is on
    /// its left.
    void append(std::uint32_t triangle, std::vector<Ring>& rings) {
        for (std::uint32_t i = 0; i < 3; ++i) {
            if (!is_border(triangle, i) || seen_[3 * triangle + i]) continue;
            Ring way;
            std::uint32_t t = triangle, edge = i;
            while (!seen_[3 * t + edge]) {
                seen_[3 * t + edge] = true;
                way.push_back(cut_.triangles[t].corners[edge]);
                edge = (edge + 1) % 3;
                while (!is_border(t, edge)) {
                    const std::uint32_t v = cut_.triangles[t].corners[edge];
                    t = cut_.triangles[t].next[edge];
                    const Triangle& c = cut_.triangles[t].corners;
                    edge = c[0] == v ? 0 : c[1] == v ? 1 : 2;
                }
            }
            divide(way, rings);
        }
    }

private:
    [[nodiscard]] bool is_border(std::uint32_t t, std::uint32_t edge) const {
        const std::uint32_t other = cut_.triangles[t].next[edge];
        return other == no_index || region_of_[other] != region_of_[t];
    }

    /// Divides a closed way at the vertices that it meets again.
    static void divide(const Ring& way, std::vector<Ring>& rings) {
        Ring open;
        std::unordered_map<std::uint32_t, std::size_t> place; // in `open`, of its vertices
        for (const std::uint32_t v : way) {
            if (const auto before = place.find(v); before != place.end()) {
                const auto first = open.begin() + static_cast<std::ptrdiff_t>(before->second);
                rings.emplace_back(first, open.end());
                for (const std::uint32_t w : rings.back()) place.erase(w);
                open.erase(first, open.end());
            }
            place[v] = open.size();
            open.push_back(v);
        }
        rings.push_back(std::move(open));
    }

    const Cut& cut_;
    const std::vector<std::uint32_t>& region_of_;
    std::vector<bool> seen_; ///< per edge of a triangle
};

/// Turns each ring to its least vertex, and puts the outer one first.
void order_rings(const SectionOrder& before, std::vector<Ring>& rings) {
    TERRANE_ASSERT(!rings.empty());
    std::uint32_t least = rings[0][0], most = least;
    for (Ring& ring : rings) {
        const auto [first, last] = std::minmax_element(ring.begin(), ring.end(), before);
        if (before(*first, least)) least = *first;
        if (before(most, *last)) most = *last;
        std::rotate(ring.begin(), first, ring.end());
    }
    const auto outer = std::find_if(rings.begin(), rings.end(), [&](const Ring& ring) {
        return ring[0] == least && std::find(ring.begin(), ring.end(), most) != ring.end();
    });
    TERRANE_ASSERT(outer != rings.end());
    std::rotate(rings.begin(), outer, outer + 1);
}

} // namespace

std::vector<CutRegion> find_regions(const Cut& cut, const SectionSurface& along) {
    const auto count = static_cast<std::uint32_t>(cut.triangles.size());
    DisjointSets parts(count);
    for (std::uint32_t t = 0; t < count; ++t)
        for (const std::uint32_t other : cut.triangles[t].next)
            if (other != no_index && cut.triangles[other].blocks == cut.triangles[t].blocks)
                parts.join(t, other);
    const auto& region_of = parts.flattened();
    std::vector<std::uint32_t> number(count, no_index);
    std::vector<CutRegion> regions;
    Borders borders(cut, region_of);
    for (std::uint32_t t = 0; t < count; ++t) {
        if (cut.triangles[t].blocks == std::array{0U, 0U}) continue;
        if (region_of[t] == t) {
            number[t] = static_cast<std::uint32_t>(regions.size());
            regions.emplace_back();
        }
        CutRegion& region = regions[number[region_of[t]]];
        region.triangles.push_back(t);
        borders.append(t, region.rings);
    }
    const SectionOrder order(cut, along);
    for (CutRegion& region : regions) order_rings(order, region.rings);
    return regions;
}

} // namespace terrane::sections
