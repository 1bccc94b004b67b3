// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Joins the pieces of tiles to one mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>

namespace terrane::tiles {

/// Puts the vertices and triangles of pieces where their numbers say.
///
/// (1) The mesh does not depend on how it was cut into pieces, nor on their order.
/// (2) Each number must occur: of vertices at least once, with the same coordinates, of triangles once.
/// (3) Intersection edges are left out.
/// (4) Either all pieces tell the volumes on the sides of their triangles, or none does.
class PieceJoiner {
public:
    PieceJoiner(std::size_t vertices, std::size_t triangles);

    /// Adds a piece. Errors: bad_index (law 2, lists of the wrong length, or other surfaces than those
    /// of the first piece).
    Status add(const TilePiece& piece);
    /// Returns the mesh. Errors: bad_index (a number is missing; law 4).
    Result<Mesh> finish() &&;
    /// Returns the volumes in front of and behind each triangle, if the pieces told them. Call it
    /// after the last piece and before finish().
    [[nodiscard]] std::span<const std::array<std::uint32_t, 2>> volumes_of_sides() const {
        return volumes_of_sides_;
    }

private:
    /// Lists of which most have one value.
    struct ShortLists {
        std::vector<std::uint32_t> first;
        std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> longer;

        void set(std::uint32_t id, std::span<const std::uint32_t> list);
        [[nodiscard]] IndexLists<std::uint32_t> lists() &&;
    };

    Mesh mesh_;
    std::vector<bool> has_vertex_, has_triangle_;
    ShortLists surfaces_, regions_, parents_;
    std::vector<std::array<std::uint32_t, 2>> volumes_of_sides_;
    std::size_t with_volumes_ = 0; ///< number of triangles
};

} // namespace terrane::tiles
