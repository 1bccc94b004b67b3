// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Derives from a mesh and its blocks the contents that the files of a folder with blocks must have:
// result.vtp, blocks/block_N, interfaces/interface_N, or blocks.vtp and interfaces.vtp with all of these,
// and the lists of model.json.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/verify/detail/kinds.hpp>
#include <terrane/algorithms/verify/detail/output.hpp>
#include <terrane/algorithms/verify/detail/tetrahedra.hpp>

namespace terrane::verifier {

/// Triangles between the same two blocks that belong to the same surfaces.
struct Interface {
    BlockSides blocks{}; ///< the lower first
    Numbers surfaces;    ///< ascending
    Numbers triangles;   ///< ascending
    Numbers patches;     ///< ascending
};

/// Triangles of an interface that are connected by edges at which no others meet.
struct Patch {
    std::uint32_t interface = 0;
    Numbers triangles; ///< ascending
};

/// The interfaces, ordered by their blocks, then by the lists of their vertices in lexicographic
/// order, then by their first triangles; and the patches, ordered likewise without blocks.
struct BlockParts {
    std::vector<Interface> interfaces;
    std::vector<Patch> patches;
    std::map<std::uint32_t, Numbers> around; ///< by block: triangles with it on one side, ascending
    Numbers interface_of;                    ///< per triangle
    Numbers patch_of;                        ///< per triangle
};

/// Returns the rank of each vertex in the lexicographic order of the points.
Numbers ranks_of(const std::vector<Point3>& vertices);

BlockParts find_parts(const WrittenMesh& mesh, const std::vector<BlockSides>& sides);

/// A part of the mesh as a file holds it.
struct PartMesh {
    std::vector<Point3> vertices; ///< those of its triangles, in the order of the mesh
    std::vector<Triangle> triangles;
    IndexLists<std::uint32_t> regions_of, parents_of, surfaces_of;
    Numbers numbers; ///< per triangle: its number in the mesh
};

/// A triangle of the mesh, and whether a part has it turned over.
struct Taken {
    std::uint32_t triangle = 0;
    bool turned = false;
};

/// Adds the triangles around a block, wound outward; none that has the block on both sides.
void take_block(const std::vector<BlockSides>& sides, const BlockParts& parts, std::uint32_t block,
                std::vector<Taken>& taken);

/// Adds the triangles of an interface, so wound that the block with the higher number is in front.
void take_interface(const std::vector<BlockSides>& sides, const Interface& interface,
                    std::vector<Taken>& taken);

/// Takes triangles out of the mesh.
PartMesh part_of(const WrittenMesh& mesh, const std::vector<Taken>& taken);

/// The contents of model.json.
struct ModelLists {
    const WrittenMesh& mesh;
    const BlockParts& parts;
    std::span<const SurfaceInfo> surfaces;
    const ModelClaim& stated;
    std::span<const std::string> names; ///< of blocks
    std::vector<double> volumes;        ///< per block: nearest to the exact volume of the mesh
    /// Returns the file of a block ("block") or an interface ("interface").
    std::function<std::string(const std::string& kind, std::uint32_t number)> file_of;
};

/// Compares model.json with its contents: a line for each element of its arrays. Returns where it
/// differs, or nothing.
std::string difference(std::string_view contents, const ModelLists& lists);

} // namespace terrane::verifier
