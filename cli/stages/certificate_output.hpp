// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What `arrange` writes for others to check: certificates and exact coordinates.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <terrane/cli/options/files.hpp>
#include <terrane/cli/session/session.hpp>
#include <terrane/cli/stages/pipeline.hpp>

namespace terrane::cli {

struct ProofOptions {
    std::string certificate, exact; ///< files; empty: none
};

void add_proof(CLI::App& command, ProofOptions& options);

/// What is wrong with the names, found before any work is done.
Status plan_proof(const ProofOptions& options, const FileOptions& files);

/// The certificate of a result whose inputs are all of these files, for a file `path`.
/// Errors: cannot_open.
Result<std::string> certificate_text(const std::string& path, const std::vector<std::string>& files,
                                     const Inputs& inputs, const Arranged& arranged,
                                     const Session& session);

/// Whether or not the doubles are conforming: the exact result holds all the same.
Status write_proof(const ProofOptions& options, const FileOptions& files, const Inputs& inputs,
                   const Arranged& arranged, Session& session);

} // namespace terrane::cli
