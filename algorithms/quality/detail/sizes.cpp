// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/detail/sizes.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/quality/detail/constants.hpp>
#include <terrane/algorithms/quality/detail/curvature.hpp>

namespace terrane::quality::detail {
namespace {

Point3 normal_of(const Mesh& mesh, const Triangle& t) {
    return cross(minus(mesh.vertices[t[1]], mesh.vertices[t[0]]),
                 minus(mesh.vertices[t[2]], mesh.vertices[t[0]]));
}

/// Computes, for each surface, the edge length of as many equilateral triangles of the same area.
std::vector<double> automatic_lengths(const Mesh& mesh) {
    std::vector<double> area(mesh.surfaces.size(), 0);
    std::vector<std::size_t> count(mesh.surfaces.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t s : mesh.surfaces_of[t]) {
            area[s] += length(normal_of(mesh, mesh.triangles[t])) / 2;
            ++count[s];
        }
    for (std::size_t s = 0; s < area.size(); ++s)
        if (count[s] > 0)
            area[s] = std::sqrt(area[s] / static_cast<double>(count[s]) * 4 / std::sqrt(3.0));
    return area;
}

std::vector<double> lengths_of_surfaces(const Mesh& mesh, const ImproveOptions& options) {
    std::vector<double> lengths(mesh.surfaces.size(), options.edge_length);
    for (std::size_t s = 0; s < options.edge_length_of.size(); ++s)
        if (options.edge_length_of[s] > 0) lengths[s] = options.edge_length_of[s];
    if (std::find(lengths.begin(), lengths.end(), 0.0) == lengths.end()) return lengths;
    const auto automatic = automatic_lengths(mesh);
    for (std::size_t s = 0; s < lengths.size(); ++s)
        if (lengths[s] == 0) lengths[s] = automatic[s];
    return lengths;
}

/// Computes, per vertex, the edge of an equilateral triangle as large as the largest one at the
/// vertex or at its neighbours: the slivers along intersections are next to larger triangles.
std::vector<double> edges_of_largest(const Mesh& mesh, const Features& features) {
    std::vector<double> at(mesh.vertices.size(), 0);
    for (const Triangle& t : features.triangles) {
        const double edge = std::sqrt(length(normal_of(mesh, t)) * 2 / std::sqrt(3.0));
        for (const std::uint32_t v : t) at[v] = std::max(at[v], edge);
    }
    std::vector<double> near = at;
    for (const Triangle& t : features.triangles)
        for (const std::uint32_t v : t) near[v] = std::max({near[v], at[t[0]], at[t[1]], at[t[2]]});
    return near;
}

/// Reduces the target length where the sheet turns by more than `turn` along it. Turns are measured
/// over the target length, or over about two triangles where these are smaller.
void limit_by_curvature(const Mesh& mesh, const Features& features, double turn,
                        std::vector<double>& sizes) {
    std::vector<double> reach = edges_of_largest(mesh, features);
    for (std::size_t v = 0; v < sizes.size(); ++v)
        reach[v] = std::min(sizes[v], constants.turn_reach * reach[v]);
    const auto turns = turns_per_length(mesh, features, reach);
    for (std::size_t v = 0; v < sizes.size(); ++v)
        if (turns[v] * sizes[v] > turn)
            sizes[v] = std::max(turn / turns[v], constants.curvature_floor * sizes[v]);
}

} // namespace

Sizes find_sizes(const Mesh& mesh, const Features& features, const ImproveOptions& options) {
    const auto lengths = lengths_of_surfaces(mesh, options);
    constexpr double endless = std::numeric_limits<double>::infinity();
    Sizes out;
    out.bound_of.assign(features.first_of.size(), 0);
    std::vector<double> of_sheets(features.first_of.size(), endless);
    for (std::size_t s = 0; s < of_sheets.size(); ++s) {
        for (const std::uint32_t surface : mesh.surfaces_of[features.first_of[s]])
            of_sheets[s] = std::min(of_sheets[s], lengths[surface]);
        out.bound_of[s] = options.max_deviation > 0 ? options.max_deviation
                                                    : constants.default_tolerance * of_sheets[s];
    }
    out.of_vertices.assign(mesh.vertices.size(), endless);
    for (std::uint32_t t = 0; t < features.triangles.size(); ++t)
        for (const std::uint32_t v : features.triangles[t])
            out.of_vertices[v] = std::min(out.of_vertices[v], of_sheets[features.sheet_of[t]]);
    if (options.curve_length > 0)
        for (std::uint32_t v = 0; v < out.of_vertices.size(); ++v)
            if (features.kinds[v] == VertexKind::curve || features.kinds[v] == VertexKind::corner)
                out.of_vertices[v] = std::min(out.of_vertices[v], options.curve_length);
    if (options.turn > 0)
        limit_by_curvature(mesh, features, options.turn * std::acos(-1.0) / 180, out.of_vertices);
    limit_growth(mesh.vertices, features.triangles, options.growth, out.of_vertices);
    return out;
}

void limit_growth(std::span<const Point3> points, std::span<const Triangle> triangles,
                  double growth, std::vector<double>& sizes) {
    std::vector<std::vector<std::uint32_t>> next(sizes.size());
    for (const Triangle& t : triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            next[t[i]].push_back(t[(i + 1) % 3]);
            next[t[(i + 1) % 3]].push_back(t[i]);
        }
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    for (std::uint32_t v = 0; v < sizes.size(); ++v)
        if (!next[v].empty()) front.emplace(sizes[v], v);
    while (!front.empty()) {
        const auto [size, v] = front.top();
        front.pop();
        if (size > sizes[v]) continue;
        for (const std::uint32_t u : next[v]) {
            const double most = size + growth * length(minus(points[u], points[v]));
            if (!(most < sizes[u])) continue;
            sizes[u] = most;
            front.emplace(most, u);
        }
    }
}

double expected_with_sizes(const Mesh& mesh, const Features& features, const Sizes& sizes) {
    double count = 0;
    for (const Triangle& t : features.triangles) {
        const Point3 n = cross(minus(mesh.vertices[t[1]], mesh.vertices[t[0]]),
                               minus(mesh.vertices[t[2]], mesh.vertices[t[0]]));
        const double size =
            (sizes.of_vertices[t[0]] + sizes.of_vertices[t[1]] + sizes.of_vertices[t[2]]) / 3;
        count += length(n) / 2 / (std::sqrt(3.0) / 4 * size * size);
    }
    return count;
}

} // namespace terrane::quality::detail
