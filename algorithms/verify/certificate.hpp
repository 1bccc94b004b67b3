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
#include <terrane/kernel/point.hpp>

namespace terrane {

// The claims of a certificate about blocks, and about tetrahedra that fill them. Triangles are
// those of the mesh of doubles. A side is a number: 2 t is the front of triangle t, from which its
// corners are counterclockwise, 2 t + 1 is its back.

/// The part of model.json that does not follow from the mesh and its blocks. It is stated, and not
/// judged. Each text is as in the file, made of values that were read strictly.
struct ModelClaim {
    struct Block {
        std::string unit_and_age; ///< members, as far as they are there, each with a comma before
        std::string volume;       ///< of the exact block: a number, or null
        std::string positions;    ///< members that list the surfaces above, below and beside it
    };
    std::vector<Block> blocks;      ///< [0] is the outside
    std::vector<std::string> gaps;  ///< per free border: a list
    std::vector<std::string> leaks; ///< objects
    std::string seal;               ///< an object; empty without sealing
};

/// The claims about blocks. Number 0 is the outside.
struct BlocksClaim {
    std::uint32_t exact = 0; ///< number of blocks of the exact arrangement, which have the numbers
                             ///< from 1 on; blocks that rounding made follow
    IndexLists<std::uint32_t> shells; ///< per shell: its sides, ascending; by their first sides
    std::vector<std::uint32_t> block_of_shell; ///< per shell: the block that it bounds
    std::vector<std::uint32_t> around; ///< per shell: UINT32_MAX if it bounds its block from the
                                       ///< outside, or bounds the outside; else the shell that
                                       ///< bounds its block from the outside
    std::vector<std::string> volumes;  ///< per block: its exact volume in the mesh of doubles, as a
                                       ///< reduced fraction; [0] is that of all blocks
    std::vector<std::string> names;    ///< per block: what files call it; not judged
    ModelClaim model{};                ///< of the kind volumes only
};

/// The claims about tetrahedra.
struct TetrahedraClaim {
    bool box = false;             ///< they fill a box around the mesh, with the outside
    std::vector<Point3> vertices; ///< called nodes; unit of the input
    std::vector<std::array<std::uint32_t, 4>> tetrahedra; ///< the fourth node is in front of the
                                                          ///< triangle of the first three
    std::vector<std::uint32_t> block_of;                  ///< per tetrahedron
    std::vector<Triangle> faces;                          ///< those on triangles, and on the box
    std::vector<std::uint32_t> triangle_of; ///< per face: the triangle that it is on; UINT32_MAX
                                            ///< on the box
    std::vector<std::array<std::uint32_t, 2>> twins; ///< pairs of faces, in front of a cut and
                                                     ///< behind it, corner by corner at the same
                                                     ///< place
};

// The claims of certificates about surfaces that were changed.

/// The claims of a certificate about a mesh that was improved.
struct ImprovedClaim {
    std::vector<Point3> vertices;          ///< unit of the input
    std::vector<Triangle> triangles;       ///< indices into vertices
    IndexLists<std::uint32_t> surfaces_of; ///< per triangle: surfaces of the inputs, sorted, >= 1
    IndexLists<std::uint32_t> regions_of;  ///< per triangle: its region in each of these surfaces,
                                           ///< numbered as in the mesh before
    std::vector<Edge> intersection_edges;  ///< sorted, unique
    std::vector<double> limits; ///< per surface: no point of it is farther from the same region in
                                ///< the other mesh, unit of the input
};

/// A surface whose holes were filled.
struct FilledPart {
    std::uint32_t vertices = 0;  ///< number of its vertices, given and new
    std::uint32_t triangles = 0; ///< number of its triangles, given and new
    double limit = 0; ///< no filling reaches farther out of the box around the border of its hole,
                      ///< unit of the input
};

/// The claims of a certificate about surfaces whose holes were filled.
struct FilledClaim {
    std::vector<Point3> vertices;     ///< of all surfaces in order; of each first the given ones
    std::vector<Triangle> triangles;  ///< likewise; indices into vertices
    std::vector<FilledPart> surfaces; ///< order of the inputs
    std::vector<std::uint32_t>
        interpolated; ///< per triangle: the number of its hole; 0: it was given
    std::vector<double>
        deviation; ///< per vertex: its expected error, unit of the input; NaN: unknown
};

/// A horizon of a stack.
struct CertifiedLayer {
    std::uint32_t surface = 0; ///< of the inputs
    double hardness = 0;       ///< larger is harder; of equals the upper one counts as harder
};

/// The claims of a certificate about horizons that were put in order.
struct LayeredClaim {
    std::vector<Point3> vertices;          ///< unit of the input
    std::vector<Triangle> triangles;       ///< indices into vertices
    IndexLists<std::uint32_t> surfaces_of; ///< per triangle: its layers, positions in the order,
                                           ///< sorted, >= 1
    IndexLists<std::uint32_t> regions_of;  ///< per triangle: what the files say; or no lists
    IndexLists<std::uint32_t> parents_of;  ///< likewise
    std::vector<CertifiedLayer> order;     ///< from the top down
    double deviation = 0; ///< no triangle is farther from where it must be, unit of the input
    std::optional<double> thickness; ///< least distance along z from harder layers, unit of the
                                     ///< input; > 0; none: layers may touch
};

/// The volume of interest by which surfaces were cut.
struct VolumeClaim {
    std::string shape; ///< "prism": upright, over a polygon; "hexahedron": with eight corners;
                       ///< "surface": of the last input files
    std::vector<std::array<double, 2>> corners; ///< of a prism: its polygon, in order
    std::vector<double> between;                ///< of a prism: its two heights, the lower first
    std::uint32_t files = 0;       ///< of a surface: the number of input files that hold it
    std::vector<Surface> boundary; ///< the surfaces that bound the volume together
};

/// The claims of a certificate about the parts that were left out of an arrangement.
struct CutClaim {
    VolumeClaim
        volume; ///< what was cut out; without a boundary: nothing was, as surfaces were only
                ///< sealed
    std::vector<std::uint32_t> dropped; ///< triangles of the exact part that were left out, sorted
};

/// The triangles that were added to a surface. Its triangles, given, then extended, then sealed, have the numbers
/// of input triangles, with three vertices of their own each.
struct SealedPart {
    double limit = 0; ///< the surface as given and as kept are nowhere farther apart, unit of the
                      ///< input
    std::vector<std::array<Point3, 3>>
        extended;                              ///< triangles that go on to the boundary of a volume
    std::vector<std::array<Point3, 3>> sealed; ///< triangles that close gaps
};

/// The claims of a certificate about surfaces that were sealed or extended.
struct SealedClaim {
    std::vector<SealedPart> surfaces; ///< order of the inputs, without the boundary of a volume
};

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
    std::string digest;                ///< "sha256:" and 64 hexadecimal digits; see arrangement.hpp
    std::optional<CutClaim> cut;       ///< the left-out part; always there with sealed
    std::optional<SealedClaim> sealed; ///< triangles added to surfaces before

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
