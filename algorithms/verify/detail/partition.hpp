// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Internal to the verifier: rule R6, whether an input triangle is the union of others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/detail/contacts.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>

namespace terrane::verifier {

/// One input triangle (the parent) and the triangles of a mesh that name it (its children).
/// Children that lie within the parent, meet properly (R5) and have its area together cover it:
/// what they left open would have area, as they are closed.
/// Holds references to the points and the mesh.
class Partition {
public:
    /// Precondition: the parent has area.
    Partition(const std::array<const Vector4*, 3>& parent, const ExactMesh& mesh);

    /// Whether all corners of a triangle of the mesh lie in the (closed) parent.
    [[nodiscard]] bool holds(const Triangle& child) const;

    /// Whether the areas of the children add up to that of the parent, exactly.
    /// Precondition: the parent holds them.
    [[nodiscard]] bool areas_add_up(std::span<const std::uint32_t> children) const;

private:
    const ExactMesh& mesh_;
    std::array<const Vector4*, 3> corners_; ///< counterclockwise in the projection
    Vector4 plane_;
    std::size_t axis_; ///< that the projection drops
};

} // namespace terrane::verifier
