// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Changes of the triangles in a certificate, whatever section has them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/verify/verify.hpp>

namespace terrane::fuzz {

using Numbers = std::vector<std::uint32_t>;

/// The arguments of a change, from the bytes of the fuzzer.
struct Arguments {
    unsigned a = 0; ///< of 16 bits, the others of 8
    unsigned b = 0, c = 0, d = 0;
};

/// Returns a number below the count; 0 if there is nothing to pick.
inline std::size_t pick(unsigned number, std::size_t count) {
    return count == 0 ? 0 : number % count;
}

/// Moves a coordinate by some units in the last place, a part of itself, or a length.
double moved(double x, unsigned how, unsigned amount);

std::vector<Numbers> unpacked(const IndexLists<std::uint32_t>& lists);
IndexLists<std::uint32_t> packed(const std::vector<Numbers>& lists);

template <class Item>
void erase_at(std::vector<Item>& items, std::size_t i) {
    items.erase(items.begin() + static_cast<std::ptrdiff_t>(i));
}
void erase_at(IndexLists<std::uint32_t>& lists, std::size_t i);

/// What the sections "exact", "rounded", "improved", "filled" and "layered" have in common.
struct Part {
    std::vector<Triangle>& triangles;
    IndexLists<std::uint32_t>& parents_of; ///< of changed surfaces: surfaces
    IndexLists<std::uint32_t>* regions_of; ///< nullptr: it has none
    std::vector<Edge>* intersection_edges; ///< nullptr: it has none
    std::size_t vertices;                  ///< their number
    std::vector<Point3>* points = nullptr; ///< nullptr: they are constructions
};

/// A change of a part that has triangles.
struct PartChange {
    const char* name;
    void (*make)(Part&, const Arguments&);
};

std::span<const PartChange> part_changes();

/// Divides a triangle, and with it those beyond its side, at a vertex.
void divide(Part& part, const Arguments& arguments, std::uint32_t vertex, bool at_side);

/// Adds a vertex in the middle of a triangle or of its side, and divides the triangles there.
void divide_at_middle(Part& part, const Arguments& arguments);

} // namespace terrane::fuzz
