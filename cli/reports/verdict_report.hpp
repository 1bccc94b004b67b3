// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reports the findings of the verifier about a certificate as text and as JSON.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/cli/session/console.hpp>

namespace terrane::cli {

/// An output file of the certificate, and the findings about it.
struct JudgedOutput {
    std::size_t number = 0; ///< in the certificate
    std::string path;       ///< where it was looked for
    std::string missing;    ///< why it could not be read; empty: it was
    OutputVerdict verdict;

    [[nodiscard]] bool verified() const {
        return missing.empty() && verdict.violations.empty() &&
               verdict.check != OutputCheck::hash_only;
    }
};

/// All that was found.
struct Judgement {
    Certificate certificate;
    Verdict verdict;
    std::vector<JudgedOutput> outputs; ///< none if the certificate is refuted

    [[nodiscard]] std::vector<Violation> violations() const {
        auto all = verdict.violations;
        for (const JudgedOutput& output : outputs)
            all.insert(all.end(), output.verdict.violations.begin(),
                       output.verdict.violations.end());
        return all;
    }
    [[nodiscard]] ExitStatus status() const {
        if (!violations().empty()) return ExitStatus::negative;
        const bool all = std::ranges::all_of(outputs, &JudgedOutput::verified);
        return all && !outputs.empty() ? ExitStatus::done : ExitStatus::bad_input;
    }
};

/// Says what a valid certificate states, or which rules it breaks.
std::string verdict_text(const Judgement& judged, const std::string& name);
/// The same as JSON.
std::string verdict_json(const Judgement& judged);

} // namespace terrane::cli
