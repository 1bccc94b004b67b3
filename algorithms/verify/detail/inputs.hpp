// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The joined inputs of the verifier, and facts about them that do not depend on the claim.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>
#include <terrane/algorithms/verify/detail/violations.hpp>
#include <terrane/algorithms/verify/verdict.hpp>

namespace terrane::verifier {

/// The vertices and triangles of all surfaces, numbered consecutively.
struct Inputs {
    std::vector<Point3> vertices;
    std::vector<Triangle> triangles; ///< indices into vertices
    Numbers surface_of;              ///< per triangle
};

/// The triangles that rule R8 sets aside, computed from the inputs only.
struct SetAside {
    Numbers degenerate;                                   ///< sorted
    std::vector<std::array<std::uint32_t, 2>> duplicates; ///< {triangle, first}, sorted
    Numbers first_of; ///< per input triangle: the first one with the same points, often itself
};

/// Joins the surfaces. A triangle with an index out of range is reported (R1), and gets the corners
/// 0, 0, 0.
Inputs join_inputs(std::span<const Surface> surfaces, Violations& found);

/// Finds degenerate and duplicate triangles. `points` are the points of the inputs.
SetAside find_set_aside(const Inputs& inputs, std::span<const Vector4> points);

/// Returns, for each input triangle, the triangles that name it as a parent, sorted.
/// Precondition: the parents are in range.
IndexLists<std::uint32_t> children_of(const IndexLists<std::uint32_t>& parents_of,
                                      std::size_t input_count);

/// Returns the surfaces of each triangle, those of its parents, sorted. `surface_of` is per input triangle, ascending.
IndexLists<std::uint32_t> surfaces_of_parents(const Numbers& surface_of,
                                              const IndexLists<std::uint32_t>& parents_of);

/// Returns the intersection edges as rule R7 defines them, sorted.
std::vector<Edge> find_intersection_edges(const Parts& parts, const Inputs& inputs,
                                          const SetAside& set_aside);

/// Reports under `rule` the edges that are missing in `listed`, and those that do not belong there.
void check_intersection_edges(const std::vector<Edge>& truth, const std::vector<Edge>& listed,
                              Rule rule, Violations& found);

} // namespace terrane::verifier
