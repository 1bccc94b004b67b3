// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Abaqus .inp: nodes, elements, sets and surfaces; no materials, no steps.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Node v + 1 is vertex v, element t + 1 is triangle t (S3). Each surface is an element set, called
/// after it with letters, digits and '_' only; a triangle of several surfaces is in all their sets.
/// Numbers read back as the same doubles.
std::string to_abaqus(const Mesh& mesh);

/// Element t + 1 is tetrahedron t (C3D4), in the element set of its region: outside, region_1, ...,
/// or, where region_names[r] is not empty, called after it as surfaces are; comments say which
/// region a set is. Each surface is a node set and, as faces of elements, the surfaces NAME_FRONT
/// (of the elements in front of it) and NAME_BACK (of those behind it); a side without elements has
/// none. Where nodes are split the unsorted node sets NAME_PAIRS_FRONT and NAME_PAIRS_BACK list the
/// nodes on both sides of the cut, pair by pair.
std::string to_abaqus(const TetrahedralMesh& mesh, std::span<const std::string> region_names = {});

} // namespace terrane
