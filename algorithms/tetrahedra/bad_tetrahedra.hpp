// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds tetrahedra with small dihedral angles, and why they have them, and other misshapen ones.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>

namespace terrane {

/// Returns the corners of a tetrahedron of a mesh.
std::array<Point3, 4> corners_of(const TetrahedralMesh& mesh, std::uint32_t number);

/// Tells why tetrahedra of a mesh are bad. A face is on a surface if it is one of `mesh.faces`.
class BadCauses {
public:
    explicit BadCauses(const TetrahedralMesh& mesh);

    /// Returns the first cause that applies. `angles`: those of dihedral_angles(), one of them bad.
    [[nodiscard]] BadCause of(const std::array<std::uint32_t, 4>& tetrahedron,
                              const std::array<Point3, 4>& corners,
                              const std::array<double, 6>& angles) const;
    /// Tells whether the two faces at edge i of dihedral_angles() are on surfaces.
    [[nodiscard]] bool is_between_surfaces(const std::array<std::uint32_t, 4>& tetrahedron,
                                           std::size_t i) const;

private:
    [[nodiscard]] bool is_given(const std::array<std::uint32_t, 4>& tetrahedron,
                                std::size_t k) const;

    std::vector<Triangle> faces_;  ///< on surfaces; corners ascending; sorted
    std::vector<bool> on_surface_; ///< per node
};

/// A tetrahedron with a dihedral angle below bad_angle.
struct BadTetrahedron {
    std::uint32_t number = 0; ///< its index
    BadCause cause{};
    double least = 0; ///< least dihedral angle, degrees
    bool is_at_input_angle =
        false; ///< a corner of it is at a bad angle of the surfaces, which no mesh can avoid: at an
               ///< end of an edge where two of them meet at such an angle, or where two curves do
};

/// Lists the bad tetrahedra of a mesh by their index. Curves are edges with other than two faces,
/// or with two of different surfaces. The values are computed in doubles.
std::vector<BadTetrahedron> bad_tetrahedra(const TetrahedralMesh& mesh);

/// Lists tetrahedra by their index that are not bad, but whose mean_ratio() is below `least`. Those
/// with a corner at a bad angle of the surfaces are left out, see BadTetrahedron::is_at_input_angle.
std::vector<std::uint32_t> misshapen_tetrahedra(const TetrahedralMesh& mesh, double least);

} // namespace terrane
