// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of the kind "filled", which are about the surfaces of the input files with
// triangles in their holes.
#include <terrane/algorithms/verify/detail/kinds.hpp>

#include <algorithm>
#include <array>

#include <terrane/algorithms/verify/detail/filled.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>

namespace terrane::verifier {

namespace {

void parse_filled(const Node& node, Certificate& certificate) {
    const Node claim = node["filled"];
    claim.expect_keys({"vertices", "triangles", "surfaces", "invented", "deviation"});
    const auto part = [](const Node& s) {
        s.expect_keys({"vertices", "triangles", "limit"});
        return FilledPart{s["vertices"].index(), s["triangles"].index(), s["limit"].number()};
    };
    const auto expected_error = [](const Node& error) {
        return error.is_null() ? std::numeric_limits<double>::quiet_NaN() : error.number();
    };
    certificate.beside =
        FilledClaim{each(claim["vertices"], point), each(claim["triangles"], indices<3>),
                    each(claim["surfaces"], part), each(claim["invented"], index),
                    each(claim["deviation"], expected_error)};
}

void judge_filled(std::span<const Surface> surfaces, const Certificate& certificate,
                  const VerifyOptions& options, Verdict& verdict) {
    const double accepted = options.max_change.value_or(default_max_change(surfaces));
    check_filled(surfaces, *certificate.filled(), accepted, verdict.violations);
    double limit = 0;
    for (const FilledPart& part : certificate.filled()->surfaces)
        limit = std::max(limit, part.limit);
    verdict.change = SurfaceChange{limit, accepted};
}

std::optional<WrittenMesh> written_filled(const Certificate& certificate) {
    static const IndexLists<std::uint32_t> none;
    const FilledClaim& filled = *certificate.filled();
    IndexLists<std::uint32_t> surfaces_of;
    for (std::uint32_t s = 0; s < filled.surfaces.size(); ++s)
        for (std::uint32_t t = 0; t < filled.surfaces[s].triangles; ++t)
            surfaces_of.push_back(std::array{s});
    return WrittenMesh{filled.vertices, filled.triangles, none, none, std::move(surfaces_of),
                       false,           &filled};
}

} // namespace

const Kind& filled_kind() {
    static constexpr std::array<std::string_view, 1> keys{"filled"};
    static constexpr Kind kind{CertificateKind::filled, "filled", keys, parse_filled, judge_filled,
                               written_filled};
    return kind;
}

} // namespace terrane::verifier
