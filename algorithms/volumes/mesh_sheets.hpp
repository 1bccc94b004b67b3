// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/volumes/complex.hpp>

namespace terrane::volumes {

/// Views a mesh of doubles as a complex, all of whose vertices are input points. The triangles must
/// outlive it.
class MeshSheets {
public:
    MeshSheets(std::span<const Point3> vertices, std::span<const Triangle> triangles,
               const Run& run = {}) :
        triangles_(triangles),
        points_(std::vector<Point3>(vertices.begin(), vertices.end())), vertices_(vertices.size()),
        edges_(group_edges(triangles, vertices.size(), run)) {
        std::iota(vertices_.begin(), vertices_.end(), PointIndex{0});
    }
    [[nodiscard]] TriangleComplex view() const {
        return {points_, vertices_, triangles_, edges_, triangles_, nullptr};
    }

private:
    std::span<const Triangle> triangles_;
    PointStore points_;
    std::vector<PointIndex> vertices_;
    EdgeSides edges_;
};

} // namespace terrane::volumes
