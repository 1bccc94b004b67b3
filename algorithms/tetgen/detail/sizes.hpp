// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Wanted lengths of edges as the bounds that TetGen takes. Private to terrane::tetgen.
//
// A length L becomes the volume of a regular tetrahedron of that edge, L^3 / (6 sqrt 2), in blocks,
// and the area of its faces, L^2 sqrt(3) / 4, on surfaces. In a block holds its own length, else
// edge_length and max_volume; on a triangle the least length of its surfaces and of the blocks on
// its sides. TetGen 1.5.0 keeps these bounds, but for its last step, which improves shapes: volumes
// may be a fifth larger after it. Its other way, lengths at points (-m), does not: where 0.5 was
// asked on a fault in a box of 8, faces had areas as of 0.93, with bounds on areas 0.4995.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/region_point.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::tetgen::detail {

/// What holds in one volume; infinite: no bound. Unit of the mesh.
struct SizeInVolume {
    double length = std::numeric_limits<double>::infinity();     ///< of edges
    double max_volume = std::numeric_limits<double>::infinity(); ///< of a tetrahedron

    [[nodiscard]] bool bounded() const {
        return std::isfinite(length) || std::isfinite(max_volume);
    }
    friend bool operator==(const SizeInVolume&, const SizeInVolume&) = default;
};

struct Sizes {
    std::vector<SizeInVolume> in_volumes;
    std::vector<double> on_triangles; ///< per triangle of the mesh: length of edges, or infinite

    [[nodiscard]] bool any() const;
    /// Whether all blocks, and the outside, have the same.
    [[nodiscard]] bool same_everywhere() const;
};

/// `volumes` are those of the mesh. Errors: bad_option where a length is no positive number, a
/// block or a surface does not exist or is named twice.
Result<Sizes> sizes_of(const Mesh& mesh, const Volumes& volumes, const TetrahedraOptions& options);

/// Of a regular tetrahedron, and of its faces.
double volume_of(double edge_length);
double area_of(double edge_length);

/// A point in each volume that has a bound, the outside among them.
/// Errors: unsupported where no point of doubles was found in one; interrupted.
Result<std::vector<RegionPoint>> points_of_bounded(const Mesh& mesh, const Volumes& volumes,
                                                   const Box3& box, const Sizes& sizes,
                                                   const Run& run);

} // namespace terrane::tetgen::detail
