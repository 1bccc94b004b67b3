// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of the kind "layered", which are about horizons that were put in order.
#include <terrane/algorithms/verify/detail/kinds.hpp>

#include <array>
#include <utility>

#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/layered.hpp>
#include <terrane/algorithms/verify/detail/rounded_parts.hpp>

namespace terrane::verifier {

namespace {

void parse_layered(const Node& node, Certificate& certificate) {
    const Node claim = node["layered"];
    if (claim.has("thickness"))
        claim.expect_keys({"order", "deviation", "thickness", "vertices", "triangles", "layers",
                           "regions", "parents"});
    else
        claim.expect_keys(
            {"order", "deviation", "vertices", "triangles", "layers", "regions", "parents"});
    const auto layer = [](const Node& l) {
        l.expect_keys({"surface", "hardness"});
        return CertifiedLayer{l["surface"].index(), l["hardness"].number()};
    };
    std::size_t surfaces = 0;
    for (const CertifiedInput& input : certificate.inputs) surfaces += input.surfaces.size();
    LayeredClaim layered{each(claim["vertices"], point), each(claim["triangles"], indices<3>),
                         lists(claim["layers"]),         lists(claim["regions"]),
                         lists(claim["parents"]),        each(claim["order"], layer),
                         claim["deviation"].number(),    std::nullopt};
    if (claim.has("thickness")) layered.thickness = claim["thickness"].number();
    for (const CertifiedLayer& l : layered.order)
        if (l.surface >= surfaces) claim["order"].fail("a layer names no surface");
    certificate.beside = std::move(layered);
}

void judge_layered(std::span<const Surface> surfaces, const Certificate& certificate,
                   const VerifyOptions& options, Verdict& verdict) {
    const Inputs inputs = join_inputs(surfaces, verdict.violations);
    const double accepted = options.max_deviation.value_or(default_max_deviation(inputs));
    const LayeredClaim& layered = *certificate.layered();
    check_layered(surfaces, layered, accepted, verdict.violations);
    verdict.measured = Measured{layered.deviation, accepted, 0, 0, false, {}};
}

std::optional<WrittenMesh> written_layered(const Certificate& certificate) {
    const LayeredClaim& mesh = *certificate.layered();
    return WrittenMesh{mesh.vertices,   mesh.triangles,   mesh.regions_of,
                       mesh.parents_of, mesh.surfaces_of, true};
}

} // namespace

const Kind& layered_kind() {
    static constexpr std::array<std::string_view, 1> keys{"layered"};
    static constexpr Kind kind{
        CertificateKind::layered, "layered", keys, parse_layered, judge_layered, written_layered};
    return kind;
}

} // namespace terrane::verifier
