// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/face_sides.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>

namespace terrane {
namespace {

/// Regions and volumes, matched with each other one by one.
class Matching {
public:
    Matching(std::size_t blocks, std::size_t volumes) :
        volume_of_(blocks, no_index), block_of_(volumes, no_index) {
        volume_of_[0] = 0; // block 0 touches the box, and so does the outside
        block_of_[0] = 0;
    }
    /// Returns whether the two are matched with each other.
    bool match(std::uint32_t block, std::uint32_t volume) {
        if (volume_of_[block] == no_index) volume_of_[block] = volume;
        if (block_of_[volume] == no_index) block_of_[volume] = block;
        return volume_of_[block] == volume && block_of_[volume] == block;
    }
    [[nodiscard]] bool complete() const {
        return std::count(volume_of_.begin(), volume_of_.end(), no_index) == 0 &&
               std::count(block_of_.begin(), block_of_.end(), no_index) == 0;
    }
    [[nodiscard]] std::uint32_t volume_of(std::uint32_t block) const { return volume_of_[block]; }

private:
    std::vector<std::uint32_t> volume_of_, block_of_;
};

} // namespace

Status adopt_volume_numbers(const Volumes& volumes, TetrahedralMesh& tetrahedra) {
    return guarded("to number the blocks", "tetrahedra", [&]() -> Status {
        Matching matching(tetrahedra.block_count, volumes.measures.size());
        const auto sides = sides_of_faces(tetrahedra);
        for (std::size_t f = 0; f < tetrahedra.faces.size(); ++f) {
            const std::uint32_t triangle = tetrahedra.face_triangle[f];
            if (triangle == no_index) continue;
            const std::array<TetrahedronSide, 2> at{sides[f].front, sides[f].back};
            for (std::size_t side = 0; side < 2; ++side) {
                if (!at[side].exists()) continue;
                const std::uint32_t block = tetrahedra.block_of[at[side].tetrahedron];
                const std::uint32_t volume = volumes.of_sides[triangle][side];
                if (!matching.match(block, volume))
                    return Error{
                        ErrorCode::internal,
                        fmt::format("block {} of the tetrahedra is not volume {}", block, volume),
                        fmt::format("triangle {}", triangle)};
            }
        }
        if (!matching.complete())
            return Error{ErrorCode::internal,
                         fmt::format("{} blocks of tetrahedra, {} volumes", tetrahedra.block_count,
                                     volumes.measures.size()),
                         ""};
        for (std::uint32_t& block : tetrahedra.block_of) block = matching.volume_of(block);
        return Done{};
    });
}

} // namespace terrane
