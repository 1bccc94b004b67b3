// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Counts the pairs of triangles of a mesh by the step that decides them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane {

/// The step that decided a pair of triangles whose boxes overlap.
enum class DecidedBy : std::uint8_t {
    test,       ///< exact predicates on the two triangles
    patch,      ///< both are in one injective patch: docs/explanation/injective-patches.md
    separation, ///< a bound on their distance: docs/explanation/separation.md
    exact_mesh, ///< the exact arrangement, since neither has moved
};

/// Counts all pairs of triangles of a mesh; decided_by is asked for those whose boxes overlap, from
/// several threads. None if more than `most` boxes overlap. Cost: one box search, which ends there,
/// and no memory for the pairs. Times: count_pairs.
std::optional<PairCounts>
count_pairs(std::span<const Point3> points, std::span<const Triangle> triangles,
            const std::function<DecidedBy(const CandidatePair&)>& decided_by, std::uint64_t most,
            const Run& run = {});

} // namespace terrane
