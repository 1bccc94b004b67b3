// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/detail/face_groups.hpp>

#include <utility>

namespace terrane::detail {

std::vector<FaceGroup> face_groups(const TetrahedralMesh& mesh, const NamedParts& parts) {
    const auto sides = cut_sides(mesh);
    const auto of_surfaces = faces_of_surfaces(mesh);
    std::vector<FaceGroup> groups;
    for (std::size_t s = 0; s < of_surfaces.size(); ++s) {
        if (of_surfaces[s].empty()) continue;
        groups.push_back({parts.surfaces[s], of_surfaces[s]});
        if (sides.empty()) continue;
        for (const SideSet& set : parts.side_sets) {
            if (set.surface != s) continue;
            FaceGroup group{set.name, {}};
            for (const auto f : of_surfaces[s])
                if (sides[f] != CutSide::none && sides[f] == set.side) group.faces.push_back(f);
            if (!group.faces.empty()) groups.push_back(std::move(group));
        }
    }
    return groups;
}

} // namespace terrane::detail
