// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Random pairs of triangles of a small lattice, where every kind of contact is common, against
// CGAL's intersection in its exact kernel.
#include "../support/effort.hpp"
#include "../support/oracle.hpp"
#include "../support/points.hpp"

#include <terrane/algorithms/intersection.hpp>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <catch2/catch.hpp>

#include <map>
#include <set>

namespace {

using namespace terrane;
using namespace test_support;
using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;
using Points = std::vector<Epeck::Point_3>;

constexpr int width = 4; // lattice points per axis

struct Lattice {
    std::vector<Point3> points; ///< equal points are equal indices
    std::vector<oracle::Point> exact;

    Lattice() {
        for (int i = 0; i < width * width * width; ++i)
            points.push_back(
                {double(i % width), double(i / width % width), double(i / width / width)});
        exact = oracle::points(points);
    }
    [[nodiscard]] Epeck::Point_3 epeck(std::uint32_t i) const {
        return {points[i].x, points[i].y, points[i].z};
    }
    [[nodiscard]] Epeck::Triangle_3 epeck(const Triangle& t) const {
        return {epeck(t[0]), epeck(t[1]), epeck(t[2])};
    }
};

/// With area; of one plane z = 0, 1 in a third of the cases.
Triangle random_triangle(Random& random, const Lattice& lattice, bool flat) {
    const int end = flat ? width * width : width * width * width;
    for (;;) {
        Triangle t;
        for (auto& v : t) v = static_cast<std::uint32_t>(random_int(random, 0, end - 1));
        const auto n = oracle::plane(lattice.exact[t[0]], lattice.exact[t[1]], lattice.exact[t[2]]);
        if (n[0] != 0 || n[1] != 0 || n[2] != 0) return t;
    }
}

void sort_unique(Points& points) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
}

/// Without points between two others.
Points extreme(const Points& points) {
    Points kept;
    for (const auto& p : points) {
        bool between = false;
        for (const auto& a : points)
            for (const auto& b : points)
                between = between || (p != a && p != b && CGAL::collinear(a, p, b) &&
                                      CGAL::collinear_are_strictly_ordered_along_line(a, p, b));
        if (!between) kept.push_back(p);
    }
    return kept;
}

struct Collect {
    using result_type = Points;
    Points operator()(const Epeck::Point_3& p) const { return {p}; }
    Points operator()(const Epeck::Segment_3& s) const { return {s.source(), s.target()}; }
    Points operator()(const Epeck::Triangle_3& t) const { return {t[0], t[1], t[2]}; }
    Points operator()(const Points& polygon) const { return polygon; }
};

/// Corners of the common part.
Points by_cgal(const Lattice& lattice, const Triangle& s, const Triangle& t) {
    const auto common = CGAL::intersection(lattice.epeck(s), lattice.epeck(t));
    if (!common) return {};
    Points points = boost::apply_visitor(Collect{}, *common);
    sort_unique(points);
    return extreme(points);
}

Epeck::Point_3 epeck(const oracle::Point& p) {
    const Epeck::FT w(p.w.get_d()); // small integers
    return {Epeck::FT(p.x.get_d()) / w, Epeck::FT(p.y.get_d()) / w, Epeck::FT(p.z.get_d()) / w};
}

std::vector<std::uint32_t> shared_corners(const Triangle& s, const Triangle& t) {
    std::vector<std::uint32_t> shared;
    for (const std::uint32_t v : s)
        if (std::find(t.begin(), t.end(), v) != t.end()) shared.push_back(v);
    return shared;
}

Points by_terrane(const Lattice& lattice, const Triangle& s, const Triangle& t,
                  const std::optional<Contact>& contact) {
    Points points;
    if (contact) {
        for (unsigned i = 0; i < contact->point_count; ++i)
            points.push_back(epeck(oracle::construct(contact->points[i].how, lattice.exact)));
    } else {
        for (const std::uint32_t v : shared_corners(s, t)) points.push_back(lattice.epeck(v));
    }
    std::sort(points.begin(), points.end());
    return points;
}

/// Whether p lies on the triangle where `place` says.
bool is_at(const Lattice& lattice, const oracle::Point& p, const Triangle& t, Place place) {
    std::array<oracle::Point, 3> c;
    for (unsigned i = 0; i < 3; ++i) c[i] = lattice.exact[t[i]];
    if (is_corner(place)) return oracle::compare(p, c[corner_of(place)]) == 0;
    if (oracle::orient3d(c[0], c[1], c[2], p) != Sign::Zero) return false;
    for (const Axis axis : {Axis::z, Axis::x, Axis::y}) {
        const Sign turn = oracle::orient2d(axis, c[0], c[1], c[2]);
        if (turn == Sign::Zero) continue;
        for (unsigned e = 0; e < 3; ++e) {
            const Sign inside = turn * oracle::orient2d(axis, c[e], c[(e + 1) % 3], p);
            const bool on = is_edge(place) && edge_of(place) == e;
            if (inside != (on ? Sign::Zero : Sign::Positive)) return false;
        }
        return true;
    }
    return false;
}

bool places_are_right(const Lattice& lattice, const Triangle& s, const Triangle& t,
                      const Contact& contact) {
    for (unsigned i = 0; i < contact.point_count; ++i) {
        const auto p = oracle::construct(contact.points[i].how, lattice.exact);
        if (!is_at(lattice, p, s, contact.points[i].place[0]) ||
            !is_at(lattice, p, t, contact.points[i].place[1]))
            return false;
    }
    return true;
}

bool on_closed_edge(Place p, unsigned e) {
    if (is_edge(p)) return edge_of(p) == e;
    return is_corner(p) && (corner_of(p) == e || corner_of(p) == (e + 1) % 3);
}

/// Coplanar: each edge of the other triangle that reaches triangle k gives one piece, from its
/// first point to its last one.
bool pieces_are_right(const Contact& c, unsigned k) {
    if (!c.coplanar)
        return c.piece_count[k] == 1 && c.point_count <= 2 && c.pieces[k][0].support == 3 &&
               c.pieces[k][0].ends[1] + 1 == c.point_count;
    unsigned pieces = 0;
    for (unsigned e = 0; e < 3; ++e) {
        std::set<unsigned> points;
        for (unsigned i = 0; i < c.point_count; ++i)
            if (on_closed_edge(c.points[i].place[1 - k], e)) points.insert(i);
        if (points.empty()) continue;
        const ContactPiece& piece = c.pieces[k][pieces++];
        if (piece.support != e || points != std::set<unsigned>{piece.ends[0], piece.ends[1]})
            return false;
    }
    return pieces == c.piece_count[k];
}

using Named = std::set<std::pair<Construction, std::array<Place, 2>>>;

Named named(const Contact& c, bool swapped) {
    Named all;
    for (unsigned i = 0; i < c.point_count; ++i) {
        const auto [a, b] = c.points[i].place;
        all.insert({c.points[i].how, swapped ? std::array{b, a} : std::array{a, b}});
    }
    return all;
}

bool same_when_swapped(const Lattice& lattice, const Triangle& s, const Triangle& t,
                       const std::optional<Contact>& contact) {
    const auto other = improper_contact(lattice.points, t, s);
    if (contact.has_value() != other.has_value()) return false;
    return !contact || (named(*contact, false) == named(*other, true) &&
                        contact->coplanar == other->coplanar && contact->overlap == other->overlap);
}

/// Turning and reversing corners changes how they are numbered, not the points.
bool same_points_when_turned(const Lattice& lattice, const Triangle& s, const Triangle& t,
                             const std::optional<Contact>& contact) {
    const auto other = improper_contact(lattice.points, {s[1], s[2], s[0]}, {t[1], t[0], t[2]});
    if (contact.has_value() != other.has_value()) return false;
    if (!contact) return true;
    std::set<Construction> a, b;
    for (unsigned i = 0; i < contact->point_count; ++i) a.insert(contact->points[i].how);
    for (unsigned i = 0; i < other->point_count; ++i) b.insert(other->points[i].how);
    return a == b;
}

} // namespace

TEST_CASE("improper_contact agrees with CGAL's intersection on random lattice triangles") {
    const Lattice lattice;
    Random random(61);
    std::map<std::size_t, int> seen; // by number of common corners
    for (int i = 0; i < cases(100'000); ++i) {
        const bool flat = random_int(random, 0, 2) == 0;
        const Triangle s = random_triangle(random, lattice, flat);
        const Triangle t = random_triangle(random, lattice, flat);
        if (shared_corners(s, t).size() == 3) continue;
        const auto contact = improper_contact(lattice.points, s, t);
        const Points points = by_terrane(lattice, s, t, contact);
        INFO(s[0] << " " << s[1] << " " << s[2] << ", " << t[0] << " " << t[1] << " " << t[2]);
        REQUIRE(points == by_cgal(lattice, s, t));
        REQUIRE(same_when_swapped(lattice, s, t, contact));
        REQUIRE(same_points_when_turned(lattice, s, t, contact));
        if (!contact) continue;
        ++seen[points.size()];
        REQUIRE(contact->overlap == (points.size() > 2));
        REQUIRE(places_are_right(lattice, s, t, *contact));
        REQUIRE(pieces_are_right(*contact, 0));
        REQUIRE(pieces_are_right(*contact, 1));
    }
    for (std::size_t corners = 1; corners <= 6; ++corners) CHECK(seen[corners] > cases(50));
}
