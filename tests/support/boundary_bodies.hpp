// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Closed boundaries for tests of volumes of interest, and their exact volumes.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <gmpxx.h>

#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

namespace test_support {

/// Computes the volume that closed surfaces enclose, in rationals; positive if oriented outward.
inline mpq_class volume_of(const std::vector<terrane::Surface>& boundary) {
    using Spot = std::array<mpq_class, 3>;
    const auto spot = [](const terrane::Point3& p) { return Spot{p.x, p.y, p.z}; };
    mpq_class six;
    for (const terrane::Surface& s : boundary)
        for (const terrane::Triangle& t : s.triangles) {
            const Spot a = spot(s.vertices[t[0]]), b = spot(s.vertices[t[1]]),
                       c = spot(s.vertices[t[2]]);
            for (unsigned k = 0; k < 3; ++k) {
                const unsigned u = (k + 1) % 3, v = (k + 2) % 3;
                six += a[k] * (b[u] * c[v] - b[v] * c[u]);
            }
        }
    return six / 6;
}

/// Builds the boundary of an axis-parallel box.
inline std::vector<terrane::Surface> box_of(const terrane::Point3& low,
                                            const terrane::Point3& high) {
    auto made = terrane::box_boundary(low, high);
    REQUIRE(made);
    return std::move(made).value();
}

} // namespace test_support
