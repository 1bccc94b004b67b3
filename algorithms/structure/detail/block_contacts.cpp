// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/detail/block_contacts.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/structure/detail/constants.hpp>
#include <terrane/algorithms/structure/detail/parts.hpp>

namespace terrane::structure::detail {
namespace {

void add(Point3& sum, const Point3& p, double factor) {
    sum = {sum.x + factor * p.x, sum.y + factor * p.y, sum.z + factor * p.z};
}

/// Sums over the triangles of a surface at a block. Normals are outward, as long as the area is.
struct Sums {
    double area = 0;
    double up = 0, down = 0; ///< areas in the map where the normal rises, and where it falls
    Point3 normal{};         ///< sum of the normals
    Point3 centre{};         ///< sum of the centres by area
    double moment = 0;       ///< sum of the products of centre and normal

    void add_triangle(const Point3& outward, const Point3& place) {
        const double size = length(outward);
        area += size;
        (outward.z > 0 ? up : down) += std::abs(outward.z);
        add(normal, outward, 1);
        add(centre, place, size);
        moment += dot(place, outward);
    }
};

/// Names the direction of a vector in the map, one of eight.
std::string_view compass(double east, double north) {
    constexpr double tangent = 0.41421356237309503; // of half the angle between two directions
    const double x = std::abs(east), y = std::abs(north);
    if (y <= tangent * x) return east > 0 ? "east" : "west";
    if (x < tangent * y) return north > 0 ? "north" : "south";
    if (north > 0) return east > 0 ? "northeast" : "northwest";
    return east > 0 ? "southeast" : "southwest";
}

BlockContact contact_of(std::uint32_t surface, const Sums& sums) {
    BlockContact c{.surface = surface, .area = sums.area};
    const double least = block_name_constants.least_share * (sums.up + sums.down);
    c.is_roof = sums.up > 0 && sums.up >= least;
    c.is_floor = sums.down > 0 && sums.down >= least;
    const Point3& n = sums.normal;
    if (!(length(n) >= block_name_constants.least_resultant * sums.area)) {
        // The moment about the centre tells on which side of the surface its centre is.
        const double moment = sums.moment - dot(sums.centre, n) / sums.area;
        c.position = moment > 0 ? BlockPosition::inside : BlockPosition::around;
    } else if (std::abs(n.z) >= std::hypot(n.x, n.y)) {
        c.position = n.z > 0 ? BlockPosition::below : BlockPosition::above;
    } else {
        c.position = BlockPosition::beside;
        c.direction = compass(-n.x, -n.y);
    }
    return c;
}

} // namespace

std::vector<std::vector<BlockContact>> find_contacts(const Mesh& mesh, const Volumes& volumes) {
    std::vector<std::map<std::uint32_t, Sums>> sums(volumes.measures.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (volumes.dangles(t)) continue;
        const auto [i, j, k] = mesh.triangles[t];
        Point3 place{}; // relative to a vertex, so that large coordinates cost no digits
        for (const std::uint32_t v : {i, j, k})
            add(place, minus(mesh.vertices[v], mesh.vertices[0]), 1. / 3);
        const Point3 n = area_vector(mesh, t);
        for (std::size_t side = 0; side < 2; ++side) {
            const double half = side == 0 ? -0.5 : 0.5; // normals point away from the back
            const Point3 outward{half * n.x, half * n.y, half * n.z};
            const std::uint32_t block = volumes.of_sides[t][side];
            if (block == 0) continue;
            for (const std::uint32_t s : mesh.surfaces_of[t])
                sums[block][s].add_triangle(outward, place);
        }
    }
    std::vector<std::vector<BlockContact>> contacts(sums.size());
    for (std::size_t b = 1; b < sums.size(); ++b)
        for (const auto& [surface, own] : sums[b]) contacts[b].push_back(contact_of(surface, own));
    return contacts;
}

} // namespace terrane::structure::detail
