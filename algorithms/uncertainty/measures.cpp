// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/uncertainty/measures.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <terrane/algorithms/maps/verticals.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Returns the first and one past the last cell whose centres may be in [low, high].
std::array<std::size_t, 2> cells_between(double low, double high, double start, double size,
                                         std::size_t count) {
    const auto index = [&](double at) {
        return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count)));
    };
    return {index(std::floor((low - start) / size - 0.5)),
            index(std::floor((high - start) / size - 0.5) + 2)};
}

/// Calls visit(cell, centre) for the cells whose centres may lie in a triangle in the map.
struct CellsNear {
    const MapGrid& grid;

    template <class Visit>
    void operator()(const std::array<Point3, 3>& corners, const Visit& visit) const {
        const auto& [a, b, c] = corners;
        const auto x = std::minmax({a.x, b.x, c.x}), y = std::minmax({a.y, b.y, c.y});
        const auto columns = cells_between(x.first, x.second, grid.x, grid.width, grid.columns);
        const auto rows = cells_between(y.first, y.second, grid.y, grid.height, grid.rows);
        for (std::size_t row = rows[0]; row < rows[1]; ++row)
            for (std::size_t column = columns[0]; column < columns[1]; ++column)
                visit(row * grid.columns + column,
                      Point3{grid.x + (static_cast<double>(column) + 0.5) * grid.width,
                             grid.y + (static_cast<double>(row) + 0.5) * grid.height, 0});
    }
};

/// Of a linear function over a triangle: the share of the area where it is above 0, and the mean of max(d, 0).
struct Above {
    double share = 0, mean = 0;
};

/// `d`: the values at the corners.
Above above_zero(std::array<double, 3> d) {
    std::sort(d.begin(), d.end());
    if (d[2] <= 0) return {};
    const double mean = (d[0] + d[1] + d[2]) / 3;
    if (d[0] >= 0) return {1, mean};
    if (d[1] <= 0) {
        const double corner = d[2] / (d[2] - d[0]) * (d[2] / (d[2] - d[1]));
        return {corner, d[2] / 3 * corner};
    }
    const double corner = d[0] / (d[0] - d[1]) * (d[0] / (d[0] - d[2])); // it is below
    return {1 - corner, mean - d[0] / 3 * corner};
}

} // namespace

ColumnMaps column_maps(const Mesh& mesh, const Volumes& volumes, const MapGrid& grid) {
    const auto crossings = vertical_crossings(mesh, volumes, CellsNear{grid});
    const std::size_t cells = grid.columns * grid.rows;
    ColumnMaps maps{std::vector<double>(mesh.surfaces.size() * cells, nan),
                    std::vector<double>(volumes.measures.size() * cells)};
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        const VerticalCrossing& at = crossings[i];
        for (const std::uint32_t s : mesh.surfaces_of[at.triangle])
            maps.heights[s * cells + at.node] = at.z; // the last one is the highest
        if (i + 1 == crossings.size() || crossings[i + 1].node != at.node || at.above == 0)
            continue;
        maps.thicknesses[at.above * cells + at.node] += crossings[i + 1].z - at.z;
    }
    return maps;
}

std::vector<BlockMeasure> measure_blocks(const Mesh& mesh, const Volumes& volumes,
                                         std::span<const double> contacts) {
    std::vector<BlockMeasure> all(volumes.measures.size());
    std::vector<double> area(all.size());
    for (BlockMeasure& m : all)
        m = {HUGE_VAL, -HUGE_VAL, {}, std::vector<PartAbove>(contacts.size())};
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (volumes.dangles(t)) continue;
        const auto& [i, j, k] = mesh.triangles[t];
        const Point3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
        const Point3 n = cross(minus(b, a), minus(c, a));
        const double size = length(n);
        const auto z = std::minmax({a.z, b.z, c.z});
        for (const std::size_t side : {0U, 1U}) {
            const std::uint32_t volume = volumes.of_sides[t][side];
            if (volume == 0) continue;
            BlockMeasure& m = all[volume];
            m.low = std::min(m.low, z.first);
            m.high = std::max(m.high, z.second);
            area[volume] += size;
            m.middle = {m.middle.x + size * (a.x + b.x + c.x) / 3,
                        m.middle.y + size * (a.y + b.y + c.y) / 3,
                        m.middle.z + size * (a.z + b.z + c.z) / 3};
            // The divergence of (0, 0, max(z - contact, 0)) is 1 above the contact, and 0 below. (0, 0, 1) flows
            // out of the part above as much as it flows in through the section. The normal points into the volume
            // in front, out of the one behind.
            const double outward = (side == 1 ? n.z : -n.z) / 2;
            for (std::size_t l = 0; l < contacts.size(); ++l) {
                const Above above =
                    above_zero({a.z - contacts[l], b.z - contacts[l], c.z - contacts[l]});
                m.above[l].volume += outward * above.mean;
                m.above[l].area += outward * above.share;
            }
        }
    }
    for (std::size_t v = 0; v < all.size(); ++v) {
        BlockMeasure& m = all[v];
        if (!(area[v] > 0)) {
            m = {0, 0, {}, std::vector<PartAbove>(contacts.size())};
            continue;
        }
        for (std::size_t l = 0; l < contacts.size(); ++l) {
            m.above[l].column = std::max(0.0, m.high - contacts[l]);
            if (m.low < contacts[l]) continue;
            m.above[l].volume = volumes.measures[v]; // all of it; sums would round
            if (m.low > contacts[l]) m.above[l].area = 0;
        }
        m.middle = {m.middle.x / area[v], m.middle.y / area[v], m.middle.z / area[v]};
    }
    return all;
}

} // namespace terrane
