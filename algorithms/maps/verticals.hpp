// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Vertical lines and the triangles that they meet.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {

/// A way in which a vertical is moved: by (x e, y e^2) in the map, for an infinitely small e > 0.
struct VerticalShift {
    int x = 1, y = 1; ///< each 1 or -1
};
inline constexpr std::array<VerticalShift, 4> vertical_shifts{{{1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};

/// Tells whether the vertical through p meets a triangle that turns so in the map, or its border.
inline bool meets(const std::array<Point3, 3>& t, Sign turn, const Point3& p) {
    return orient2d(Axis::z, t[0], t[1], p) != -turn && orient2d(Axis::z, t[1], t[2], p) != -turn &&
           orient2d(Axis::z, t[2], t[0], p) != -turn;
}

/// Returns the set of shifts by which the moved vertical through p meets a triangle that turns so in the map: bit k is
/// that of vertical_shifts[k].
std::uint8_t shifts_that_meet(const std::array<Point3, 3>& t, Sign turn, const Point3& p);

/// Returns by how much a triangle, which is not vertical, falls per unit along x and y: the doubles nearest to the
/// exact numbers.
std::array<double, 2> fall_of(const std::array<Point3, 3>& t);

/// The height of the plane of a triangle on a vertical that meets the triangle.
class VerticalHeight {
public:
    /// t: not vertical, and with as long a life. The height differs from the exact one by at most 2^-45 of the
    /// greatest height of a corner; at a corner it is that of the corner.
    VerticalHeight(const std::array<Point3, 3>& t, const Point3& p);

    [[nodiscard]] double z() const { return z_; }
    /// Returns how the exact heights of two triangles on the same vertical compare.
    [[nodiscard]] Sign compare(const VerticalHeight& other) const;
    /// The same on the vertical moved so; Zero only if the planes of the triangles are the same.
    [[nodiscard]] Sign compare(const VerticalHeight& other, const VerticalShift& shift) const;

private:
    std::array<Point3, 3> corners_;
    Point3 place_;
    double z_, error_ = 0;
};

/// A point in which a vertical meets a triangle.
struct VerticalCrossing {
    std::size_t node = 0;
    double z = 0;
    std::uint32_t triangle = 0;
    std::uint32_t above = 0; ///< volume
};

/// A triangle near a vertical that meets it for some shifts.
struct VerticalCandidate {
    VerticalCrossing crossing;
    VerticalHeight height;
    std::uint8_t shifts = 0;
};

/// Returns the crossings of each vertical by the first of the shifts that has any: by node, then upwards. The order is
/// exact, also where triangles meet on the vertical.
std::vector<VerticalCrossing> in_order(std::vector<VerticalCandidate> candidates);

/// Returns where the verticals through the nodes, moved as in_order() says, meet triangles.
/// for_near(corners, visit) calls visit(node, place) for all nodes that may lie in the triangle in the map.
template <class ForNear>
std::vector<VerticalCrossing> vertical_crossings(const Mesh& mesh, const Volumes& volumes,
                                                 const ForNear& for_near) {
    std::vector<VerticalCandidate> found;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [i, j, k] = mesh.triangles[t];
        const std::array corners{mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]};
        const Sign turn = orient2d(Axis::z, corners[0], corners[1], corners[2]);
        if (turn == Sign::Zero) continue;
        const std::uint32_t above = volumes.of_sides[t][turn == Sign::Positive ? 0 : 1];
        for_near(corners, [&](std::size_t node, const Point3& p) {
            const std::uint8_t shifts = shifts_that_meet(corners, turn, p);
            if (shifts == 0) return;
            const VerticalHeight height(corners, p);
            found.push_back({{node, height.z(), t, above}, height, shifts});
        });
    }
    return in_order(std::move(found));
}

} // namespace terrane
