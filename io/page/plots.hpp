// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The plots of a page, as data: bars over classes of a measure, or over names.
#pragma once

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/quality/improve_measured.hpp>
#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/algorithms/tetrahedra/tetrahedra_shape.hpp>
#include <terrane/io/page/json.hpp>

namespace terrane::page {

/// The triangles' q, smallest angles and edge lengths, after and, if there was one, before. A plot
/// is {"title", "x": {"label", "measure"}, "y": likewise, "bounds": ends of the classes,
/// "series": [{"name", "values"}]}.
void add_triangle_plots(Json& plots, const Mesh& mesh, const Mesh* before);
/// Dihedral angles of tetrahedra.
void add_tetrahedra_plots(Json& plots, const TetrahedraShape& shape);
/// Lengths of free borders by their distance from the nearest surface.
void add_gap_plot(Json& plots, const std::vector<FreeBorder>& borders);
/// The variogram and the cross-validation of filled holes, of the six largest, as points and lines:
/// "lines" in place of "series", each with "name", "x", "y" and "dots".
void add_fill_plots(Json& plots, const FillWork& work);
/// Volumes of the blocks, at most the 40 largest: "names" in place of "bounds".
void add_volume_plot(Json& plots, const Model& model);

} // namespace terrane::page
