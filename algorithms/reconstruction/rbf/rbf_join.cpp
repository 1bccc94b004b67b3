// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/rbf_join.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/is_external.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/kriging/fill_kriging.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/data.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/fit.hpp>

namespace terrane {
namespace {

Result<FilledByRbf> try_once(const Surface& surface, const BorderLoop& loop,
                             const RbfOptions& options, const JoinOptions& join, const Run& run) {
    RbfReport report;
    auto filling = fill_by_rbf(surface, loop, options, run, &report);
    if (!filling) return filling.error();
    auto joined = join_filling(surface, loop, filling.value().surface, join, run);
    if (!joined) return joined.error();
    return FilledByRbf{std::move(filling).value(), std::move(joined).value(), report};
}

using Axes = std::array<Point3, 3>;

Point3 along_axes(const Point3& p, const Axes& axes) {
    return {dot(p, axes[0]), dot(p, axes[1]), dot(p, axes[2])};
}

/// Fills a graph over the plane of the first two axes. Border vertices keep their coordinates.
Result<Filling> fill_turned(const Surface& surface, const BorderLoop& loop,
                            const KrigingOptions& options, const Axes& axes, const Run& run) {
    Surface turned = surface;
    for (Point3& p : turned.vertices) p = along_axes(p, axes);
    auto filling = fill_by_kriging(turned, loop, options, run);
    if (!filling) return filling;
    std::map<Point3, Point3> given; // of the borders
    const auto keep = [&](const BorderLoop& border) {
        for (const auto v : border.vertices) given.emplace(turned.vertices[v], surface.vertices[v]);
    };
    keep(loop);
    for (const BorderLoop& other : options.loops) keep(other);
    const Axes back{{{axes[0].x, axes[1].x, axes[2].x},
                     {axes[0].y, axes[1].y, axes[2].y},
                     {axes[0].z, axes[1].z, axes[2].z}}};
    for (Point3& p : filling->surface.vertices) {
        const auto found = given.find(p);
        p = found != given.end() ? found->second : along_axes(p, back);
    }
    return filling;
}

/// Tells whether an edge is steeper than 87 degrees: heights do not tell where a cliff goes.
bool has_cliff(const rbf::detail::RbfData& data, const Point3& up) {
    constexpr double steepest = 20;
    for (const Triangle& t : data.triangles)
        for (unsigned i = 0; i < 3; ++i) {
            const Point3 d = minus(data.points[t[(i + 1) % 3]], data.points[t[i]]);
            const double rise = dot(d, up), square = dot(d, d) - rise * rise;
            if (rise * rise > steepest * steepest * square) return true;
        }
    return false;
}

/// Fills a graph over x and y, or else over the hole's own plane.
Result<Filling> fill_graph(const Surface& surface, const BorderLoop& loop,
                           const RbfOptions& options, const Run& run) {
    const auto data = rbf::detail::collect_data(surface, loop, options.loops,
                                                {options.reach, options.rings, false});
    if (!data) return data.error();
    KrigingOptions kriging{.mesh_size = options.size, .loops = options.loops};
    if (options.smoothing.value_or(0) > 0) kriging.noise = options.smoothing;
    const auto own = rbf::detail::axes_of(*data);
    const Point3 up{0, 0, own[2].z < 0 ? -1.0 : 1.0};
    const auto is_graph = [&](const Point3& axis) {
        return rbf::detail::is_graph_along(*data, axis) && !has_cliff(*data, axis);
    };
    if (is_graph(up)) return fill_by_kriging(surface, loop, kriging, run);
    if (is_graph(own[2])) return fill_turned(surface, loop, kriging, own, run);
    return Error{ErrorCode::unsupported, "the surface is no graph next to the hole", ""};
}

/// Fills a graph exactly up to its border. None if that is impossible: the level may do better.
std::optional<Result<FilledByRbf>> try_graph(const Surface& surface, const BorderLoop& loop,
                                             const RbfOptions& options, const Run& run) {
    FilledByRbf made;
    auto filling = fill_graph(surface, loop, options, run);
    if (!filling && is_external(filling.error().code)) return filling.error();
    if (!filling) return std::nullopt;
    made.report.data = filling->report.data;
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
        if (const auto good = validate_options(options); !good) return good.error();
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
