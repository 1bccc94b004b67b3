// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/capi/verification.h>

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/verifier_input.hpp>

namespace terrane::capi::detail {
namespace {

namespace fs = std::filesystem;

terrane_verify_options default_verifying() noexcept {
    return {sizeof(terrane_verify_options), nullptr, 0, default_reading(), -1, -1};
}

void add(const std::vector<Violation>& violations, terrane_verdict& verdict) {
    for (const Violation& v : violations)
        verdict.items.push_back({name_of(v.rule), v.sentence, v.elements});
}

std::unique_ptr<terrane_verdict> verdict_of(const std::vector<Violation>& violations) {
    auto verdict = std::make_unique<terrane_verdict>();
    add(violations, *verdict);
    return verdict;
}

std::vector<InputFile> read_inputs(const fs::path& folder, const terrane_verify_options& options,
                                   const Certificate& certificate) {
    need_array(options.inputs, options.input_count, "options.inputs");
    std::vector<fs::path> paths;
    if (options.inputs)
        for (const char* path : std::span(options.inputs, options.input_count))
            paths.emplace_back(needed_text(path, "options.inputs"));
    else
        for (const CertifiedInput& input : certificate.inputs) paths.push_back(folder / input.name);
    const auto reading = reading_of(&options.reading);
    return must(read_certified(certificate, paths,
                               {reading.format,
                                reading.options,
                                "options.inputs",
                                {"options.reading.depth", "options.reading.max_edge"}}));
}

/// Judges the output files that a certificate names; one that can't be judged is a violation, too.
void judge_outputs(const fs::path& folder, const Certificate& certificate,
                   terrane_verdict& verdict) {
    const auto refuse = [&](const std::string& sentence, std::uint32_t output) {
        verdict.items.push_back({"output", sentence, {output}});
    };
    if (certificate.outputs.empty())
        verdict.items.push_back({"output", "the certificate names no output file", {}});
    OutputVerifier verifier(certificate);
    for (std::uint32_t i = 0; i < certificate.outputs.size(); ++i) {
        const std::string& name = certificate.outputs[i].name;
        if (name == "-") {
            refuse("the certificate names standard output", i);
            continue;
        }
        const auto contents = read_file(folder / name);
        if (!contents) {
            refuse(contents.error().message(), i);
            continue;
        }
        const OutputVerdict found = verifier(*contents, i);
        add(found.violations, verdict);
        if (found.violations.empty() && found.check == OutputCheck::hash_only)
            refuse(name + ": the verifier has no writer for its format", i);
    }
}

std::unique_ptr<terrane_verdict> judge(const char* path, const terrane_verify_options* given) {
    const fs::path file = needed_file(path);
    const auto options = options_of(given, default_verifying());
    const auto text = must(read_file(file));
    const auto certificate = must(parse_certificate(text, file.string()));
    const auto inputs = read_inputs(file.parent_path(), options, certificate);
    const VerifyOptions limits{number_or_default(options.max_deviation, "options.max_deviation"),
                               number_or_default(options.max_change, "options.max_change")};
    auto verdict = verdict_of(verify_certificate(inputs, certificate, limits).violations);
    if (verdict->items.empty()) judge_outputs(file.parent_path(), certificate, *verdict);
    return verdict;
}

const terrane_verdict::Item* item_at(const terrane_verdict* verdict,
                                     std::size_t violation) noexcept {
    return known(verdict) && violation < verdict->items.size() ? &verdict->items[violation]
                                                               : nullptr;
}

} // namespace
} // namespace terrane::capi::detail

using namespace terrane::capi::detail;

terrane_code terrane_verify_options_init(terrane_verify_options* options, size_t struct_size) {
    return init_options(options, struct_size, default_verifying());
}

terrane_code terrane_verify_arrangement(const terrane_surfaces* surfaces,
                                        const terrane_arrangement* arrangement,
                                        terrane_verdict** out, terrane_error** error) {
    return produce(out, error, [&] {
        const auto& list = needed(surfaces, "surfaces").list;
        return verdict_of(
            terrane::verify_arrangement(list, claim_of(*needed(arrangement, "arrangement").exact)));
    });
}

terrane_code terrane_verify_mesh(const terrane_mesh* mesh, terrane_verdict** out,
                                 terrane_error** error) {
    return produce(out, error, [&] {
        const terrane::Mesh& judged = needed(mesh, "mesh").mesh;
        return verdict_of(terrane::verify_conforming(judged.vertices, judged.triangles));
    });
}

terrane_code terrane_verify_certificate(const char* path, const terrane_verify_options* options,
                                        terrane_verdict** out, terrane_error** error) {
    return produce(out, error, [&] { return judge(path, options); });
}

void terrane_verdict_free(terrane_verdict* verdict) {
    release(verdict);
}

int terrane_verdict_is_valid(const terrane_verdict* verdict) {
    return known(verdict) && verdict->items.empty() ? 1 : 0;
}

size_t terrane_verdict_count(const terrane_verdict* verdict) {
    return known(verdict) ? verdict->items.size() : 0;
}

const char* terrane_verdict_rule(const terrane_verdict* verdict, size_t violation) {
    const auto* item = item_at(verdict, violation);
    return item ? item->rule.c_str() : nullptr;
}

const char* terrane_verdict_sentence(const terrane_verdict* verdict, size_t violation) {
    const auto* item = item_at(verdict, violation);
    return item ? item->sentence.c_str() : nullptr;
}

const uint32_t* terrane_verdict_elements(const terrane_verdict* verdict, size_t violation,
                                         size_t* count) {
    const auto* item = item_at(verdict, violation);
    return array_of<uint32_t>(item ? &item->elements : nullptr, count);
}
