// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How far it is from place to place along the surfaces, or along the curves, of a complex.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <terrane/algorithms/simplification/detail/complex.hpp>
#include <terrane/algorithms/simplification/detail/contacts.hpp>
#include <terrane/algorithms/simplification/detail/features.hpp>

namespace terrane::simplification::detail {

class Ways {
public:
    Ways(const Complex& complex, const CurveNetwork& curves) : complex_(complex), curves_(curves) {}

    /// Tells whether no way along the surfaces is shorter than far_along times the distance. Ways
    /// run along edges, across one edge that cells of both places have in common, or along the
    /// section with a plane through both places: the shortest one if cells go on as planes.
    [[nodiscard]] bool are_far_along_surfaces(const NearPlaces& c) const;
    /// The same along curves.
    [[nodiscard]] bool are_far_along_curves(const NearPlaces& c) const;

private:
    [[nodiscard]] bool are_far(const NearPlaces& c, bool along_curves) const;
    [[nodiscard]] bool meet_at_edge(const NearPlaces& c, double limit) const;
    [[nodiscard]] bool meet_in_section(const NearPlaces& c, const Point3& normal,
                                       double limit) const;
    [[nodiscard]] Point3 normal_of(std::uint32_t cell) const;
    [[nodiscard]] bool meet_in_a_section(const NearPlaces& c, double limit) const;
    [[nodiscard]] std::vector<std::uint32_t> cells_of(const Place& place) const;
    [[nodiscard]] Point3 at(const Place& place) const {
        return complex_.between(place.vertices(), place.shares()).place;
    }

    const Complex& complex_;
    const CurveNetwork& curves_;
};

} // namespace terrane::simplification::detail
