// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Judges a certificate: reads the files that it is about, with the readers of io/, and asks the
// verifier, which alone judges.
#pragma once

#include <string>
#include <vector>

#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/reports/verdict_report.hpp>

namespace terrane::cli {

/// A certificate to judge, and how its files are found and read.
struct CertificateRequest {
    std::string certificate;          ///< file; - is standard input
    FileOptions files;                ///< inputs; none: those that the certificate names
    std::vector<std::string> outputs; ///< files that are not where the certificate says
    VerifyOptions options;
};

/// Judges a certificate and the output files. Errors: cannot_open; those of parse_certificate;
/// unknown_format; bad_option where there are other files than the certificate is about; those of
/// reading an input file that has the stated hash.
Judgement judge_certificate(const CertificateRequest& request);

} // namespace terrane::cli
