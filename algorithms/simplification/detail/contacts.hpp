// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds contacts nearer than the resolution: places of a complex that are near in space but far
// along it.
//
// A contact joins two places, of which each is a vertex, on an edge, or within a cell. It counts
// (a) on surfaces, if the places are nearest to one another and the way along the surfaces between
//     them is longer than far_along times their distance;
// (b) on curves, if both are on curves, by the way along the curves;
// (c) if both are corners.
// So sheets that are near, wedges of small angles and narrow strips are contacts, while parts of
// one sheet that are near since edges are short are not.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/simplification/detail/complex.hpp>
#include <terrane/algorithms/simplification/detail/features.hpp>

namespace terrane::simplification::detail {

/// A place of a complex: in a vertex, on an edge, or within a cell.
struct Place {
    std::array<std::uint32_t, 3> corners{none, none, none}; ///< ascending, then none
    std::array<double, 3> weights{1, 0, 0};                 ///< of the corners
    std::uint32_t size = 1;                                 ///< number of corners

    [[nodiscard]] std::span<const std::uint32_t> vertices() const { return {corners.data(), size}; }
    [[nodiscard]] std::span<const double> shares() const { return {weights.data(), size}; }
};

/// Two places that are near.
struct NearPlaces {
    double distance = 0;
    Place from{}; ///< a vertex, or on an edge
    Place to{};
    bool on_surfaces = false; ///< rule (a)
};

struct Found {
    std::vector<NearPlaces> contacts{};     ///< by distance, then by vertices
    std::vector<std::uint32_t> to_divide{}; ///< cells too long for where surfaces are near
};

/// Finds the contacts of the active cells (ascending). Cost: a box search, and some microseconds per
/// pair of triangles that is near.
Found find_contacts(const Complex& complex, const CurveNetwork& curves, double resolution,
                    std::span<const std::uint32_t> active, const Run& run);

} // namespace terrane::simplification::detail
