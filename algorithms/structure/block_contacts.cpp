// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/block_contacts.hpp>

#include <algorithm>
#include <array>
#include <bit>
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

/// Mixes the bits of a number, each of which then depends on all. Source: the finaliser of SplitMix64
/// (Steele, Lea and Flood, 2014).
std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ x >> 30U) * 0xBF58476D1CE4E5B9U;
    x = (x ^ x >> 27U) * 0x94D049BB133111EBU;
    return x ^ x >> 31U;
}

/// Returns a number for the place of a vertex, which is the same in each tile.
BlockSides::EdgeSum number_of(const Point3& p) {
    BlockSides::EdgeSum number{0x9E3779B97F4A7C15U, 0xD1B54A32D192ED03U};
    for (std::uint64_t& half : number)
        for (const double c : {p.x, p.y, p.z})
            half = mixed(half ^ std::bit_cast<std::uint64_t>(c + 0.0)); // -0 is 0
    return number;
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

void BlockSides::add(const Mesh& mesh, std::span<const std::array<std::uint32_t, 2>> of_sides) {
    std::vector<EdgeSum> numbers; // of the vertices
    std::array<std::uint32_t, 2> last{};
    for (const Point3& p : mesh.vertices) numbers.push_back(number_of(p));
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [front, back] = of_sides[t];
        if (front == back) continue; // it dangles
        const auto surfaces = mesh.surfaces_of[t];
        const std::array<std::uint32_t, 2> blocks{std::min(front, back), std::max(front, back)};
        if (blocks != last) crossings_.try_emplace(blocks, surfaces.begin(), surfaces.end());
        last = blocks; // neighbouring triangles mostly follow each other
        EdgeSum sum{};
        for (std::size_t i = 0; i < 3; ++i) {
            const EdgeSum &a = numbers[mesh.triangles[t][i]],
                          &b = numbers[mesh.triangles[t][(i + 1) % 3]];
            for (std::size_t k = 0; k < 2; ++k) sum[k] ^= mixed(a[k] + b[k]);
        }
        for (const std::uint32_t s : surfaces) add_edges(s, sum);
    }
}

void BlockSides::add_crossing(const std::array<std::uint32_t, 2>& blocks,
                              std::span<const std::uint32_t> surfaces) {
    crossings_.try_emplace(blocks, surfaces.begin(), surfaces.end());
}

void BlockSides::add_edges(std::uint32_t surface, const EdgeSum& sum) {
    EdgeSum& all = edges_[surface];
    for (std::size_t k = 0; k < 2; ++k) all[k] ^= sum[k];
}

void BlockSides::place(std::vector<std::vector<BlockContact>>& contacts) const {
    using Crossing = Crossings::value_type;
    std::vector<std::vector<const Crossing*>> at(contacts.size());
    for (const Crossing& crossing : crossings_)
        for (const std::uint32_t block : crossing.first) at[block].push_back(&crossing);
    std::map<std::uint32_t, bool> is_inside; // of closed surfaces: of the block at hand
    for (const auto& [surface, sum] : edges_)
        if (sum == EdgeSum{}) is_inside[surface] = false;
    if (is_inside.empty()) return;
    const auto cross = [&](const Crossing* crossing) {
        if (crossing == nullptr) return;
        for (const std::uint32_t s : crossing->second)
            if (const auto found = is_inside.find(s); found != is_inside.end())
                found->second = !found->second;
    };
    struct Step {
        std::uint32_t block;
        const Crossing* way;  ///< to the block
        std::size_t next = 0; ///< of its crossings
    };
    std::vector<bool> seen(contacts.size());
    std::vector<Step> path{{0, nullptr}};
    seen[0] = true;
    while (!path.empty()) {
        Step& step = path.back();
        if (step.next == 0)
            for (BlockContact& c : contacts[step.block])
                if (const auto found = is_inside.find(c.surface); found != is_inside.end()) {
                    if (found->second) c.position = BlockPosition::inside;
                    if (!found->second && c.position == BlockPosition::inside)
                        c.position = BlockPosition::around;
                }
        if (step.next == at[step.block].size()) {
            cross(step.way);
            path.pop_back();
            continue;
        }
        const Crossing* way = at[step.block][step.next++];
        const std::uint32_t to = way->first[way->first[0] == step.block ? 1 : 0];
        if (seen[to]) continue;
        seen[to] = true;
        cross(way);
        path.push_back({to, way});
    }
}

std::vector<std::vector<BlockContact>>
contacts_of(std::span<const std::map<std::uint32_t, ContactSums>> sums, const BlockSides& sides) {
    std::vector<std::vector<BlockContact>> contacts(sums.size());
    for (std::size_t b = 1; b < sums.size(); ++b)
        for (const auto& [surface, own] : sums[b]) contacts[b].push_back(own.contact(surface));
    sides.place(contacts);
    return contacts;
}

std::vector<std::vector<BlockContact>> find_contacts(const Mesh& mesh, const Volumes& volumes) {
    std::vector<std::map<std::uint32_t, ContactSums>> sums(volumes.measures.size());
    BlockSides sides;
    if (!mesh.triangles.empty()) {
        add_contacts(mesh, volumes.of_sides, mesh.vertices[0], sums);
        sides.add(mesh, volumes.of_sides);
    }
    return contacts_of(sums, sides);
}

} // namespace terrane::structure
