// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates and exact coordinates, which others can check.
#pragma once

#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <terrane/cli/options/files.hpp>
#include <terrane/cli/session/session.hpp>
#include <terrane/io/certify.hpp>

namespace terrane::cli {

struct ProofOptions {
    std::string certificate, exact; ///< files; empty: none
};

/// Adds --certificate and --exact.
void add_proof(CLI::App& command, ProofOptions& options);
/// Adds --certificate only.
void add_certificate(CLI::App& command, std::string& certificate);

/// Warns if `terrane verify` refuses the certificate of a result in `file`, or accepts its deviation
/// only with an option.
void warn_of_refusal(const std::string& certificate, const std::filesystem::path& file,
                     const CertifiedResult& result);

/// Checks the file names before any work is done. Errors: bad_option, cannot_open.
void plan_proof(const ProofOptions& options, const FileOptions& files);

/// Checks before any work is done that a certificate can name these files. It is UTF-8 and names
/// them relative to its folder. Errors: bad_option.
void check_certified_names(const std::string& certificate, const std::vector<std::string>& files);

/// Checks before any work is done that a certificate can state the names of surfaces, which are
/// those of their files. Errors: bad_option, with the file as its place.
void check_certified_surfaces(std::span<const std::string> names,
                              std::span<const std::string> files);

/// Reads all inputs; if `certificate` is not empty, their surfaces must have names that it can
/// state. Errors: those of read_inputs; bad_option.
Inputs read_certified_inputs(const std::string& certificate, const FileOptions& options,
                             Session& session);

/// Tells whether a certificate can be about tetrahedra in this format and of this order.
bool is_certifiable(Format format, unsigned order);

/// Returns the input files of a result.
std::vector<SourceFile> certified_inputs(const std::vector<std::string>& files,
                                         const Inputs& inputs);
/// Returns the files that were written. Output to a standard stream, which can't be read again,
/// is made once more.
std::vector<ResultFile> certified_outputs(const std::vector<Output>& outputs, const Mesh& mesh,
                                          bool ascii);

/// Writes the certificate of a result whose files are written, and warns if `terrane verify`
/// refuses its deviation. Says so on `told`. Errors: those of certify(); write_failed.
void write_certificate(const std::string& path, const CertifiedResult& result, std::FILE* told,
                       Session& session);

/// Writes the exact coordinates, if they are wanted.
void write_exact(const ProofOptions& options, const Arrangement& exact, std::FILE* told,
                 Session& session);

} // namespace terrane::cli
