// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Sheets over a grid in x and y, with cells left out.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace test_support {

/// Over [0, columns] x [0, rows] in steps of one, times `step`: each cell that `keep`(column, row)
/// names as two triangles, front up; vertices in use only, at point(x, y).
template <class Keep, class At>
terrane::Surface sheet_of(int columns, int rows, double step, const Keep& keep, const At& point) {
    terrane::Surface s{"sheet", terrane::Role::horizon, {}, {}};
    std::map<std::pair<int, int>, std::uint32_t> known;
    const auto vertex = [&](int i, int j) {
        const auto [at, added] =
            known.try_emplace({i, j}, static_cast<std::uint32_t>(s.vertices.size()));
        if (added) s.vertices.push_back(point(i * step, j * step));
        return at->second;
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            if (!keep(i, j)) continue;
            const auto a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                       d = vertex(i, j + 1);
            s.triangles.push_back({a, b, c});
            s.triangles.push_back({a, c, d});
        }
    return s;
}

/// The same with heights z(x, y).
template <class Keep, class Height>
terrane::Surface sheet(int columns, int rows, double step, const Keep& keep, const Height& z) {
    return sheet_of(columns, rows, step, keep, [&](double x, double y) {
        return terrane::Point3{x, y, z(x, y)};
    });
}

/// Keeps all but the cells whose middle is within `radius` cells of (column, row).
inline auto without_disc(double column, double row, double radius) {
    return [=](int i, int j) { return std::hypot(i + 0.5 - column, j + 0.5 - row) > radius; };
}

} // namespace test_support
