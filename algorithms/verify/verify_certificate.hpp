// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Judges a certificate (for its format see io/certificate.hpp) from the inputs only. This uses
// value types, GMP, SHA-256 and JSON, but no reader, predicate, search or arrangement code.
//
// A certificate that is accepted proves, for the input files whose hashes it contains:
// (1) The exact part is the arrangement of the surfaces in these files (rules R1 to R8).
// (2) The mesh of doubles is conforming, or is stated not to be (R10, R11).
// (3) Each point of a triangle of the mesh is within `deviation` of each of its parents (R13; the
//     distance to a triangle is convex, so it suffices to judge corners). Each input triangle with
//     area is a parent, or listed as vanished (R12). Projected along its normal, each point of an
//     input triangle that is farther than `deviation` from its border is covered (R18).
// (4) If the mesh has the triangles of the exact part, each vertex is within `max_move` of the
//     exact vertex (R14).
// (5) Its intersection edges, its regions and the digest are correct (R15 to R17).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/verify.hpp>

namespace terrane {

/// A surface of an input file as the certificate describes it.
struct CertifiedSurface {
    std::string name;            ///< as in the file
    Role role = Role::unknown;   ///< as in the file
    std::uint64_t vertices = 0;  ///< number of vertices
    std::uint64_t triangles = 0; ///< number of triangles

    friend bool operator==(const CertifiedSurface&, const CertifiedSurface&) = default;
};

/// An input file as the certificate describes it.
struct CertifiedInput {
    std::string name;                       ///< relative to the folder of the certificate
    std::string sha256;                     ///< 64 lower-case hexadecimal digits
    std::uint64_t bytes = 0;                ///< length of the file
    std::vector<CertifiedSurface> surfaces; ///< order of the file
};

/// The claims of a certificate about the mesh of doubles.
struct RoundedClaim {
    std::vector<Point3> vertices;         ///< unit of the input
    std::vector<Triangle> triangles;      ///< indices into vertices
    IndexLists<std::uint32_t> parents_of; ///< per triangle: input triangles, sorted, >= 1
    std::vector<Edge> intersection_edges; ///< sorted, unique
    std::optional<IndexLists<std::uint32_t>>
        regions_of;                      ///< per triangle: its region in each surface of
                                         ///< its parents, by surface
    bool clean = false;                  ///< conforming
    std::uint32_t rounds = 0;            ///< rounds of snapping; not judged
    double max_move = 0;                 ///< of a vertex, unit of the input
    double deviation = 0;                ///< of a triangle from a parent, unit of the input
    std::vector<std::uint32_t> vanished; ///< input triangles, sorted
};

/// A certificate, parsed.
struct Certificate {
    std::vector<CertifiedInput> inputs;  ///< in the order in which they were read
    ArrangementClaim exact;              ///< the arrangement in exact numbers
    std::optional<RoundedClaim> rounded; ///< the mesh of doubles, if there is one
    std::string digest;                  ///< "sha256:" and 64 hexadecimal digits; see digest.hpp
};

/// Parses a certificate. Errors: bad_syntax with "source, line l, column c" if the text is not
/// JSON, and with "source, exact.triangles[12]" if it is not a certificate: if a key is missing or
/// unknown, a value has the wrong type, or a number is out of range.
/// Cost: linear; about ten times the size of the text in memory.
Result<Certificate> parse_certificate(std::string_view text, std::string_view source);

/// An input file as it was found.
struct InputFile {
    std::string sha256;            ///< of its bytes, 64 lower-case hexadecimal digits
    std::uint64_t bytes = 0;       ///< length of the file
    std::vector<Surface> surfaces; ///< its surfaces; none if it cannot be read
};

/// Hashes the contents of a file; `surfaces` are what a reader made of it.
InputFile input_file(std::string_view contents, std::vector<Surface> surfaces);

/// Returns all violations, sorted by rule and elements; none if the certificate is true. After a
/// violation of R9 no other rule is judged; after one of R1, R2 or R10 the rules that need the
/// index are not judged. Cost: about twice that of verify_arrangement.
std::vector<Violation> verify_certificate(std::span<const InputFile> files,
                                          const Certificate& certificate);

/// Judges the rules R10 to R16 and R18 only. Precondition: the exact claim violates neither R1 nor
/// R2.
std::vector<Violation> verify_rounded(std::span<const Surface> inputs,
                                      const ArrangementClaim& exact, const RoundedClaim& rounded);

} // namespace terrane
