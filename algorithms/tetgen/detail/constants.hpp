// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of the domain that is filled with tetrahedra.
#pragma once

#include <vector>

#include <terrane/algorithms/core/named_constant.hpp>

namespace terrane::tetgen::detail {

/// They decide the box around the mesh and which requests are refused.
struct TetrahedraConstants {
    /// Least distance of the box from the mesh, in largest coordinates: room for doubles between.
    double least_margin = 0x1p-40;
    /// Largest margin, and length of a box that is given, in lengths of the mesh: meshers crash at 1e13, where few of the 53
    /// bits of its coordinates are left for the mesh.
    double most_enlargement = 1e9;
    /// Least ratio of circumradius to shortest edge that may be asked for: TetGen need not end
    /// below.
    double least_ratio = 1.1;
    /// Largest expected number of tetrahedra; TetGen counts in int.
    double most_tetrahedra = 5e8;
    /// Time for TetGen where it has a bound on shapes and keeps all facets: a share of the time limit,
    /// or seconds per point if that is more; 1.5.0 may refine forever. Larger: longer waits.
    double bounded_share = 0.1, bounded_seconds_per_point = 2e-3;
};

inline constexpr TetrahedraConstants constants;

/// Lists all constants by name, in the order of their declaration.
inline std::vector<NamedConstant> named_constants() {
    return {
        {"least_margin", constants.least_margin},
        {"most_enlargement", constants.most_enlargement},
        {"least_ratio", constants.least_ratio},
        {"most_tetrahedra", constants.most_tetrahedra},
        {"bounded_share", constants.bounded_share},
        {"bounded_seconds_per_point", constants.bounded_seconds_per_point},
    };
}

} // namespace terrane::tetgen::detail
