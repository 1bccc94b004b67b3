// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Fills a hole of a surface z = f(x, y) exactly up to its border, with heights of any method.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/holes/filling.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/data.hpp>

namespace terrane {

/// The heights that a method finds at places in the hole.
struct KnownHeights {
    std::vector<double> heights;  ///< per place
    std::vector<double> expected; ///< per place: expected error; NaN if unknown
};

/// Estimates heights at the x and y of places.
using HeightSource = std::function<KnownHeights(std::span<const Point3>)>;

/// A hole seen along z.
class FlatHole {
public:
    /// Collects the corners of at least `rings` rings of triangles around the hole (more up to two of
    /// its radii, while there are fewer than 4000, and farther away, while there are fewer than 800)
    /// and around those of all loops that are islands in it. Errors: unsupported if the surface there is no graph
    /// z = f(x, y), with the place; bad_index; nothing_to_do for a loop without area; interrupted.
    static Result<FlatHole> of(const Surface& surface, const BorderLoop& loop,
                               std::span<const BorderLoop> loops, std::size_t rings,
                               const Run& run = {});

    /// The corners; those on borders come first, in the order of the loops.
    [[nodiscard]] const std::vector<Point3>& data() const { return data_.points; }
    /// Number of data up to two radii away, which come first.
    [[nodiscard]] std::size_t near() const { return data_.near; }
    /// Number of data on borders.
    [[nodiscard]] std::size_t border() const { return data_.inner_of.size(); }
    /// Radius of a disk with the area of the hole.
    [[nodiscard]] double radius() const;

    /// Builds the mesh, without heights. `mesh_size`: the distance of its vertices; 0: the median
    /// edge of the border. Errors: unsupported if the border crosses itself or the surface reaches
    /// into the hole, seen along z; interrupted.
    Status triangulate(double mesh_size, const Run& run);

    /// Sets the heights of the mesh. If its size was not given, it is halved, down to a quarter,
    /// while flat triangles are farther from the heights than these are expected to be from the
    /// truth. Errors: interrupted.
    ///
    /// Exact: seen along z, the triangles of the filling do not overlap, and at each border edge
    /// they lie strictly on the other side than the surface. (Other parts of the surface above or
    /// below are not examined.) Where more than 20 000 vertices would be needed, the mesh becomes
    /// coarser away from the border. The report lacks data and model.
    Result<Filling> filled(const HeightSource& source, const Run& run);

private:
    /// Vertices of triangles, those on borders first, and the triangles, front up.
    struct Mesh {
        std::vector<Point3> points;
        std::vector<Triangle> triangles;
    };

    Status build(const Run& run);
    Status check_sides() const;
    std::vector<double> set_heights(const HeightSource& source);
    [[nodiscard]] bool is_too_flat(const HeightSource& source) const;
    [[nodiscard]] double error_of_flat(const HeightSource& source) const;

    Surface named_; ///< name and role of the surface, no more
    kriging::detail::KrigingData data_;
    double area_ = 0;      ///< positive if the loop is counterclockwise
    double mesh_size_ = 0; ///< as used
    bool given_ = false;   ///< whether a mesh size was
    Mesh mesh_;
};

} // namespace terrane
