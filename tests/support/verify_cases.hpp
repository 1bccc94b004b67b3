// SPDX-License-Identifier: LGPL-3.0-or-later
//
// True claims about small inputs, written by hand, and functions that break them.
#pragma once

#include <terrane/algorithms/verify/verify.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace verify_cases {

using namespace terrane;

using Indices = std::vector<std::uint32_t>;

/// Inputs and a claim about them.
struct Case {
    std::vector<Surface> inputs;
    ArrangementClaim claim;
};

inline Surface surface(std::vector<Point3> vertices, std::vector<Triangle> triangles) {
    return {"", Role::unknown, std::move(vertices), std::move(triangles)};
}

inline Construction construction(Construction::Kind kind, const Indices& v, Axis axis = Axis::x) {
    Construction result{kind, axis, {}};
    std::copy(v.begin(), v.end(), result.v.begin());
    return result;
}

inline Construction input(std::uint32_t v) {
    return construction(Construction::Kind::input, {v});
}

inline Construction line_plane(const Indices& v) {
    return construction(Construction::Kind::line_plane, v);
}

inline Construction three_planes(const Indices& v) {
    return construction(Construction::Kind::three_planes, v);
}

inline Construction line_line(const Indices& v, Axis axis) {
    return construction(Construction::Kind::line_line, v, axis);
}

inline std::vector<Construction> input_vertices(std::uint32_t count) {
    std::vector<Construction> result;
    for (std::uint32_t v = 0; v < count; ++v) result.push_back(input(v));
    return result;
}

inline void add_triangle(ArrangementClaim& claim, const Triangle& triangle,
                         const Indices& parents) {
    claim.triangles.push_back(triangle);
    claim.parents_of.push_back(parents);
}

/// Gives a triangle other parents, or drops it if there are none to give.
inline void change_parents(ArrangementClaim& claim, std::size_t triangle,
                           const std::optional<Indices>& parents) {
    IndexLists<std::uint32_t> lists;
    for (std::size_t t = 0; t < claim.parents_of.size(); ++t) {
        if (t != triangle) lists.push_back(claim.parents_of[t]);
        if (t == triangle && parents) lists.push_back(*parents);
    }
    claim.parents_of = lists;
}

inline void set_parents(ArrangementClaim& claim, std::size_t triangle, const Indices& parents) {
    change_parents(claim, triangle, parents);
}

inline void drop_triangle(ArrangementClaim& claim, std::size_t triangle) {
    claim.triangles.erase(claim.triangles.begin() + static_cast<std::ptrdiff_t>(triangle));
    change_parents(claim, triangle, std::nullopt);
}

// --- True claims ------------------------------------------------------------------------------

/// A vertical triangle (3, 4, 5) stands through a horizontal one (0, 1, 2): they cross in the
/// segment from 6 = (2, 2, 0) to 7 = (2, 4, 0).
inline Case crossing() {
    Case c;
    c.inputs = {surface({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}, {{0, 1, 2}}),
                surface({{2, 1, -2}, {2, 5, -2}, {2, 3, 2}}, {{0, 1, 2}})};
    c.claim.vertices = input_vertices(6);
    c.claim.vertices.push_back(line_plane({3, 5, 0, 1, 2}));
    c.claim.vertices.push_back(line_plane({4, 5, 0, 1, 2}));
    add_triangle(c.claim, {0, 1, 6}, {0});
    add_triangle(c.claim, {1, 7, 6}, {0});
    add_triangle(c.claim, {1, 2, 7}, {0});
    add_triangle(c.claim, {2, 6, 7}, {0});
    add_triangle(c.claim, {2, 0, 6}, {0});
    add_triangle(c.claim, {5, 6, 7}, {1});
    add_triangle(c.claim, {3, 4, 7}, {1});
    add_triangle(c.claim, {3, 7, 6}, {1});
    c.claim.intersection_edges = {{6, 7}};
    return c;
}

/// Like crossing(), but surface 0 has a fourth vertex, 3, in the plane of its triangle; the
/// construction of 6 names the plane by this vertex.
inline Case crossing_with_spare_vertex() {
    Case c = crossing();
    c.inputs[0].vertices.push_back({9, 9, 0});
    c.claim.vertices = {input(0), input(1), input(2), input(4), input(5), input(6)};
    c.claim.vertices.push_back(line_plane({4, 6, 0, 1, 3}));
    c.claim.vertices.push_back(line_plane({5, 6, 0, 1, 2}));
    return c;
}

/// Two triangles in one plane overlap in the triangle 3 = (1, 1), 6 = (3, 1), 7 = (1, 3).
inline Case overlap() {
    Case c;
    c.inputs = {surface({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}),
                surface({{1, 1, 0}, {5, 1, 0}, {1, 5, 0}}, {{0, 2, 1}})};
    c.claim.vertices = input_vertices(6);
    c.claim.vertices.push_back(line_line({1, 2, 3, 4}, Axis::z));
    c.claim.vertices.push_back(line_line({1, 2, 3, 5}, Axis::z));
    add_triangle(c.claim, {3, 6, 7}, {0, 1});
    add_triangle(c.claim, {0, 1, 3}, {0});
    add_triangle(c.claim, {1, 6, 3}, {0});
    add_triangle(c.claim, {0, 3, 2}, {0});
    add_triangle(c.claim, {3, 7, 2}, {0});
    add_triangle(c.claim, {6, 5, 4}, {1}); // input 1 faces the other side
    add_triangle(c.claim, {6, 7, 5}, {1});
    c.claim.intersection_edges = {{3, 6}, {3, 7}, {6, 7}};
    return c;
}

/// Three triangles in the coordinate planes meet in the origin. Each is a copy of the others with
/// the coordinates rotated, and long enough that each pierces only one of them with its border.
inline Case three_planes_meet() {
    Case c;
    c.inputs = {surface({{-2, -4, 0}, {2, -4, 0}, {0, 4, 0}}, {{0, 1, 2}}),
                surface({{-4, 0, -2}, {-4, 0, 2}, {4, 0, 0}}, {{0, 1, 2}}),
                surface({{0, -2, -4}, {0, 2, -4}, {0, 0, 4}}, {{0, 1, 2}})};
    c.claim.vertices = input_vertices(9);
    for (const auto& v : {Indices{0, 2, 3, 4, 5}, Indices{1, 2, 3, 4, 5}, Indices{3, 5, 6, 7, 8},
                          Indices{4, 5, 6, 7, 8}, Indices{6, 8, 0, 1, 2}, Indices{7, 8, 0, 1, 2}}) {
        c.claim.vertices.push_back(line_plane(v));
    }
    c.claim.vertices.push_back(three_planes({0, 1, 2, 3, 4, 5, 6, 7, 8}));
    const std::uint32_t ends[3][4] = {{9, 10, 13, 14}, {11, 12, 9, 10}, {13, 14, 11, 12}};
    for (std::uint32_t parent = 0; parent < 3; ++parent) {
        const std::uint32_t a = 3 * parent;
        const auto [left, right, below, above] = ends[parent]; // on its border twice, inside twice
        for (const Triangle& t :
             {Triangle{a, a + 1, below}, Triangle{a + 1, right, below}, Triangle{right, 15, below},
              Triangle{15, left, below}, Triangle{left, a, below}, Triangle{15, right, above},
              Triangle{right, a + 2, above}, Triangle{a + 2, left, above},
              Triangle{left, 15, above}}) {
            add_triangle(c.claim, t, {parent});
        }
    }
    c.claim.intersection_edges = {{9, 15}, {10, 15}, {11, 15}, {12, 15}, {13, 15}, {14, 15}};
    return c;
}

/// Surface 0 has a triangle and one without area; surface 1 has the same triangle, turned over,
/// with vertices of its own, and one that shares an edge with it.
inline Case twins() {
    Case c;
    c.inputs = {surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 3, 3}, {6, 6, 6}, {9, 9, 9}},
                        {{0, 1, 2}, {3, 4, 5}}),
                surface({{0, 1, 0}, {1, 0, -0.0}, {0, 0, 0}, {1, 1, 1}}, {{0, 1, 2}, {1, 0, 3}})};
    c.claim.vertices = {input(0), input(1), input(2), input(9)};
    add_triangle(c.claim, {0, 1, 2}, {0, 2});
    add_triangle(c.claim, {1, 2, 3}, {3});
    c.claim.intersection_edges = {{1, 2}}; // surface 0 ends there
    c.claim.degenerate = {1};
    c.claim.duplicates = {{2, 0}};
    return c;
}

/// A square of two triangles, in one surface or two.
inline Case square(bool in_two_surfaces) {
    const std::vector<Point3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    Case c;
    if (in_two_surfaces) {
        c.inputs = {surface(corners, {{0, 1, 2}}), surface(corners, {{0, 2, 3}})};
    } else {
        c.inputs = {surface(corners, {{0, 1, 2}, {0, 2, 3}})};
    }
    c.claim.vertices = input_vertices(4);
    add_triangle(c.claim, {0, 1, 2}, {0});
    add_triangle(c.claim, {0, 2, 3}, {1});
    if (in_two_surfaces) c.claim.intersection_edges = {{0, 2}};
    return c;
}

inline Case square_in_two() {
    return square(true);
}

inline Case square_in_one() {
    return square(false);
}

// --- Judging ----------------------------------------------------------------------------------

/// Returns the violated rules, such as "R5 R7".
inline std::string broken_rules(const std::vector<Violation>& violations) {
    std::set<int> rules;
    for (const Violation& v : violations) rules.insert(static_cast<int>(v.rule) + 1);
    std::string result;
    for (const int rule : rules) result += (result.empty() ? "R" : " R") + std::to_string(rule);
    return result;
}

inline std::string verdict(const Case& c) {
    return broken_rules(verify_arrangement(c.inputs, c.claim));
}

} // namespace verify_cases
