// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: the verifier accepts the certificate of an arrangement, and refuses it once it was
// changed and sealed anew (digest and hash of the output file computed again), unless it still
// means the same. The bytes are a list of changes, then the input as an OBJ file.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/verify/detail/digest.hpp>
#include <terrane/algorithms/verify/verify_certificate.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/files.hpp>

#include "bytes.hpp"
#include "forge_changes.hpp"
#include "report.hpp"

using namespace terrane;
using fuzz::require;

namespace {

constexpr std::size_t most_triangles = 60;

/// An input with its certificate and its output file.
struct Subject {
    std::vector<InputFile> files;
    std::vector<Surface> surfaces;
    Certificate certificate;
    std::string output;   ///< the OBJ file
    double deviation = 0; ///< as the verifier measured it
};

/// Returns the subject of an OBJ file; none if it is no file, is too large, or cannot be rounded.
std::optional<Subject> make_subject(std::string_view obj) {
    Subject s;
    auto surfaces = parse_surfaces(obj, "input.obj", Format::obj);
    if (!surfaces) return std::nullopt;
    std::size_t count = 0;
    for (const Surface& surface : *surfaces) count += surface.triangles.size();
    if (count > most_triangles) return std::nullopt;
    s.surfaces = std::move(surfaces).value();
    s.files = {input_file(obj, s.surfaces)};
    const auto exact = arrange(s.surfaces);
    if (!exact || exact->triangles.size() > 4 * most_triangles) return std::nullopt;
    const auto rounded = round_to_doubles(*exact);
    if (!rounded) return std::nullopt;
    s.output = format_mesh(rounded->mesh, Format::obj).value();
    const std::vector<InputRecord> inputs{
        {"input.obj", s.files[0].sha256, s.files[0].bytes, s.surfaces.size()}};
    const std::vector<OutputRecord> outputs{
        record_output(s.output, "out.obj", "obj", rounded->mesh->surfaces)};
    const auto text = to_certificate({inputs, s.surfaces, *exact, &*rounded, outputs});
    auto parsed = parse_certificate(text, "certificate");
    if (!parsed) fuzz::fail("a certificate that can't be parsed: " + parsed.error().message());
    s.certificate = std::move(parsed).value();
    return s;
}

/// Judges the certificate as it was written. What vanished without anything near it, and more
/// rounding than is accepted, are refused by design.
bool judge_original(Subject& s) {
    // So are names that are not UTF-8, as a certificate cannot state them.
    const auto& stated = s.certificate.inputs.front().surfaces;
    for (std::size_t i = 0; i < stated.size(); ++i)
        if (stated[i].name != s.surfaces[i].name) return false;
    const auto verdict = verify_certificate(s.files, s.certificate);
    for (const Violation& v : verdict.violations) {
        if (v.rule == Rule::R12_rounded_parents || v.rule == Rule::R13_deviation) return false;
        fuzz::fail("a right certificate is refused: " + v.sentence);
    }
    for (const Violation& v : verify_output(s.output, s.certificate, 0).violations)
        fuzz::fail("a right file is refused: " + v.sentence);
    s.deviation = verdict.measured->deviation;
    require(s.deviation <= s.certificate.rounded->deviation, "the deviation is above the stated");
    return true;
}

/// Computes the digest anew, where the indices allow it.
void seal(const Subject& s, Certificate& certificate) {
    for (const Violation& v : verify_arrangement(s.surfaces, certificate.exact))
        if (v.rule <= Rule::R2_vertices) return;
    if (const auto digest = verifier::digest_of(s.surfaces, certificate.exact))
        certificate.digest = *digest;
}

/// Numbers regions by where they first occur.
std::vector<std::uint32_t> canonical(const IndexLists<std::uint32_t>& regions) {
    std::map<std::uint32_t, std::uint32_t> number_of;
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t region : regions.values)
        numbers.push_back(
            number_of.try_emplace(region, static_cast<std::uint32_t>(number_of.size()))
                .first->second);
    return numbers;
}

bool same_bits(const std::vector<Point3>& a, const std::vector<Point3>& b) {
    const auto bits = [](double d) { return std::bit_cast<std::uint64_t>(d); };
    return std::ranges::equal(a, b, [&](const Point3& p, const Point3& q) {
        return bits(p.x) == bits(q.x) && bits(p.y) == bits(q.y) && bits(p.z) == bits(q.z);
    });
}

/// Tells whether a triangle of one part has the vertices of a triangle of the other, but faces the
/// other side. The digest does not know sides.
bool has_turned(const ArrangementClaim& a, const ArrangementClaim& b) {
    if (a.vertices != b.vertices) return false;
    const auto from_lowest = [](Triangle t) {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        return t;
    };
    std::set<Triangle> known;
    for (const Triangle& t : a.triangles) known.insert(from_lowest(t));
    return std::ranges::any_of(b.triangles, [&](const Triangle& t) {
        return known.contains(from_lowest({t[1], t[0], t[2]}));
    });
}

/// Describes how an accepted certificate differs in meaning; empty if it does not. The stated
/// bounds may be others: the verifier reports its own.
std::string difference(const Certificate& a, const Certificate& b) {
    if (a.digest != b.digest) return "the digest";
    if (has_turned(a.exact, b.exact)) return "a side";
    if (a.rounded.has_value() != b.rounded.has_value()) return "whether there are doubles";
    if (!a.rounded) return "";
    const RoundedClaim &x = *a.rounded, &y = *b.rounded;
    if (!same_bits(x.vertices, y.vertices)) return "the vertices";
    if (x.triangles != y.triangles) return "the triangles";
    if (x.parents_of != y.parents_of) return "the parents";
    if (x.intersection_edges != y.intersection_edges) return "the intersection edges";
    if (x.regions_of.offsets != y.regions_of.offsets ||
        canonical(x.regions_of) != canonical(y.regions_of))
        return "the regions";
    if (x.clean != y.clean || x.vanished != y.vanished) return "what is said of the doubles";
    return "";
}

/// Judges a changed certificate against the output file as it is.
void judge(const Subject& s, const Certificate& changed, const std::string& what) {
    const auto verdict = verify_certificate(s.files, changed, {.max_deviation = s.deviation * 4});
    if (!verdict.violations.empty() || changed.outputs.empty()) return;
    const auto file = verify_output(s.output, changed, 0);
    if (!file.violations.empty() || !file.renamed.empty() || file.check != OutputCheck::doubles)
        return;
    require(verdict.measured.has_value(), "accepted without having been measured");
    const std::string other = difference(s.certificate, changed);
    if (!other.empty())
        fuzz::fail("accepted with " + other + " changed, after: " + what + "\n" +
                   fuzz::obj_text(s.surfaces));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t header = 1 + fuzz::most_changes * fuzz::bytes_of_change;
    if (size <= header) return 0;
    static std::string known; // the fuzzer changes mostly the list of changes
    static std::optional<Subject> subject;
    const std::string obj(reinterpret_cast<const char*>(data) + header, size - header);
    if (obj != known) {
        known = obj;
        subject = make_subject(obj);
        if (subject && !judge_original(*subject)) subject.reset();
    }
    if (!subject) return 0;
    Certificate changed = subject->certificate;
    fuzz::Bytes bytes(data, header);
    std::string what;
    for (unsigned n = 1 + bytes.below(fuzz::most_changes); n > 0; --n)
        what += fuzz::change(changed, bytes) + "; ";
    seal(*subject, changed);
    judge(*subject, changed, what);
    return 0;
}
