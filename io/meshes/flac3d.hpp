// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Grids of FLAC3D (.f3grid) in text. Reference: Itasca, FLAC3D 7.0 documentation, "FLAC3D Grid Format".
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Writes gridpoints, a zone of type T4 per tetrahedron and a face of type T3 per face; gridpoint v + 1 is vertex
/// v, and so on. Blocks are groups of zones in slot 1, and surfaces groups of faces, of which each has a slot of
/// its own, since a face has one group per slot: NAME and, where nodes are split, NAME_front and NAME_back
/// (names.hpp, WordNames).
std::string to_flac3d(const TetrahedralMesh& mesh, std::span<const std::string> block_names = {});

} // namespace terrane
