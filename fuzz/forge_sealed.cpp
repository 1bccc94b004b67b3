// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The changes that only certificates of sealed surfaces have.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "forge_geometry.hpp"
#include "forge_lists.hpp"

namespace terrane::fuzz {

namespace {

using Added = std::vector<std::array<Point3, 3>>;

constexpr double wide_limit = 0.125;   ///< accepted with each model, and wider than its gaps
constexpr double widest_limit = 0.328; ///< accepted with most models: a triangle can be missing

/// The input triangles, and the input vertices, of a surface: given, then extended, then sealed.
struct OwnInputs {
    std::uint32_t extended = 0, sealed = 0, end = 0; ///< triangles
    std::uint32_t first_vertex = 0;                  ///< of the extended ones
};

/// Returns the numbers of each surface; none where there is not one part for each.
std::vector<OwnInputs> own_inputs(const Certificate& c) {
    std::vector<OwnInputs> own;
    std::uint32_t triangles = 0, vertices = 0;
    for (const CertifiedInput& input : c.inputs)
        for (const CertifiedSurface& s : input.surfaces) {
            if (own.size() == c.sealed->surfaces.size()) return own;
            const SealedPart& part = c.sealed->surfaces[own.size()];
            const auto extended = static_cast<std::uint32_t>(part.extended.size());
            const auto sealed = static_cast<std::uint32_t>(part.sealed.size());
            OwnInputs& numbers = own.emplace_back();
            numbers.extended = triangles + s.triangles;
            numbers.sealed = numbers.extended + extended;
            triangles = numbers.end = numbers.sealed + sealed;
            numbers.first_vertex = vertices + s.vertices;
            vertices = numbers.first_vertex + 3 * (extended + sealed);
        }
    return own.size() == c.sealed->surfaces.size() ? own : std::vector<OwnInputs>();
}

/// A triangle that was added.
struct Chosen {
    std::size_t surface = 0;
    std::uint32_t input = 0;  ///< the input triangle
    std::uint32_t vertex = 0; ///< its first vertex
    std::array<Point3, 3>* corners = nullptr;
};

std::optional<Chosen> choose(Certificate& c, unsigned number) {
    std::vector<Chosen> all;
    const auto own = own_inputs(c);
    for (std::size_t s = 0; s < own.size(); ++s) {
        SealedPart& part = c.sealed->surfaces[s];
        for (auto* list : {&part.extended, &part.sealed})
            for (auto& corners : *list) {
                const auto k = static_cast<std::uint32_t>(&corners - list->data()) +
                               (list == &part.sealed ? own[s].sealed - own[s].extended : 0U);
                all.push_back({s, own[s].extended + k, own[s].first_vertex + 3 * k, &corners});
            }
    }
    if (all.empty()) return std::nullopt;
    return all[pick(number, all.size())];
}

template <class Rename>
void rename_all(IndexLists<std::uint32_t>& lists, const Rename& rename) {
    for (std::uint32_t& p : lists.values) p = rename(p);
    auto all = unpacked(lists);
    for (Numbers& list : all) std::sort(list.begin(), list.end());
    lists = packed(all);
}

/// Renames input triangles wherever they are.
template <class Rename>
void rename_inputs(Certificate& c, const Rename& rename) {
    rename_all(c.exact.parents_of, rename);
    for (std::uint32_t& t : c.exact.degenerate) t = rename(t);
    for (auto& pair : c.exact.duplicates) pair = {rename(pair[0]), rename(pair[1])};
    if (!c.rounded) return;
    rename_all(c.rounded->parents_of, rename);
    for (std::uint32_t& t : c.rounded->vanished) t = rename(t);
}

/// Renames input vertices in the constructions of the exact part.
template <class Rename>
void rename_input_vertices(Certificate& c, const Rename& rename) {
    for (Construction& how : c.exact.vertices)
        for (std::uint32_t& v : how.v) v = rename(v);
}

/// Removes the triangles that name an input triangle, and no other one, from a part.
void drop_children(std::vector<Triangle>& triangles, IndexLists<std::uint32_t>& parents_of,
                   IndexLists<std::uint32_t>* regions_of, std::uint32_t input) {
    for (std::size_t t = std::min(triangles.size(), parents_of.size()); t-- > 0;) {
        if (parents_of[t].size() != 1 || parents_of[t].front() != input) continue;
        erase_at(triangles, t);
        erase_at(parents_of, t);
        if (regions_of != nullptr && t < regions_of->size()) erase_at(*regions_of, t);
    }
}

/// Takes an added triangle out of the claims and of both parts, or of some of them.
void remove_added(Certificate& c, const Arguments& n) {
    const auto chosen = choose(c, n.a);
    if (!chosen) return;
    const std::uint32_t input = chosen->input, vertex = chosen->vertex;
    if (c.rounded && n.b % 2 == 0)
        drop_children(c.rounded->triangles, c.rounded->parents_of, &c.rounded->regions_of, input);
    if (n.b % 4 < 2) {
        Numbers dropped;
        for (std::size_t t = 0, kept = 0; t < c.exact.parents_of.size(); ++t) {
            if (c.exact.parents_of[t].size() == 1 && c.exact.parents_of[t].front() == input)
                continue;
            if (std::ranges::binary_search(c.cut->dropped, t))
                dropped.push_back(static_cast<std::uint32_t>(kept));
            ++kept;
        }
        drop_children(c.exact.triangles, c.exact.parents_of, nullptr, input);
        c.cut->dropped = dropped;
    }
    SealedPart& part = c.sealed->surfaces[chosen->surface];
    for (auto* list : {&part.extended, &part.sealed})
        for (std::size_t i = 0; i < list->size(); ++i)
            if (chosen->corners == &(*list)[i]) {
                erase_at(*list, i);
                rename_inputs(c, [&](std::uint32_t p) { return p > input ? p - 1 : p; });
                rename_input_vertices(c,
                                      [&](std::uint32_t v) { return v > vertex + 2 ? v - 3 : v; });
                return;
            }
}

/// Adds a triangle to the claims, far away or next to another one; the exact part has it as a
/// triangle of its own, which is kept or dropped, and where it is kept the doubles have it too.
void add_added(Certificate& c, const Arguments& n) {
    const auto own = own_inputs(c);
    if (own.empty()) return;
    const std::size_t s = pick(n.a, own.size());
    const double x = n.b % 4 == 0 ? 1e6 : 3 + n.b % 4, size = n.c % 2 == 0 ? 1 : 1e-6;
    const std::array<Point3, 3> corners{Point3{x, 0, 9}, Point3{x + size, 0, 9},
                                        Point3{x, size, 9 + size}};
    const std::uint32_t input = own[s].end;
    const std::uint32_t vertex = own[s].first_vertex + 3 * (own[s].end - own[s].extended);
    c.sealed->surfaces[s].sealed.push_back(corners);
    rename_inputs(c, [&](std::uint32_t p) { return p >= input ? p + 1 : p; });
    rename_input_vertices(c, [&](std::uint32_t v) { return v >= vertex ? v + 3 : v; });
    if (n.d % 4 == 0) return;
    const auto first = static_cast<std::uint32_t>(c.exact.vertices.size());
    for (std::uint32_t k = 0; k < 3; ++k)
        c.exact.vertices.push_back({Construction::Kind::input, Axis::x, {vertex + k}});
    if (n.d % 4 == 1)
        c.cut->dropped.push_back(static_cast<std::uint32_t>(c.exact.triangles.size()));
    c.exact.triangles.push_back({first, first + 1, first + 2});
    c.exact.parents_of.push_back(std::array{input});
    if (n.d % 4 == 1 || !c.rounded) return;
    RoundedClaim& r = *c.rounded;
    const auto v = static_cast<std::uint32_t>(r.vertices.size());
    r.vertices.insert(r.vertices.end(), corners.begin(), corners.end());
    r.triangles.push_back({v, v + 1, v + 2});
    r.parents_of.push_back(std::array{input});
    std::uint32_t region = 0;
    for (const std::uint32_t known : r.regions_of.values) region = std::max(region, known + 1);
    r.regions_of.push_back(std::array{region});
}

/// Moves a corner of added triangles wherever it is, in the doubles, too.
void move_corner(Certificate& c, const Arguments& n) {
    const auto chosen = choose(c, n.a);
    if (!chosen) return;
    const Point3 from = (*chosen->corners)[n.b % 3];
    Point3 to = from;
    double& x = n.b / 3 % 3 == 0 ? to.x : n.b / 3 % 3 == 1 ? to.y : to.z;
    x = n.d % 2 == 0 ? moved(x, n.c, n.d / 2) : x + (n.c - 128.0) / 64;
    const auto move = [&](Point3& p) {
        if (p == from) p = to;
    };
    for (SealedPart& part : c.sealed->surfaces)
        for (auto* list : {&part.extended, &part.sealed})
            for (auto& corners : *list) std::ranges::for_each(corners, move);
    if (c.rounded && n.d % 4 < 2) std::ranges::for_each(c.rounded->vertices, move);
}

/// Says that the first sealing triangle extends, or the last extended one seals.
void rename_purpose(Certificate& c, const Arguments& n) {
    if (c.sealed->surfaces.empty()) return;
    SealedPart& part = c.sealed->surfaces[pick(n.a, c.sealed->surfaces.size())];
    const auto move = [](Added& from, Added& to, bool front) {
        if (from.empty()) return;
        const auto at = front ? from.begin() : from.end() - 1;
        to.insert(front ? to.end() : to.begin(), *at);
        from.erase(at);
    };
    for (unsigned k = 0; k <= n.c % 8; ++k)
        if (n.b % 2 == 0)
            move(part.sealed, part.extended, true);
        else
            move(part.extended, part.sealed, false);
}

/// Returns the edges with other than two triangles that lie in as many input triangles of the same
/// surfaces.
std::vector<Edge> intersection_edges(const std::vector<Triangle>& triangles,
                                     const IndexLists<std::uint32_t>& parents_of,
                                     const Numbers& surface_of) {
    std::map<Edge, std::vector<Numbers>> at_edge; // the surfaces of the parents of each triangle
    for (std::size_t t = 0; t < triangles.size() && t < parents_of.size(); ++t) {
        Numbers surfaces;
        for (const std::uint32_t p : parents_of[t])
            surfaces.push_back(p < surface_of.size() ? surface_of[p] : UINT32_MAX);
        std::sort(surfaces.begin(), surfaces.end());
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
            at_edge[{low, high}].push_back(surfaces);
        }
    }
    std::vector<Edge> edges;
    for (const auto& [edge, at] : at_edge)
        if (at.size() > 2 || (at.size() == 2 && at[0] != at[1])) edges.push_back(edge);
    return edges;
}

/// Makes the intersection edges and regions of the doubles those that their triangles have.
void follow_names(Certificate& c) {
    c.rounded->intersection_edges =
        intersection_edges(c.rounded->triangles, c.rounded->parents_of, surfaces_of_inputs(c));
    renumber_regions(c);
}

/// Gives the added triangles of a surface to another one, with the intersection edges and regions
/// that follow from that.
void move_to_surface(Certificate& c, const Arguments& n) {
    const auto own = own_inputs(c);
    if (own.size() < 2) return;
    const std::size_t from = pick(n.a, own.size()), to = pick(n.b, own.size());
    Added& leaving = c.sealed->surfaces[from].sealed;
    if (from == to || leaving.empty()) return;
    const auto count = static_cast<std::uint32_t>(leaving.size());
    // The numbers in between shift by the triangles that leave, or by those that come.
    const auto shifted = [&](std::uint32_t first, std::uint32_t end, std::uint32_t by) {
        return [=](std::uint32_t p) {
            if (p >= first && p < first + by)
                return from < to ? p + (end - first - by) : p - (first - end);
            if (from < to && p >= first + by && p < end) return p - by;
            if (from > to && p >= end && p < first) return p + by;
            return p;
        };
    };
    const auto vertex_of = [&](const OwnInputs& numbers, std::uint32_t input) {
        return numbers.first_vertex + 3 * (input - numbers.extended);
    };
    rename_inputs(c, shifted(own[from].sealed, own[to].end, count));
    rename_input_vertices(c, shifted(vertex_of(own[from], own[from].sealed),
                                     vertex_of(own[to], own[to].end), 3 * count));
    Added& joining = c.sealed->surfaces[to].sealed;
    joining.insert(joining.end(), leaving.begin(), leaving.end());
    leaving.clear();
    if (n.c % 2 == 0) c.sealed->surfaces[to].limit = wide_limit;
    if (n.d % 4 == 0) return;
    c.exact.intersection_edges =
        intersection_edges(c.exact.triangles, c.exact.parents_of, surfaces_of_inputs(c));
    if (c.rounded) follow_names(c);
}

void change_limit(Certificate& c, const Arguments& n) {
    if (c.sealed->surfaces.empty()) return;
    double& limit = c.sealed->surfaces[pick(n.a, c.sealed->surfaces.size())].limit;
    if (n.b % 4 == 0)
        limit = 0;
    else if (n.b % 4 == 1)
        limit = n.c / 16.0;
    else
        limit *= 1 + (n.b % 4 == 2 ? 1 : -1) * std::ldexp(1.0, -static_cast<int>(n.c % 12));
}

/// Leaves out all that names an input triangle, as far as no other one names it: in both parts, or
/// in one.
void leave_out(Certificate& c, const Arguments& n) {
    std::uint32_t inputs = 0;
    for (const OwnInputs& own : own_inputs(c)) inputs = own.end;
    std::optional<Chosen> added;
    if (n.b % 2 == 0) added = choose(c, n.a);
    const auto input = added ? added->input : static_cast<std::uint32_t>(pick(n.a, inputs));
    const Numbers before = c.cut->dropped;
    Numbers& dropped = c.cut->dropped;
    for (std::uint32_t t = 0; t < c.exact.parents_of.size() && n.c % 4 != 0; ++t)
        if (c.exact.parents_of[t].size() == 1 && c.exact.parents_of[t].front() == input)
            dropped.push_back(t);
    std::sort(dropped.begin(), dropped.end());
    dropped.erase(std::unique(dropped.begin(), dropped.end()), dropped.end());
    const double limit = n.d % 4 < 2 ? widest_limit : n.d % 4 == 2 ? wide_limit : 0;
    for (SealedPart& part : c.sealed->surfaces) part.limit = std::max(part.limit, limit);
    if (!c.rounded || n.c % 4 == 1) return;
    if (n.c % 4 == 0)
        drop_children(c.rounded->triangles, c.rounded->parents_of, &c.rounded->regions_of, input);
    else
        follow_dropped(c, before);
    follow_names(c);
}

/// Returns the coordinates of an input vertex of an added triangle.
std::optional<Point3> added_vertex(const Certificate& c, std::uint32_t vertex) {
    const auto own = own_inputs(c);
    for (std::size_t s = 0; s < own.size(); ++s) {
        std::uint32_t next = own[s].first_vertex;
        for (const auto* list : {&c.sealed->surfaces[s].extended, &c.sealed->surfaces[s].sealed})
            for (const auto& corners : *list)
                for (const Point3& p : corners)
                    if (next++ == vertex) return p;
    }
    return std::nullopt;
}

/// Returns the vertices of the doubles by those of the exact part, where the doubles are what was
/// kept of it; else nothing.
Numbers doubles_of_exact(const Certificate& c) {
    constexpr std::uint32_t none = UINT32_MAX;
    Numbers number(c.exact.vertices.size(), none);
    std::size_t kept = 0;
    for (std::uint32_t t = 0; t < c.exact.triangles.size(); ++t) {
        if (std::ranges::binary_search(c.cut->dropped, t)) continue;
        ++kept;
        for (const std::uint32_t v : c.exact.triangles[t])
            if (v < number.size()) number[v] = 0;
    }
    std::uint32_t count = 0;
    for (std::uint32_t& v : number)
        if (v == 0) v = count++;
    return kept == c.rounded->triangles.size() && count == c.rounded->vertices.size() ? number
                                                                                      : Numbers();
}

/// Returns the exact triangles that were dropped and of which all parents were added.
Numbers dropped_strips(const Certificate& c) {
    std::set<std::uint32_t> added; // input triangles
    for (const OwnInputs& own : own_inputs(c))
        for (std::uint32_t p = own.extended; p < own.end; ++p) added.insert(p);
    Numbers candidates;
    for (const std::uint32_t t : c.cut->dropped)
        if (t < c.exact.triangles.size() &&
            std::ranges::all_of(c.exact.parents_of[t], [&](auto p) { return added.contains(p); }))
            candidates.push_back(t);
    return candidates;
}

/// Keeps what was dropped of an added triangle, in both parts or in one.
void keep_again(Certificate& c, const Arguments& n) {
    if (!c.rounded || c.cut->dropped.empty() ||
        c.exact.parents_of.size() != c.exact.triangles.size())
        return;
    RoundedClaim& r = *c.rounded;
    Numbers number = doubles_of_exact(c);
    if (number.empty()) return;
    const Numbers candidates = dropped_strips(c);
    if (candidates.empty()) return;
    const std::uint32_t chosen = candidates[pick(n.a, candidates.size())];
    const Numbers like(c.exact.parents_of[chosen].begin(), c.exact.parents_of[chosen].end());
    std::uint32_t region = 0;
    for (const std::uint32_t known : r.regions_of.values) region = std::max(region, known + 1);
    const Numbers before = c.cut->dropped;
    for (const std::uint32_t t : before) {
        if (t >= c.exact.triangles.size() || !std::ranges::equal(c.exact.parents_of[t], like) ||
            (n.b % 4 == 0 && t != chosen))
            continue;
        if (n.c % 8 != 0) std::erase(c.cut->dropped, t);
        if (n.c % 8 == 1) continue;
        Triangle corners = c.exact.triangles[t];
        for (std::uint32_t& v : corners) {
            if (v >= number.size()) return;
            if (number[v] == UINT32_MAX) {
                const Construction& how = c.exact.vertices[v];
                const auto place = added_vertex(c, how.v[0]);
                if (how.kind != Construction::Kind::input || !place) return;
                number[v] = static_cast<std::uint32_t>(r.vertices.size());
                r.vertices.push_back(*place);
            }
            v = number[v];
        }
        r.triangles.push_back(corners);
        r.parents_of.push_back(like);
        r.regions_of.push_back(Numbers(like.size(), region));
    }
    r.max_move.reset();
    r.deviation = std::max(r.deviation, 1e-12);
    for (SealedPart& part : c.sealed->surfaces)
        if (n.d % 4 != 0) part.limit = std::max(part.limit, wide_limit);
    follow_names(c);
}

constexpr std::array<Change, 9> sealed_changes{{
    {"dropped part of an added triangle kept", keep_again},
    {"added triangle removed", remove_added},
    {"triangle added", add_added},
    {"corner of added triangles moved", move_corner},
    {"triangles that seal said to extend", rename_purpose},
    {"triangles added to another surface", move_to_surface},
    {"limit changed", change_limit},
    {"input triangle left out", leave_out},
    {"volume dropped", [](Certificate& c, const Arguments&) { c.cut->volume = {}; }},
}};

} // namespace

std::span<const Change> changes_of_seals() {
    static const std::vector<Change> all = [] {
        std::vector<Change> changes(sealed_changes.begin(), sealed_changes.end());
        const auto more = changes_of_cuts();
        changes.insert(changes.end(), more.begin(), more.end());
        return changes;
    }();
    return all;
}

} // namespace terrane::fuzz
