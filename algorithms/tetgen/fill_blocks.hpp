// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Fills the blocks of a model with tetrahedra, by sizes and cuts that are given by name, and checks
// them. Regions have the numbers of the model's blocks.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>

namespace terrane {

/// The name of a surface or block as the user gave it.
struct GivenName {
    std::string name;  ///< name of a surface, or name or number of a block
    std::string place; ///< where the user gave it, for errors: "--size-of", "tetrahedra.split[0]"
};

/// An edge length for a surface or block.
struct NamedSize {
    GivenName of;           ///< surface or block that gets it
    double edge_length = 0; ///< unit of the mesh
};

/// The options of fill_blocks.
struct TetrahedraRequest {
    TetrahedraOptions options{};      ///< without sizes of blocks and surfaces
    std::vector<NamedSize> size_of{}; ///< by surface
    std::vector<NamedSize> size_in{}; ///< by block: its number or its name
    std::vector<GivenName> split{};   ///< surfaces, or "fault": all with that role
    bool outside = true;              ///< whether block 0 gets tetrahedra, too
};

/// The tetrahedra of a model.
struct FilledBlocks {
    TetrahedralMesh tetrahedra;                ///< blocks by the numbers of the blocks
    TetrahedraReport report;                   ///< likewise; with the outside, before splitting
    std::vector<std::string> block_names;      ///< names of the blocks, by block
    std::size_t added_nodes = 0;               ///< number of nodes that splitting added
    std::optional<OptimiseReport> optimised{}; ///< the improvement; none: options said so, or the
                                               ///< checks found violations before
};

/// Fills the blocks with tetrahedra, improves these, checks them against mesh and volumes, and
/// splits nodes. If the checks find violations, nodes are not split. Errors: bad_option, with its place, for a name
/// that does not exist; nothing_to_do if there is no block and the outside is not wanted; those of
/// tetrahedralize and split_nodes; interrupted.
Result<FilledBlocks> fill_blocks(const Model& model, const TetrahedraRequest& request,
                                 const Run& run = {});

/// Makes the tetrahedra alone, which is what takes time: with the outside, blocks by the numbers
/// of find_volumes(mesh), nothing improved or split. Errors: bad_option, those of tetrahedralize.
Result<TetrahedralMesh> make_tetrahedra(const Model& model, const TetrahedraRequest& request,
                                        const Run& run = {});

/// Improves tetrahedra that make_tetrahedra made of the same model, as fill_blocks() does, with
/// the freedom of vertices and the steps, angles and shapes, of `steps`. None, and nothing is changed, if
/// the checks find violations before, or the options ask for nothing. Errors: bad_option, those of
/// optimise().
Result<std::optional<OptimiseReport>>
improve_tetrahedra(const Model& model, const TetrahedraRequest& request,
                   const OptimiseOptions& steps, TetrahedralMesh& made, const Run& run = {});

/// Checks and improves tetrahedra that make_tetrahedra made of the same model, now or earlier,
/// checks what became of them, and splits nodes.
/// Nothing of them is trusted. Errors: those of fill_blocks that are left.
Result<FilledBlocks> fill_blocks(const Model& model, const TetrahedraRequest& request,
                                 TetrahedralMesh made, const Run& run = {});

} // namespace terrane
