// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/rbf_join.hpp>

#include <utility>

namespace terrane {
namespace {

Result<FilledByRbf> try_once(const Surface& surface, const BorderLoop& loop,
                             const RbfOptions& options, const JoinOptions& join, const Run& run) {
    RbfReport report;
    auto filling = fill_by_rbf(surface, loop, options, report, run);
    if (!filling) return filling.error();
    auto joined = join_filling(surface, loop, filling.value().surface, join, run);
    if (!joined) return joined.error();
    return FilledByRbf{std::move(filling).value(), std::move(joined).value(), report};
}

bool may_be_joined_otherwise(const Error& error) {
    return error.code == ErrorCode::not_closed || error.code == ErrorCode::improper_contact;
}

} // namespace

Result<FilledByRbf> fill_and_join_by_rbf(const Surface& surface, const BorderLoop& loop,
                                         const RbfOptions& options, const JoinOptions& join,
                                         const Run& run) {
    auto filled = try_once(surface, loop, options, join, run);
    if (filled || options.long_edges || !may_be_joined_otherwise(filled.error())) return filled;
    RbfOptions again = options;
    again.long_edges = true;
    auto second = try_once(surface, loop, again, join, run);
    if (second || second.error().code == ErrorCode::interrupted) return second;
    return filled;
}

} // namespace terrane
