// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Operations on curves. Each vertex stays on its original curve.
#include <terrane/algorithms/quality/detail/operations.hpp>

#include <algorithm>
#include <cmath>

#include <terrane/algorithms/quality/detail/constants.hpp>
#include <terrane/algorithms/quality/detail/windows.hpp>

namespace terrane::quality::detail {
namespace {

/// An edge of a curve, in the direction of the curve.
struct CurveEdge {
    std::uint32_t curve = 0, from = 0, to = 0;
};

std::vector<CurveEdge> curve_edges(const WorkMesh& mesh, const std::vector<Curve>& curves) {
    std::vector<CurveEdge> edges;
    for (std::uint32_t v = 0; v < mesh.kinds.size(); ++v) {
        if (mesh.kinds[v] != VertexKind::curve) continue;
        edges.push_back({mesh.curve_of[v], mesh.along[v][0], v});
        if (mesh.kinds[mesh.along[v][1]] == VertexKind::corner)
            edges.push_back({mesh.curve_of[v], v, mesh.along[v][1]});
    }
    const std::size_t inner = edges.size();
    for (const auto& [ends, c] : mesh.direct())
        edges.push_back({c, curves[c].vertices.front(), curves[c].vertices.back()});
    // Sorted, as the order of a hash map is not reproducible.
    std::sort(edges.begin() + static_cast<std::ptrdiff_t>(inner), edges.end(),
              [](const auto& a, const auto& b) { return a.curve < b.curve; });
    return edges;
}

/// Returns the arc lengths of the two ends of an edge.
std::array<double, 2> places_of(const RemeshContext& context, const CurveEdge& e) {
    return {context.mesh.place_at(context.curves, e.curve, e.from, e.to),
            context.mesh.kinds[e.from] == VertexKind::corner &&
                    context.mesh.kinds[e.to] == VertexKind::corner
                ? context.curves[e.curve].at.back()
                : context.mesh.place_at(context.curves, e.curve, e.to, e.from)};
}

bool propose_curve_split(RemeshContext& context, const CurveEdge& e, Proposal& proposal) {
    const WorkMesh& mesh = context.mesh;
    const auto [from, to] = places_of(context, e);
    proposal.at = from + (to - from) / 2;
    if (!chord_within_bound(context, e.curve, from, proposal.at) ||
        !chord_within_bound(context, e.curve, proposal.at, to))
        return false;
    Change& change = proposal.change;
    change.clear();
    change.on_border = true;
    mesh.triangles_at(e.from, e.to, change.removed);
    set_facing(mesh, change);
    const std::uint32_t m = mesh.next_vertex();
    change.placed = m;
    change.place = point_on(context, e.curve, proposal.at);
    change.kind = VertexKind::curve;
    change.size = mesh.wanted_length(e.from, e.to);
    for (const std::uint32_t t : change.removed) {
        change.add(with(mesh.triangles[t], e.to, m), t);
        change.add(with(mesh.triangles[t], e.from, m), t);
    }
    return context.validator.check(change, proposal.checked) == Outcome::allowed;
}

void after_split(WorkMesh& mesh, const CurveEdge& e, const Proposal& proposal) {
    const std::uint32_t m = proposal.change.placed;
    mesh.curve_of[m] = e.curve;
    mesh.place_on[m] = proposal.at;
    mesh.along[m] = {e.from, e.to};
    const bool from_inner = mesh.kinds[e.from] == VertexKind::curve;
    const bool to_inner = mesh.kinds[e.to] == VertexKind::curve;
    if (from_inner) mesh.along[e.from][1] = m;
    if (to_inner) mesh.along[e.to][0] = m;
    if (!from_inner && !to_inner) mesh.drop_direct(e.from, e.to);
}

/// Sums 1 / q of the added triangles.
double badness_of_added(const WorkMesh& mesh, const Change& change) {
    double sum = 0;
    for (const Triangle& t : change.added)
        sum += 1 / shape_of(change.point(mesh.points, t[0]), change.point(mesh.points, t[1]),
                            change.point(mesh.points, t[2]));
    return sum;
}

bool propose_slide_to(RemeshContext& context, std::uint32_t v, double at, Proposal& proposal) {
    const WorkMesh& mesh = context.mesh;
    const std::uint32_t curve = mesh.curve_of[v];
    const auto [before, after] = mesh.along[v];
    if (!chord_within_bound(context, curve, mesh.place_at(context.curves, curve, before, v), at) ||
        !chord_within_bound(context, curve, at, mesh.place_at(context.curves, curve, after, v)))
        return false;
    proposal.at = at;
    Change& change = proposal.change;
    collect_star(mesh, v, change);
    change.on_border = true;
    change.place = mesh.points[v];
    const double before_it = badness_of_added(mesh, change);
    change.place = point_on(context, curve, at);
    if (!(badness_of_added(mesh, change) < before_it * (1 - constants.least_gain))) return false;
    set_facing(mesh, change);
    return context.validator.check(change, proposal.checked) == Outcome::allowed;
}

/// Slides a vertex to halfway between its neighbours, or half of the way there.
bool propose_slide(RemeshContext& context, std::uint32_t v, Proposal& proposal) {
    const WorkMesh& mesh = context.mesh;
    if (mesh.kinds[v] != VertexKind::curve) return false;
    const std::uint32_t curve = mesh.curve_of[v];
    const double from = mesh.place_at(context.curves, curve, mesh.along[v][0], v);
    const double to = mesh.place_at(context.curves, curve, mesh.along[v][1], v);
    const double middle = from + (to - from) / 2, here = mesh.place_on[v];
    if (std::fabs(middle - here) < constants.least_slide * (to - from)) return false;
    return propose_slide_to(context, v, middle, proposal) ||
           propose_slide_to(context, v, here + constants.slide_share * (middle - here), proposal);
}

/// Collapses the edge to the nearer neighbour on the curve if it is short.
bool propose_curve_collapse(RemeshContext& context, std::uint32_t v, Proposal& proposal) {
    const WorkMesh& mesh = context.mesh;
    if (mesh.kinds[v] != VertexKind::curve) return false;
    const auto [before, after] = mesh.along[v];
    const double back = mesh.edge_length(v, before), on = mesh.edge_length(v, after);
    const std::uint32_t kept = back < on ? before : after;
    const double wanted = mesh.wanted_length(v, kept);
    return std::min(back, on) < constants.collapse_ratio * wanted &&
           back + on < constants.split_ratio * wanted &&
           propose_collapse(context, {v, kept}, constants.curve_collapse_ratio * wanted,
                            constants.least_shape, proposal);
}

std::vector<std::uint32_t> curve_vertices(const RemeshContext& context) {
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < context.mesh.kinds.size(); ++v)
        if (context.mesh.kinds[v] == VertexKind::curve && !is_settled(context, v))
            vertices.push_back(v);
    return vertices;
}

} // namespace

Point3 point_on(const RemeshContext& context, std::uint32_t curve, double at) {
    const Curve& c = context.curves[curve];
    const auto after = std::upper_bound(c.at.begin() + 1, c.at.end() - 1, at);
    const auto i = static_cast<std::size_t>(after - c.at.begin());
    const Point3 &a = context.points[c.vertices[i - 1]], &b = context.points[c.vertices[i]];
    const double piece = c.at[i] - c.at[i - 1];
    const double share = piece > 0 ? std::clamp((at - c.at[i - 1]) / piece, 0.0, 1.0) : 0;
    return nearest_in_box(towards(a, b, share), std::array{a, b});
}

bool chord_within_bound(const RemeshContext& context, std::uint32_t curve, double from, double to) {
    const Curve& c = context.curves[curve];
    const Point3 a = point_on(context, curve, from), b = point_on(context, curve, to);
    const Point3 d = minus(b, a);
    const double square = dot(d, d);
    auto i =
        static_cast<std::size_t>(std::upper_bound(c.at.begin(), c.at.end(), from) - c.at.begin());
    for (; i < c.at.size() && c.at[i] < to; ++i) {
        const Point3 w = minus(context.points[c.vertices[i]], a);
        const double share = square > 0 ? std::clamp(dot(w, d) / square, 0.0, 1.0) : 0;
        const Point3 off{w.x - share * d.x, w.y - share * d.y, w.z - share * d.z};
        if (!(std::sqrt(dot(off, off)) + context.reference.rounding() <=
              context.curve_bound[curve]))
            return false;
    }
    return true;
}

std::size_t split_curves(RemeshContext& context) {
    std::size_t count = 0;
    for (unsigned round = 0; round < constants.split_rounds && !context.run.stop.stop_requested();
         ++round) {
        std::vector<CurveEdge> edges = curve_edges(context.mesh, context.curves);
        std::erase_if(edges, [&](const CurveEdge& e) {
            const auto [from, to] = places_of(context, e);
            return !(to - from >
                     constants.split_ratio * context.mesh.wanted_length(e.from, e.to)) ||
                   is_settled_edge(context, e.from, e.to);
        });
        const std::size_t more = in_windows(
            context, edges,
            [&](const CurveEdge& e, Proposal& p) { return propose_curve_split(context, e, p); },
            [&](const CurveEdge& e, const Proposal& p, bool is_made) {
                if (is_made) after_split(context.mesh, e, p);
            });
        if (more == 0) break;
        context.splits += more;
        count += more;
    }
    return count;
}

std::size_t collapse_curves(RemeshContext& context) {
    const std::size_t count = in_windows(
        context, curve_vertices(context),
        [&](std::uint32_t v, Proposal& p) { return propose_curve_collapse(context, v, p); },
        [&](std::uint32_t, const Proposal& p, bool is_made) {
            if (is_made) after_collapse(context.mesh, p);
        });
    context.collapses += count;
    return count;
}

std::size_t slide_curves(RemeshContext& context) {
    const std::size_t count = in_windows(
        context, curve_vertices(context),
        [&](std::uint32_t v, Proposal& p) { return propose_slide(context, v, p); },
        [&](std::uint32_t v, const Proposal& p, bool is_made) {
            if (is_made) context.mesh.place_on[v] = p.at;
        });
    context.moves += count;
    return count;
}

} // namespace terrane::quality::detail
