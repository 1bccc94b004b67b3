// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/capi/verification.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/judgement/judgement.hpp>

namespace terrane::capi::detail {
namespace {

terrane_verify_options default_verifying() noexcept {
    const JudgementLimits limits;
    return {sizeof(terrane_verify_options),
            nullptr,
            0,
            default_reading(),
            -1,
            -1,
            nullptr,
            limits.time,
            limits.memory};
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

/// Returns what is known of the output files; one that can't be judged is a violation, too.
void add_outputs(const Judgement& judged, terrane_verdict& verdict) {
    if (judged.outputs.empty())
        verdict.items.push_back({"output", "the certificate names no output file", {}});
    for (const JudgedOutput& output : judged.outputs) {
        add(output.verdict.violations, verdict);
        if (output.verified() || !output.verdict.violations.empty()) continue;
        verdict.items.push_back(
            {"output",
             output.path + ": " +
                 (output.missing.empty() ? "the verifier has no writer for its format"
                                         : output.missing),
             {static_cast<std::uint32_t>(output.number)}});
    }
}

std::unique_ptr<terrane_verdict> judge_file(const char* path, const terrane_verify_options* given) {
    const auto options = options_of(given, default_verifying());
    const auto reading = reading_of(&options.reading);
    JudgementRequest request{
        .certificate = needed_file(path),
        .reading = {reading.format,
                    reading.options,
                    "options.inputs",
                    {"options.reading.depth", "options.reading.max_edge",
                     "options.reading.columns"}},
        .options = {number_or_default(options.max_deviation, "options.max_deviation"),
                    number_or_default(options.max_change, "options.max_change")},
        .limits = {options.time, options.memory}};
    need_array(options.inputs, options.input_count, "options.inputs");
    for (const char* input : std::span(options.inputs, options.inputs ? options.input_count : 0))
        request.inputs.emplace_back(needed_text(input, "options.inputs"));
    const auto judged = must(judge(request));
    auto verdict = verdict_of(judged.verdict.violations);
    if (verdict->items.empty()) add_outputs(judged, *verdict);
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
    return produce(out, error, [&] { return judge_file(path, options); });
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
