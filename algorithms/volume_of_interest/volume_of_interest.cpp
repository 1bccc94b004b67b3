// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

#include <algorithm>
#include <functional>
#include <map>
#include <tuple>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/arrangement/restricted.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {
namespace {

Error interrupted() {
    return {ErrorCode::interrupted, "stopped on request", ""};
}

bool has_any(std::span<const std::uint32_t> list, std::span<const std::uint32_t> sorted) {
    return std::any_of(list.begin(), list.end(), [&](std::uint32_t s) {
        return std::binary_search(sorted.begin(), sorted.end(), s);
    });
}

std::vector<bool> triangles_in(const Arrangement& a, std::span<const std::uint32_t> boundary) {
    std::vector<bool> in(a.triangles.size());
    for (std::size_t t = 0; t < in.size(); ++t) in[t] = has_any(a.surfaces_of[t], boundary);
    return in;
}

/// The parts of space that the boundary separates, and the parity of the number of crossings on a
/// path from the outside.
class Parts {
public:
    Parts(const Volumes& volumes, const std::vector<bool>& in_boundary) :
        volumes_(volumes), in_boundary_(in_boundary), parts_(volumes.measures.size()),
        parity_(volumes.measures.size(), unknown) {
        for (std::size_t t = 0; t < in_boundary.size(); ++t)
            if (!in_boundary[t]) parts_.join(volumes.of_sides[t][0], volumes.of_sides[t][1]);
    }

    /// Counts crossings. Returns false if some closed path crosses the boundary an odd number of
    /// times, so that it is open.
    bool count_crossings() {
        std::vector<std::vector<std::uint32_t>> beyond(parity_.size());
        for (std::size_t t = 0; t < in_boundary_.size(); ++t) {
            if (!in_boundary_[t]) continue;
            const auto [front, back] = volumes_.of_sides[t];
            const std::uint32_t p = parts_.find(front), q = parts_.find(back);
            beyond[p].push_back(q);
            beyond[q].push_back(p);
        }
        std::vector<std::uint32_t> reached{parts_.find(0)};
        parity_[reached[0]] = 0;
        for (std::size_t i = 0; i < reached.size(); ++i)
            for (const std::uint32_t q : beyond[reached[i]]) {
                const auto there = static_cast<std::uint8_t>(1 - parity_[reached[i]]);
                if (parity_[q] == unknown) {
                    parity_[q] = there;
                    reached.push_back(q);
                }
                if (parity_[q] != there) return false;
            }
        return true;
    }

    [[nodiscard]] bool is_inside(std::uint32_t volume) { return parity_[parts_.find(volume)] == 1; }

private:
    static constexpr std::uint8_t unknown = 2;

    const Volumes& volumes_;
    const std::vector<bool>& in_boundary_;
    DisjointSets parts_;               ///< of volumes
    std::vector<std::uint8_t> parity_; ///< per part
};

/// Repeats earlier restrictions, then the cut.
std::function<Result<Arrangement>(Arrangement, const Run&)>
again(std::function<Result<Arrangement>(Arrangement, const Run&)> before,
      std::vector<std::uint32_t> boundary) {
    return [before = std::move(before),
            boundary = std::move(boundary)](Arrangement a, const Run& run) -> Result<Arrangement> {
        if (before) {
            auto done = before(std::move(a), run);
            if (!done) return done.error();
            a = std::move(done).value();
        }
        auto cut = cut_to_volume(std::move(a), boundary, run);
        if (!cut) return cut.error();
        return std::move(cut.value().arrangement);
    };
}

/// Returns the coordinates of the boundary's triangles across each axis.
std::array<std::vector<double>, 3> planes_of(const Arrangement& a,
                                             std::span<const std::uint32_t> boundary) {
    std::array<std::vector<double>, 3> planes;
    for (const std::uint32_t s : boundary)
        for (std::uint32_t t = a.inputs.first[s]; t < a.inputs.first[s + 1]; ++t) {
            const Triangle& c = a.state->corners[t];
            const Point3 &p = a.state->points.input(c[0]), &q = a.state->points.input(c[1]),
                         &r = a.state->points.input(c[2]);
            if (p.x == q.x && q.x == r.x) planes[0].push_back(p.x);
            if (p.y == q.y && q.y == r.y) planes[1].push_back(p.y);
            if (p.z == q.z && q.z == r.z) planes[2].push_back(p.z);
        }
    for (auto& coordinates : planes) sort_unique(coordinates);
    return planes;
}

// ---- Report

double area_of(std::span<const Point3> places, const Triangle& t) {
    return area_between(places[t[0]], places[t[1]], places[t[2]]);
}

std::vector<Point3> places_of(const Arrangement& a) {
    std::vector<Point3> places;
    places.reserve(a.vertices.size());
    for (const PointIndex v : a.vertices) places.push_back(a.state->points.nearest(v));
    return places;
}

std::vector<SurfaceCut> areas(const Arrangement& a, std::span<const Where> where) {
    const auto places = places_of(a);
    std::vector<SurfaceCut> cuts(a.surfaces.size());
    for (std::size_t t = 0; t < a.triangles.size(); ++t) {
        const double area = area_of(places, a.triangles[t]);
        for (const std::uint32_t s : a.surfaces_of[t]) {
            SurfaceCut& c = cuts[s];
            (where[t] == Where::inside    ? c.area_inside
             : where[t] == Where::outside ? c.area_outside
                                          : c.area_on_boundary) += area;
        }
    }
    return cuts;
}

/// Calls join(surface, triangle, triangle) for the triangles of one surface that an edge connects.
template <class Join>
void for_joined(const Arrangement& a, const Join& join) {
    for (const auto& inner : a.state->adjacency.inner)
        for (const auto& [t, u] : inner) join(a.surfaces_of[t][0], t, u);
    std::map<std::uint32_t, std::uint32_t> first; // of a surface, at this edge
    for (std::size_t e = 0; e < a.state->adjacency.edges.size(); ++e) {
        first.clear();
        for (const std::uint32_t t : a.state->adjacency.triangles_at[e])
            for (const std::uint32_t s : a.surfaces_of[t])
                if (const auto [at, fresh] = first.emplace(s, t); !fresh) join(s, at->second, t);
    }
}

/// Counts the connected pieces of each surface.
void count_pieces(const Arrangement& a, std::vector<SurfaceCut>& cuts) {
    const auto& offsets = a.surfaces_of.offsets;
    DisjointSets pieces(a.surfaces_of.values.size()); // one element per triangle and surface of it
    const auto element = [&](std::uint32_t s, std::uint32_t t) {
        const auto of = a.surfaces_of[t];
        return offsets[t] +
               static_cast<std::uint32_t>(std::lower_bound(of.begin(), of.end(), s) - of.begin());
    };
    for_joined(a, [&](std::uint32_t s, std::uint32_t t, std::uint32_t u) {
        pieces.join(element(s, t), element(s, u));
    });
    for (std::uint32_t i = 0; i < a.surfaces_of.values.size(); ++i)
        if (pieces.find(i) == i) ++cuts[a.surfaces_of.values[i]].pieces;
}

} // namespace

std::vector<OpenBorder> open_borders(const Arrangement& a, std::span<const std::uint32_t> but) {
    const StandardArithmetic guard;
    const auto places = places_of(a);
    std::map<std::uint32_t, std::vector<Edge>> edges; // by surface
    for (std::size_t e = 0; e < a.state->adjacency.edges.size(); ++e) {
        const auto at = a.state->adjacency.triangles_at[e];
        if (at.size() != 1 || has_any(a.surfaces_of[at[0]], but)) continue;
        for (const std::uint32_t s : a.surfaces_of[at[0]])
            edges[s].push_back(a.state->adjacency.edges[e]);
    }
    std::vector<OpenBorder> borders;
    for (const auto& [surface, open] : edges) {
        DisjointSets sets(open.size());
        std::map<std::uint32_t, std::uint32_t> at_vertex;
        for (std::uint32_t i = 0; i < open.size(); ++i)
            for (const std::uint32_t v : open[i])
                if (const auto [it, fresh] = at_vertex.emplace(v, i); !fresh)
                    sets.join(it->second, i);
        std::map<std::uint32_t, OpenBorder> by_set;
        for (std::uint32_t i = 0; i < open.size(); ++i) {
            const Point3 &p = places[open[i][0]], &q = places[open[i][1]];
            const auto [it, fresh] =
                by_set.emplace(sets.find(i), OpenBorder{SurfaceId(surface), 0, std::min(p, q)});
            it->second.length += distance_between(q, p);
            it->second.place = std::min({it->second.place, p, q});
        }
        for (const auto& [set, border] : by_set) borders.push_back(border);
    }
    std::sort(borders.begin(), borders.end(), [](const OpenBorder& b, const OpenBorder& c) {
        return std::tie(b.surface, b.place, b.length) < std::tie(c.surface, c.place, c.length);
    });
    return borders;
}

Result<std::vector<Where>> locate(const Arrangement& a, std::span<const std::uint32_t> boundary,
                                  const Run& run) {
    return guarded(
        "for the volume of interest", "volume of interest", [&]() -> Result<std::vector<Where>> {
            const auto in_boundary = triangles_in(a, boundary);
            const auto volumes = find_volumes(a, run);
            if (!volumes) return volumes.error();
            Parts parts(volumes.value(), in_boundary);
            if (!parts.count_crossings())
                return Error{ErrorCode::not_closed, "the boundary of the volume is not closed",
                             "boundary"};
            std::vector<Where> where(a.triangles.size(), Where::boundary);
            for (std::size_t t = 0; t < where.size(); ++t)
                if (!in_boundary[t])
                    where[t] = parts.is_inside(volumes.value().of_sides[t][0]) ? Where::inside
                                                                               : Where::outside;
            return where;
        });
}

namespace {

Result<VolumeOfInterest> cut(Arrangement a, std::span<const std::uint32_t> boundary,
                             const Run& run) {
    const auto where = locate(a, boundary, run);
    if (!where) return where.error();
    if (run.progress) run.progress("volume of interest", 0);
    if (run.stop.stop_requested()) return interrupted();
    VolumeOfInterest result;
    result.report.surfaces = areas(a, where.value());
    std::vector<bool> keep(a.triangles.size());
    for (std::size_t t = 0; t < keep.size(); ++t) keep[t] = where.value()[t] != Where::outside;
    auto before = a.state->restrict_again;
    result.arrangement = restricted(std::move(a), keep);
    ExactState& state = own_state(result.arrangement);
    state.kept_planes = planes_of(result.arrangement, boundary);
    if (!state.whole) {
        state.measures = before && state.measures;
        state.restrict_again = again(std::move(before), {boundary.begin(), boundary.end()});
    }
    count_pieces(result.arrangement, result.report.surfaces);
    result.report.borders = open_borders(result.arrangement, boundary);
    for (const OpenBorder& b : result.report.borders) {
        result.report.surfaces[b.surface].open_length += b.length;
        ++result.report.surfaces[b.surface].open_borders;
    }
    if (run.stop.stop_requested()) return interrupted();
    if (run.progress) run.progress("volume of interest", 1);
    return result;
}

} // namespace

Result<VolumeOfInterest> cut_to_volume(Arrangement a, std::span<const std::uint32_t> boundary,
                                       const Run& run) {
    const StageTimer timer(run, "volume of interest");
    return guarded("for the volume of interest", "volume of interest",
                   [&] { return cut(std::move(a), boundary, timer.inside()); });
}

} // namespace terrane
