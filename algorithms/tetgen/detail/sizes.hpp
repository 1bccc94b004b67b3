// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Turns wanted edge lengths into the bounds that TetGen takes.
//
// A length L becomes the volume of a regular tetrahedron with that edge, L^3 / (6 sqrt 2), in
// blocks, and the area of its faces, L^2 sqrt(3) / 4, on surfaces. A block uses its own length, or
// else edge_length and max_volume; a triangle uses the least length of its surfaces and of the
// blocks on its sides. TetGen 1.5.0 keeps these bounds, except in its last step, which improves
// shapes and may make volumes a fifth larger. It does not keep the sizes of its other way, lengths
// at points (-m): with 0.5 asked for on a fault in a box of 8, faces had areas up to that of an
// edge length of 0.93; with bounds on areas, up to 0.4995.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::tetgen::detail {

/// Bounds in one volume; infinite: no bound. Unit of the mesh.
struct SizeInVolume {
    double length = std::numeric_limits<double>::infinity();     ///< wanted length of edges
    double max_volume = std::numeric_limits<double>::infinity(); ///< largest tetrahedron

    [[nodiscard]] bool bounded() const {
        return std::isfinite(length) || std::isfinite(max_volume);
    }
    friend bool operator==(const SizeInVolume&, const SizeInVolume&) = default;
};

struct Sizes {
    std::vector<SizeInVolume> in_volumes;
    std::vector<double> on_triangles; ///< per triangle of the mesh: wanted edge length, or infinite

    [[nodiscard]] bool any() const;
    /// Tells whether the volumes of tetrahedra are bounded anywhere.
    [[nodiscard]] bool bound_volumes() const;
    /// Tells whether all blocks and the outside have the same bounds.
    [[nodiscard]] bool same_everywhere() const;
};

/// Collects the sizes from the options. `volumes` are those of the mesh. Errors: bad_option if a
/// length is not a positive number, or if a block or a surface does not exist or is named twice.
Result<Sizes> sizes_of(const Mesh& mesh, const Volumes& volumes, const TetrahedraOptions& options);

/// Return the volume of a regular tetrahedron with this edge, and the area of one of its faces.
double volume_of(double edge_length);
double area_of(double edge_length);

/// Finds a point in each volume that has a bound, including the outside. Errors: unsupported if
/// none of the points of doubles tried lies in one of them; interrupted.
Result<std::vector<BlockPoint>> points_of_bounded(const Mesh& mesh, const Volumes& volumes,
                                                  const Box3& box, const Sizes& sizes,
                                                  const Run& run);

} // namespace terrane::tetgen::detail
