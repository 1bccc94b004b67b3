// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The kinds of certificates. Each kind has sections of its own in addition to "format", "version", "kind",
// "inputs" and "outputs", and a file NAME_kind.cpp that reads and judges them.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/detail/node.hpp>
#include <terrane/algorithms/verify/verdict.hpp>

namespace terrane::verifier {

struct Folder; ///< what all files of a folder with blocks need

/// The mesh of doubles that the output files of a certificate must hold.
struct WrittenMesh {
    const std::vector<Point3>& vertices;
    const std::vector<Triangle>& triangles;
    const IndexLists<std::uint32_t>& regions_of; ///< per triangle; empty: the files have none
    const IndexLists<std::uint32_t>& parents_of; ///< per triangle; empty: the files have none
    IndexLists<std::uint32_t> surfaces_of;       ///< per triangle: its surfaces, sorted, unique
    bool clean = false;                          ///< conforming, as was verified
    const FilledClaim* filled =
        nullptr; ///< its expected errors are in VTP files; nullptr: none are
};

/// A kind of certificate: its name, reader and checks.
struct Kind {
    CertificateKind kind;
    std::string_view name;                  ///< value of the key "kind"
    std::span<const std::string_view> keys; ///< its keys in addition to those of all kinds
    /// Reads the sections of the kind. The certificate has these keys. Throws Malformed.
    void (*parse)(const Node& node, Certificate& certificate);
    /// Adds violations and measures to the verdict. `surfaces` are those of all input files, which
    /// are the ones of the certificate.
    void (*judge)(std::span<const Surface> surfaces, const Certificate& certificate,
                  const VerifyOptions& options, Verdict& verdict);
    /// Returns the mesh of the output files; none if the certificate has no mesh of doubles.
    /// Precondition: judge() found no violation.
    std::optional<WrittenMesh> (*written)(const Certificate& certificate);
    /// Compares the contents of an output with those that it must have: fills in `check` and
    /// `renamed`, and returns the flaw, or nothing. nullptr: all outputs hold the mesh. Size and
    /// hash are compared before. `folder` keeps what several outputs need.
    std::string (*compare)(std::string_view contents, const Certificate& certificate,
                           const CertifiedOutput& output, std::shared_ptr<const Folder>& folder,
                           OutputVerdict& verdict) = nullptr;
    /// It can have the keys "cut" and "sealed", too, which parse() and judge() look for.
    bool can_be_cut = false;
};

/// In the order of Role.
inline constexpr std::array<std::string_view, 4> names_of_roles{"unknown", "horizon", "fault",
                                                                "boundary"};

/// Returns the kind with this name; nullptr if there is none.
const Kind* find_kind(std::string_view name);
const Kind& find_kind(CertificateKind kind);

// One function per kind, in NAME_kind.cpp; kinds.cpp lists them.
const Kind& arrangement_kind();
const Kind& volumes_kind();
const Kind& tetrahedra_kind();
const Kind& improved_kind();
const Kind& filled_kind();
const Kind& layered_kind();
const Kind& cut_kind();
const Kind& sealed_kind();

// --- For kinds that contain an arrangement ------------------------------------------------------

/// Reads "exact", "rounded" and "digest".
void parse_arrangement_sections(const Node& node, Certificate& certificate);
/// Reads "cut" and "sealed", as far as they are there.
void parse_cut_sections(const Node& node, Certificate& certificate);
/// Judges all these sections: judge_arrangement() where nothing was cut or sealed, else the rules
/// for that, too (R26, R50 to R57).
void judge_surfaces(std::span<const Surface> files, const Certificate& certificate,
                    const VerifyOptions& options, Verdict& verdict);
/// Returns the exact part without its dropped triangles.
ArrangementClaim kept_part(const Certificate& certificate);
/// Returns the largest limit of a change that is accepted.
double accepted_change(std::span<const Surface> files, const Certificate& certificate,
                       const VerifyOptions& options);
/// Judges "exact", "rounded" and "digest" (R1 to R8, R10 to R20).
void judge_arrangement(std::span<const Surface> surfaces, const Certificate& certificate,
                       const VerifyOptions& options, Verdict& verdict);
std::optional<WrittenMesh> rounded_mesh(const Certificate& certificate);

/// Returns the surfaces that the exact part is about: those of the files, with the triangles added
/// to them, then the boundary of a volume of interest. Precondition: R53 holds.
std::vector<Surface> surfaces_of_exact(std::span<const Surface> files,
                                       const Certificate& certificate);

/// Returns the largest limit of a change that is accepted where none is given; VerifyOptions
/// defines it.
double default_max_change(std::span<const Surface> surfaces);

/// Returns the surfaces of the mesh as the inputs describe them.
std::vector<CertifiedSurface> surfaces_of_mesh(const Certificate& certificate);

/// Returns the surfaces of each triangle, given the input triangles that are its parents.
IndexLists<std::uint32_t> surfaces_of_parents(const Certificate& certificate,
                                              const IndexLists<std::uint32_t>& parents_of);

} // namespace terrane::verifier
