// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds patches of surfaces that provably do not intersect themselves, so that their triangles need
// no pair tests. Guarantee: two triangles of one patch share a common vertex, a common edge, or
// nothing. The proof shows that some projection is injective on the patch, because the patch's
// border winds around each point at most once and does not touch itself; see statements (2) to (4)
// of docs/explanation/injective-patches.md. Cost: linear, plus a box search and exact tests of the
// border edges.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/adjacency.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/kernel/point.hpp>
#include <terrane/kernel/sign.hpp>

namespace terrane {

/// Patches that are proven to be injective.
struct InjectivePatches {
    std::vector<std::uint32_t> of; ///< per triangle: its patch, or no_group if there is no proof
    std::vector<Axis> axis;        ///< per patch: a projection that is injective on it
    std::vector<Sign> turn;        ///< per patch: the orientation of all its triangles in that
                                   ///< projection; Zero if they differ
};

/// Finds injective patches. It tries (1) whole surfaces, (2) connected components of the rest,
/// (3) connected parts of the rest whose normals are longest along the same axis; each in the
/// three projections. `triangles` are distinct, with area, over distinct points, and `edges` groups
/// their sides. `turns` are their orientations seen along z, if these are known already. Patches are
/// numbered in the order of their first triangles. Those of a surface depend on its triangles alone.
InjectivePatches find_injective_patches(std::span<const Point3> points,
                                        std::span<const Triangle> triangles,
                                        std::span<const std::uint32_t> surface_of,
                                        const EdgeSides& edges, const Run& run = {},
                                        std::span<const Sign> turns = {});

/// Numbers patches in the order of their first triangles, and leaves out those without any.
void number_by_first_triangle(InjectivePatches& patches);

/// Proves injectivity again after some vertices have moved a little, and returns for each patch
/// whether the proof succeeded. Cost: one predicate per triangle with a moved corner, and tests of
/// the borders on which a vertex has moved.
/// triangles: parts of the triangles for which injectivity was proven; patches.of refers to them.
/// adjacency: that of the triangles, made with patches.of.
/// moved: the triangles with a moved corner.
/// is_moved: per vertex, whether it has moved.
/// turn: returns the sign of a triangle in a projection before the move; called with the axis of
/// its patch.
std::vector<bool>
recheck_injective_patches(std::span<const Point3> points, std::span<const Triangle> triangles,
                          const Adjacency& adjacency, std::span<const std::uint32_t> moved,
                          const std::vector<bool>& is_moved,
                          const std::function<Sign(std::uint32_t triangle, Axis axis)>& turn,
                          const InjectivePatches& patches);

} // namespace terrane
