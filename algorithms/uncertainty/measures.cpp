// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/uncertainty/measures.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A point in which a vertical line meets a triangle.
struct ColumnCrossing {
    std::size_t cell = 0;
    double z = 0;
    std::uint32_t triangle = 0;
    std::uint32_t above = 0; ///< volume

    friend bool operator<(const ColumnCrossing& a, const ColumnCrossing& b) {
        if (a.cell != b.cell) return a.cell < b.cell;
        return a.z != b.z ? a.z < b.z : a.triangle < b.triangle;
    }
};

/// Returns on which side of the line from a to b the point is, moved as column_maps() says.
Sign side_of(const Point3& a, const Point3& b, const Point3& p) {
    if (const Sign sign = orient2d(Axis::z, a, b, p); sign != Sign::Zero) return sign;
    if (a.y != b.y) return a.y > b.y ? Sign::Positive : Sign::Negative;
    if (a.x == b.x) return Sign::Zero;
    return b.x > a.x ? Sign::Positive : Sign::Negative;
}

/// Returns the height of the plane of a triangle at a place, within the heights of its corners.
double height_at(const Point3& a, const Point3& b, const Point3& c, const Point3& p) {
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    const double to_b = ((p.x - a.x) * (c.y - a.y) - (c.x - a.x) * (p.y - a.y)) / area;
    const double to_c = ((b.x - a.x) * (p.y - a.y) - (p.x - a.x) * (b.y - a.y)) / area;
    const auto [low, high] = std::minmax({a.z, b.z, c.z});
    const double z = a.z + to_b * (b.z - a.z) + to_c * (c.z - a.z);
    return std::isfinite(z) ? std::clamp(z, low, high) : (low + high) / 2;
}

/// Returns the first and one past the last cell whose centres may be in [low, high].
std::array<std::size_t, 2> cells_between(double low, double high, double start, double size,
                                         std::size_t count) {
    const auto index = [&](double at) {
        return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count)));
    };
    return {index(std::floor((low - start) / size - 0.5)),
            index(std::floor((high - start) / size - 0.5) + 2)};
}

class ColumnSearch {
public:
    ColumnSearch(const Mesh& mesh, const Volumes& volumes, const MapGrid& grid) :
        mesh_(mesh), volumes_(volumes), grid_(grid) {}

    std::vector<ColumnCrossing> operator()() {
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) add(t);
        std::sort(found_.begin(), found_.end());
        return std::move(found_);
    }

private:
    void add(std::uint32_t t) {
        const auto& [i, j, k] = mesh_.triangles[t];
        const Point3 &a = mesh_.vertices[i], &b = mesh_.vertices[j], &c = mesh_.vertices[k];
        const Sign turn = orient2d(Axis::z, a, b, c);
        if (turn == Sign::Zero) return;
        const auto x = std::minmax({a.x, b.x, c.x}), y = std::minmax({a.y, b.y, c.y});
        const auto columns = cells_between(x.first, x.second, grid_.x, grid_.width, grid_.columns);
        const auto rows = cells_between(y.first, y.second, grid_.y, grid_.height, grid_.rows);
        const auto& sides = volumes_.of_sides[t];
        for (std::size_t row = rows[0]; row < rows[1]; ++row)
            for (std::size_t column = columns[0]; column < columns[1]; ++column) {
                const Point3 p{grid_.x + (static_cast<double>(column) + 0.5) * grid_.width,
                               grid_.y + (static_cast<double>(row) + 0.5) * grid_.height, 0};
                if (side_of(a, b, p) != turn || side_of(b, c, p) != turn ||
                    side_of(c, a, p) != turn)
                    continue;
                found_.push_back({row * grid_.columns + column, height_at(a, b, c, p), t,
                                  sides[turn == Sign::Positive ? 0 : 1]});
            }
    }

    const Mesh& mesh_;
    const Volumes& volumes_;
    const MapGrid& grid_;
    std::vector<ColumnCrossing> found_;
};

/// Returns the mean of max(d, 0) over a triangle whose corners have the values d.
double mean_above(std::array<double, 3> d) {
    std::sort(d.begin(), d.end());
    if (d[2] <= 0) return 0;
    const double mean = (d[0] + d[1] + d[2]) / 3;
    if (d[0] >= 0) return mean;
    if (d[1] <= 0) return d[2] / 3 * (d[2] / (d[2] - d[0])) * (d[2] / (d[2] - d[1]));
    return mean - d[0] / 3 * (d[0] / (d[0] - d[1])) * (d[0] / (d[0] - d[2]));
}

} // namespace

ColumnMaps column_maps(const Mesh& mesh, const Volumes& volumes, const MapGrid& grid) {
    const auto crossings = ColumnSearch(mesh, volumes, grid)();
    const std::size_t cells = grid.columns * grid.rows;
    ColumnMaps maps{std::vector<double>(mesh.surfaces.size() * cells, nan),
                    std::vector<double>(volumes.measures.size() * cells)};
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        const ColumnCrossing& at = crossings[i];
        for (const std::uint32_t s : mesh.surfaces_of[at.triangle])
            maps.heights[s * cells + at.cell] = at.z; // the last one is the highest
        if (i + 1 == crossings.size() || crossings[i + 1].cell != at.cell || at.above == 0)
            continue;
        maps.thicknesses[at.above * cells + at.cell] += crossings[i + 1].z - at.z;
    }
    return maps;
}

std::vector<BlockMeasure> measure_blocks(const Mesh& mesh, const Volumes& volumes,
                                         std::span<const double> contacts) {
    std::vector<BlockMeasure> all(volumes.measures.size());
    std::vector<double> area(all.size());
    for (BlockMeasure& m : all) m = {HUGE_VAL, -HUGE_VAL, {}, std::vector<double>(contacts.size())};
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
            // The divergence of (0, 0, max(z - contact, 0)) is 1 above the contact, and 0 below. The
            // normal points into the volume in front, out of the one behind.
            const double outward = (side == 1 ? n.z : -n.z) / 2;
            for (std::size_t l = 0; l < contacts.size(); ++l)
                m.above[l] +=
                    outward * mean_above({a.z - contacts[l], b.z - contacts[l], c.z - contacts[l]});
        }
    }
    for (std::size_t v = 0; v < all.size(); ++v) {
        BlockMeasure& m = all[v];
        if (!(area[v] > 0)) {
            m = {0, 0, {}, std::vector<double>(contacts.size())};
            continue;
        }
        m.middle = {m.middle.x / area[v], m.middle.y / area[v], m.middle.z / area[v]};
    }
    return all;
}

} // namespace terrane
