// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Builds the boundary representation of a model from a conforming mesh and its volumes: corners,
// lines, patches, interfaces and blocks, as in RINGMesh and OpenGeode.
//
// - An interface consists of all triangles between the same two volumes that belong to the same
//   surfaces. If both volumes are the same, it dangles.
// - A patch is a part of an interface that is connected across edges of two triangles, both of the
//   interface.
// - A line is a chain of the other edges: those at which other than two triangles meet, or two of
//   different interfaces. It ends in corners: vertices at which other than two such edges meet, or
//   two at which different patches meet. A closed line without corners repeats its first vertex.
// Indices are by position: corners in lexicographic order; lines and patches by their least vertex
// and, among equals, by all their vertices; interfaces by their volumes, then likewise. Lengths and
// areas are in floating point. Cost: linear, except for sorting. Source: RINGMesh (Pellerin et al.
// 2017) for the entities; the paper, 5.3, for their use.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// Geological meaning of a line; the first one that applies.
enum class LineKind : std::uint8_t {
    free_border,  ///< one triangle: the surface ends here
    boundary,     ///< a surface with the role boundary takes part
    cutoff,       ///< a horizon meets a fault
    branch,       ///< faults only, one of which ends at another one
    intersection, ///< any other contact, or a surface with itself
};

/// Names the kind: "free border", "boundary line", "cutoff line", "branch line", "intersection
/// curve".
std::string_view name_of(LineKind kind);

/// A vertex at which lines end.
struct ModelCorner {
    VertexId vertex{};                  ///< of the mesh
    std::vector<std::uint32_t> lines{}; ///< that end here, ascending; twice if both ends do
};

/// A chain of edges at which patches meet or end.
struct ModelLine {
    LineKind kind = LineKind::free_border;  ///< by the roles of the surfaces
    std::vector<std::uint32_t> vertices{};  ///< of the mesh, >= 2, in order; first = last: closed
    std::vector<std::uint32_t> patches{};   ///< that meet here, ascending, each once
    std::vector<std::uint32_t> surfaces{};  ///< of the triangles that meet here, ascending
    std::array<std::uint32_t, 2> corners{}; ///< at its ends; UINT32_MAX: closed without corner
    double length = 0;                      ///< unit of the mesh
};

/// A connected part of an interface.
struct ModelPatch {
    InterfaceId interface {};               ///< the interface that it is part of
    std::vector<std::uint32_t> triangles{}; ///< of the mesh, ascending
    std::vector<std::uint32_t> lines{};     ///< around it and within it, ascending
    double area = 0;                        ///< squared unit
};

/// The triangles between the same two volumes that belong to the same surfaces.
struct ModelInterface {
    std::array<std::uint32_t, 2> volumes{}; ///< on its sides, the lower first; equal: it dangles
    std::vector<std::uint32_t> surfaces{};  ///< of all its triangles, ascending, >= 1
    std::vector<std::uint32_t> patches{};   ///< ascending
    std::vector<std::uint32_t> triangles{}; ///< of the mesh, ascending
    double area = 0;                        ///< squared unit

    /// Tells whether the same volume is on both sides.
    [[nodiscard]] bool dangles() const { return volumes[0] == volumes[1]; }
};

/// A block, described by the surfaces around it. The area of each of its triangles counts as above
/// if the block's outward normal rises by at least 45 degrees, as below if it falls by as much, and
/// as beside otherwise. A surface is above, below or beside the block if at least a tenth of its
/// area at the block is, and where most of it is.
struct ModelBlock {
    std::string name{}; ///< different for all; see block_names.hpp
    std::string unit{}; ///< of a stratigraphic column, or layer that a file states; empty: none
    std::optional<double> age{};                   ///< of the base of that unit, as in the column
    std::vector<std::uint32_t> above{};            ///< surfaces above it, ascending
    std::vector<std::uint32_t> below{};            ///< surfaces below it, ascending
    std::vector<std::uint32_t> beside{};           ///< surfaces beside it, ascending
    std::vector<std::uint32_t> interfaces{};       ///< around it; without dangling ones
    std::vector<std::uint32_t> inner_interfaces{}; ///< that dangle in it
    std::vector<std::uint32_t> neighbours{};       ///< volumes across its interfaces, ascending
    double volume =
        0;           ///< cubic unit: the exact volume of the mesh, rounded to a double; outside: 0
    double area = 0; ///< of the boundary
};

/// The boundary representation of a model.
struct Structure {
    std::vector<ModelCorner> corners{};        ///< in lexicographic order of their positions
    std::vector<ModelLine> lines{};            ///< by their least vertices
    std::vector<ModelPatch> patches{};         ///< by their least vertices
    std::vector<ModelInterface> interfaces{};  ///< by their volumes
    std::vector<ModelBlock> blocks{};          ///< per volume; [0] is the outside, "outside"
    std::vector<std::uint32_t> patch_of{};     ///< per triangle
    std::vector<std::uint32_t> interface_of{}; ///< per triangle
};

/// Builds the structure. `volumes` must be those of the mesh; roles come from its surfaces. Blocks
/// are named by their surfaces; name_blocks() gives them names that people gave.
Structure build_structure(const Mesh& mesh, const Volumes& volumes);

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> structure_constants();

// Extracts blocks and interfaces as separate meshes. They conform exactly: where two parts share a
// triangle, an edge or a vertex of the whole mesh, they have the same doubles there.

/// A part of a mesh. It has the vertices used by its triangles, in their order, and no intersection
/// edges.
struct MeshPart {
    Mesh mesh;                            ///< the part as a mesh of its own
    std::vector<std::uint32_t> triangles; ///< per triangle of the part: its number in the whole
};

/// Which surfaces a part names.
enum class PartSurfaces : std::uint8_t {
    all, ///< those of the whole mesh, by their numbers there
    own, ///< those of its triangles, numbered anew in their order; the cost is that of the part
};

/// Extracts the closed boundary of a block (or of the outside, 0), oriented outward, without
/// interfaces that dangle in it.
MeshPart block_part(const Mesh& mesh, const Volumes& volumes, const Structure& structure,
                    BlockId block, PartSurfaces surfaces = PartSurfaces::all);

/// Extracts an interface, oriented so that its front faces the volume of higher index; a dangling
/// one keeps the orientation of its triangles.
MeshPart interface_part(const Mesh& mesh, const Volumes& volumes, const Structure& structure,
                        InterfaceId interface, PartSurfaces surfaces = PartSurfaces::all);

/// Many parts as one mesh, one after the other. Parts share vertices; a triangle between two blocks
/// stands twice among all blocks.
struct MeshParts {
    MeshPart all;                       ///< it names all surfaces
    std::vector<std::uint32_t> part_of; ///< per triangle of `all`: number of its block or interface
};

/// Extracts all blocks but the outside, each as block_part() does.
MeshParts block_parts(const Mesh& mesh, const Volumes& volumes, const Structure& structure);
/// Extracts all interfaces, each as interface_part() does.
MeshParts interface_parts(const Mesh& mesh, const Volumes& volumes, const Structure& structure);

} // namespace terrane
