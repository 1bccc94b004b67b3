// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Judges how two triangles meet by CGAL's intersection in its exact kernel, and the positions of
// the points on them by exact integers.
#pragma once

#include "support/oracle.hpp"

#include <terrane/algorithms/intersection/intersection.hpp>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace contact_oracle {

using terrane::Axis;
using terrane::Construction;
using terrane::Contact;
using terrane::ContactPiece;
using terrane::Point3;
using terrane::Sign;
using terrane::Simplex;
using terrane::Triangle;
using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;
using Rational = CGAL::Exact_rational;
using Spot = std::array<Rational, 3>;
using Spots = std::vector<Spot>;

/// A set of distinct points, each with its exact twin.
struct Corners {
    std::vector<Point3> points;
    std::vector<oracle::Point> exact; ///< times 2^-exponent
    int exponent = 0;

    explicit Corners(std::vector<Point3> all) :
        points(std::move(all)), exact(oracle::points(points)),
        exponent(oracle::lowest_exponent(points)) {}

    [[nodiscard]] Epeck::Point_3 epeck(std::uint32_t i) const {
        return {points[i].x, points[i].y, points[i].z};
    }
    [[nodiscard]] Epeck::Triangle_3 epeck(const Triangle& t) const {
        return {epeck(t[0]), epeck(t[1]), epeck(t[2])};
    }
    [[nodiscard]] Rational rational(oracle::Int n, oracle::Int d) const {
        if (exponent > 0) n <<= static_cast<mp_bitcnt_t>(exponent);
        if (exponent < 0) d <<= static_cast<mp_bitcnt_t>(-exponent);
        mpq_class q(n, d);
        q.canonicalize();
        return Rational(q.get_mpq_t());
    }
    [[nodiscard]] Spot spot(const oracle::Point& p) const {
        return {rational(p.x, p.w), rational(p.y, p.w), rational(p.z, p.w)};
    }
};

inline Spot spot(const Epeck::Point_3& p) {
    const auto& e = CGAL::exact(p);
    return {e.x(), e.y(), e.z()};
}

inline bool collinear(const Spot& a, const Spot& b, const Spot& c) {
    for (unsigned k = 0; k < 3; ++k) {
        const unsigned u = (k + 1) % 3, v = (k + 2) % 3;
        if ((b[u] - a[u]) * (c[v] - a[v]) != (b[v] - a[v]) * (c[u] - a[u])) return false;
    }
    return true;
}

/// Returns the corners of a convex polygon, sorted, without those in line with their neighbours.
inline Spots extreme(const Spots& polygon) {
    Spots cycle;
    for (const Spot& p : polygon)
        if (cycle.empty() || cycle.back() != p) cycle.push_back(p);
    while (cycle.size() > 1 && cycle.front() == cycle.back()) cycle.pop_back();
    Spots kept;
    const std::size_t n = cycle.size();
    for (std::size_t i = 0; i < n; ++i)
        if (n < 3 || !collinear(cycle[(i + n - 1) % n], cycle[i], cycle[(i + 1) % n]))
            kept.push_back(cycle[i]);
    std::sort(kept.begin(), kept.end());
    return kept;
}

struct Collect {
    using result_type = Spots;
    using Polygon = std::vector<Epeck::Point_3>;
    Spots operator()(const Epeck::Point_3& p) const { return {spot(p)}; }
    Spots operator()(const Epeck::Segment_3& s) const {
        return {spot(s.source()), spot(s.target())};
    }
    Spots operator()(const Epeck::Triangle_3& t) const {
        return {spot(t[0]), spot(t[1]), spot(t[2])};
    }
    Spots operator()(const Polygon& polygon) const {
        Spots all;
        for (const auto& p : polygon) all.push_back(spot(p));
        return all;
    }
};

/// Returns the corners of the intersection.
inline Spots by_cgal(const Corners& corners, const Triangle& s, const Triangle& t) {
    const auto common = CGAL::intersection(corners.epeck(s), corners.epeck(t));
    return common ? extreme(boost::apply_visitor(Collect{}, *common)) : Spots{};
}

inline std::vector<std::uint32_t> shared_corners(const Triangle& s, const Triangle& t) {
    std::vector<std::uint32_t> shared;
    for (const std::uint32_t v : s)
        if (std::find(t.begin(), t.end(), v) != t.end()) shared.push_back(v);
    return shared;
}

inline Spots by_terrane(const Corners& corners, const Triangle& s, const Triangle& t,
                        const std::optional<Contact>& contact) {
    Spots spots;
    if (contact) {
        for (unsigned i = 0; i < contact->point_count; ++i)
            spots.push_back(corners.spot(oracle::construct(contact->points[i].how, corners.exact)));
    } else {
        for (const std::uint32_t v : shared_corners(s, t))
            spots.push_back(corners.spot(corners.exact[v]));
    }
    std::sort(spots.begin(), spots.end());
    return spots;
}

/// Tells whether p lies in the open simplex `place` of the triangle.
inline bool is_at(const Corners& corners, const oracle::Point& p, const Triangle& t,
                  Simplex place) {
    std::array<oracle::Point, 3> c;
    for (unsigned i = 0; i < 3; ++i) c[i] = corners.exact[t[i]];
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

inline bool places_are_right(const Corners& corners, const Triangle& s, const Triangle& t,
                             const Contact& contact) {
    for (unsigned i = 0; i < contact.point_count; ++i) {
        const auto p = oracle::construct(contact.points[i].how, corners.exact);
        if (!is_at(corners, p, s, contact.points[i].place[0]) ||
            !is_at(corners, p, t, contact.points[i].place[1]))
            return false;
    }
    return true;
}

inline bool lies_on_edge(Simplex p, unsigned e) {
    if (is_edge(p)) return edge_of(p) == e;
    return is_corner(p) && (corner_of(p) == e || corner_of(p) == (e + 1) % 3);
}

/// Checks that, if the triangles are coplanar, each edge of the other triangle that reaches
/// triangle k gives one piece, from its first point to its last one.
inline bool pieces_are_right(const Contact& c, unsigned k) {
    if (!c.coplanar)
        return c.piece_count[k] == 1 && c.point_count <= 2 && c.pieces[k][0].support == 3 &&
               c.pieces[k][0].ends[1] + 1 == c.point_count;
    unsigned pieces = 0;
    for (unsigned e = 0; e < 3; ++e) {
        std::set<unsigned> points;
        for (unsigned i = 0; i < c.point_count; ++i)
            if (lies_on_edge(c.points[i].place[1 - k], e)) points.insert(i);
        if (points.empty()) continue;
        if (pieces == c.piece_count[k]) return false;
        const ContactPiece& piece = c.pieces[k][pieces++];
        if (piece.support != e || points != std::set<unsigned>{piece.ends[0], piece.ends[1]})
            return false;
    }
    return pieces == c.piece_count[k];
}

using Named = std::set<std::pair<Construction, std::array<Simplex, 2>>>;

inline Named named(const Contact& c, bool swapped) {
    Named all;
    for (unsigned i = 0; i < c.point_count; ++i) {
        const auto& [a, b] = c.points[i].place;
        all.insert({c.points[i].how, swapped ? std::array{b, a} : std::array{a, b}});
    }
    return all;
}

inline bool same_when_swapped(const Corners& corners, const Triangle& s, const Triangle& t,
                              const std::optional<Contact>& contact) {
    const auto other = improper_contact(corners.points, t, s);
    if (contact.has_value() != other.has_value()) return false;
    return !contact || (named(*contact, false) == named(*other, true) &&
                        contact->coplanar == other->coplanar && contact->overlap == other->overlap);
}

/// Checks that rotating and reversing the corners changes only their numbers, not the points.
inline bool same_points_when_turned(const Corners& corners, const Triangle& s, const Triangle& t,
                                    const std::optional<Contact>& contact) {
    const auto other = improper_contact(corners.points, {s[1], s[2], s[0]}, {t[1], t[0], t[2]});
    if (contact.has_value() != other.has_value()) return false;
    if (!contact) return true;
    std::set<Construction> a, b;
    for (unsigned i = 0; i < contact->point_count; ++i) a.insert(contact->points[i].how);
    for (unsigned i = 0; i < other->point_count; ++i) b.insert(other->points[i].how);
    return a == b;
}

/// Describes a flaw in the contact of two triangles that differ in at least one corner; empty if
/// there is none.
inline std::string flaw(const Corners& corners, const Triangle& s, const Triangle& t,
                        const std::optional<Contact>& contact) {
    const Spots spots = by_terrane(corners, s, t, contact);
    if (spots != by_cgal(corners, s, t)) return "not the points of CGAL's intersection";
    if (!same_when_swapped(corners, s, t, contact)) return "another answer in the other order";
    if (!same_points_when_turned(corners, s, t, contact))
        return "another answer for turned corners";
    if (!contact) return "";
    if (contact->overlap != (spots.size() > 2)) return "overlap is wrong";
    if (!places_are_right(corners, s, t, *contact)) return "a point is not where it is said to be";
    if (!pieces_are_right(*contact, 0) || !pieces_are_right(*contact, 1)) return "pieces are wrong";
    return "";
}

} // namespace contact_oracle
