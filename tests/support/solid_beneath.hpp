// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The solid beneath a sheet, by which sides of surfaces are judged.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <terrane/algorithms/mesh/surface.hpp>

namespace test_support {

/// Returns the edges of a sheet, and how often it runs along each, from the lesser end, more than against it.
inline std::map<std::pair<terrane::Point3, terrane::Point3>, int>
border_of(const terrane::Surface& sheet) {
    std::map<std::pair<terrane::Point3, terrane::Point3>, int> border;
    for (const auto& [i, j, k] : sheet.triangles)
        for (const auto& [v, w] : {std::pair{i, j}, std::pair{j, k}, std::pair{k, i}}) {
            const auto &p = sheet.vertices[v], &q = sheet.vertices[w];
            border[std::minmax(p, q)] += p < q ? 1 : -1;
        }
    std::erase_if(border, [](const auto& edge) { return edge.second == 0; });
    return border;
}

/// Whether no two triangles run the same way along an edge.
inline bool is_turned_alike(const terrane::Surface& sheet) {
    std::map<std::pair<terrane::Point3, terrane::Point3>, int> times;
    for (const auto& [i, j, k] : sheet.triangles)
        for (const auto& [v, w] : {std::pair{i, j}, std::pair{j, k}, std::pair{k, i}})
            if (++times[{sheet.vertices[v], sheet.vertices[w]}] > 1) return false;
    return true;
}

/// Returns the solid between a sheet and a horizontal plane: the sheet, its image in that plane, turned over, and walls
/// along its border. Where the sheet overhangs, parts of the image cancel out.
inline terrane::Surface beneath(const terrane::Surface& sheet, double bottom, std::string name) {
    using terrane::Point3;
    terrane::Surface solid{std::move(name), terrane::Role::unknown, {}, {}};
    const auto down = [&](const Point3& p) { return Point3{p.x, p.y, bottom}; };
    const auto add = [&](const Point3& a, const Point3& b, const Point3& c) {
        const auto first = static_cast<std::uint32_t>(solid.vertices.size());
        solid.vertices.insert(solid.vertices.end(), {a, b, c});
        solid.triangles.push_back({first, first + 1, first + 2});
    };
    for (const auto& [i, j, k] : sheet.triangles) {
        const Point3 &a = sheet.vertices[i], &b = sheet.vertices[j], &c = sheet.vertices[k];
        add(a, b, c);
        add(down(a), down(c), down(b));
    }
    for (const auto& [edge, times] : border_of(sheet)) {
        const auto [p, q] = times > 0 ? edge : std::pair{edge.second, edge.first};
        for (int n = 0; n < std::abs(times); ++n) {
            add(p, down(p), down(q));
            add(p, down(q), q);
        }
    }
    return solid;
}

} // namespace test_support
