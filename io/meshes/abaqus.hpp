// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Abaqus .inp with nodes, elements, sets and surfaces, but without materials and steps.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetrahedra/edge_nodes.hpp>

namespace terrane {

/// Writes the triangles as shell elements: node v + 1 is vertex v, element t + 1 is triangle t
/// (S3). Each surface is an element set named after it (names.hpp, label_names); a triangle of
/// several surfaces is in all their sets. Numbers read back as the same doubles.
std::string to_abaqus(const Mesh& mesh);

/// Writes the tetrahedra: element t + 1 is tetrahedron t (C3D4). Each block is an element set
/// named after block_names[r], or OUTSIDE, BLOCK_1, ... if that is empty; comments state the
/// block of each set. Each surface is a node set and two surfaces of element faces, NAME_FRONT
/// (of the elements in front of it) and NAME_BACK (of those behind it); a side without elements is
/// left out. If nodes are split, the unsorted node sets NAME_PAIRS_FRONT and NAME_PAIRS_BACK list
/// the nodes on both sides of the cut pair by pair. With `nodes` elements are of second order
/// (C3D10), and sets of nodes have those on edges.
std::string to_abaqus(const TetrahedralMesh& mesh, std::span<const std::string> block_names = {},
                      const EdgeNodes* nodes = nullptr);

} // namespace terrane
