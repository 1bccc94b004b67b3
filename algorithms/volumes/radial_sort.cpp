// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/volumes/radial_sort.hpp>

#include <algorithm>
#include <stdexcept>

namespace terrane::volumes {
namespace {

using Side = EdgeSides::Side;

bool have_common_value(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        if (a[i] == b[j]) return true;
        a[i] < b[j] ? ++i : ++j;
    }
    return false;
}

/// Compares the directions of triangles away from one edge by their angles.
class Directions {
public:
    Directions(UpwardWitness upward, const TriangleComplex& sheets, std::uint32_t low,
               const Side& reference) :
        upward_(upward),
        sheets_(sheets), low_(low), reference_(reference) {}

    /// Tells whether p has a strictly smaller angle than q, measured from the reference in
    /// [0, 2 pi).
    [[nodiscard]] bool before(const Side& p, const Side& q) const {
        if (p.triangle == q.triangle) return false;
        const int a = sector(p), b = sector(q);
        if (a != b) return a < b;
        if (const Sign s = turn(p, q); s != Sign::Zero) return s == Sign::Positive;
        throw std::logic_error("two triangles overlap");
    }

private:
    /// Returns 0 for the angle 0 of the reference, 1 for angles below pi, 2 for pi, 3 above.
    [[nodiscard]] int sector(const Side& q) const {
        if (q.triangle == reference_.triangle) return 0;
        const Sign s = turn(reference_, q);
        return s == Sign::Positive ? 1 : s == Sign::Zero ? 2 : 3;
    }

    /// Returns Positive iff q is less than half a turn ahead of p, Zero iff it is opposite.
    [[nodiscard]] Sign turn(const Side& p, const Side& q) const {
        if (sheets_.parents != nullptr &&
            have_common_value((*sheets_.parents)[p.triangle], (*sheets_.parents)[q.triangle]))
            return Sign::Zero;
        const auto [a, b, c] = sheets_.triangles[q.triangle];
        const std::uint32_t apex = a ^ b ^ c ^ low_ ^ q.high; // the third corner
        const Sign side = side_of(upward_, sheets_, TriangleId(p.triangle), VertexId(apex));
        return runs_along(sheets_.triangles[p.triangle], low_, p.high) ? side : -side;
    }

    [[no_unique_address]] UpwardWitness upward_;
    const TriangleComplex& sheets_;
    std::uint32_t low_; ///< vertex of the edge
    const Side reference_;
};

/// Whether two triangles, which share an edge, run along it the same way.
bool run_alike(const Triangle& t, const Triangle& u) {
    for (unsigned i = 0; i < 3; ++i)
        for (unsigned j = 0; j < 3; ++j)
            if (t[i] == u[j] && t[(i + 1) % 3] == u[(j + 1) % 3]) return true;
    return false;
}

} // namespace

void sort_round_edge(UpwardWitness upward, const TriangleComplex& sheets, std::uint32_t low,
                     std::span<Side> sides) {
    if (sides.size() < 3) return;
    const Directions directions(upward, sheets, low, sides[0]);
    std::sort(sides.begin(), sides.end(),
              [&](const Side& p, const Side& q) { return directions.before(p, q); });
}

void join_round_edges(const TriangleComplex& sheets, DisjointSets& sides) {
    const UpwardRounding guard;
    std::vector<Side> round;
    sheets.edges.for_each([&](std::uint32_t low, std::uint32_t, std::span<const Side> at_edge) {
        const auto join = [&](std::uint32_t a, std::uint32_t b) { sides.join(a, b); };
        if (at_edge.size() < 3) return join_round_edge(sheets, low, at_edge, join);
        round.assign(at_edge.begin(), at_edge.end());
        sort_round_edge(guard, sheets, low, round);
        join_round_edge(sheets, low, round, join);
    });
}

void join_round_edges(const TriangleComplex& sheets, const Adjacency& adjacency,
                      DisjointSets& sides) {
    for (const auto& inner : adjacency.inner)
        for (const auto& [t, u] : inner) {
            const bool turned = run_alike(sheets.triangles[t], sheets.triangles[u]);
            sides.join(front_of(t), turned ? back_of(u) : front_of(u));
            sides.join(back_of(t), turned ? front_of(u) : back_of(u));
        }
    const UpwardRounding guard;
    std::vector<Side> round;
    for (std::size_t e = 0; e < adjacency.edges.size(); ++e) {
        const auto& [low, high] = adjacency.edges[e];
        round.clear();
        for (const std::uint32_t t : adjacency.triangles_at[e]) round.push_back({high, t});
        sort_round_edge(guard, sheets, low, round);
        join_round_edge(sheets, low, round,
                        [&](std::uint32_t a, std::uint32_t b) { sides.join(a, b); });
    }
}

} // namespace terrane::volumes
