// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/diffusion.hpp>

namespace terrane {
namespace {

SharedFacet<3> sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

} // namespace

std::vector<std::uint32_t> regions_of_polygons(const IndexLists<std::uint32_t>& polygons,
                                               std::span<const Edge> stops) {
    std::vector<CellFacet<2>> sides;
    sides.reserve(polygons.values.size());
    for (std::uint32_t p = 0; p < polygons.size(); ++p) {
        const auto corners = polygons[p];
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto ends = std::minmax(corners[i], corners[(i + 1) % corners.size()]);
            sides.push_back({{ends.first, ends.second}, p});
        }
    }
    return diffuse<2>(polygons.size(), std::move(sides), stops);
}

std::vector<std::uint32_t> blocks_of_tetrahedra(const TetrahedralMesh& mesh) {
    std::vector<CellFacet<3>> faces;
    faces.reserve(4 * mesh.tetrahedra.size());
    for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
        const auto& [a, b, c, d] = mesh.tetrahedra[t];
        for (const Triangle& face :
             {Triangle{a, b, c}, Triangle{a, b, d}, Triangle{a, c, d}, Triangle{b, c, d}})
            faces.push_back({sorted(face), t});
    }
    std::vector<SharedFacet<3>> stops;
    stops.reserve(mesh.faces.size());
    for (const Triangle& face : mesh.faces) stops.push_back(sorted(face));
    std::sort(stops.begin(), stops.end());
    return diffuse<3>(mesh.tetrahedra.size(), std::move(faces), stops);
}

} // namespace terrane
