// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <terrane/algorithms/verify/detail/box_tree.hpp>
#include <terrane/algorithms/verify/detail/exact_mesh.hpp>
#include <terrane/algorithms/verify/detail/violations.hpp>

namespace terrane::verifier {

/// A triangle through which a ray passes.
struct Passed {
    std::uint32_t triangle = 0;
    int side = 0; ///< 1: its corners are counterclockwise in the projection along the ray; else -1
};

/// Casts rays in the direction of an axis through some triangles of a mesh, to which it holds a reference. Each ray is
/// moved aside, by e in the next coordinate and e^2 in the one after that, for an e that is smaller than all lengths in
/// the mesh, so that it meets no edge.
/// Cost: n log n for n triangles; per ray, exact tests of those in whose boxes its point is in the projection.
class Rays {
public:
    Rays(const ExactMesh& mesh, const Numbers& triangles, std::size_t axis);

    /// Returns the triangles that are strictly above a point and that its ray passes, ascending.
    [[nodiscard]] std::vector<Passed> cast(const Vector4& point) const;

private:
    [[nodiscard]] int side_of(const Vector4& a, const Vector4& b, const Vector4& point) const;

    const ExactMesh& mesh_;
    std::size_t axis_, u_, v_;
    BoxTree tree_;
};

} // namespace terrane::verifier
