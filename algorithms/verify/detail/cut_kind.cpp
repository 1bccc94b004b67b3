// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of the kind "cut", which are about an arrangement of which a volume of interest was
// cut out, and of the kind "sealed", whose surfaces were sealed or extended before that. The exact
// part is the arrangement of all surfaces, with what was added to them, and the boundary of the
// volume, with what was left out; the mesh of doubles is what was kept.
#include <terrane/algorithms/verify/detail/kinds.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/verify/detail/cut.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/rounded_parts.hpp>
#include <terrane/algorithms/verify/detail/sealed.hpp>
#include <terrane/algorithms/verify/verify.hpp>

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

VolumeClaim volume_of(const Node& volume, std::size_t inputs) {
    volume.expect_keys({"shape", "corners", "between", "files", "boundary"});
    VolumeClaim claim{std::string(volume["shape"].string()),
                      each(volume["corners"], corner_of_polygon),
                      each(volume["between"], [](const Node& height) { return height.number(); }),
                      volume["files"].index(), each(volume["boundary"], boundary_surface)};
    if (claim.shape.empty()) volume["shape"].fail("no shape of this name");
    if (claim.files > inputs) volume["files"].fail("there are fewer input files");
    return claim;
}

CutClaim cut_of(const Node& claim, std::size_t inputs, bool needs_volume) {
    claim.expect_keys({"volume", "dropped"});
    CutClaim cut;
    if (needs_volume || !claim["volume"].is_null()) cut.volume = volume_of(claim["volume"], inputs);
    cut.dropped = each(claim["dropped"], index);
    return cut;
}

std::array<Point3, 3> added_triangle(const Node& node) {
    node.expect_size(3);
    std::array<Point3, 3> corners{};
    node.for_each([&](const Node& item, std::size_t i) { corners[i] = point(item); });
    return corners;
}

SealedPart sealed_part(const Node& node) {
    node.expect_keys({"limit", "extended", "sealed"});
    return {node["limit"].number(), each(node["extended"], added_triangle),
            each(node["sealed"], added_triangle)};
}

void parse_cut(const Node& node, Certificate& certificate) {
    parse_arrangement_sections(node, certificate);
    parse_cut_sections(node, certificate);
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

/// Judges the doubles by what was kept. `surfaces` are all surfaces of the exact part.
void judge_doubles(std::span<const Surface> surfaces, const Certificate& certificate,
                   const VerifyOptions& options, Verdict& verdict) {
    std::size_t inputs = 0;
    for (const Surface& s : surfaces) inputs += s.triangles.size();
    const RoundedClaim& claim = *certificate.rounded;
    const auto kept = kept_part(certificate);
    const auto is_cut = cut_inputs(certificate, inputs);
    auto rounded = verify_rounded_part(surfaces, kept, claim, options, is_cut);
    verdict.measured = rounded.measured;
    const bool is_sound = rounded.violations.empty();
    const bool has_volume = !certificate.cut->volume.shape.empty();
    // With the exact triangles it is shown already that those inside stay near the inside.
    if (has_volume && !claim.clean && !claim.max_move)
        verdict.violations.push_back({Rule::R52_inside,
                                      {},
                                      "the doubles are not conforming, and other triangles than "
                                      "those that were kept"});
    std::move(rounded.violations.begin(), rounded.violations.end(),
              std::back_inserter(verdict.violations));
    if (is_sound && claim.clean && has_volume)
        check_inside(surfaces, certificate.cut->volume.boundary.size(), claim, verdict.violations);
    if (is_sound && certificate.sealed)
        check_only_kept(surfaces, kept, claim, is_cut, verdict.violations);
}

/// Tells whether nothing is said about a volume, so that nothing was cut.
bool is_empty(const VolumeClaim& volume) {
    return volume.shape.empty() && volume.corners.empty() && volume.between.empty() &&
           volume.files == 0 && volume.boundary.empty();
}

/// Judges what was added and left out, by the claims themselves.
void judge_lists(std::span<const Surface> files, const Certificate& certificate,
                 const VerifyOptions& options, Verdict& verdict) {
    const CutClaim& cut = *certificate.cut;
    if (cut.volume.files > certificate.inputs.size()) {
        verdict.violations.push_back({Rule::R50_volume, {}, "there are fewer input files"});
        return;
    }
    const std::size_t own = arranged_surfaces(certificate);
    if (certificate.sealed) {
        const double accepted = accepted_change(files, certificate, options);
        check_sealed_lists(*certificate.sealed, own, accepted, verdict.violations);
        double limit = 0;
        for (const SealedPart& part : certificate.sealed->surfaces)
            limit = std::max(limit, part.limit);
        verdict.change = SurfaceChange{limit, accepted};
        for (std::uint32_t s = 0; s < certificate.sealed->surfaces.size(); ++s)
            if (is_empty(cut.volume) && !certificate.sealed->surfaces[s].extended.empty())
                verdict.violations.push_back(
                    {Rule::R53_sealed_lists,
                     {s},
                     "surface " + text(s) + " is extended, but there is no volume"});
    }
    if (!is_empty(cut.volume) || !certificate.sealed)
        check_volume(cut.volume, files.subspan(own), verdict.violations);
    if (!sorted_and_unique(std::span(cut.dropped)) ||
        !all_below(cut.dropped, certificate.exact.triangles.size()))
        verdict.violations.push_back(
            {Rule::R51_dropped, {}, "the dropped triangles are unsorted or out of range"});
}

/// Returns the options with the largest deviation that is accepted. It depends on the surfaces
/// of the input files alone, not on a volume or on triangles that the certificate names.
VerifyOptions with_deviation(std::span<const Surface> own, VerifyOptions options) {
    Violations none; // R1 holds
    if (!options.max_deviation)
        options.max_deviation = default_max_deviation(join_inputs(own, none));
    return options;
}

} // namespace

void judge_surfaces(std::span<const Surface> files, const Certificate& certificate,
                    const VerifyOptions& options, Verdict& verdict) {
    if (!certificate.cut) {
        judge_arrangement(files, certificate, options, verdict);
        return;
    }
    Violations& found = verdict.violations;
    judge_lists(files, certificate, options, verdict);
    if (!found.empty()) return;
    const CutClaim& cut = *certificate.cut;
    const auto own = files.first(arranged_surfaces(certificate));
    const auto surfaces = surfaces_of_exact(files, certificate);
    Certificate all;
    all.exact = certificate.exact;
    all.digest = certificate.digest;
    judge_arrangement(surfaces, all, options, verdict);
    if (!found.empty()) return;
    const auto outside = find_outside(surfaces, cut.volume.boundary.size(), certificate.exact);
    check_dropped(outside, cut.dropped, certificate.sealed.has_value(), found);
    if (found.empty() && certificate.sealed)
        check_sealed({surfaces, own, *certificate.sealed, certificate.exact, cut.dropped, outside},
                     found);
    if (certificate.rounded)
        judge_doubles(surfaces, certificate, with_deviation(own, options), verdict);
}

void parse_cut_sections(const Node& node, Certificate& certificate) {
    if (node.has("cut"))
        certificate.cut = cut_of(node["cut"], certificate.inputs.size(), !node.has("sealed"));
    if (!node.has("sealed")) return;
    node.expect_key("cut");
    certificate.sealed = SealedClaim{each(node["sealed"], sealed_part)};
}

ArrangementClaim kept_part(const Certificate& certificate) {
    return certificate.cut ? without(certificate.exact, certificate.cut->dropped)
                           : certificate.exact;
}

double accepted_change(std::span<const Surface> files, const Certificate& certificate,
                       const VerifyOptions& options) {
    if (options.max_change) return *options.max_change;
    return default_max_change(certificate.cut ? files.first(arranged_surfaces(certificate))
                                              : files);
}

std::vector<Surface> surfaces_of_exact(std::span<const Surface> files,
                                       const Certificate& certificate) {
    if (!certificate.cut) return {files.begin(), files.end()};
    const auto own = files.first(arranged_surfaces(certificate));
    auto surfaces = certificate.sealed ? grown_surfaces(own, *certificate.sealed)
                                       : std::vector<Surface>(own.begin(), own.end());
    const auto& boundary = certificate.cut->volume.boundary;
    surfaces.insert(surfaces.end(), boundary.begin(), boundary.end());
    return surfaces;
}

const Kind& cut_kind() {
    static constexpr std::array<std::string_view, 4> keys{"exact", "rounded", "digest", "cut"};
    static constexpr Kind kind{CertificateKind::cut, "cut",       keys, parse_cut,
                               judge_surfaces,       rounded_mesh};
    return kind;
}

const Kind& sealed_kind() {
    static constexpr std::array<std::string_view, 5> keys{"exact", "rounded", "digest", "cut",
                                                          "sealed"};
    static constexpr Kind kind{CertificateKind::sealed, "sealed",    keys, parse_cut,
                               judge_surfaces,          rounded_mesh};
    return kind;
}

} // namespace terrane::verifier

namespace terrane {

Verdict verify_doubles(std::span<const Surface> surfaces, const Certificate& certificate,
                       const VerifyOptions& options) {
    if (!certificate.cut)
        return verify_rounded(surfaces, certificate.exact, *certificate.rounded, options);
    const StandardArithmetic arithmetic;
    Verdict verdict;
    verifier::judge_doubles(surfaces, certificate, options, verdict);
    return verdict;
}

} // namespace terrane
