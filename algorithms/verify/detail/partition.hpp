// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rule R6 of the verifier: whether an input triangle is the union of other triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/detail/contacts.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>

namespace terrane::verifier {

/// Judges an input triangle (the parent) and the triangles of a mesh that name it (its children).
/// Children that lie in the parent, meet properly (R5) and have a total area equal to its area
/// cover it: they are closed, so an uncovered part would have area.
/// It holds references to the points and the mesh.
class Partition {
public:
    /// Precondition: the parent has area.
    Partition(const std::array<const Vector4*, 3>& parent, const ExactMesh& mesh);

    /// Tells whether all corners of a triangle of the mesh lie in the (closed) parent.
    [[nodiscard]] bool holds(const Triangle& child) const;

    /// Tells whether the areas of the children add up to that of the parent exactly.
    /// Precondition: the parent holds the children.
    [[nodiscard]] bool areas_add_up(std::span<const std::uint32_t> children) const;

private:
    const ExactMesh& mesh_;
    std::array<const Vector4*, 3> corners_; ///< counterclockwise in the projection
    Vector4 plane_;
    std::size_t axis_; ///< the coordinate that the projection drops
};

} // namespace terrane::verifier
