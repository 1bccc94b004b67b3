// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Corners, lines, surfaces and blocks of a model: its boundary representation, as in RINGMesh and
// OpenGeode, of a conforming mesh and its volumes.
//
// - An interface is all triangles between the same two volumes that lie in the same surfaces. Where
//   both volumes are one it dangles.
// - A patch is a part of an interface that hangs together by edges of two triangles, both of the
//   interface.
// - A line is a chain of all other edges: those in which other than two triangles meet, or two of
//   different interfaces. It ends in corners: vertices in which other than two such edges meet, or
//   two at which different patches meet. A closed line without corners repeats its first vertex.
// Numbers are by position: of corners in lexicographic order, of lines and patches by their least
// vertex and, among equals, by all their vertices; of interfaces by their volumes, then likewise.
// Lengths and areas are in floating point.
// Cost: linear, but for sorting.
// Source: RINGMesh (Pellerin et al. 2017) for the entities; the paper, 5.3, for their use.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// What a line is to the geologist; the first that holds.
enum class LineKind : std::uint8_t {
    free_border,  ///< one triangle: the surface ends here
    boundary,     ///< a surface with the role boundary takes part
    cutoff,       ///< a horizon and a fault
    branch,       ///< faults only, and one of them ends here, on another one
    intersection, ///< any other meeting, or a surface with itself
};

/// "free border", "boundary line", "cutoff line", "branch line", "intersection curve".
std::string_view name_of(LineKind kind);

/// A vertex at which lines end.
struct ModelCorner {
    std::uint32_t vertex = 0;           ///< of the mesh
    std::vector<std::uint32_t> lines{}; ///< that end here, ascending; twice for both ends
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
    std::uint32_t interface = 0;            ///< the interface that it is part of
    std::vector<std::uint32_t> triangles{}; ///< of the mesh, ascending
    std::vector<std::uint32_t> lines{};     ///< around it and within it, ascending
    double area = 0;                        ///< squared unit
};

/// What lies between the same two volumes and in the same surfaces.
struct ModelInterface {
    std::array<std::uint32_t, 2> volumes{}; ///< on its sides, the lower first; equal: it dangles
    std::vector<std::uint32_t> surfaces{};  ///< of all its triangles, ascending, >= 1
    std::vector<std::uint32_t> patches{};   ///< ascending
    std::vector<std::uint32_t> triangles{}; ///< of the mesh, ascending
    double area = 0;                        ///< squared unit

    /// Whether the same volume is on both sides.
    [[nodiscard]] bool dangles() const { return volumes[0] == volumes[1]; }
};

/// A block is described by the surfaces around it. Each of its triangles counts with its area as
/// above where the block's outward normal rises by 45 degrees or more, as below where it falls so,
/// as beside otherwise. A surface is above, below or beside where at least a tenth of its area at
/// the block is, and where most of it is.
struct ModelBlock {
    std::string name{}; ///< "top/base|fault": above/below|beside, "-" for none, "+" between two;
                        ///< unique: one met again gets " 2", " 3", ...
    std::vector<std::uint32_t> above{};            ///< surfaces above it, ascending
    std::vector<std::uint32_t> below{};            ///< surfaces below it, ascending
    std::vector<std::uint32_t> beside{};           ///< surfaces beside it, ascending
    std::vector<std::uint32_t> interfaces{};       ///< around it; none that dangles
    std::vector<std::uint32_t> inner_interfaces{}; ///< that dangle in it
    std::vector<std::uint32_t> neighbours{};       ///< volumes beyond the former, ascending
    double volume = 0; ///< cubic unit: the double nearest to the exact volume of the mesh
    double area = 0;   ///< of the boundary
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

/// `volumes` are those of the mesh. Roles come from the mesh's surfaces.
Structure build_structure(const Mesh& mesh, const Volumes& volumes);

} // namespace terrane
