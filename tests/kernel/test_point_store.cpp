// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests the laws of point_store.hpp by number, then compares all predicates and coordinates with
// exact integers.
#include "support/point_store_cases.hpp"

#include <terrane/kernel/predicates.hpp>

#include <catch2/catch.hpp>

namespace {

using namespace point_store_cases;

int order(const PointStore& store, PointIndex p, PointIndex q) {
    const auto c = store.compare(p, q);
    return c < 0 ? -1 : c > 0 ? 1 : 0;
}

bool on_planes(UpwardWitness upward, const PointStore& store, PointIndex p, int first, int count) {
    const auto v = store.construction(p).v;
    for (int i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(first + 3 * i);
        if (store.side_of_plane(upward, v[k], v[k + 1], v[k + 2], p) != Sign::Zero) return false;
    }
    return true;
}

bool lies_on_its_lines_and_planes(UpwardWitness upward, const PointStore& store, PointIndex p) {
    const Construction how = store.construction(p);
    if (how.kind == Kind::three_planes) return on_planes(upward, store, p, 0, 3);
    for (const Axis axis : axes)
        if (store.orient2d(upward, axis, how.v[0], how.v[1], p) != Sign::Zero) return false;
    if (how.kind == Kind::line_plane) return on_planes(upward, store, p, 2, 1);
    return store.orient2d(upward, how.axis, how.v[2], how.v[3], p) == Sign::Zero;
}

/// Constructs a point equal to input point `v`, by a line and a plane through it.
Construction copy_of(Random& random, std::uint32_t v, std::size_t inputs) {
    for (;;) {
        const auto w = pick(random, 4, inputs);
        if (std::find(w.begin(), w.end(), v) != w.end()) continue;
        Construction how;
        how.kind = Kind::line_plane;
        how.v = {v, w[0], v, w[1], w[2]};
        std::sort(how.v.begin(), how.v.begin() + 2);
        std::sort(how.v.begin() + 2, how.v.begin() + 5);
        return how;
    }
}

/// Compares d with numerator / denominator * 2^exponent: < 0, 0 or > 0; denominator > 0.
int compare(double d, const oracle::Int& numerator, const oracle::Int& denominator, int exponent) {
    if (std::isinf(d)) return d > 0 ? 1 : -1;
    const int unit = std::min(exponent, oracle::Binary(d).exponent);
    return cmp(oracle::Int(oracle::scaled(d, unit) * denominator),
               oracle::Int(numerator << static_cast<mp_bitcnt_t>(exponent - unit)));
}

bool enclosed(const Twins& t, PointIndex p) {
    const Enclosure e = t.store.enclosure(p);
    const oracle::Point& q = t.exact[p];
    const std::array coordinates{q.x, q.y, q.z};
    for (unsigned k = 0; k < 3; ++k)
        if (compare(e.low[k], coordinates[k], q.w, t.exponent) > 0 ||
            compare(e.high[k], coordinates[k], q.w, t.exponent) < 0)
            return false;
    return true;
}

/// Tells whether the errors are at least half a step between doubles, and 0 only where the
/// enclosure has no width.
bool errors_are_bounds(const Twins& t, PointIndex p) {
    const Enclosure e = t.store.enclosure(p);
    const Point3& n = t.store.nearest(p);
    const std::array nearest{n.x, n.y, n.z};
    const auto errors = t.store.rounding_errors(p);
    for (unsigned k = 0; k < 3; ++k) {
        double step = 0; // the larger of the two steps; none to infinity
        for (const double end : {e.low[k], e.high[k]})
            if (std::isfinite(end)) step = std::max(step, std::fabs(end - nearest[k]));
        if (std::isinf(nearest[k])) step = 0;
        if (e.low[k] == e.high[k] ? errors[k] != 0 : !(errors[k] > 0 && errors[k] >= step / 2))
            return false;
    }
    return true;
}

bool has_negative_zero(const Point3& p) {
    const auto is = [](double d) { return d == 0 && std::signbit(d); };
    return is(p.x) || is(p.y) || is(p.z);
}

bool nearest_is_right(const Twins& t, PointIndex p) {
    const Point3 n = t.store.nearest(p);
    if (!t.store.is_input(p) && has_negative_zero(n)) return false;
    const oracle::Point& q = t.exact[p];
    return oracle::is_nearest(n.x, q.x, q.w, t.exponent) &&
           oracle::is_nearest(n.y, q.y, q.w, t.exponent) &&
           oracle::is_nearest(n.z, q.z, q.w, t.exponent);
}

template <class Visit>
void for_twins(std::uint64_t seed, int count, const Visit& visit) {
    Random random(seed);
    for (const Family family : all_families)
        for (int i = 0; i < cases(count); ++i) {
            const Twins t = random_twins(random, family, 9, 8);
            const UpwardRounding guard;
            visit(guard, random, t);
        }
}

} // namespace

TEST_CASE("point store law 1: predicates agree with their namesakes on input points") {
    Random random(41);
    int copies = 0;
    for (const Family family : all_families)
        for (int i = 0; i < cases(60); ++i) {
            Twins t = twins_of(points_of(random, family, 8));
            std::vector<std::array<PointIndex, 2>> same; // input point and its constructed copy
            for (std::uint32_t v = 0; v < 8; ++v)
                if (append(t, copy_of(random, v, 8)))
                    same.push_back({v, static_cast<PointIndex>(t.store.size() - 1)});
            if (same.size() < 4) continue;
            ++copies;
            const UpwardRounding guard;
            const auto& s = t.store;
            const auto in = [&](unsigned k) -> const Point3& { return s.input(same[k][0]); };
            const auto c = [&](unsigned k) { return same[k][1]; };
            bool ok =
                s.orient3d(guard, c(0), c(1), c(2), c(3)) == orient3d(in(0), in(1), in(2), in(3)) &&
                s.orient3d(guard, c(0), same[1][0], c(2), same[3][0]) ==
                    orient3d(in(0), in(1), in(2), in(3)) &&
                s.side_of_plane(guard, same[0][0], same[1][0], same[2][0], c(3)) ==
                    orient3d(in(0), in(1), in(2), in(3));
            for (const Axis axis : axes)
                ok = ok &&
                     s.orient2d(guard, axis, c(0), c(1), c(2)) ==
                         orient2d(axis, in(0), in(1), in(2)) &&
                     s.in_circle(guard, axis, c(0), c(1), c(2), c(3)) ==
                         in_circle(axis, in(0), in(1), in(2), in(3)) &&
                     s.in_circle(guard, axis, same[0][0], same[1][0], same[2][0], same[3][0]) ==
                         in_circle(axis, in(0), in(1), in(2), in(3));
            for (const auto& [v, copy] : same) ok = ok && s.equal(v, copy);
            REQUIRE(ok);
        }
    CHECK(copies > cases(300));
}

TEST_CASE("point store law 1: permutations of constructed points") {
    for_twins(42, 100, [](UpwardWitness upward, Random& random, const Twins& t) {
        const auto& s = t.store;
        const PointIndex a = any_point(random, t), b = any_point(random, t),
                         c = any_point(random, t), d = any_point(random, t);
        const Sign volume = s.orient3d(upward, a, b, c, d);
        bool ok = s.orient3d(upward, b, a, c, d) == -volume &&
                  s.orient3d(upward, a, b, d, c) == -volume &&
                  s.orient3d(upward, b, c, a, d) == volume &&
                  s.orient3d(upward, a, b, c, a) == Sign::Zero;
        for (const Axis axis : axes) {
            const Sign turn_sign = s.orient2d(upward, axis, a, b, c),
                       circle_sign = s.in_circle(upward, axis, a, b, c, d);
            ok = ok && s.orient2d(upward, axis, b, c, a) == turn_sign &&
                 s.orient2d(upward, axis, c, b, a) == -turn_sign &&
                 s.in_circle(upward, axis, b, c, a, d) == circle_sign &&
                 s.in_circle(upward, axis, b, a, c, d) == -circle_sign &&
                 s.in_circle(upward, axis, a, b, c, b) == Sign::Zero;
        }
        REQUIRE(ok);
    });
}

TEST_CASE("point store law 2: constructed points lie on their lines and planes") {
    for_twins(43, 250, [](UpwardWitness upward, Random&, const Twins& t) {
        for (PointIndex p = 9; p < t.store.size(); ++p)
            REQUIRE(lies_on_its_lines_and_planes(upward, t.store, p));
    });
}

TEST_CASE("point store law 3: compare is the lexicographic order of the exact points") {
    int equal = 0;
    for_twins(44, 250, [&](UpwardWitness, Random&, const Twins& t) {
        bool ok = true;
        for (PointIndex p = 0; p < t.store.size(); ++p)
            for (PointIndex q = 0; q < t.store.size(); ++q) {
                const int c = order(t.store, p, q);
                ok = ok && c == oracle::compare(t.exact[p], t.exact[q]);
                equal += c == 0 && p < q;
            }
        REQUIRE(ok);
    });
    CHECK(equal > cases(2000)); // equal points with other constructions are common here
}

TEST_CASE("point store law 4: points on a line are ordered along it") {
    Random random(45);
    for (const Family family : all_families)
        for (int i = 0; i < cases(60); ++i) {
            Twins t = twins_of(points_of(random, family, 9));
            if (oracle::compare(t.exact[0], t.exact[1]) == 0) continue;
            for (int k = 0; k < 6; ++k) {
                Construction how = random_construction(random, 9);
                if (how.kind == Kind::three_planes) continue;
                how.v[0] = 0, how.v[1] = 1;
                append(t, how);
            }
            std::vector<PointIndex> line{0, 1};
            for (PointIndex p = 9; p < t.store.size(); ++p) line.push_back(p);
            const UpwardRounding guard;
            std::sort(line.begin(), line.end(),
                      [&](PointIndex p, PointIndex q) { return order(t.store, p, q) < 0; });
            // Steps along the line, times the weight; all steps have the same direction.
            const auto& a = t.exact[0];
            const auto& b = t.exact[1];
            const oracle::Row4 along{b.x - a.x, b.y - a.y, b.z - a.z, 0};
            const int ahead = oracle::compare(a, b) < 0 ? 1 : -1;
            for (std::size_t k = 0; k + 1 < line.size(); ++k) {
                const auto &p = t.exact[line[k]], &q = t.exact[line[k + 1]];
                const oracle::Int step =
                    oracle::value(along, q) * p.w - oracle::value(along, p) * q.w;
                REQUIRE(sgn(step) * ahead >= 0);
            }
        }
}

TEST_CASE(
    "point store law 5: nearest is correctly rounded, enclosures enclose, errors are bounds") {
    for_twins(46, 500, [](UpwardWitness, Random&, const Twins& t) {
        for (PointIndex p = 0; p < t.store.size(); ++p) {
            REQUIRE(nearest_is_right(t, p));
            REQUIRE(enclosed(t, p));
            REQUIRE(errors_are_bounds(t, p));
        }
    });
}

TEST_CASE("point store: enclosures have ends where intervals overflow") {
    // The crossing is nearer to the second point than doubles can resolve.
    Twins t = twins_of({{0, 0, -0x1p812}, {-1, 0, -1}, {-1, 0, 0}, {0, 0, 0}});
    Construction how;
    how.kind = Kind::line_line;
    how.axis = Axis::y;
    how.v = {0, 2, 1, 3};
    REQUIRE(append(t, how));
    CHECK(enclosed(t, 4));
    CHECK(nearest_is_right(t, 4));
    const Enclosure e = t.store.enclosure(4);
    for (unsigned k = 0; k < 3; ++k) CHECK(e.high[k] - e.low[k] < 1e-15);
}

TEST_CASE("orient2d, orient3d, in_circle and side_of_plane agree with exact integers") {
    for_twins(47, 250, [](UpwardWitness upward, Random& random, const Twins& t) {
        for (int i = 0; i < 12; ++i) {
            const PointIndex a = any_point(random, t), b = any_point(random, t),
                             c = any_point(random, t), d = any_point(random, t);
            const auto &p = t.exact[a], &q = t.exact[b], &r = t.exact[c], &s = t.exact[d];
            bool ok = t.store.orient3d(upward, a, b, c, d) == oracle::orient3d(p, q, r, s);
            ok = ok && t.store.side_of_plane(upward, 0, 1, 2, d) ==
                           oracle::orient3d(t.exact[0], t.exact[1], t.exact[2], s);
            for (const Axis axis : axes)
                ok = ok &&
                     t.store.orient2d(upward, axis, a, b, c) == oracle::orient2d(axis, p, q, r) &&
                     t.store.in_circle(upward, axis, a, b, c, d) ==
                         oracle::in_circle(axis, p, q, r, s);
            REQUIRE(ok);
        }
    });
}

TEST_CASE("one point has many constructions") {
    // (1, 1, 1) by a line and a plane, by three planes, by two lines, in thirds, and from other
    // vertices.
    const std::vector<Point3> input{{0, 0, 0}, {3, 3, 3}, {1, 0, 0}, {1, 5, 1}, {1, 0, 7},
                                    {0, 1, 0}, {5, 1, 1}, {0, 1, 7}, {0, 0, 1}, {7, 0, 1},
                                    {0, 7, 1}, {1, 1, 1}, {2, 2, 2}, {1, 1, 9}};
    PointStore store(input);
    const auto make = [](Kind kind, std::array<std::uint32_t, 9> v, Axis axis = Axis::x) {
        return Construction{kind, axis, v};
    };
    store.append(std::array{make(Kind::line_plane, {0, 1, 2, 3, 4}),
                            make(Kind::line_plane, {1, 12, 5, 6, 7}),
                            make(Kind::three_planes, {2, 3, 4, 5, 6, 7, 8, 9, 10}),
                            make(Kind::line_line, {0, 1, 11, 13}, Axis::x),
                            make(Kind::line_line, {11, 13, 0, 12}, Axis::y)});
    const UpwardRounding guard;
    for (PointIndex p = 14; p < store.size(); ++p) {
        CHECK(store.equal(11, p));
        CHECK(store.equal(p, 14));
        CHECK(store.nearest(p) == Point3{1, 1, 1});
        CHECK(store.rounding_errors(p) == std::array{0.0, 0.0, 0.0}); // though the parameter is 1/3
        CHECK(order(store, 0, p) == -1);
        CHECK(order(store, 12, p) == 1);
    }
}

TEST_CASE("a store can be copied, extended and thinned out") {
    Random random(48);
    Twins t = random_twins(random, Family::lattice, 9, 12);
    const auto constructed = static_cast<PointIndex>(t.store.size());
    REQUIRE(constructed > 13);
    const PointStore copy = t.store;
    std::vector<PointIndex> kept;
    for (PointIndex p = 9; p < constructed; p += 2) kept.push_back(p);
    t.store.keep_constructed(kept);
    REQUIRE(t.store.size() == 9 + kept.size());
    const UpwardRounding guard;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        const auto p = static_cast<PointIndex>(9 + k);
        CHECK(t.store.construction(p) == copy.construction(kept[k]));
        CHECK(t.store.nearest(p) == copy.nearest(kept[k]));
    }
    PointStore grown = t.store;
    grown.append(std::array{copy.construction(10)});
    CHECK(grown.nearest(static_cast<PointIndex>(grown.size() - 1)) == copy.nearest(10));
    for (PointIndex p = 0; p < 9; ++p) {
        CHECK(grown.is_input(p));
        CHECK(grown.construction(p).kind == Kind::input);
        CHECK(grown.construction(p).v[0] == p);
    }
}

TEST_CASE("interval predicates decide well-shaped constructed points, exact ones the rest") {
    Random random(49);
    const Twins t = random_twins(random, Family::uniform, 40, 200);
    const UpwardRounding guard;
    const PredicateCounts before = predicate_counts();
    for (int i = 0; i < 2000; ++i)
        (void)t.store.orient3d(guard, any_point(random, t), any_point(random, t),
                               any_point(random, t), any_point(random, t));
    const PredicateCounts random_ones = predicate_counts() - before;
    CHECK(random_ones.interval > 20 * random_ones.exact);
    const PredicateCounts start = predicate_counts();
    for (PointIndex p = 40; p < t.store.size(); ++p) {
        const auto v = t.store.construction(p).v;
        (void)t.store.orient3d(guard, v[2], v[3], v[4], p);
    }
    CHECK((predicate_counts() - start).exact > 20);
}
