// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/verify.hpp>

#include <algorithm>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/kinds.hpp>
#include <terrane/algorithms/verify/detail/rounded_parts.hpp>
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
    if (stated.empty()) found.push_back({Rule::R9_inputs, {}, "there is no input file"});
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

} // namespace

InputFile input_file(std::string_view contents, std::vector<Surface> surfaces) {
    return {verifier::in_hexadecimal(verifier::hash_of(contents)), contents.size(),
            std::move(surfaces)};
}

double default_max_deviation(std::span<const Surface> inputs) {
    const StandardArithmetic arithmetic;
    Violations not_judged;
    return verifier::default_max_deviation(verifier::join_inputs(inputs, not_judged));
}

Verdict verify_certificate(std::span<const InputFile> files, const Certificate& certificate,
                           const VerifyOptions& options) {
    const StandardArithmetic arithmetic;
    Verdict verdict;
    Violations& found = verdict.violations;
    check_inputs(files, certificate.inputs, found);
    if (!found.empty()) return verdict;
    std::vector<Surface> surfaces;
    for (const InputFile& file : files)
        surfaces.insert(surfaces.end(), file.surfaces.begin(), file.surfaces.end());
    const verifier::Kind& kind = verifier::find_kind(certificate.kind());
    kind.judge(surfaces, certificate, options, verdict);
    if (found.empty() && !certificate.outputs.empty() && !kind.written(certificate))
        found.push_back({Rule::R21_output, {}, "there are output files, but no mesh of doubles"});
    verifier::sort_by_rule(found);
    return verdict;
}

} // namespace terrane
