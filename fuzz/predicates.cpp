// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: every predicate has the sign that exact integers give, for input points and constructed
// points; for input points CGAL's exact kernel agrees.
#include "bytes.hpp"
#include "report.hpp"

#include "support/point_store_cases.hpp"

#include <terrane/kernel/predicates.hpp>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <cmath>

using namespace terrane;
using fuzz::Bytes;
using fuzz::require;
using point_store_cases::Twins;
using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;
using Kind = Construction::Kind;

namespace {

Axis any_axis(Bytes& bytes) {
    return static_cast<Axis>(bytes.below(3));
}

/// Returns a small integer or a neighbour of one; sometimes any finite double.
double coordinate(Bytes& bytes) {
    const unsigned kind = bytes.byte();
    const double integer = bytes.between(-8, 8);
    if (kind < 128) return integer;
    if (kind < 160) return std::nextafter(integer, HUGE_VAL);
    if (kind < 192) return std::nextafter(integer, -HUGE_VAL);
    if (kind < 208) return integer * 0.1;
    if (kind < 224) return 4200000 + integer * 0.01;
    if (kind < 248) return std::ldexp(integer, bytes.between(-60, 60));
    const double any =
        kind < 252 ? std::ldexp(integer, 8 * bytes.between(-128, 125)) : bytes.any_double();
    return std::isfinite(any) ? any : integer;
}

/// Returns points which, half of the time, are in a plane as nearly as doubles allow.
std::vector<Point3> input_points(Bytes& bytes) {
    std::vector<Point3> points(4 + bytes.below(5));
    const unsigned kind = bytes.byte();
    for (std::size_t i = 0; i < points.size(); ++i) {
        Point3& p = points[i];
        p = {coordinate(bytes), coordinate(bytes), coordinate(bytes)};
        if (i < 3 || kind % 4 != 0) continue;
        const double s = bytes.between(-4, 4) / 2.0, t = bytes.between(-4, 4) / (1.0 + kind / 128);
        const auto at = [&](double a, double b, double c, double off) {
            const double d = a + s * (b - a) + t * (c - a);
            if (!std::isfinite(d)) return off;
            return std::fabs(off) > 7 ? std::nextafter(d, off) : d;
        };
        p = {at(points[0].x, points[1].x, points[2].x, p.x),
             at(points[0].y, points[1].y, points[2].y, p.y),
             at(points[0].z, points[1].z, points[2].z, p.z)};
    }
    return points;
}

/// Picks different numbers below `inputs`, ascending.
void pick(Bytes& bytes, std::size_t inputs, std::span<std::uint32_t> into) {
    std::vector<std::uint32_t> all(inputs);
    for (std::uint32_t i = 0; i < inputs; ++i) all[i] = i;
    for (std::uint32_t& v : into) {
        const auto at = all.begin() + bytes.below(static_cast<unsigned>(all.size()));
        v = *at;
        all.erase(at);
    }
    std::sort(into.begin(), into.end());
}

Construction construction(Bytes& bytes, std::size_t inputs) {
    Construction how;
    how.kind = std::array{Kind::line_plane, Kind::three_planes, Kind::line_line}[bytes.below(3)];
    const std::span<std::uint32_t> v(how.v);
    if (how.kind == Kind::three_planes) {
        for (const std::size_t first : {0u, 3u, 6u}) pick(bytes, inputs, v.subspan(first, 3));
        return how;
    }
    pick(bytes, inputs, v.subspan(0, 2));
    pick(bytes, inputs, v.subspan(2, how.kind == Kind::line_plane ? 3 : 2));
    if (how.kind == Kind::line_line) how.axis = any_axis(bytes);
    return how;
}

Epeck::Point_2 projected(Axis axis, const Point3& p) {
    if (axis == Axis::x) return {p.y, p.z};
    if (axis == Axis::y) return {p.z, p.x};
    return {p.x, p.y};
}

Epeck::Point_3 epeck(const Point3& p) {
    return {p.x, p.y, p.z};
}

Sign sign(CGAL::Sign s) {
    return static_cast<Sign>(static_cast<int>(s));
}

void check_against_cgal(Axis axis, const std::array<Point3, 4>& p) {
    require(orient3d(p[0], p[1], p[2], p[3]) ==
                sign(CGAL::orientation(epeck(p[0]), epeck(p[1]), epeck(p[2]), epeck(p[3]))),
            "orient3d is not CGAL's");
    const std::array q{projected(axis, p[0]), projected(axis, p[1]), projected(axis, p[2]),
                       projected(axis, p[3])};
    require(orient2d(axis, p[0], p[1], p[2]) == sign(CGAL::orientation(q[0], q[1], q[2])),
            "orient2d is not CGAL's");
    require(in_circle(axis, p[0], p[1], p[2], p[3]) ==
                sign(CGAL::side_of_oriented_circle(q[0], q[1], q[2], q[3])),
            "in_circle is not CGAL's");
}

void check_projection_axis(const std::array<Point3, 4>& p, const std::array<oracle::Point, 4>& e) {
    const auto plane = oracle::plane(e[0], e[1], e[2]);
    const bool flat = plane[0] == 0 && plane[1] == 0 && plane[2] == 0;
    require(collinear(p[0], p[1], p[2]) == flat, "collinear is wrong");
    if (flat) return;
    unsigned longest = 2;
    for (const unsigned k : {0u, 1u})
        if (abs(plane[static_cast<std::size_t>(k)]) > abs(plane[static_cast<std::size_t>(longest)]))
            longest = k;
    require(projection_axis(p[0], p[1], p[2]) == static_cast<Axis>(longest),
            "projection_axis is not the longest");
}

void check_inputs(Bytes& bytes, const Twins& t) {
    std::array<Point3, 4> p;
    std::array<oracle::Point, 4> e;
    for (unsigned i = 0; i < 4; ++i) {
        const auto at = bytes.below(static_cast<unsigned>(t.store.input_count()));
        p[i] = t.store.input(at);
        e[i] = t.exact[at];
    }
    const Axis axis = any_axis(bytes);
    const Sign turn = oracle::orient2d(axis, e[0], e[1], e[2]);
    require(orient3d(p[0], p[1], p[2], p[3]) == oracle::orient3d(e[0], e[1], e[2], e[3]),
            "orient3d is wrong");
    require(orient2d(axis, p[0], p[1], p[2]) == turn, "orient2d is wrong");
    require(filtered_orient2d(axis, p[0], p[1], p[2]).value_or(turn) == turn,
            "quick_orient2d is wrong");
    require(turn2d(axis, p[0], p[1], p[2], p[3]) == oracle::turn2d(axis, e[0], e[1], e[2], e[3]),
            "turn2d is wrong");
    require(in_circle(axis, p[0], p[1], p[2], p[3]) ==
                oracle::in_circle(axis, e[0], e[1], e[2], e[3]),
            "in_circle is wrong");
    check_projection_axis(p, e);
    if (bytes.byte() % 4 == 0) check_against_cgal(axis, p);
}

/// Compares the fraction n / w * 2^exponent with a double.
int compare(const oracle::Int& n, const oracle::Int& w, int exponent, double d) {
    const auto scale = std::min({exponent, oracle::Binary(d).exponent, 0});
    return cmp(oracle::Int(n << static_cast<mp_bitcnt_t>(exponent - scale)),
               oracle::Int(oracle::scaled(d, scale) * w));
}

void check_place(const Twins& t, PointIndex p) {
    const oracle::Point& e = t.exact[p];
    const Enclosure box = t.store.enclosure(p);
    const std::array<const oracle::Int*, 3> numerator{&e.x, &e.y, &e.z};
    for (unsigned k = 0; k < 3; ++k)
        require(
            (std::isinf(box.low[k]) || compare(*numerator[k], e.w, t.exponent, box.low[k]) >= 0) &&
                (std::isinf(box.high[k]) ||
                 compare(*numerator[k], e.w, t.exponent, box.high[k]) <= 0),
            "the enclosure does not hold the point");
    const Point3 near = t.store.nearest(p);
    require(oracle::is_nearest(near.x, e.x, e.w, t.exponent) &&
                oracle::is_nearest(near.y, e.y, e.w, t.exponent) &&
                oracle::is_nearest(near.z, e.z, e.w, t.exponent),
            "nearest is not the nearest double");
}

void check_stored(Bytes& bytes, const Twins& t) {
    const UpwardRounding upward;
    const auto any = [&] { return bytes.below(static_cast<unsigned>(t.exact.size())); };
    const PointIndex a = any(), b = any(), c = any(), d = any();
    const auto e = [&](PointIndex p) -> const oracle::Point& { return t.exact[p]; };
    const Axis axis = any_axis(bytes);
    const auto order = t.store.compare(a, b);
    require((order > 0) - (order < 0) == oracle::compare(e(a), e(b)), "compare is wrong");
    require(t.store.orient2d(upward, axis, a, b, c) == oracle::orient2d(axis, e(a), e(b), e(c)),
            "orient2d of stored points is wrong");
    require(t.store.orient3d(upward, a, b, c, d) == oracle::orient3d(e(a), e(b), e(c), e(d)),
            "orient3d of stored points is wrong");
    require(t.store.in_circle(upward, axis, a, b, c, d) ==
                oracle::in_circle(axis, e(a), e(b), e(c), e(d)),
            "in_circle of stored points is wrong");
    std::array<std::uint32_t, 3> plane{};
    pick(bytes, t.store.input_count(), plane);
    require(t.store.side_of_plane(upward, plane[0], plane[1], plane[2], d) ==
                oracle::orient3d(e(plane[0]), e(plane[1]), e(plane[2]), e(d)),
            "side_of_plane is wrong");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    Twins twins = point_store_cases::twins_of(input_points(bytes));
    for (unsigned tries = bytes.below(4); tries > 0; --tries)
        point_store_cases::append(twins, construction(bytes, twins.store.input_count()));
    for (unsigned queries = 1 + bytes.below(2); queries > 0; --queries) {
        check_inputs(bytes, twins);
        check_stored(bytes, twins);
    }
    check_place(twins, static_cast<PointIndex>(twins.exact.size() - 1));
    return 0;
}
