// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates and exact coordinates, which others can check.
#pragma once

#include <cstdio>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/layers/layers.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/session/session.hpp>
#include <terrane/cli/stages/pipeline.hpp>
#include <terrane/io/certificate.hpp>

namespace terrane::cli {

struct ProofOptions {
    std::string certificate, exact; ///< files; empty: none
};

/// Adds --certificate and --exact.
void add_proof(CLI::App& command, ProofOptions& options);
/// Adds --certificate only.
void add_certificate(CLI::App& command, std::string& certificate);

/// Warns if `terrane verify` refuses a certificate unless an option allows its deviation. `inputs`
/// are all surfaces that it is about.
void warn_of_deviation(const std::string& certificate, double deviation,
                       std::span<const Surface> inputs);

/// Checks the file names before any work is done. Errors: bad_option, cannot_open.
Status plan_proof(const ProofOptions& options, const FileOptions& files);

/// Checks before any work is done that a certificate can name these files. It is UTF-8 and names
/// them relative to its folder. Errors: bad_option.
Status check_certified_names(const std::string& certificate, const std::vector<std::string>& files);

/// Checks before any work is done that a certificate can state the names of surfaces, which are
/// those of their files. Errors: bad_option, with the file as its place.
Status check_certified_surfaces(std::span<const std::string> names,
                                std::span<const std::string> files);

/// Reads all inputs; if `certificate` is not empty, their surfaces must have names that it can
/// state. Errors: those of read_inputs; bad_option.
Result<Inputs> read_certified_inputs(const std::string& certificate, const FileOptions& options,
                                     Session& session);

/// Hashes the input files in their present state. If one was changed after it was read, the
/// verifier finds that the certificate does not fit it. Errors: cannot_open.
Result<std::vector<InputRecord>> record_inputs(const std::string& certificate,
                                               const std::vector<std::string>& files,
                                               const Inputs& inputs);

/// Tells whether a certificate can be about tetrahedra in this format and of this order.
bool is_certifiable(Format format, unsigned order);

/// What surfaces were cut, sealed or extended by.
struct CutRequest {
    /// Returns the volume of interest for a certificate with this path; empty: there is none.
    std::function<Result<VolumeRecord>(const std::string& path)> volume{};
    Search search = Search::automatic; ///< for arranging again what was left out
};

/// Returns how surfaces were changed, as the settings asked for, which must outlive the result;
/// none: they stay as they are.
std::optional<CutRequest> cut_request(const ArrangeSettings& settings, const Arranged& arranged);

/// What was changed, for a certificate.
struct ChangeRecord {
    std::optional<VolumeRecord> volume{};
    std::size_t boundary_count = 0;
    std::span<const SurfaceGrowth> growth{};

    [[nodiscard]] CutRecord record() const {
        return {volume ? &*volume : nullptr, boundary_count, growth};
    }
};

/// Finds out what was changed. The result refers to `arranged`. Errors: those of reading files.
Result<ChangeRecord> change_of(const CutRequest& request, const std::string& path,
                               const Inputs& inputs, const Arranged& arranged);

/// Makes the sections of a certificate about what was changed; none without a request.
Result<std::optional<CutSections>> sections_of(const std::optional<CutRequest>& request,
                                               const std::string& path, const Inputs& inputs,
                                               const Certified& certified, const Arranged& arranged,
                                               const Session& session);

/// The files that a certificate is about.
struct ProofFiles {
    std::vector<std::string> inputs;
    std::vector<Output> outputs; ///< those that were written
    bool ascii = false;          ///< STL was written as text
    std::FILE* told = stdout;    ///< where people are told what is written
    std::optional<CutRequest>
        cut{}; ///< what surfaces were cut, sealed or extended by; none: nothing
};

/// Makes the certificate of a result whose inputs are exactly these files, to be written to `path`.
/// Errors: cannot_open, where a file cannot be read again; with a volume of interest those of
/// to_cut_certificate().
Result<std::string> certificate_text(const std::string& path, const ProofFiles& files,
                                     const Inputs& inputs, const Arranged& arranged,
                                     const Session& session);

/// Writes both files, and says so on `files.told`. Rounded coordinates need not be conforming, as
/// the exact result holds anyway.
Status write_proof(const ProofOptions& options, const ProofFiles& files, const Inputs& inputs,
                   const Arranged& arranged, Session& session);

/// Writes the certificate of a mesh that was improved after it was arranged, and says so on
/// `files.told`.
Status write_improved_certificate(const std::string& path, const ProofFiles& files,
                                  const Inputs& inputs, const Arranged& before,
                                  const Improved& improved, Session& session);

/// Writes the certificate of surfaces whose holes were filled; `mesh` is what the output files
/// hold.
Status write_filled_certificate(const std::string& path, const ProofFiles& files,
                                const Inputs& inputs, const FillWork& work, const Mesh& mesh,
                                Session& session);

/// Writes the certificate of horizons that were put in this order, and says so on `files.told`.
Status write_layered_certificate(const std::string& path, const ProofFiles& files,
                                 const Inputs& inputs, std::span<const Layer> order,
                                 const Layered& layered, Session& session);

} // namespace terrane::cli
