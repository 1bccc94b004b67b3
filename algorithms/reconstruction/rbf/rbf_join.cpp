// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/rbf_join.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/is_external.hpp>
#include <terrane/algorithms/reconstruction/kriging/fill_kriging.hpp>

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

/// Fills a graph exactly up to its border. None if that is impossible: the level may do better.
std::optional<Result<FilledByRbf>> try_graph(const Surface& surface, const BorderLoop& loop,
                                             const RbfOptions& options, const Run& run) {
    FilledByRbf made;
    auto filling = fill_graph_by_rbf(surface, loop, options, made.report, run);
    if (!filling && is_external(filling.error().code)) return filling.error();
    if (!filling) return std::nullopt;
    made.filling = std::move(*filling);
    made.joined.surface = joined(surface, made.filling);
    const auto checked = check(std::span(&made.joined.surface, 1), run);
    if (!checked) return checked.error();
    for (const ImproperContact& c : checked->contacts)
        if (std::max(c.triangles[0], c.triangles[1]) >= surface.triangles.size())
            return std::nullopt;
    const auto all = static_cast<std::uint32_t>(made.filling.surface.vertices.size());
    for (auto v = all - static_cast<std::uint32_t>(made.filling.report.interpolated); v < all; ++v)
        made.joined.filling_vertices.push_back(v);
    JoinReport& report = made.joined.report;
    report.inside_triangles = report.new_triangles = made.filling.surface.triangles.size();
    report.new_vertices = made.filling.report.interpolated;
    report.area = made.filling.report.area;
    return made;
}

bool may_be_joined_otherwise(const Error& error) {
    return error.code == ErrorCode::not_closed || error.code == ErrorCode::improper_contact;
}

} // namespace

Result<FilledByRbf> fill_and_join_by_rbf(const Surface& surface, const BorderLoop& loop,
                                         const RbfOptions& options, const JoinOptions& join,
                                         const Run& run) {
    return guarded("for the filling", "fill", [&]() -> Result<FilledByRbf> {
        if (!options.long_edges)
            if (auto graph = try_graph(surface, loop, options, run)) return std::move(*graph);
        auto filled = try_once(surface, loop, options, join, run);
        if (filled || options.long_edges || !may_be_joined_otherwise(filled.error())) return filled;
        RbfOptions again = options;
        again.long_edges = true;
        auto second = try_once(surface, loop, again, join, run);
        if (second || is_external(second.error().code)) return second;
        return filled;
    });
}

} // namespace terrane
