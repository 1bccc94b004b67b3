// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tetrahedra that are judged: their faces, and which of these lie on the surfaces.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/judge/detail/properties.hpp>
#include <terrane/algorithms/judge/detail/target.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane::judging {

/// A face of tetrahedra, or of one.
struct TetrahedronFace {
    Triangle corners; ///< ascending
    std::array<std::uint32_t, 2>
        sides; ///< tetrahedra in front, from where the corners are counterclockwise, and behind; or no_index

    [[nodiscard]] bool is_border() const { return sides[0] == no_index || sides[1] == no_index; }
    [[nodiscard]] std::vector<std::uint32_t> tetrahedra() const;
};

/// The faces of tetrahedra. Nodes at one point are one, the first.
struct TetrahedronFaces {
    const LabelledTetrahedra& made;
    std::vector<std::uint32_t> node_at; ///< per vertex: the first one at its point
    std::vector<TetrahedronFace> faces; ///< by corners
    int winding = 1;                    ///< -1 if most tetrahedra have orient3d(0,1,2,3) < 0
    Flaws positive, conforming;

    TetrahedronFaces(const LabelledTetrahedra& tetrahedra, std::size_t most_flaws);

    [[nodiscard]] Point3 middle(std::uint32_t tetrahedron) const;
    [[nodiscard]] Point3 middle(const TetrahedronFace& face) const;
    [[nodiscard]] std::array<std::uint32_t, 4> nodes(std::uint32_t tetrahedron) const;
    /// Whether the two tetrahedra of a face have other vertices there.
    [[nodiscard]] bool is_torn(const TetrahedronFace& face) const;

private:
    void join_nodes();
    void find_faces(const std::vector<int>& signs);
};

/// The faces that should be the surfaces.
struct SurfaceFaces {
    std::vector<std::uint32_t> faces; ///< ascending
    std::vector<bool> flat;           ///< per tetrahedron: all of its nodes are on one cell
};

/// Chooses faces. Those of one tetrahedron are, and those of which all corners are within `reach` of one
/// cell; where tetrahedra lie between several layers of these, the layer is that in front of the cell.
SurfaceFaces choose_surface_faces(const TetrahedronFaces& tetrahedra, const Target& target,
                                  const Cells& cells, double reach);

} // namespace terrane::judging
