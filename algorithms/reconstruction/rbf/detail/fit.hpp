// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Fits the function whose zero level fills a hole: steps (2) to (4) of rbf.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/data.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/function.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/patches.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>

namespace terrane::rbf::detail {

struct Implicit {
    RbfFunction smooth;
    RbfPatches rest;
    double nugget = 0; ///< of detail/error.hpp: variance of each datum if smoothed

    [[nodiscard]] double operator()(const Point3& p) const {
        return rest.size() == 0 ? smooth(p) : smooth(p) + rest(p);
    }
};

/// The form of the function to fit.
struct RbfForm {
    RbfPolynomial polynomial;
    bool along_axis = false; ///< offset constraints are along the polynomial's third axis, not
                             ///< along normals: f is a height, of which the polynomial can take
                             ///< more than of a distance
    bool smoothed = false;   ///< step (3) smooths by generalised cross-validation, so that noise of
                             ///< the data is left to step (4) and does not enter the hole
};

/// Fits the function. `tree`: of the data's triangles; `report` describes the fit. Errors: those of
/// fit_rbf(); interrupted.
Result<Implicit> fit_hole(const RbfData& data, const TriangleTree& tree, const RbfForm& form,
                          const RbfOptions& options, RbfReport& report, const Run& run);

/// The data without those nearest to the hole, as if it were larger.
struct LeftOut {
    RbfData kept;
    std::vector<std::uint32_t> points; ///< indices of the data left out
    double width = 0;                  ///< by how much the hole is wider, unit of the surface
};

/// The chosen form and its validation.
struct RbfChoice {
    RbfForm form;
    double validated = 0; ///< root mean square error at the data left out; NaN if none could be
                          ///< left out
    std::vector<std::array<double, 2>> left_out{}; ///< FillReport::left_out
    double expected = 0; ///< factor of RbfError: error at the data left out / power function there;
                         ///< NaN if none could be left out
};

/// Computes axes along and across the hole; the third is the mean normal of its border.
std::array<Point3, 3> axes_of(const RbfData& data);

/// Tells whether the data are a graph over the plane across this axis.
bool is_graph_along(const RbfData& data, const Point3& axis);

/// Chooses the form with the least error at the data left out; a higher degree must be better by a
/// tenth. Errors: interrupted.
Result<RbfChoice> choose_form(const RbfData& data, const RbfOptions& options, const Run& run);

/// Step (4): interpolates the errors that were left at the data, if any exceeds the tolerance;
/// `fade` says how far they reach. With options.smoothing, reports them only.
void interpolate_rest(Implicit& f, const RbfData& data, const RbfOptions& options,
                      RbfReport& report, const Run& run);

/// Selects up to `count` of the points marked in `of`, each as far as possible from those before
/// it.
std::vector<std::uint32_t> well_spread(const std::vector<Point3>& points, std::size_t count,
                                       const std::vector<bool>& of);

} // namespace terrane::rbf::detail
