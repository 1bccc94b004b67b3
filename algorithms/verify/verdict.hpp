// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The rules that the verifier judges by, and what it answers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace terrane {

/// The rules that the verifier judges by. R22 to R29, R35, R36 and R39 are for surfaces that were
/// changed, R37 and R38 for the mesh of doubles, R30 to R34 for volumes, R40 to R49 for tetrahedra, R50 to R52 for
/// volumes of interest, R53 to R57 for sealed surfaces, R60 to R69 for layers.
enum class Rule : std::uint8_t {
    R1_indices,   ///< an index is out of range, a list unsorted or empty
    R2_vertices,  ///< a construction is undefined (parallel line and plane, ...)
    R3_distinct,  ///< two vertices are the same point, or a vertex belongs to no triangle
    R4_triangles, ///< a triangle without area, or two triangles with the same vertices
    R5_contacts,  ///< two triangles meet other than in a shared vertex or edge
    R6_parents,   ///< an input triangle is not exactly the union of the triangles that name
                  ///< it: a child lies outside of it, or the areas do not add up
    R7_intersection_edges, ///< an intersection edge is not listed, or another edge is
    R8_set_aside,          ///< a degenerate or duplicate triangle is not listed, or another one is
    // R9 and the following rules judge a certificate: see verify.hpp.
    R9_inputs,            ///< an input file is not the one that the certificate describes
    R10_rounded_indices,  ///< in the mesh of doubles: as R1, or a number is not finite
    R11_conforming,       ///< the doubles are stated to be conforming and are not, or the reverse
    R12_rounded_parents,  ///< a parent without area; an input triangle without any part that is not
                          ///< listed as vanished, or the reverse
    R13_deviation,        ///< a triangle and a parent are farther apart than the stated deviation,
                          ///< or this is larger than the largest that is accepted
    R14_moves,            ///< a vertex is farther from its exact point than the stated largest move
    R15_rounded_edges,    ///< as R7, in the mesh of doubles
    R16_regions,          ///< regions are not those into which intersection edges divide surfaces
    R17_digest,           ///< the digest is not that of the arrangement
    R18_coverage,         ///< the triangles that name an input triangle leave a hole in it
    R19_orientation,      ///< a triangle does not face the side that its first parent faces
    R20_meetings,         ///< a vertex is neither a corner of an input triangle nor a point where
                          ///< intersection segments end or cross
    R21_output,           ///< an output file is not the one that the certificate describes, or does
                          ///< not hold the mesh of doubles
    R22_improved_indices, ///< in an improved mesh: as R1, or a number is not finite
    R23_improved_conforming, ///< an improved mesh is not conforming
    R24_sheets, ///< regions are not those of the mesh before, or are connected otherwise
    R25_curves, ///< a curve or a corner is not that of the mesh before, or too far from it
    R26_limits, ///< two surfaces are farther apart than the stated limit, or this is larger than
                ///< the largest that is accepted
    R27_sides,  ///< a region faces another side than before
    R28_filled_indices, ///< in filled surfaces: as R1, or a number is not finite
    R29_given,          ///< a filled surface has not all that was given, unchanged
    // Blocks: see docs/reference/certificate.md.
    R30_block_lists = 29, ///< a list about blocks is unsorted, too long or too short
    R31_shells,           ///< the shells are not those of the mesh
    R32_nesting,          ///< another shell bounds a block from the outside
    R33_block_numbers,    ///< a shell bounds another block, or there are more or fewer blocks
    R34_volumes,          ///< a block has another volume
    R35_fillings, ///< new triangles do not close whole borders of a surface, or an outer one
    R36_embedded, ///< a new triangle has no area, or meets another one of its surface
                  ///< improperly
    R37_images,   ///< the parts of input triangles are torn, or enclose a space
    R38_places,   ///< triangles bound other blocks than in the exact part
    R39_beside,   ///< sheets lie around a curve, or between blocks, otherwise than before
    // Tetrahedra: see docs/explanation/tetrahedra.md.
    R40_tetrahedra_lists = 39, ///< as R1, in the lists about tetrahedra
    R41_positive,              ///< a tetrahedron is flat or inverted
    R42_faces,                 ///< a face has two tetrahedra on a side, or none where one must be
    R43_box,                   ///< the tetrahedra do not fill their box
    R44_nodes,         ///< two nodes are one point, one is in no tetrahedron, or none at a vertex
    R45_cover,         ///< the faces on a triangle do not cover it
    R46_blocks,        ///< a tetrahedron is in another block
    R47_block_volumes, ///< a block and its tetrahedra differ in volume by more than nodes
                       ///< near its triangles allow
    R48_cuts,          ///< nodes are not split as twin faces say
    // Volumes of interest: see detail/cut.hpp.
    R50_volume = 49, ///< the boundary is not that of the stated volume, or not closed
    R51_dropped,     ///< a triangle outside is not listed as dropped, or another one is
    R52_inside,      ///< a triangle of the mesh of doubles is outside
    // Sealed and extended surfaces: see detail/sealed.hpp.
    R53_sealed_lists, ///< a list about sealed surfaces has another length than it must have, or a
                      ///< number is not finite
    R54_attached,     ///< an added part does not go on from the border of its surface
    R55_ends,         ///< an added part ends free elsewhere than at a lateral side
    R56_trimmed,      ///< a missing part leaves an edge free, or its surface does not go on
    R57_only_kept,    ///< doubles lie where nothing was kept
    // Layers: see detail/layered.hpp.
    R60_layer_lists = 59, ///< as R1, in layers, or a number is not finite
    R61_layer_mesh,       ///< the mesh of the layers is not conforming
    R62_layer_order,      ///< a layer is above one that is higher in the order, or itself
    R63_layer_heights,    ///< a triangle is neither on its surface nor on a harder one that must
                          ///< replace it there
    R64_layer_places,     ///< a layer does not exist where its surface does, or the reverse
    R65_layer_sides,      ///< a triangle faces another side than the surface that it is on
};

/// Returns "R5" for rule R5, and so on.
std::string name_of(Rule rule);

/// A rule that does not hold, and where.
struct Violation {
    Rule rule{};                         ///< which rule
    std::vector<std::uint32_t> elements; ///< R1: the element with the wrong index, empty for a list
                                         ///< R2, R3: vertices; R4, R5: triangles
                                         ///< R6: {input triangle}, {input triangle, triangle}, or
                                         ///<     {duplicate, first}
                                         ///< R7: the two vertices of an edge; R8: input triangles
                                         ///< R9: an input; R10, R15: as R1, R7; R11: none, or as
                                         ///< R3 to R5; R12: {input triangle} or {triangle, parent}
                                         ///< R13: {vertex, input triangle}; R14: vertex
                                         ///< R16: triangles, or none for the whole; R17: none
                                         ///< R18: an input triangle; R19: {triangle, parent}
                                         ///< R20: a vertex; R21: an output
                                         ///< R31, R32: a shell; R33, R34: a block or a shell
                                         ///< R40, R41: tetrahedra; R42, R46: a tetrahedron or a
                                         ///< face; R44: nodes, or a vertex; R45: a triangle
                                         ///< R47: a block; R48: a face or a node
                                         ///< R22, R23: as R1, R3 to R5; R24: {triangle} or none
                                         ///< R25: the vertices of an edge, or none
                                         ///< R26: {triangle} or {surface}; R27: {triangle}
                                         ///< R28, R29, R35, R36: a triangle, a vertex or none
                                         ///< R50: none; R51, R52: a triangle
                                         ///< R60, R63, R65: a triangle or none; R61: as R3 to
                                         ///< R5; R62: two triangles; R64: a triangle or an edge
    std::string sentence;                ///< names the flaw
};

/// Once this many pairs violate R5, no more are searched for: the claim is sufficiently refuted.
inline constexpr std::size_t most_contacts_listed = 100'000;

/// Options of verify_certificate().
struct VerifyOptions {
    /// The largest deviation that is accepted, unit of the input. None: 2^-40 of the largest
    /// coordinate of the triangles in the input files, which is at least 4 096 spacings of the
    /// doubles there, or 16 times the smallest positive double if that is more.
    std::optional<double> max_deviation{};
    /// The largest limit of a change that is accepted, unit of the input. None: a twentieth of the
    /// diagonal of the box around the triangles of the inputs.
    std::optional<double> max_change{};
};

/// How the mesh of doubles differs from the exact part. A meeting is a set of input triangles that
/// have a vertex in common, without those that have vanished.
struct Differences {
    std::size_t lost = 0;   ///< meetings in the exact part only
    std::size_t made = 0;   ///< meetings in the doubles only
    std::size_t turned = 0; ///< edges around which the same triangles lie in another order

    friend bool operator==(const Differences&, const Differences&) = default;
};

/// The verifier's own measure of the mesh of doubles.
struct Measured {
    double deviation = 0;     ///< upper bound, both ways; unit of the input
    double max_deviation = 0; ///< the largest that was accepted
    std::size_t vanished = 0; ///< number of input triangles with area of which nothing is left
    std::size_t partly_vanished = 0; ///< number of those of which only a thin part is not left
    bool same_cells =
        false; ///< the doubles have the triangles of the exact part, in the same order
               ///< around edges and with the same blocks: the same regions, curves
               ///< and blocks
    Differences differences; ///< from the exact part
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

/// The findings of the verifier.
struct Verdict {
    std::vector<Violation> violations; ///< sorted by rule and elements; none: the claims are true
    std::optional<Measured> measured;  ///< of the mesh of doubles; none if it was not judged
    std::optional<MeasuredBlocks> blocks; ///< none if they were not judged
    std::optional<SurfaceChange>
        change; ///< of surfaces that were changed; none if it was not judged
};

/// How an output file is bound to the certificate.
enum class OutputCheck : std::uint8_t {
    every_byte, ///< it is what the verifier's own writer makes of the certificate
    inflated,   ///< likewise, once its compressed arrays are decompressed
    float32,    ///< every byte; its coordinates are the doubles rounded to float32
    hash_only   ///< by its SHA-256 only: the verifier has no writer for the format
};

/// The findings of the verifier about an output file.
struct OutputVerdict {
    OutputCheck check = OutputCheck::every_byte; ///< how it was compared
    std::vector<Violation> violations;           ///< of R21; none: the file is the one it should be
    std::vector<std::uint32_t> renamed; ///< surfaces with another name or role than in the input
    double float32_move = 0; ///< no number's point is farther from its doubles; unit of the input
};

} // namespace terrane
