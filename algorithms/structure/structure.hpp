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
#include <string_view>
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

// How surfaces end and meet: the leaks where one ends without meeting another one, through which volumes
// are connected, and tables that structural geologists ask for: which surface stops against which, along what
// length and with what gap; and which blocks face each other across a fault.

/// A part of a free border whose nearest surface is the same and whose distances are of one order
/// of magnitude, so that borders that stop a little short are separated from those that end far
/// away.
struct BorderGap {
    SurfaceId surface{}; ///< the nearest one; of its own surface only other parts count
    int decade = 0;      ///< distances are in [10^decade, 10^(decade + 1)); INT_MIN: they are 0
    double length = 0;   ///< of this part of the border
    double least = 0;    ///< smallest distance of an edge, at its farther end
    double largest = 0;  ///< largest distance of an edge, at its farther end
    Point3 place{};      ///< the vertex or midpoint with the largest distance
};

/// A free border, from corner to corner or closed.
struct FreeBorder {
    std::uint32_t line = 0;                ///< of the structure, of kind free_border
    std::vector<std::uint32_t> surfaces{}; ///< that end here, ascending
    double length = 0;                     ///< unit of the mesh
    bool closed = false;                   ///< whether it is a loop without corner
    std::vector<BorderGap> gaps{}; ///< by decade, then surface; empty if there is no other surface
};

/// Two surfaces, one of which ends near the other without meeting it, at distances of one order of
/// magnitude.
struct Leak {
    SurfaceId from{};        ///< the surface that ends
    SurfaceId to{};          ///< the surface nearest to it; `from`: another part of it
    int decade = 0;          ///< as in BorderGap
    std::size_t borders = 0; ///< parts of borders
    double length = 0;       ///< of these parts
    double least = 0;        ///< smallest distance
    double largest = 0;      ///< largest distance
    Point3 place{};          ///< where it is largest

    /// Adds a part of a border of the surface `from`.
    void add(const BorderGap& gap);
};

/// Finds all free borders, in the order of their lines. Each edge counts for the surface nearest to
/// its farthest point. Distances and lengths are in the unit of the mesh, in floating point. Cost:
/// O(n log n) for a search tree; two queries in it per border vertex.
std::vector<FreeBorder> find_free_borders(const Mesh& mesh, const Structure& structure);

/// Summarises free borders by pairs of surfaces: by the surface that ends, then the other. A border
/// of several surfaces counts for each.
std::vector<Leak> leaks_of(std::span<const FreeBorder> borders);

/// The relation of two surfaces where they meet, or nearly meet.
enum class RelationKind : std::uint8_t {
    stops,    ///< `from` ends at `to`, which goes on
    crosses,  ///< both go on
    meets,    ///< both end
    overlaps, ///< both have the triangles at the line
    near,     ///< `from` ends near `to` without meeting it
};

/// Names the kind: "stops at", "crosses", "meets", "overlaps", "ends near".
std::string_view name_of(RelationKind kind);

/// One kind of contact between two surfaces. All but `stops` and `near` are symmetric, and listed
/// once, with from < to.
struct SurfaceRelation {
    SurfaceId from{};                       ///< the surface that ends
    SurfaceId to{};                         ///< the other one
    RelationKind kind = RelationKind::near; ///< the kind of relation
    double length = 0;                      ///< of all lines, unit of the mesh
    double least = 0;   ///< of `near`: the smallest gap, as in Leak; otherwise 0
    double largest = 0; ///< of `near`: the largest gap
    Point3 place{};     ///< on the longest line; of `near`: where the gap is largest
};

/// Two blocks that face each other across a surface.
struct Juxtaposition {
    SurfaceId surface{};                   ///< between them
    std::array<std::uint32_t, 2> blocks{}; ///< numbers, the lower first; 0 is the outside
    double area = 0;                       ///< squared unit
};

/// Finds how surfaces end at each other, by the lines of the structure and the gaps of free
/// borders: by `from`, `to`, kind. Gaps of different orders of magnitude are different relations,
/// the smallest first. Cost: linear in the triangles, n log n in the lines.
std::vector<SurfaceRelation> find_relations(const Mesh& mesh, const Structure& structure,
                                            std::span<const FreeBorder> borders);

/// Finds the areas across which blocks face each other, by surface, then blocks. Parts of a surface
/// that dangle in one block are left out; an area of several surfaces counts for each.
std::vector<Juxtaposition> find_juxtapositions(const Structure& structure);

} // namespace terrane
