// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A certificate (its format: io/certificate.hpp) judged from the inputs alone: value types, GMP,
// SHA-256 and JSON; no reader, predicate, search or arrangement code.
//
// A certificate that is accepted shows, for the input files whose hashes it holds:
// (1) the exact part is the arrangement of the surfaces in them (rules R1 to R8);
// (2) the mesh of doubles is conforming, or said not to be (R10, R11);
// (3) each point of it is within `deviation` of each input triangle that it is said to be part of
//     (R13; a distance to a triangle is convex, so its corners tell for the whole of a triangle),
//     and each input triangle with area is part of it or listed as vanished (R12);
//     No point of an input triangle that is farther than `deviation` from its border is left
//     uncovered, seen along its normal (R18);
// (4) where it has the triangles of the exact part, each vertex is within `max_move` of the exact
//     one (R14);
// (5) its intersection edges, regions and the digest are what they are called (R15 to R17).
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

struct CertifiedSurface {
    std::string name;
    Role role = Role::unknown;
    std::uint64_t vertices = 0, triangles = 0;

    friend bool operator==(const CertifiedSurface&, const CertifiedSurface&) = default;
};

/// An input file as the certificate describes it.
struct CertifiedInput {
    std::string name;   ///< relative to the folder of the certificate
    std::string sha256; ///< 64 lower-case hexadecimal digits
    std::uint64_t bytes = 0;
    std::vector<CertifiedSurface> surfaces; ///< order of the file
};

/// What a certificate says of the mesh of doubles.
struct RoundedClaim {
    std::vector<Point3> vertices;
    std::vector<Triangle> triangles;      ///< indices into vertices
    IndexLists<std::uint32_t> parents_of; ///< per triangle: input triangles, sorted, >= 1
    std::vector<Edge> intersection_edges; ///< sorted, unique
    std::optional<IndexLists<std::uint32_t>>
        regions_of;                      ///< per triangle: its region in each surface of
                                         ///< its parents, by surface
    bool clean = false;                  ///< conforming
    std::uint32_t rounds = 0;            ///< of snapping; not judged
    double max_move = 0, deviation = 0;  ///< unit of the input
    std::vector<std::uint32_t> vanished; ///< input triangles, sorted
};

struct Certificate {
    std::vector<CertifiedInput> inputs;
    ArrangementClaim exact;
    std::optional<RoundedClaim> rounded;
    std::string digest; ///< "sha256:" and 64 hexadecimal digits; see digest.hpp
};

/// Errors: bad_syntax with "source, line l, column c" where it is no JSON, and with
/// "source, exact.triangles[12]" where it is no certificate: a key missing, unknown, or of another
/// type; a number out of its range.
/// Cost: linear; some ten times the size of the text in memory.
Result<Certificate> parse_certificate(std::string_view text, std::string_view source);

/// An input file as it is found.
struct InputFile {
    std::string sha256; ///< of its bytes, 64 lower-case hexadecimal digits
    std::uint64_t bytes = 0;
    std::vector<Surface> surfaces; ///< what a reader makes of them; none where it can't be read
};

InputFile input_file(std::string_view contents, std::vector<Surface> surfaces);

/// All violations, sorted by rule and elements; none if the certificate is right.
/// (1) After a violation of R9 no other rule is judged; after one of R1, R2 or R10 those that need
///     the index are not.
/// Cost: as verify_arrangement, about twice.
std::vector<Violation> verify_certificate(std::span<const InputFile> files,
                                          const Certificate& certificate);

/// Rules R10 to R16 and R18 alone. Precondition: the exact claim breaks neither R1 nor R2.
std::vector<Violation> verify_rounded(std::span<const Surface> inputs,
                                      const ArrangementClaim& exact, const RoundedClaim& rounded);

} // namespace terrane
