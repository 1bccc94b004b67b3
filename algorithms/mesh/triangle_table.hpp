// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

#include <terrane/algorithms/mesh/index_table.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Hashes the corners of a triangle, in their order.
inline std::uint64_t hash_of(const Triangle& t) {
    std::uint64_t h = 0;
    for (const std::uint32_t v : t) h = (h ^ v) * 0x9e3779b97f4a7c15u;
    return h ^ (h >> 32);
}

struct TriangleHash {
    std::size_t operator()(const Triangle& t) const { return hash_of(t); }
};

/// Finds triangles with equal corners in the same order.
using TriangleTable = IndexTable<Triangle, TriangleHash>;

} // namespace terrane
