// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The surface as it was: what an improved mesh is held to. Private to improve.
//
// Guarantee of contains_within_tolerance(): every point of the triangle is within the bound of its sheet as it was.
// Two reasons are tried, on the triangle and, where both fail, on parts of it:
// (1) Along its normal, or along an axis, the triangle, drawn in a little, is covered. A set of
//     triangles of the sheet, all wound alike in this projection, is spread from one that meets it
//     over every edge that meets it, and meets no curve edge. Over the triangle, which is connected
//     and simply connected, that set is a covering, so one part of it is the graph of a function
//     over it. The difference in height is linear on each common part: bounded at its corners.
// (2) All its corners are within the bound of one triangle of the sheet: the distance to a convex
//     set is a convex function.
// Rounding errors are counted in. Cost: about the number of triangles that it covers.
//
// A triangle of the input is alone where it is farther from all other sheets than both bounds
// together: what follows such triangles only can't meet another sheet that follows itself.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/quality/detail/features.hpp>
#include <terrane/kernel/construction.hpp>

namespace terrane::improving {

/// Triangles whose area is a smaller share of the square of their longest edge (times two) are so
/// thin that rounding may take their normal: nothing is looked for along it. Leaving them out can
/// only make a bound larger.
constexpr double thinnest = 1e-6;

using Corners = std::array<Point3, 3>;

/// No less than the distance of p to the triangle, but for rounding: to a point that is on it,
/// however ill-shaped.
double to_triangle(const Point3& p, const Point3& a, const Point3& b, const Point3& c);

class ReferenceSurface {
public:
    /// bound_of: per sheet. Of the features, the triangles, sheet_of and across are looked at.
    /// What is named must outlive it.
    ReferenceSurface(std::span<const Point3> points, const Features& features,
                     std::span<const double> bound_of);

    /// Finds the triangles that are alone; until then none is.
    void find_isolated(const Run& run);

    [[nodiscard]] bool is_isolated(std::uint32_t t) const { return facets_[t].isolated; }

    /// The least bound that is told apart from rounding errors.
    [[nodiscard]] double least_bound() const { return 1e3 * slack_; }
    /// More than rounding puts into a distance.
    [[nodiscard]] double rounding() const { return slack_; }

    struct Containment {
        std::uint32_t hint = 0; ///< a triangle of the sheet near the middle
        bool isolated = true;   ///< every triangle used is isolated
    };
    /// What a thread that asks has to itself; its contents mean nothing to it.
    class Search {
        friend class ReferenceSurface;
        std::vector<std::uint32_t> seen_; ///< per triangle: the last search that saw it
        std::uint32_t number_ = 0;        ///< of the search at hand
        std::vector<std::uint32_t> front_;
        bool all_isolated_ = true; ///< of the triangles that it has visited
    };
    /// Whether the triangle is shown to be within the bound of the sheet of the triangle `hint`.
    [[nodiscard]] std::optional<Containment>
    contains_within_tolerance(const Corners& triangle, std::uint32_t hint, Search& search) const;

    struct Place {
        Point3 point;           ///< on the surface, but for rounding
        std::uint32_t triangle; ///< on which it lies
    };
    /// The point of the sheet of `hint` straight above or below p along the axis in which the
    /// normal is longest; none where the way there meets a curve or a fold.
    [[nodiscard]] std::optional<Place> above(const Point3& p, const Point3& normal,
                                             std::uint32_t hint) const;

private:
    struct Flat {
        double u = 0, v = 0, w = 0; ///< in a projection, relative to an origin; w is along it
    };
    /// Directions in which flat coordinates are measured, and whether they are axes.
    struct Frame {
        Point3 u, v, w;
        std::optional<Axis> axis;

        [[nodiscard]] Flat flat(const Point3& d) const {
            if (!axis)
                return {u.x * d.x + u.y * d.y + u.z * d.z, v.x * d.x + v.y * d.y + v.z * d.z,
                        w.x * d.x + w.y * d.y + w.z * d.z};
            if (*axis == Axis::x) return {d.y, d.z, d.x};
            if (*axis == Axis::y) return {d.z, d.x, d.y};
            return {d.x, d.y, d.z};
        }
    };
    /// A triangle drawn in, in one projection.
    struct Target {
        Frame frame;
        int orientation = 1;         ///< +1: counterclockwise in the projection
        Point3 origin;               ///< of the flat coordinates
        std::array<Flat, 3> corners; ///< drawn in
        Flat middle;
        double slope_u = 0, slope_v = 0; ///< height of its plane: slope_u u + slope_v v
        double error = 0;                ///< of a height, per unit of distance
        /// A point at d from the origin has measures x dx + y dy + z dz - off: three times how far
        /// it lies inside of an edge, times its length; and the height over the plane. Side by
        /// side, so that one instruction does several.
        struct Measures {
            std::array<double, 4> x, y, z, off;
        };
        Measures measures{};
        double spread = 0; ///< sum of the sizes in a measure, the largest: errors are a share of it
        double radius = 0; ///< of the corner farthest from the origin
        double bound = 0;  ///< of heights
    };
    struct Walk {
        std::uint32_t end = 0;
        bool arrived = false;
    };
    enum class Cover : std::uint8_t { near, far, open }; ///< open: not covered, or not for sure

    static Frame frame_of(Axis axis);
    static Frame frame_along(const Point3& normal, const Point3& side);
    /// None for a triangle so thin that the heights of its plane mean nothing.
    static void set_measures(Target& target);
    [[nodiscard]] static std::optional<Target> target_of(const Corners& triangle, double bound,
                                                         bool along_axis);
    /// How the triangle is wound in the projection; 0 where that is not sure.
    [[nodiscard]] int orientation_of(std::uint32_t t, const Frame& frame) const;
    [[nodiscard]] Walk walk(const Frame& frame, const Point3& origin, const Flat& to,
                            int orientation, std::uint32_t from) const;
    Cover covered(const Target& target, std::uint32_t start, Search& search) const;
    Cover visit(const Target& target, std::uint32_t t, Search& search) const;
    [[nodiscard]] static bool is_near(const Target& target, const Corners& facet,
                                      const std::array<double, 3>& heights);
    [[nodiscard]] bool near_one(const Corners& triangle, std::uint32_t t, double bound) const;
    bool contains_part(const Corners& triangle, Containment& containment, double bound,
                       unsigned& budget, Search& search) const;
    [[nodiscard]] bool is_beyond_plane(std::uint32_t t, std::uint32_t of, double gap) const;

    std::span<const Point3> points_;
    const Features& features_;
    std::span<const double> bound_of_;
    /// All that searches look at, in one place: what they cost is mostly to get it.
    struct alignas(64) Facet {
        Corners corners;
        Point3 normal;
        double error = 0; ///< of each coordinate of the normal, at most
        double lean = 0;  ///< its height in a frame tells how it is wound only beyond that
        std::array<std::uint32_t, 3> across{};     ///< as in the features
        std::array<std::int8_t, 3> orientations{}; ///< per axis, exactly
        bool isolated = false;
    };
    std::vector<Facet> facets_; ///< per triangle
    double slack_ = 0;          ///< more than the errors of distances from rounded coordinates
};

} // namespace terrane::improving
