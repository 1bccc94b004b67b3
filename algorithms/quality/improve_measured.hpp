// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <terrane/algorithms/check/conforming.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/quality/deviation.hpp>
#include <terrane/algorithms/quality/improve.hpp>

namespace terrane {

/// An improved mesh and how far it is from the mesh before, measured by code that shares nothing
/// with the improvement.
struct ImprovedAndMeasured {
    Improved improved;                 ///< the improved mesh, with its report
    std::vector<Deviation> deviations; ///< per surface, measured
    std::vector<double> bounds_back;   ///< per surface: bound of the distance from old to new

    /// Tells whether the mesh before is proven to be within the bounds of the improved one as well.
    [[nodiscard]] bool is_near_back() const;
};

/// Improves a mesh and measures its deviation. Errors: those of improve; interrupted; internal
/// where the measured deviation exceeds the bound.
Result<ImprovedAndMeasured> improve_and_measure(const ConformingMesh& mesh,
                                                const ImproveOptions& options, const Run& run = {});

/// Returns the improved mesh with its vertices at other places, proven conforming again, and measures
/// it again; its report keeps the bounds. None if it is not conforming, or if other volumes are at
/// its triangles. `points`: one per vertex; `check`: how it is proven. Errors: bad_number; interrupted, out_of_memory.
Result<std::optional<ImprovedAndMeasured>> with_vertices_at(const ConformingMesh& before,
                                                            const ImprovedAndMeasured& improved,
                                                            std::vector<Point3> points,
                                                            const PairCheckOptions& check = {},
                                                            const Run& run = {});

} // namespace terrane
