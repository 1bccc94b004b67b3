// SPDX-License-Identifier: LGPL-3.0-or-later
#include "forge_changes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace terrane::fuzz {

namespace {

using Numbers = std::vector<std::uint32_t>;

/// What the exact part and the mesh of doubles have in common.
struct Part {
    std::vector<Triangle>& triangles;
    IndexLists<std::uint32_t>& parents_of;
    IndexLists<std::uint32_t>* regions_of; ///< of the doubles only
    std::vector<Edge>& intersection_edges;
    std::size_t vertices;
};

Part exact_part(Certificate& c) {
    return {c.exact.triangles, c.exact.parents_of, nullptr, c.exact.intersection_edges,
            c.exact.vertices.size()};
}

Part rounded_part(Certificate& c) {
    RoundedClaim& r = *c.rounded;
    return {r.triangles, r.parents_of, &r.regions_of, r.intersection_edges, r.vertices.size()};
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

template <class Item>
void erase_at(std::vector<Item>& items, std::size_t i) {
    items.erase(items.begin() + static_cast<std::ptrdiff_t>(i));
}

void erase_at(IndexLists<std::uint32_t>& lists, std::size_t i) {
    auto all = unpacked(lists);
    erase_at(all, i);
    lists = packed(all);
}

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

/// The arguments of a change.
struct Arguments {
    unsigned a, b, c, d;
};

std::size_t pick(unsigned number, std::size_t count) {
    return count == 0 ? 0 : number % count;
}

// --- Changes of one part ------------------------------------------------------------------------

/// Drops all triangles whose only parent is that of a triangle.
void drop_parent(Part& p, const Arguments& n) {
    const Numbers gone{p.parents_of[pick(n.a, p.triangles.size())].front()};
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

/// Divides a triangle, and with it those beyond its side, at a vertex.
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
    const Edge edge{std::min(u, v), std::max(u, v)};
    if (std::erase(p.intersection_edges, edge) > 0) {
        p.intersection_edges.push_back({u, vertex});
        p.intersection_edges.push_back({v, vertex});
        std::sort(p.intersection_edges.begin(), p.intersection_edges.end());
    }
}

void change_edges(Part& p, const Arguments& n) {
    auto& edges = p.intersection_edges;
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

struct PartChange {
    const char* name;
    void (*make)(Part&, const Arguments&);
};

/// Precondition: the part has triangles.
const std::array<PartChange, 14> part_changes{{
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
}};

// --- Changes of the whole -----------------------------------------------------------------------

void change_construction(Certificate& c, const Arguments& n) {
    if (c.exact.vertices.empty()) return;
    Construction& how = c.exact.vertices[pick(n.a, c.exact.vertices.size())];
    if (n.b % 4 == 0)
        how.kind = static_cast<Construction::Kind>(n.c % 4);
    else if (n.b % 4 == 1)
        std::swap(how, c.exact.vertices[pick(n.c, c.exact.vertices.size())]);
    else
        how.v[n.c % 9] = n.d % 64;
}

/// Moves a coordinate by some units in the last place, a part of itself, or a length.
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

void move_vertex(Certificate& c, const Arguments& n) {
    auto& vertices = c.rounded->vertices;
    if (vertices.empty()) return;
    Point3& p = vertices[pick(n.a, vertices.size())];
    double& x = n.b % 3 == 0 ? p.x : n.b % 3 == 1 ? p.y : p.z;
    x = moved(x, n.c, n.d);
}

void change_bounds(Certificate& c, const Arguments& n) {
    RoundedClaim& r = *c.rounded;
    const double factor = std::ldexp(1.0, static_cast<int>(n.b) - 64);
    if (n.a % 3 == 0) r.deviation *= factor;
    if (n.a % 3 == 1) r.deviation = r.deviation == 0 ? factor : r.deviation * (1 + factor);
    if (n.a % 3 != 2) return;
    if (r.max_move && n.c % 2 == 0)
        r.max_move.reset();
    else
        r.max_move = r.max_move.value_or(r.deviation) * factor;
}

void change_list(Numbers& list, const Arguments& n) {
    if (n.b % 2 == 0 && !list.empty()) {
        erase_at(list, pick(n.c, list.size()));
    } else {
        list.push_back(n.c % 64);
        std::sort(list.begin(), list.end());
    }
}

/// Lists as vanished what no triangle of the doubles names, as far as the bytes allow.
void list_vanished(Certificate& c, const Arguments&) {
    RoundedClaim& r = *c.rounded;
    std::size_t inputs = 0;
    for (const CertifiedInput& input : c.inputs)
        for (const CertifiedSurface& s : input.surfaces) inputs += s.triangles;
    r.vanished.clear();
    for (std::uint32_t t = 0; t < inputs; ++t)
        if (std::ranges::find(r.parents_of.values, t) == r.parents_of.values.end() &&
            !std::ranges::binary_search(c.exact.degenerate, t))
            r.vanished.push_back(t);
}

void drop_unused_vertices(Certificate& c, const Arguments&) {
    RoundedClaim& r = *c.rounded;
    Numbers number(r.vertices.size(), UINT32_MAX);
    for (const Triangle& t : r.triangles)
        for (const auto v : t)
            if (v < number.size()) number[v] = 0;
    std::vector<Point3> kept;
    for (std::size_t v = 0; v < number.size(); ++v)
        if (number[v] == 0) {
            number[v] = static_cast<std::uint32_t>(kept.size());
            kept.push_back(r.vertices[v]);
        }
    const auto renamed = [&](std::uint32_t v) { return v < number.size() ? number[v] : v; };
    for (Triangle& t : r.triangles)
        for (auto& v : t) v = renamed(v);
    std::erase_if(r.intersection_edges, [&](const Edge& e) {
        return renamed(e[0]) == UINT32_MAX || renamed(e[1]) == UINT32_MAX;
    });
    for (Edge& e : r.intersection_edges) e = {renamed(e[0]), renamed(e[1])};
    r.vertices = kept;
    r.max_move.reset();
}

void change_regions(Certificate& c, const Arguments& n) {
    auto& values = c.rounded->regions_of.values;
    if (values.empty()) return;
    if (n.b % 2 == 0)
        values[pick(n.a, values.size())] = n.c % 8;
    else
        std::swap(values[pick(n.a, values.size())], values[pick(n.c, values.size())]);
}

/// Adds a vertex to both parts, on a side of a triangle or within it: the exact one is the point of
/// any construction, the rounded one the middle of the side or of the triangle.
void add_vertex(Certificate& c, const Arguments& n) {
    RoundedClaim& r = *c.rounded;
    if (c.exact.triangles.empty() || r.triangles.empty()) return;
    const Triangle& t = r.triangles[pick(n.a, r.triangles.size())];
    const bool at_side = n.c % 2 == 0;
    const Point3 &u = r.vertices[t[n.b % 3]], &v = r.vertices[t[(n.b + 1) % 3]],
                 &w = r.vertices[t[(n.b + 2) % 3]];
    r.vertices.push_back(
        at_side ? Point3{(u.x + v.x) / 2, (u.y + v.y) / 2, (u.z + v.z) / 2}
                : Point3{(u.x + v.x + w.x) / 3, (u.y + v.y + w.y) / 3, (u.z + v.z + w.z) / 3});
    const auto& known = c.exact.vertices;
    Construction how = known[pick(n.d, known.size())];
    how.kind = static_cast<Construction::Kind>(1 + n.d % 3);
    for (std::size_t i = 0; i < 9; ++i) how.v[i] = (how.v[i] + n.d * static_cast<unsigned>(i)) % 8;
    c.exact.vertices.push_back(how);
    Part exact = exact_part(c), rounded = rounded_part(c);
    divide(exact, n, static_cast<std::uint32_t>(exact.vertices - 1), at_side);
    divide(rounded, n, static_cast<std::uint32_t>(rounded.vertices - 1), at_side);
}

/// Adds a vertex to the exact part, where a side of a triangle that runs between two input vertices
/// meets the plane through three more. The doubles stay as they are.
void add_exact_vertex(Certificate& c, const Arguments& n) {
    auto& vertices = c.exact.vertices;
    if (c.exact.triangles.empty() || !c.rounded) return;
    const Triangle& t = c.exact.triangles[pick(n.a, c.exact.triangles.size())];
    const Construction &u = vertices[t[n.b % 3]], &v = vertices[t[(n.b + 1) % 3]];
    if (u.kind != Construction::Kind::input || v.kind != Construction::Kind::input) return;
    std::size_t inputs = 0;
    for (const CertifiedInput& input : c.inputs)
        for (const CertifiedSurface& surface : input.surfaces) inputs += surface.vertices;
    const auto input = [&](unsigned k) { return static_cast<std::uint32_t>(pick(k, inputs)); };
    const Construction how{Construction::Kind::line_plane,
                           Axis::x,
                           {u.v[0], v.v[0], input(n.c), input(n.d), input(n.c + n.d + 1)}};
    vertices.push_back(how);
    Part exact = exact_part(c);
    divide(exact, n, static_cast<std::uint32_t>(exact.vertices - 1), true);
    c.rounded->max_move.reset();
}

void change_output(Certificate& c, const Arguments& n) {
    if (c.outputs.empty()) return;
    CertifiedOutput& output = c.outputs[0];
    switch (n.a % 4) {
    case 0:
        output.format = n.b % 2 == 0 ? "msh" : "off";
        break;
    case 1:
        if (!output.surfaces.empty())
            std::swap(output.surfaces[pick(n.b, output.surfaces.size())],
                      output.surfaces[pick(n.c, output.surfaces.size())]);
        break;
    case 2:
        c.outputs.clear();
        break;
    default:
        if (!output.surfaces.empty())
            output.surfaces[pick(n.b, output.surfaces.size())].role = static_cast<Role>(n.c % 4);
    }
}

struct Change {
    const char* name;
    void (*make)(Certificate&, const Arguments&);
};

const std::array<Change, 15> changes{{
    {"construction changed", change_construction},
    {"vertex moved", move_vertex},
    {"bounds changed", change_bounds},
    {"degenerate changed",
     [](Certificate& c, const Arguments& n) { change_list(c.exact.degenerate, n); }},
    {"vanished changed",
     [](Certificate& c, const Arguments& n) { change_list(c.rounded->vanished, n); }},
    {"what is missing listed as vanished", list_vanished},
    {"unused vertices dropped", drop_unused_vertices},
    {"regions changed", change_regions},
    {"vertex added to both parts", add_vertex},
    {"vertex added to the exact part", add_exact_vertex},
    {"output changed", change_output},
    {"conforming or not",
     [](Certificate& c, const Arguments&) { c.rounded->clean = !c.rounded->clean; }},
    {"doubles dropped", [](Certificate& c, const Arguments&) { c.rounded.reset(); }},
    {"duplicates changed",
     [](Certificate& c, const Arguments& n) {
         auto& list = c.exact.duplicates;
         if (n.a % 2 == 0 && !list.empty())
             erase_at(list, pick(n.b, list.size()));
         else
             list.push_back({n.b % 16, n.c % 16});
         std::sort(list.begin(), list.end());
     }},
    {"vertices exchanged",
     [](Certificate& c, const Arguments& n) {
         auto& list = c.rounded->vertices;
         if (!list.empty()) std::swap(list[pick(n.a, list.size())], list[pick(n.b, list.size())]);
     }},
}};

} // namespace

std::string change(Certificate& certificate, Bytes& bytes) {
    std::array<unsigned, bytes_of_change> byte{};
    for (unsigned& b : byte) b = bytes.byte();
    const unsigned which = byte[0], parts = byte[1];
    const Arguments n{byte[2] | byte[3] << 8U, byte[4], byte[5], byte[6]};
    if (!certificate.rounded) return "nothing";
    const std::size_t kind = which % (part_changes.size() + changes.size());
    if (kind >= part_changes.size()) {
        const Change& made = changes[kind - part_changes.size()];
        made.make(certificate, n);
        return made.name;
    }
    const PartChange& made = part_changes[kind];
    std::string name = made.name;
    if (Part p = exact_part(certificate); parts % 3 != 0 && !p.triangles.empty()) {
        made.make(p, n);
        name += ", exact";
    }
    if (Part p = rounded_part(certificate); parts % 3 != 1 && !p.triangles.empty()) {
        made.make(p, n);
        name += ", doubles";
    }
    return name;
}

} // namespace terrane::fuzz
