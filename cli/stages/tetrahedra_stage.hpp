// SPDX-License-Identifier: LGPL-3.0-or-later
//
// From a conforming mesh to tetrahedra that were checked, with sizes and cuts by name: what
// tetrahedralize and build share.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/session/session.hpp>

namespace terrane::cli {

/// A surface or a block, as the user calls it.
struct NameOnCommandLine {
    std::string name;
    std::string place; ///< where the user said so: "--size-of", "tetrahedra.split[0]"
};

struct NamedSize {
    NameOnCommandLine of;
    double edge_length = 0;
};

struct TetrahedraRequest {
    TetrahedraOptions options{};            ///< without sizes of blocks and surfaces
    std::vector<NamedSize> size_of{};       ///< by surface
    std::vector<NamedSize> size_in{};       ///< by block: its number or its name
    std::vector<NameOnCommandLine> split{}; ///< surfaces, or "fault": all with that role
    bool outside = true;                    ///< whether region 0 gets tetrahedra, too
};

/// A mesh and its blocks by the numbers that the user sees.
struct BlocksOfMesh {
    const Mesh& mesh;
    std::span<const std::string> labels; ///< per surface of the mesh: its name, made unique
    const Volumes& volumes;              ///< of the mesh
    const Structure& structure;          ///< by the same numbers
};

struct Filled {
    TetrahedralMesh tetrahedra; ///< regions by the numbers of the blocks
    TetrahedraReport report;    ///< likewise; of all tetrahedra, the outside too, before the cut
    std::vector<std::string> block_names; ///< per region, of the surfaces around it
    std::size_t added_nodes = 0;          ///< by splitting
};

/// Tetrahedra, their checks, and what was wished for. Adds to `statistics`. Where the checks find
/// violations, nodes are not split. Errors: bad_option with the place of a name that nothing has;
/// those of tetrahedralize and split_nodes.
Result<Filled> fill_and_check(const BlocksOfMesh& blocks, const TetrahedraRequest& wishes,
                              Session& session, Json& statistics);

/// Counts, per region too, the checks and the shapes.
std::string filled_text(const Filled& filled);

} // namespace terrane::cli
