// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The boundary of a region, exact and rounded, with the side of each triangle on which the region is.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace terrane::selection {

/// A region of an arrangement.
struct SelectedRegion {
    Arrangement boundary; ///< restricted to the triangles between the region and the rest of space
    std::vector<std::array<std::uint32_t, 2>>
        of_sides; ///< per triangle: the piece in front of and behind it, from 1; 0 is not in the region
    std::uint32_t pieces = 0;   ///< their number
    std::uint32_t cavities = 0; ///< bounded parts of space without the region
    /// Per surface, whether a part of it is selected as an open surface, instead of a region; else empty.
    std::vector<bool> open{};
};

/// The triangles of an exact boundary, found by a parent and a place near to theirs.
class BoundaryFacets {
public:
    explicit BoundaryFacets(const SelectedRegion& region);

    struct Facet {
        std::uint32_t parent; ///< the first
        Point3 middle;        ///< of the doubles nearest to its corners
        std::uint32_t piece;  ///< that it bounds, from 0
        bool is_behind;       ///< whether the piece is behind it
    };
    /// Returns the facet with this first parent whose middle is nearest to that of a triangle of the
    /// rounded boundary; nullptr if there is none.
    [[nodiscard]] const Facet* nearest(std::uint32_t parent,
                                       const std::array<Point3, 3>& corners) const;

private:
    struct OfParent {
        Facet facet{};         ///< the first; without a middle
        bool is_known = false; ///< whether there is one
        bool is_mixed = false; ///< whether others differ from it in piece or side
    };
    std::vector<OfParent> of_parent_; ///< per input triangle
    std::vector<Facet> mixed_;        ///< those of mixed parents, by parent, then by middle
};

/// A rounded boundary whose triangles face outwards.
struct Oriented {
    Mesh mesh;
    std::vector<std::uint32_t> piece_of; ///< per triangle: the piece that it bounds, from 0
};

/// Turns the triangles of a rounded boundary outwards. A volume of the mesh is in the region if this is so of more of
/// its triangles than not, by the facets that they come from; so the result is closed, whatever rounding
/// did. Triangles with the region on both sides, or on none, as a part of it was too thin for doubles,
/// are left out. Errors: those of find_volumes().
Result<Oriented> oriented(const RoundedMesh& rounded, const SelectedRegion& region, const Run& run);

/// Turns the triangles of a rounded part of an open surface as that surface faces, where they are wound as another
/// surface that they are part of, too.
void turn_as_open(const SelectedRegion& region, Mesh& rounded);

/// Returns the triangles of a mesh that are kept, with the vertices and intersection edges that they use;
/// without regions.
Mesh part_of(const Mesh& mesh, const std::vector<bool>& keep);

} // namespace terrane::selection
