// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What the triangles of a filling miss for being flat. Private to filling.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane::detail {

/// A filling whose mesh size was not asked for may have its edges halved so often.
constexpr int most_halvings = 2;

/// Edges with two triangles, at most `most`, spread evenly through all of them, ascending.
std::vector<Edge> some_inner_edges(std::span<const Triangle> triangles, std::size_t vertices,
                                   std::size_t most);

inline Point3 middle_of(const Point3& a, const Point3& b) {
    return {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
}

/// Whether smaller triangles would bring a filling nearer to the truth: what the function that it
/// stands for bends away from the middles of edges (`sags`) is more than it is itself expected to
/// be off there, both as root mean squares, and more than rounding: a millionth of `size`, the edge
/// length. False where an expected error is not known, or without any.
bool flatness_outweighs(std::span<const double> sags, std::span<const double> expected,
                        double size);

} // namespace terrane::detail
