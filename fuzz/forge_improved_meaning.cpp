// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The meaning of an improved mesh: the regions of the mesh before, near it, on the same side.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "forge_geometry.hpp"
#include "forge_meaning.hpp"

namespace terrane::fuzz {

namespace {

/// The triangles of a region of a surface.
struct RegionPart {
    std::vector<std::array<Point3, 3>> triangles;
    std::set<Edge> edges;
    std::set<std::uint32_t> vertices;

    [[nodiscard]] std::ptrdiff_t euler_characteristic() const {
        return static_cast<std::ptrdiff_t>(vertices.size() + triangles.size()) -
               static_cast<std::ptrdiff_t>(edges.size());
    }
    [[nodiscard]] Point3 area() const {
        Point3 sum{};
        for (const auto& t : triangles) sum = along(sum, area_vector(t), 1);
        return sum;
    }
    [[nodiscard]] double size() const {
        double sum = 0;
        for (const auto& t : triangles) sum += length(area_vector(t));
        return sum;
    }
    [[nodiscard]] double distance_to(const Point3& p) const {
        double least = std::numeric_limits<double>::infinity();
        for (const auto& t : triangles) least = std::min(least, distance(p, t));
        return least;
    }
};

/// Surface and region: the triangles there.
using RegionParts = std::map<std::array<std::uint32_t, 2>, RegionPart>;

RegionParts parts_of(const std::vector<Point3>& vertices, const std::vector<Triangle>& triangles,
                     const IndexLists<std::uint32_t>& surfaces_of,
                     const IndexLists<std::uint32_t>& regions_of) {
    RegionParts parts;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t i = 0; i < surfaces_of[t].size(); ++i) {
            RegionPart& part = parts[{surfaces_of[t][i], regions_of[t][i]}];
            part.triangles.push_back(corners(vertices, triangles[t]));
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [low, high] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
                part.edges.insert({low, high});
                part.vertices.insert(triangles[t][k]);
            }
        }
    return parts;
}

/// Tells whether corners, middles of sides and centres of one are within a distance of the other.
bool is_near(const RegionPart& one, const RegionPart& other, double limit) {
    const auto near = [&](const Point3& p) {
        return other.distance_to(p) <= 1.0001 * limit + 1e-11 * (1 + length(p));
    };
    for (const auto& t : one.triangles) {
        const Point3 middle = along(t[0], t[1] - t[0], 0.5);
        if (!near(t[0]) || !near(middle) || !near(along(middle, t[2] - middle, 1.0 / 3)))
            return false;
    }
    return true;
}

std::string difference_of_regions(const RegionPart& was, const RegionPart& is, double limit) {
    if (was.euler_characteristic() != is.euler_characteristic()) return "how a region is connected";
    if (!is_near(was, is, limit) || !is_near(is, was, limit)) return "the distance of a region";
    if (dot(was.area(), is.area()) < 0 && length(was.area()) > was.size() / 2)
        return "the side of a region";
    return "";
}

} // namespace

std::string difference_of_improved(const Subject& s, const Certificate& changed) {
    const ImprovedClaim& claim = *changed.improved();
    if (!is_conforming(claim.vertices, claim.triangles))
        return "whether the improved mesh is conforming";
    const auto before = mesh_of(s, [&] {
        Certificate c = changed;
        c.beside = {};
        return c;
    }());
    if (!before) return "lists that make no mesh";
    const auto was = parts_of(before->vertices, before->triangles, before->surfaces_of,
                              changed.rounded->regions_of);
    const auto is = parts_of(claim.vertices, claim.triangles, claim.surfaces_of, claim.regions_of);
    if (was.size() != is.size()) return "the number of regions";
    for (const auto& [key, part] : was) {
        const auto found = is.find(key);
        if (found == is.end()) return "the regions";
        if (auto what = difference_of_regions(part, found->second, claim.limits[key[0]]);
            !what.empty())
            return what;
    }
    return "";
}

} // namespace terrane::fuzz
