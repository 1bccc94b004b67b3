// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The changes that only certificates of volumes of interest have.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <terrane/algorithms/verify/detail/joined_sets.hpp>

#include "forge_geometry.hpp"
#include "forge_lists.hpp"

namespace terrane::fuzz {

namespace {

/// Returns the exact triangles that are kept.
Numbers kept_triangles(const Certificate& c, const Numbers& dropped) {
    Numbers kept;
    for (std::uint32_t t = 0; t < c.exact.triangles.size(); ++t)
        if (!std::ranges::binary_search(dropped, t)) kept.push_back(t);
    return kept;
}

/// Numbers the exact vertices that kept triangles have, in order.
Numbers numbers_of_kept(const Certificate& c, const Numbers& kept, std::uint32_t& count) {
    Numbers number(c.exact.vertices.size(), UINT32_MAX);
    for (const std::uint32_t t : kept)
        for (const std::uint32_t v : c.exact.triangles[t])
            if (v < number.size()) number[v] = 0;
    count = 0;
    for (std::uint32_t& v : number)
        if (v == 0) v = count++;
    return number;
}

std::size_t boundary_triangles(const Certificate& c) {
    std::size_t count = 0;
    for (const Surface& side : c.cut->volume.boundary) count += side.triangles.size();
    return count;
}

/// Numbers the regions of the doubles anew: triangles of a surface that share an edge which is no
/// intersection edge are in one.
void number_regions(Certificate& c) {
    RoundedClaim& r = *c.rounded;
    const Numbers surface_of = surfaces_of_inputs(c);
    std::vector<Edge> slots; // triangle and surface
    std::map<std::pair<Edge, std::uint32_t>, Numbers> at_edge;
    for (std::uint32_t t = 0; t < r.triangles.size(); ++t) {
        std::set<std::uint32_t> surfaces;
        for (const std::uint32_t p : r.parents_of[t])
            if (p < surface_of.size()) surfaces.insert(surface_of[p]);
        for (const std::uint32_t s : surfaces) {
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [low, high] =
                    std::minmax(r.triangles[t][k], r.triangles[t][(k + 1) % 3]);
                if (!std::ranges::binary_search(r.intersection_edges, Edge{low, high}))
                    at_edge[{Edge{low, high}, s}].push_back(
                        static_cast<std::uint32_t>(slots.size()));
            }
            slots.push_back({t, s});
        }
    }
    verifier::JoinedSets sets(slots.size());
    for (const auto& [edge, list] : at_edge)
        for (const std::uint32_t slot : list) sets.join(list.front(), slot);
    std::map<std::uint32_t, std::uint32_t> number_of;
    std::vector<Numbers> regions(r.triangles.size());
    for (std::uint32_t slot = 0; slot < slots.size(); ++slot) {
        const auto count = static_cast<std::uint32_t>(number_of.size());
        regions[slots[slot][0]].push_back(
            number_of.try_emplace(sets.find(slot), count).first->second);
    }
    r.regions_of = packed(regions);
}

/// Keeps an exact triangle that was dropped, or drops one, or all that have its parents; the
/// doubles follow or not.
void change_dropped(Certificate& c, const Arguments& n) {
    const auto& exact = c.exact;
    if (exact.triangles.empty() || exact.parents_of.size() != exact.triangles.size()) return;
    auto& dropped = c.cut->dropped;
    const Numbers before = dropped;
    const auto chosen = static_cast<std::uint32_t>(pick(n.a, exact.triangles.size()));
    const bool was = std::ranges::count(dropped, chosen) > 0;
    const auto like = exact.parents_of[chosen];
    for (std::uint32_t t = 0; t < exact.triangles.size(); ++t) {
        if (n.b % 2 == 0 ? t != chosen : !std::ranges::equal(exact.parents_of[t], like)) continue;
        std::erase(dropped, t);
        if (!was) dropped.push_back(t);
    }
    std::sort(dropped.begin(), dropped.end());
    if (!c.rounded || n.c % 4 == 0 || !std::ranges::is_sorted(before)) return;
    follow_dropped(c, before);
    if (n.c % 4 != 1) number_regions(c);
}

/// Adds a triangle to the doubles, beyond an edge that is on the boundary of the volume, and says
/// that they have other triangles than the exact part. As a sliver it is as near to what was kept
/// as a larger stated deviation allows.
void add_outside(Certificate& c, const Arguments& n) {
    if (!c.rounded || c.rounded->triangles.size() != c.rounded->parents_of.size()) return;
    RoundedClaim& r = *c.rounded;
    const std::size_t own = surfaces_of_inputs(c).size() - boundary_triangles(c);
    const auto is_on_boundary = [&](std::size_t t) {
        const auto parents = r.parents_of[t];
        return parents.empty() || parents.back() >= own;
    };
    std::set<Edge> on_boundary;
    std::vector<std::array<std::uint32_t, 3>> ends; // of edges there, and the corner inside
    Numbers triangles;
    for (const bool boundary : {true, false})
        for (std::uint32_t t = 0; t < r.triangles.size(); ++t)
            for (std::size_t i = 0; i < 3; ++i) {
                const Triangle& at = r.triangles[t];
                const std::uint32_t a = at[i], b = at[(i + 1) % 3], inner = at[(i + 2) % 3];
                if (std::max({a, b, inner}) >= r.vertices.size()) return;
                const Edge edge{std::min(a, b), std::max(a, b)};
                if (boundary && is_on_boundary(t)) on_boundary.insert(edge);
                if (boundary || is_on_boundary(t) || !on_boundary.contains(edge)) continue;
                ends.push_back({a, b, inner});
                triangles.push_back(t);
            }
    if (ends.empty()) return;
    const std::size_t chosen = pick(n.a, ends.size());
    const Point3 a = r.vertices[ends[chosen][0]], b = r.vertices[ends[chosen][1]];
    const Point3 foot =
        along(a, b - a, dot(r.vertices[ends[chosen][2]] - a, b - a) / dot(b - a, b - a));
    const Point3 outwards = foot - r.vertices[ends[chosen][2]];
    const double size = length(b - a);
    const double gap = std::ldexp(size, -24 - static_cast<int>(n.b % 8)) / length(outwards);
    const double width = n.c % 4 == 0 ? 0.25 : gap; // far beyond, or as a sliver
    const auto first = static_cast<std::uint32_t>(r.vertices.size());
    r.vertices.push_back(along(along(a, b - a, 0.75), outwards, gap));
    r.vertices.push_back(along(along(a, b - a, 0.25), outwards, gap));
    r.vertices.push_back(along(along(a, b - a, 0.5), outwards, gap + width));
    r.triangles.push_back({first, first + 1, first + 2});
    const auto like = triangles[chosen];
    const Numbers parents(r.parents_of[like].begin(), r.parents_of[like].end());
    r.parents_of.push_back(parents);
    number_regions(c);
    r.max_move.reset();
    r.deviation = std::max(r.deviation, 16 * gap * length(outwards));
}

/// Gives a coordinate of the boundary another value wherever it is: in the description of a prism,
/// in the vertices of its sides, and in the doubles.
void move_boundary_side(Certificate& c, const Arguments& n) {
    VolumeClaim& volume = c.cut->volume;
    if (volume.boundary.empty()) return;
    const auto& vertices = volume.boundary[pick(n.a, volume.boundary.size())].vertices;
    if (vertices.empty()) return;
    const auto axis = n.b % 3;
    const auto coordinate = [axis](Point3& p) -> double& {
        return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
    };
    Point3 chosen = vertices[pick(n.a / 16, vertices.size())];
    const double from = coordinate(chosen), to = moved(from, n.c, n.d);
    const auto set = [&](double& x) {
        if (x == from) x = to;
    };
    if (axis == 2) std::ranges::for_each(volume.between, set);
    if (axis < 2)
        for (auto& corner : volume.corners) set(corner[axis]);
    for (Surface& side : volume.boundary)
        for (Point3& p : side.vertices) set(coordinate(p));
    if (c.rounded && n.d % 4 < 3)
        for (Point3& p : c.rounded->vertices) set(coordinate(p));
}

/// Turns the boundary over, and with it the triangles of both parts that have it as first parent.
void turn_boundary(Certificate& c, const Arguments& n) {
    const std::size_t own = surfaces_of_inputs(c).size() - boundary_triangles(c);
    for (Surface& side : c.cut->volume.boundary)
        for (Triangle& t : side.triangles) std::swap(t[0], t[1]);
    const auto turn = [&](std::vector<Triangle>& triangles,
                          const IndexLists<std::uint32_t>& parents_of) {
        for (std::size_t t = 0; t < triangles.size() && t < parents_of.size(); ++t)
            if (!parents_of[t].empty() && parents_of[t].front() >= own)
                std::swap(triangles[t][0], triangles[t][1]);
    };
    if (n.a % 4 != 1) turn(c.exact.triangles, c.exact.parents_of);
    if (n.a % 4 != 2 && c.rounded) turn(c.rounded->triangles, c.rounded->parents_of);
}

/// Describes the same boundary otherwise.
void change_shape(Certificate& c, const Arguments& n) {
    VolumeClaim& volume = c.cut->volume;
    static constexpr std::array shapes{"prism", "hexahedron", "surface", ""};
    volume.shape = shapes[n.a % shapes.size()];
    if (n.b % 2 == 0) {
        volume.corners.clear();
        volume.between.clear();
    }
    if (n.c % 3 == 0) volume.files = n.d % 3;
}

void change_corners(Certificate& c, const Arguments& n) {
    auto& corners = c.cut->volume.corners;
    if (corners.empty()) return;
    if (n.a % 3 == 0)
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    else if (n.a % 3 == 1)
        std::reverse(corners.begin(), corners.end());
    else
        std::reverse(c.cut->volume.between.begin(), c.cut->volume.between.end());
}

/// Moves the triangles of one side of the boundary to the end of another one: the boundary stays.
void join_sides(Certificate& c, const Arguments& n) {
    auto& sides = c.cut->volume.boundary;
    if (sides.size() < 2) return;
    const std::size_t from = sides.size() - 1, to = pick(n.a, sides.size() - 1);
    const auto first = static_cast<std::uint32_t>(sides[to].vertices.size());
    const Surface moving = sides[from];
    sides[to].vertices.insert(sides[to].vertices.end(), moving.vertices.begin(),
                              moving.vertices.end());
    for (const Triangle& t : moving.triangles)
        sides[to].triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    sides.pop_back();
}

/// Renames a number of input triangles by another one in both parts.
void exchange_parents(Certificate& c, const Arguments& n) {
    const auto rename = [&](IndexLists<std::uint32_t>& lists) {
        auto all = unpacked(lists);
        for (Numbers& list : all) {
            for (std::uint32_t& p : list)
                if (p == n.b || p == n.c) p = p == n.b ? n.c : n.b;
            std::sort(list.begin(), list.end());
        }
        lists = packed(all);
    };
    rename(c.exact.parents_of);
    if (c.rounded) rename(c.rounded->parents_of);
}

constexpr std::array<Change, 8> cut_changes{{
    {"triangles dropped or kept", change_dropped},
    {"triangle outside added to the doubles", add_outside},
    {"side of the volume moved", move_boundary_side},
    {"boundary turned over", turn_boundary},
    {"shape changed", change_shape},
    {"corners in another order", change_corners},
    {"sides joined", join_sides},
    {"parents exchanged", exchange_parents},
}};

} // namespace

Numbers surfaces_of_inputs(const Certificate& c) {
    Numbers of;
    std::uint32_t surface = 0;
    const std::size_t files =
        c.inputs.size() - std::min<std::size_t>(c.inputs.size(), c.cut->volume.files);
    for (std::size_t i = 0; i < files; ++i)
        for (const CertifiedSurface& s : c.inputs[i].surfaces) {
            of.insert(of.end(), s.triangles, surface);
            if (c.sealed && surface < c.sealed->surfaces.size()) {
                const SealedPart& part = c.sealed->surfaces[surface];
                of.insert(of.end(), part.extended.size() + part.sealed.size(), surface);
            }
            ++surface;
        }
    for (const Surface& s : c.cut->volume.boundary)
        of.insert(of.end(), s.triangles.size(), surface++);
    return of;
}

void follow_dropped(Certificate& c, const Numbers& before) {
    RoundedClaim& r = *c.rounded;
    std::uint32_t count = 0, count_now = 0;
    const Numbers kept = kept_triangles(c, before), kept_now = kept_triangles(c, c.cut->dropped);
    const Numbers number = numbers_of_kept(c, kept, count);
    const Numbers number_now = numbers_of_kept(c, kept_now, count_now);
    if (kept.size() != r.triangles.size() || kept.size() != r.parents_of.size() ||
        kept.size() != r.regions_of.size() || count != r.vertices.size())
        return;
    for (std::size_t i = kept.size(); i-- > 0;) {
        if (!std::ranges::binary_search(c.cut->dropped, kept[i])) continue;
        erase_at(r.triangles, i);
        erase_at(r.parents_of, i);
        erase_at(r.regions_of, i);
    }
    Numbers renamed(count, UINT32_MAX);
    std::vector<Point3> points(count_now);
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] == UINT32_MAX || number_now[v] == UINT32_MAX) continue;
        renamed[number[v]] = number_now[v];
        points[number_now[v]] = r.vertices[number[v]];
    }
    r.vertices = points;
    std::map<Edge, std::vector<Numbers>> parents_at;
    for (std::size_t t = 0; t < r.triangles.size(); ++t) {
        for (std::uint32_t& v : r.triangles[t]) v = v < count ? renamed[v] : v;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(r.triangles[t][k], r.triangles[t][(k + 1) % 3]);
            parents_at[{low, high}].emplace_back(r.parents_of[t].begin(), r.parents_of[t].end());
        }
    }
    for (Edge& e : r.intersection_edges)
        for (std::uint32_t& v : e) v = v < count ? renamed[v] : v;
    std::erase_if(r.intersection_edges, [&](const Edge& e) {
        const auto at = parents_at.find(e);
        return at == parents_at.end() || at->second.size() < 2 ||
               (at->second.size() == 2 && at->second[0] == at->second[1]);
    });
}

void renumber_regions(Certificate& c) {
    number_regions(c);
}

std::span<const Change> changes_of_cuts() {
    return cut_changes;
}

} // namespace terrane::fuzz
