// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Holes of surfaces: found, chosen, filled and checked, as `fill` and `build` do it.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/reconstruction/holes/filling.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/algorithms/reconstruction/kriging/fill_kriging.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/session/session.hpp>

namespace terrane::cli {

/// How the holes of a surface are filled. Lengths in the unit of the surface.
struct FillSettings {
    std::string method = "kriging"; ///< or rbf
    std::string model = "auto"; ///< of the variogram: or spherical, exponential, gaussian, power
    double max_area = HUGE_VAL; ///< larger holes stay open
    double mesh_size = 0;       ///< 0: the median edge of the hole's border
    std::size_t rings = KrigingOptions{}.rings; ///< of data, for kriging
    double gap_slope = GapRule{}.slope;
    bool isotropic = false;
    bool bridge = false;               ///< fault gaps, too
    std::optional<double> smoothing{}; ///< RbfOptions::smoothing
};

/// A surface whose holes are to be filled.
struct FillTask {
    std::uint32_t surface = 0; ///< of the inputs
    FillSettings settings;
};

/// A hole and where it is.
struct NumberedHole {
    std::size_t number = 0;             ///< from 1, through all tasks
    std::size_t task = 0;               ///< and surface of FillWork
    std::size_t loop = 0;               ///< of that surface
    std::optional<FillReport> report{}; ///< where it was filled
    std::string refused{};              ///< why it was not
};

/// A surface as it becomes: what was given, then what was invented.
struct HoledSurface {
    FillTask task;
    std::string label;
    std::vector<BorderLoop> loops; ///< all of the surface as it was given
    Surface filled;
    std::size_t given_vertices = 0, given_triangles = 0;
    std::vector<double> deviation;      ///< per vertex of `filled`: 0 for what was given, NaN where
                                        ///< the method foresees none
    std::vector<std::int32_t> invented; ///< per triangle of `filled`: number of the hole, or 0
};

struct FillWork {
    std::vector<HoledSurface> surfaces; ///< one per task
    std::vector<NumberedHole> holes;    ///< by number
};

inline const BorderLoop& loop_of(const FillWork& work, const NumberedHole& hole) {
    return work.surfaces[hole.task].loops[hole.loop];
}

/// The holes, none of them filled. No two tasks are about one surface. Errors: those of
/// find_border_loops.
Result<FillWork> find_holes(const Inputs& inputs, std::span<const FillTask> tasks,
                            Session& session);

/// Per hole, whether its task wants it filled: none that is too large, or a gap.
std::vector<bool> wanted_holes(const FillWork& work);

/// Fills those that are chosen. A hole that can't be filled is no error: it stays open, with the
/// reason. Errors: interrupted, out_of_memory, bad_option, internal.
Status fill_holes(const Inputs& inputs, const std::vector<bool>& chosen, FillWork& work,
                  Session& session);

/// Where new triangles meet others improperly within their surface, by exact check: at most ten
/// in words, a line each; empty: nowhere.
Result<std::string> contacts_of_new(const FillWork& work, Session& session);

/// "hole 2 of top is left open: ...", one line for each that was refused; empty: none.
std::string refusals_text(const FillWork& work);

} // namespace terrane::cli
