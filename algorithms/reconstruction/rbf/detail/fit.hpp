// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Fits the function whose zero level fills a hole: steps (2) to (4) of rbf.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/reconstruction/kriging/nearby_rest.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/data.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/function.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>

namespace terrane::rbf::detail {

struct Implicit {
    RbfFunction smooth;
    std::shared_ptr<const NearbyRest> rest; ///< of step (4); none if it was not needed

    [[nodiscard]] double operator()(const Point3& p) const {
        return rest ? smooth(p) + (*rest)(p) : smooth(p);
    }
};

/// The form of the function to fit.
struct RbfForm {
    RbfPolynomial polynomial;
    bool along_axis = false; ///< offset constraints are along the polynomial's third axis, not
                             ///< along normals: f is a height, of which the polynomial can take
                             ///< more than of a distance
    bool smoothed = false; ///< step (3) smooths as is likeliest, so that noise of the data is left
                           ///< to step (4) and does not enter the hole
};

/// Fits the function. `tree`: of the data's triangles; `report` describes the fit. Errors: those of
/// RbfFunction::fitted().
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
};

/// Computes axes along and across the hole; the third is the mean normal of its border.
std::array<Point3, 3> axes_of(const RbfData& data);

/// Tells whether the data are a graph over the plane across this axis.
bool is_graph_along(const RbfData& data, const Point3& axis);

/// Chooses the form with the least error at the data left out; a higher degree must be better by a
/// tenth. Errors: interrupted.
Result<RbfChoice> choose_form(const RbfData& data, const RbfOptions& options, const Run& run);

} // namespace terrane::rbf::detail
