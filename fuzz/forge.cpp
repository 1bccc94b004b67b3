// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: the verifier accepts a certificate as it was written, and refuses it once it was
// changed and sealed anew (the digest and the hashes of the output files are computed again),
// unless it still means the same. There is a target for each kind, named by forge_kind. The bytes
// are a list of changes, then the input as an OBJ file; for other kinds than arrangements one byte
// that chooses a model.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/verify/detail/digest.hpp>
#include <terrane/algorithms/verify/detail/kinds.hpp>
#include <terrane/algorithms/verify/verify.hpp>

#include "bytes.hpp"
#include "forge_changes.hpp"
#include "forge_meaning.hpp"
#include "forge_subjects.hpp"
#include "report.hpp"

using namespace terrane;
using fuzz::require;
using fuzz::Subject;

extern const std::string_view forge_kind;

namespace {

/// Judges the certificate as it was written. More rounding than is accepted is refused by design, and
/// so is a part that is cut out otherwise after the input was moved.
bool judge_original(Subject& s) {
    // So are names that are not UTF-8, as a certificate cannot state them.
    const auto& stated = s.certificate.inputs.front().surfaces;
    for (std::size_t i = 0; i < stated.size(); ++i)
        if (stated[i].name != s.surfaces[i].name) return false;
    const auto verdict = verify_certificate(s.files, s.certificate);
    for (const Violation& v : verdict.violations) {
        if (v.rule == Rule::R13_deviation) return false;
        if (v.rule == Rule::R12_rounded_parents && s.certificate.cut) return false;
        fuzz::fail("a right certificate is refused: " + v.sentence);
    }
    OutputVerifier verifier(s.certificate);
    for (std::size_t i = 0; i < s.contents.size(); ++i)
        for (const Violation& v : verifier(s.contents[i], i).violations)
            fuzz::fail("a right file is refused: " + v.sentence);
    if (!verdict.measured) return true;
    s.deviation = verdict.measured->deviation;
    if (s.certificate.rounded)
        require(s.deviation <= s.certificate.rounded->deviation,
                "the deviation is above the stated");
    const auto what = fuzz::difference_in_meaning(s, s.certificate, s.deviation);
    if (!what.empty()) fuzz::fail("a right certificate differs from itself in " + what);
    return true;
}

/// Computes the hashes anew, and the digest where the indices allow it.
void seal(const Subject& s, Certificate& certificate, const fuzz::Contents& contents) {
    for (std::size_t i = 0; i < contents.size() && i < certificate.outputs.size(); ++i) {
        const InputFile file = input_file(contents[i], {});
        certificate.outputs[i].sha256 = file.sha256;
        certificate.outputs[i].bytes = file.bytes;
    }
    if (certificate.filled() || certificate.layered()) return; // they have no digest
    const auto surfaces = fuzz::arranged_surfaces(s, certificate);
    for (const Surface& surface : surfaces)
        for (const Point3& p : surface.vertices)
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return;
    for (const Violation& v : verify_arrangement(surfaces, certificate.exact))
        if (v.rule <= Rule::R2_vertices) return;
    if (const auto digest = verifier::digest_of(surfaces, certificate.exact))
        certificate.digest = *digest;
}

/// Tells whether the verifier accepts all output files, and compares all that they hold.
bool accepts_outputs(const Certificate& changed, const fuzz::Contents& contents) {
    OutputVerifier verifier(changed);
    for (std::size_t i = 0; i < contents.size() && i < changed.outputs.size(); ++i) {
        const auto verdict = verifier(contents[i], i);
        if (!verdict.violations.empty() || !verdict.renamed.empty() ||
            verdict.check == OutputCheck::hash_only)
            return false;
    }
    return true;
}

/// Describes how accepted output files differ from the right ones, which certificates of the same
/// mesh must have; empty if they do not.
std::string difference_of_outputs(const Subject& s, const Certificate& changed,
                                  const fuzz::Contents& contents) {
    const bool folder = s.certificate.kind() == CertificateKind::volumes;
    const auto key = [&](const CertifiedOutput& output) { // what says what the file must hold
        return folder ? output.name : output.format;
    };
    std::map<std::string, std::string> right;
    for (std::size_t i = 0; i < s.contents.size(); ++i)
        right[key(s.certificate.outputs[i])] = s.contents[i];
    if (folder && !changed.outputs.empty() && changed.outputs.size() != s.contents.size())
        return "the files of the folder";
    for (std::size_t i = 0; i < contents.size() && i < changed.outputs.size(); ++i) {
        const auto found = right.find(key(changed.outputs[i]));
        if (found == right.end() || found->second != contents[i])
            return "the file " + changed.outputs[i].name;
    }
    return "";
}

void report(const Subject& s, const std::string& difference, const std::string& what) {
    fuzz::fail("accepted with " + difference + " changed, after: " + what + "\n" +
               fuzz::obj_text(s.surfaces));
}

/// Judges a changed certificate. `rewritten` tells whether the output files follow its claims.
void judge(const Subject& s, const Certificate& changed, const fuzz::Contents& contents,
           bool rewritten, const std::string& what) {
    // A cut part may be stated to be farther away, as far as the user accepts by default: there
    // doubles can be outside of the volume that are near to what is inside.
    VerifyOptions options;
    if (!s.certificate.cut) options.max_deviation = s.deviation * 4;
    const auto verdict = verify_certificate(s.files, changed, options);
    if (!verdict.violations.empty()) return;
    double accepted = verdict.measured ? verdict.measured->max_deviation : 0;
    if (s.certificate.cut && changed.rounded)
        accepted = std::max(s.deviation, changed.rounded->deviation);
    const auto other = fuzz::difference_in_meaning(s, changed, accepted);
    if (!other.empty()) report(s, other, what);
    if (changed.outputs.empty() || !accepts_outputs(changed, contents) || rewritten) return;
    if (!fuzz::writes_the_same(s.certificate, changed)) report(s, "the mesh", what);
    const auto file = difference_of_outputs(s, changed, contents);
    if (!file.empty()) report(s, file, what);
}

/// Returns the subject that the bytes behind the list of changes stand for, if there is one.
const Subject* subject_of(const std::string& rest) {
    const auto kind = verifier::find_kind(forge_kind)->kind;
    if (kind != CertificateKind::arrangement) {
        static std::vector<Subject> all = [&] {
            auto subjects = fuzz::subjects_of(kind);
            for (Subject& s : subjects) require(judge_original(s), "a base model is refused");
            return subjects;
        }();
        return &all[static_cast<unsigned char>(rest[0]) % all.size()];
    }
    static std::string known; // the fuzzer changes mostly the list of changes
    static std::optional<Subject> subject;
    if (rest != known) {
        known = rest;
        subject = fuzz::arrangement_subject(rest);
        if (subject && !judge_original(*subject)) subject.reset();
    }
    return subject ? &*subject : nullptr;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t header = 1 + fuzz::most_changes * fuzz::bytes_of_change;
    if (size <= header) return 0;
    const Subject* const subject =
        subject_of({reinterpret_cast<const char*>(data) + header, size - header});
    if (subject == nullptr) return 0;
    Certificate changed = subject->certificate;
    fuzz::Contents contents = subject->contents;
    fuzz::Bytes bytes(data, header);
    std::string what;
    const unsigned first = bytes.byte();
    for (unsigned n = 1 + first % fuzz::most_changes; n > 0; --n)
        what += fuzz::change(changed, contents, bytes) + "; ";
    const bool rewritten =
        first / fuzz::most_changes % 2 == 1 && fuzz::write_outputs(*subject, changed, contents);
    seal(*subject, changed, contents);
    judge(*subject, changed, contents, rewritten, what);
    return 0;
}
