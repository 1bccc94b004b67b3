// SPDX-License-Identifier: LGPL-3.0-or-later
//
// OpenGeoSys 6: VTK XML files of the whole mesh and of its boundaries.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetrahedra/edge_nodes.hpp>
#include <terrane/io/meshes/several_files.hpp>

namespace terrane {

/// How files are called and written.
struct VtkFiles {
    std::string stem; ///< name of the first file without its extension; the others begin with it
    bool compress = true; ///< zlib
};

/// Writes the tetrahedra alone, of second order with `nodes`, with the cell array MaterialIDs (Int32),
/// the block. A comment lists the names of the blocks. Each side of a surface is a file
/// STEM_NAME.vtu: NAME is one word (names.hpp), with the ending _front or _back where the surface has
/// tetrahedra on both sides. It has triangles wound counterclockwise seen from outside of their
/// tetrahedra, the point array bulk_node_ids and the cell array bulk_element_ids (UInt64): node and
/// tetrahedron in the first file.
SeveralFiles to_opengeosys(const TetrahedralMesh& mesh, const VtkFiles& files,
                           std::span<const std::string> block_names = {},
                           const EdgeNodes* nodes = nullptr);

} // namespace terrane
