// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Groups of triangles for the formats in which a triangle has only one number, although it may
// belong to several surfaces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane::detail {

/// The side of a cut on which a face is, if nodes are split (split_nodes.hpp).
enum class CutSide : std::uint8_t { none, front, back };

/// Returns "", " front" or " back".
[[nodiscard]] std::string_view ending_of(CutSide side);

/// Returns the side of each face; an empty list if no nodes are split.
[[nodiscard]] std::vector<CutSide> cut_sides(const TetrahedralMesh& mesh);

/// The triangles that belong to the same surfaces and are on the same side of a cut.
struct SurfaceGroup {
    std::size_t tag = 0;                 ///< s + 1 for surface s only, without cut; else larger
    std::vector<std::uint32_t> surfaces; ///< ascending
    CutSide side = CutSide::none;
    std::vector<std::size_t> cells; ///< triangles, ascending
};

/// Returns one group for each pair of a set of surfaces and a side that some triangle has, in
/// lexicographic order. Groups of several surfaces or of a side have the tags surface_count + 1,
/// ... in that order. `sides` has one value per triangle, or is empty.
[[nodiscard]] std::vector<SurfaceGroup> surface_groups(const IndexLists<std::uint32_t>& surfaces_of,
                                                       std::size_t surface_count,
                                                       std::span<const CutSide> sides = {});

/// Returns the tag of a surface or of one of its sides, for formats in which each of them is a
/// group: s + 1 for surface s, surface_count + 2 s + 1 for its front and surface_count + 2 s + 2
/// for its back.
[[nodiscard]] std::size_t side_tag(std::size_t surface, CutSide side, std::size_t surface_count);

/// Returns the tag of a block, for formats in which surfaces and blocks are groups, too. No
/// surface, and no side of one, has the same: programs that take the mesh for a simulation, such as
/// GetDP, know a group by its number alone.
[[nodiscard]] std::size_t block_tag(std::size_t block, std::size_t surface_count);

/// Returns the tag of the group of each triangle.
[[nodiscard]] std::vector<std::size_t> group_tags(const std::vector<SurfaceGroup>& groups,
                                                  std::size_t triangle_count);

/// Returns comments that state the surfaces of each tag: `# 3: top, main fault`,
/// `# 4: main fault front`.
[[nodiscard]] std::string tag_comments(const std::vector<SurfaceGroup>& groups,
                                       const std::vector<SurfaceInfo>& surfaces);

/// The group of one side of a split surface, with its name: "F1 front".
struct SideName {
    std::size_t tag = 0; ///< see side_tag
    std::string name;    ///< fit for double quotes
};

/// Returns all sides that some group has, by tag.
[[nodiscard]] std::vector<SideName> side_names(const std::vector<SurfaceGroup>& groups,
                                               const std::vector<SurfaceInfo>& surfaces);

/// Returns "outside" for block 0, otherwise "block 1", ..., followed by its name if it has one:
/// "block 1: top/base".
[[nodiscard]] std::string block_name(std::size_t block, std::span<const std::string> names = {});

} // namespace terrane::detail
