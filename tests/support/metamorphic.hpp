// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Changes of the input that must not change the arrangement: order, orientation, and, once undone,
// reflections, scales and permutations of the axes. The arrangement of transformed surfaces is
// carried back by its constructions, which name input vertices: the same claim is made about the
// original vertices.
#pragma once

#include "support/claim.hpp"

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace test_support {

using Surfaces = std::vector<terrane::Surface>;
using Change = std::function<terrane::Point3(const terrane::Point3&)>;

inline Surfaces changed(Surfaces surfaces, const Change& change) {
    for (terrane::Surface& s : surfaces)
        for (terrane::Point3& p : s.vertices) p = change(p);
    return surfaces;
}

/// Returns the surface with its vertices and triangles in another order, other first corners and
/// other orientations.
inline terrane::Surface shuffled(const terrane::Surface& surface, std::mt19937& random) {
    std::vector<std::uint32_t> place(surface.vertices.size());
    std::iota(place.begin(), place.end(), 0U);
    std::shuffle(place.begin(), place.end(), random);
    terrane::Surface result = surface;
    for (std::size_t v = 0; v < place.size(); ++v) result.vertices[place[v]] = surface.vertices[v];
    for (terrane::Triangle& t : result.triangles) {
        for (std::uint32_t& corner : t) corner = place[corner];
        std::rotate(t.begin(), t.begin() + random() % 3, t.end());
        if (random() % 2 == 0) std::swap(t[0], t[1]);
    }
    std::shuffle(result.triangles.begin(), result.triangles.end(), random);
    return result;
}

/// Shuffles each surface, and their order.
inline Surfaces shuffled(const Surfaces& surfaces, std::mt19937& random) {
    Surfaces other;
    for (const terrane::Surface& s : surfaces) other.push_back(shuffled(s, random));
    std::shuffle(other.begin(), other.end(), random);
    return other;
}

inline terrane::Point3 turned(const terrane::Point3& p) {
    return {p.y, p.z, p.x};
}

/// Undoes turned(), which permutes the axes: the plane seen along y is seen along x again.
inline void turn_back(terrane::ArrangementClaim& claim) {
    using terrane::Construction;
    for (Construction& how : claim.vertices)
        if (how.kind == Construction::Kind::line_line)
            how.axis = static_cast<terrane::Axis>((static_cast<unsigned>(how.axis) + 1) % 3);
}

inline const std::array<Change, 3> reflections{[](const terrane::Point3& p) {
                                                   return terrane::Point3{-p.x, p.y, p.z};
                                               },
                                               [](const terrane::Point3& p) {
                                                   return terrane::Point3{p.x, -p.y, p.z};
                                               },
                                               [](const terrane::Point3& p) {
                                                   return terrane::Point3{p.x, p.y, -p.z};
                                               }};

/// Scales the surfaces by 2^k; none if this exceeds the range of doubles.
inline Surfaces scaled(const Surfaces& surfaces, int k) {
    const auto times = [](const Surfaces& all, int e) {
        return changed(all, [e](const terrane::Point3& p) {
            return terrane::Point3{std::ldexp(p.x, e), std::ldexp(p.y, e), std::ldexp(p.z, e)};
        });
    };
    const auto result = times(surfaces, k);
    const auto back = times(result, -k);
    using terrane::Surface;
    const bool exact =
        std::ranges::equal(back, surfaces, {}, &Surface::vertices, &Surface::vertices);
    return exact ? result : Surfaces{};
}

using CornerSets = std::set<std::array<terrane::Point3, 3>>;

/// Returns the triangles by their corners as points, sorted.
inline CornerSets triangles_of(std::span<const terrane::Point3> vertices,
                               std::span<const terrane::Triangle> triangles) {
    CornerSets result;
    for (const terrane::Triangle& t : triangles) {
        std::array corners{vertices[t[0]], vertices[t[1]], vertices[t[2]]};
        for (terrane::Point3& p : corners) p = {p.x + 0.0, p.y + 0.0, p.z + 0.0}; // -0 is 0
        std::sort(corners.begin(), corners.end());
        result.insert(corners);
    }
    return result;
}

inline Surfaces surfaces_of(const terrane::Mesh& mesh) {
    Surfaces surfaces;
    for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
        surfaces.push_back({mesh.surfaces[s].name, mesh.surfaces[s].role, mesh.vertices, {}});
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            if (std::ranges::binary_search(mesh.surfaces_of[t], s))
                surfaces.back().triangles.push_back(mesh.triangles[t]);
    }
    return surfaces;
}

} // namespace test_support
