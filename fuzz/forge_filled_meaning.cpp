// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The meaning of filled surfaces: all given triangles, and new triangles that close whole borders.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <vector>

#include <terrane/algorithms/check/check.hpp>

#include "forge_geometry.hpp"
#include "forge_meaning.hpp"

namespace terrane::fuzz {

namespace {

/// A filled surface, and how much of it was given.
struct FilledSurface {
    Surface surface;
    std::size_t given_vertices = 0, given_triangles = 0;
    double limit = 0;
};

std::map<Edge, std::vector<std::uint32_t>> edges_of(const std::vector<Triangle>& triangles) {
    std::map<Edge, std::vector<std::uint32_t>> edges;
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
            edges[{low, high}].push_back(t);
        }
    return edges;
}

std::string contact_flaw(const FilledSurface& filled) {
    const auto report = check(std::array{filled.surface});
    if (!report) return "lists that make no surface";
    const auto is_new = [&](std::uint32_t t) { return t >= filled.given_triangles; };
    for (const auto& contact : report->contacts)
        if (std::ranges::any_of(contact.triangles, is_new)) return "a new triangle meets another";
    if (std::ranges::any_of(report->degenerate, is_new)) return "a new triangle without area";
    for (const auto& repeated : report->repeated)
        if (is_new(repeated[0])) return "a new triangle that was there";
    return "";
}

/// New triangles form components; each must be bounded by whole borders of what was given.
std::string border_flaw(const FilledSurface& filled) {
    const auto& all = filled.surface.triangles;
    const std::vector<Triangle> given(
        all.begin(), all.begin() + static_cast<std::ptrdiff_t>(filled.given_triangles));
    const auto before = edges_of(given);
    std::map<std::uint32_t, std::vector<std::uint32_t>> next; // along given borders
    for (const auto& [edge, around] : before)
        if (around.size() == 1) {
            next[edge[0]].push_back(edge[1]);
            next[edge[1]].push_back(edge[0]);
        }
    for (const auto& [edge, around] : edges_of(all)) {
        const bool touched = std::ranges::any_of(
            around, [&](std::uint32_t t) { return t >= filled.given_triangles; });
        if (!touched) continue;
        if (around.size() != 2) return "an edge of a new triangle that is not closed";
        const bool on_border = before.contains(edge);
        if (!on_border) continue;
        for (const std::uint32_t v : edge) // the border goes on, and is closed there as well
            for (const std::uint32_t w : next[v]) {
                const auto after = edges_of(all).at({std::min(v, w), std::max(v, w)});
                if (after.size() != 2 && next[v].size() == 2)
                    return "a border that is closed in part";
            }
    }
    return "";
}

std::string place_flaw(const FilledSurface& filled) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Point3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
    const auto& vertices = filled.surface.vertices;
    for (std::size_t v = 0; v < filled.given_vertices; ++v) {
        const Point3& p = vertices[v];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const double slack = filled.limit * 1.0001 + 1e-12;
    for (std::size_t v = filled.given_vertices; v < vertices.size(); ++v) {
        const Point3& p = vertices[v];
        if (p.x < low.x - slack || p.y < low.y - slack || p.z < low.z - slack ||
            p.x > high.x + slack || p.y > high.y + slack || p.z > high.z + slack)
            return "a new vertex far from all that was given";
    }
    return "";
}

} // namespace

std::string difference_of_filled(const Subject& s, const FilledClaim& claim) {
    if (claim.surfaces.size() != s.surfaces.size()) return "the number of surfaces";
    std::size_t vertex = 0, triangle = 0;
    for (std::size_t i = 0; i < s.surfaces.size(); ++i) {
        const FilledPart& part = claim.surfaces[i];
        const Surface& given = s.surfaces[i];
        if (vertex + part.vertices > claim.vertices.size() ||
            triangle + part.triangles > claim.triangles.size() ||
            part.vertices < given.vertices.size() || part.triangles < given.triangles.size())
            return "the counts";
        FilledSurface filled{given, given.vertices.size(), given.triangles.size(), part.limit};
        filled.surface.vertices.assign(claim.vertices.begin() + static_cast<std::ptrdiff_t>(vertex),
                                       claim.vertices.begin() +
                                           static_cast<std::ptrdiff_t>(vertex + part.vertices));
        filled.surface.triangles.clear();
        for (std::size_t t = triangle; t < triangle + part.triangles; ++t) {
            Triangle corners = claim.triangles[t];
            for (auto& v : corners) v -= static_cast<std::uint32_t>(vertex);
            filled.surface.triangles.push_back(corners);
        }
        if (!std::equal(given.vertices.begin(), given.vertices.end(),
                        filled.surface.vertices.begin()) ||
            !std::equal(given.triangles.begin(), given.triangles.end(),
                        filled.surface.triangles.begin()))
            return "what was given";
        for (const auto flaw : {contact_flaw, border_flaw, place_flaw})
            if (auto what = flaw(filled); !what.empty()) return what;
        vertex += part.vertices;
        triangle += part.triangles;
    }
    return vertex == claim.vertices.size() && triangle == claim.triangles.size() ? ""
                                                                                 : "the counts";
}

} // namespace terrane::fuzz
