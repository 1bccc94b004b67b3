// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The triangles of a section in the exact arrangement of a model and the section.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/sections/sections.hpp>

namespace terrane::sections {

/// A triangle of the section, whose corners are counterclockwise as seen from the front.
struct CutTriangle {
    Triangle corners{};                  ///< vertices of the arrangement
    std::array<std::uint32_t, 3> next{}; ///< across edge (i, i + 1): the next triangle, or no_index
    std::array<std::uint32_t, 2> blocks{}; ///< in front of it and behind it
    std::uint32_t sheet = 0;
};

/// An edge of the section that lies on a surface, and where the surface does not go on within the section on
/// both sides.
struct Trace {
    std::uint32_t surface = 0;
    Edge edge{};

    friend auto operator<=>(const Trace&, const Trace&) = default;
};

/// A section before it is divided into polygons and lines.
struct Cut {
    Arrangement exact;
    std::vector<CutTriangle> triangles;
    std::vector<Trace> traces; ///< sorted, unique
};

/// Arranges the mesh and the section. Errors: those of cut_section().
Result<Cut> cut(const Mesh& mesh, const Volumes& volumes, const SectionSurface& along,
                const Run& run);

} // namespace terrane::sections
