// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of the kind "arrangement", which are about the arrangement of the surfaces in the
// input files. Other kinds use its sections "exact" and "rounded", too.
#include <terrane/algorithms/verify/detail/kinds.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <terrane/algorithms/verify/detail/digest.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/verify.hpp>

namespace terrane::verifier {

namespace {

/// The names of the constructions, and the number of indices of each.
constexpr std::array<std::pair<std::string_view, std::size_t>, 4> kinds{
    {{"v", 1}, {"lp", 5}, {"ppp", 9}, {"ll", 4}}};

Construction::Kind construction_kind(const Node& node) {
    const auto kind =
        std::ranges::find(kinds, node.string(), [](const auto& k) { return k.first; });
    if (kind == kinds.end()) node.fail("no construction of this name");
    return static_cast<Construction::Kind>(kind - kinds.begin());
}

Axis axis(const Node& node) {
    const std::string_view name = node.string();
    if (name != "x" && name != "y" && name != "z") node.fail("no axis of this name");
    return static_cast<Axis>(name[0] - 'x');
}

/// Reads ["v", i], ["lp", 5 indices], ["ppp", 9 indices] or ["ll", 4 indices, "x" | "y" | "z"].
Construction construction(const Node& node) {
    if (node.size() == 0) node.fail("a construction is needed");
    Construction how;
    std::size_t used = 0; // indices
    node.for_each([&](const Node& item, std::size_t i) {
        if (i == 0) {
            how.kind = construction_kind(item);
            used = kinds[static_cast<std::size_t>(how.kind)].second;
            node.expect_size(1 + used + (how.kind == Construction::Kind::line_line ? 1 : 0));
        } else if (i <= used) {
            how.v[i - 1] = item.index();
        } else {
            how.axis = axis(item);
        }
    });
    return how;
}

ArrangementClaim exact(const Node& node) {
    node.expect_keys(
        {"vertices", "triangles", "parents", "intersection_edges", "degenerate", "duplicates"});
    return {each(node["vertices"], construction),
            each(node["triangles"], indices<3>),
            lists(node["parents"]),
            each(node["intersection_edges"], indices<2>),
            each(node["degenerate"], index),
            each(node["duplicates"], indices<2>)};
}

RoundedClaim rounded(const Node& node) {
    node.expect_keys({"vertices", "triangles", "parents", "intersection_edges", "regions", "clean",
                      "max_move", "deviation", "vanished"});
    RoundedClaim claim;
    claim.vertices = each(node["vertices"], point);
    claim.triangles = each(node["triangles"], indices<3>);
    claim.parents_of = lists(node["parents"]);
    claim.intersection_edges = each(node["intersection_edges"], indices<2>);
    claim.regions_of = lists(node["regions"]);
    claim.clean = node["clean"].flag();
    if (const Node move = node["max_move"]; !move.is_null()) claim.max_move = move.number();
    claim.deviation = node["deviation"].number();
    claim.vanished = each(node["vanished"], index);
    return claim;
}

bool breaks_first_rules(const Violations& found) {
    return std::any_of(found.begin(), found.end(),
                       [](const Violation& v) { return v.rule <= Rule::R2_vertices; });
}

void check_digest(std::span<const Surface> surfaces, const Certificate& certificate,
                  Violations& found) {
    const auto digest = digest_of(surfaces, certificate.exact);
    if (digest == certificate.digest) return;
    found.push_back({Rule::R17_digest, {}, "the digest is " + digest.value_or("undefined")});
}

} // namespace

void parse_arrangement_sections(const Node& node, Certificate& certificate) {
    certificate.exact = exact(node["exact"]);
    if (const Node claim = node["rounded"]; !claim.is_null()) certificate.rounded = rounded(claim);
    certificate.digest = std::string(node["digest"].string());
}

void judge_arrangement(std::span<const Surface> surfaces, const Certificate& certificate,
                       const VerifyOptions& options, Verdict& verdict) {
    Violations found = verify_arrangement(surfaces, certificate.exact);
    if (!breaks_first_rules(found)) {
        if (certificate.rounded) {
            auto rounded =
                verify_rounded(surfaces, certificate.exact, *certificate.rounded, options);
            std::move(rounded.violations.begin(), rounded.violations.end(),
                      std::back_inserter(found));
            verdict.measured = rounded.measured;
        }
        check_digest(surfaces, certificate, found);
    }
    std::move(found.begin(), found.end(), std::back_inserter(verdict.violations));
}

std::optional<WrittenMesh> rounded_mesh(const Certificate& certificate) {
    if (!certificate.rounded) return std::nullopt;
    const RoundedClaim& mesh = *certificate.rounded;
    return WrittenMesh{mesh.vertices,
                       mesh.triangles,
                       mesh.regions_of,
                       mesh.parents_of,
                       surfaces_of_parents(certificate, mesh.parents_of),
                       mesh.clean};
}

const Kind& arrangement_kind() {
    static constexpr std::array<std::string_view, 3> keys{"exact", "rounded", "digest"};
    static constexpr Kind kind{CertificateKind::arrangement, "arrangement",     keys,
                               parse_arrangement_sections,   judge_arrangement, rounded_mesh};
    return kind;
}

} // namespace terrane::verifier
