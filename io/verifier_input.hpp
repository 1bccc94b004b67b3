// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What the verifier judges, from what the library made and from files. None of this is code of the verifier.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/io/files.hpp>

namespace terrane {

/// Returns the exact result as a claim.
ArrangementClaim claim_of(const Arrangement& arrangement);

/// How the input files of a certificate are read, and how the caller names that.
struct CertifiedReading {
    std::optional<Format> format{}; ///< none: that of each file's name
    ReadOptions options{};
    const char* paths_name = "";                  ///< of a wrong number of files
    std::array<const char*, 2> option_names = {}; ///< see check_reading()
};

/// Reads the input files of a certificate, which are at these paths. A file whose hash differs from the certificate's
/// need not parse: the verifier rejects it by its hash. Errors: cannot_open; unknown_format; bad_option where there
/// are other files than the certificate is about, and those of check_reading; those of parsing a file that has the
/// stated hash.
Result<std::vector<InputFile>> read_certified(const Certificate& certificate,
                                              const std::vector<std::filesystem::path>& paths,
                                              const CertifiedReading& reading);

} // namespace terrane
