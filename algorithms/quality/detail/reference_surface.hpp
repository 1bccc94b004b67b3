// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The original surface, to which an improved mesh is compared.
//
// Guarantee of contains_within_tolerance(): every point of the triangle is within the tolerance of
// its sheet of the original surface. Two proofs are tried, on the triangle and, where both fail, on
// parts of it:
// (1) The triangle, shrunk a little, is covered by triangles of the sheet along its normal or along
//     an axis, and all heights over it are within the tolerance: statements (1) to (3) of
//     docs/explanation/deviation.md.
// (2) All its corners are within the tolerance of one triangle of the sheet: statement (4).
// Rounding errors are included. Cost: about the number of triangles that it covers.
//
// An input triangle is isolated if it is farther from all other sheets than both tolerances
// together. Triangles that follow isolated ones only can't meet another sheet that stays within its
// own tolerance: statement (5).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/quality/detail/constants.hpp>
#include <terrane/algorithms/quality/detail/features.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::quality::detail {

using Corners = std::array<Point3, 3>;

/// Returns the point a + share * (b - a).
[[nodiscard]] Point3 towards(const Point3& a, const Point3& b, double share);

/// Returns the point nearest to p in the bounding box of `points`. A computed point of a triangle or
/// an edge can be outside of its bounding box by a rounding error, and so outside of a volume of
/// interest; this function moves it back.
[[nodiscard]] Point3 nearest_in_box(const Point3& p, std::span<const Point3> points);

/// Computes an upper bound (up to rounding) of the distance of p to the triangle: the distance to a
/// point that lies on it, however ill-shaped it is.
double to_triangle(const Point3& p, const Point3& a, const Point3& b, const Point3& c);

class ReferenceSurface {
public:
    /// bound_of is given per sheet. Of the features, only triangles, sheet_of and across are used.
    /// Referenced objects must outlive the object.
    ReferenceSurface(std::span<const Point3> points, const Features& features,
                     std::span<const double> bound_of);

    /// Limits heights over single triangles, which are distances along about the normal. `bounds`
    /// is given per triangle and is at most that of its sheet.
    void limit_bounds(std::vector<double> bounds) { local_bound_ = std::move(bounds); }

    /// Finds the isolated triangles; before, none counts as isolated.
    void find_isolated(const Run& run);

    [[nodiscard]] bool is_isolated(std::uint32_t t) const { return facets_[t].isolated; }

    /// Returns the least tolerance that is distinguishable from rounding errors.
    [[nodiscard]] double least_bound() const { return constants.least_bound * slack_; }
    /// Returns an upper bound of the rounding error of a distance where no coordinate is larger.
    static double rounding_at(double largest_coordinate) {
        return 256 * std::numeric_limits<double>::epsilon() * largest_coordinate;
    }
    /// Returns that bound for this surface.
    [[nodiscard]] double rounding() const { return slack_; }

    struct Containment {
        std::uint32_t hint = 0; ///< a triangle of the sheet near the centroid
        bool isolated = true;   ///< every triangle used is isolated
    };
    /// Working memory of one thread; callers do not use its contents.
    class Search {
        friend class ReferenceSurface;
        std::vector<std::uint32_t> seen_; ///< per triangle: the last search that visited it
        std::uint32_t number_ = 0;        ///< of the current search
        std::vector<std::uint32_t> front_;
        bool all_isolated_ = true; ///< of the triangles visited
    };
    /// Tells whether the triangle is proven to be within the tolerance of the sheet of the triangle
    /// `hint`.
    [[nodiscard]] std::optional<Containment>
    contains_within_tolerance(const Corners& triangle, std::uint32_t hint, Search& search) const;

    struct Place {
        Point3 point; ///< on the surface, up to rounding, and in the triangle's bounding box
        std::uint32_t triangle; ///< contains the point
    };
    /// Projects p to the sheet of `hint` along the axis in which the normal is longest. Returns
    /// nothing if the walk there meets a curve or a fold.
    [[nodiscard]] std::optional<Place> above(const Point3& p, const Point3& normal,
                                             std::uint32_t hint) const;

private:
    struct Flat {
        double u = 0, v = 0, w = 0; ///< in a projection, relative to an origin; w is along it
    };
    /// An orthonormal frame; `axis` is set if its directions are axes.
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
    /// A shrunk triangle in one projection.
    struct Target {
        Frame frame;
        int orientation = 1;         ///< +1: counterclockwise in the projection
        Point3 origin;               ///< of the flat coordinates
        std::array<Flat, 3> corners; ///< after shrinking
        Flat middle;
        double slope_u = 0, slope_v = 0; ///< height of its plane: slope_u u + slope_v v
        double error = 0;                ///< of a height, per unit of distance
        /// A point at d from the origin has the measures x dx + y dy + z dz - off. The first three
        /// tell how far it lies inside of each edge, times the length of the edge; the fourth is
        /// its height above the plane. Arranged so that one instruction computes several.
        struct Measures {
            std::array<double, 4> x, y, z, off;
        };
        Measures measures{};
        double spread = 0; ///< largest sum of coefficients of a measure; rounding errors are
                           ///< relative to it
        double radius = 0; ///< distance of the farthest corner from the origin
        double bound = 0;  ///< of heights
    };
    struct Walk {
        std::uint32_t end = 0;
        bool arrived = false;
    };
    enum class Cover : std::uint8_t { near, far, open }; ///< open: not covered, or not proven to be

    static Frame frame_of(Axis axis);
    static Frame frame_along(const Point3& normal, const Point3& side);
    /// Prepares the four measures of a target. target_of() returns nothing for a triangle so thin
    /// that the heights of its plane are meaningless.
    static void set_measures(Target& target);
    [[nodiscard]] static std::optional<Target> target_of(const Corners& triangle, double bound,
                                                         bool along_axis);
    /// Returns the orientation of a triangle in the projection; 0 if it is not certain.
    [[nodiscard]] int orientation_of(std::uint32_t t, const Frame& frame) const;
    [[nodiscard]] Walk walk(const Frame& frame, const Point3& origin, const Flat& to,
                            int orientation, std::uint32_t from) const;
    Cover covered(const Target& target, std::uint32_t start, Search& search) const;
    Cover visit(const Target& target, std::uint32_t t, Search& search) const;
    [[nodiscard]] static bool is_near(const Target& target, const Corners& facet,
                                      const std::array<double, 3>& heights, double bound);
    /// Returns the bound of heights over triangle t, rounding errors included.
    [[nodiscard]] double height_bound(std::uint32_t t) const {
        return (local_bound_.empty() ? bound_of_[features_.sheet_of[t]] : local_bound_[t]) - slack_;
    }
    [[nodiscard]] bool near_one(const Corners& triangle, std::uint32_t t, double bound) const;
    bool contains_part(const Corners& triangle, Containment& containment, double bound,
                       unsigned& budget, Search& search) const;
    [[nodiscard]] bool is_beyond_plane(std::uint32_t t, std::uint32_t of, double gap) const;

    std::span<const Point3> points_;
    const Features& features_;
    std::span<const double> bound_of_;
    /// The data of a triangle in one place, as searches mostly wait for memory.
    struct alignas(64) Facet {
        Corners corners;
        Point3 normal;
        double error = 0; ///< of each coordinate of the normal, at most
        double lean = 0;  ///< the sign of the normal's height is certain beyond this
        std::array<std::uint32_t, 3> across{};     ///< as in Features
        std::array<std::int8_t, 3> orientations{}; ///< per axis, exact
        bool isolated = false;
    };
    std::vector<Facet> facets_;       ///< per triangle
    std::vector<double> local_bound_; ///< per triangle; empty: those of the sheets
    double slack_ = 0;                ///< exceeds the rounding errors of distances
};

} // namespace terrane::quality::detail
