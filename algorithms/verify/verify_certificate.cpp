// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/verify_certificate.hpp>

#include <algorithm>
#include <iterator>

#include <terrane/algorithms/verify/detail/digest.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/sha256.hpp>

namespace terrane {

namespace {

using verifier::text;
using verifier::Violations;

std::vector<CertifiedSurface> described(std::span<const Surface> surfaces) {
    std::vector<CertifiedSurface> result;
    for (const Surface& s : surfaces)
        result.push_back({s.name, s.role, s.vertices.size(), s.triangles.size()});
    return result;
}

/// Describes a difference between a file and its description; empty if there is none.
std::string difference(const InputFile& file, const CertifiedInput& stated) {
    if (file.sha256 != stated.sha256) return "has another SHA-256";
    if (file.bytes != stated.bytes) return "has another size";
    if (described(file.surfaces) != stated.surfaces) return "has other surfaces";
    return "";
}

void check_inputs(std::span<const InputFile> files, const std::vector<CertifiedInput>& stated,
                  Violations& found) {
    if (files.size() != stated.size())
        found.push_back(
            {Rule::R9_inputs,
             {},
             "there are " + text(files.size()) + " input files, not " + text(stated.size())});
    for (std::uint32_t i = 0; i < std::min(files.size(), stated.size()); ++i) {
        const std::string what = difference(files[i], stated[i]);
        if (what.empty()) continue;
        found.push_back({Rule::R9_inputs,
                         {i},
                         "input " + text(i) + ", " + stated[i].name + ", " + what +
                             " than the certificate says"});
    }
}

bool breaks_first_rules(const Violations& found) {
    return std::any_of(found.begin(), found.end(),
                       [](const Violation& v) { return v.rule <= Rule::R2_vertices; });
}

void check_digest(std::span<const Surface> surfaces, const Certificate& certificate,
                  Violations& found) {
    const auto digest = verifier::digest_of(surfaces, certificate.exact);
    if (digest == certificate.digest) return;
    found.push_back({Rule::R17_digest, {}, "the digest is " + digest.value_or("undefined")});
}

} // namespace

InputFile input_file(std::string_view contents, std::vector<Surface> surfaces) {
    return {verifier::in_hexadecimal(verifier::hash_of(contents)), contents.size(),
            std::move(surfaces)};
}

Verdict verify_certificate(std::span<const InputFile> files, const Certificate& certificate,
                           const VerifyOptions& options) {
    Verdict verdict;
    Violations& found = verdict.violations;
    check_inputs(files, certificate.inputs, found);
    if (!found.empty()) return verdict;
    std::vector<Surface> surfaces;
    for (const InputFile& file : files)
        surfaces.insert(surfaces.end(), file.surfaces.begin(), file.surfaces.end());
    found = verify_arrangement(surfaces, certificate.exact);
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
    if (!certificate.rounded && !certificate.outputs.empty())
        found.push_back({Rule::R21_output, {}, "there are output files, but no mesh of doubles"});
    verifier::sort_by_rule(found);
    return verdict;
}

} // namespace terrane
