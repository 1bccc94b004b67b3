// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The function whose zero level fills a hole: steps (2) to (4) of rbf.hpp. Private to rbf.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/data.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/function.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/patches.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>

namespace terrane {

struct Implicit {
    RbfFunction smooth;
    RbfPatches rest;
    double nugget = 0; ///< of rbf_error.hpp: of each datum, where they are smoothed

    [[nodiscard]] double operator()(const Point3& p) const {
        return rest.size() == 0 ? smooth(p) : smooth(p) + rest(p);
    }
};

/// What is fitted, by its form.
struct RbfForm {
    RbfPolynomial polynomial;
    bool along_axis = false; ///< constraints off the surface are along the polynomial's third axis,
                             ///< not along normals: f is a height, of which the polynomial takes
                             ///< more than of a distance
    bool smoothed = false;   ///< step (3) is smoothing by generalised cross-validation, so that
                             ///< noise of the data is left to step (4), and out of the hole
};

/// `tree`: of the data's triangles. `report` gets what happened. Errors: those of fit_rbf;
/// interrupted.
Result<Implicit> fit_hole(const RbfData& data, const TriangleTree& tree, const RbfForm& form,
                          const RbfOptions& options, RbfReport& report, const Run& run);

/// The data without those nearest to the hole, as if it were larger.
struct LeftOut {
    RbfData kept;
    std::vector<std::uint32_t> points; ///< left out: of the data
    double width = 0;                  ///< how much larger, unit of the surface
};

/// What the form that was chosen misses of the data left out.
struct RbfChoice {
    RbfForm form;
    double validated = 0; ///< root mean square; NaN where no data could be left out
    double expected = 0; ///< factor of RbfError: what is missed in units of what it says there; NaN
                         ///< where no data could be left out
};

/// The form that misses least of the data left out; one of a higher degree must be better by a
/// tenth. Errors: interrupted.
Result<RbfChoice> choose_form(const RbfData& data, const RbfOptions& options, const Run& run);

/// Up to `count` of the points for which `of` holds, each as far as can be from those before it.
std::vector<std::uint32_t> well_spread(const std::vector<Point3>& points, std::size_t count,
                                       const std::vector<bool>& of);

} // namespace terrane
