// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Diffusion over cells of any kind: polygons that share edges, or tetrahedra that share faces. It
// spreads from a cell to all its neighbours except across stops.
// Source: the paper, section 3, step 2b, and its remark that the method extends to quadrilateral
// meshes and to one dimension more.
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

/// The edge (N = 2) or triangular face (N = 3) that two cells share, by its corners, ascending.
template <std::size_t N>
using SharedFacet = std::array<std::uint32_t, N>;

template <std::size_t N>
struct CellFacet {
    SharedFacet<N> corners{};
    std::uint32_t cell = 0;

    friend auto operator<=>(const CellFacet&, const CellFacet&) = default;
};

/// Returns the region of each cell. Two cells are in the same region iff a path connects them
/// across facets that exactly two cells share and that are not stops. Regions are numbered from 0
/// by their lowest cells. `stops` are sorted. Cost: sorting the facets.
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
    std::uint32_t count = 0; // the root of a set is its lowest cell, which comes first
    for (std::uint32_t c = 0; c < cells; ++c)
        region[c] = sets.find(c) == c ? count++ : region[sets.find(c)];
    return region;
}

/// Returns the region of each polygon (triangles, quadrilaterals, or any mixture). A polygon is
/// given by its corners in order around it, >= 3. `stops` are the edges of the curve, sorted, with
/// the lower vertex first; they must be whole edges of polygons to have an effect.
std::vector<std::uint32_t> regions_of_polygons(const IndexLists<std::uint32_t>& polygons,
                                               std::span<const Edge> stops);

/// Returns the region of each tetrahedron, by diffusion across the faces that are on no surface.
std::vector<std::uint32_t> blocks_of_tetrahedra(const TetrahedralMesh& mesh);

} // namespace terrane
