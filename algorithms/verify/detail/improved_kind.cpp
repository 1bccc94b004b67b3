// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of the kind "improved". They contain the certificate of the mesh before, which is
// the arrangement of the surfaces in the input files, and the improved mesh in the output files.
#include <terrane/algorithms/verify/detail/kinds.hpp>

#include <algorithm>
#include <array>

#include <terrane/algorithms/verify/detail/improved.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>

namespace terrane::verifier {

namespace {

void parse_improved(const Node& node, Certificate& certificate) {
    parse_arrangement_sections(node, certificate);
    parse_cut_sections(node, certificate);
    const Node claim = node["improved"];
    claim.expect_keys(
        {"vertices", "triangles", "surfaces", "regions", "intersection_edges", "limits"});
    certificate.beside =
        ImprovedClaim{each(claim["vertices"], point),
                      each(claim["triangles"], indices<3>),
                      lists(claim["surfaces"]),
                      lists(claim["regions"]),
                      each(claim["intersection_edges"], indices<2>),
                      each(claim["limits"], [](const Node& limit) { return limit.number(); })};
}

void judge_improved(std::span<const Surface> surfaces, const Certificate& certificate,
                    const VerifyOptions& options, Verdict& verdict) {
    judge_surfaces(surfaces, certificate, options, verdict);
    Violations& found = verdict.violations;
    if (!found.empty()) return;
    if (!certificate.rounded || !certificate.rounded->clean)
        found.push_back(
            {Rule::R23_improved_conforming, {}, "there is no conforming mesh that was improved"});
    const double accepted = accepted_change(surfaces, certificate, options);
    check_improved_numbers(*certificate.improved(), surfaces_of_mesh(certificate).size(), accepted,
                           found);
    if (!found.empty()) return;
    const RoundedClaim& rounded = *certificate.rounded;
    const auto surfaces_of = surfaces_of_parents(certificate, rounded.parents_of);
    check_improved({rounded.vertices, rounded.triangles, surfaces_of, rounded.regions_of,
                    rounded.intersection_edges},
                   *certificate.improved(), found);
    double largest = verdict.change ? verdict.change->limit : 0;
    for (const double limit : certificate.improved()->limits) largest = std::max(largest, limit);
    verdict.change = SurfaceChange{largest, accepted};
}

std::optional<WrittenMesh> written_improved(const Certificate& certificate) {
    static const IndexLists<std::uint32_t> no_parents;
    const ImprovedClaim& mesh = *certificate.improved();
    return WrittenMesh{mesh.vertices, mesh.triangles,   mesh.regions_of,
                       no_parents,    mesh.surfaces_of, true};
}

} // namespace

const Kind& improved_kind() {
    static constexpr std::array<std::string_view, 4> keys{"exact", "rounded", "digest", "improved"};
    static constexpr Kind kind{
        CertificateKind::improved, "improved", keys, parse_improved, judge_improved,
        written_improved,          nullptr,    true};
    return kind;
}

} // namespace terrane::verifier
