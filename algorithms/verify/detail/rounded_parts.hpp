// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The mesh of doubles of a certificate, in exact numbers, with the data for the rules about it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/detail/contacts.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>
#include <terrane/algorithms/verify/verdict.hpp>

namespace terrane::verifier {

/// All indices of the claims are in range (R1, R10). The points, max_move and deviation are
/// integers: the numbers of the certificate times `scale`.
struct RoundedParts {
    const Inputs& inputs;
    const ArrangementClaim& exact;
    const RoundedClaim& rounded;
    SetAside set_aside;
    IndexLists<std::uint32_t> children; ///< per input triangle: the triangles of the mesh that name
                                        ///< it
    std::vector<Vector4> input_points, points;
    mpz_class max_move, deviation;
    mpz_class quarter; ///< of the deviation, rounded down
    mpz_class scale = 1;
    bool same_triangles = false; ///< the mesh has the vertices, triangles and parents of the exact
                                 ///< part, each vertex at another place at most
    IndexLists<std::uint32_t> exact_children; ///< per input triangle: its exact triangles
    mpz_class accepted;                       ///< the largest deviation that is accepted
    std::vector<bool> is_cut; ///< per input triangle: some of its exact triangles were left out;
                              ///< empty: none

    [[nodiscard]] std::array<const Vector4*, 3> input_corners(std::uint32_t triangle) const {
        const auto& [a, b, c] = inputs.triangles[triangle];
        return {&input_points[a], &input_points[b], &input_points[c]};
    }
    [[nodiscard]] std::array<const Vector4*, 3> corners(std::uint32_t triangle) const {
        const auto& [a, b, c] = rounded.triangles[triangle];
        return {&points[a], &points[b], &points[c]};
    }
};

/// Does what verify_rounded() does for an arrangement of which a part was left out: `exact` is what
/// was kept, and `is_cut` is that of RoundedParts.
Verdict verify_rounded_part(std::span<const Surface> inputs, const ArrangementClaim& exact,
                            const RoundedClaim& rounded, const VerifyOptions& options,
                            std::vector<bool> is_cut);

RoundedParts make_rounded_parts(const Inputs& inputs, const ArrangementClaim& exact,
                                const RoundedClaim& rounded);

/// Returns the largest deviation that is accepted where none is given; VerifyOptions defines it.
double default_max_deviation(const Inputs& inputs);

/// The results of check_distances().
struct Distances {
    double deviation = 0;    ///< upper bound, both ways; unit of the input
    Numbers partly_vanished; ///< input triangles of which a thin part is not left, sorted
};

/// Checks the distances between the mesh and the inputs, both ways (R12, R13, R14, R18), and
/// measures them. Precondition: the stated deviation is not
/// above the largest that is accepted.
///
/// (1) With the triangles of the exact part, each point of an exact triangle has an image in the
///     triangle with the same number, which is not farther from it than the farthest corner. So the
///     largest move of a vertex bounds both distances.
/// (2) Otherwise: a triangle is not farther from a parent than its farthest corner, since the
///     distance to a convex set is convex.
/// (3) Let c be a quarter of the stated deviation. A point of an input triangle that is not covered
///     along its normal is at most 3/2 c away from the triangle's border: at most c by R18, or the
///     centroid is at most c away from the border, which it is if the radius of the inscribed
///     circle is at most 3/2 c (this is at most half of the smallest height, the centroid's
///     distance is a third of it). The sides are at most c away from the triangles that name the
///     input triangle. So all of it is at most 5/2 c away from these. Where the tip of a needle has
///     vanished, its sides are at most c away from the mesh.
///     Where a part of the input triangle was left out, the same is shown for each exact triangle
///     that was kept: the border of what is covered is at most c away from the border of what was
///     kept, which is outside of each of them. Exact points are taken to integers for that, which
///     moves them by less than the unit of these integers.
/// (4) An input triangle that has vanished has a height of at most 2 c, so that each point is at
///     most c away from the sides, and the sides are at most c away from the mesh.
Distances check_distances(const RoundedParts& parts, Violations& found);

/// Reports the triangles that are turned over (R19): a triangle faces the side that its first parent
/// faces, unless its smallest height is at most the stated deviation: rounding can turn such a
/// triangle.
void check_rounded_orientation(const RoundedParts& parts, Violations& found);

/// Compares how the triangles that name input triangles are connected with the exact part (R37).
/// The image of an input triangle consists of the triangles that name it, with their edges and
/// vertices. It may have no more pieces and holes than in the exact part, and enclose no space. The
/// same holds for what two input triangles with a common side have in common. Input triangles that
/// meet along more than the deviation still meet, unless one is as near to the plane of the other
/// as is accepted. `thinned` are the input triangles of which a part has vanished: they may be torn, as
/// those may whose smallest height is at most the deviation.
/// Returns the differences of all kinds. A mesh with the triangles of the exact part differs in nothing.
Differences check_images(const RoundedParts& parts, const Numbers& thinned, Violations& found);

/// Checks that shells with the same sides, of two meshes with the same triangles, are around the same
/// shells and bound what is around their component likewise (R38). Returns the number of edges
/// around which the triangles lie in another order. Precondition: both are conforming.
std::size_t check_places(const ExactMesh& exact, const ExactMesh& doubles, Violations& found);

/// Checks that regions are the parts into which intersection edges divide the surfaces (R16).
void check_regions(const RoundedParts& parts, Violations& found);

} // namespace terrane::verifier
