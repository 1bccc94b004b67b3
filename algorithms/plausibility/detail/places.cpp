// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cmath>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/plausibility/detail/examination.hpp>
#include <terrane/algorithms/plausibility/detail/left_extents.hpp>
#include <terrane/algorithms/plausibility/detail/thresholds.hpp>

namespace terrane::plausibility::detail {
namespace {

/// Returns groups of surfaces: two are in one if boxes lead from one to the other without a far
/// gap. The first group is the one of most surfaces; of equal ones, the one of the first surface.
std::vector<std::vector<std::uint32_t>> groups_of(const Examination& e) {
    LeftExtents left(e.extents, e.used);
    std::vector<std::vector<std::uint32_t>> groups;
    for (const auto s : e.used) {
        if (!left.holds(s)) continue;
        auto& group = groups.emplace_back();
        left.take_near(e.extents[s], thresholds.far_apart, group); // s among them
        for (std::size_t i = 0; i < group.size(); ++i)
            left.take_near(e.extents[group[i]], thresholds.far_apart, group);
        std::ranges::sort(group);
    }
    std::ranges::stable_sort(groups, std::ranges::greater{}, &std::vector<std::uint32_t>::size);
    return groups;
}

Extent extent_of(const Examination& e, const std::vector<std::uint32_t>& surfaces) {
    Extent all;
    for (const auto s : surfaces) all.add(e.extents[s]);
    return all;
}

Extent with_exchanged_axes(Extent extent) {
    std::swap(extent.low[0], extent.low[1]);
    std::swap(extent.high[0], extent.high[1]);
    return extent;
}

/// Areas of a surface in space and from above.
struct Areas {
    double in_space = 0;
    double from_above = 0;
};

Areas areas_of(const Surface& surface) {
    Areas areas;
    for (const Triangle& t : surface.triangles) {
        const Point3 &a = surface.vertices[t[0]], &b = surface.vertices[t[1]],
                     &c = surface.vertices[t[2]];
        const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
        const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
        const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
        areas.in_space += std::hypot(nx, ny, nz) / 2;
        areas.from_above += std::abs(nz) / 2;
    }
    return areas;
}

/// Tells whether a surface encloses something alone: each edge has an even number of triangles.
bool is_closed(const Surface& surface) {
    std::unordered_map<std::uint64_t, std::uint32_t> edges;
    for (const Triangle& t : surface.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
            ++edges[(std::uint64_t(low) << 32) | high];
        }
    return std::ranges::all_of(edges, [](const auto& edge) { return edge.second % 2 == 0; });
}

/// The surfaces that could close a model at its top or base.
struct Layers {
    double all = 0;             ///< their footprints together
    double largest = 0;         ///< footprint
    std::uint32_t surface = 0;  ///< of the largest
    bool closed_volume = false; ///< whether a surface is closed alone
};

Layers layers_of(const Examination& e) {
    Layers layers;
    for (const auto s : e.used) {
        if (is_closed(e.surfaces[s])) layers.closed_volume = true;
        const Areas areas = areas_of(e.surfaces[s]);
        if (areas.from_above < thresholds.layer_footprint * areas.in_space) continue;
        layers.all += areas.from_above;
        if (areas.from_above > layers.largest) {
            layers.largest = areas.from_above;
            layers.surface = s;
        }
    }
    return layers;
}

constexpr auto open_why = "A block is found only where surfaces close it on all sides";
constexpr auto open_answer = "Add the missing surface, or a volume of interest (--box, --polygon, "
                             "--within), whose boundary closes the model";

} // namespace

void check_distances(Examination& e) {
    const auto groups = groups_of(e);
    if (groups.size() < 2) return;
    const Extent model = extent_of(e, groups.front());
    for (std::size_t g = 1; g < groups.size(); ++g) {
        const Extent extent = extent_of(e, groups[g]);
        if (in_degrees(extent) != in_degrees(model)) continue; // check_systems() says so
        const double gap = gap_from_above(model, extent);
        const bool exchanged = gap_from_above(model, with_exchanged_axes(extent)) == 0;
        e.warn(Doubt::far_apart, groups[g],
               fmt::format("{} is {} away from {}, {} times the size of the larger",
                           e.names(groups[g]), figure(gap, 4), e.names(groups.front()),
                           figure(gap / std::max(model.diagonal(), extent.diagonal()), 3)),
               exchanged ? "It would lie among the others if its x and y were exchanged"
                         : "Surfaces that far away from the others meet none of them",
               "Compare the coordinate systems and units of the files, or leave the file out");
    }
}

void check_volume(Examination& e) {
    if (e.context.boundary.empty() || e.used.empty()) return;
    Extent volume;
    for (const Surface& s : e.context.boundary) volume.add(detail::extent_of(s));
    const Extent data = extent_of(e, e.used);
    const auto outside = [&](std::uint32_t s) { return gap_between(volume, e.extents[s]) > 0; };
    if (!std::ranges::all_of(e.used, outside)) return;
    const auto span = [](const Extent& extent, std::size_t axis) {
        return fmt::format("{} to {}", figure(extent.low[axis]), figure(extent.high[axis]));
    };
    e.warn(Doubt::volume_without_data, {},
           fmt::format(
               "the volume of interest holds no surface: it spans x {}, y {}, z {}; the surfaces "
               "span x {}, y {}, z {}",
               span(volume, 0), span(volume, 1), span(volume, 2), span(data, 0), span(data, 1),
               span(data, 2)),
           "All surfaces are cut away, and one empty block is left",
           "Give the box or polygon in the coordinates of the files; depths are negative z");
}

void check_top_and_base(Examination& e) {
    if (!e.context.blocks || !e.context.boundary.empty() || e.used.empty()) return;
    const Layers layers = layers_of(e);
    if (layers.closed_volume) return;
    const Extent model = extent_of(e, e.used);
    if (layers.largest < thresholds.spanning_footprint * model.size(0) * model.size(1)) {
        e.warn(Doubt::no_top, {},
               "no surface spans the model from above, neither at its top nor at its base",
               open_why, open_answer);
        return;
    }
    if (layers.all >= thresholds.two_layers * layers.largest) return;
    double others = 0;
    for (const auto s : e.used)
        others += e.extents[s].middle(2) / static_cast<double>(e.used.size());
    const bool base_is_there = e.extents[layers.surface].middle(2) <= others;
    e.warn(base_is_there ? Doubt::no_top : Doubt::no_base, {layers.surface},
           fmt::format("{} spans the model, and no other surface does: the model is open at its {}",
                       e.names({layers.surface}), base_is_there ? "top" : "base"),
           open_why, open_answer);
}

} // namespace terrane::plausibility::detail
