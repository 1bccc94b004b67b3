// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the blocks of a mesh before and after, and which of them, and which surfaces, touch.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/simplification/detail/complex.hpp>
#include <terrane/algorithms/simplification/simplify.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::simplification::detail {

/// A mesh of cells that know of which triangle of the mesh before they are the image.
struct Traced {
    const Mesh& mesh;
    const std::vector<Cell>& cells; ///< parallel to the triangles, with the same orientation
    const Volumes& volumes;
};

/// Returns per volume of the mesh after the volume before that most of it was, by the areas of the
/// triangles of one surface around it; none if there is no such triangle.
std::vector<std::uint32_t> matched_blocks(const Volumes& before, const Traced& after);

/// Lists the blocks before that are not one and the same block after.
std::vector<ChangedBlock> changed_blocks(const Volumes& before, const Traced& after,
                                         std::span<const std::uint32_t> block_before);

/// Lists the pairs of blocks with a triangle between them in only one of the meshes.
std::vector<ChangedContact> changed_block_contacts(const Volumes& before, const Traced& after,
                                                   std::span<const std::uint32_t> block_before);

/// Lists the pairs of surfaces with an edge in common in only one of the meshes.
std::vector<ChangedContact> changed_surface_contacts(const Mesh& before, const Mesh& after);

} // namespace terrane::simplification::detail
