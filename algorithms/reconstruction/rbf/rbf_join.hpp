// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Fills a hole by radial basis functions (rbf.hpp) and joins the filling (join.hpp).
#pragma once

#include <terrane/algorithms/reconstruction/joining/join.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>

namespace terrane {

/// A hole filled by radial basis functions and joined.
struct FilledByRbf {
    Filling filling;  ///< before joining
    Joined joined;    ///< the surface with the filling
    RbfReport report; ///< of the fit; of a graph, its data alone
};

/// Fills a graph over x and y, or else over the hole's own plane, by kriging, whose covariances
/// are radial basis functions; options.smoothing is then the noise of the data, 0: as is likeliest. Where the surface is no graph next to the hole, or what was made meets another part
/// of it, runs fill_by_rbf() and join_filling(). If the zero level does
/// not pass along the border, so that it can't be joined, tries again with options.long_edges, as
/// the hole may be at a cliff. Errors: those of both; those of the first attempt if neither can be
/// joined.
Result<FilledByRbf> fill_and_join_by_rbf(const Surface& surface, const BorderLoop& loop,
                                         const RbfOptions& options = {},
                                         const JoinOptions& join = {}, const Run& run = {});

} // namespace terrane
