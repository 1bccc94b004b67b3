// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The independent verifier uses GMP rationals and value types only. It shares no predicate, search
// structure or arrangement code with the producer; a test checks its includes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/verdict.hpp>

namespace terrane {

/// Returns all violations of the rules, sorted by rule and elements; none if the claim is true.
/// (1) Any claim is judged, whatever it contains. After a violation of R1 or R2 the following rules
///     are not judged.
/// (2) R5: the intersection of two triangles, as closed sets, must be the convex hull of the
///     vertices that they share: nothing, a vertex or an edge.
/// (3) R7: an edge is an intersection edge iff more than two triangles meet in it, or if it has two
///     triangles that differ in the number of geometrically distinct parents in some surface.
/// (4) R20: the local structure at a vertex consists of the planes and the edges of the input
///     triangles through it. It is a meeting iff no direction lies in all of these planes and along
///     all of these edges; so the vertices of a true claim are determined by the inputs.
/// (5) R8: triangles without area are degenerate and are not compared for duplicates; points are
///     equal if their coordinates are equal, whatever their indices.
///
/// Cost: O(n log n + k) for k pairs of triangles whose boxes touch, with an exact test each.
/// 100 000 triangles take about a second.
std::vector<Violation> verify_arrangement(std::span<const Surface> inputs,
                                          const ArrangementClaim& claim);

/// Returns all violations of R1, R3, R4 and R5 in a mesh of doubles, judged by rationals. After a
/// violation of R1 the other rules are not judged.
std::vector<Violation> verify_conforming(std::span<const Point3> vertices,
                                         std::span<const Triangle> triangles);

// Judges a certificate (for its format see io/certificate.hpp) from the input files and the output
// files. This uses value types, GMP, SHA-256 and zlib, but no writer, predicate, search or
// arrangement code of the producer, and writers of its own for the output files.
//
// A certificate that is accepted proves, for the input files whose hashes it contains:
// (1) The exact part is the arrangement of the surfaces in these files (rules R1 to R8). It is the
//     only one: its vertices and the way its triangles face are determined by the inputs (R19,
//     R20); only the diagonals of its triangulation are free.
// (2) The mesh of doubles is conforming, or is stated not to be (R10, R11).
// (3) Each point of a triangle of the mesh is within `deviation` of each of its parents, and each
//     point of an input triangle is within `deviation` of the triangles that name it (R13, R18).
//     An input triangle without any is listed as vanished, thinner than half of `deviation`, and
//     within `deviation` of the mesh (R12); so are thin parts of others that have vanished. The
//     verifier computes the deviation itself, and refuses one that is larger than the largest that
//     is accepted; see VerifyOptions.
//     The triangles that name an input triangle are connected as its exact parts are, without
//     further holes or closed parts, and so are those of two with a common side; no two surfaces
//     come apart (R37).
// (4) If the mesh has the triangles of the exact part, each vertex is within `max_move` of the
//     exact vertex (R14), and what bounds its blocks is around the same others (R38).
// (5) Its intersection edges, its regions and the digest are correct (R15 to R17).
// (6) An improved mesh is conforming, has the regions, curves and corners of the mesh before, in the
//     same order and between the same blocks, and is within the stated limits of it, both ways (R22
//     to R27, R39).
// (7) Filled surfaces have all that was given, and new triangles are discs that close whole inner
//     borders without meeting others (R28, R29, R35, R36).
// (8) Layers are the pointwise stack of the surfaces that they were made of (R60 to R65). With a
//     minimum thickness their order is shown, and that they lie on surfaces moved along z.
// (9) The mesh of a volume of interest is the part inside of it, all of that and nothing else (R50
//     to R52); (3) and (4) hold for the parts inside.
// (10) Sealed and extended surfaces differ from those of the files by added triangles, which go on
//      from them, and by missing parts that leave no edge free, and by no more than their limits
//      (R26, R53 to R57).
// (11) Each output file that was given is, byte for byte, what the verifier's own writers make of
//      the certificate (R21); where the format has none, it has the stated SHA-256.

namespace verifier {
struct Folder;
}

/// Parses a certificate. Errors: bad_syntax with "source, line l, column c" if the text is not
/// strict JSON (see detail/json.hpp), and with "source, exact.triangles[12]" if it is not a
/// certificate: if a key is missing, unknown or there twice, a value has the wrong type, or a
/// number is out of range. Cost: linear; about three times the size of the text in memory.
Result<Certificate> parse_certificate(std::string_view text, std::string_view source);

/// The hash, the length and the surfaces of an input file.
struct InputFile {
    std::string sha256;            ///< of its bytes, 64 lower-case hexadecimal digits
    std::uint64_t bytes = 0;       ///< length of the file
    std::vector<Surface> surfaces; ///< its surfaces; none if it cannot be read
};

/// Hashes the contents of a file; `surfaces` are what a reader made of it.
InputFile input_file(std::string_view contents, std::vector<Surface> surfaces);

/// Returns the largest deviation from these surfaces, those of all inputs, that is accepted where
/// none is given.
double default_max_deviation(std::span<const Surface> inputs);

/// Judges a certificate without its output files. After a violation of R9 no other rule is judged;
/// after one of R1, R2 or R10 the rules that need the index are not judged.
/// Cost: about twice that of verify_arrangement.
Verdict verify_certificate(std::span<const InputFile> files, const Certificate& certificate,
                           const VerifyOptions& options = {});

/// Judges the rules R10 to R16 and R18 only. Precondition: the exact claim violates neither R1 nor
/// R2.
Verdict verify_rounded(std::span<const Surface> inputs, const ArrangementClaim& exact,
                       const RoundedClaim& rounded, const VerifyOptions& options = {});

/// Judges the mesh of doubles of a certificate by itself. `surfaces` are those that the exact part is
/// about. Precondition: as for verify_rounded(), and the certificate has doubles.
Verdict verify_doubles(std::span<const Surface> surfaces, const Certificate& certificate,
                       const VerifyOptions& options);

/// Judges an output file by its contents: whether it is the file that the certificate names, and
/// has all bytes that follow from the certificate, and no others (R21). A file of float32 must be
/// conforming, too, if the doubles are.
/// Precondition: verify_certificate() found no violation. Cost: linear in the size of the file; for
/// float32 that of verify_conforming.
OutputVerdict verify_output(std::string_view contents, const Certificate& certificate,
                            std::size_t output);

/// Verifies several files. The consequences of the certificate for all of them are computed once.
class OutputVerifier {
public:
    /// The certificate must outlive the object.
    explicit OutputVerifier(const Certificate& certificate) : certificate_(certificate) {}
    /// Compares one file, as verify_output() does.
    OutputVerdict operator()(std::string_view contents, std::size_t output);

private:
    const Certificate& certificate_;
    std::shared_ptr<const verifier::Folder> folder_; ///< for the kind volumes
};

} // namespace terrane
