// SPDX-License-Identifier: LGPL-3.0-or-later
#include "forge_triangles.hpp"

#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace terrane::fuzz {

double moved(double x, unsigned how, unsigned amount) {
    const double sign = amount % 2 == 0 ? 1 : -1;
    switch (how % 4) {
    case 0:
        return std::nextafter(x, sign * 1e300);
    case 1:
        return x + sign * std::ldexp(1.0 + amount, -60);
    case 2:
        return x * (1 + sign * std::ldexp(1.0, -static_cast<int>(amount % 60)));
    default:
        return x == 0 ? -x : x + sign * amount;
    }
}

std::vector<Numbers> unpacked(const IndexLists<std::uint32_t>& lists) {
    std::vector<Numbers> result;
    for (std::size_t i = 0; i < lists.size(); ++i)
        result.emplace_back(lists[i].begin(), lists[i].end());
    return result;
}

IndexLists<std::uint32_t> packed(const std::vector<Numbers>& lists) {
    IndexLists<std::uint32_t> result;
    for (const Numbers& list : lists) result.push_back(list);
    return result;
}

void erase_at(IndexLists<std::uint32_t>& lists, std::size_t i) {
    auto all = unpacked(lists);
    erase_at(all, i);
    lists = packed(all);
}

namespace {

void drop_triangle(Part& p, std::size_t t) {
    erase_at(p.triangles, t);
    erase_at(p.parents_of, t);
    if (p.regions_of != nullptr) erase_at(*p.regions_of, t);
}

void add_triangle(Part& p, const Triangle& corners, std::size_t like) {
    const Numbers parents(p.parents_of[like].begin(), p.parents_of[like].end());
    p.triangles.push_back(corners);
    p.parents_of.push_back(parents);
    if (p.regions_of == nullptr) return;
    const Numbers regions((*p.regions_of)[like].begin(), (*p.regions_of)[like].end());
    p.regions_of->push_back(regions);
}

} // namespace

void divide(Part& p, const Arguments& n, std::uint32_t vertex, bool at_side) {
    const std::size_t s = pick(n.a, p.triangles.size());
    const Triangle whole = p.triangles[s];
    if (!at_side) {
        for (std::size_t i = 0; i < 3; ++i)
            add_triangle(p, {whole[i], whole[(i + 1) % 3], vertex}, s);
        drop_triangle(p, s);
        return;
    }
    const auto u = whole[n.b % 3], v = whole[(n.b + 1) % 3];
    for (std::size_t t = p.triangles.size(); t-- > 0;)
        for (std::size_t i = 0; i < 3; ++i) {
            const Triangle old = p.triangles[t];
            const auto from = old[i], to = old[(i + 1) % 3];
            if (!((from == u && to == v) || (from == v && to == u))) continue;
            add_triangle(p, {from, vertex, old[(i + 2) % 3]}, t);
            add_triangle(p, {vertex, to, old[(i + 2) % 3]}, t);
            drop_triangle(p, t);
            break;
        }
    if (p.intersection_edges == nullptr) return;
    auto& edges = *p.intersection_edges;
    if (std::erase(edges, Edge{std::min(u, v), std::max(u, v)}) == 0) return;
    edges.push_back({u, vertex});
    edges.push_back({v, vertex});
    std::sort(edges.begin(), edges.end());
}

void divide_at_middle(Part& p, const Arguments& n) {
    if (p.points == nullptr || p.triangles.empty()) return;
    const Triangle& t = p.triangles[pick(n.a, p.triangles.size())];
    if (std::ranges::any_of(t, [&](std::uint32_t v) { return v >= p.points->size(); })) return;
    const Point3 u = (*p.points)[t[n.b % 3]], v = (*p.points)[t[(n.b + 1) % 3]],
                 w = (*p.points)[t[(n.b + 2) % 3]];
    const bool at_side = n.c % 2 == 0;
    p.points->push_back(
        at_side ? Point3{(u.x + v.x) / 2, (u.y + v.y) / 2, (u.z + v.z) / 2}
                : Point3{(u.x + v.x + w.x) / 3, (u.y + v.y + w.y) / 3, (u.z + v.z + w.z) / 3});
    p.vertices = p.points->size();
    divide(p, n, static_cast<std::uint32_t>(p.vertices - 1), at_side);
}

namespace {

// --- Changes of one part ------------------------------------------------------------------------

/// Drops all triangles that have the parents of one.
void drop_parent(Part& p, const Arguments& n) {
    const auto parents = p.parents_of[pick(n.a, p.triangles.size())];
    const Numbers gone(parents.begin(), parents.end());
    for (std::size_t t = p.triangles.size(); t-- > 0;)
        if (std::ranges::equal(p.parents_of[t], gone)) drop_triangle(p, t);
}

/// Drops all triangles that hang together with one.
void drop_component(Part& p, const Arguments& n) {
    std::set<std::uint32_t> reached(p.triangles[pick(n.a, p.triangles.size())].begin(),
                                    p.triangles[pick(n.a, p.triangles.size())].end());
    for (std::size_t before = 0; before != reached.size();) {
        before = reached.size();
        for (const Triangle& t : p.triangles)
            if (std::ranges::any_of(t, [&](auto v) { return reached.contains(v); }))
                reached.insert(t.begin(), t.end());
    }
    for (std::size_t t = p.triangles.size(); t-- > 0;)
        if (reached.contains(p.triangles[t][0])) drop_triangle(p, t);
}

void change_parents(Part& p, const Arguments& n) {
    auto lists = unpacked(p.parents_of);
    Numbers& list = lists[pick(n.a, lists.size())];
    switch (n.b % 4) {
    case 0:
        std::swap(list, lists[pick(n.c, lists.size())]);
        break;
    case 1:
        list.push_back(n.c % 16);
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
        break;
    case 2:
        if (list.size() > 1) erase_at(list, pick(n.c, list.size()));
        break;
    default:
        list = lists[pick(n.c, lists.size())];
    }
    p.parents_of = packed(lists);
}

/// Exchanges the diagonal of two triangles that share an edge and their parents.
void flip_diagonal(Part& p, const Arguments& n) {
    const std::size_t s = pick(n.a, p.triangles.size());
    for (std::size_t t = 0; t < p.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3 && t != s; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const auto a = p.triangles[s][i], b = p.triangles[s][(i + 1) % 3];
                if (a != p.triangles[t][(j + 1) % 3] || b != p.triangles[t][j] ||
                    !std::ranges::equal(p.parents_of[s], p.parents_of[t]))
                    continue;
                const auto c = p.triangles[s][(i + 2) % 3], d = p.triangles[t][(j + 2) % 3];
                p.triangles[s] = {c, a, d};
                p.triangles[t] = {d, b, c};
                return;
            }
}

void change_edges(Part& p, const Arguments& n) {
    if (p.intersection_edges == nullptr) return;
    auto& edges = *p.intersection_edges;
    if (n.b % 2 == 0) {
        if (!edges.empty()) erase_at(edges, pick(n.a, edges.size()));
        return;
    }
    const Triangle& t = p.triangles[pick(n.a, p.triangles.size())];
    const auto [low, high] = std::minmax(t[n.c % 3], t[(n.c + 1) % 3]);
    edges.push_back({low, high});
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

void merge_vertices(Part& p, const Arguments& n) {
    const auto from = static_cast<std::uint32_t>(pick(n.a, p.vertices));
    const auto to = static_cast<std::uint32_t>(pick(n.b, p.vertices));
    for (Triangle& t : p.triangles) std::replace(t.begin(), t.end(), from, to);
}

void move_point(Part& p, const Arguments& n) {
    if (p.points == nullptr || p.points->empty()) return;
    Point3& point = (*p.points)[pick(n.a, p.points->size())];
    double& x = n.b % 3 == 0 ? point.x : n.b % 3 == 1 ? point.y : point.z;
    x = moved(x, n.c, n.d);
}

/// Exchanges two vertices and the numbers by which triangles and edges name them.
void exchange_points(Part& p, const Arguments& n) {
    if (p.points == nullptr || p.points->empty()) return;
    const auto one = static_cast<std::uint32_t>(pick(n.a, p.points->size()));
    const auto other = static_cast<std::uint32_t>(pick(n.b, p.points->size()));
    std::swap((*p.points)[one], (*p.points)[other]);
    const auto rename = [&](std::uint32_t& v) {
        if (v == one || v == other) v = v == one ? other : one;
    };
    for (Triangle& t : p.triangles) std::ranges::for_each(t, rename);
    if (p.intersection_edges == nullptr) return;
    for (Edge& e : *p.intersection_edges) {
        std::ranges::for_each(e, rename);
        std::sort(e.begin(), e.end());
    }
    std::sort(p.intersection_edges->begin(), p.intersection_edges->end());
}

const std::array<PartChange, 17> all_part_changes{{
    {"triangle dropped",
     [](Part& p, const Arguments& n) { drop_triangle(p, pick(n.a, p.triangles.size())); }},
    {"triangle added",
     [](Part& p, const Arguments& n) {
         const auto vertex = [&](unsigned k) {
             return static_cast<std::uint32_t>(pick(k, p.vertices));
         };
         add_triangle(p, {vertex(n.b), vertex(n.c), vertex(n.d)}, pick(n.a, p.triangles.size()));
     }},
    {"triangle repeated",
     [](Part& p, const Arguments& n) {
         const std::size_t t = pick(n.a, p.triangles.size());
         add_triangle(p, p.triangles[t], t);
     }},
    {"triangle turned over",
     [](Part& p, const Arguments& n) {
         Triangle& t = p.triangles[pick(n.a, p.triangles.size())];
         std::swap(t[0], t[1]);
     }},
    {"all turned over",
     [](Part& p, const Arguments&) {
         for (Triangle& t : p.triangles) std::swap(t[0], t[1]);
     }},
    {"corner changed",
     [](Part& p, const Arguments& n) {
         p.triangles[pick(n.a, p.triangles.size())][n.b % 3] =
             static_cast<std::uint32_t>(pick(n.c, p.vertices + 1));
     }},
    {"triangles exchanged",
     [](Part& p, const Arguments& n) {
         std::swap(p.triangles[pick(n.a, p.triangles.size())],
                   p.triangles[pick(n.b, p.triangles.size())]);
     }},
    {"corners rotated",
     [](Part& p, const Arguments& n) {
         Triangle& t = p.triangles[pick(n.a, p.triangles.size())];
         std::rotate(t.begin(), t.begin() + 1, t.end());
     }},
    {"parent dropped", drop_parent},
    {"component dropped", drop_component},
    {"parents changed", change_parents},
    {"diagonal exchanged", flip_diagonal},
    {"intersection edges changed", change_edges},
    {"vertices merged", merge_vertices},
    {"vertex moved", move_point},
    {"vertices exchanged, and their numbers", exchange_points},
    {"vertex added in the middle", divide_at_middle},
}};

} // namespace

std::span<const PartChange> part_changes() {
    return all_part_changes;
}

} // namespace terrane::fuzz
