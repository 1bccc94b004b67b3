// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The reports of the checks of the verifier, and the parts that they judge.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/verdict.hpp>

namespace terrane::verifier {

using Numbers = std::vector<std::uint32_t>;
constexpr std::uint32_t no_number = UINT32_MAX; ///< of what does not exist
using Violations = std::vector<Violation>;

/// Sorts a list, and leaves each value once.
template <class T>
void make_set(std::vector<T>& values) {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

std::string text(std::uint64_t number);
std::string text(Edge pair); ///< "3 and 7"

void sort_by_rule(Violations& violations);

/// Triangles and their parents, the input triangles that contain them.
struct Parts {
    std::span<const Triangle> triangles;
    const IndexLists<std::uint32_t>& parents_of; ///< per triangle
};

} // namespace terrane::verifier
