// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Universal files of I-DEAS (.unv), which Salome, Gmsh and others read. Reference: SDRC, Universal Dataset Number 2411,
// 2412 and 2467.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Writes nodes (2411), with 17 digits, triangles as thin shells (type 91 of 2412) and a group (2467) for each
/// surface. Names have one word (names.hpp, WordNames) of at most 40 bytes; a longer one is cut and ends with '~'
/// and the number of its group. Node v + 1 is vertex v. Errors: unsupported for more than 2147483647 elements.
Result<std::string> to_universal(const Mesh& mesh);

/// Does the same with tetrahedra (type 111), then their faces on surfaces, and with a group for each block as well.
/// Where nodes are split, there are groups NAME_front and NAME_back, too.
Result<std::string> to_universal(const TetrahedralMesh& mesh,
                                 std::span<const std::string> block_names = {});

} // namespace terrane
