// SPDX-License-Identifier: LGPL-3.0-or-later
#include "damages.hpp"

#include <limits>
#include <utility>

namespace test_support {
namespace {

using Made = std::optional<Surface>;

Point3 plus(const Point3& p, const Point3& d) {
    return {p.x + d.x, p.y + d.y, p.z + d.z};
}
Point3 times(double f, const Point3& p) {
    return {f * p.x, f * p.y, f * p.z};
}
Point3 middle(const Point3& p, const Point3& q) {
    return {(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2};
}
std::uint32_t add_vertex(Surface& s, const Point3& p) {
    s.vertices.push_back(p);
    return static_cast<std::uint32_t>(s.vertices.size() - 1);
}
Point3 centre(const Surface& s, std::uint32_t t) {
    const auto [a, b, c] = s.triangles[t];
    return times(1.0 / 3, plus(plus(s.vertices[a], s.vertices[b]), s.vertices[c]));
}
/// A normal of length 1.
Point3 unit_normal(const Surface& s, std::uint32_t t) {
    const Point3 n = DamagePlaces(s).normal(t);
    return times(1 / std::hypot(n.x, n.y, n.z), n);
}
/// Removes triangles.
void drop(Surface& s, const std::set<std::uint32_t>& which) {
    std::vector<Triangle> kept;
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t)
        if (!which.contains(t)) kept.push_back(s.triangles[t]);
    s.triangles = std::move(kept);
}
/// The largest triangle.
std::uint32_t largest(const Surface& s) {
    std::uint32_t best = 0;
    double most = -1;
    const DamagePlaces places(s);
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
        const Point3 n = places.normal(t);
        if (const double area = std::hypot(n.x, n.y, n.z); area > most) {
            most = area;
            best = t;
        }
    }
    return best;
}
void replace(Surface& s, std::uint32_t t, std::uint32_t from, std::uint32_t to) {
    std::replace(s.triangles[t].begin(), s.triangles[t].end(), from, to);
}

// --- damages with a size

Made move_corner(Surface s, double by) {
    const auto v = DamagePlaces(s).corner();
    if (!v) return std::nullopt;
    s.vertices[*v] = plus(s.vertices[*v], {by, by, by});
    return s;
}
/// Half of the triangles of a vertex get a copy of it.
Made crack(Surface s, double by) {
    const DamagePlaces places(s);
    const auto v = places.corner();
    if (!v) return std::nullopt;
    const auto w = add_vertex(s, plus(s.vertices[*v], {by, 0, by}));
    std::size_t n = 0;
    for (const std::uint32_t t : places.around.at(*v))
        if (n++ < places.around.at(*v).size() / 2) replace(s, t, *v, w);
    return s;
}
/// One triangle gets other corners than its neighbours, all at once.
Made detach(Surface s, double by) {
    const std::uint32_t t = largest(s);
    for (std::uint32_t& v : s.triangles[t]) v = add_vertex(s, plus(s.vertices[v], {by, by, -by}));
    return s;
}
/// A copy of a triangle floats above it.
Made second_sheet(Surface s, double by) {
    const std::uint32_t t = largest(s);
    const Point3 up = times(by, unit_normal(s, t));
    Triangle copy = s.triangles[t];
    for (std::uint32_t& v : copy) v = add_vertex(s, plus(s.vertices[v], up));
    s.triangles.push_back(copy);
    return s;
}
/// A triangle becomes three that rise to a point above it; `keep` leaves it there as well.
Made bubble(Surface s, double by, bool keep) {
    const std::uint32_t t = largest(s);
    const auto [a, b, c] = s.triangles[t];
    const auto top = add_vertex(s, plus(centre(s, t), times(by, unit_normal(s, t))));
    if (!keep) drop(s, {t});
    s.triangles.insert(s.triangles.end(), {{a, b, top}, {b, c, top}, {c, a, top}});
    return s;
}
/// A triangle hangs on an edge, in no plane of its triangles.
Made fin(Surface s, double by) {
    const DamagePlaces places(s);
    const auto& [edge, triangles] = *places.edges.begin();
    const Point3 up = times(by, unit_normal(s, triangles[0]));
    const auto top = add_vertex(s, plus(middle(s.vertices[edge[0]], s.vertices[edge[1]]), up));
    s.triangles.push_back({edge[0], edge[1], top});
    return s;
}
Made shift_all(Surface s, double by) {
    for (Point3& p : s.vertices) p = plus(p, {by, by, by});
    return s;
}
Made scale_all(Surface s, double by) {
    for (Point3& p : s.vertices) p = times(1 + by, p);
    return s;
}
/// Rounds coordinates to a multiple of `by`.
Made coarsen(Surface s, double by) {
    bool changed = false;
    for (Point3& p : s.vertices) {
        const Point3 q{std::round(p.x / by) * by, std::round(p.y / by) * by,
                       std::round(p.z / by) * by};
        changed = changed || std::max({std::abs(p.x - q.x), std::abs(p.y - q.y),
                                       std::abs(p.z - q.z)}) > by / 100;
        p = q;
    }
    return changed ? Made(std::move(s)) : std::nullopt;
}
/// A triangle floats far away.
Made stray(Surface s, double by) {
    const Point3 p = plus(s.vertices[s.triangles[0][0]], {30, 30, 30});
    const auto a = add_vertex(s, p), b = add_vertex(s, plus(p, {by, 0, 0})),
               c = add_vertex(s, plus(p, {0, by, 0}));
    s.triangles.push_back({a, b, c});
    return s;
}
/// Divides an edge of one triangle alone, at a point beside its middle.
Made gap_at_edge(Surface s, double by) {
    const auto edge = DamagePlaces(s).crease();
    if (!edge) return std::nullopt;
    const DamagePlaces places(s);
    const std::uint32_t t = places.edges.at(*edge)[0];
    const std::uint32_t w = places.third(t, (*edge)[0], (*edge)[1]);
    const Point3 m = middle(s.vertices[(*edge)[0]], s.vertices[(*edge)[1]]);
    const Point3& top = s.vertices[w];
    const auto v = add_vertex(s, plus(m, times(by, {top.x - m.x, top.y - m.y, top.z - m.z})));
    const Triangle whole = s.triangles[t];
    replace(s, t, (*edge)[0], v);
    Triangle other = whole;
    std::replace(other.begin(), other.end(), (*edge)[1], v);
    s.triangles.push_back(other);
    return s;
}

// --- damages without a size

Made flip_one(Surface s) {
    std::swap(s.triangles[largest(s)][0], s.triangles[largest(s)][1]);
    return s;
}
Made flip_all(Surface s) {
    for (Triangle& t : s.triangles) std::swap(t[0], t[1]);
    return s;
}
Made flip_half(Surface s) {
    for (std::size_t t = 0; t < s.triangles.size() / 2; ++t)
        std::swap(s.triangles[t][0], s.triangles[t][1]);
    return s;
}
Made drop_largest(Surface s) {
    drop(s, {largest(s)});
    return s;
}
Made drop_first(Surface s) {
    drop(s, {0});
    return s;
}
Made drop_last(Surface s) {
    s.triangles.pop_back();
    return s;
}
Made drop_half(Surface s) {
    s.triangles.resize(s.triangles.size() / 2);
    return s;
}
Made drop_all(Surface s) {
    s.triangles.clear();
    return s;
}
Made drop_fan(Surface s) {
    const DamagePlaces places(s);
    const auto v = places.corner();
    if (!v) return std::nullopt;
    drop(s, places.around.at(*v));
    return s;
}
Made drop_beside_junction(Surface s) {
    const DamagePlaces places(s);
    const auto edge = places.junction();
    if (!edge) return std::nullopt;
    drop(s, {places.edges.at(*edge)[0]});
    return s;
}
Made repeat_one(Surface s) {
    s.triangles.push_back(s.triangles[largest(s)]);
    return s;
}
Made repeat_turned(Surface s) {
    const auto [a, b, c] = s.triangles[largest(s)];
    s.triangles.push_back({b, a, c});
    return s;
}
Made repeat_with_own_vertices(Surface s) {
    Triangle t = s.triangles[largest(s)];
    for (std::uint32_t& v : t) v = add_vertex(s, s.vertices[v]);
    s.triangles.push_back(t);
    return s;
}
Made repeat_all(Surface s) {
    const auto all = s.triangles;
    s.triangles.insert(s.triangles.end(), all.begin(), all.end());
    return s;
}
Made repeat_smaller(Surface s) {
    const std::uint32_t t = largest(s);
    const Point3 c = centre(s, t);
    Triangle copy = s.triangles[t];
    for (std::uint32_t& v : copy) v = add_vertex(s, middle(s.vertices[v], c));
    s.triangles.push_back(copy);
    return s;
}
/// A triangle goes through another one.
Made pierce(Surface s) {
    const std::uint32_t t = largest(s);
    const Point3 c = centre(s, t), n = unit_normal(s, t);
    const auto a = add_vertex(s, plus(c, times(0.01, n))),
               b = add_vertex(s, plus(c, times(-0.01, n)));
    s.triangles.push_back({a, b, s.triangles[t][0]});
    return s;
}
Made no_area(Surface s) {
    const auto [a, b, c] = s.triangles[0];
    s.triangles.push_back({a, b, a});
    return s;
}
Made no_area_between_points(Surface s) {
    const Point3 p = s.vertices[s.triangles[0][0]];
    const auto a = add_vertex(s, p), b = add_vertex(s, plus(p, {1, 0, 0})),
               c = add_vertex(s, plus(p, {2, 0, 0}));
    s.triangles.push_back({a, b, c});
    return s;
}
Made unweld(Surface s) {
    const DamagePlaces places(s);
    const auto v = places.corner();
    if (!v) return std::nullopt;
    const auto w = add_vertex(s, s.vertices[*v]);
    replace(s, *places.around.at(*v).begin(), *v, w);
    return s;
}
Made unweld_all(Surface s) {
    Surface soup = s;
    soup.vertices.clear();
    for (Triangle& t : soup.triangles)
        for (std::uint32_t& v : t) v = add_vertex(soup, s.vertices[v]);
    return soup;
}
/// A vertex with a point one spacing beside it, for one triangle.
Made tear_by_spacing(Surface s) {
    const DamagePlaces places(s);
    const auto v = places.corner();
    if (!v) return std::nullopt;
    Point3 p = s.vertices[*v];
    p.z = std::nextafter(p.z, p.z + 1);
    const auto w = add_vertex(s, p);
    replace(s, *places.around.at(*v).begin(), *v, w);
    return s;
}
/// The other diagonal of a bent quadrilateral.
Made swap_diagonal(Surface s) {
    const DamagePlaces places(s);
    const auto edge = places.crease();
    if (!edge) return std::nullopt;
    const std::uint32_t t = places.edges.at(*edge)[0], u = places.edges.at(*edge)[1];
    const std::uint32_t a = places.third(t, (*edge)[0], (*edge)[1]),
                        b = places.third(u, (*edge)[0], (*edge)[1]);
    replace(s, t, (*edge)[0], b);
    replace(s, u, (*edge)[1], a);
    return s;
}
/// Joins the ends of an edge.
Made collapse(Surface s, const std::optional<std::array<std::uint32_t, 2>>& edge) {
    if (!edge) return std::nullopt;
    std::set<std::uint32_t> gone;
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
        replace(s, t, (*edge)[0], (*edge)[1]);
        const auto& k = s.triangles[t];
        if (k[0] == k[1] || k[1] == k[2] || k[2] == k[0]) gone.insert(t);
    }
    drop(s, gone);
    return s;
}
Made collapse_crease(Surface s) {
    const auto edge = DamagePlaces(s).crease();
    return collapse(std::move(s), edge);
}
Made collapse_junction(Surface s) {
    const auto edge = DamagePlaces(s).junction();
    return collapse(std::move(s), edge);
}
/// Two vertices far apart become one.
Made pinch(Surface s) {
    const auto v = DamagePlaces(s).corner();
    if (!v) return std::nullopt;
    std::uint32_t far = *v;
    const auto distance = [&](std::uint32_t w) {
        const Point3 &p = s.vertices[*v], &q = s.vertices[w];
        return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
    };
    for (const Triangle& t : s.triangles)
        for (const std::uint32_t w : t)
            if (distance(w) > distance(far)) far = w;
    return collapse(std::move(s), std::array{*v, far});
}
/// Two vertices change places.
Made exchange(Surface s) {
    const auto edge = DamagePlaces(s).crease();
    if (!edge) return std::nullopt;
    std::swap(s.vertices[(*edge)[0]], s.vertices[(*edge)[1]]);
    return s;
}
/// A triangle between vertices that have none.
Made wall_inside(Surface s) {
    const auto v = DamagePlaces(s).corner();
    if (!v) return std::nullopt;
    const Triangle& t = s.triangles[largest(s)];
    const Triangle& u = s.triangles[s.triangles.size() / 2];
    std::set<std::uint32_t> corners{*v, t[0], u[1]};
    if (corners.size() < 3) return std::nullopt;
    const auto has = [&](const Triangle& k) {
        return std::set<std::uint32_t>(k.begin(), k.end()) == corners;
    };
    if (std::ranges::any_of(s.triangles, has)) return std::nullopt;
    s.triangles.push_back({*v, t[0], u[1]});
    return s;
}
Made mirror(Surface s) {
    for (Point3& p : s.vertices) p.x = 20 - p.x;
    return s;
}
Made turn_axes(Surface s) {
    for (Point3& p : s.vertices) p = {p.y, p.z, p.x};
    return s;
}
Made to_float(Surface s) {
    bool changed = false;
    for (Point3& p : s.vertices) {
        const Point3 q{double(float(p.x)), double(float(p.y)), double(float(p.z))};
        changed = changed || q != p;
        p = q;
    }
    return changed ? Made(std::move(s)) : std::nullopt;
}
Made flatten(Surface s) {
    for (Point3& p : s.vertices) p.z = 0.25;
    return s;
}
Made wrong_vertex(Surface s) {
    const auto v = DamagePlaces(s).corner();
    if (!v) return std::nullopt;
    Triangle& t = s.triangles[largest(s)];
    if (std::ranges::count(t, *v) != 0) return std::nullopt;
    t[0] = *v;
    return s;
}

} // namespace

std::vector<MeshDamage> all_mesh_damages() {
    std::vector<MeshDamage> all;
    const auto sized = [&](const std::string& name, const std::string& breaks, auto make,
                           std::initializer_list<double> sizes) {
        for (const double by : sizes)
            all.push_back({name + " by " + std::to_string(std::log10(by)), breaks,
                           [make, by](Surface s) { return make(std::move(s), by); }});
    };
    sized("move a corner", "vertices", move_corner, {1e-12, 1e-10, 1e-8, 1e-6, 1e-3, 0.2});
    sized("crack at a vertex", "topology", crack, {1e-12, 1e-10, 1e-8, 1e-6, 1e-3});
    sized("detach a triangle", "topology", detach, {1e-12, 1e-9, 1e-6, 1e-2});
    sized("second sheet", "coverage", second_sheet, {1e-12, 1e-9, 1e-6, 1e-2});
    sized("bubble", "coverage",
          [](Surface s, double by) { return bubble(std::move(s), by, false); },
          {1e-12, 1e-9, 1e-6, 1e-2, 1});
    sized("pocket", "coverage", [](Surface s, double by) { return bubble(std::move(s), by, true); },
          {1e-12, 1e-9, 1e-6, 1e-2, 1});
    sized("fin", "coverage", fin, {1e-9, 1e-6, 1e-2, 1});
    sized("shift all", "vertices", shift_all, {1e-12, 1e-9, 1e-6, 1});
    sized("scale all", "vertices", scale_all, {1e-12, 1e-9, 1e-6, 1});
    sized("coarsen", "vertices", coarsen, {1e-11, 1e-9, 1e-6, 1e-3});
    sized("stray triangle", "coverage", stray, {1e-9, 1e-3, 1});
    sized("gap at an edge", "topology", gap_at_edge, {1e-12, 1e-9, 1e-6, 1e-2, 0.5});
    const std::vector<MeshDamage> others{
        {"flip one", "orientation", flip_one},
        {"flip all", "orientation", flip_all},
        {"flip half", "orientation", flip_half},
        {"drop the largest", "coverage", drop_largest},
        {"drop the first", "coverage", drop_first},
        {"drop the last", "coverage", drop_last},
        {"drop half", "coverage", drop_half},
        {"drop all", "coverage", drop_all},
        {"drop a fan", "coverage", drop_fan},
        {"drop beside a junction", "coverage", drop_beside_junction},
        {"repeat one", "distinct", repeat_one},
        {"repeat one, for coverage", "coverage", repeat_one},
        {"repeat one turned", "distinct", repeat_turned},
        {"repeat one with own vertices", "welded", repeat_with_own_vertices},
        {"repeat all", "distinct", repeat_all},
        {"repeat a smaller one", "coverage", repeat_smaller},
        {"pierce", "conforming", pierce},
        {"pierce, for coverage", "coverage", pierce},
        {"corner twice", "distinct", no_area},
        {"collinear", "distinct", no_area_between_points},
        {"unweld one", "welded", unweld},
        {"unweld all", "welded", unweld_all},
        {"tear by a spacing", "welded", tear_by_spacing},
        {"tear by a spacing, for topology", "topology", tear_by_spacing},
        {"swap a diagonal", "coverage", swap_diagonal},
        {"collapse a crease", "vertices", collapse_crease},
        {"collapse a junction", "vertices", collapse_junction},
        {"pinch", "topology", pinch},
        {"exchange vertices", "coverage", exchange},
        {"wall inside", "coverage", wall_inside},
        {"mirror", "coverage", mirror},
        {"turn axes", "coverage", turn_axes},
        {"to float32", "vertices", to_float},
        {"flatten", "coverage", flatten},
        {"wrong vertex", "coverage", wrong_vertex},
    };
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

} // namespace test_support
