// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Coordinates in which nearly coplanar clusters are coplanar. Triangles in one inclined plane cross
// each other all over once their corners are doubles, on binary grids, too. With the normal of the
// plane as a coordinate axis, all of them have the same coordinate on it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <terrane/algorithms/mesh/point_table.hpp>
#include <terrane/algorithms/rounding/detail/input_frame.hpp>

namespace terrane::rounding::detail {

/// Measures points along three directions from an origin.
///
/// (1) Coordinates of chosen points on an axis that differ by less than twice the tolerance become
///     the same one.
/// (2) If those of all chosen points are multiples of one length within the tolerance, they become
///     the integers: points of a lattice, turned in any way, are then in planes and lines exactly.
class ClusterFrame : public InputFrame {
public:
    /// Returns the frame with these axes, completed by directions across them. `normals`: one to
    /// three unit vectors that are not in one plane; `chosen`: per point. Returns nothing if no
    /// point is chosen, or if the frame has no finite error.
    static std::optional<ClusterFrame> of(std::span<const Point3> points,
                                          const std::vector<bool>& chosen,
                                          std::span<const Point3> normals, double tolerance);
    /// Does the same for the chosen points alone: keep_place() and state_largest_error() have to follow.
    static std::optional<ClusterFrame> of_chosen(std::span<const Point3> points,
                                                 std::span<const Point3> normals, double tolerance);

    /// Notes where back() takes a place of input points: to the first of them.
    void keep_place(const Point3& place, const Point3& given) { given_.try_emplace(place, given); }
    /// Bounds the distance between given and its place, or another input point and this place.
    [[nodiscard]] double error_of_place(const Point3& place, const Point3& given) const {
        return error_between(place, given, {});
    }

    [[nodiscard]] Point3 into(const Point3& p) const override;
    [[nodiscard]] Point3 back(const Point3& q) const override;
    [[nodiscard]] double error_of(const Point3& q,
                                  const std::array<double, 3>& errors) const override;

private:
    /// Values along an axis that become one coordinate.
    struct Group {
        double least = 0, largest = 0; ///< values along the normal, from the origin
        double coordinate = 0;         ///< in the frame
    };
    struct Axis {
        Point3 normal;             ///< values are measured along it
        Point3 step;               ///< exactly where a coordinate that grows by 1 leads
        double unit = 1;           ///< length along the normal of a coordinate of 1
        bool is_lattice = false;   ///< whether the coordinates of groups are integers
        double base = 0;           ///< value of coordinate 0
        double shift = 0;          ///< the same in the frame: coordinate + shift steps
                                   ///< lead from the origin to a place
        double tolerance = 0;      ///< how near to a group a value must be to become part of it
        std::vector<Group> groups; ///< of the chosen points, ascending

        void find_groups(std::vector<double> values);
        void number_lattice();
        [[nodiscard]] double coordinate_of(double value) const;
    };

    void set_steps();
    void keep_places(std::span<const Point3> points);
    [[nodiscard]] double error_between(const Point3& q, const Point3& given,
                                       const std::array<double, 3>& errors) const;

    Point3 origin_;
    std::array<Axis, 3> axes_;
    std::unordered_map<Point3, Point3, PointHash> given_; ///< per place of an input point: a point
};

} // namespace terrane::rounding::detail
