// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The plots of a page, as data: bars over classes of a measure, or over names.
#pragma once

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>
#include <terrane/io/page/json.hpp>

namespace terrane::page {

/// Adds the triangles' q, smallest angles and edge lengths; with a mesh `before`, of both. A plot is {"title", "x": {"label", "measure"}, "y": likewise, "bounds": ends of the classes,
/// "series": [{"name", "values"}]}.
void add_triangle_plots(Json& plots, const Mesh& mesh, const Mesh* before);
/// Adds the dihedral angles of tetrahedra, their SICN and mean ratios by classes, and how many are
/// bad for each cause.
void add_tetrahedra_plots(Json& plots, const TetrahedraShape& shape);
/// Adds the lengths of free borders by their distance from the nearest surface.
void add_gap_plot(Json& plots, const std::vector<FreeBorder>& borders);
/// Adds the variogram and the cross-validation of each of the six largest filled holes, as points
/// and lines. These plots have "lines" instead of "series", each with "name", "x", "y" and "dots".
void add_fill_plots(Json& plots, const FillWork& work);
/// Adds the volumes of the 40 largest blocks as bars. This plot has names of bars ("names") instead
/// of classes ("bounds").
void add_volume_plot(Json& plots, const Model& model);

} // namespace terrane::page
