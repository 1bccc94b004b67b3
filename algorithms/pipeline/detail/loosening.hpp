// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Moves vertices of an improved mesh where tetrahedra are bad, as no choice of tetrahedra between
// these triangles would make them better.
#pragma once

#include <optional>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>

namespace terrane::pipeline::detail {

/// The mesh and tetrahedra whose vertices are moved.
struct LoosenInput {
    const Arranged& arranged; ///< the surfaces before they were improved
    const ImprovedAndMeasured& improved;
    const ImproveOptions& options; ///< of that
    const Model& model;            ///< of the improved mesh
    const TetrahedraRequest& request;
    const TetrahedralMesh& made; ///< by make_tetrahedra()
};

/// A mesh of which vertices have moved, and its tetrahedra.
struct Loosened {
    std::optional<ImprovedAndMeasured> improved; ///< none: no vertex has moved
    TetrahedralMesh tetrahedra;                  ///< improved
    OptimiseReport optimised;
    LoosenedVertices moved;
};

/// Moves vertices of the improved mesh where its tetrahedra are bad, see optimise(). The mesh is then
/// proven conforming again; its blocks stay.
///
/// Where surfaces were simplified, all their vertices may move, in the sides of the boundary, as far as
/// the resolution leaves room; all of each surface is shown to be within the resolution again, and
/// report.bound_of grows by the movement. Otherwise only vertices inside of sheets move, on the
/// original surface, and each of their triangles is proven to be within report.bound_of of that; and no
/// dihedral angle is larger than the largest one before. Vertices of triangles without proof move less,
/// or not at all. After three attempts without a complete proof no vertex moves.
///
/// Returns none if the tetrahedra are not sound. Errors: those of improve_tetrahedra() and with_vertices_at().
Result<std::optional<Loosened>> loosen(const LoosenInput& input, const Run& run);

} // namespace terrane::pipeline::detail
