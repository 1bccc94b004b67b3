// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/detail/block_volumes.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane::quality::detail {

BlockVolumes::BlockVolumes(const Mesh& mesh, const Features& features,
                           std::vector<std::array<std::uint32_t, 2>> sides, std::size_t count) :
    features_(features),
    sides_(std::move(sides)), origin_(count), area_(count, 0), largest_move_(count, 0) {
    std::vector<char> has_origin(count, 0);
    for (std::size_t t = 0; t < features.triangles.size(); ++t) {
        const auto& [a, b, c] = features.triangles[t];
        const Point3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
        const auto [front, behind] = sides_[features.sheet_of[t]];
        if (front == behind) continue;
        for (const std::uint32_t volume : {front, behind}) {
            if (std::exchange(has_origin[volume], 1) == 0) origin_[volume] = p;
            area_[volume] += length(cross(minus(q, p), minus(r, p))) / 2;
        }
    }
    before_ = sums(mesh.vertices, features.triangles, features.sheet_of);
}

/// Adds up the signed tetrahedra between the borders of volumes and their origins, times six.
std::vector<double> BlockVolumes::sums(std::span<const Point3> points,
                                       std::span<const Triangle> triangles,
                                       std::span<const std::uint32_t> sheet_of) const {
    std::vector<double> sums(origin_.size(), 0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Triangle& corners = triangles[t];
        if (corners[0] == none) continue; // not in use
        const auto [front, behind] = sides_[sheet_of[t]];
        if (front == behind) continue;
        const auto add = [&](std::uint32_t volume, double sign) {
            const auto from_origin = [&](int corner) {
                return minus(points[corners[corner]], origin_[volume]);
            };
            sums[volume] += sign * dot(from_origin(0), cross(from_origin(1), from_origin(2)));
        };
        add(front, 1);
        add(behind, -1);
    }
    return sums;
}

bool BlockVolumes::limit_bounds(const WorkMesh& now, double share, double least,
                                std::span<const double> bound_of, std::vector<double>& bounds) {
    const auto after = sums(now.points, now.triangles, now.sheet_of);
    bool is_limited = false;
    for (std::size_t v = 1; v < after.size(); ++v) {
        if (std::fabs(after[v] - before_[v]) <= share * std::fabs(before_[v])) continue;
        const double move = largest_move_[v] > 0 ? largest_move_[v] / 2
                                                 : share * std::fabs(before_[v]) / 6 / area_[v];
        largest_move_[v] = std::max(move, least);
        is_limited = true;
    }
    if (!is_limited) return false;
    if (bounds.empty())
        for (const std::uint32_t sheet : features_.sheet_of) bounds.push_back(bound_of[sheet]);
    bool is_smaller = false;
    for (std::size_t t = 0; t < bounds.size(); ++t) {
        const auto& sides = sides_[features_.sheet_of[t]];
        if (sides[0] == sides[1]) continue;
        for (const std::uint32_t v : sides) {
            if (!(largest_move_[v] > 0) || !(largest_move_[v] < bounds[t])) continue;
            bounds[t] = largest_move_[v];
            is_smaller = true;
        }
    }
    return is_smaller;
}

std::size_t BlockVolumes::limited() const {
    return static_cast<std::size_t>(std::count_if(largest_move_.begin(), largest_move_.end(),
                                                  [](double move) { return move > 0; }));
}

} // namespace terrane::quality::detail
