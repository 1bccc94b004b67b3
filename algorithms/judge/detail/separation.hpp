// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The edges between cells, as a mesh has them.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/judge/detail/matching.hpp>
#include <terrane/algorithms/judge/detail/target.hpp>

namespace terrane::judging {

/// The boundaries of cells along edges of a mesh. The mesh may leave out a point at which two collinear
/// edges of a boundary, and no other, meet; and it may divide an edge at vertices within the bound of it.
class Separation {
public:
    Separation(const Target& target, const Cells& cells, const OutputMesh& output,
               const Matching& matching, double bound);

    /// Boundaries of cells between vertices of the mesh; edges whose ends coincide there are left out.
    [[nodiscard]] const std::vector<CellEdge>& boundary() const { return boundary_; }
    /// Whether an edge of the mesh separates cells.
    [[nodiscard]] bool separates(std::uint32_t u, std::uint32_t w) const;
    /// Points that the mesh needs and lacks, ascending.
    [[nodiscard]] const std::vector<std::uint32_t>& missing() const { return missing_; }
    /// Returns the vertices of the mesh along an exact edge that begins at `from`, up to the first one
    /// at the end of it or beyond; none if `from` has no vertex, or no end has. Where the mesh has no
    /// such edges, the two ends are returned.
    [[nodiscard]] std::vector<std::uint32_t> image(std::uint32_t from, std::uint32_t to) const;
    /// Whether the mesh has all edges between vertices that follow each other.
    [[nodiscard]] bool has_path(const std::vector<std::uint32_t>& vertices) const;
    /// Returns the vertices of the mesh along edges of cells from one vertex straight to another one,
    /// both included; none if there is no such path.
    [[nodiscard]] std::vector<std::uint32_t> straight_path(std::uint32_t u, std::uint32_t w) const;

private:
    [[nodiscard]] bool is_passed(std::uint32_t x) const;
    [[nodiscard]] bool collinear(std::uint32_t x, std::uint32_t y, std::uint32_t z) const;
    [[nodiscard]] std::vector<std::uint32_t> path(std::uint32_t x, std::uint32_t y) const;
    [[nodiscard]] std::vector<std::uint32_t> near_path(std::uint32_t u, std::uint32_t w) const;

    const Target& target_;
    const OutputMesh& output_;
    const Matching& matching_;
    double bound_;
    IndexLists<std::uint32_t> neighbours_; ///< per vertex of the arrangement: along edges of cells
    IndexLists<std::uint32_t> around_;     ///< per vertex of the mesh: along its edges
    std::vector<std::uint32_t> missing_;
    std::vector<CellEdge> boundary_;
    std::vector<Edge> separating_; ///< sorted
};

} // namespace terrane::judging
