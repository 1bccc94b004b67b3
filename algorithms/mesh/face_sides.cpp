// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/face_sides.hpp>

#include <algorithm>
#include <utility>

namespace terrane {
namespace {

/// Rotates a triangle so that its least corner comes first; the winding is kept.
Triangle turned(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

} // namespace

std::vector<FaceSides> sides_of_faces(const TetrahedralMesh& mesh) {
    std::vector<std::pair<Triangle, std::uint32_t>> faces;
    faces.reserve(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        faces.emplace_back(turned(mesh.faces[f]), f);
    std::sort(faces.begin(), faces.end());
    std::vector<FaceSides> sides(mesh.faces.size());
    const auto set = [&](const Triangle& corners, TetrahedronSide FaceSides::*which,
                         TetrahedronSide side) {
        const Triangle key = turned(corners);
        auto at = std::lower_bound(faces.begin(), faces.end(), std::pair(key, 0U));
        for (; at != faces.end() && at->first == key; ++at) sides[at->second].*which = side;
    };
    for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
        for (std::uint32_t s = 0; s < 4; ++s) {
            const auto& [i, j, k] = corners_of_side[s];
            const auto& v = mesh.tetrahedra[t];
            set({v[i], v[j], v[k]}, &FaceSides::front, {t, s});
            set({v[k], v[j], v[i]}, &FaceSides::back, {t, s});
        }
    return sides;
}

} // namespace terrane
