// SPDX-License-Identifier: LGPL-3.0-or-later
//
// For formats that give each triangle one number only, though it may belong to several surfaces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/lists.hpp>
#include <terrane/algorithms/mesh.hpp>

namespace terrane::detail {

/// The triangles that belong to the same surfaces.
struct SurfaceGroup {
    std::size_t tag = 0;                 ///< s + 1 for surface s alone; larger for several
    std::vector<std::uint32_t> surfaces; ///< ascending
    std::vector<std::size_t> cells;      ///< triangles, ascending
};

/// One group per set of surfaces that some triangle has, in lexicographic order; sets of several
/// are numbered surface_count + 1, ... in that order.
[[nodiscard]] std::vector<SurfaceGroup> surface_groups(const Lists<std::uint32_t>& surfaces_of,
                                                       std::size_t surface_count);

/// Per triangle the tag of its group.
[[nodiscard]] std::vector<std::size_t> group_tags(const std::vector<SurfaceGroup>& groups,
                                                  std::size_t triangle_count);

/// Lines of comment that say which surfaces each tag stands for: `# 3: top, main fault`.
[[nodiscard]] std::string tag_comments(const std::vector<SurfaceGroup>& groups,
                                       const std::vector<SurfaceInfo>& surfaces);

/// "outside" for 0, else "region 1", ..., and what the names given say: "region 1: top/base".
[[nodiscard]] std::string region_name(std::size_t region, std::span<const std::string> names = {});

} // namespace terrane::detail
