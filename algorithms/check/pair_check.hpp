// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How a mesh is shown to be conforming: what decides each pair of its triangles.
//
// Laws of counts (a test carries each number):
// (1) The five counts add up to n (n - 1) / 2 for n triangles.
// (2) Without `apart` they add up to the pairs of triangles whose boxes overlap.
// (3) With PairCheck::full, in_patches, separated and unmoved are 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace terrane {

/// Which pairs of triangles are tested by exact predicates.
enum class PairCheck : std::uint8_t {
    bounds, ///< those that no proven bound clears
    full,   ///< all whose boxes overlap
};

/// "bounds" or "full".
std::string_view name_of(PairCheck method);

/// Options of all that proves a mesh conforming. The verdict depends on none of them.
struct PairCheckOptions {
    PairCheck method = PairCheck::bounds; ///< which pairs are tested
    /// Largest mesh, in triangles, for which the report counts what decided each pair. Counting takes
    /// one more box search, which proven bounds spare otherwise: for many narrow triangles as long as
    /// all else.
    std::size_t count_up_to = 0;
    /// Pairs with overlapping boxes are not counted if there are more than this for each triangle: of
    /// long triangles side by side nearly all boxes overlap.
    std::uint64_t most_per_triangle = UINT64_MAX;

    /// Returns the largest number of pairs that is counted for a mesh of this size; 0: none.
    [[nodiscard]] constexpr std::uint64_t most_counted(std::size_t triangles) const {
        if (triangles > count_up_to || triangles == 0) return 0;
        return most_per_triangle > UINT64_MAX / triangles ? UINT64_MAX
                                                          : most_per_triangle * triangles;
    }
};

/// How many pairs of triangles of a mesh were decided in which way.
struct PairCounts {
    std::uint64_t tested = 0;     ///< by exact predicates on the two triangles
    std::uint64_t in_patches = 0; ///< by injective patches
    std::uint64_t separated = 0;  ///< by separation
    std::uint64_t unmoved = 0;    ///< by the exact arrangement
    std::uint64_t apart = 0;      ///< their boxes do not overlap

    friend bool operator==(const PairCounts&, const PairCounts&) = default;
};

} // namespace terrane
