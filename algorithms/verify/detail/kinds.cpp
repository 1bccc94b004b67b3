// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/kinds.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <terrane/algorithms/verify/detail/inputs.hpp>

namespace terrane::verifier {

namespace {

/// All kinds, in the order of CertificateKind.
const auto& all_kinds() {
    static const std::array all{&arrangement_kind(), &volumes_kind(), &tetrahedra_kind(),
                                &improved_kind(),    &filled_kind(),  &layered_kind(),
                                &cut_kind(),         &sealed_kind()};
    return all;
}

/// Returns the surface of each input triangle.
Numbers surfaces_of_inputs(const Certificate& certificate) {
    Numbers surface_of;
    std::uint32_t surface = 0;
    for (const CertifiedSurface& s : surfaces_of_mesh(certificate))
        surface_of.insert(surface_of.end(), s.triangles, surface++);
    return surface_of;
}

} // namespace

const Kind* find_kind(std::string_view name) {
    const auto found = std::ranges::find(all_kinds(), name, &Kind::name);
    return found == all_kinds().end() ? nullptr : *found;
}

const Kind& find_kind(CertificateKind kind) {
    return **std::ranges::find(all_kinds(), kind, &Kind::kind);
}

double default_max_change(std::span<const Surface> surfaces) {
    std::array<double, 3> low{infinity, infinity, infinity};
    std::array<double, 3> high{-infinity, -infinity, -infinity};
    for (const Surface& surface : surfaces)
        for (const Triangle& t : surface.triangles)
            for (const std::uint32_t corner : t) {
                const Point3& p = surface.vertices[corner];
                const std::array<double, 3> at{p.x, p.y, p.z};
                for (std::size_t i = 0; i < 3; ++i) {
                    low[i] = std::min(low[i], at[i]);
                    high[i] = std::max(high[i], at[i]);
                }
            }
    double part = 0;
    for (std::size_t i = 0; i < 3; ++i)
        if (low[i] < high[i]) part = std::hypot(part, high[i] / 20 - low[i] / 20);
    return part;
}

std::vector<CertifiedSurface> surfaces_of_mesh(const Certificate& certificate) {
    std::vector<CertifiedSurface> all;
    const std::size_t files =
        certificate.inputs.size() - (certificate.cut ? certificate.cut->volume.files : 0);
    for (const CertifiedInput& input : std::span(certificate.inputs).first(files))
        all.insert(all.end(), input.surfaces.begin(), input.surfaces.end());
    if (certificate.sealed)
        for (std::size_t s = 0; s < all.size(); ++s) {
            const SealedPart& part = certificate.sealed->surfaces.at(s);
            const std::size_t added = part.extended.size() + part.sealed.size();
            all[s].vertices += 3 * added;
            all[s].triangles += added;
        }
    if (certificate.cut)
        for (const Surface& s : certificate.cut->volume.boundary)
            all.push_back({s.name, s.role, s.vertices.size(), s.triangles.size()});
    if (!certificate.layered()) return all;
    std::vector<CertifiedSurface> layers;
    for (const CertifiedLayer& layer : certificate.layered()->order)
        layers.push_back(all.at(layer.surface));
    return layers;
}

IndexLists<std::uint32_t> surfaces_of_parents(const Certificate& certificate,
                                              const IndexLists<std::uint32_t>& parents_of) {
    const auto surface_of = surfaces_of_inputs(certificate);
    IndexLists<std::uint32_t> surfaces_of;
    for (std::size_t t = 0; t < parents_of.size(); ++t) {
        Numbers surfaces;
        for (const std::uint32_t parent : parents_of[t]) surfaces.push_back(surface_of[parent]);
        surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
        surfaces_of.push_back(surfaces); // parents are sorted, and so are their surfaces
    }
    return surfaces_of;
}

} // namespace terrane::verifier
