// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/detail/borders.hpp>

#include <algorithm>
#include <utility>

#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::quality::detail {
namespace {

using Flat = std::array<double, 2>;

Flat flat(Axis axis, const Point3& p) {
    return axis == Axis::x ? Flat{p.y, p.z} : axis == Axis::y ? Flat{p.z, p.x} : Flat{p.x, p.y};
}

/// Adds a directed edge to a sum in which opposite edges cancel.
void add(std::vector<Edge>& sum, std::uint32_t from, std::uint32_t to) {
    const auto opposite = std::find(sum.begin(), sum.end(), Edge{to, from});
    if (opposite == sum.end()) {
        sum.push_back({from, to});
    } else {
        *opposite = sum.back();
        sum.pop_back();
    }
}

/// Tells whether a coordinate separates the boxes strictly.
bool boxes_apart(Axis axis, const Point3& a, const Point3& b, const std::array<Point3, 3>& t) {
    const Flat p = flat(axis, a), q = flat(axis, b);
    const std::array<Flat, 3> c{flat(axis, t[0]), flat(axis, t[1]), flat(axis, t[2])};
    for (std::size_t k = 0; k < 2; ++k) {
        if (std::max(p[k], q[k]) < std::min({c[0][k], c[1][k], c[2][k]})) return true;
        if (std::min(p[k], q[k]) > std::max({c[0][k], c[1][k], c[2][k]})) return true;
    }
    return false;
}

/// Tells whether a segment and a triangle are proven not to meet in the projection.
bool apart(Axis axis, const Point3& a, const Point3& b, const std::array<Point3, 3>& t) {
    if (boxes_apart(axis, a, b, t)) return true;
    const Sign first = orient2d(axis, a, b, t[0]);
    if (first != Sign::Zero && orient2d(axis, a, b, t[1]) == first &&
        orient2d(axis, a, b, t[2]) == first)
        return true;
    const Sign orientation = orient2d(axis, t[0], t[1], t[2]);
    for (std::size_t i = 0; i < 3; ++i) {
        const Point3 &from = t[i], &to = t[(i + 1) % 3];
        const Sign side = orient2d(axis, from, to, a);
        if (side == Sign::Zero || orient2d(axis, from, to, b) != side) continue;
        // A degenerate triangle lies in each of its lines.
        if (orientation == Sign::Zero || side != orientation) return true;
    }
    return false;
}

/// Tells whether the segment from corner `a` of the triangle a, p, q to b is proven to meet it in
/// `a` only.
bool apart_but_for(Axis axis, const Point3& a, const Point3& b, const Point3& p, const Point3& q) {
    const Flat at = flat(axis, a), end = flat(axis, b), r = flat(axis, p), s = flat(axis, q);
    for (std::size_t k = 0; k < 2; ++k)
        if ((end[k] < at[k] && r[k] >= at[k] && s[k] >= at[k]) ||
            (end[k] > at[k] && r[k] <= at[k] && s[k] <= at[k]))
            return true;
    const Sign orientation = orient2d(axis, a, p, q);
    const Sign to_p = orient2d(axis, a, p, b), to_q = orient2d(axis, a, q, b);
    if (orientation == Sign::Zero) return to_p != Sign::Zero && to_q != Sign::Zero;
    return (to_p != Sign::Zero && to_p != orientation) || to_q == orientation;
}

} // namespace

void Borders::find(std::span<const std::uint32_t> patch_of, std::size_t patches) {
    edges_.assign(patches, {});
    for (std::uint32_t t = 0; t < patch_of.size(); ++t) {
        if (patch_of[t] == no_group) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = mesh_.triangles[t][i], b = mesh_.triangles[t][(i + 1) % 3];
            const auto& at = mesh_.star[a];
            const bool is_inside = std::any_of(at.begin(), at.end(), [&](std::uint32_t u) {
                return u != t && patch_of[u] == patch_of[t] && has(mesh_.triangles[u], b);
            });
            if (!is_inside) edges_[patch_of[t]].push_back({a, b});
        }
    }
}

/// Sums the borders of the triangles that the patch gets, minus those that it loses.
void Borders::find_chain(const Change& change, std::span<const std::uint32_t> patch_of,
                         std::uint32_t patch, bool with_added, std::uint32_t name_of_old,
                         std::vector<Edge>& chain) const {
    chain.clear();
    if (with_added)
        for (std::size_t i = 0; i < change.added.size(); ++i)
            if (patch_of[change.from[i]] == patch)
                for (std::size_t k = 0; k < 3; ++k)
                    add(chain, change.added[i][k], change.added[i][(k + 1) % 3]);
    for (const std::uint32_t r : change.removed) {
        if (patch_of[r] != patch) continue;
        const Triangle t = with(mesh_.triangles[r], change.placed, name_of_old);
        for (std::size_t k = 0; k < 3; ++k) add(chain, t[(k + 1) % 3], t[k]);
    }
}

/// Orders the chain as a loop of three or four corners and divides it into triangles.
bool Borders::find_swept(const Change& change, Axis axis, Search& search) const {
    std::vector<Edge>& chain = search.chain_;
    std::vector<Swept>& swept = search.swept_;
    swept.clear();
    if (chain.empty()) return true;
    if (chain.size() < 3 || chain.size() > 4) return false;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const auto next =
            std::find_if(chain.begin() + static_cast<std::ptrdiff_t>(i) + 1, chain.end(),
                         [&](const Edge& e) { return e[0] == chain[i][1]; });
        if (next == chain.end()) return false;
        std::swap(*next, chain[i + 1]);
    }
    const auto corner = [&](const Edge& e) {
        return Corner{e[0], e[0] == old_place ? mesh_.points[change.placed]
                                              : change.point(mesh_.points, e[0])};
    };
    if (chain.size() == 3) {
        swept.push_back({corner(chain[0]), corner(chain[1]), corner(chain[2])});
        return true;
    }
    std::size_t old = 0;
    while (old < 4 && chain[old][0] != old_place) ++old;
    if (old == 4) return false;
    const Corner from = corner(chain[old]), a = corner(chain[(old + 1) % 4]),
                 to = corner(chain[(old + 2) % 4]), b = corner(chain[(old + 3) % 4]);
    if (to.name != change.placed) return false;
    swept.push_back({from, a, to});
    swept.push_back({from, to, b});
    if (orient2d(axis, a.point, to.point, b.point) != Sign::Zero) return true;
    const Flat p = flat(axis, a.point), m = flat(axis, to.point), q = flat(axis, b.point);
    for (std::size_t k = 0; k < 2; ++k)
        if ((p[k] < m[k] && m[k] < q[k]) || (p[k] > m[k] && m[k] > q[k])) return true;
    return false; // the chain would fold back on itself
}

bool Borders::keeps(const Change& change, std::span<const std::uint32_t> patch_of,
                    std::uint32_t patch, Axis axis, Search& search) const {
    find_chain(change, patch_of, patch, true, old_place, search.chain_);
    if (!find_swept(change, axis, search)) return false;
    if (search.swept_.empty()) return true;
    const auto goes = [&](const Edge& e) {
        return std::find(search.chain_.begin(), search.chain_.end(), Edge{e[1], e[0]}) !=
               search.chain_.end();
    };
    Flat low = flat(axis, search.swept_[0][0].point), high = low;
    for (const Swept& t : search.swept_)
        for (const Corner& c : t) {
            const Flat p = flat(axis, c.point);
            for (std::size_t k = 0; k < 2; ++k) {
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
        }
    return std::all_of(edges_[patch].begin(), edges_[patch].end(), [&](const Edge& e) {
        const Flat p = flat(axis, mesh_.points[e[0]]), q = flat(axis, mesh_.points[e[1]]);
        for (std::size_t k = 0; k < 2; ++k) // most edges are far away
            if (std::max(p[k], q[k]) < low[k] || std::min(p[k], q[k]) > high[k]) return true;
        const bool moves =
            change.placed != none && (e[0] == change.placed || e[1] == change.placed);
        // All edges at a vertex that moves are part of the change.
        return moves || goes(e) || stays_apart(e, axis, search);
    });
}

/// Tells whether an edge of the border touches the swept triangles at the ends of the chain only.
bool Borders::stays_apart(const Edge& e, Axis axis, const Search& search) const {
    const Point3 &a = mesh_.points[e[0]], &b = mesh_.points[e[1]];
    return std::all_of(search.swept_.begin(), search.swept_.end(), [&](const Swept& t) {
        const std::array<Point3, 3> c{t[0].point, t[1].point, t[2].point};
        const auto find = [&](std::uint32_t v) {
            std::size_t i = 0;
            while (i < 3 && t[i].name != v) ++i;
            return i;
        };
        const std::size_t i = find(e[0]), j = find(e[1]);
        if (i < 3 && j < 3) return false;
        if (i < 3) return apart_but_for(axis, a, b, c[(i + 1) % 3], c[(i + 2) % 3]);
        if (j < 3) return apart_but_for(axis, b, a, c[(j + 1) % 3], c[(j + 2) % 3]);
        return apart(axis, a, b, c);
    });
}

void Borders::update(const Change& change, std::span<const std::uint32_t> patch_of,
                     std::uint32_t patch, bool is_kept) {
    find_chain(change, patch_of, patch, is_kept, change.placed, chain_);
    for (const auto& [from, to] : chain_) add(edges_[patch], from, to);
}

} // namespace terrane::quality::detail
