// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The rules R40 to R48 of the verifier: tetrahedra. docs/explanation/tetrahedra.md proves what
// follows from them; the numbers of statements refer to that page.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/detail/extent.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>

namespace terrane::verifier {

using BlockSides = std::array<std::uint32_t, 2>; ///< blocks in front of a triangle and behind it

/// The mesh that tetrahedra fill, as it was verified.
struct FilledMesh {
    std::span<const Point3> vertices;
    std::span<const Triangle> triangles;
    std::span<const BlockSides> sides;  ///< per triangle
    std::span<const mpq_class> volumes; ///< per block; [0] of all
};

/// Tetrahedra with values that follow from the coordinates of their nodes.
struct TetrahedraParts {
    const TetrahedraClaim& claim;
    const FilledMesh& mesh;
    std::vector<Vector4> nodes;  ///< integers: the coordinates times scale
    std::vector<Vector4> points; ///< the vertices of the mesh, likewise
    mpz_class scale = 1;
    Extent box;              ///< around the tetrahedra
    Numbers place_of;        ///< per node: the lowest node of a tetrahedron at the same point
    Numbers place_of_vertex; ///< per vertex of the mesh: the place at exactly its coordinates, or
                             ///< no_number

    [[nodiscard]] bool needs_faces(std::uint32_t triangle) const {
        return claim.box || mesh.sides[triangle] != BlockSides{0, 0};
    }
    template <std::size_t n>
    [[nodiscard]] std::array<std::uint32_t, n> places(std::array<std::uint32_t, n> nodes_of) const {
        for (std::uint32_t& node : nodes_of) node = place_of[node];
        return nodes_of;
    }
};

/// Judges the faces of tetrahedra (R42), their blocks (R46) and cuts (R48). Returns, per triangle,
/// the listed faces that name it, without the second ones of twins.
std::vector<Numbers> check_faces(const TetrahedraParts& parts, Violations& found);

/// Judges whether the faces of each triangle cover it (R45), by statements (3) to (5). Returns, per
/// triangle, whether it is divided.
std::vector<bool> check_cover(const TetrahedraParts& parts, const std::vector<Numbers>& faces_of,
                              Violations& found);

/// Returns an upper bound of the volume of all points that are within reach of a triangle, by
/// statements (5) and (8). It depends on the coordinates of the triangle only.
mpq_class volume_within_reach(const std::array<Point3, 3>& triangle);

/// Measured volumes of tetrahedra.
struct MeasuredVolumes {
    std::size_t divided = 0;  ///< triangles that are not single faces
    mpq_class difference = 0; ///< the largest between a block and its tetrahedra
};

/// Judges all rules about tetrahedra. After a violation of R40 no other one is judged. Cost:
/// sorting the faces, and a determinant of integers per tetrahedron; rationals on divided
/// triangles.
MeasuredVolumes check_tetrahedra(const TetrahedraClaim& claim, const FilledMesh& mesh,
                                 Violations& found);

} // namespace terrane::verifier
