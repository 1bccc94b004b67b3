// SPDX-License-Identifier: LGPL-3.0-or-later
//
// From a model to tetrahedra that were checked, with sizes and cuts by name. Regions have the
// numbers of the model's blocks.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>

namespace terrane {

/// A surface or a block, as the user calls it.
struct GivenName {
    std::string name;  ///< of a surface or a block
    std::string place; ///< where the user gave it, for errors: "--size-of", "tetrahedra.split[0]"
};

/// An edge length for a name.
struct NamedSize {
    GivenName of;           ///< what gets it
    double edge_length = 0; ///< unit of the mesh
};

/// What fill_blocks is asked for.
struct TetrahedraRequest {
    TetrahedraOptions options{};      ///< without sizes of blocks and surfaces
    std::vector<NamedSize> size_of{}; ///< by surface
    std::vector<NamedSize> size_in{}; ///< by block: its number or its name
    std::vector<GivenName> split{};   ///< surfaces, or "fault": all with that role
    bool outside = true;              ///< whether region 0 gets tetrahedra, too
};

/// The tetrahedra of a model.
struct FilledBlocks {
    TetrahedralMesh tetrahedra; ///< regions by the numbers of the blocks
    TetrahedraReport report;    ///< likewise; of all tetrahedra, the outside too, before the cut
    std::vector<std::string> block_names; ///< per region
    std::size_t added_nodes = 0;          ///< by splitting
    double seconds_tetrahedralize = 0;    ///< time of TetGen
    double seconds_check = 0;             ///< time of the checks
    double seconds_split = 0;             ///< time of splitting nodes
};

/// Fills the blocks with tetrahedra, checks these against mesh and volumes, and splits nodes. Where
/// the checks find violations, nodes are not split. Errors: bad_option with the place of a name
/// that nothing has; nothing_to_do without a block, where there is no outside; those of
/// tetrahedralize and split_nodes; interrupted.
Result<FilledBlocks> fill_blocks(const Model& model, const TetrahedraRequest& request,
                                 const Run& run = {});

} // namespace terrane
