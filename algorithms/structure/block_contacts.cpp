// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/block_contacts.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/structure/detail/constants.hpp>
#include <terrane/algorithms/structure/detail/parts.hpp>

namespace terrane::structure {
namespace {

/// Names the direction of a vector in the map, one of eight.
std::string_view compass(double east, double north) {
    constexpr double tangent = 0.41421356237309503; // of half the angle between two directions
    const double x = std::abs(east), y = std::abs(north);
    if (y <= tangent * x) return east > 0 ? "east" : "west";
    if (x < tangent * y) return north > 0 ? "north" : "south";
    if (north > 0) return east > 0 ? "northeast" : "northwest";
    return east > 0 ? "southeast" : "southwest";
}

} // namespace

void ContactSums::add_triangle(const Point3& outward, const Point3& place) {
    const double size = length(outward);
    sums_[area].add(size);
    sums_[outward.z > 0 ? up : down].add(std::abs(outward.z));
    const double n[3] = {outward.x, outward.y, outward.z}, p[3] = {place.x, place.y, place.z};
    for (std::size_t k = 0; k < 3; ++k) {
        sums_[normal + k].add(n[k]);
        sums_[centre + k].add(size * p[k]);
    }
    sums_[moment].add(dot(place, outward));
}

void ContactSums::add(const ContactSums& other) {
    for (std::size_t k = 0; k < count; ++k) sums_[k].add(other.sums_[k]);
}

BlockContact ContactSums::contact(std::uint32_t surface) const {
    const auto value = [&](std::size_t k) { return sums_[k].value(); };
    const auto vector = [&](std::size_t k) { return Point3{value(k), value(k + 1), value(k + 2)}; };
    BlockContact c{.surface = surface, .area = value(area)};
    const double least = detail::block_name_constants.least_share * (value(up) + value(down));
    c.is_roof = value(up) > 0 && value(up) >= least;
    c.is_floor = value(down) > 0 && value(down) >= least;
    const Point3 n = vector(normal);
    if (!(length(n) >= detail::block_name_constants.least_resultant * c.area)) {
        // The moment about the centre tells on which side of the surface its centre is.
        const bool is_inside = value(moment) - dot(vector(centre), n) / c.area > 0;
        c.position = is_inside ? BlockPosition::inside : BlockPosition::around;
    } else if (std::abs(n.z) >= std::hypot(n.x, n.y)) {
        c.position = n.z > 0 ? BlockPosition::below : BlockPosition::above;
    } else {
        c.position = BlockPosition::beside;
        c.direction = compass(-n.x, -n.y);
    }
    return c;
}

void add_contacts(const Mesh& mesh, std::span<const std::array<std::uint32_t, 2>> of_sides,
                  const Point3& origin, std::vector<std::map<std::uint32_t, ContactSums>>& sums) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (of_sides[t][0] == of_sides[t][1]) continue; // it dangles
        Point3 place{};
        for (const std::uint32_t v : mesh.triangles[t]) {
            const Point3 p = minus(mesh.vertices[v], origin);
            place = {place.x + p.x / 3, place.y + p.y / 3, place.z + p.z / 3};
        }
        const Point3 n = detail::area_vector(mesh, t);
        for (std::size_t side = 0; side < 2; ++side) {
            const double half = side == 0 ? -0.5 : 0.5; // normals point away from the back
            const std::uint32_t block = of_sides[t][side];
            if (block == 0) continue;
            for (const std::uint32_t s : mesh.surfaces_of[t])
                sums[block][s].add_triangle({half * n.x, half * n.y, half * n.z}, place);
        }
    }
}

std::vector<std::vector<BlockContact>>
contacts_of(std::span<const std::map<std::uint32_t, ContactSums>> sums) {
    std::vector<std::vector<BlockContact>> contacts(sums.size());
    for (std::size_t b = 1; b < sums.size(); ++b)
        for (const auto& [surface, own] : sums[b]) contacts[b].push_back(own.contact(surface));
    return contacts;
}

std::vector<std::vector<BlockContact>> find_contacts(const Mesh& mesh, const Volumes& volumes) {
    std::vector<std::map<std::uint32_t, ContactSums>> sums(volumes.measures.size());
    if (mesh.triangles.empty()) return contacts_of(sums);
    add_contacts(mesh, volumes.of_sides, mesh.vertices[0], sums);
    return contacts_of(sums);
}

} // namespace terrane::structure
