// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests sections of models whose parts are known, in ordinary and degenerate places.
#include <catch2/catch.hpp>

#include <map>
#include <numbers>
#include <set>

#include <terrane/algorithms/sections/sections.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

#include "sections_of_models.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

template <class T>
ErrorCode refusal_of_section(const Result<T>& result) {
    REQUIRE(!result);
    return result.error().code;
}

/// A box of 4 x 4 x 4 with a horizon at z = 2 and a fault x = 1 that ends at z = 1, inside of a block.
SectionModel small_model() {
    return section_model({level(2, -1, -1, 5, 5, "horizon"),
                          quad({1, -1, 1}, {1, 5, 1}, {1, 5, 5}, {1, -1, 5}, "fault")},
                         *box_boundary({0, 0, 0}, {4, 4, 4}));
}

double area_of(const Section& section) {
    double sum = 0;
    for (const SectionPolygon& p : section.polygons) sum += p.area;
    return sum;
}

/// Lengths of the lines of each surface, by its name.
std::map<std::string, double> lengths_of(const Section& section, const Mesh& mesh) {
    std::map<std::string, double> sums;
    for (const SectionLine& line : section.lines)
        for (std::size_t i = 1; i < line.vertices.size(); ++i)
            sums[mesh.surfaces[line.surface].name] += length(
                minus(section.vertices[line.vertices[i]], section.vertices[line.vertices[i - 1]]));
    return sums;
}

Section section_at(const SectionModel& model, const Point3& point, const Point3& normal) {
    return cut_along(model, section_plane(model.mesh, point, normal));
}

} // namespace

TEST_CASE("sections: a plane across layers and a fault that ends in a block") {
    const SectionModel model = small_model();
    REQUIRE(model.volumes.block_count() == 3);
    const Section section = section_at(model, {9, 1.5, 7}, {0, -1, 0});
    REQUIRE(section.polygons.size() == 3);
    std::multiset<double> areas;
    for (const SectionPolygon& p : section.polygons) {
        areas.insert(p.area);
        CHECK(p.block == p.behind);
        REQUIRE(p.rings.size() == 1);
        CHECK(p.rings[0].size() == (p.area == 8 ? 5 : 4)); // a hanging end is no border
        for (const std::uint32_t v : p.rings[0]) {
            CHECK(section.flat[v][0] == section.vertices[v].x - 9); // from the point on
            CHECK(section.flat[v][1] == section.vertices[v].z);
        }
        CHECK(model.volumes.measures[p.block] == p.area * 4);
    }
    CHECK(areas == std::multiset<double>{2, 6, 8});
    const auto lengths = lengths_of(section, model.mesh);
    CHECK(lengths.at("fault") == 3);
    CHECK(lengths.at("horizon") == 4);
    CHECK(lengths.at("boundary top") == 4);
    CHECK(lengths.size() == 6); // without the sides in front and behind
}

TEST_CASE("sections: planes upon surfaces, through edges and through corners") {
    const SectionModel model = small_model();
    const auto volume = [&](BlockId block) { return model.volumes.measures[block]; };
    SECTION("on the horizon the block on the side of the normal counts") {
        const Section above = section_at(model, {0, 0, 2}, {0, 0, 1});
        REQUIRE(above.polygons.size() == 2);
        for (const SectionPolygon& p : above.polygons) {
            CHECK(volume(p.block) == 2 * p.area);
            CHECK(volume(p.behind) == 32);
        }
        CHECK(lengths_of(above, model.mesh).at("horizon") == 16); // its border
        const Section below = section_at(model, {0, 0, 2}, {0, 0, -3});
        REQUIRE(below.polygons.size() == 2); // with two blocks behind
        CHECK(volume(below.polygons[0].block) == 32);
        CHECK(area_of(below) == 16);
    }
    SECTION("on the top of the model") {
        const Section above = section_at(model, {0, 0, 4}, {0, 0, 1});
        const Section below = section_at(model, {0, 0, 4}, {0, 0, -1});
        CHECK(area_of(above) == 16);
        CHECK(area_of(below) == 16);
        for (const SectionPolygon& p : above.polygons) CHECK((p.block == 0 && p.behind != 0));
        for (const SectionPolygon& p : below.polygons) CHECK((p.block != 0 && p.behind == 0));
    }
    SECTION("on the fault, partly") {
        const Section section = section_at(model, {1, 0, 0}, {-1, 0, 0});
        CHECK(area_of(section) == 16);
        REQUIRE(section.polygons.size() == 2);
        CHECK(lengths_of(section, model.mesh).at("fault") == 2 * (4 + 3));
    }
    SECTION("through opposite edges") {
        const Section section = section_at(model, {0, 0, 0}, {1, 0, -1});
        CHECK(area_of(section) == Approx(16 * std::numbers::sqrt2));
        CHECK(section.polygons.size() == 2); // it meets the fault in its lower border only
    }
    SECTION("through an edge, and a corner, alone") {
        const Section edge = section_at(model, {0, 0, 4}, {1, 0, -1});
        CHECK(edge.polygons.empty());
        CHECK(lengths_of(edge, model.mesh).at("boundary top") == 4);
        const Section corner = section_at(model, {0, 0, 0}, {1, 1, 1});
        CHECK(corner.polygons.empty());
        CHECK(corner.lines.empty());
    }
    SECTION("beside the model") {
        CHECK(section_at(model, {0, 0, 5}, {0, 0, 1}).lines.empty());
    }
}

TEST_CASE("sections: holes, and holes that touch the border or each other") {
    const auto middle = [](std::vector<Surface> solids) {
        return section_at(section_model(std::move(solids), {}), {0, 0, 4}, {0, 0, 1});
    };
    const auto rings_of = [](const Section& section) {
        std::multiset<std::size_t> counts;
        for (const SectionPolygon& p : section.polygons) counts.insert(p.rings.size());
        return counts;
    };
    const Surface outer = cube(0, 8, "outer");
    using Counts = std::multiset<std::size_t>;
    const Section one = middle({outer, cube(3, 5)});
    CHECK(rings_of(one) == Counts{1, 2});
    CHECK(area_of(one) == 64);
    // Octahedra touch the side x = 0, both sides, and one another.
    CHECK(rings_of(middle({outer, octahedron({1, 4, 4}, 1)})) == Counts{1, 2});
    CHECK(rings_of(middle({outer, octahedron({4, 4, 4}, 4)})) == Counts{1, 1, 1, 1, 1});
    CHECK(rings_of(middle({outer, octahedron({3, 4, 4}, 1), octahedron({5, 4, 4}, 1)})) ==
          Counts{1, 1, 3});
    const Section ring = middle({outer, octahedron({3, 3, 4}, 1), octahedron({5, 3, 4}, 1),
                                 octahedron({3, 5, 4}, 1), octahedron({5, 5, 4}, 1)});
    // The outer part with one hole, which the island between the four touches from inside.
    CHECK(ring.polygons.size() == 6);
    CHECK(area_of(ring) == 64);
    // A hole that touches the border in its least vertex, and in its greatest one.
    const Surface diamond = octahedron({4, 4, 4}, 4);
    const Section left =
        middle({diamond, tetrahedron({0, 4, 4}, {2, 4.5, 3}, {2, 3.5, 3}, {2, 4, 5})});
    const Section right =
        middle({diamond, tetrahedron({8, 4, 4}, {6, 4.5, 3}, {6, 3.5, 3}, {6, 4, 5})});
    CHECK(rings_of(left) == Counts{1, 2});
    CHECK(rings_of(right) == Counts{1, 2});
    for (const Section& section : {one, ring, left, right})
        for (const SectionPolygon& p : section.polygons)
            for (std::size_t k = 0; k < p.rings.size(); ++k)
                CHECK((shoelace(section, p.rings[k]) > 0) == (k == 0));
}

TEST_CASE("sections: a fence") {
    const SectionModel model = small_model();
    const std::vector<std::array<double, 2>> corners{{-1, 1}, {3, 1}, {3, 3}, {0.5, 3}, {0.5, 9}};
    const Section section = cut_along(model, section_fence(model.mesh, corners));
    CHECK(area_of(section) == 4 * (3 + 2 + 2.5 + 1));
    for (const SectionPolygon& p : section.polygons) {
        CHECK(p.rings.size() == 1); // a block on both sides of a bend is one polygon
        CHECK(shoelace(section, p.rings[0]) == Approx(p.area));
    }
    CHECK(section.polygons.size() ==
          4); // blocks below and east of the fault once, west of it twice
    std::set<double> bends;
    for (std::size_t v = 0; v < section.flat.size(); ++v)
        if (section.vertices[v].x == 3 && section.vertices[v].y == 1)
            bends.insert(section.flat[v][0]);
    CHECK(bends == std::set<double>{4});
    const auto refused = [&](std::vector<std::array<double, 2>> line) {
        return refusal_of_section(section_fence(model.mesh, line)) == ErrorCode::bad_option;
    };
    CHECK(refused({{0, 0}}));
    CHECK(refused({{0, 0}, {0, 0}}));
    CHECK(refused({{0, 0}, {4, 0}, {2, 0}}));                  // back on its way
    CHECK(refused({{0, 0}, {4, 0}, {4, 4}, {0, 0}}));          // closed
    CHECK(refused({{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, -1}})); // crosses itself
    CHECK(refused({{0, 0}, {4, 0}, {4, 4}, {2, 0}}));          // touches itself
    CHECK(!section_fence(model.mesh, std::vector<std::array<double, 2>>{{0, NAN}, {1, 1}}));
}

TEST_CASE("sections: levels, contours and outcrops") {
    const SectionModel model = small_model();
    const Section slices =
        cut_along(model, section_levels(model.mesh, std::vector<double>{3, 1, 3, 7}));
    CHECK(area_of(slices) == 32);
    CHECK(slices.polygons.size() == 3);
    const SectionModel slope =
        section_model({quad({0, 0, 0}, {8, 0, 4}, {8, 8, 4}, {0, 8, 0})}, {});
    const Section contours =
        cut_along(slope, section_levels(slope.mesh, std::vector<double>{0, 1, 2.5, 9}));
    REQUIRE(contours.lines.size() == 3);
    CHECK(contours.polygons.empty());
    for (const SectionLine& line : contours.lines) {
        REQUIRE(line.vertices.size() == 2); // without the vertex on the diagonal
        for (const std::uint32_t v : line.vertices)
            CHECK(contours.vertices[v].x == 2 * contours.vertices[v].z);
    }
    // Outcrops on a topography that dips west.
    const Surface topography = quad({-1, -1, 0}, {5, -1, 3}, {5, 5, 3}, {-1, 5, 0}, "topography");
    const Section outcrops = cut_along(model, section_along(topography));
    CHECK(area_of(outcrops) == Approx(16 * std::sqrt(1.25)));
    CHECK(lengths_of(outcrops, model.mesh).at("horizon") == 4);
    const Surface turned{"", Role::unknown, topography.vertices, {{0, 2, 1}, {0, 3, 2}}};
    CHECK(cut_along(model, section_along(turned)).polygons.size() == outcrops.polygons.size());
    const Section wall =
        cut_along(model, section_along(quad({2, -1, -1}, {2, 5, -1}, {2, 5, 5}, {2, -1, 5})));
    CHECK(area_of(wall) == 16);
    const Section other =
        cut_along(model, section_along(quad({-1, 2, -1}, {5, 2, -1}, {5, 2, 5}, {-1, 2, 5})));
    // A steep surface is seen from its side, though it is one-to-one in the map as well.
    const Section steep = cut_along(
        model, section_along(quad({1.5, -1, -1}, {1.5, 5, -1}, {2.5, 5, 5}, {2.5, -1, 5})));
    for (std::size_t v = 0; v < steep.flat.size(); ++v)
        CHECK(steep.flat[v] == std::array{steep.vertices[v].y, steep.vertices[v].z});
    CHECK(area_of(steep) == Approx(4 * std::hypot(4, 4.0 / 6)));
    for (const Section* s : {&wall, &other, &outcrops, &steep})
        for (const SectionPolygon& p : s->polygons) CHECK(shoelace(*s, p.rings[0]) > 0);
}

TEST_CASE("sections: what makes no sense is refused") {
    const SectionModel model = small_model();
    const auto code = [&](const Point3& point, const Point3& normal) {
        return refusal_of_section(section_plane(model.mesh, point, normal));
    };
    CHECK(code({0, 0, 0}, {0, 0, 0}) == ErrorCode::bad_option);
    CHECK(code({0, NAN, 0}, {0, 0, 1}) == ErrorCode::bad_option);
    CHECK(code({0, 0, 0}, {0, INFINITY, 1}) == ErrorCode::bad_option);
    CHECK(code({1e308, 0, 0}, {1, 2, 0}) == ErrorCode::bad_option);
    CHECK(refusal_of_section(section_levels(model.mesh, {})) == ErrorCode::bad_option);
    CHECK(refusal_of_section(section_plane(Mesh{}, {}, {0, 0, 1})) == ErrorCode::nothing_to_do);
    CHECK(refusal_of_section(section_along(cube(0, 1))) == ErrorCode::bad_option);
    CHECK(refusal_of_section(section_along({"", Role::unknown, {}, {}})) ==
          ErrorCode::nothing_to_do);
    CHECK(refusal_of_section(section_along(moebius_strip())) == ErrorCode::bad_option);
    auto along = section_plane(model.mesh, {1, 1, 1}, {0, 0, 1});
    REQUIRE(along);
    Volumes others = model.volumes;
    others.of_sides.pop_back();
    CHECK(refusal_of_section(cut_section(model.mesh, others, *along)) ==
          ErrorCode::improper_contact);
    others = model.volumes;
    std::swap(others.of_sides[0][0], others.of_sides[0][1]);
    CHECK(refusal_of_section(cut_section(model.mesh, others, *along)) ==
          ErrorCode::improper_contact);
    along->surface.triangles.push_back(along->surface.triangles[0]);
    along->sheet_of.push_back(0);
    CHECK(refusal_of_section(cut_section(model.mesh, model.volumes, *along)) ==
          ErrorCode::bad_option);
    along->sheet_of.back() = 1;
    CHECK(refusal_of_section(cut_section(model.mesh, model.volumes, *along)) ==
          ErrorCode::bad_option);
}
