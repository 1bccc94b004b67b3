// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/partition.hpp>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/verify/detail/edges.hpp>

namespace terrane::verifier {

namespace {

/// Twice an area, as a fraction that is not reduced; denominator > 0.
struct AreaFraction {
    mpz_class numerator = 0;
    mpz_class denominator = 1;
};

/// Adds areas recursively by halves, so that numbers of similar size are multiplied.
AreaFraction sum(std::span<const AreaFraction> areas) {
    if (areas.empty()) return {};
    if (areas.size() == 1) return areas.front();
    const AreaFraction a = sum(areas.first(areas.size() / 2));
    const AreaFraction b = sum(areas.subspan(areas.size() / 2));
    return {a.numerator * b.denominator + b.numerator * a.denominator,
            a.denominator * b.denominator};
}

/// Returns twice the signed area between the origin and an edge in a projection. The sum over the
/// borders of counterclockwise triangles is twice the sum of their areas.
AreaFraction area_beside(const Vector4& from, const Vector4& to, std::size_t axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    return {from[u] * to[v] - from[v] * to[u], from[3] * to[3]};
}

/// Returns the areas next to all edges of the children, each of which is made counterclockwise. An
/// edge that occurs in both directions, as most edges do, contributes nothing and is left out.
std::vector<AreaFraction> areas_beside_borders(const ExactMesh& mesh,
                                               std::span<const std::uint32_t> children,
                                               std::size_t axis) {
    std::map<Edge, int> runs; // number of times from lower to higher index, minus the reverse
    for (const std::uint32_t child : children) {
        Triangle t = mesh.triangles[child];
        if (sgn(mesh.planes[child][axis]) < 0) std::swap(t[1], t[2]);
        for (const HalfEdge& side : sides_of(t)) runs[side.edge] += side.ascends ? 1 : -1;
    }
    std::vector<AreaFraction> areas;
    for (const auto& [edge, count] : runs) {
        if (count == 0) continue;
        areas.push_back(area_beside(mesh.points[edge[0]], mesh.points[edge[1]], axis));
        areas.back().numerator *= count;
    }
    return areas;
}

} // namespace

Partition::Partition(const std::array<const Vector4*, 3>& parent, const ExactMesh& mesh) :
    mesh_(mesh), corners_(parent), plane_(orthogonal(*parent[0], *parent[1], *parent[2])),
    axis_(projection_axis(plane_).value()) {
    if (sgn(plane_[axis_]) < 0) std::swap(corners_[1], corners_[2]);
}

bool Partition::holds(const Triangle& child) const {
    return std::all_of(child.begin(), child.end(), [this](std::uint32_t vertex) {
        const Vector4& point = mesh_.points[vertex];
        if (sgn(dot(plane_, point)) != 0) return false;
        for (std::size_t i = 0; i < 3; ++i) {
            if (sgn(turn(*corners_[i], *corners_[(i + 1) % 3], point, axis_)) < 0) return false;
        }
        return true;
    });
}

bool Partition::areas_add_up(std::span<const std::uint32_t> children) const {
    std::vector<AreaFraction> areas = areas_beside_borders(mesh_, children, axis_);
    for (std::size_t i = 0; i < 3; ++i) {
        areas.push_back(area_beside(*corners_[(i + 1) % 3], *corners_[i], axis_));
    }
    return sgn(sum(areas).numerator) == 0;
}

} // namespace terrane::verifier
