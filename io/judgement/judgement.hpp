// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Judges a certificate by its files: reads them with the readers of io/, within limits, and asks the
// verifier, which alone judges. It is a library of its own: none of this is code of the verifier, and
// the library does not contain it, as it would need the verifier.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/reading.hpp>

namespace terrane {

/// Returns the exact result as a claim.
ArrangementClaim claim_of(const Arrangement& exact);

/// What a judgement may take.
struct JudgementLimits {
    double time = 3600;   ///< processor seconds
    double memory = 16e9; ///< bytes beyond what the process has before
};

/// How the input files of a certificate are read, and how the caller names that.
struct CertifiedReading {
    std::optional<Format> format{}; ///< none: that of each file's name
    ReadOptions options{};
    const char* paths_name = "";                  ///< of a wrong number of files
    std::array<const char*, 3> option_names = {}; ///< see check_reading()
};

/// A certificate to judge.
struct JudgementRequest {
    std::filesystem::path certificate;             ///< file; - is standard input
    std::vector<std::filesystem::path> inputs{};   ///< none: those that the certificate names
    std::vector<std::filesystem::path> expected{}; ///< files that must be among the inputs
    std::vector<std::filesystem::path> outputs{};  ///< in place of those that they are most like
    /// The files that the certificate names are in this folder. Empty: in that of the certificate, and
    /// not reached through links.
    std::filesystem::path folder{};
    CertifiedReading reading{};
    VerifyOptions options{};
    JudgementLimits limits{};
};

/// An input file, as it was read.
struct JudgedInput {
    std::string path;
    std::uint64_t bytes = 0;
    std::string sha256; ///< empty: of another size than stated, and not read
};

/// An output file, as it was found.
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
    std::vector<JudgedInput> inputs;   ///< in the order of the certificate
    std::vector<JudgedOutput> outputs; ///< all of the certificate; none if that is refuted

    [[nodiscard]] std::vector<Violation> violations() const {
        auto all = verdict.violations;
        for (const JudgedOutput& output : outputs)
            all.insert(all.end(), output.verdict.violations.begin(),
                       output.verdict.violations.end());
        return all;
    }
    /// Whether nothing is refuted, and at least one output file, and each, was compared.
    [[nodiscard]] bool verified() const {
        return violations().empty() && !outputs.empty() &&
               std::ranges::all_of(outputs, &JudgedOutput::verified);
    }
};

/// Judges a certificate, its input files and all of its output files. Errors: cannot_open (also what is no regular file,
/// and what the certificate names outside of its folder or through links); those of parse_certificate; unknown_format;
/// bad_option where there are other files than the certificate is about, and those of check_reading; those of parsing an
/// input file that has the stated hash; timed_out and out_of_memory at the limits; interrupted.
Result<Judgement> judge(const JudgementRequest& request, const std::stop_token& stop = {});

} // namespace terrane
