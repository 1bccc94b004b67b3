// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The Booleans of two closed surfaces, put together from the parts into which they divide each
// other, in exact rationals.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include <CGAL/Exact_rational.h>

#include <terrane/algorithms/mesh/surface.hpp>

namespace corefine_oracle {

using Rational = CGAL::Exact_rational;
using Spot = std::array<Rational, 3>;

/// The points and triangles of a divided surface, with the input triangle that contains each one.
struct Parts {
    std::vector<Spot> points;
    std::vector<terrane::Triangle> triangles;
    std::vector<std::uint32_t> parent; ///< counted within the surface
    std::set<std::array<Spot, 2>> intersection_edges;
};

/// Returns the ends of an edge in lexicographic order.
std::array<Spot, 2> ordered(const Spot& a, const Spot& b);

/// Returns six times the volume of the tetrahedron with corners a, b, c and the origin.
Rational volume(const Spot& a, const Spot& b, const Spot& c);

/// The border of a Boolean of two closed surfaces.
struct Border {
    std::vector<terrane::Triangle> triangles;

    /// Tells whether each edge has two triangles. Vertices where the border touches itself are not
    /// searched for.
    [[nodiscard]] bool is_manifold() const;
    [[nodiscard]] Rational six_volumes(const std::vector<Spot>& points) const;
};

/// The borders of union, intersection, first minus second, and second minus first.
using Borders = std::array<Border, 4>;

/// Returns the Booleans of two closed surfaces, whose parts are given.
Borders booleans(std::span<const terrane::Surface> pair, const std::array<Parts, 2>& parts);

} // namespace corefine_oracle
