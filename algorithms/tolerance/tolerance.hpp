// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Joins what is nearer than a tolerance: units that were meshed apart, whose contacts nearly coincide,
// get common sheets.
//
// (a) Borders and creases of a surface that are near those of earlier surfaces get their vertices.
// (b) Fences, strips of triangles across the space beside a crease or border, divide the gaps and
//     overlaps between surfaces into cells, in the exact arrangement of all.
// (c) A surface is a chain of faces of cells. The boundary of a thin cell is added (modulo 2) to the
//     surfaces of its largest interface, which vanishes: one surface then runs along the other side.
// (d) What surfaces still have is rounded, and gives the surfaces of the result. Faces that several
//     surfaces run along are the same triangle in each of them.
//
// Guarantees: (1) each point of a surface of the result is within the tolerance of where the surface
// was, and each point where it was is within the tolerance of it, or of another surface where nothing is
// left of it, as is_within() shows for the doubles at the end, by code that shares nothing with the moves.
// If that is not shown for a surface, nothing is joined. (2) A closed surface stays closed: boundaries are added to it.
// (3) Thin cells that were left are listed. A thin cell with one surface only, such as a thin unit, is
// left. Cost: that of two arrangements. The result does not depend on the number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace terrane {

/// Options of join_within().
struct ToleranceOptions {
    double tolerance = 0;       ///< > 0, unit of the surfaces
    ArrangeOptions arrange{};   ///< of the surfaces with their fences
    RoundingOptions rounding{}; ///< of the result
};

/// A gap, an overlap or a unit that is thinner than the tolerance and was not joined.
struct ThinCell {
    double thickness = 0;                  ///< twice its volume by the area around it
    double volume = 0;                     ///< cubic unit
    std::vector<std::uint32_t> surfaces{}; ///< around it, ascending
    Point3 place{};                        ///< centre of its largest face
};

/// What was joined.
struct ToleranceReport {
    double tolerance = 0;         ///< as asked for
    std::size_t vertices = 0;     ///< of borders and creases that moved to another surface's
    std::size_t cells = 0;        ///< thin cells that were joined
    double volume = 0;            ///< of these, cubic unit
    std::vector<ThinCell> left{}; ///< from the largest volume on
    std::vector<std::uint32_t> vanished{}; ///< surfaces that collapsed: others are where they were
    bool is_joined = false;                ///< false: nothing is near, or is_refused
    bool is_refused = false; ///< what was joined is not shown to be within the tolerance
};

/// Surfaces that were joined.
struct JoinedSurfaces {
    std::vector<Surface> surfaces; ///< in the order of the input
    ToleranceReport report;
};

/// Joins surfaces. Errors: bad_option (the tolerance is not positive and finite), those of arrange(),
/// find_volumes() and round_to_doubles(). Times: tolerance, with their steps.
Result<JoinedSurfaces> join_within(std::vector<Surface> surfaces, const ToleranceOptions& options,
                                   const Run& run = {});

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> tolerance_constants();

} // namespace terrane
