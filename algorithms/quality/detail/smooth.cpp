// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Smoothing by trapezium drawing.
#include <terrane/algorithms/quality/detail/operations.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <terrane/algorithms/quality/detail/constants.hpp>
#include <terrane/algorithms/quality/detail/windows.hpp>

namespace terrane::quality::detail {
namespace {

/// Computes the position proposed by trapezium drawing.
Point3 drawn(const WorkMesh& mesh, std::uint32_t v) {
    const Point3& p = mesh.points[v];
    Point3 sum{};
    for (const std::uint32_t t : mesh.star[v]) {
        const Triangle& c = mesh.triangles[t];
        const std::size_t i = c[0] == v ? 0 : c[1] == v ? 1 : 2;
        const Point3 &a = mesh.points[c[(i + 1) % 3]], &b = mesh.points[c[(i + 2) % 3]];
        const Point3 base = minus(b, a);
        const Point3 to_middle{(a.x + b.x) / 2 - p.x, (a.y + b.y) / 2 - p.y, (a.z + b.z) / 2 - p.z};
        const double square = dot(base, base);
        const double share = square > 0 ? dot(to_middle, base) / square : 0;
        sum = {sum.x + share * base.x, sum.y + share * base.y, sum.z + share * base.z};
    }
    const auto count = static_cast<double>(mesh.star[v].size());
    return {p.x + sum.x / count, p.y + sum.y / count, p.z + sum.z / count};
}

/// Computes the mean of the neighbours.
Point3 centre(const WorkMesh& mesh, std::uint32_t v) {
    Point3 sum{};
    for (const std::uint32_t t : mesh.star[v])
        for (const std::uint32_t c : mesh.triangles[t])
            if (c != v)
                sum = {sum.x + mesh.points[c].x, sum.y + mesh.points[c].y,
                       sum.z + mesh.points[c].z};
    const auto count = 2 * static_cast<double>(mesh.star[v].size());
    return {sum.x / count, sum.y / count, sum.z / count};
}

/// Sum and maximum of 1 / q over the triangles at a vertex.
struct Badness {
    double sum = 0, largest = 0;
};

/// Computes q of triangle t for vertex v at p.
double shape_with(const WorkMesh& mesh, const Triangle& t, std::uint32_t v, const Point3& p) {
    const auto at = [&](std::uint32_t c) -> const Point3& { return c == v ? p : mesh.points[c]; };
    return shape_of(at(t[0]), at(t[1]), at(t[2]));
}

/// Computes the badness for vertex v at p.
Badness badness_at(const WorkMesh& mesh, std::uint32_t v, const Point3& p) {
    Badness badness;
    for (const std::uint32_t t : mesh.star[v]) {
        const double one = 1 / shape_with(mesh, mesh.triangles[t], v, p);
        badness.sum += one;
        badness.largest = std::max(badness.largest, one);
    }
    return badness;
}

constexpr double endless = std::numeric_limits<double>::infinity();

/// Tells whether both sum and maximum are less than the limits for vertex v at p. As each 1 / q is
/// at least 1, the test can stop early.
bool is_below(const WorkMesh& mesh, std::uint32_t v, const Point3& p, const Badness& limits) {
    auto left = static_cast<double>(mesh.star[v].size());
    double sum = 0;
    for (const std::uint32_t t : mesh.star[v]) {
        const double one = 1 / shape_with(mesh, mesh.triangles[t], v, p);
        sum += one;
        left -= 1;
        if (!(sum + left < limits.sum && one < limits.largest)) return false;
    }
    return true;
}

/// Proposes to move the vertex of change.placed, after collect_star(), to the projection of `to` to
/// the original surface. The badness there must be below the limits.
bool propose_move(const RemeshContext& context, const Point3& to, const Badness& limits,
                  Proposal& proposal) {
    const WorkMesh& mesh = context.mesh;
    Change& change = proposal.change;
    const std::uint32_t v = change.placed;
    if (!is_below(mesh, v, to, limits)) return false; // rejects most proposals
    if (change.facing.empty()) set_facing(mesh, change);
    const auto place =
        context.reference.above(to, change.facing[0].second, mesh.hint_of[change.removed[0]]);
    if (!place || !is_below(mesh, v, place->point, limits)) return false;
    change.place = place->point;
    return context.validator.check(change, proposal.checked) == Outcome::allowed;
}

bool propose_smoothing(const RemeshContext& context, std::uint32_t v, Proposal& proposal) {
    const WorkMesh& mesh = context.mesh;
    proposal.is_tried = mesh.changed_since(v, context.smoothed_at[v]);
    if (!proposal.is_tried) return false;
    collect_star(mesh, v, proposal.change);
    const Point3 &from = mesh.points[v], to = drawn(mesh, v);
    const Badness better{badness_at(mesh, v, from).sum * (1 - constants.least_gain), endless};
    // Each triangle moves the vertex along its own edge only: half of the way on average.
    for (const double share : constants.smoothing_shares)
        if (propose_move(context, towards(from, to, share), better, proposal)) return true;
    return propose_move(context, towards(from, centre(mesh, v), constants.centring_share), better,
                        proposal);
}

/// Searches for a better position in the directions of the tangent plane, with steps that are
/// halved. Every improvement is the start of the next step; the last one is proposed.
bool propose_improvement(const RemeshContext& context, std::uint32_t v, double below,
                         Proposal& proposal) {
    const WorkMesh& mesh = context.mesh;
    proposal.is_tried = mesh.changed_since(v, context.improved_at[v]) &&
                        std::any_of(mesh.star[v].begin(), mesh.star[v].end(), [&](std::uint32_t t) {
                            return shape_of(mesh, mesh.triangles[t]) < below;
                        });
    if (!proposal.is_tried) return false;
    collect_star(mesh, v, proposal.change);
    set_facing(mesh, proposal.change);
    Point3 n = proposal.change.facing[0].second;
    const double size = std::sqrt(dot(n, n));
    if (!(size > 0)) return false;
    n = {n.x / size, n.y / size, n.z / size};
    Point3 u = std::fabs(n.x) < 0.6 ? cross(n, {1, 0, 0}) : cross(n, {0, 1, 0});
    const double across = std::sqrt(dot(u, u));
    u = {u.x / across, u.y / across, u.z / across};
    const Point3 w = cross(n, u);
    constexpr unsigned half_turn = constants.search_directions / 2;
    bool moves = false;
    Point3 p = mesh.points[v];
    CheckedChange of_p;
    double largest = badness_at(mesh, v, p).largest, step = constants.search_step * mesh.sizes[v];
    for (unsigned halving = 0; halving < constants.search_halvings; ++halving, step /= 2)
        for (unsigned k = 0; k < constants.search_directions; ++k) {
            const double angle = k * std::acos(-1.0) / half_turn;
            const double c = step * std::cos(angle), s = step * std::sin(angle);
            const Point3 to{p.x + c * u.x + s * w.x, p.y + c * u.y + s * w.y,
                            p.z + c * u.z + s * w.z};
            if (!propose_move(context, to, {endless, largest * (1 - constants.least_gain)},
                              proposal))
                continue;
            p = proposal.change.place;
            std::swap(of_p, proposal.checked);
            largest = badness_at(mesh, v, p).largest;
            moves = true;
        }
    proposal.change.place = p;
    std::swap(of_p, proposal.checked);
    return moves;
}

/// Computes pseudo-random coordinates in [-1, 1) from the index.
Point3 scattered(std::uint32_t v) {
    std::uint64_t h = v * 0x9E3779B97F4A7C15ULL;
    const auto next = [&] {
        h ^= h >> 31U;
        h *= 0xBF58476D1CE4E5B9ULL;
        h ^= h >> 29U;
        return static_cast<double>(h >> 11U) * 0x1p-52 - 1;
    };
    const double x = next(), y = next(), z = next();
    return {x, y, z};
}

/// Lists inner vertices: those in one injective patch, then the others.
std::array<std::vector<std::uint32_t>, 2> inner_vertices(const RemeshContext& context) {
    std::array<std::vector<std::uint32_t>, 2> lists;
    for (std::uint32_t v = 0; v < context.mesh.kinds.size(); ++v) {
        const WorkMesh::Star& star = context.mesh.star[v];
        if (context.mesh.kinds[v] == VertexKind::inner)
            lists[context.validator.in_one_patch({star.data(), star.size()}) ? 0 : 1].push_back(v);
    }
    return lists;
}

} // namespace

void collect_star(const WorkMesh& mesh, std::uint32_t v, Change& change) {
    change.clear();
    change.in_place = true;
    change.placed = v;
    change.removed.assign(mesh.star[v].begin(), mesh.star[v].end());
    for (const std::uint32_t t : change.removed) change.add(mesh.triangles[t], t);
}

void settle(RemeshContext& context, std::span<const double> lengths) {
    const std::uint32_t now = ++context.mesh.now;
    context.settled_at = context.equalized_at = context.swapped_at = context.collapsed_at = now;
    context.smoothed_at.assign(context.mesh.kinds.size(), now);
    context.improved_at.assign(context.mesh.kinds.size(), now);
    context.settled.resize(lengths.size());
    for (std::size_t v = 0; v < lengths.size(); ++v)
        context.settled[v] = static_cast<char>(context.mesh.sizes[v] == lengths[v]);
}

bool is_settled(const RemeshContext& context, std::uint32_t v) {
    return v < context.settled.size() && context.settled[v] != 0 &&
           !context.mesh.changed_since(v, context.settled_at);
}

std::size_t smooth(RemeshContext& context) {
    ++context.mesh.now;
    context.smoothed_at.resize(context.mesh.kinds.size(), 0);
    std::size_t count = 0;
    for (const std::vector<std::uint32_t>& vertices : inner_vertices(context))
        count += in_windows(
            context, vertices,
            [&](std::uint32_t v, Proposal& p) { return propose_smoothing(context, v, p); },
            [&](std::uint32_t v, const Proposal& p, bool is_made) {
                // Changes of this window come after the vertex was tried.
                if (p.is_tried) context.smoothed_at[v] = is_made ? 0 : context.mesh.now;
            });
    context.moves += count;
    return count;
}

std::size_t jitter(RemeshContext& context) {
    const WorkMesh& mesh = context.mesh;
    const auto propose = [&](std::uint32_t v, Proposal& proposal) {
        if (!std::all_of(mesh.star[v].begin(), mesh.star[v].end(), [&](std::uint32_t t) {
                return shape_of(mesh, mesh.triangles[t]) < constants.jitter_below_shape;
            }))
            return false;
        collect_star(mesh, v, proposal.change);
        const double size = constants.jitter * mesh.sizes[v];
        const Point3& p = mesh.points[v];
        const auto off = scattered(v);
        return propose_move(context, {p.x + size * off.x, p.y + size * off.y, p.z + size * off.z},
                            {endless, 2}, proposal);
    };
    std::size_t count = 0;
    for (const std::vector<std::uint32_t>& vertices : inner_vertices(context))
        count += in_windows(context, vertices, propose, nothing_more);
    context.moves += count;
    return count;
}

std::size_t improve_worst(RemeshContext& context, double below) {
    ++context.mesh.now;
    context.improved_at.resize(context.mesh.kinds.size(), 0);
    std::size_t count = 0;
    for (const std::vector<std::uint32_t>& vertices : inner_vertices(context))
        count += in_windows(
            context, vertices,
            [&](std::uint32_t v, Proposal& p) { return propose_improvement(context, v, below, p); },
            [&](std::uint32_t v, const Proposal& p, bool is_made) {
                if (p.is_tried) context.improved_at[v] = is_made ? 0 : context.mesh.now;
            });
    context.moves += count;
    return count;
}

} // namespace terrane::quality::detail
