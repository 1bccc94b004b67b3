// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A certificate, parsed: its files and its claims.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/block_claims.hpp>
#include <terrane/algorithms/verify/changed_claims.hpp>
#include <terrane/kernel/construction.hpp>

namespace terrane {

/// The claims of an arrangement. Input vertices and triangles are numbered through all surfaces:
/// vertex k of surface s is (vertices of the surfaces before s) + k; triangles likewise.
struct ArrangementClaim {
    std::vector<Construction> vertices;    ///< pairwise distinct points
    std::vector<Triangle> triangles;       ///< indices into vertices; unique as sets
    IndexLists<std::uint32_t> parents_of;  ///< per triangle: all input triangles that contain it,
                                           ///< including duplicates; sorted, >= 1
    std::vector<Edge> intersection_edges;  ///< sorted, unique; see rule R7
    std::vector<std::uint32_t> degenerate; ///< input triangles without area, sorted
    std::vector<std::array<std::uint32_t, 2>> duplicates; ///< {triangle, the first one with the
                                                          ///< same three points}, sorted
};

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

/// The subject of a certificate.
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

/// The claims of the kind tetrahedra.
struct FilledBlocksClaim {
    BlocksClaim blocks;
    TetrahedraClaim tetrahedra;
};

/// A certificate, parsed. Its kind follows from what it claims.
class Certificate {
    template <class Self>
    static auto* tetrahedra_in(Self& self) {
        auto* both = std::get_if<FilledBlocksClaim>(&self.beside);
        return both != nullptr ? &both->tetrahedra : nullptr;
    }
    template <class Self>
    static auto* blocks_in(Self& self) {
        auto* both = std::get_if<FilledBlocksClaim>(&self.beside);
        return both != nullptr ? &both->blocks : std::get_if<BlocksClaim>(&self.beside);
    }

public:
    std::vector<CertifiedInput> inputs;   ///< in the order in which they were read
    std::vector<CertifiedOutput> outputs; ///< the files with the mesh of doubles

    // About an arrangement, as all kinds are but filled and layered.
    ArrangementClaim exact;              ///< the arrangement in exact numbers
    std::optional<RoundedClaim> rounded; ///< the mesh of doubles, if there is one
    std::string digest;                  ///< "sha256:" and 64 hexadecimal digits; see digest.hpp
    std::optional<CutClaim> cut;         ///< the left-out part; always there with sealed
    std::optional<SealedClaim> sealed;   ///< triangles added to surfaces before

    /// The further claim; the kinds arrangement, cut and sealed have none.
    std::variant<std::monostate, BlocksClaim, FilledBlocksClaim, ImprovedClaim, FilledClaim,
                 LayeredClaim>
        beside;

    [[nodiscard]] CertificateKind kind() const {
        using Kind = CertificateKind;
        constexpr std::array kinds{Kind::arrangement, Kind::volumes, Kind::tetrahedra,
                                   Kind::improved,    Kind::filled,  Kind::layered};
        if (beside.index() == 0 && sealed) return Kind::sealed;
        if (beside.index() == 0 && cut) return Kind::cut;
        return kinds.at(beside.index());
    }

    // Return the further claim; nullptr: it is of another kind.
    [[nodiscard]] const BlocksClaim* blocks() const { return blocks_in(*this); }
    [[nodiscard]] BlocksClaim* blocks() { return blocks_in(*this); }
    [[nodiscard]] const TetrahedraClaim* tetrahedra() const { return tetrahedra_in(*this); }
    [[nodiscard]] TetrahedraClaim* tetrahedra() { return tetrahedra_in(*this); }
    [[nodiscard]] const ImprovedClaim* improved() const {
        return std::get_if<ImprovedClaim>(&beside);
    }
    [[nodiscard]] ImprovedClaim* improved() { return std::get_if<ImprovedClaim>(&beside); }
    [[nodiscard]] const FilledClaim* filled() const { return std::get_if<FilledClaim>(&beside); }
    [[nodiscard]] FilledClaim* filled() { return std::get_if<FilledClaim>(&beside); }
    [[nodiscard]] const LayeredClaim* layered() const { return std::get_if<LayeredClaim>(&beside); }
    [[nodiscard]] LayeredClaim* layered() { return std::get_if<LayeredClaim>(&beside); }
};

} // namespace terrane
