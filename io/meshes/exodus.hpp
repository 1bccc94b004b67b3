// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Exodus II, in NetCDF's classic format with offsets of 64 bits. It is read by MOOSE, Sierra, ParaView and others.
// Reference: Mills-Curran et al., EXODUS: A Finite Element Data Model, SAND92-2137, 2019.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetrahedra/edge_nodes.hpp>

namespace terrane {

/// Writes the tetrahedra block by block, of the type TETRA, or TETRA10 with `nodes`: node v + 1 is
/// vertex v. All parts have names of one word (names.hpp), with n surfaces:
///   element blocks  one per block with the number of the block, and the outside with the one
///                   after all others; called after block_names[r], or outside, block_1, ...
///   side sets       NAME with the number s + 1 for surface s with tetrahedra on one side; else
///                   NAME_front with n + 2 s + 1 and NAME_back with n + 2 s + 2
///   node sets       NAME with s + 1: all nodes of surface s. If nodes are split: NAME_front and
///                   NAME_back with the numbers above, the nodes of the faces on these sides, and
///                   NAME_pairs_front, NAME_pairs_back with 3 n + 2 s + 1 and + 2, the nodes at one
///                   place, pair by pair. Of faults also NAME_edges with 5 n + s + 1, the nodes at
///                   which they end inside the domain.
/// Names longer than 32 characters are complete; ex_set_max_name_length() makes the library of
/// Exodus return them.
/// Errors: unsupported (an array of 4 GiB or more: more than 268435455 tetrahedra in a block).
Result<std::string> to_exodus(const TetrahedralMesh& mesh,
                              std::span<const std::string> block_names = {},
                              const EdgeNodes* nodes = nullptr);

} // namespace terrane
