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
    Matching(std::size_t regions, std::size_t volumes) :
        volume_of_(regions, no_index), region_of_(volumes, no_index) {
        volume_of_[0] = 0; // region 0 touches the box, and so does the outside
        region_of_[0] = 0;
    }
    /// Returns whether the two are matched with each other.
    bool match(std::uint32_t region, std::uint32_t volume) {
        if (volume_of_[region] == no_index) volume_of_[region] = volume;
        if (region_of_[volume] == no_index) region_of_[volume] = region;
        return volume_of_[region] == volume && region_of_[volume] == region;
    }
    [[nodiscard]] bool complete() const {
        return std::count(volume_of_.begin(), volume_of_.end(), no_index) == 0 &&
               std::count(region_of_.begin(), region_of_.end(), no_index) == 0;
    }
    [[nodiscard]] std::uint32_t volume_of(std::uint32_t region) const { return volume_of_[region]; }

private:
    std::vector<std::uint32_t> volume_of_, region_of_;
};

} // namespace

Status adopt_volume_numbers(const Volumes& volumes, TetrahedralMesh& tetrahedra) {
    return guarded("to number the blocks", "tetrahedra", [&]() -> Status {
        Matching matching(tetrahedra.region_count, volumes.measures.size());
        const auto sides = sides_of_faces(tetrahedra);
        for (std::size_t f = 0; f < tetrahedra.faces.size(); ++f) {
            const std::uint32_t triangle = tetrahedra.face_triangle[f];
            if (triangle == no_index) continue;
            const std::array<TetrahedronSide, 2> at{sides[f].front, sides[f].back};
            for (std::size_t side = 0; side < 2; ++side) {
                if (!at[side].exists()) continue;
                const std::uint32_t region = tetrahedra.region_of[at[side].tetrahedron];
                const std::uint32_t volume = volumes.of_sides[triangle][side];
                if (!matching.match(region, volume))
                    return Error{
                        ErrorCode::internal,
                        fmt::format("region {} of the tetrahedra is not volume {}", region, volume),
                        fmt::format("triangle {}", triangle)};
            }
        }
        if (!matching.complete())
            return Error{ErrorCode::internal,
                         fmt::format("{} regions of tetrahedra, {} volumes",
                                     tetrahedra.region_count, volumes.measures.size()),
                         ""};
        for (std::uint32_t& region : tetrahedra.region_of) region = matching.volume_of(region);
        return Done{};
    });
}

} // namespace terrane
