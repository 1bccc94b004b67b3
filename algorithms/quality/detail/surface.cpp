// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Splits, collapses and swaps edges within sheets.
#include <terrane/algorithms/quality/detail/operations.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/quality/detail/constants.hpp>
#include <terrane/algorithms/quality/detail/windows.hpp>

namespace terrane::quality::detail {
namespace {

/// Returns the class of a ratio from 1: there are four classes for each factor of two. Within a
/// class edges are processed in the order of their vertices, which saves cache misses.
double length_class(double ratio) {
    return 1.0 + std::ilogb(ratio * ratio * (ratio * ratio));
}

/// Calls list(t, items) for each triangle in use, in parallel, and concatenates the items in the
/// order of triangles.
template <class Item, class List>
std::vector<Item> from_triangles(const RemeshContext& context, const List& list) {
    const WorkMesh& mesh = context.mesh;
    const auto of_range = [&](std::size_t first, std::size_t last) {
        std::vector<Item> items;
        for (auto t = static_cast<std::uint32_t>(first); t < last; ++t)
            if (mesh.in_use(t)) list(t, items);
        return items;
    };
    return concatenated(
        parts_of_ranges<std::vector<Item>>(mesh.triangles.size(), context.run, of_range));
}

/// Lists inner edges with a positive measure, each once, lower vertex first, in the order of
/// triangles.
template <class Wanted>
std::vector<std::pair<double, Edge>> inner_edges(const RemeshContext& context,
                                                 const Wanted& wanted) {
    using Measured = std::pair<double, Edge>;
    const WorkMesh& mesh = context.mesh;
    return from_triangles<Measured>(context, [&](std::uint32_t t, std::vector<Measured>& edges) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
            if (a > b) continue; // the neighbour has the edge in the other direction
            const double measure = wanted(a, b);
            if (measure > 0 && mesh.curve_at(a, b) == none) edges.push_back({measure, {a, b}});
        }
    });
}

/// Lists the edges of each class, the highest class first.
std::vector<std::vector<Edge>> by_class(const std::vector<std::pair<double, Edge>>& edges) {
    std::map<double, std::vector<Edge>, std::greater<>> classes;
    for (const auto& [measure, e] : edges) classes[measure].push_back(e);
    std::vector<std::vector<Edge>> lists;
    for (auto& [measure, list] : classes) lists.push_back(std::move(list));
    return lists;
}

/// The aim of a swap.
enum class Aim : std::uint8_t { angles, valences };

/// Returns by how much the squared difference of a valence from six grows when it changes by
/// `change` (1 or -1).
int valence_cost(const WorkMesh& mesh, std::uint32_t v, int change) {
    if (mesh.kinds[v] != VertexKind::inner) return 0;
    return 2 * change * (static_cast<int>(mesh.star[v].size()) - 6) + 1;
}

/// Tells whether a swap of the edge (a, b) opposite to c can be worthwhile. In a plane, a swap
/// makes the sums of the angles at both ends of the edge angles of the new triangles. So the
/// largest angle decreases only if it is opposite to the edge and larger than both sums; as these
/// four angles add up to 360 degrees, it is obtuse then. For valences, the gain is a sum over the
/// two triangles, so one of them sees at least half of it.
bool promises(const WorkMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, Aim aim) {
    if (aim == Aim::valences)
        return valence_cost(mesh, a, -1) + valence_cost(mesh, b, -1) +
                   2 * valence_cost(mesh, c, 1) <
               0;
    const Point3& p = mesh.points[c];
    return dot(minus(mesh.points[a], p), minus(mesh.points[b], p)) < 0;
}

/// Lists the inner edges for which a swap can be worthwhile, as oriented in their triangles. Edges
/// are omitted if no triangle near them has changed at `time` or later.
std::vector<Edge> edges_to_swap(const RemeshContext& context, std::uint32_t time, Aim aim) {
    const WorkMesh& mesh = context.mesh;
    std::vector<char> is_near(mesh.points.size(), 0);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        if (mesh.in_use(t) && mesh.changed_at[t] >= time)
            for (const std::uint32_t v : mesh.triangles[t]) is_near[v] = 1;
    return from_triangles<Edge>(context, [&](std::uint32_t t, std::vector<Edge>& edges) {
        const Triangle& c = mesh.triangles[t];
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = c[i], b = c[(i + 1) % 3];
            if (is_near[a] != 0 && is_near[b] != 0 && promises(mesh, a, b, c[(i + 2) % 3], aim) &&
                mesh.curve_at(a, b) == none)
                edges.push_back({a, b});
        }
    });
}

/// Proposes to split an edge, unless one of its triangles has changed since.
bool propose_edge_split(RemeshContext& context, const Edge& e, std::uint32_t since,
                        Proposal& proposal) {
    const WorkMesh& mesh = context.mesh;
    const auto [a, b] = e;
    Change& change = proposal.change;
    change.clear();
    mesh.triangles_at(a, b, change.removed);
    if (change.removed.size() != 2) return false;
    if (mesh.changed_at[change.removed[0]] >= since || mesh.changed_at[change.removed[1]] >= since)
        return false;
    set_facing(mesh, change);
    const Point3 &p = mesh.points[a], &q = mesh.points[b];
    const Point3 middle{p.x + (q.x - p.x) / 2, p.y + (q.y - p.y) / 2, p.z + (q.z - p.z) / 2};
    const std::uint32_t m = mesh.next_vertex();
    change.placed = m;
    change.kind = VertexKind::inner;
    change.size = mesh.wanted_length(a, b);
    for (const std::uint32_t t : change.removed) {
        change.add(with(mesh.triangles[t], b, m), t);
        change.add(with(mesh.triangles[t], a, m), t);
    }
    const auto above =
        context.reference.above(middle, change.facing[0].second, mesh.hint_of[change.removed[0]]);
    if (above) {
        change.place = above->point;
        if (context.validator.check(change, proposal.checked) == Outcome::allowed) return true;
    }
    change.place = middle;
    return context.validator.check(change, proposal.checked) == Outcome::allowed;
}

/// Returns the cosine of the largest angle of a triangle.
double least_cosine(const WorkMesh& mesh, const Triangle& t) {
    double least = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point3 u = minus(mesh.points[t[(i + 1) % 3]], mesh.points[t[i]]);
        const Point3 w = minus(mesh.points[t[(i + 2) % 3]], mesh.points[t[i]]);
        const double size = std::sqrt(dot(u, u) * dot(w, w));
        least = std::min(least, size > 0 ? dot(u, w) / size : -1);
    }
    return least;
}

/// Proposes to swap an edge of edges_to_swap().
bool propose_swap(RemeshContext& context, const Edge& e, Aim aim, Proposal& proposal) {
    const WorkMesh& mesh = context.mesh;
    const auto [a, b] = e;
    Change& change = proposal.change;
    change.clear();
    mesh.triangles_at(a, b, change.removed);
    if (change.removed.size() != 2) return false;
    if (!runs_along(mesh.triangles[change.removed[0]], a, b))
        std::swap(change.removed[0], change.removed[1]);
    const std::uint32_t t = change.removed[0], u = change.removed[1];
    const Triangle &first = mesh.triangles[t], &second = mesh.triangles[u];
    const std::uint32_t c = opposite(first, a, b), d = opposite(second, a, b);
    if (a > b && promises(mesh, b, a, d, aim)) return false; // it is also in the list as (b, a)
    double least = constants.least_valence_cosine;
    if (aim == Aim::valences) {
        if (valence_cost(mesh, a, -1) + valence_cost(mesh, b, -1) + valence_cost(mesh, c, 1) +
                valence_cost(mesh, d, 1) >=
            0)
            return false;
    } else {
        least = constants.least_cosine_gain +
                std::min(least_cosine(mesh, first), least_cosine(mesh, second));
    }
    const Triangle left{c, a, d}, right{d, b, c};
    if (!(least_cosine(mesh, left) > least) || !(least_cosine(mesh, right) > least)) return false;
    if (mesh.are_neighbours(c, d)) return false;
    set_facing(mesh, change);
    change.add(left, t);
    change.add(right, u);
    return context.validator.check(change, proposal.checked) == Outcome::allowed;
}

std::size_t swap_those(RemeshContext& context, std::uint32_t changed_since, Aim aim) {
    const std::size_t count = in_windows(
        context, edges_to_swap(context, changed_since, aim),
        [&](const Edge& e, Proposal& p) { return propose_swap(context, e, aim, p); }, nothing_more);
    context.swaps += count;
    return count;
}

/// Tells whether the mesh has a triangle with the corners of t; v is one of them.
bool exists(const WorkMesh& mesh, const Triangle& t, std::uint32_t v) {
    return std::any_of(mesh.star[v].begin(), mesh.star[v].end(), [&](std::uint32_t other) {
        return std::all_of(t.begin(), t.end(),
                           [&](std::uint32_t c) { return has(mesh.triangles[other], c); });
    });
}

/// Tells whether the collapse preserves the topology.
bool keeps_topology(const WorkMesh& mesh, std::uint32_t gone, std::uint32_t kept, Proposal& p) {
    mesh.neighbours(gone, p.of_gone);
    mesh.neighbours(kept, p.of_kept);
    p.common.clear();
    p.across.clear();
    std::set_intersection(p.of_gone.begin(), p.of_gone.end(), p.of_kept.begin(), p.of_kept.end(),
                          std::back_inserter(p.common));
    for (const std::uint32_t t : p.at_edge)
        p.across.push_back(opposite(mesh.triangles[t], gone, kept));
    std::sort(p.across.begin(), p.across.end());
    if (p.common != p.across) return false;
    const auto is_across = [&](std::uint32_t v) {
        return std::binary_search(p.across.begin(), p.across.end(), v);
    };
    for (const Triangle& t : p.change.added) {
        unsigned count = 0;
        for (const std::uint32_t v : t) count += is_across(v);
        if (count == 2 && exists(mesh, t, kept)) return false;
    }
    return true;
}

/// For a vertex of a curve: finds the neighbour on the other side and tells whether the new edge
/// stays near the curve.
bool curve_allows(const RemeshContext& context, std::uint32_t gone, std::uint32_t kept,
                  std::uint32_t& other) {
    const WorkMesh& mesh = context.mesh;
    const std::uint32_t curve = mesh.curve_of[gone];
    const auto [before, after] = mesh.along[gone];
    if (before == after || (kept != before && kept != after)) return false;
    other = kept == before ? after : before;
    return chord_within_bound(context, curve, mesh.place_at(context.curves, curve, before, gone),
                              mesh.place_at(context.curves, curve, after, gone));
}

/// Proposes to collapse a short edge into one of its ends, unless nothing there has changed since.
bool propose_edge_collapse(RemeshContext& context, const Edge& e, std::uint32_t since,
                           Proposal& proposal) {
    const WorkMesh& mesh = context.mesh;
    const auto [a, b] = e;
    if (mesh.kinds[a] == VertexKind::unused || mesh.kinds[b] == VertexKind::unused) return false;
    const double wanted = mesh.wanted_length(a, b);
    if (!mesh.changed_since(a, since) && !mesh.changed_since(b, since)) return false;
    if (!(mesh.edge_length(a, b) < constants.collapse_ratio * wanted) ||
        !mesh.are_neighbours(a, b) || mesh.curve_at(a, b) != none)
        return false;
    const auto into = [&](std::uint32_t gone, std::uint32_t kept) {
        return mesh.kinds[gone] == VertexKind::inner &&
               propose_collapse(context, {gone, kept}, constants.split_ratio * wanted,
                                constants.least_shape, proposal);
    };
    return into(a, b) || into(b, a);
}

/// Proposes to collapse the shortest edge of a triangle, or the second shortest, into one of its
/// ends.
bool propose_collapse_at(RemeshContext& context, const Triangle& c, Proposal& proposal) {
    const WorkMesh& mesh = context.mesh;
    std::array<std::pair<double, std::size_t>, 3> by_length;
    for (std::size_t i = 0; i < 3; ++i) by_length[i] = {mesh.edge_length(c[i], c[(i + 1) % 3]), i};
    std::sort(by_length.begin(), by_length.end());
    for (std::size_t k = 0; k < 2; ++k) { // collapsing the longest would create a long edge
        const std::uint32_t a = c[by_length[k].second], b = c[(by_length[k].second + 1) % 3];
        const double longest = constants.bad_collapse_ratio * mesh.wanted_length(a, b);
        const bool on_curve = mesh.curve_at(a, b) != none;
        const auto into = [&](std::uint32_t gone, std::uint32_t kept) {
            const bool fits = mesh.kinds[gone] == VertexKind::inner ||
                              (on_curve && mesh.kinds[gone] == VertexKind::curve);
            return fits && propose_collapse(context, {gone, kept}, longest, 1.0, proposal);
        };
        if (into(a, b) || into(b, a)) return true;
    }
    return false;
}

} // namespace

bool propose_collapse(RemeshContext& context, const Edge& gone_kept, double longest, double least,
                      Proposal& proposal) {
    const WorkMesh& mesh = context.mesh;
    const auto [gone, kept] = gone_kept;
    if (mesh.kinds[gone] == VertexKind::corner) return false;
    const bool on_curve = mesh.kinds[gone] == VertexKind::curve;
    proposal.gone = gone;
    proposal.kept = kept;
    if (on_curve && !curve_allows(context, gone, kept, proposal.other)) return false;
    Change& change = proposal.change;
    change.clear();
    change.on_border = on_curve;
    change.removed.assign(mesh.star[gone].begin(), mesh.star[gone].end());
    proposal.at_edge.clear();
    double longest_added = 0;
    for (const std::uint32_t t : change.removed) {
        const Triangle& corners = mesh.triangles[t];
        if (has(corners, kept)) {
            // The triangles of a sheet between the two edges of the curve must not all vanish.
            if (on_curve && opposite(corners, gone, kept) == proposal.other) return false;
            proposal.at_edge.push_back(t);
            continue;
        }
        change.add(with(corners, gone, kept), t);
        for (const std::uint32_t v : corners) {
            if (v == gone) continue;
            longest = std::max(longest, mesh.edge_length(v, gone)); // edges may be as long as
                                                                    // before
            longest_added = std::max(longest_added, mesh.edge_length(v, kept));
        }
    }
    if (change.added.empty() || longest_added > longest) return false;
    double worst = 1;
    for (const Triangle& t : change.added) worst = std::min(worst, shape_of(mesh, t));
    if (!(worst > least)) {
        double worst_before = 1;
        for (const std::uint32_t t : change.removed)
            worst_before = std::min(worst_before, shape_of(mesh, mesh.triangles[t]));
        if (!(worst > worst_before)) return false;
    }
    if (!keeps_topology(mesh, gone, kept, proposal)) return false;
    set_facing(mesh, change);
    return context.validator.check(change, proposal.checked) == Outcome::allowed;
}

void after_collapse(WorkMesh& mesh, const Proposal& proposal) {
    const auto gone = proposal.gone, kept = proposal.kept;
    mesh.kinds[gone] = VertexKind::unused;
    if (!proposal.change.on_border) return;
    const std::uint32_t curve = mesh.curve_of[gone], other = proposal.other;
    const auto [before, after] = mesh.along[gone];
    const bool inner_before = mesh.kinds[before] == VertexKind::curve;
    const bool inner_after = mesh.kinds[after] == VertexKind::curve;
    if (inner_before) mesh.along[before][1] = after;
    if (inner_after) mesh.along[after][0] = before;
    if (!inner_before && !inner_after) mesh.set_direct(kept, other, curve);
}

double shape_of(const Point3& a, const Point3& b, const Point3& c) {
    const Point3 u = minus(b, a), v = minus(c, b), w = minus(a, c);
    const Point3 n = cross(u, v);
    const double lu = std::sqrt(dot(u, u)), lv = std::sqrt(dot(v, v)), lw = std::sqrt(dot(w, w));
    const double size = lu * lv * lw * (lu + lv + lw);
    return size > 0 ? 4 * dot(n, n) / size : 0;
}

void set_facing(const WorkMesh& mesh, Change& change) {
    for (const std::uint32_t t : change.removed) {
        const std::uint32_t sheet = mesh.sheet_of[t];
        auto at = std::find_if(change.facing.begin(), change.facing.end(),
                               [&](const auto& f) { return f.first == sheet; });
        if (at == change.facing.end())
            at = change.facing.insert(change.facing.end(), {sheet, Point3{}});
        const Point3 n = mesh.normal(mesh.triangles[t]);
        at->second = {at->second.x + n.x, at->second.y + n.y, at->second.z + n.z};
    }
}

std::size_t split_edges(RemeshContext& context) {
    const WorkMesh& mesh = context.mesh;
    std::size_t count = 0;
    for (unsigned round = 0; round < constants.split_rounds && !context.run.stop.stop_requested();
         ++round) {
        const auto classes = by_class(inner_edges(context, [&](std::uint32_t a, std::uint32_t b) {
            const double ratio = mesh.edge_length(a, b) / mesh.wanted_length(a, b);
            if (!(ratio > constants.split_ratio) || is_settled_edge(context, a, b)) return 0.0;
            return length_class(ratio);
        }));
        std::size_t more = 0;
        const std::uint32_t since = ++context.mesh.now;
        for (const std::vector<Edge>& edges : classes)
            more += in_windows(
                context, edges,
                [&](const Edge& e, Proposal& p) {
                    return propose_edge_split(context, e, since, p);
                },
                nothing_more);
        if (more == 0) break;
        context.splits += more;
        count += more;
        // Halves of slivers are slivers: swapping and collapsing them prevents repeated halving.
        if (constants.cleanup_part * more < mesh.triangles.size()) continue;
        swap_edges(context);
        collapse_edges(context);
    }
    return count;
}

std::size_t collapse_edges(RemeshContext& context) {
    const WorkMesh& mesh = context.mesh;
    std::size_t count = 0;
    const auto classes = by_class(inner_edges(context, [&](std::uint32_t a, std::uint32_t b) {
        const double ratio = mesh.edge_length(a, b) / mesh.wanted_length(a, b);
        return ratio < constants.collapse_ratio
                   ? length_class(1 / std::max(ratio, constants.least_length_ratio))
                   : 0;
    }));
    const std::uint32_t since = context.collapsed_at; // what failed then would fail again
    context.collapsed_at = ++context.mesh.now;
    for (const std::vector<Edge>& edges : classes)
        count += in_windows(
            context, edges,
            [&](const Edge& e, Proposal& p) { return propose_edge_collapse(context, e, since, p); },
            [&](const Edge&, const Proposal& p, bool is_made) {
                if (is_made) after_collapse(context.mesh, p);
            });
    context.collapses += count;
    return count;
}

std::size_t collapse_bad(RemeshContext& context, double below) {
    using Triangles = std::vector<std::uint32_t>;
    const WorkMesh& mesh = context.mesh;
    const auto is_bad = [&](std::uint32_t t) {
        return mesh.in_use(t) && shape_of(mesh, mesh.triangles[t]) < below;
    };
    const auto bad = from_triangles<std::uint32_t>(context, [&](std::uint32_t t, Triangles& list) {
        if (is_bad(t)) list.push_back(t);
    });
    const std::size_t count = in_windows(
        context, bad,
        [&](std::uint32_t t, Proposal& p) {
            return is_bad(t) && propose_collapse_at(context, mesh.triangles[t], p);
        },
        [&](std::uint32_t, const Proposal& p, bool is_made) {
            if (is_made) after_collapse(context.mesh, p);
        });
    context.collapses += count;
    return count;
}

std::size_t improve_triangle(RemeshContext& context, std::uint32_t t) {
    const Triangle c = context.mesh.triangles[t];
    std::vector<Edge> ends; // gone, kept
    for (std::size_t i = 0; i < 3; ++i) {
        ends.push_back({c[i], c[(i + 1) % 3]});
        ends.push_back({c[(i + 1) % 3], c[i]});
    }
    for (const std::uint32_t v : c) { // its other neighbours, and the collapse of a vertex of three
        std::vector<std::uint32_t> around;
        context.mesh.neighbours(v, around);
        for (const std::uint32_t u : around)
            if (!has(c, u)) ends.push_back({v, u});
    }
    const auto fits = [&](const Edge& e) {
        const auto kind = context.mesh.kinds[e[0]];
        return kind == VertexKind::inner ||
               (kind == VertexKind::curve && context.mesh.curve_at(e[0], e[1]) != none);
    };
    std::erase_if(ends, [&](const Edge& e) { return !fits(e); });
    const auto is_here = [&] { return context.mesh.in_use(t) && context.mesh.triangles[t] == c; };
    std::size_t count = in_windows(
        context, ends,
        [&](const Edge& e, Proposal& p) {
            return is_here() && propose_collapse(context, e, HUGE_VAL, 1.0, p);
        },
        [&](const Edge&, const Proposal& p, bool is_made) {
            if (is_made) after_collapse(context.mesh, p);
        });
    context.collapses += count;
    if (count > 0 || !is_here()) return count;
    std::vector<Edge> sides;
    for (std::size_t i = 0; i < 3; ++i)
        if (context.mesh.curve_at(c[i], c[(i + 1) % 3]) == none)
            sides.push_back({c[i], c[(i + 1) % 3]});
    count = in_windows(
        context, sides,
        [&](const Edge& e, Proposal& p) {
            return is_here() && propose_swap(context, e, Aim::angles, p);
        },
        nothing_more);
    context.swaps += count;
    return count;
}

std::size_t equalize_valences(RemeshContext& context) {
    const std::size_t count = swap_those(context, context.equalized_at, Aim::valences);
    context.equalized_at = ++context.mesh.now;
    return count;
}

std::size_t swap_edges(RemeshContext& context) {
    std::size_t count = 0;
    for (unsigned round = 0; round < constants.swap_rounds && !context.run.stop.stop_requested();
         ++round) {
        const std::uint32_t since = context.swapped_at;
        context.swapped_at = ++context.mesh.now;
        const std::size_t more = swap_those(context, since, Aim::angles);
        count += more;
        if (constants.sweep_part * more < context.mesh.triangles.size()) break;
    }
    return count;
}

} // namespace terrane::quality::detail
