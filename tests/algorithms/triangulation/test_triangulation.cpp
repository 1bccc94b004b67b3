// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests FaceTriangulation on lattices, where points on a circle are common: the result covers the
// face, is constrained Delaunay, and is unique.
#include "support/effort.hpp"
#include "support/oracle.hpp"
#include "support/points.hpp"

#include <terrane/algorithms/triangulation/triangulation.hpp>
#include <terrane/kernel/predicates.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <stop_token>

namespace {

using namespace terrane;
using namespace test_support;

using Triangles = std::vector<Triangle>;
using Edges = std::map<std::array<std::uint32_t, 2>, std::vector<std::uint32_t>>;

struct Uv {
    std::int64_t u = 0, v = 0;
};

Uv operator-(Uv a, Uv b) {
    return {a.u - b.u, a.v - b.v};
}
std::int64_t cross(Uv a, Uv b) {
    return a.u * b.v - a.v * b.u;
}
std::int64_t turn(Uv a, Uv b, Uv c) {
    return cross(b - a, c - a);
}
int sign(std::int64_t i) {
    return i > 0 ? 1 : i < 0 ? -1 : 0;
}

/// A square lattice of input points in a tilted plane; (u, v) are the integer coordinates of a
/// point.
class Sheet {
public:
    Sheet(Random& random, int width) {
        const auto step = [&] { return double(random_int(random, -2, 2)); };
        Point3 e, f;
        do {
            e = point_of(step);
            f = point_of(step);
        } while (collinear({0, 0, 0}, e, f));
        std::vector<Point3> points;
        for (int v = 0; v < width; ++v)
            for (int u = 0; u < width; ++u) {
                uv_.push_back({u, v});
                points.push_back({u * e.x + v * f.x, u * e.y + v * f.y, u * e.z + v * f.z});
            }
        exact_ = oracle::points(points);
        axis = projection_axis({0, 0, 0}, e, f);
        store = PointStore(points);
        set_ranks();
    }

    [[nodiscard]] const Uv& uv(PointIndex p) const { return uv_[p]; }
    [[nodiscard]] const oracle::Point& exact(PointIndex p) const { return exact_[p]; }
    [[nodiscard]] PointIndex count() const { return static_cast<PointIndex>(uv_.size()); }

    PointStore store;
    std::vector<std::uint32_t> rank;
    Axis axis = Axis::z;

private:
    void set_ranks() {
        std::vector<PointIndex> order(uv_.size());
        std::iota(order.begin(), order.end(), 0u);
        std::sort(order.begin(), order.end(), [&](PointIndex a, PointIndex b) {
            return oracle::compare(exact_[a], exact_[b]) < 0;
        });
        rank.resize(order.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
    }

    std::vector<Uv> uv_;
    std::vector<oracle::Point> exact_;
};

/// Tells whether p lies strictly between a and b.
bool is_between(const Sheet& s, PointIndex p, PointIndex a, PointIndex b) {
    const Uv ab = s.uv(b) - s.uv(a), ap = s.uv(p) - s.uv(a);
    const std::int64_t along = ab.u * ap.u + ab.v * ap.v;
    return cross(ab, ap) == 0 && along > 0 && along < ab.u * ab.u + ab.v * ab.v;
}

/// Tells whether the open segments meet in a point, other than along a common line.
bool cross_inside(const Sheet& s, const Segment& a, const Segment& b) {
    const Uv p = s.uv(a[0]), q = s.uv(a[1]), r = s.uv(b[0]), t = s.uv(b[1]);
    return sign(turn(p, q, r)) * sign(turn(p, q, t)) < 0 &&
           sign(turn(r, t, p)) * sign(turn(r, t, q)) < 0;
}

std::vector<PointIndex> points_named(const FaceInput& face) {
    std::vector<PointIndex> all(face.corners.begin(), face.corners.end());
    for (const auto& e : face.edge_points) all.insert(all.end(), e.begin(), e.end());
    all.insert(all.end(), face.inner_points.begin(), face.inner_points.end());
    return all;
}

/// Adds points of the sheet on the triangle, each with the given probability in percent.
void add_points(Random& random, const Sheet& s, FaceInput& face, int percent) {
    const auto& c = face.corners;
    const int up = sign(turn(s.uv(c[0]), s.uv(c[1]), s.uv(c[2])));
    for (PointIndex p = 0; p < s.count(); ++p) {
        if (random_int(random, 0, 99) >= percent) continue;
        bool inside = true;
        for (unsigned e = 0; e < 3; ++e) {
            const auto a = c[e], b = c[(e + 1) % 3];
            if (is_between(s, p, a, b)) face.edge_points[e].push_back(p);
            inside = inside && up * turn(s.uv(a), s.uv(b), s.uv(p)) > 0;
        }
        if (inside) face.inner_points.push_back(p);
    }
    for (unsigned e = 0; e < 3; ++e)
        std::sort(face.edge_points[e].begin(), face.edge_points[e].end(),
                  [&](PointIndex a, PointIndex b) { return is_between(s, a, c[e], b); });
}

/// Adds segments that do not cross any other inside; they may overlap, and pass through points.
void add_segments(Random& random, const Sheet& s, FaceInput& face, int tries) {
    const auto points = points_named(face);
    for (int i = 0; i < tries; ++i) {
        const auto any = [&] {
            return points[static_cast<std::size_t>(
                random_int(random, 0, static_cast<int>(points.size()) - 1))];
        };
        const Segment segment{any(), any()};
        const bool free =
            std::none_of(face.segments.begin(), face.segments.end(),
                         [&](const Segment& other) { return cross_inside(s, segment, other); });
        // Crossings at lattice points that are not named are excluded as well: cross_inside() sees
        // them.
        if (segment[0] != segment[1] && free) face.segments.push_back(segment);
    }
}

FaceInput random_face(Random& random, const Sheet& s, int percent, int segments) {
    FaceInput face;
    face.axis = s.axis;
    do {
        for (auto& c : face.corners)
            c = static_cast<PointIndex>(random_int(random, 0, static_cast<int>(s.count()) - 1));
    } while (turn(s.uv(face.corners[0]), s.uv(face.corners[1]), s.uv(face.corners[2])) == 0);
    add_points(random, s, face, percent);
    add_segments(random, s, face, segments);
    return face;
}

Triangles triangulate(const Sheet& s, const FaceInput& face) {
    const UpwardRounding guard;
    FaceTriangulation triangulation(guard);
    const auto result = triangulation(s.store, s.rank, face);
    return {result.begin(), result.end()};
}

Triangles triangulate_in_order(const Sheet& s, const FaceInput& face) {
    const UpwardRounding guard;
    FaceTriangulation triangulation(guard);
    triangulation.divide(s.store, s.rank, face);
    const auto result = triangulation.in_order();
    return {result.begin(), result.end()};
}

Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

std::set<Triangle> as_set(const Triangles& triangles) {
    std::set<Triangle> all;
    for (const Triangle& t : triangles) all.insert(sorted(t));
    return all;
}

/// Returns the apexes opposite each edge.
Edges edges_of(const Triangles& triangles) {
    Edges edges;
    for (const Triangle& t : triangles)
        for (unsigned i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
            edges[{low, high}].push_back(t[(i + 2) % 3]);
        }
    return edges;
}

bool covers(const Sheet& s, const FaceInput& face, const Triangles& triangles) {
    const auto area = [&](const Triangle& t) { return turn(s.uv(t[0]), s.uv(t[1]), s.uv(t[2])); };
    const std::int64_t whole = area(face.corners);
    std::int64_t sum = 0;
    std::set<PointIndex> used;
    for (const Triangle& t : triangles) {
        if (sign(area(t)) != sign(whole)) return false;
        sum += area(t);
        used.insert(t.begin(), t.end());
    }
    const auto named = points_named(face);
    const std::size_t border =
        3 + face.edge_points[0].size() + face.edge_points[1].size() + face.edge_points[2].size();
    return sum == whole && used == std::set(named.begin(), named.end()) &&
           triangles.size() == 2 * face.inner_points.size() + border - 2;
}

/// Returns the edges of which a segment must be the union.
std::vector<Segment> steps_of(const Sheet& s, const FaceInput& face, const Segment& segment) {
    std::vector<PointIndex> on{segment[0], segment[1]};
    for (const PointIndex p : points_named(face))
        if (is_between(s, p, segment[0], segment[1])) on.push_back(p);
    std::sort(on.begin(), on.end(),
              [&](PointIndex a, PointIndex b) { return s.rank[a] < s.rank[b]; });
    std::vector<Segment> steps;
    for (std::size_t i = 0; i + 1 < on.size(); ++i) {
        const auto [low, high] = std::minmax(on[i], on[i + 1]);
        steps.push_back({low, high});
    }
    return steps;
}

std::set<Segment> constraints(const Sheet& s, const FaceInput& face) {
    std::set<Segment> all;
    for (const Segment& segment : face.segments)
        for (const Segment& step : steps_of(s, face, segment)) all.insert(step);
    return all;
}

bool is_constrained_delaunay(const Sheet& s, const FaceInput& face, const Triangles& triangles) {
    const auto fixed = constraints(s, face);
    for (const auto& [edge, apexes] : edges_of(triangles)) {
        if (apexes.size() > 2) return false;
        if (apexes.size() == 1 || fixed.contains(edge)) continue;
        const auto &a = s.exact(edge[0]), &b = s.exact(edge[1]), &c = s.exact(apexes[0]);
        const Sign up = oracle::orient2d(s.axis, a, b, c);
        if (up * oracle::in_circle(s.axis, a, b, c, s.exact(apexes[1])) == Sign::Positive)
            return false;
    }
    return true;
}

bool contains_segments(const Sheet& s, const FaceInput& face, const Triangles& triangles) {
    const Edges edges = edges_of(triangles);
    const auto fixed = constraints(s, face);
    return std::all_of(fixed.begin(), fixed.end(),
                       [&](const Segment& e) { return edges.contains(e); });
}

/// Returns the same face with its lists in another order, corners rotated, and reversed if asked.
FaceInput shuffled(Random& random, FaceInput face, bool reversed) {
    std::shuffle(face.inner_points.begin(), face.inner_points.end(), random);
    std::shuffle(face.segments.begin(), face.segments.end(), random);
    for (Segment& s : face.segments)
        if (random_int(random, 0, 1)) std::swap(s[0], s[1]);
    const auto turns = random_int(random, 0, 2);
    std::rotate(face.corners.begin(), face.corners.begin() + turns, face.corners.end());
    std::rotate(face.edge_points.begin(), face.edge_points.begin() + turns, face.edge_points.end());
    if (!reversed) return face;
    std::swap(face.corners[1], face.corners[2]); // edges 0 1, 1 2, 2 0 become 0 2, 2 1, 1 0
    std::swap(face.edge_points[0], face.edge_points[2]);
    for (auto& e : face.edge_points) std::reverse(e.begin(), e.end());
    return face;
}

/// Visits faces on small and larger sheets, sparse and full, with few and many segments.
template <class Visit>
void for_faces(std::uint64_t seed, int count, const Visit& visit) {
    Random random(seed);
    for (int i = 0; i < cases(count); ++i) {
        const Sheet sheet(random, random_int(random, 3, i % 50 == 0 ? 16 : 8));
        const int percent = std::array{15, 40, 100}[static_cast<std::size_t>(i % 3)];
        const int segments = random_int(random, 0, i % 20 == 0 ? 400 : 40);
        visit(random, sheet, random_face(random, sheet, percent, segments));
    }
}

} // namespace

TEST_CASE("face triangulation covers the triangle, contains its segments, is Delaunay elsewhere") {
    for_faces(71, 3000, [](Random&, const Sheet& sheet, const FaceInput& face) {
        const Triangles triangles = triangulate(sheet, face);
        REQUIRE(covers(sheet, face, triangles));
        REQUIRE(contains_segments(sheet, face, triangles));
        REQUIRE(is_constrained_delaunay(sheet, face, triangles));
    });
}

TEST_CASE("face triangulation does not depend on the order of anything") {
    for_faces(72, 3000, [](Random& random, const Sheet& sheet, const FaceInput& face) {
        const auto triangles = as_set(triangulate(sheet, face));
        for (const bool reversed : {false, true}) {
            const FaceInput other = shuffled(random, face, reversed);
            const Triangles again = triangulate(sheet, other);
            REQUIRE(as_set(again) == triangles);
            REQUIRE(covers(sheet, other, again)); // oriented as the corners
        }
    });
}

TEST_CASE("face triangulation is empty once a stop is requested") {
    std::stop_source stop;
    stop.request_stop();
    for_faces(78, 200, [&](Random&, const Sheet& sheet, const FaceInput& face) {
        FaceInput stopped = face;
        stopped.stop = stop.get_token();
        REQUIRE(triangulate(sheet, stopped).empty());
        REQUIRE(triangulate_in_order(sheet, stopped).empty());
    });
}

TEST_CASE("face triangulation: triangles in order start with their lowest corner and are sorted") {
    const auto check = [](Random& random, const Sheet& sheet, const FaceInput& face) {
        const Triangles triangles = triangulate_in_order(sheet, face);
        const auto ranks = [&](const Triangle& t) {
            return std::array{sheet.rank[t[0]], sheet.rank[t[1]], sheet.rank[t[2]]};
        };
        REQUIRE(as_set(triangles) == as_set(triangulate(sheet, face)));
        REQUIRE(covers(sheet, face, triangles));
        REQUIRE(triangles == triangulate_in_order(sheet, shuffled(random, face, false)));
        REQUIRE(std::ranges::is_sorted(triangles, {}, ranks));
        for (const Triangle& t : triangles) REQUIRE(std::ranges::min(ranks(t)) == sheet.rank[t[0]]);
    };
    for_faces(76, 2000, [&](Random& random, const Sheet& sheet, const FaceInput& face) {
        if (face.edge_points[0].empty() && face.edge_points[1].empty() &&
            face.edge_points[2].empty() && face.inner_points.empty()) {
            REQUIRE(triangulate_in_order(sheet, face) == Triangles{face.corners});
            return;
        }
        check(random, sheet, face);
    });
    Random random(77);
    for (int i = 0; i < 4; ++i) { // about 1 500 triangles
        const Sheet sheet(random, 40);
        FaceInput face;
        face.axis = sheet.axis;
        face.corners = {0, 39, 40 * 39};
        add_points(random, sheet, face, i == 0 ? 100 : 95);
        check(random, sheet, face);
    }
}

TEST_CASE("two coplanar triangles triangulate a common part in the same way") {
    Random random(73);
    int compared = 0;
    for (int i = 0; i < cases(12'000); ++i) {
        const Sheet sheet(random, 8);
        const FaceInput common = random_face(random, sheet, 60, 10);
        // Both triangles have the border of the common part.
        std::vector<Segment> border;
        for (unsigned e = 0; e < 3; ++e)
            border.push_back({common.corners[e], common.corners[(e + 1) % 3]});
        const auto inside = points_named(common);
        std::array<std::set<Triangle>, 2> parts;
        int built = 0;
        for (int tries = 0; tries < 100 && built < 2; ++tries) {
            FaceInput face = random_face(random, sheet, 0, 0);
            const int up = sign(turn(sheet.uv(face.corners[0]), sheet.uv(face.corners[1]),
                                     sheet.uv(face.corners[2])));
            const auto holds = [&](PointIndex p) {
                for (unsigned e = 0; e < 3; ++e)
                    if (up * turn(sheet.uv(face.corners[e]), sheet.uv(face.corners[(e + 1) % 3]),
                                  sheet.uv(p)) <
                        0)
                        return false;
                return true;
            };
            if (!std::all_of(common.corners.begin(), common.corners.end(), holds)) continue;
            // Both have all points of the common part, and others outside of it.
            FaceInput all = face;
            add_points(random, sheet, all, 100);
            const int side = sign(turn(sheet.uv(common.corners[0]), sheet.uv(common.corners[1]),
                                       sheet.uv(common.corners[2])));
            const auto wanted = [&](PointIndex p) {
                if (std::find(inside.begin(), inside.end(), p) != inside.end()) return true;
                for (const Segment& b : border)
                    if (side * turn(sheet.uv(b[0]), sheet.uv(b[1]), sheet.uv(p)) < 0)
                        return (p * 7 + static_cast<unsigned>(tries)) % 3 == 0;
                return false;
            };
            for (auto& e : all.edge_points)
                std::erase_if(e, [&](PointIndex p) { return !wanted(p); });
            std::erase_if(all.inner_points, [&](PointIndex p) { return !wanted(p); });
            all.segments = common.segments;
            all.segments.insert(all.segments.end(), border.begin(), border.end());
            for (const Triangle& t : as_set(triangulate(sheet, all))) {
                const bool part = std::all_of(t.begin(), t.end(), [&](PointIndex p) {
                    return std::find(inside.begin(), inside.end(), p) != inside.end();
                });
                if (part) parts[static_cast<std::size_t>(built)].insert(t);
            }
            ++built;
        }
        if (built < 2) continue;
        ++compared;
        REQUIRE(parts[0] == parts[1]);
        REQUIRE(parts[0] == as_set(triangulate(sheet, common)));
    }
    CHECK(compared > cases(300));
}

TEST_CASE("face triangulation: a part of a face with many points is as if divided by itself") {
    Random random(75);
    for (int i = 0; i < cases(40); ++i) { // points on a circle everywhere
        const Sheet sheet(random, 40);
        const auto at = [](int u, int v) { return static_cast<PointIndex>(40 * v + u); };
        FaceInput part;
        part.axis = sheet.axis;
        const int low = random_int(random, 1, 8), high = low + random_int(random, 9, 14);
        part.corners = {at(low, low), at(high, low), at(low, high)};
        add_points(random, sheet, part, 100);
        add_segments(random, sheet, part, 10);
        FaceInput whole;
        whole.axis = sheet.axis;
        whole.corners = {at(0, 0), at(39, 0), at(0, 39)};
        add_points(random, sheet, whole, 100);
        whole.segments = part.segments;
        for (unsigned e = 0; e < 3; ++e)
            whole.segments.push_back({part.corners[e], part.corners[(e + 1) % 3]});
        const Triangles of_whole = triangulate(sheet, whole);
        REQUIRE(covers(sheet, whole, of_whole));
        REQUIRE(contains_segments(sheet, whole, of_whole));
        const auto inside = points_named(part);
        auto of_part = as_set(of_whole);
        std::erase_if(of_part, [&](const Triangle& t) {
            return !std::all_of(t.begin(), t.end(), [&](PointIndex p) {
                return std::find(inside.begin(), inside.end(), p) != inside.end();
            });
        });
        REQUIRE(of_part == as_set(triangulate(sheet, part)));
    }
}

TEST_CASE("face triangulation: pinned cases") {
    Random random(74);
    const Sheet sheet(random, 5);
    FaceInput face;
    face.axis = sheet.axis;
    face.corners = {0, 4, 20};
    CHECK(triangulate(sheet, face) == Triangles{{0, 4, 20}});
    face.inner_points = {6};
    CHECK(as_set(triangulate(sheet, face)) ==
          std::set<Triangle>{{0, 4, 6}, {4, 6, 20}, {0, 6, 20}});
    face.edge_points[1] = {12};
    face.segments = {{0, 12}}; // through 6
    CHECK(as_set(triangulate(sheet, face)) ==
          std::set<Triangle>{{0, 4, 6}, {4, 6, 12}, {6, 12, 20}, {0, 6, 20}});
}
