// SPDX-License-Identifier: LGPL-3.0-or-later
//
// An improved mesh and its report.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <terrane/algorithms/check/conforming.hpp>
#include <terrane/algorithms/mesh/shared_mesh.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// The reason why the worst triangle can't be improved; the first one that applies.
enum class WorstCause : std::uint8_t {
    none,         ///< no triangle; or vertices moved afterwards, and another one is the worst
    corner_angle, ///< its smallest angle lies between two curves
    short_curve,  ///< its shortest edge is a curve between two corners
    close_curves, ///< all its corners lie on curves
    deviation,    ///< better triangles are not proven to be within max_deviation
    contact,      ///< better triangles would meet others
    shape,        ///< collapses, swaps and moves at its corners were tried; none improves it
    rounds,       ///< the number of changes made for worst triangles is limited
};

/// Names the cause as reports print it: "fixed corner angle", "short curve", ...
std::string_view name_of(WorstCause cause);

/// Describes the improvement of a mesh.
struct ImproveReport {
    QualityReport before;            ///< of the given mesh
    QualityReport after;             ///< of the improved mesh
    std::vector<double> bound_of;    ///< per surface: upper bound of its distance from the original
    std::size_t corners = 0;         ///< vertices that stay
    std::size_t curves = 0;          ///< from corner to corner, or closed
    std::size_t sheets = 0;          ///< parts of surfaces between curves
    std::size_t splits = 0;          ///< edges divided
    std::size_t collapses = 0;       ///< edges removed
    std::size_t swaps = 0;           ///< edges exchanged for the other diagonal
    std::size_t moves = 0;           ///< vertices moved, each time counted
    std::size_t refused_contact = 0; ///< changes rejected since triangles would meet improperly
    std::size_t refused_deviation = 0; ///< changes rejected since they are not proven to be near
    std::size_t refused_shape = 0;     ///< changes rejected since they would fold, degenerate or
                                       ///< be worse than the worst triangle of the input
    double least_quality = 0;          ///< no triangle may have a smaller q, see guarantee (6)
    unsigned attempts = 1;  ///< times that the mesh was improved from the start, for guarantee (6)
                            ///< and for the volumes of blocks
    bool is_strict = false; ///< guarantee (6) needed more than one attempt
    std::size_t held_blocks = 0;    ///< blocks around which bounds were reduced for their volumes
    std::size_t thin_triangles = 0; ///< input triangles over which thickness_share limits the bound
    unsigned passes = 0;            ///< rounds of the four operations
    bool sides_kept = false; ///< exact: each sheet has the same volumes on its sides as before
    WorstCause worst_cause = WorstCause::none; ///< of the triangle after.worst
};

/// An improved mesh.
struct Improved {
    /// The improved mesh: vertices and triangles in a new order; surfaces, regions and intersection
    /// edges as before. parents_of is empty, as triangles no longer lie in input triangles. All
    /// triangles of a sheet have the orientation of its first input triangle.
    SharedMesh mesh;
    std::optional<ConformingMesh> conforming{}; ///< the same mesh with its proof; always there;
                                                ///< pairs() where options.check counts them
    Volumes volumes{};                          ///< of the mesh, found for report.sides_kept
    Volumes volumes_before{};                   ///< of the mesh before
    std::vector<std::uint32_t> volume_before; ///< per volume of the mesh: the volume before that it
                                              ///< is; empty unless report.sides_kept
    std::vector<std::uint32_t> near_of; ///< per triangle: an input triangle of the same sheet, near
                                        ///< its centroid
    ImproveReport report;               ///< quality, changes and bounds
};

} // namespace terrane
