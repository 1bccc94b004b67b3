// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Decides where the triangles of surfaces must be smaller, so that tetrahedra between them are good.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/quality/improve.hpp>

namespace terrane::pipeline::detail {

/// The bad and misshapen tetrahedra of a mesh, and what may help.
struct BadPlaces {
    std::size_t bad = 0;          ///< tetrahedra with an angle below bad_angle
    std::size_t apart = 0;        ///< of these: no corner is at such an angle of the surfaces
    std::size_t misshapen = 0;    ///< others, see misshapen_tetrahedra()
    std::vector<LocalSize> sizes; ///< edge lengths for those apart, or if there is none for the
                                  ///< worse of the misshapen ones, at their centres; none is below
                                  ///< `smallest`
};

/// Factors of the lengths of BadPlaces. The first is for the round after the best one, the others are
/// for rounds after those that were no better. Smaller triangles are not always better: one factor
/// is above 1.
inline constexpr std::array<double, 5> refinement_shares{1, 0.7, 1.3, 0.5, 0.35};

/// Multiplies the lengths by a share; none becomes less than `smallest`.
std::vector<LocalSize> scaled(std::vector<LocalSize> sizes, double share, double smallest);

/// Finds the bad tetrahedra and those of a mean ratio below misshapen_ratio. Near one that is apart
/// from bad angles of the surfaces, edges are to be as short as a tetrahedron of its least height
/// needs, between a quarter and three fifths of its longest edge. Small angles go first: smaller
/// triangles for the other ones were measured to make new small angles.
BadPlaces bad_places(const TetrahedralMesh& mesh, double smallest);

} // namespace terrane::pipeline::detail
