// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Diagnoses triangulated surfaces exactly. It repairs nothing and lists all flaws. Cost: one box
// search, and one exact test per pair of overlapping boxes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/intersection/contact_kind.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// The result of check(). Triangles are numbered through all surfaces, in order.
struct CheckReport {
    std::size_t surfaces = 0;                           ///< number of surfaces
    std::size_t triangles = 0;                          ///< number of triangles of all surfaces
    std::size_t vertices = 0;                           ///< number of distinct points in use
    std::vector<std::uint32_t> first_triangle;          ///< per surface, and the total at the end
    std::vector<ImproperContact> contacts;              ///< of distinct triangles with area; sorted
    std::vector<std::uint32_t> degenerate;              ///< triangles without area, ascending
    std::vector<std::array<std::uint32_t, 2>> repeated; ///< {triangle, first with the same points},
                                                        ///< both in one surface
    std::vector<std::array<std::uint32_t, 2>> shared;   ///< likewise in different surfaces: no flaw
    std::vector<std::array<Point3, 2>> non_manifold_edges; ///< with more than two triangles of one
                                                           ///< surface: no flaw by itself
    std::size_t free_border_edges = 0;                     ///< edges with one triangle of a surface
    std::size_t components = 0; ///< number of components that are connected across edges, whatever
                                ///< the surface

    /// Whether the surfaces are conforming: no improper contact, no degenerate and no repeated
    /// triangle.
    [[nodiscard]] bool clean() const {
        return contacts.empty() && degenerate.empty() && repeated.empty();
    }
};

/// Checks surfaces. Errors: bad_number, bad_index, unsupported (indices beyond 32 bits),
/// interrupted, out_of_memory, internal.
Result<CheckReport> check(std::span<const Surface> surfaces, const Run& run = {});

} // namespace terrane
