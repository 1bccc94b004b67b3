// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests each class of contact between two triangles by an example.
#include <terrane/algorithms/intersection/intersection.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <string>

namespace {

using namespace terrane;
using Kind = Construction::Kind;

/// Returns "c0" for a corner, "e1" for an edge, "f" for the face.
std::string text(Simplex p) {
    if (is_corner(p)) return "c" + std::to_string(corner_of(p));
    return is_edge(p) ? "e" + std::to_string(edge_of(p)) : "f";
}

/// Returns the simplices of all points, sorted: "c0-e1 f-e2".
std::string places(const Contact& c) {
    std::vector<std::string> all;
    for (unsigned i = 0; i < c.point_count; ++i)
        all.push_back(text(c.points[i].place[0]) + "-" + text(c.points[i].place[1]));
    std::sort(all.begin(), all.end());
    std::string joined;
    for (const auto& s : all) joined += (joined.empty() ? "" : " ") + s;
    return joined;
}

/// Counts the points of each kind: "input", "line_plane", "line_line".
std::map<Kind, int> kinds(const Contact& c) {
    std::map<Kind, int> count;
    for (unsigned i = 0; i < c.point_count; ++i) ++count[c.points[i].how.kind];
    return count;
}

/// The first triangle (0, 1, 2) of all cases, with corners at (0,0), (4,0) and (0,4).
const std::vector<Point3> base{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

std::optional<Contact> meets(const std::vector<Point3>& more, const Triangle& second) {
    std::vector<Point3> points = base;
    points.insert(points.end(), more.begin(), more.end());
    return improper_contact(points, {0, 1, 2}, second);
}

Contact meets_improperly(const std::vector<Point3>& more, const Triangle& second = {3, 4, 5}) {
    const auto c = meets(more, second);
    REQUIRE(c);
    return *c;
}

} // namespace

TEST_CASE("contact: none") {
    CHECK_FALSE(meets({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {3, 4, 5}));    // parallel planes
    CHECK_FALSE(meets({{5, 5, -1}, {6, 5, 1}, {5, 6, 1}}, {3, 4, 5}));   // planes cross elsewhere
    CHECK_FALSE(meets({{4, 4, 0}, {5, 4, 0}, {4, 5, 0}}, {3, 4, 5}));    // coplanar, apart
    CHECK_FALSE(meets({{2, 3, -1}, {2, 3, 1}, {5, 5, 0.5}}, {3, 4, 5})); // passes the slanted edge
}

TEST_CASE("contact: shared corners and edges alone are proper") {
    CHECK_FALSE(meets({{1, 1, 1}, {2, 1, 1}}, {0, 3, 4}));   // a vertex
    CHECK_FALSE(meets({{-1, 0, 0}, {0, -1, 0}}, {0, 3, 4})); // a vertex, coplanar
    CHECK_FALSE(meets({{-4, 0, 0}, {0, -1, 0}}, {0, 3, 4})); // and edges in line
    CHECK_FALSE(meets({{1, 1, 1}}, {0, 1, 3}));              // an edge
    CHECK_FALSE(meets({{1, -1, 0}}, {0, 1, 3}));             // an edge, flat
    CHECK_FALSE(meets({{1, -1, 0}}, {1, 0, 3}));             // the other orientation
}

TEST_CASE("contact: vertex on edge, vertex on face") {
    Contact c = meets_improperly({{2, 0, 0}, {2, 0, 1}, {2, -1, 1}});
    CHECK(places(c) == "e0-c0");
    CHECK(kinds(c) == std::map<Kind, int>{{Kind::input, 1}});
    CHECK(c.points[0].how.v[0] == 3);
    CHECK_FALSE(c.coplanar);
    CHECK(c.piece_count == std::array<std::uint8_t, 2>{1, 1});
    CHECK(c.pieces[0][0].ends[0] == c.pieces[0][0].ends[1]);

    c = meets_improperly({{5, 5, 5}, {1, 1, 0}, {6, 5, 5}});
    CHECK(places(c) == "f-c1");
    CHECK(c.points[0].how.v[0] == 4);

    c = meets_improperly({{-1, 1, 1}, {1, -1, -1}, {-3, -1, 5}}); // the corner of the first
    CHECK(places(c) == "c0-e0");
    CHECK(c.points[0].how.v[0] == 0);
}

TEST_CASE("contact: two edges cross in a point") {
    const Contact c = meets_improperly({{2, 0, -1}, {2, 0, 1}, {2, -5, 0}});
    CHECK(places(c) == "e0-e0");
    CHECK(c.points[0].how.kind == Kind::line_line);
    CHECK(c.points[0].how.v == std::array<std::uint32_t, 9>{0, 1, 3, 4});
}

TEST_CASE("contact: an edge goes through the face, the segment ends at an edge or inside") {
    Contact c = meets_improperly({{1, 1, -1}, {1, 1, 1}, {9, 1, 1}});
    CHECK(places(c) == "e1-f f-e0");
    CHECK(kinds(c) == std::map<Kind, int>{{Kind::line_plane, 2}});
    CHECK(c.piece_count == std::array<std::uint8_t, 2>{1, 1});
    CHECK(c.pieces[0][0].support == 3);
    CHECK(c.pieces[0][0].ends[0] != c.pieces[0][0].ends[1]);

    c = meets_improperly({{1, 1, -1}, {1, 1, 1}, {2, 1, 1}}); // both ends inside the first
    CHECK(places(c) == "f-e0 f-e2");

    c = meets_improperly({{-9, 1, -9}, {19, 1, -9}, {1, 1, 9}}); // both ends inside the second
    CHECK(places(c) == "e1-f e2-f");

    c = meets_improperly({{1, 1, 0}, {1, 2, 3}, {1, 2, -3}}); // from a vertex to an edge
    CHECK(places(c) == "f-c0 f-e1");
}

TEST_CASE("contact: an edge lies in the face, or along an edge") {
    Contact c = meets_improperly({{1, 1, 0}, {2, 1, 0}, {1, 1, 3}});
    CHECK(places(c) == "f-c0 f-c1");
    CHECK_FALSE(c.coplanar);
    CHECK(kinds(c) == std::map<Kind, int>{{Kind::input, 2}});

    c = meets_improperly({{1, 0, 0}, {3, 0, 0}, {1, 0, 3}}); // within an edge
    CHECK(places(c) == "e0-c0 e0-c1");
    c = meets_improperly({{2, 0, 0}, {6, 0, 0}, {1, 0, 3}}); // overlapping an edge
    CHECK(places(c) == "c1-e0 e0-c0");
    c = meets_improperly({{-1, 1, 0}, {5, 1, 0}, {1, 1, 3}}); // through the face
    CHECK(places(c) == "e1-e0 e2-e0");
    CHECK(kinds(c) == std::map<Kind, int>{{Kind::line_line, 2}});
}

TEST_CASE("contact: a shared vertex and a crossing") {
    Contact c = meets_improperly({{1, 1, -1}, {1, 1, 1}}, {0, 3, 4});
    CHECK(places(c) == "c0-c0 f-e1");
    CHECK(kinds(c) == std::map<Kind, int>{{Kind::input, 1}, {Kind::line_plane, 1}});
    c = meets_improperly({{4, 4, -4}, {4, 4, 4}}, {0, 3, 4}); // leaves through the far edge
    CHECK(places(c) == "c0-c0 e1-f");
    c = meets_improperly({{2, 2, 0}, {1, 1, 3}}, {3, 4, 0}); // an edge along the face
    CHECK(places(c) == "c0-c2 e1-c0");
    c = meets_improperly({{2, 0, 0}, {1, 1, 3}}, {0, 3, 4}); // edges overlap from the vertex on
    CHECK(places(c) == "c0-c0 e0-c1");
}

TEST_CASE("contact: folded over a shared edge") {
    Contact c = meets_improperly({{1, 1, 0}}, {0, 1, 3});
    CHECK(c.coplanar);
    CHECK(c.overlap);
    CHECK(places(c) == "c0-c0 c1-c1 f-c2");
    c = meets_improperly({{4, 4, 0}}, {1, 0, 3});
    CHECK(c.overlap);
    CHECK(places(c) == "c0-c1 c1-c0 e1-e1");
    CHECK(kinds(c) == std::map<Kind, int>{{Kind::input, 2}, {Kind::line_line, 1}});
    c = meets_improperly({{0, 8, 0}}, {0, 1, 3}); // a side along a side
    CHECK(places(c) == "c0-c0 c1-c1 c2-e2");
}

TEST_CASE("contact: coplanar, touching without area") {
    Contact c = meets_improperly({{2, 0, 0}, {2, -1, 0}, {3, -1, 0}});
    CHECK(c.coplanar);
    CHECK_FALSE(c.overlap);
    CHECK(places(c) == "e0-c0");
    c = meets_improperly({{1, 0, 0}, {3, 0, 0}, {2, -1, 0}});
    CHECK_FALSE(c.overlap);
    CHECK(places(c) == "e0-c0 e0-c1");
}

TEST_CASE("contact: coplanar overlap in part, as a whole, of either orientation") {
    Contact c = meets_improperly({{1, 1, 0}, {5, 1, 0}, {1, 5, 0}});
    CHECK(c.coplanar);
    CHECK(c.overlap);
    CHECK(places(c) == "e1-e0 e1-e2 f-c0");
    const Contact reversed = meets_improperly({{1, 1, 0}, {1, 5, 0}, {5, 1, 0}});
    CHECK(places(reversed) == "e1-e0 e1-e2 f-c0");

    c = meets_improperly({{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}); // the second within the first
    CHECK(c.overlap);
    CHECK(places(c) == "f-c0 f-c1 f-c2");
    CHECK(c.piece_count == std::array<std::uint8_t, 2>{3, 0}); // nothing to draw in the second

    c = meets_improperly({{-4, -4, 0}, {12, -4, 0}, {-4, 12, 0}}); // the first within the second
    CHECK(places(c) == "c0-f c1-f c2-f");
    CHECK(c.piece_count == std::array<std::uint8_t, 2>{0, 3});

    c = meets_improperly({{3, 3, 0}, {-1, 3, 0}, {3, -1, 0}}); // a star of six corners
    CHECK(c.overlap);
    CHECK(c.point_count == 6);
    CHECK(kinds(c) == std::map<Kind, int>{{Kind::line_line, 6}});
}

TEST_CASE("constructions are canonical") {
    CHECK(line_plane({5, 2}, {9, 1, 4}) == line_plane({2, 5}, {1, 4, 9}));
    CHECK(line_plane({5, 2}, {9, 1, 4}).v == std::array<std::uint32_t, 9>{2, 5, 1, 4, 9});
    const auto planes = three_planes({3, 2, 1}, {6, 5, 4}, {1, 2, 0});
    CHECK(planes == three_planes({4, 5, 6}, {0, 1, 2}, {1, 2, 3}));
    CHECK(planes.v == std::array<std::uint32_t, 9>{0, 1, 2, 1, 2, 3, 4, 5, 6});
    const std::vector<Point3> p{{0, 0, 0}, {1, 0, 1}, {0, 0, 1}, {1, 0, 0}};
    CHECK(line_line(p, {3, 2}, {1, 0}) == line_line(p, {0, 1}, {2, 3}));
    CHECK(line_line(p, {0, 1}, {2, 3}).axis == Axis::y); // parallel along z and along x
    CHECK(line_line(p, {3, 2}, {1, 0}).v == std::array<std::uint32_t, 9>{0, 1, 2, 3});
}
