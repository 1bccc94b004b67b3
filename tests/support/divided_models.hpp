// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Filled models on which checks of tetrahedra are tested: a cube, a geological model, and faults in
// a box, each with added nodes.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "support/filled.hpp"
#include "support/read.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/tetrahedra/split_nodes.hpp>
#include <terrane/algorithms/tetrahedra/without_outside.hpp>

namespace test_support {

/// A filled model with added nodes on edges, on triangles and in tetrahedra.
inline Filled divided(const std::vector<Surface>& surfaces) {
    Filled f = fill(surfaces);
    divide(f, 5);
    CHECK(f.on_edges.size() == 5);
    CHECK(f.on_faces.size() == 5);
    CHECK(f.inside.size() == 5);
    return f;
}

inline Filled tilted_cube() {
    Surface tilted = box({0, 0, 0}, {4, 4, 4}, "cube");
    for (Point3& p : tilted.vertices) // no side is parallel to an axis
        p = {p.x + .3 * p.y + .1, p.y - .2 * p.z + 7, p.z + .7 * p.x - .1 * p.y};
    return divided({tilted});
}

inline Filled geological_model() {
    return divided(read_data("ringmesh/modelA1.ml"));
}

/// The first faults of a region, cut by a level, in a box of two blocks.
inline Filled faults() {
    auto surfaces = read_data("arch-platform/faults.ts");
    surfaces.resize(6);
    surfaces.push_back(box({1.6, 42.3, -.2}, {2.9, 42.8, .1}, "region"));
    surfaces.push_back(level(-.01, 1.5, 42.2, 3, 42.9));
    return divided(surfaces);
}

using TetrahedralMeshes = std::vector<std::pair<const char*, TetrahedralMesh>>;

/// The tetrahedra with the nodes on all surfaces split.
inline TetrahedralMesh split_everywhere(const Filled& f, const TetrahedralMesh& tetrahedra) {
    std::vector<std::uint32_t> all(f.mesh.surfaces.size());
    for (std::uint32_t s = 0; s < all.size(); ++s) all[s] = s;
    auto split = split_nodes(tetrahedra, all);
    REQUIRE(split);
    return std::move(split).value();
}

/// The tetrahedra as they were made, without the outside, and with the nodes on all surfaces split.
inline TetrahedralMeshes forms_of(const Filled& f) {
    const TetrahedralMesh blocks = without_outside(f.tetrahedra);
    return {{"whole", f.tetrahedra},
            {"blocks", blocks},
            {"whole, split", split_everywhere(f, f.tetrahedra)},
            {"blocks, split", split_everywhere(f, blocks)}};
}

/// The model without the outside.
inline Filled blocks_of(const Filled& f) {
    Filled blocks = f;
    blocks.tetrahedra = without_outside(f.tetrahedra);
    const auto& left = blocks.tetrahedra.vertices;
    for (auto* nodes : {&blocks.on_faces, &blocks.on_edges, &blocks.inside})
        for (std::uint32_t& node : *nodes)
            node = static_cast<std::uint32_t>(
                std::find(left.begin(), left.end(), f.tetrahedra.vertices[node]) - left.begin());
    return blocks;
}

} // namespace test_support
