// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A hole filled by radial basis functions (rbf.hpp) and joined (join.hpp).
#pragma once

#include <terrane/algorithms/reconstruction/joining/join.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>

namespace terrane {

struct FilledByRbf {
    Filling filling; ///< as it was before it was joined
    Joined joined;
    RbfReport report;
};

/// fill_by_rbf and join_filling. Where the level does not pass along the border so that it can be
/// joined, once more with options.long_edges: it may be a cliff's. Errors: those of both; of the
/// first try where neither can be joined.
Result<FilledByRbf> fill_and_join_by_rbf(const Surface& surface, const BorderLoop& loop,
                                         const RbfOptions& options = {},
                                         const JoinOptions& join = {}, const Run& run = {});

} // namespace terrane
