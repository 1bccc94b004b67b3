// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds the features that remeshing preserves: sheets, the curves between them, and corners.
//
// - A curve edge has other than two triangles, or two that differ in their surfaces or regions, or
//   is an intersection edge, or a crease: its triangles turn by more than the crease angle.
// - A sheet is a maximal set of triangles connected across all other edges. Its triangles are
//   oriented consistently; a one-sided sheet (a Moebius strip) is cut open by a curve.
// - A corner is a vertex at which other than two curve edges meet, or two that turn sharply or are
//   of different kinds, or at which not every fan of triangles runs from one curve edge to the
//   other. A closed curve without corners gets one.
// - A curve runs from corner to corner.
// Cost: linear, except for sorting.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane::quality::detail {

constexpr std::uint32_t none = UINT32_MAX;

enum class VertexKind : std::uint8_t { unused, inner, curve, corner };

struct Curve {
    std::vector<std::uint32_t> vertices; ///< of the mesh, >= 2, in order; both ends are corners
    std::vector<double> at;              ///< per vertex: arc length, from 0
    bool intersection = false;           ///< its edges are intersection edges
};

struct Features {
    std::vector<Triangle> triangles;     ///< those of the mesh, oriented consistently within a
                                         ///< sheet
    std::vector<std::uint32_t> sheet_of; ///< per triangle
    std::vector<std::array<std::uint32_t, 3>>
        across;                          ///< per triangle and edge i (from corner i to the next):
                                         ///< its neighbour in the sheet, none at a curve edge
    std::vector<std::uint32_t> first_of; ///< per sheet: its first triangle
    std::vector<VertexKind> kinds;       ///< per vertex
    std::vector<Curve> curves;           ///< in order of discovery
    std::vector<std::uint32_t> curve_of; ///< per vertex of kind curve: its curve; else none
    std::vector<std::uint32_t> place_of; ///< per vertex of kind curve: its index in the curve
    std::vector<Edge> edges;             ///< all curve edges, sorted
};

struct FeatureAngles {
    double crease = 0; ///< radians by which two triangles may turn; more is a crease
    double curve = 0;  ///< radians by which a curve may turn at a vertex; more is a corner
};

Features find_features(const Mesh& mesh, const FeatureAngles& angles, const Run& run = {});

} // namespace terrane::quality::detail
