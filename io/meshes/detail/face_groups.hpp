// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Groups of the faces of tetrahedra, for formats in which groups have names of one word and a face may be in several.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/io/meshes/detail/side_sets.hpp>

namespace terrane::detail {

/// Faces of the mesh, ascending.
struct FaceGroup {
    std::string name;
    std::vector<std::uint32_t> faces;
};

/// Returns a group for each surface with faces, called after it and, where its nodes are split, followed by those
/// in front and behind the cut, NAME_front and NAME_back.
[[nodiscard]] std::vector<FaceGroup> face_groups(const TetrahedralMesh& mesh,
                                                 const NamedParts& parts);

} // namespace terrane::detail
