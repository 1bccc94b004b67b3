// SPDX-License-Identifier: LGPL-3.0-or-later
//
// For formats that give each triangle one number only, though it may belong to several surfaces.
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

/// Where nodes are split (split_nodes.hpp), the face in front of the cut and the one behind it.
enum class CutSide : std::uint8_t { none, front, back };

/// "", " front", " back".
[[nodiscard]] std::string_view ending_of(CutSide side);

/// Per face; none at all where no nodes are split.
[[nodiscard]] std::vector<CutSide> cut_sides(const TetrahedralMesh& mesh);

/// The triangles that belong to the same surfaces, on the same side of a cut.
struct SurfaceGroup {
    std::size_t tag = 0;                 ///< s + 1 for surface s alone, without cut; else larger
    std::vector<std::uint32_t> surfaces; ///< ascending
    CutSide side = CutSide::none;
    std::vector<std::size_t> cells; ///< triangles, ascending
};

/// One group per set of surfaces that some triangle has and side of a cut, in lexicographic order;
/// sets of several, and sides, are numbered surface_count + 1, ... in that order. `sides`: per
/// triangle, or empty.
[[nodiscard]] std::vector<SurfaceGroup> surface_groups(const IndexLists<std::uint32_t>& surfaces_of,
                                                       std::size_t surface_count,
                                                       std::span<const CutSide> sides = {});

/// For formats in which each surface, and each side of one that is cut, has a group of its own:
/// s + 1 for surface s, and after those 2 s + 1 for its front, 2 s + 2 for its back.
[[nodiscard]] std::size_t side_tag(std::size_t surface, CutSide side, std::size_t surface_count);

/// Per triangle the tag of its group.
[[nodiscard]] std::vector<std::size_t> group_tags(const std::vector<SurfaceGroup>& groups,
                                                  std::size_t triangle_count);

/// Lines of comment that say which surfaces each tag stands for: `# 3: top, main fault`,
/// `# 4: main fault front`.
[[nodiscard]] std::string tag_comments(const std::vector<SurfaceGroup>& groups,
                                       const std::vector<SurfaceInfo>& surfaces);

/// A side of a surface that is cut, as a group with a name: "F1 front".
struct SideName {
    std::size_t tag = 0; ///< as side_tag has it
    std::string name;    ///< for double quotes
};

/// Of all sides that some group has, by tag.
[[nodiscard]] std::vector<SideName> side_names(const std::vector<SurfaceGroup>& groups,
                                               const std::vector<SurfaceInfo>& surfaces);

/// "outside" for 0, else "region 1", ..., and what the names given say: "region 1: top/base".
[[nodiscard]] std::string region_name(std::size_t region, std::span<const std::string> names = {});

} // namespace terrane::detail
