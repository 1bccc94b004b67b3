// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Patches of a surface that provably do not meet themselves: their triangles need no pair tests.
//
// Guarantee: two triangles of one patch share a common vertex, a common edge, or nothing.
// Reason: some projection is injective on the patch, since the patch's border winds round each point
// at most once and does not touch itself: statements (2) to (4) of
// docs/explanation/injective-patches.md.
// Cost: linear, plus a box search and exact tests of the border edges.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/adjacency.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/kernel/construction.hpp>
#include <terrane/kernel/sign.hpp>

namespace terrane {

struct InjectivePatches {
    std::vector<std::uint32_t> of; ///< per triangle: its patch, or no_group where nothing was shown
    std::vector<Axis> axis;        ///< per patch: the projection in which it is one-to-one
    std::vector<Sign> turn;        ///< per patch: how all its triangles are oriented there, or Zero
};

/// `edges` groups the sides of `triangles`; these are distinct, with area, over distinct points.
/// `turns`: their orientations seen along z, where they are known already.
/// Tried first: connected components of a surface, in each of the three projections; then their
/// parts of like orientation.
InjectivePatches find_injective_patches(std::span<const Point3> points,
                                        std::span<const Triangle> triangles,
                                        std::span<const std::uint32_t> surface_of,
                                        const EdgeSides& edges, const Run& run = {},
                                        std::span<const Sign> turns = {});

/// Shows the same again after some vertices have moved a little: per patch, whether it holds.
/// patches.of counts the triangles given here (parts of those for which it was shown), turn(t) is
/// the sign of triangle t in its patch's projection before the move, and is_moved says which
/// vertices moved, `moved` lists the triangles at them, `adjacency` was made with patches.of. Cost:
/// a predicate per triangle with a moved corner, and the borders of the patches that have a moved
/// vertex on it.
std::vector<bool>
recheck_injective_patches(std::span<const Point3> points, std::span<const Triangle> triangles,
                          const Adjacency& adjacency, std::span<const std::uint32_t> moved,
                          const std::vector<bool>& is_moved,
                          const std::function<Sign(std::uint32_t triangle, Axis axis)>& turn,
                          const InjectivePatches& patches);

} // namespace terrane
