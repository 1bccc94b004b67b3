// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The blocks of a mesh with exact points, as the verifier finds them.
//
// A side is a number: 2 t is the front of triangle t, from which its corners are counterclockwise,
// 2 t + 1 is its back. A shell consists of sides that face each other around edges. A component
// consists of triangles that are connected by edges; a connected part of space without it has one
// shell of the component as its border (docs/reference/certificate.md, Blocks).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <terrane/algorithms/verify/detail/contacts.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>

namespace terrane::verifier {

/// The shells of a mesh, numbered by their first sides.
struct Shells {
    Numbers of_side;               ///< per side
    std::vector<Numbers> sides_of; ///< per shell: its sides, ascending
    Numbers component_of;          ///< per shell: the lowest triangle of its component
};

/// Two sides that face each other around an edge.
struct Facing {
    Edge edge{};
    std::array<std::uint32_t, 2> sides{};

    friend auto operator<=>(const Facing&, const Facing&) = default;
};

/// Returns the sides that face each other around edges, sorted. Precondition: the mesh is
/// conforming, so that no two triangles at an edge have the same direction. Cost: sorting, and exact
/// directions at edges with more than two triangles.
std::vector<Facing> facing_sides(const ExactMesh& mesh);

/// Links the sides that face each other. Precondition and cost as for facing_sides().
Shells find_shells(const ExactMesh& mesh);

/// Where the shells lie.
struct Nesting {
    std::vector<bool> outermost; ///< per shell: it borders the unbounded part without its component
    Numbers around; ///< per shell that is outermost: the innermost shell of another component
                    ///< around it, or no_number; for other shells no_number
};

/// Locates each component among the others, by the winding numbers of shells around a point of it.
/// Cost: per component, the triangles in whose boxes its point is in a projection.
Nesting find_nesting(const ExactMesh& mesh, const Shells& shells);

/// The blocks of a mesh. Number 0 is the outside; blocks are counted in the order of their least
/// vertices, then of the sorted lists of all their vertices, then of their least sides.
struct Blocks {
    Shells shells;
    Nesting nesting;
    Numbers of_shell;        ///< per shell
    std::uint32_t count = 1; ///< with the outside

    [[nodiscard]] std::array<std::uint32_t, 2> of_sides(std::uint32_t triangle) const {
        return {of_shell[shells.of_side[2 * triangle]], of_shell[shells.of_side[2 * triangle + 1]]};
    }
};

Blocks find_blocks(const ExactMesh& mesh);

/// Returns the number among the blocks of the exact mesh for each block of the rounded one. Blocks
/// that have no match get the numbers after these. Matched are first the blocks that have the most
/// sides of common triangles; among equals, those with the least numbers. Triangles are common if
/// the corners of the one are the doubles nearest to those of the other.
Numbers matched_numbers(const ExactMesh& exact, const Blocks& of_exact, const ExactMesh& rounded,
                        const Blocks& of_rounded);

/// Returns six times the volume of each block, in the unit of the points; [0] is that of all
/// blocks. Precondition: all points have w = 1.
std::vector<mpz_class> six_volumes(const ExactMesh& mesh, const Blocks& blocks);

/// Returns a double that is nearest to a fraction; among two, the one with an even last bit.
double nearest_double(const mpq_class& number);

} // namespace terrane::verifier
