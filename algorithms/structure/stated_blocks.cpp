// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/block_names.hpp>

#include <algorithm>
#include <cstddef>
#include <map>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/structure/detail/constants.hpp>

namespace terrane {
namespace {

/// The borders of all stated blocks, each once.
struct Borders {
    std::vector<std::uint32_t> of_input;               ///< per input triangle: its border
    std::vector<std::vector<std::uint32_t>> of_stated; ///< per stated block, ascending
    std::size_t count = 0;
};

Borders number_borders(const Arrangement& a, std::span<const StatedBlock> stated) {
    Borders all;
    all.of_input.assign(a.inputs.first.back(), no_index);
    std::map<StatedBorder, std::uint32_t> numbers;
    for (const StatedBlock& one : stated) {
        auto& own = all.of_stated.emplace_back();
        for (const StatedBorder& border : one.borders) {
            if (border.surface + std::size_t{1} >= a.inputs.first.size()) continue;
            if (a.inputs.first[border.surface] + std::uint64_t{border.first_triangle} +
                    border.triangle_count >
                a.inputs.first[border.surface + 1])
                continue;
            const auto fresh = static_cast<std::uint32_t>(numbers.size());
            const std::uint32_t number = numbers.emplace(border, fresh).first->second;
            own.push_back(number);
            const std::uint32_t first = a.inputs.first[border.surface] + border.first_triangle;
            std::fill_n(all.of_input.begin() + first, border.triangle_count, number);
        }
        std::sort(own.begin(), own.end());
        own.erase(std::unique(own.begin(), own.end()), own.end());
    }
    all.count = numbers.size();
    return all;
}

double area_of(const Arrangement& a, std::uint32_t t) {
    const auto [i, j, k] = a.triangles[t];
    const Point3 &p = a.nearest(VertexId(i)), &q = a.nearest(VertexId(j)),
                 &r = a.nearest(VertexId(k));
    return length(cross(minus(q, p), minus(r, p))) / 2;
}

/// Areas of the borders of stated blocks.
struct Areas {
    std::vector<double> all;                               ///< per border
    std::vector<std::map<std::uint32_t, double>> of_block; ///< per block, by border
};

Areas measure(const Arrangement& a, const Volumes& volumes, const Borders& borders) {
    Areas areas{std::vector<double>(borders.count), {}};
    areas.of_block.resize(volumes.measures.size());
    for (std::uint32_t t = 0; t < a.triangles.size(); ++t) {
        if (volumes.dangles(t)) continue;
        const auto parents = a.parents_of[t];
        const auto known = std::ranges::find_if(
            parents, [&](std::uint32_t p) { return borders.of_input[p] != no_index; });
        if (known == parents.end()) continue;
        const std::uint32_t border = borders.of_input[*known];
        const double area = area_of(a, t);
        areas.all[border] += area;
        for (const std::uint32_t block : volumes.of_sides[t]) areas.of_block[block][border] += area;
    }
    return areas;
}

std::uint32_t stated_of(const std::map<std::uint32_t, double>& block, const Borders& borders,
                        const std::vector<double>& all) {
    double boundary = 0, best = 0;
    for (const auto& [border, area] : block) boundary += area;
    std::uint32_t found = no_index;
    for (std::uint32_t r = 0; r < borders.of_stated.size(); ++r) {
        double common = 0, stated = 0;
        for (const std::uint32_t border : borders.of_stated[r]) {
            stated += all[border];
            if (const auto own = block.find(border); own != block.end()) common += own->second;
        }
        if (!(common >= structure::detail::stated_block_constants.least_common * boundary))
            continue;
        const double share = common / (boundary + stated - common);
        if (!(share > best)) continue;
        best = share;
        found = r;
    }
    return found;
}

} // namespace

std::vector<std::uint32_t> match_blocks(const Arrangement& arrangement, const Volumes& volumes,
                                        std::span<const StatedBlock> stated) {
    const StandardArithmetic guard;
    std::vector<std::uint32_t> match(volumes.measures.size(), no_index);
    if (stated.empty()) return match;
    const Borders borders = number_borders(arrangement, stated);
    const Areas areas = measure(arrangement, volumes, borders);
    for (std::size_t b = 1; b < match.size(); ++b)
        match[b] = stated_of(areas.of_block[b], borders, areas.all);
    return match;
}

} // namespace terrane
