// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Right certificates of each kind, for the targets forge_KIND to change.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

#include "forge_changes.hpp"

namespace terrane::fuzz {

/// A certificate with the files that it is about.
struct Subject {
    std::vector<InputFile> files;
    std::vector<Surface> surfaces; ///< of all files; then the boundary of a volume of interest
    Certificate certificate;
    Contents contents;        ///< of the output files
    double deviation = 0;     ///< as the verifier measured it
    std::optional<Mesh> mesh; ///< the mesh of doubles, for kinds with blocks
    Volumes volumes;          ///< of this mesh, for kinds with blocks
};

/// Returns the subject of an OBJ file, of the kind "arrangement"; none if it is no file, is too
/// large, or cannot be rounded.
std::optional<Subject> arrangement_subject(std::string_view obj);

/// Returns the small models of a kind; none for arrangements, which are made of any OBJ file.
std::vector<Subject> subjects_of(CertificateKind kind);

/// Returns the surfaces that the exact part of a certificate is about: those of the files, and the
/// boundary of a volume of interest as the certificate has it.
std::vector<Surface> arranged_surfaces(const Subject& subject, const Certificate& certificate);

/// Returns what the producer makes of the surfaces of a subject and another boundary of a volume of
/// interest; none if it refuses that.
std::optional<Subject> cut_again(const Subject& subject, const std::vector<Surface>& boundary);

/// Writes the output files anew from the certificate, as far as it names one mesh for all of them,
/// and tells whether it did.
bool write_outputs(const Subject& subject, const Certificate& certificate, Contents& contents);

} // namespace terrane::fuzz
