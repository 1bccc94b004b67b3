// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Diffusion over cells of any kind: polygons that share edges, tetrahedra that share faces. From a
// cell it spreads to all neighbours, but not over stops.
// Source: the paper, section 3, step 2b, and its remark that it extends to quadrilateral meshes and
// one dimension up.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// What two cells share: an edge (N = 2) or a triangular face (N = 3), by its corners, ascending.
template <std::size_t N>
using SharedFacet = std::array<std::uint32_t, N>;

template <std::size_t N>
struct CellFacet {
    SharedFacet<N> corners{};
    std::uint32_t cell = 0;

    friend auto operator<=>(const CellFacet&, const CellFacet&) = default;
};

/// Per cell its region: two cells have the same one iff a path leads from one to the other over
/// facets that exactly two cells share and that are no stops. Numbers are by lowest cell, from 0.
/// `stops`: sorted. Cost: sorting the facets.
template <std::size_t N>
std::vector<std::uint32_t> diffuse(std::size_t cells, std::vector<CellFacet<N>> facets,
                                   std::span<const SharedFacet<N>> stops) {
    DisjointSets sets(cells);
    std::sort(facets.begin(), facets.end());
    for (std::size_t i = 0, end = 0; i < facets.size(); i = end) {
        while (end < facets.size() && facets[end].corners == facets[i].corners) ++end;
        if (end - i == 2 && !std::binary_search(stops.begin(), stops.end(), facets[i].corners))
            sets.join(facets[i].cell, facets[i + 1].cell);
    }
    std::vector<std::uint32_t> region(cells);
    std::uint32_t count = 0; // a set is named after its lowest cell, which comes first
    for (std::uint32_t c = 0; c < cells; ++c)
        region[c] = sets.find(c) == c ? count++ : region[sets.find(c)];
    return region;
}

/// Regions of polygons (triangles, quadrilaterals, any mixture): per polygon its corners in order
/// around it, >= 3. `stops`: edges of the curve, lower vertex first, sorted; parts of edges are
/// none.
std::vector<std::uint32_t> regions_of_polygons(const IndexLists<std::uint32_t>& polygons,
                                               std::span<const Edge> stops);

/// Regions of tetrahedra, by diffusion over faces that are on no surface.
std::vector<std::uint32_t> regions_of_tetrahedra(const TetrahedralMesh& mesh);

} // namespace terrane
