// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetgen/detail/ways.hpp>

#include <algorithm>

namespace terrane::tetgen::detail {

std::vector<Way> ways_of_tetgen(const TetgenInput& input) {
    std::vector<Way> ways;
    for (const bool sort_points : {true, false})
        for (const bool keep : {true, false})
            for (const bool improve : {true, false})
                if (input.keep_facets || !keep)
                    ways.push_back({Mesher::tetgen, keep, improve, sort_points, false});
    if (input.keep_facets && input.radius_edge_ratio)
        for (const bool sort_points : {true, false})
            ways.push_back({Mesher::tetgen, true, true, sort_points, false, false, false});
    return ways;
}

std::vector<Way> ways_of_gmsh(const Volumes& volumes) {
    std::vector<Way> ways;
    const bool all_separate = std::all_of(volumes.of_sides.begin(), volumes.of_sides.end(),
                                          [](const auto& sides) { return sides[0] != sides[1]; });
    if (all_separate) ways.push_back({Mesher::gmsh, true, true, true, true});
    ways.push_back({Mesher::gmsh, true, true, true, false});
    ways.push_back({Mesher::gmsh, true, false, true, false, true});
    return ways;
}

} // namespace terrane::tetgen::detail
