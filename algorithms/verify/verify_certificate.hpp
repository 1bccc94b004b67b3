// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Judges a certificate (for its format see io/certificate.hpp) from the input files and the output
// files. This uses value types, GMP, SHA-256 and zlib, but no writer, predicate, search or
// arrangement code of the producer, and readers of its own for the output files.
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
// (4) If the mesh has the triangles of the exact part, each vertex is within `max_move` of the
//     exact vertex (R14).
// (5) Its intersection edges, its regions and the digest are correct (R15 to R17).
// (6) An improved mesh is conforming, has the regions, curves and corners of the mesh before, and
// is
//     within the stated limits of it, both ways (R22 to R27).
// (7) Filled surfaces have all that was given, and new triangles close whole borders without
//     meeting others (R28, R29, R35, R36).
// (8) Layers are the pointwise stack of the surfaces that they were made of (R60 to R66).
// (9) The mesh of a volume of interest is what is inside of it, all of that and nothing else (R50
// to
//     R52); (3) and (4) hold for the parts inside.
// (10) Sealed and extended surfaces differ from those of the files by added triangles and by whole
//      parts beyond other surfaces only, and by no more than their limits (R26, R53 to R57).
// (11) Each output file that was given holds this mesh (R21): all coordinates and all triangles,
//      bit for bit; with the numbers rounded to float32 where this is what the file holds.
#pragma once

#include <any>
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
#include <terrane/algorithms/verify/block_claims.hpp>
#include <terrane/algorithms/verify/changed_claims.hpp>
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

/// An output file as the certificate describes it.
struct CertifiedOutput {
    std::string name;        ///< relative to the folder of the certificate; "-": standard output
    std::string format;      ///< "obj", "vtp", ...: an extension without its dot; "stl-ascii"
    std::string sha256;      ///< 64 lower-case hexadecimal digits
    std::uint64_t bytes = 0; ///< length of the file
    std::vector<SurfaceInfo> surfaces; ///< what the file calls the surfaces of the inputs, in order
};

/// The claims of a certificate about the mesh of doubles.
struct RoundedClaim {
    std::vector<Point3> vertices;         ///< unit of the input
    std::vector<Triangle> triangles;      ///< indices into vertices
    IndexLists<std::uint32_t> parents_of; ///< per triangle: input triangles, sorted, >= 1
    std::vector<Edge> intersection_edges; ///< sorted, unique
    IndexLists<std::uint32_t> regions_of; ///< per triangle: its region in each surface of its
                                          ///< parents, by surface
    bool clean = false;                   ///< conforming
    std::optional<double> max_move;       ///< of a vertex, unit of the input; none if the triangles
                                          ///< are not those of the exact part
    double deviation = 0; ///< of the triangles from their parents and the reverse, unit of the
                          ///< input
    std::vector<std::uint32_t> vanished; ///< input triangles, sorted
};

/// The kinds of certificates.
enum class CertificateKind : std::uint8_t {
    arrangement, ///< the arrangement of the surfaces as they are in the input files
    volumes,     ///< this, and the blocks of the mesh of doubles
    tetrahedra,  ///< all that, and tetrahedra in the blocks
    improved,    ///< an arrangement whose triangles were improved
    filled,      ///< the surfaces of the input files with triangles in their holes
    layered,     ///< horizons of the input files, put in order
    cut,         ///< an arrangement of which a volume of interest was cut out
    sealed,      ///< an arrangement of surfaces that were sealed or extended, also cut
};

/// A certificate, parsed.
struct Certificate {
    CertificateKind kind = CertificateKind::arrangement; ///< which sections it has
    std::vector<CertifiedInput> inputs;                  ///< in the order in which they were read
    std::vector<CertifiedOutput> outputs;                ///< the files with the mesh of doubles
    ArrangementClaim exact;                              ///< the arrangement in exact numbers
    std::optional<RoundedClaim> rounded;                 ///< the mesh of doubles, if there is one
    std::optional<BlocksClaim> blocks;                   ///< for volumes and tetrahedra
    std::optional<TetrahedraClaim> tetrahedra;           ///< for tetrahedra
    std::optional<ImprovedClaim> improved;               ///< of the kind improved
    std::optional<FilledClaim> filled;                   ///< of the kind filled
    std::string digest;                  ///< "sha256:" and 64 hexadecimal digits; see digest.hpp
    std::optional<LayeredClaim> layered; ///< of the kind layered
    std::optional<CutClaim> cut;         ///< of the kinds cut and sealed
    std::optional<SealedClaim> sealed;   ///< of the kind sealed
};

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

/// Options of verify_certificate().
struct VerifyOptions {
    /// The largest deviation that is accepted, unit of the input. None: the largest of
    /// (1) 2^-20 of the diagonal of the box around the triangles of the inputs,
    /// (2) 2^-40 of their largest coordinate, which is 4096 units in its last place, and
    /// (3) 16 times the smallest positive double.
    std::optional<double> max_deviation{};
    /// The largest limit of a change that is accepted, unit of the input. None: a twentieth of the
    /// diagonal of the box around the triangles of the inputs.
    std::optional<double> max_change{};
};

/// Returns the largest deviation from these surfaces, those of all inputs, that is accepted where
/// none is given.
double default_max_deviation(std::span<const Surface> inputs);

/// The verifier's own measure of the mesh of doubles.
struct Measured {
    double deviation = 0;     ///< upper bound, both ways; unit of the input
    double max_deviation = 0; ///< the largest that was accepted
    std::size_t vanished = 0; ///< number of input triangles with area of which nothing is left
    std::size_t partly_vanished = 0; ///< number of those of which only a thin part is not left
};

/// The verifier's own measure of blocks and tetrahedra.
struct MeasuredBlocks {
    std::size_t blocks = 0;       ///< number of blocks of the mesh of doubles
    std::size_t tetrahedra = 0;   ///< number of tetrahedra
    std::size_t divided = 0;      ///< number of triangles that are more than one face of tetrahedra
    double volume_difference = 0; ///< the largest between a block and its tetrahedra
};

/// How far surfaces were changed.
struct SurfaceChange {
    double limit = 0;     ///< the largest that is stated, and verified; unit of the input
    double max_limit = 0; ///< the largest that was accepted
};

/// The verdict of the verifier.
struct Verdict {
    std::vector<Violation> violations; ///< sorted by rule and elements; none: the claims are true
    std::optional<Measured> measured;  ///< of the mesh of doubles; none if it was not judged
    std::optional<MeasuredBlocks> blocks; ///< none if they were not judged
    std::optional<SurfaceChange>
        change; ///< of surfaces that were changed; none if it was not judged
};

/// Judges a certificate without its output files. After a violation of R9 no other rule is judged;
/// after one of R1, R2 or R10 the rules that need the index are not judged.
/// Cost: about twice that of verify_arrangement.
Verdict verify_certificate(std::span<const InputFile> files, const Certificate& certificate,
                           const VerifyOptions& options = {});

/// Judges the rules R10 to R16 and R18 only. Precondition: the exact claim violates neither R1 nor
/// R2.
Verdict verify_rounded(std::span<const Surface> inputs, const ArrangementClaim& exact,
                       const RoundedClaim& rounded, const VerifyOptions& options = {});

/// The kinds of comparison of an output file.
enum class OutputCheck : std::uint8_t {
    doubles,  ///< with all coordinates and triangles (or tetrahedra)
    numbers,  ///< with the numbers of blocks, interfaces and patches; not with all that it holds
    float32,  ///< with all coordinates, rounded to float32, and all triangles
    hash_only ///< with its SHA-256 only: the verifier has no reader for the format
};

/// The verdict about an output file.
struct OutputVerdict {
    OutputCheck check = OutputCheck::doubles; ///< the kind of comparison
    std::vector<Violation> violations;        ///< of R21; none: the file is the one it should be
    std::vector<std::uint32_t> renamed; ///< surfaces with another name or role than in the input
    double float32_move = 0; ///< no number's point is farther from its doubles; unit of the input
};

/// Judges an output file by its contents: whether it is the file that the certificate names, and
/// holds its mesh of doubles (R21). Numbers and triangles are compared bit for bit and in their
/// order; so are the surfaces of triangles, their regions and their first parents in formats that
/// hold them. A file of float32 must be conforming, too, if the doubles are.
/// Precondition: verify_certificate() found no violation. Cost: linear in the size of the file; for
/// float32 that of verify_conforming.
OutputVerdict verify_output(std::string_view contents, const Certificate& certificate,
                            std::size_t output);

/// Does the same for several files. What follows from the certificate for all of them is computed
/// once.
class OutputVerifier {
public:
    /// The certificate must outlive the object.
    explicit OutputVerifier(const Certificate& certificate) : certificate_(certificate) {}
    /// Compares one file, as verify_output() does.
    OutputVerdict operator()(std::string_view contents, std::size_t output);

private:
    const Certificate& certificate_;
    std::any computed_; ///< of a type that the kind of certificate has
};

} // namespace terrane
