// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tables that structural geologists ask for: which surface stops against which, along what length
// and with what gap; and which blocks face each other across a fault.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/structure/free_borders.hpp>
#include <terrane/algorithms/structure/structure.hpp>

namespace terrane {

/// The relation of two surfaces where they meet, or nearly meet.
enum class RelationKind : std::uint8_t {
    stops,    ///< `from` ends at `to`, which goes on
    crosses,  ///< both go on
    meets,    ///< both end
    overlaps, ///< both have the triangles at the line
    near,     ///< `from` ends near `to` without meeting it
};

/// Names the kind: "stops at", "crosses", "meets", "overlaps", "ends near".
std::string_view name_of(RelationKind kind);

/// One kind of contact between two surfaces. All but `stops` and `near` are symmetric, and listed
/// once, with from < to.
struct SurfaceRelation {
    SurfaceId from{};                       ///< the surface that ends
    SurfaceId to{};                         ///< the other one
    RelationKind kind = RelationKind::near; ///< the kind of relation
    double length = 0;                      ///< of all lines, unit of the mesh
    double least = 0;   ///< of `near`: the smallest gap, as in Leak; otherwise 0
    double largest = 0; ///< of `near`: the largest gap
    Point3 place{};     ///< on the longest line; of `near`: where the gap is largest
};

/// Two blocks that face each other across a surface.
struct Juxtaposition {
    SurfaceId surface{};                   ///< between them
    std::array<std::uint32_t, 2> blocks{}; ///< numbers, the lower first; 0 is the outside
    double area = 0;                       ///< squared unit
};

/// Finds how surfaces end at each other, by the lines of the structure and the gaps of free
/// borders: by `from`, `to`, kind. Gaps of different orders of magnitude are different relations,
/// the smallest first. Cost: linear in the triangles, n log n in the lines.
std::vector<SurfaceRelation> find_relations(const Mesh& mesh, const Structure& structure,
                                            std::span<const FreeBorder> borders);

/// Finds the areas across which blocks face each other, by surface, then blocks. Parts of a surface
/// that dangle in one block are left out; an area of several surfaces counts for each.
std::vector<Juxtaposition> find_juxtapositions(const Structure& structure);

} // namespace terrane
