// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks of the verifier that indices are in range and lists are sorted; violations are reported
// under the given rule.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/verify/detail/violations.hpp>

namespace terrane::verifier {

template <class T>
bool sorted_and_unique(std::span<const T> values) {
    return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

bool all_below(std::span<const std::uint32_t> values, std::size_t count);

/// Tells whether there are `count` lists, with offsets that ascend from 0 to the number of values.
bool well_formed(const IndexLists<std::uint32_t>& lists, std::size_t count);

/// Checks that all coordinates are finite; `name` is the name of a point in sentences: "vertex".
void check_finite(std::span<const Point3> vertices, const std::string& name, Rule rule,
                  Violations& found);
void check_corners(std::span<const Triangle> triangles, std::size_t vertex_count, Rule rule,
                   Violations& found);
/// Checks that each triangle has a sorted list of input triangles that is not empty.
void check_parents(const Parts& parts, std::size_t input_triangles, Rule rule, Violations& found);
void check_edge_list(std::span<const Edge> edges, std::size_t vertex_count, Rule rule,
                     Violations& found);

/// Checks that a stated limit of a surface is a distance, and not above the largest that is accepted
/// (R26).
void check_limit(double limit, std::uint32_t surface, double accepted, Rule rule,
                 Violations& found);

/// Calls report(value, is_listed) for each value that is only in one of two sorted lists.
template <class T, class Report>
void compare_lists(const std::vector<T>& truth, const std::vector<T>& listed,
                   const Report& report) {
    std::vector<T> different;
    std::ranges::set_symmetric_difference(truth, listed, std::back_inserter(different));
    for (const T& value : different) report(value, std::ranges::binary_search(listed, value));
}

} // namespace terrane::verifier
