// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The verifier refutes each way of breaking a true claim, by the rule that is broken.
#include "support/verify_cases.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace {

using namespace verify_cases;

struct Mutation {
    std::string name;
    std::function<Case()> start;
    std::function<void(Case&)> breaks;
    std::string verdict;
};

void check_mutations(const std::vector<Mutation>& mutations) {
    for (const Mutation& mutation : mutations) {
        INFO(mutation.name);
        Case c = mutation.start();
        REQUIRE(verdict(c).empty());
        mutation.breaks(c);
        CHECK(verdict(c) == mutation.verdict);
    }
}

} // namespace

TEST_CASE("verify_arrangement refutes indices out of range, and stops there") {
    const auto bad_kind = static_cast<Construction::Kind>(7);
    const auto bad_axis = static_cast<Axis>(3);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    check_mutations({
        {"corner", crossing, [](Case& c) { c.claim.triangles[1][2] = 8; }, "R1"},
        {"input vertex", crossing, [](Case& c) { c.claim.vertices[6].v[4] = 6; }, "R1"},
        {"kind", crossing, [&](Case& c) { c.claim.vertices[6].kind = bad_kind; }, "R1"},
        {"axis", overlap, [&](Case& c) { c.claim.vertices[6].axis = bad_axis; }, "R1"},
        {"parent", crossing, [](Case& c) { set_parents(c.claim, 3, {2}); }, "R1"},
        {"no parent", crossing, [](Case& c) { set_parents(c.claim, 3, {}); }, "R1"},
        {"unsorted parents", overlap,
         [](Case& c) {
             set_parents(c.claim, 0, {1, 0});
         },
         "R1"},
        {"a parent twice", crossing,
         [](Case& c) {
             set_parents(c.claim, 0, {0, 0});
         },
         "R1"},
        {"too few lists", crossing, [](Case& c) { c.claim.parents_of.offsets.pop_back(); }, "R1"},
        {"no lists", crossing, [](Case& c) { c.claim.parents_of.offsets.clear(); }, "R1"},
        {"bad offset", crossing, [](Case& c) { c.claim.parents_of.offsets[3] = 900; }, "R1"},
        {"short values", crossing, [](Case& c) { c.claim.parents_of.values.clear(); }, "R1"},
        {"edge", crossing, [](Case& c) { c.claim.intersection_edges[0][1] = 8; }, "R1"},
        {"edge reversed", crossing,
         [](Case& c) {
             c.claim.intersection_edges = {{7, 6}};
         },
         "R1"},
        {"edge twice", crossing,
         [](Case& c) {
             c.claim.intersection_edges.push_back({6, 7});
         },
         "R1"},
        {"degenerate", twins, [](Case& c) { c.claim.degenerate = {4}; }, "R1"},
        {"degenerate twice", twins,
         [](Case& c) {
             c.claim.degenerate = {1, 1};
         },
         "R1"},
        {"duplicate", twins,
         [](Case& c) {
             c.claim.duplicates = {{4, 0}};
         },
         "R1"},
        {"unsorted duplicates", twins,
         [](Case& c) {
             c.claim.duplicates = {{2, 0}, {1, 0}};
         },
         "R1"},
        {"input corner", crossing, [](Case& c) { c.inputs[1].triangles[0][0] = 3; }, "R1"},
        {"NaN", crossing, [&](Case& c) { c.inputs[0].vertices[0].y = nan; }, "R1"},
    });
}

TEST_CASE("verify_arrangement refutes undefined constructions") {
    check_mutations({
        {"line in the plane", crossing,
         [](Case& c) {
             c.claim.vertices[6] = line_plane({0, 1, 0, 1, 2});
         },
         "R2"},
        {"line parallel to the plane", crossing,
         [](Case& c) {
             c.claim.vertices[6] = line_plane({3, 4, 0, 1, 2});
         },
         "R2"},
        {"line through one point", crossing,
         [](Case& c) {
             c.claim.vertices[6] = line_plane({3, 3, 0, 1, 2});
         },
         "R2"},
        {"plane through a line", crossing,
         [](Case& c) {
             c.claim.vertices[6] = line_plane({3, 5, 0, 0, 1});
         },
         "R2"},
        {"planes share a line", three_planes_meet,
         [](Case& c) {
             c.claim.vertices[15] = three_planes({0, 1, 2, 0, 1, 2, 6, 7, 8});
         },
         "R2"},
        {"parallel lines", overlap,
         [](Case& c) {
             c.claim.vertices[6] = line_line({0, 1, 3, 4}, Axis::z);
         },
         "R2"},
        {"axis in the plane of the lines", overlap,
         [](Case& c) {
             c.claim.vertices[6] = line_line({1, 2, 3, 4}, Axis::x);
         },
         "R2"},
        {"lines not coplanar by one step of a double", overlap,
         [](Case& c) { c.inputs[1].vertices[1].z = std::numeric_limits<double>::denorm_min(); },
         "R2"},
    });
}

TEST_CASE("verify_arrangement refutes wrong vertices and triangles") {
    check_mutations({
        {"a vertex no triangle has", crossing,
         [](Case& c) {
             c.claim.vertices.push_back(line_plane({0, 1, 3, 4, 5}));
         },
         "R3"},
        {"one point, two vertices", crossing,
         [](Case& c) {
             c.claim.vertices.push_back(c.claim.vertices[6]);
             c.claim.triangles[5] = {5, 8, 7};
         },
         "R3 R5"},
        {"one point, two names", square_in_two,
         [](Case& c) {
             c.claim.vertices.push_back(input(4));
             c.claim.triangles[1] = {4, 2, 3};
         },
         "R3 R5 R7"},
        {"one point, two constructions", crossing_with_spare_vertex,
         [](Case& c) {
             c.claim.vertices.push_back(line_plane({4, 6, 0, 1, 2}));
             c.claim.triangles[5] = {5, 8, 7};
         },
         "R3 R5"},
        {"distinct points merged", crossing,
         [](Case& c) {
             for (Triangle& t : c.claim.triangles) {
                 std::replace(t.begin(), t.end(), 7U, 6U);
             }
         },
         "R3 R4 R6 R7"},
        {"another construction", crossing,
         [](Case& c) {
             c.claim.vertices[6] = line_plane({0, 1, 3, 4, 5});
         },
         "R4 R6"},
        {"the same construction", crossing,
         [](Case& c) { c.claim.vertices[6] = c.claim.vertices[7]; }, "R3 R4 R5 R6"},
        {"triangle twice", crossing,
         [](Case& c) {
             add_triangle(c.claim, {7, 2, 1}, {0});
         },
         "R4 R6 R7 R19"},
        {"overlap once for each parent", overlap,
         [](Case& c) {
             set_parents(c.claim, 0, {0});
             add_triangle(c.claim, {7, 6, 3}, {1});
         },
         "R4"},
        {"a corner twice", crossing,
         [](Case& c) {
             c.claim.triangles[3] = {2, 6, 6};
         },
         "R4 R6"},
    });
}

TEST_CASE("verify_arrangement refutes contacts") {
    check_mutations({
        {"a triangle left whole where another crosses it", crossing,
         [](Case& c) {
             drop_triangle(c.claim, 7);
             drop_triangle(c.claim, 6);
             c.claim.triangles[5] = {3, 4, 5};
         },
         "R5 R7"},
        {"an overlap left whole", overlap,
         [](Case& c) {
             drop_triangle(c.claim, 6);
             c.claim.triangles[5] = {3, 5, 4};
             set_parents(c.claim, 0, {0});
             c.claim.intersection_edges.clear();
         },
         "R5"},
        {"the common point left out of one triangle", three_planes_meet,
         [](Case& c) {
             c.claim.triangles[2] = {10, 9, 13};
             c.claim.triangles[5] = {10, 9, 14};
             drop_triangle(c.claim, 8);
             drop_triangle(c.claim, 3);
         },
         "R5 R7 R19"},
        {"ends of an intersection swapped", three_planes_meet,
         [](Case& c) { std::swap(c.claim.vertices[9], c.claim.vertices[10]); }, "R5 R6 R19"},
    });
}

TEST_CASE("verify_arrangement refutes wrong parents") {
    check_mutations({
        {"dropped triangle", crossing, [](Case& c) { drop_triangle(c.claim, 2); }, "R6"},
        {"nothing left of an input", square_in_one,
         [](Case& c) {
             drop_triangle(c.claim, 1);
             c.claim.vertices.pop_back();
         },
         "R6"},
        {"swapped parents", crossing,
         [](Case& c) {
             set_parents(c.claim, 2, {1});
             set_parents(c.claim, 5, {0});
         },
         "R6 R7"},
        {"swapped parents in one plane, of equal area", square_in_one,
         [](Case& c) {
             set_parents(c.claim, 0, {1});
             set_parents(c.claim, 1, {0});
         },
         "R6"},
        {"parent not listed", overlap, [](Case& c) { set_parents(c.claim, 0, {0}); }, "R6 R7"},
        {"parent too many", overlap,
         [](Case& c) {
             set_parents(c.claim, 5, {0, 1});
         },
         "R6 R7 R19"},
        {"flipped index", crossing,
         [](Case& c) {
             c.claim.triangles[3] = {2, 6, 5};
         },
         "R6 R7"},
        {"vertex moved by 2^-1000 along the edge it lies on", crossing_with_spare_vertex,
         [](Case& c) { c.inputs[0].vertices[3].z = 0x1p-1000; }, "R6"},
        {"an input moved by one step of a double", square_in_one,
         [](Case& c) {
             c.inputs.push_back(c.inputs[0]);
             c.inputs[1].vertices[1].z = std::numeric_limits<double>::denorm_min();
             set_parents(c.claim, 0, {0, 2});
             set_parents(c.claim, 1, {1, 3});
             c.claim.duplicates = {{2, 0}, {3, 1}};
         },
         "R6 R8"},
        {"degenerate named as a parent", twins,
         [](Case& c) {
             set_parents(c.claim, 1, {1, 3});
         },
         "R6 R7"},
        {"duplicate not named as a parent", twins, [](Case& c) { set_parents(c.claim, 0, {0}); },
         "R6"},
        {"only the duplicate named as a parent", twins,
         [](Case& c) { set_parents(c.claim, 0, {2}); }, "R6 R7 R19"},
    });
}

TEST_CASE("verify_arrangement refutes wrong intersection edges") {
    const auto extra = [](Edge edge) {
        return [edge](Case& c) {
            auto& edges = c.claim.intersection_edges;
            edges.insert(std::lower_bound(edges.begin(), edges.end(), edge), edge);
        };
    };
    const auto none = [](Case& c) { c.claim.intersection_edges.clear(); };
    check_mutations({
        {"missing, four triangles", crossing, none, "R7"},
        {"missing, overlap", overlap, none, "R7"},
        {"missing, two surfaces", square_in_two, none, "R7"},
        {"missing, end of a coinciding surface", twins, none, "R7"},
        {"one of six missing", three_planes_meet,
         [](Case& c) { c.claim.intersection_edges.erase(c.claim.intersection_edges.begin() + 2); },
         "R7"},
        {"an inner edge too many", crossing, extra({1, 6}), "R7"},
        {"a border too many", crossing, extra({0, 1}), "R7"},
        {"not an edge at all", crossing, extra({0, 7}), "R7"},
        {"the diagonal of a square", square_in_one, extra({0, 2}), "R7"},
    });
}

TEST_CASE("verify_arrangement refutes wrong lists of what was set aside") {
    check_mutations({
        {"degenerate not listed", twins, [](Case& c) { c.claim.degenerate.clear(); }, "R8"},
        {"degenerate, but has area", twins,
         [](Case& c) {
             c.claim.degenerate = {0, 1};
         },
         "R8"},
        {"duplicate not listed", twins, [](Case& c) { c.claim.duplicates.clear(); }, "R8"},
        {"no duplicate", twins,
         [](Case& c) {
             c.claim.duplicates.push_back({3, 0});
         },
         "R8"},
        {"wrong first", twins,
         [](Case& c) {
             c.claim.duplicates = {{2, 1}};
         },
         "R8"},
        {"first and duplicate swapped", twins,
         [](Case& c) {
             c.claim.duplicates = {{0, 2}};
         },
         "R8"},
        {"first of itself", twins,
         [](Case& c) {
             c.claim.duplicates = {{0, 0}, {2, 0}};
         },
         "R8"},
        {"nearly a duplicate", twins,
         [](Case& c) { c.inputs[1].vertices[0].y = std::nextafter(1.0, 0.0); }, "R6 R8"},
    });
}

TEST_CASE("verify_arrangement survives claims made of noise") {
    std::mt19937 random(7);
    for (int i = 0; i < 3000; ++i) {
        Case c = i % 2 == 0 ? crossing() : overlap();
        const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
        for (int k = 0; k < 3; ++k) {
            Construction& vertex = c.claim.vertices[below(c.claim.vertices.size())];
            vertex.kind = static_cast<Construction::Kind>(below(4));
            vertex.v[below(9)] = below(6);
            c.claim.triangles[below(c.claim.triangles.size())][below(3)] = below(8);
        }
        CHECK_NOTHROW(verify_arrangement(c.inputs, c.claim));
    }
}
