// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Filling several holes of several surfaces. Each hole is filled from the surface as it was given;
// the fillings are then joined to it one after the other, so that the order does not matter.
//
// A hole that can't be filled stays open, with the reason: that is no error. New triangles may meet
// others of their surface improperly; contacts_of_new finds where, by exact check.
// Source: the paper, 4.1.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>

namespace terrane {

/// How a hole is filled.
enum class FillMethod : std::uint8_t {
    kriging, ///< z = f(x, y)
    rbf,     ///< any surface
};

/// How the holes of a surface are filled. Lengths in the unit of the surface; describe() says what
/// each member does.
struct FillOptions {
    FillMethod method = FillMethod::kriging; ///< of all holes of the surface
    std::optional<VariogramModel> model{};   ///< of kriging; none: all count, as likely as they are
    double max_area = HUGE_VAL;              ///< see describe(), squared unit
    double mesh_size = 0;                    ///< see describe()
    std::size_t rings = 5;                   ///< see describe()
    double gap_slope = GapRule{}.slope;      ///< see describe(), GapRule::slope
    bool isotropic = false;                  ///< see describe()
    bool bridge_faults = false;              ///< see describe()
    std::optional<double> smoothing{};       ///< RbfOptions::smoothing

    /// Describes the options, see Field.
    static void describe(const auto& visit, auto& o) {
        visit(Field("max_area", "AREA", "Leaves larger holes open", "no limit", {}, true),
              o.max_area);
        visit(Field("bridge_faults", "", "Fills gaps that a fault has torn as well",
                    "they stay open", {}, true),
              o.bridge_faults);
        visit(Field("gap_slope", "S",
                    "A throw of this many widths makes a hole a gap that a fault has torn", {}, {},
                    true),
              o.gap_slope);
        visit(Field("isotropic", "", "For kriging: the variogram is the same in all directions",
                    "anisotropy is fitted"),
              o.isotropic);
        visit(Field("mesh_size", "LENGTH", "Edge length of the new triangles",
                    "the median edge of the hole's border; down to a quarter of it where flat "
                    "triangles would miss more than the method itself",
                    {}, true),
              o.mesh_size);
        visit(Field("rings", "N",
                    "For kriging: least number of rings of triangles round the hole that are data",
                    {}, {1, 1000, true}),
              o.rings);
    }
};

/// A surface whose holes are to be filled.
struct FillTask {
    SurfaceId surface{};   ///< index into the list of surfaces
    FillOptions options{}; ///< for all its holes
};

/// A hole and where it is.
struct NumberedHole {
    std::size_t number = 0;             ///< from 1, through all tasks
    std::size_t task = 0;               ///< and surface of FillWork
    std::size_t loop = 0;               ///< of that surface
    std::optional<FillReport> report{}; ///< where it was filled
    std::string refused{};              ///< why it was not
};

/// A filled surface: the given vertices and triangles come first, then the interpolated ones.
struct HoledSurface {
    FillTask task;                          ///< the wish
    std::string label;                      ///< its name, made unique among all surfaces
    std::vector<BorderLoop> loops;          ///< all of the surface as it was given
    Surface filled;                         ///< with the fillings
    std::size_t given_vertices = 0;         ///< of `filled`, its first ones
    std::size_t given_triangles = 0;        ///< of `filled`, its first ones
    std::vector<double> deviation;          ///< per vertex of `filled`: 0 for given ones, NaN where
                                            ///< the method foresees none
    std::vector<std::int32_t> interpolated; ///< per triangle of `filled`: number of the hole, or 0
};

/// Surfaces with holes, as far as they are filled.
struct FillWork {
    std::vector<HoledSurface> surfaces; ///< one per task
    std::vector<NumberedHole> holes;    ///< by number
};

/// The border of a hole.
inline const BorderLoop& loop_of(const FillWork& work, const NumberedHole& hole) {
    return work.surfaces[hole.task].loops[hole.loop];
}

/// Finds the holes and fills none. Precondition: no two tasks are about one surface. Errors: those
/// of find_border_loops.
Result<FillWork> find_holes(std::span<const Surface> surfaces, std::span<const FillTask> tasks,
                            const Run& run = {});

/// Per hole, whether its task wants it filled: it is not too large, and no gap unless asked for.
std::vector<bool> wanted_holes(const FillWork& work);

/// Fills the chosen holes of the same surfaces. Errors: interrupted, out_of_memory, bad_option,
/// internal.
Status fill_holes(std::span<const Surface> surfaces, const std::vector<bool>& chosen,
                  FillWork& work, const Run& run = {});

/// A new triangle that meets another one of its surface improperly.
struct NewContact {
    std::size_t task = 0;  ///< and surface of FillWork
    std::int32_t hole = 0; ///< its number
    ContactKind kind{};    ///< how the two meet
    Point3 place{};        ///< a point that both share, to the nearest double
};

/// Finds where new triangles meet others of their surface improperly, by exact check.
Result<std::vector<NewContact>> contacts_of_new(const FillWork& work, const Run& run = {});

/// Finds, fills and checks all holes that the tasks want filled. Errors: those of find_holes and
/// fill_holes; improper_contact where new triangles meet others improperly.
Result<FillWork> fill_surfaces(std::span<const Surface> surfaces, std::span<const FillTask> tasks,
                               const Run& run = {});

} // namespace terrane
