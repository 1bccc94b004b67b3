// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Arrangements in tiles of one process.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "support/pieces_joined.hpp"

#include <catch2/catch.hpp>

namespace test_support {

using namespace terrane;

/// most_gathered: see TiledOptions.
inline tiles::TiledReport
arranged(tiles::Supersteps& tiles, const std::vector<Surface>& surfaces,
         std::uint64_t most_gathered = tiles::TiledOptions{}.most_gathered) {
    auto report =
        tiles::arrange_in_tiles(tiles, reader_of(surfaces), {surfaces.size(), true, most_gathered});
    REQUIRE(report);
    return *report;
}

inline Mesh joined(tiles::Supersteps& tiles, const tiles::TiledReport& report) {
    auto mesh = pieces_joined(tiles, report);
    REQUIRE(mesh);
    return std::move(*mesh);
}

/// Two crossing waves with enough triangles for several tiles.
inline std::vector<Surface> waves(unsigned n, double turn) {
    std::vector<Surface> surfaces{{"top", Role::horizon, {}, {}}, {"fault", Role::fault, {}, {}}};
    for (Surface& s : surfaces) {
        const bool is_fault = &s == &surfaces[1];
        for (unsigned i = 0; i <= n; ++i)
            for (unsigned k = 0; k <= n; ++k) {
                const double u = 4.0 * i / n, v = 4.0 * k / n;
                const double w = std::sin(2 * u) * std::cos(v) / 8;
                s.vertices.push_back(is_fault ? Point3{u + turn, 2 + w, v - 2} : Point3{u, v, w});
            }
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t k = 0; k < n; ++k) {
                const std::uint32_t a = i * (n + 1) + k, b = a + n + 1;
                s.triangles.push_back({a, b, a + 1});
                s.triangles.push_back({b, b + 1, a + 1});
            }
    }
    return surfaces;
}

} // namespace test_support
