// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/detail/sorted_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace terrane::quality::detail {
namespace {

/// Spreads the lowest 21 bits so that two zeros follow each.
std::uint64_t spread_bits(std::uint64_t x) {
    x &= 0x1fffff;
    x = (x | x << 32) & 0x1f00000000ffff;
    x = (x | x << 16) & 0x1f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
}

std::vector<std::uint64_t> morton_codes(const std::vector<Point3>& points) {
    Point3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const Point3& p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    // Halves keep the extent finite.
    const double extent =
        std::max({high.x / 2 - low.x / 2, high.y / 2 - low.y / 2, high.z / 2 - low.z / 2});
    const auto cell = [&](double x, double from) {
        return extent > 0 ? static_cast<std::uint64_t>((x / 2 - from / 2) / extent * 0x1fffff) : 0;
    };
    std::vector<std::uint64_t> codes;
    for (const Point3& p : points)
        codes.push_back(spread_bits(cell(p.x, low.x)) | spread_bits(cell(p.y, low.y)) << 1 |
                        spread_bits(cell(p.z, low.z)) << 2);
    return codes;
}

/// Returns the new number of each vertex.
std::vector<std::uint32_t> numbers_by_place(const std::vector<Point3>& points) {
    const auto codes = morton_codes(points);
    std::vector<std::uint32_t> order(points.size()), number(points.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const Point3 &p = points[a], &q = points[b];
        return std::tie(codes[a], p.x, p.y, p.z, a) < std::tie(codes[b], q.x, q.y, q.z, b);
    });
    for (std::uint32_t i = 0; i < order.size(); ++i) number[order[i]] = i;
    return number;
}

} // namespace

SortedMesh sort_by_place(const Mesh& mesh) {
    SortedMesh sorted;
    sorted.number_of = numbers_by_place(mesh.vertices);
    const auto& number = sorted.number_of;
    sorted.mesh.surfaces = mesh.surfaces;
    sorted.mesh.vertices.resize(mesh.vertices.size());
    for (std::size_t v = 0; v < number.size(); ++v)
        sorted.mesh.vertices[number[v]] = mesh.vertices[v];
    std::vector<Triangle> triangles;
    for (const Triangle& t : mesh.triangles) {
        Triangle c{number[t[0]], number[t[1]], number[t[2]]};
        std::sort(c.begin(), c.end());
        triangles.push_back(c);
    }
    sorted.triangle_of.resize(triangles.size());
    std::iota(sorted.triangle_of.begin(), sorted.triangle_of.end(), 0U);
    std::sort(sorted.triangle_of.begin(), sorted.triangle_of.end(),
              [&](std::uint32_t a, std::uint32_t b) {
                  return std::tie(triangles[a], a) < std::tie(triangles[b], b);
              });
    for (const std::uint32_t t : sorted.triangle_of) {
        sorted.mesh.triangles.push_back(triangles[t]);
        sorted.mesh.surfaces_of.push_back(mesh.surfaces_of[t]);
        if (mesh.regions_of.size() > 0) sorted.mesh.regions_of.push_back(mesh.regions_of[t]);
    }
    for (const Edge& e : mesh.intersection_edges) {
        const std::uint32_t a = number[e[0]], b = number[e[1]];
        sorted.mesh.intersection_edges.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(sorted.mesh.intersection_edges.begin(), sorted.mesh.intersection_edges.end());
    return sorted;
}

} // namespace terrane::quality::detail
