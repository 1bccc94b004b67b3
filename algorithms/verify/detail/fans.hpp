// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Triangles around vertices that many of them have in common. Their boxes all touch, so that a tree of boxes would
// pair each of them with each.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <terrane/algorithms/verify/detail/box_tree.hpp>
#include <terrane/algorithms/verify/detail/exact_mesh.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>

namespace terrane::verifier {

/// The triangles at one vertex, the hub. Two that have only the hub in common meet properly unless the
/// angles that they fill there have a direction in common; two with a side at the hub in common, unless they are
/// in one half of a plane.
/// Cost: O(n log n), and O(log n + k) for the k triangles that are found.
class Fan {
public:
    /// `triangles` are those at the hub that have area, ascending.
    Fan(const ExactMesh& mesh, std::uint32_t hub, Numbers triangles);

    /// Adds all triangles of the fan that may meet one of them improperly.
    void add_near(std::uint32_t triangle, Numbers& found) const;

private:
    using HalfPlane = std::pair<std::uint32_t,
                                Vector4>; ///< a vertex of its border besides the hub, and the plane

    [[nodiscard]] Box directions(std::uint32_t triangle) const;
    [[nodiscard]] HalfPlane half_plane(std::uint32_t triangle, std::uint32_t end) const;

    const ExactMesh& mesh_;
    std::uint32_t hub_;
    Numbers triangles_;
    Numbers
        ends_; ///< per triangle the group in the tree: a second vertex that many have in common, or no_number
    std::map<HalfPlane, Numbers> half_planes_; ///< triangles at those second vertices
    BoxTree tree_;                             ///< over positions in triangles_
};

/// Finds the triangles that may meet one improperly.
class ContactSearch {
public:
    explicit ContactSearch(const ExactMesh& mesh);

    /// Returns all of them, ascending.
    [[nodiscard]] Numbers near(std::uint32_t triangle) const;

    [[nodiscard]] const Numbers& with_area() const { return with_area_; }

private:
    const ExactMesh& mesh_;
    Numbers with_area_;
    Numbers hubs_; ///< per triangle the vertex that most have in common, if many do, or no_number
    std::map<std::uint32_t, Fan> fans_; ///< by their hubs
    BoxTree tree_;
};

} // namespace terrane::verifier
