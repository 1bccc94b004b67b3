// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/layers/layers.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/is_external.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/layers/detail/resolver.hpp>
#include <terrane/algorithms/layers/detail/whole_triangles.hpp>
#include <terrane/algorithms/layers/order_check.hpp>
#include <terrane/algorithms/mesh/validation.hpp>

namespace terrane {

using namespace layers::detail;

namespace {

Error bad(const char* what) {
    return {ErrorCode::bad_option, what, ""};
}

/// Lists the harder layers above and below each layer, the nearest first.
Bounds bounds_of(std::span<const Layer> order) {
    const auto harder = [&](std::size_t a, std::size_t b) {
        return order[a].hardness > order[b].hardness ||
               (order[a].hardness == order[b].hardness && a < b);
    };
    Bounds bounds;
    for (std::size_t i = 0; i < order.size(); ++i) {
        auto& above = bounds.above.emplace_back();
        auto& below = bounds.below.emplace_back();
        for (std::size_t j = i; j-- > 0;)
            if (harder(j, i)) above.push_back(j);
        for (std::size_t j = i + 1; j < order.size(); ++j)
            if (harder(j, i)) below.push_back(j);
    }
    return bounds;
}

/// Lists all copies that the layers are made of; the layers themselves come first.
std::vector<Copy> copies_needed(const Bounds& bounds, bool thick) {
    std::vector<Copy> needed;
    std::vector<Copy> open;
    for (std::size_t i = bounds.above.size(); i-- > 0;) open.push_back({i, 0});
    while (!open.empty()) {
        const Copy c = open.back();
        open.pop_back();
        if (std::find(needed.begin(), needed.end(), c) != needed.end()) continue;
        needed.push_back(c);
        for (const std::size_t above : bounds.above[c.layer]) {
            open.push_back({above, c.steps});
            if (thick) open.push_back({above, c.steps - 1});
        }
        for (const std::size_t below : bounds.below[c.layer])
            open.push_back({below, c.steps + (thick ? 1 : 0)});
    }
    return needed;
}

Surface moved_up(Surface s, double by) {
    if (by != 0)
        for (Point3& p : s.vertices) p.z += by;
    return s;
}

/// Returns more than the error of heights of copies: of the sum of a height and a multiple of the
/// thickness, and of that multiple.
double error_of_copies(std::span<const Surface> copies) {
    double highest = 0;
    for (const Surface& s : copies)
        for (const Point3& p : s.vertices) highest = std::max(highest, std::fabs(p.z));
    return 2 * (std::nextafter(highest, HUGE_VAL) - highest);
}

/// Builds vertical walls on all free borders of the layers, from below all of them to above.
Surface walls_on(std::span<const Surface> layers) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    std::vector<std::array<double, 4>> edges; // x, y, x, y; the lexicographically lower end first
    for (const Surface& s : layers) {
        for (const Point3& p : s.vertices) {
            low = std::min(low, p.z);
            high = std::max(high, p.z);
        }
        const Soup soup = merge_surfaces(std::span(&s, 1));
        soup.edges.for_each([&](std::uint32_t a, std::uint32_t b, auto sides) {
            if (sides.size() != 1) return;
            std::array<double, 2> p{soup.points[a].x, soup.points[a].y},
                q{soup.points[b].x, soup.points[b].y};
            if (q < p) std::swap(p, q);
            edges.push_back({p[0], p[1], q[0], q[1]});
        });
    }
    sort_unique(edges);
    const double room = std::max(high - low, 1.0);
    constexpr double most = std::numeric_limits<double>::max();
    const std::array<double, 2> ends{std::max(low - room, -most), std::min(high + room, most)};
    Surface walls{"vertical faces on the free borders of the layers", Role::unknown, {}, {}};
    for (const auto& e : edges) {
        const auto first = static_cast<std::uint32_t>(walls.vertices.size());
        for (const double z : ends) {
            walls.vertices.push_back({e[0], e[1], z});
            walls.vertices.push_back({e[2], e[3], z});
        }
        walls.triangles.push_back({first, first + 1, first + 3});
        walls.triangles.push_back({first, first + 3, first + 2});
    }
    return walls;
}

/// Removes the triangles that rounding has folded onto each other: those of which as many with the
/// same corners faced up as down. They would leave a fin on the layer. `upward` holds the corners of
/// each triangle in the order that was counterclockwise from above before rounding.
void remove_folds(Surface& s, const std::vector<Triangle>& upward) {
    std::map<std::array<double, 3>, std::uint32_t> first_at;
    std::vector<std::uint32_t> same(s.vertices.size());
    for (std::uint32_t v = 0; v < s.vertices.size(); ++v) {
        const Point3& p = s.vertices[v];
        same[v] = first_at.try_emplace({p.x, p.y, p.z}, v).first->second;
    }
    std::map<Triangle, std::pair<std::size_t, std::size_t>> facing; // up and down
    std::vector<Triangle> keys;
    for (const Triangle& t : upward) {
        Triangle key{same[t[0]], same[t[1]], same[t[2]]};
        std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
        const bool up = key[1] < key[2];
        if (!up) std::swap(key[1], key[2]);
        auto& [ups, downs] = facing[key];
        ++(up ? ups : downs);
        keys.push_back(key);
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
        const auto& [ups, downs] = facing.at(keys[t]);
        if (ups != downs) s.triangles[kept++] = s.triangles[t];
    }
    s.triangles.resize(kept);
}

/// Returns the point whose coordinates are the multiples of `spacing` nearest to those of p.
Point3 on_grid(const Point3& p, double spacing) {
    const auto rounded = [&](double c) { return std::nearbyint(c / spacing) * spacing; };
    return {rounded(p.x), rounded(p.y), rounded(p.z)};
}

/// The layers before they are in doubles.
struct ExactStack {
    std::span<const Surface> surfaces;
    std::span<const Layer> order;
    const Arrangement& arrangement; ///< of all copies of the layers
    const LayerResolver& resolver;  ///< has resolved all layers
    const std::vector<Set>& sets;   ///< the triangles of each layer
};

/// Builds the surface of a layer. Its new points are rounded to the nearest doubles, and then to
/// multiples of `grid` unless that is 0.
Surface surface_of(const ExactStack& exact, std::size_t layer, const WholeTriangles& whole,
                   double grid) {
    const Arrangement& a = exact.arrangement;
    const Surface& original = exact.surfaces[exact.order[layer].surface];
    Surface s{original.name, original.role, {}, {}};
    std::map<PointIndex, std::uint32_t> name;
    const auto named = [&](const std::array<PointIndex, 3>& corners) {
        const PointStore& points = a.state->points;
        Triangle t{};
        for (unsigned k = 0; k < 3; ++k) {
            const PointIndex p = corners[k];
            const auto [at, added] =
                name.try_emplace(p, static_cast<std::uint32_t>(s.vertices.size()));
            if (added)
                s.vertices.push_back(grid > 0 && !points.is_input(p)
                                         ? on_grid(points.nearest(p), grid)
                                         : points.nearest(p));
            t[k] = at->second;
        }
        return t;
    };
    std::vector<Triangle> upward;
    Set wholes;
    for (const std::uint32_t t : exact.sets[layer]) {
        const Triangle& c = a.triangles[t];
        if (const auto as = whole(t)) {
            wholes.push_back(*as);
        } else {
            s.triangles.push_back(named({a.vertices[c[0]], a.vertices[c[1]], a.vertices[c[2]]}));
            upward.push_back(named(exact.resolver.upward(t)));
        }
    }
    remove_folds(s, upward);
    sort_unique(wholes);
    for (const std::uint32_t t : wholes) s.triangles.push_back(named(a.state->corners[t]));
    return s;
}

Status validate_order(std::span<const Surface> surfaces, std::span<const Layer> order,
                      const LayerOptions& options) {
    if (const auto valid = validate(surfaces); !valid) return valid.error();
    if (order.empty()) return Error{ErrorCode::nothing_to_do, "no layers", ""};
    std::vector<std::uint32_t> named;
    for (const Layer& l : order) {
        if (l.surface >= surfaces.size()) return bad("a layer names no surface");
        if (!std::isfinite(l.hardness)) return bad("a hardness is not finite");
        named.push_back(l.surface);
    }
    sort_unique(named);
    if (named.size() != order.size()) return bad("a surface is in the order twice");
    if (!(options.min_thickness >= 0) || !std::isfinite(options.min_thickness))
        return bad("the minimum thickness is a length");
    return Done{};
}

/// Returns the distance from x to the next double above it; x >= 0.
double spacing_at(double x) {
    return std::nextafter(x, HUGE_VAL) - x;
}

/// Computes how wide the strips along steps are in which rounding may have moved the two sides of a
/// step across each other: both sides move, first to the nearest doubles, then as reported.
double width_of_steps(const RoundedMesh& rounded) {
    double largest = 0;
    for (const Point3& p : rounded.mesh->vertices)
        largest = std::max({largest, std::fabs(p.x), std::fabs(p.y)});
    return 2 * (rounded.report.max_move + spacing_at(largest));
}

/// Rounds a stack to doubles and checks their order. The new points of the layers are first moved to
/// multiples of `grid`, unless that is 0. The report of rounding includes these moves.
Result<Layered> in_doubles(const ExactStack& stack, const LayerOptions& options, double grid,
                           const Run& run) {
    const WholeTriangles whole(stack.arrangement, stack.sets);
    std::vector<Surface> stacked;
    for (std::size_t i = 0; i < stack.order.size(); ++i)
        stacked.push_back(surface_of(stack, i, whole, grid));
    const auto exact = arrange(stacked, {}, run);
    if (!exact) return exact.error();
    const double limit = options.max_move.value_or(default_max_move(*exact));
    const RoundingOptions rounding{options.max_rounds, options.check, limit - grid};
    auto rounded = round_to_doubles(*exact, rounding, run);
    if (!rounded) return rounded.error();
    // To a multiple of the grid a point moves by at most .87 of it.
    for (double* const moved : {&rounded->report.max_move, &rounded->report.surface_deviation,
                                &rounded->report.deviation})
        *moved += grid;
    rounded->report.max_allowed = limit;
    const double width = width_of_steps(*rounded);
    auto flaws = find_out_of_order(*rounded->mesh, width, run);
    if (!flaws) return flaws.error();
    return Layered{std::move(*rounded), stack.resolver.reports(), width, std::move(*flaws),
                   options.min_thickness};
}

/// Repairs a stack whose doubles in_doubles() found out of order. Where intersection curves of
/// several layers cross less than a spacing of the doubles apart, their triangles are as small, and
/// rounding inverts some of them. A grid merges the corners of such triangles. Returns nothing if no grid helps.
Result<std::optional<Layered>> on_grids(const ExactStack& stack, const LayerOptions& options,
                                        const Run& run) {
    double largest = 0;
    for (const Layer& l : stack.order)
        for (const Point3& p : stack.surfaces[l.surface].vertices)
            largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    for (const double spacings : {4.0, 32.0}) {
        const double grid = spacings * spacing_at(largest);
        if (options.max_move && grid >= *options.max_move) break;
        auto layered = in_doubles(stack, options, grid, run);
        if (!layered && is_external(layered.error().code)) return layered.error();
        if (layered && layered->is_stack()) return {std::move(*layered)};
    }
    return {std::nullopt};
}

Result<Layered> stack_valid(std::span<const Surface> surfaces, std::span<const Layer> order,
                            const LayerOptions& options, const Run& run);

/// Stacks layers again that rounding put out of order: copies of layers, moved by the minimum
/// thickness and rounded, cross each other at slightly different places than the layers do. Now
/// heights and thickness are multiples of a power of two, so that no copy is rounded. Returns
/// nothing if that does not help.
Result<std::optional<Layered>> stack_again(std::span<const Surface> surfaces,
                                           std::span<const Layer> order,
                                           const LayerOptions& options, const Run& run) {
    // Copies of each layer are moved by at most one step per other layer, in either direction.
    double highest = static_cast<double>(order.size()) * options.min_thickness;
    for (const Surface& s : surfaces)
        for (const Point3& p : s.vertices) highest = std::max(highest, std::fabs(p.z));
    constexpr int digits = std::numeric_limits<double>::digits;
    const double unit = std::ldexp(1.0, std::ilogb(highest) + 2 - digits);
    if (!(unit > 0)) return {std::nullopt}; // no doubles in between
    const auto rounded = [&](double z) { return std::nearbyint(z / unit) * unit; };
    std::vector<Surface> exact(surfaces.begin(), surfaces.end());
    bool is_changed = false;
    LayerOptions same = options;
    same.min_thickness = rounded(options.min_thickness);
    for (Surface& s : exact)
        for (Point3& p : s.vertices) {
            const double z = rounded(p.z);
            is_changed = is_changed || z != p.z;
            p.z = z;
        }
    if (!(same.min_thickness > 0) || (!is_changed && same.min_thickness == options.min_thickness))
        return {std::nullopt};
    auto again = stack_valid(exact, order, same, run);
    if (!again && is_external(again.error().code)) return again.error();
    if (!again || !again->is_stack()) return {std::nullopt};
    again->height_error += unit; // more than heights were rounded by
    return {std::move(*again)};
}

Result<Layered> stack_valid(std::span<const Surface> surfaces, std::span<const Layer> order,
                            const LayerOptions& options, const Run& run) {
    const auto progress = [&](double share) {
        if (run.progress) run.progress("layers", share);
    };
    const bool thick = options.min_thickness > 0;
    const Bounds bounds = bounds_of(order);
    const auto copies = copies_needed(bounds, thick);
    std::vector<Surface> all;
    for (const Copy& c : copies)
        all.push_back(moved_up(surfaces[order[c.layer].surface], c.steps * options.min_thickness));
    const double height_error = thick ? error_of_copies(all) : 0;
    all.push_back(walls_on(all));
    const auto arrangement = arrange(all, {}, run);
    if (!arrangement) return arrangement.error();
    progress(0.4);
    LayerResolver resolver({order, bounds, copies, thick, arrangement.value()}, run);
    if (const auto done = resolver.prepare(); !done) return done.error();
    std::vector<Set> sets;
    for (std::size_t i = 0; i < order.size(); ++i) {
        auto set = resolver.resolve({i, 0});
        if (!set) return set.error();
        sets.push_back(std::move(set).value());
        progress(0.4 + 0.3 * static_cast<double>(i + 1) / static_cast<double>(order.size()));
    }
    const ExactStack exact{surfaces, order, *arrangement, resolver, sets};
    auto layered = in_doubles(exact, options, 0, run);
    if (!layered) return layered.error();
    progress(0.9);
    Run quiet = run;
    quiet.progress = nullptr;
    if (!layered->is_stack()) {
        auto other = on_grids(exact, options, quiet);
        if (!other) return other.error();
        if (*other) layered = std::move(**other);
    }
    layered->height_error += height_error;
    if (thick && !layered->is_stack()) {
        auto other = stack_again(surfaces, order, options, quiet);
        if (!other) return other.error();
        if (*other) layered = std::move(**other);
    }
    progress(1);
    return layered;
}

} // namespace

Result<Layered> stack_layers(std::span<const Surface> surfaces, std::span<const Layer> order,
                             const LayerOptions& options, const Run& run) {
    return guarded("for the layers", "layers", [&]() -> Result<Layered> {
        if (const auto good = validate_order(surfaces, order, options); !good) return good.error();
        const StageTimer timer(run, "layers");
        return stack_valid(surfaces, order, options, timer.inside());
    });
}

Result<Layered> harden(const Surface& hard, const Surface& soft, Keep keep,
                       const LayerOptions& options, const Run& run) {
    return guarded("for the layers", "layers", [&]() -> Result<Layered> {
        const std::array<Surface, 2> both{hard, soft};
        std::array<Layer, 2> order{Layer{SurfaceId(1), 0},
                                   Layer{SurfaceId(0), 1}}; // the soft one is on top
        if (keep == Keep::lower) std::swap(order[0], order[1]);
        return stack_layers(both, order, options, run);
    });
}

} // namespace terrane
