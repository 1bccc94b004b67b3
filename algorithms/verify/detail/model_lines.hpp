// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The lines and corners of model.json, as they follow from a mesh, its interfaces and its patches.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/verify/detail/block_files.hpp>
#include <terrane/algorithms/verify/detail/blocks.hpp>

namespace terrane::verifier {

/// A chain of edges at which patches meet or end.
struct LinePart {
    std::string_view kind; ///< "free border", "boundary line", ...
    Numbers vertices; ///< from the lesser end; closed: from the least vertex, which is repeated
    Numbers patches;  ///< ascending
    Numbers surfaces; ///< ascending
    std::array<std::uint32_t, 2> corners{no_number,
                                         no_number}; ///< no_number: closed without corner
    double length = 0;
};

/// A vertex at which lines end.
struct CornerPart {
    std::uint32_t vertex = 0;
    Numbers lines; ///< ascending; twice if both ends do
};

/// The lines, ordered by the lists of their vertices in lexicographic order; the corners, in
/// lexicographic order.
struct LineParts {
    std::vector<LinePart> lines;
    std::vector<CornerPart> corners;
    std::vector<Numbers> lines_of_patch; ///< ascending
};

/// Finds all lines. Other than two triangles meet at their edges, or two of different interfaces.
/// They end in corners, where other than two such edges meet, or two with different patches.
LineParts find_lines(const WrittenMesh& mesh, std::span<const SurfaceInfo> surfaces,
                     const BlockParts& parts);

} // namespace terrane::verifier
