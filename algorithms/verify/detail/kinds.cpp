// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/kinds.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <terrane/algorithms/verify/detail/box_tree.hpp>
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
    Box box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (const Surface& surface : surfaces)
        for (const Triangle& t : surface.triangles) extend(box, box_of(surface.vertices, t));
    double part = 0;
    for (std::size_t i = 0; i < 3; ++i)
        if (box.low[i] < box.high[i]) part = std::hypot(part, box.high[i] / 20 - box.low[i] / 20);
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
    return surfaces_of_parents(surfaces_of_inputs(certificate), parents_of);
}

} // namespace terrane::verifier
