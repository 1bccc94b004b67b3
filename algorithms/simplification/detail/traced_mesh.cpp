// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/simplification/detail/traced_mesh.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane::simplification::detail {
namespace {

/// Starts a triangle at its least corner.
Triangle rotated(const Triangle& t) {
    const std::size_t i =
        static_cast<std::size_t>(std::min_element(t.begin(), t.end()) - t.begin());
    return {t[i], t[(i + 1) % 3], t[(i + 2) % 3]};
}

Point3 normal_of(const std::vector<Point3>& points, const Triangle& t) {
    return cross(minus(points[t[1]], points[t[0]]), minus(points[t[2]], points[t[0]]));
}

/// The triangles of a soup, through all surfaces.
struct FlatSoup {
    std::vector<Point3> points;
    std::vector<Triangle> triangles;
};

FlatSoup flattened(const MovedSoup& soup) {
    FlatSoup flat;
    for (const Surface& s : soup.surfaces) {
        const auto first = static_cast<std::uint32_t>(flat.points.size());
        flat.points.insert(flat.points.end(), s.vertices.begin(), s.vertices.end());
        for (const Triangle& t : s.triangles)
            flat.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    return flat;
}

/// Returns where the points were that a place in a triangle stands for: the mean of the pasts of the
/// corners, weighted by barycentric coordinates.
Past past_within(const Point3& p, const Triangle& t, std::span<const Point3> points,
                 std::span<const Past> past) {
    std::array<double, 3> share{};
    for (std::size_t i = 0; i < 3; ++i)
        share[i] =
            length(cross(minus(points[t[(i + 1) % 3]], p), minus(points[t[(i + 2) % 3]], p)));
    const double sum = share[0] + share[1] + share[2];
    Past result;
    for (std::size_t i = 0; i < 3; ++i) result.add(sum > 0 ? share[i] / sum : 1.0 / 3, past[t[i]]);
    return result;
}

} // namespace

TracedMesh traced(const Mesh& mesh) {
    std::vector<std::uint32_t> order(mesh.vertices.size()), number(order.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::tie(mesh.vertices[a], a) < std::tie(mesh.vertices[b], b);
    });
    TracedMesh result;
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        number[order[i]] = i;
        result.mesh.vertices.push_back(mesh.vertices[order[i]]);
    }
    std::vector<std::pair<Triangle, std::uint32_t>> triangles;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& c = mesh.triangles[t];
        triangles.emplace_back(rotated({number[c[0]], number[c[1]], number[c[2]]}), t);
    }
    std::sort(triangles.begin(), triangles.end());
    result.mesh.surfaces = mesh.surfaces;
    for (const auto& [corners, t] : triangles) {
        const auto origin = static_cast<std::uint32_t>(result.mesh.triangles.size());
        result.mesh.triangles.push_back(corners);
        result.mesh.surfaces_of.push_back(mesh.surfaces_of[t]);
        result.cells.push_back({corners, {}});
        for (const std::uint32_t s : mesh.surfaces_of[t])
            result.cells.back().layers.push_back({s, origin});
    }
    for (const Point3& p : result.mesh.vertices) result.past.push_back({p, p, 0});
    return result;
}

MovedSoup soup_of(const Complex& complex, std::span<const SurfaceInfo> surfaces) {
    MovedSoup soup;
    std::vector<std::vector<std::pair<Triangle, CellLayer>>> triangles(surfaces.size());
    for (const Cell& cell : complex.cells())
        for (const CellLayer& layer : cell.layers) {
            Triangle t = cell.corners;
            if (layer.is_turned) std::swap(t[1], t[2]);
            triangles[layer.surface].emplace_back(t, layer);
        }
    for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
        Surface surface{surfaces[s].name, surfaces[s].role, {}, {}};
        std::vector<std::uint32_t> used;
        for (const auto& [t, layer] : triangles[s]) used.insert(used.end(), t.begin(), t.end());
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for (const std::uint32_t v : used) {
            surface.vertices.push_back(complex.points()[v]);
            soup.past.push_back(complex.past(v));
        }
        for (auto [t, layer] : triangles[s]) {
            for (std::uint32_t& v : t)
                v = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), v) -
                                               used.begin());
            surface.triangles.push_back(t);
            layer.is_turned = layer.is_folded = false;
            soup.layers.push_back(layer);
        }
        soup.surfaces.push_back(std::move(surface));
    }
    return soup;
}

TracedMesh traced(const Mesh& mesh, const MovedSoup& soup, double rounded) {
    const FlatSoup flat = flattened(soup);
    TracedMesh result;
    result.mesh = mesh;
    std::vector<std::optional<Past>> past(mesh.vertices.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        Cell cell{mesh.triangles[t], {}};
        const Point3 normal = normal_of(mesh.vertices, cell.corners);
        for (const std::uint32_t parent : mesh.parents_of[t]) {
            CellLayer layer = soup.layers[parent];
            const Triangle& whole = flat.triangles[parent];
            for (const std::uint32_t v : cell.corners) {
                const Past there = past_within(mesh.vertices[v], whole, flat.points, soup.past);
                if (past[v])
                    past[v]->unite(there);
                else
                    past[v] = there;
            }
            if (!cell.layers.empty() && cell.layers.back().surface == layer.surface) continue;
            layer.is_turned = dot(normal, normal_of(flat.points, whole)) < 0;
            cell.layers.push_back(layer);
        }
        result.cells.push_back(std::move(cell));
    }
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        result.past.push_back(past[v].value_or(Past{mesh.vertices[v], mesh.vertices[v], 0}));
        result.past.back().slack += rounded;
    }
    return result;
}

} // namespace terrane::simplification::detail
