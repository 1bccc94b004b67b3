// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of the kind "cut", which are about an arrangement of which a volume of interest was
// cut out. The exact part is the arrangement of all surfaces and the boundary of the volume, with
// what is outside; the mesh of doubles is what was kept.
#include <terrane/algorithms/verify/detail/kinds.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <terrane/algorithms/verify/detail/cut.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/rounded_parts.hpp>

namespace terrane::verifier {

namespace {

Surface boundary_surface(const Node& node) {
    node.expect_keys({"name", "vertices", "triangles"});
    return {std::string(node["name"].string()), Role::boundary, each(node["vertices"], point),
            each(node["triangles"], indices<3>)};
}

std::array<double, 2> corner_of_polygon(const Node& node) {
    node.expect_size(2);
    std::array<double, 2> corner{};
    node.for_each([&](const Node& item, std::size_t i) { corner[i] = item.number(); });
    return corner;
}

void parse_cut(const Node& node, Certificate& certificate) {
    parse_arrangement_sections(node, certificate);
    const Node claim = node["cut"];
    claim.expect_keys({"volume", "dropped"});
    const Node volume = claim["volume"];
    volume.expect_keys({"shape", "corners", "between", "files", "boundary"});
    certificate.cut =
        CutClaim{{std::string(volume["shape"].string()), each(volume["corners"], corner_of_polygon),
                  each(volume["between"], [](const Node& height) { return height.number(); }),
                  volume["files"].index(), each(volume["boundary"], boundary_surface)},
                 each(claim["dropped"], index)};
    if (certificate.cut->volume.files > certificate.inputs.size())
        volume["files"].fail("there are fewer input files");
}

/// Returns the number of surfaces in the input files that do not hold the boundary.
std::size_t arranged_surfaces(const Certificate& certificate) {
    std::size_t count = 0;
    const std::size_t files = certificate.inputs.size() - certificate.cut->volume.files;
    for (std::size_t i = 0; i < files; ++i) count += certificate.inputs[i].surfaces.size();
    return count;
}

/// Tells for each input triangle whether some of its exact triangles were dropped.
std::vector<bool> cut_inputs(const Certificate& certificate, std::size_t inputs) {
    std::vector<bool> is_cut(inputs);
    for (const std::uint32_t t : certificate.cut->dropped)
        for (const std::uint32_t parent : certificate.exact.parents_of[t]) is_cut[parent] = true;
    return is_cut;
}

void judge_doubles(std::span<const Surface> surfaces, const Certificate& certificate,
                   const VerifyOptions& options, Verdict& verdict) {
    std::size_t inputs = 0;
    for (const Surface& s : surfaces) inputs += s.triangles.size();
    auto rounded =
        verify_rounded_part(surfaces, without(certificate.exact, certificate.cut->dropped),
                            *certificate.rounded, options, cut_inputs(certificate, inputs));
    verdict.measured = rounded.measured;
    const RoundedClaim& claim = *certificate.rounded;
    const bool is_sound = rounded.violations.empty() && claim.clean;
    // With the exact triangles it is shown already that those inside stay near the inside.
    if (!claim.clean && !claim.max_move)
        verdict.violations.push_back({Rule::R52_inside,
                                      {},
                                      "the doubles are not conforming, and other triangles than "
                                      "those that were kept"});
    std::move(rounded.violations.begin(), rounded.violations.end(),
              std::back_inserter(verdict.violations));
    if (is_sound)
        check_inside(surfaces, certificate.cut->volume.boundary.size(), *certificate.rounded,
                     verdict.violations);
}

void judge_cut(std::span<const Surface> files, const Certificate& certificate,
               const VerifyOptions& options, Verdict& verdict) {
    Violations& found = verdict.violations;
    const CutClaim& cut = *certificate.cut;
    if (cut.volume.files > certificate.inputs.size()) {
        found.push_back({Rule::R50_volume, {}, "there are fewer input files"});
        return;
    }
    const std::size_t own = arranged_surfaces(certificate);
    check_volume(cut.volume, files.subspan(own), found);
    const auto& dropped = cut.dropped;
    if (!sorted_and_unique(std::span(dropped)) ||
        !all_below(dropped, certificate.exact.triangles.size()))
        found.push_back(
            {Rule::R51_dropped, {}, "the dropped triangles are unsorted or out of range"});
    if (!found.empty()) return;
    std::vector<Surface> surfaces(files.begin(), files.begin() + static_cast<std::ptrdiff_t>(own));
    surfaces.insert(surfaces.end(), cut.volume.boundary.begin(), cut.volume.boundary.end());
    Certificate all;
    all.exact = certificate.exact;
    all.digest = certificate.digest;
    judge_arrangement(surfaces, all, options, verdict);
    if (!found.empty()) return;
    check_dropped(surfaces, cut.volume.boundary.size(), certificate.exact, dropped, found);
    if (certificate.rounded) judge_doubles(surfaces, certificate, options, verdict);
}

} // namespace

const Kind& cut_kind() {
    static constexpr std::array<std::string_view, 4> keys{"exact", "rounded", "digest", "cut"};
    static constexpr Kind kind{CertificateKind::cut, "cut", keys, parse_cut, judge_cut,
                               rounded_mesh};
    return kind;
}

} // namespace terrane::verifier
