// SPDX-License-Identifier: LGPL-3.0-or-later
//
// PyLith 4 and 5: MSH 4.1 in text, with the groups that its MeshIOPetsc makes labels of.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Writes the tetrahedra, their faces on surfaces, and the edges at which faults end inside the domain
/// (lines). With b blocks and n surfaces the physical groups are
///   material-id:R   of dimension 3 and with the number R: block R; the outside is b. PETSc makes the
///                   label material-id with the value R of it
///   NAME            of dimension 2 with the number b + s + 1: surface s
///   NAME_edges      of dimension 1 with the number b + n + s + 1: where the fault s ends inside
/// Names are one word (names.hpp). A triangle, or an edge, of several surfaces is in all their groups.
/// Errors: unsupported if nodes are split, which PyLith does itself.
Result<std::string> to_pylith(const TetrahedralMesh& mesh);

} // namespace terrane
