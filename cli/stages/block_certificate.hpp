// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of blocks and of tetrahedra, for `volume`, `tetrahedralize` and `build`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/model/model.hpp>
#include <terrane/cli/stages/certificate_output.hpp>
#include <terrane/cli/stages/pipeline.hpp>

namespace terrane::cli {

/// Checks before any work is done that a certificate can be made, if one is wanted. Errors:
/// bad_option, cannot_open.
Status plan_certificate(const std::string& path, const FileOptions& files,
                        const ArrangeSettings& settings);

/// What a certificate says besides the blocks.
struct BlockProof {
    std::string path; ///< of the certificate
    const FileOptions& files;
    const Inputs& inputs;
    std::vector<Role> roles; ///< of the surfaces as they are in the files; empty: as arranged
    Arranged& arranged;      ///< its surfaces get these roles
    std::optional<CutRequest> cut{}; ///< none: nothing was cut, sealed or extended
};

/// Returns the roles of the surfaces.
std::vector<Role> roles_of(const Inputs& inputs);

/// Makes the certificate of a model whose files are in a folder, with parts in this format; or of
/// tetrahedra that were written to these files. Errors: cannot_open.
Result<std::string> certificate_text(const BlockProof& proof, const Model& model,
                                     const std::filesystem::path& folder,
                                     const std::string& part_format, const Session& session);
Result<std::string> certificate_text(const BlockProof& proof, const Model& model,
                                     const TetrahedralMesh& tetrahedra,
                                     const std::vector<Output>& outputs, const Session& session);

/// Writes the certificate of a model whose files are in a folder, with parts in this format.
/// Errors: cannot_open, write_failed.
Status write_certificate(const BlockProof& proof, const Model& model,
                         const std::filesystem::path& folder, const std::string& part_format,
                         Session& session);

/// Writes the certificate of tetrahedra that were written to these files.
Status write_certificate(const BlockProof& proof, const Model& model,
                         const TetrahedralMesh& tetrahedra, const std::vector<Output>& outputs,
                         Session& session);

} // namespace terrane::cli
