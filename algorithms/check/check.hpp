// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The exact diagnosis of triangulated surfaces as they are: nothing is repaired, nothing is left
// out. Cost: one box search, one exact test per pair of boxes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane {

/// How two triangles meet that should not.
enum class ContactKind : std::uint8_t {
    vertex_on_edge,
    vertex_on_face,
    edges_cross,     ///< in one point, inside both
    edges_overlap,   ///< collinear, along a segment
    edge_on_face,    ///< an edge lies in the other triangle
    crossing,        ///< along a segment through the inside of at least one of them
    coplanar_overlap ///< in an area
};

/// "vertex on edge", ...
std::string_view name_of(ContactKind kind);

/// The kind of a contact, from its points' places alone.
ContactKind kind_of(const Contact& contact);

/// Two triangles that meet other than in a shared vertex or edge.
struct ImproperContact {
    std::array<std::uint32_t, 2> triangles{}; ///< input triangles, counted through all surfaces
    ContactKind kind{};                       ///< how they meet
    Point3 place;                             ///< a point that both share, to the nearest double
};

/// Triangles and vertices are counted through all surfaces, in order.
struct CheckReport {
    std::size_t surfaces = 0;                           ///< number of surfaces
    std::size_t triangles = 0;                          ///< of all surfaces
    std::size_t vertices = 0;                           ///< distinct points in use
    std::vector<std::uint32_t> first_triangle;          ///< per surface, and the total at the end
    std::vector<ImproperContact> contacts;              ///< of distinct triangles with area; sorted
    std::vector<std::uint32_t> degenerate;              ///< triangles without area, ascending
    std::vector<std::array<std::uint32_t, 2>> repeated; ///< {triangle, first with the same points},
                                                        ///< both in one surface
    std::vector<std::array<std::uint32_t, 2>> shared; ///< the same, in different surfaces: no flaw
    std::vector<std::array<Point3, 2>> non_manifold_edges; ///< of one surface, with more than two
                                                           ///< triangles: no flaw by itself
    std::size_t free_border_edges = 0;                     ///< edges with one triangle of a surface
    std::size_t components = 0; ///< connected over edges, whatever the surface

    /// Conforming: no improper contact, no degenerate and no repeated triangle.
    [[nodiscard]] bool clean() const {
        return contacts.empty() && degenerate.empty() && repeated.empty();
    }
};

/// Errors: bad_number, bad_index, interrupted, out_of_memory.
Result<CheckReport> check(std::span<const Surface> surfaces, const Run& run = {});

/// bad_number or bad_index with the place, for surfaces that no stage may be given.
Status validate(std::span<const Surface> surfaces, const Run& run = {});

} // namespace terrane
