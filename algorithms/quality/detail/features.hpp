// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What improving a mesh must keep: sheets, the curves between them, corners. Private to improve.
//
// - A curve edge is one with other than two triangles, or with two that differ in their surfaces or
//   regions, or an intersection edge, or a crease: sharper than an angle.
// - A sheet is what hangs together over all other edges. Its triangles are wound alike; where that
//   can't be (a Moebius strip) it is cut open by a curve.
// - A corner is a vertex at which other than two curve edges meet, or two that turn sharply or are
//   not of one kind, or where the sheets do not all run from the one edge to the other. A closed
//   curve without corner gets one.
// - A curve runs from corner to corner.
// Cost: linear, but for sorting.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane::improving {

constexpr std::uint32_t none = UINT32_MAX;

enum class VertexKind : std::uint8_t { unused, inner, curve, corner };

struct Curve {
    std::vector<std::uint32_t> vertices; ///< of the mesh, >= 2, in order; both ends are corners
    std::vector<double> at;              ///< per vertex: length along the curve, from 0
    bool intersection = false;           ///< its edges are intersection edges
};

struct Features {
    std::vector<Triangle> triangles;     ///< of the mesh, wound alike within a sheet
    std::vector<std::uint32_t> sheet_of; ///< per triangle
    std::vector<std::array<std::uint32_t, 3>>
        across;                          ///< per triangle and edge i (from corner i to the next):
                                         ///< its neighbour in the sheet, none at a curve edge
    std::vector<std::uint32_t> first_of; ///< per sheet: its lowest triangle
    std::vector<VertexKind> kinds;       ///< per vertex
    std::vector<Curve> curves;           ///< order of their discovery
    std::vector<std::uint32_t> curve_of; ///< per vertex of kind curve: its curve; else none
    std::vector<std::uint32_t> place_of; ///< per vertex of kind curve: its place in the curve
    std::vector<Edge> edges;             ///< all curve edges, sorted
};

struct FeatureAngles {
    double crease = 0; ///< radians by which two triangles may turn; more is a crease
    double curve = 0;  ///< radians by which a curve may turn at a vertex; more is a corner
};

Features find_features(const Mesh& mesh, const FeatureAngles& angles, const Run& run = {});

} // namespace terrane::improving
