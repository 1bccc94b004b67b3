// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of the domain that is filled with tetrahedra.
#pragma once

#include <terrane/algorithms/core/constants.hpp>

namespace terrane::tetgen::detail {

/// They decide the box around the mesh and which requests are refused.
struct TetrahedraConstants : Constants {
    /// Least distance of the box from the mesh, in largest coordinates: room for doubles between.
    double least_margin = add("least_margin", 0x1p-40);
    /// Largest margin, and length of a box that is given, in lengths of the mesh: meshers crash at 1e13, where few of the 53
    /// bits of its coordinates are left for the mesh.
    double most_enlargement = add("most_enlargement", 1e9);
    /// Least ratio of circumradius to shortest edge that may be asked for: TetGen need not end
    /// below.
    double least_ratio = add("least_ratio", 1.1);
    /// Largest expected number of tetrahedra; TetGen counts in int.
    double most_tetrahedra = add("most_tetrahedra", 5e8);
    /// Where TetGen has a bound on shapes and keeps all facets, it has this share of the time limit,
    /// but at least bounded_seconds per point: 1.5.0 may then refine forever. Larger: longer waits.
    double bounded_share = add("bounded_share", 0.1);
    /// See bounded_share.
    double bounded_seconds_per_point = add("bounded_seconds_per_point", 2e-3);
};

inline constexpr TetrahedraConstants constants{};

} // namespace terrane::tetgen::detail
