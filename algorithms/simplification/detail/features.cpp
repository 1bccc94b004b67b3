// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/simplification/detail/features.hpp>

#include <algorithm>
#include <cstddef>
#include <span>

#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/simplification/detail/tuning.hpp>

namespace terrane::simplification::detail {
namespace {

bool have_same_surfaces(const Cell& a, const Cell& b) {
    return std::equal(
        a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(),
        [](const CellLayer& x, const CellLayer& y) { return x.surface == y.surface; });
}

/// Tells whether two cells at the edge ab turn by more than the crease angle.
bool is_crease(const Complex& complex, std::uint32_t a, std::uint32_t b, const Cell& s,
               const Cell& t) {
    const auto& points = complex.points();
    const auto away = [&](const Cell& cell) { // normal of the cell, with ab before its third corner
        std::uint32_t c = cell.corners[0];
        for (const std::uint32_t v : cell.corners)
            if (v != a && v != b) c = v;
        return cross(minus(points[b], points[a]), minus(points[c], points[a]));
    };
    const Point3 m = away(s), n = away(t);
    return -dot(m, n) < tuning.crease_cosine * length(m) * length(n);
}

} // namespace

bool CurveNetwork::has(std::uint32_t a, std::uint32_t b) const {
    return std::binary_search(edges.begin(), edges.end(), Edge{std::min(a, b), std::max(a, b)});
}

CurveNetwork find_curves(const Complex& complex) {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> cell_of;
    for (std::uint32_t t = 0; t < complex.cells().size(); ++t)
        if (complex.has(t)) {
            triangles.push_back(complex.cells()[t].corners);
            cell_of.push_back(t);
        }
    const std::size_t count = complex.points().size();
    CurveNetwork curves;
    curves.neighbours.resize(count);
    const auto cell = [&](const EdgeSides::Side& side) {
        return complex.cells()[cell_of[side.triangle]];
    };
    group_edges(triangles, count)
        .for_each([&](std::uint32_t a, std::uint32_t b, std::span<const EdgeSides::Side> sides) {
            if (sides.size() == 2 && have_same_surfaces(cell(sides[0]), cell(sides[1])) &&
                !is_crease(complex, a, b, cell(sides[0]), cell(sides[1])))
                return;
            curves.edges.push_back({a, b});
            curves.neighbours[a].push_back(b);
            curves.neighbours[b].push_back(a);
        });
    using enum CurveNetwork::Kind;
    for (const auto& list : curves.neighbours)
        curves.kind_of.push_back(list.empty() ? inner : list.size() == 2 ? curve : corner);
    return curves;
}

} // namespace terrane::simplification::detail
