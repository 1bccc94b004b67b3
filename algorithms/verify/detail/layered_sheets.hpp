// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Layers and the surfaces that they were made of, seen along z, for the rules about layers.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/detail/box_tree.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/plan_view.hpp>

namespace terrane::verifier {

Box without_height(Box box);

/// A triangle, seen from above.
struct Seen {
    std::uint32_t number = 0; ///< in its mesh or its input surface
    UpwardCorners corners{};  ///< counterclockwise in the projection
    bool flipped = false;     ///< the triangle faces down
};

/// Triangles of a surface or a layer that are not upright, with a tree of their projections.
struct Sheet {
    std::vector<Seen> triangles;
    std::vector<Box> boxes; ///< with heights
    BoxTree tree;           ///< of the boxes without heights

    void add(const Seen& seen, const Box& box) {
        triangles.push_back(seen);
        boxes.push_back(box);
    }
    void finish();
};

/// An edge of a sheet in its projection, with the sides on which triangles are: 1 is the left of
/// the direction from the lower to the higher vertex.
using EdgeSides = std::map<Edge, std::vector<int>>;

/// Adds the edges of a triangle whose corners have these numbers.
void add_sides(const Seen& t, const Triangle& numbers, EdgeSides& edges);
bool has_both_sides(const std::vector<int>& sides);

/// The surfaces of layers, their borders, and the layers. Numbers are scaled to integers.
struct LayerSheets {
    /// The arguments must outlive the object. Precondition: all indices are in range.
    LayerSheets(std::span<const Surface> surfaces, const LayeredClaim& layered);
    LayerSheets(const LayerSheets&) = delete; // triangles point to `points`
    LayerSheets& operator=(const LayerSheets&) = delete;

    /// Must be called first. It reports a surface with an upright triangle (R60), and returns false
    /// then.
    bool find(Violations& found);

    [[nodiscard]] std::string name(std::uint32_t layer) const;
    [[nodiscard]] bool is_harder(std::uint32_t i, std::uint32_t j) const;
    /// Returns the numbers of the borders near a box in the projection.
    [[nodiscard]] Numbers borders_near(const Box& box) const;

    /// Returns the triangles of the surface of a layer whose boxes are near a box.
    [[nodiscard]] Numbers near_triangles(std::uint32_t layer, const Box& box) const;
    /// Returns one of these triangles of the surface of a layer that is within d of all points.
    [[nodiscard]] std::optional<std::uint32_t>
    near_one(std::uint32_t layer, std::span<const Vector4> around, const Numbers& candidates) const;
    [[nodiscard]] bool is_near(const Vector4& point, const Seen& s) const;
    /// Tells whether a triangle of the mesh faces aside: it is upright, or a corner is within 2 d of
    /// the opposite side in the projection.
    [[nodiscard]] bool faces_aside(std::uint32_t t) const { return aside_[t]; }
    /// Finds on which sides of the edges of a layer its triangles are. A triangle that faces aside
    /// is put on the side on which more of its neighbours leave room.
    [[nodiscard]] EdgeSides sides_of_layer(std::uint32_t layer) const;

    std::span<const Surface> inputs;
    const LayeredClaim& claim;
    Numbers first;                         ///< per layer: the first point of its surface
    std::vector<Vector4> points;           ///< of the mesh, then of the surfaces
    mpz_class scale;                       ///< of `points` and of the lengths below
    mpz_class deviation, width;            ///< d, 2 d
    mpz_class thickness;                   ///< D; 0: there is none
    double reach = 0;                      ///< more than both
    std::vector<Sheet> surfaces;           ///< per layer: its surface
    std::vector<Sheet> layers;             ///< per layer: its triangles of the mesh
    std::vector<Box> boxes;                ///< per triangle of the mesh
    std::vector<std::optional<Seen>> seen; ///< per triangle of the mesh; none: it is upright
    std::vector<SegmentInPlan> borders;    ///< of all surfaces
    std::vector<Vector4> border_points;    ///< their ends, at height 0
    std::vector<Triangle> border_edges;    ///< indices into these

private:
    [[nodiscard]] std::optional<Seen> seen_of(std::uint32_t number, const Triangle& t,
                                              std::uint32_t first_point) const;
    [[nodiscard]] bool has_area(const Triangle& t, std::uint32_t first_point) const;
    [[nodiscard]] bool is_thin(const Seen& t) const;
    bool find_surfaces(Violations& found);
    void find_borders();
    void find_layers();

    std::vector<Point3> doubles_; ///< that `points` were made of
    std::vector<bool> aside_;     ///< per triangle of the mesh
    BoxTree border_tree_;
};

} // namespace terrane::verifier
