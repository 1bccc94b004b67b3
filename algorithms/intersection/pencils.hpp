// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Pencils: very many triangles in planes through one line. Each two of them in different planes meet
// in that line or not at all, so that what all pairs share is found by one sweep along the line.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/intersection/contacts.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane {

/// Triangles in planes through one line.
struct Pencil {
    std::vector<std::uint32_t> triangles; ///< ascending
    std::vector<std::uint32_t> plane_of;  ///< per triangle: its plane, counted from 0
    std::array<std::uint32_t, 2>
        carriers; ///< triangles in two planes: the line is where these meet
};

/// Disjoint pencils.
struct Pencils {
    std::vector<Pencil> list;
    std::vector<std::uint32_t> of; ///< per triangle: its pencil or no_group; empty without pencils
};

/// Finds pencils of at least 128 triangles. `busy`: triangles of which some may be in one; those
/// that are in none cost little. It may miss pencils, as it tries a few lines only; the same ones on
/// each call.
Pencils find_pencils(const TriangleSoup& soup, std::span<const std::uint32_t> busy, const Run& run);

/// Returns the pairs of triangles in one plane of a pencil whose boxes overlap, except those within
/// one group; sorted, unique.
std::vector<CandidatePair> coplanar_pairs(const TriangleSoup& soup, const Pencils& pencils,
                                          std::span<const std::uint32_t> groups, const Run& run);

/// The contacts of triangles of different planes of a pencil.
struct PencilContacts {
    std::vector<Construction> points;   ///< distinct points
    std::vector<FaceConstraint> pieces; ///< ends are indices into points. Those that a triangle has
                                        ///< already, its corners and edges, are left out
};

/// Finds the contacts of a pencil. Cost: that of sorting its triangles, and of the result.
PencilContacts contacts_of(const TriangleSoup& soup, const Pencil& pencil);

} // namespace terrane
