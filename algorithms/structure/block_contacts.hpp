// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How blocks and the surfaces around them lie to each other.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::structure {

/// Where a block is, seen from a surface at its boundary.
enum class BlockPosition : std::uint8_t { below, above, beside, inside, around };

/// A surface at the boundary of a block.
struct BlockContact {
    std::uint32_t surface = 0;
    double area = 0;                               ///< at the block, squared unit
    BlockPosition position = BlockPosition::below; ///< of the block
    std::string_view direction{};                  ///< beside: of the block, "northwest"
    bool is_roof = false;  ///< whether a part of the surface that counts is above the block
    bool is_floor = false; ///< whether such a part is below it
};

/// A sum that does not depend on the order of its terms, but for errors of 1e-30 of it.
class OrderlessSum {
public:
    void add(double x) {
        const double sum = sum_ + x;
        const double from_x = sum - sum_; // Knuth: the rounding error of a sum is a double
        rest_ += (sum_ - (sum - from_x)) + (x - from_x);
        sum_ = sum;
    }
    void add(const OrderlessSum& other) {
        add(other.sum_);
        rest_ += other.rest_;
    }
    [[nodiscard]] double value() const { return std::isfinite(rest_) ? sum_ + rest_ : sum_; }

private:
    double sum_ = 0, rest_ = 0;
};

/// Sums over triangles of a surface at a block. Normals are outward, as long as the area is.
class ContactSums {
public:
    /// Adds a triangle. place: its centre.
    void add_triangle(const Point3& outward, const Point3& place);
    /// Adds the sums over other triangles.
    void add(const ContactSums& other);
    [[nodiscard]] BlockContact contact(std::uint32_t surface) const;

private:
    /// Area; areas in the map where the normal rises and where it falls; normal; centre by area; products of
    /// centre and normal.
    enum : std::size_t { area, up, down, normal, centre = normal + 3, moment = centre + 3, count };
    std::array<OrderlessSum, count> sums_;
};

/// The blocks on both sides of triangles, and the edges of surfaces. By them a block is inside of a
/// closed surface or not, whatever cuts that surface.
class BlockSides {
public:
    /// The surfaces of one triangle between two blocks, the lower one first. All ways from one block
    /// to the other cross closed surfaces equally often, but for an even number of times.
    using Crossings = std::map<std::array<std::uint32_t, 2>, std::vector<std::uint32_t>>;
    /// A number of 128 bits: the exclusive or of those of all edges of the triangles of a surface, so
    /// that it is zero where each edge has an even number of them.
    using EdgeSum = std::array<std::uint64_t, 2>;

    /// Adds the triangles of a mesh that have different blocks on their sides.
    void add(const Mesh& mesh, std::span<const std::array<std::uint32_t, 2>> of_sides);
    void add_crossing(const std::array<std::uint32_t, 2>& blocks,
                      std::span<const std::uint32_t> surfaces);
    void add_edges(std::uint32_t surface, const EdgeSum& sum);

    [[nodiscard]] const Crossings& crossings() const { return crossings_; }
    [[nodiscard]] const std::map<std::uint32_t, EdgeSum>& edge_sums() const { return edges_; }

    /// Sets the position of blocks to closed surfaces: inside where a way from the outside (block 0)
    /// crosses them an odd number of times. Cost: linear in the crossings.
    void place(std::vector<std::vector<BlockContact>>& contacts) const;

private:
    Crossings crossings_;
    std::map<std::uint32_t, EdgeSum> edges_; ///< per surface
};

/// Adds the triangles of a mesh to the sums of their surfaces, per volume. of_sides: see Volumes. The
/// centres of triangles are relative to `origin`, so that large coordinates cost no digits.
void add_contacts(const Mesh& mesh, std::span<const std::array<std::uint32_t, 2>> of_sides,
                  const Point3& origin, std::vector<std::map<std::uint32_t, ContactSums>>& sums);

/// Lists the surfaces around each block, by their sums and sides.
std::vector<std::vector<BlockContact>>
contacts_of(std::span<const std::map<std::uint32_t, ContactSums>> sums, const BlockSides& sides);

/// Lists the surfaces around each block, by their indices. The outside has none.
std::vector<std::vector<BlockContact>> find_contacts(const Mesh& mesh, const Volumes& volumes);

/// Returns the names of blocks by the surfaces around them (block_names.hpp, (c)); [0] is "outside".
std::vector<std::string> names_by_contacts(std::span<const SurfaceInfo> surfaces,
                                           std::vector<std::vector<BlockContact>> contacts);

} // namespace terrane::structure
