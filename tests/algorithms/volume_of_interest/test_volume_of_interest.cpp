// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks the laws of the cut with rationals that share no code with it.
#include <terrane/algorithms/arrangement/intersection_edges.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <catch2/catch.hpp>
#include <gmpxx.h>

#include "support/boundary_bodies.hpp"
#include "support/certified_inputs.hpp"
#include "support/cut_cases.hpp"
#include "support/effort.hpp"
#include "support/exact_numbers.hpp"
#include "support/points.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/arrangement/restricted.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

using namespace terrane;
using namespace test_support;
using namespace cut_cases;

namespace {

/// Checks that the rest, in doubles, is a conforming mesh with the same blocks.
std::vector<mpq_class> volumes_of(const Arrangement& a) {
    const auto volumes = find_volumes(a);
    REQUIRE(volumes);
    const auto exact = test_support::exact_numbers(a, volumes.value());
    mpq_class sum;
    for (std::size_t v = 1; v < exact.size(); ++v) sum += exact[v];
    CHECK(sum == exact[0]);
    return exact;
}

/// Locates a point in a box, in rationals.
Where place_in_box(const Spot& p, const Point3& low, const Point3& high) {
    const std::array<double, 3> l{low.x, low.y, low.z}, h{high.x, high.y, high.z};
    bool on = false;
    for (unsigned k = 0; k < 3; ++k) {
        if (p[k] < l[k] || p[k] > h[k]) return Where::outside;
        on = on || p[k] == l[k] || p[k] == h[k];
    }
    return on ? Where::boundary : Where::inside;
}

Surface soup_of(Random& random, Family family, std::size_t triangles) {
    Surface s{"soup", Role::unknown, points_of(random, family, 3 * triangles), {}};
    for (std::uint32_t t = 0; t < triangles; ++t)
        s.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    return s;
}

/// Checks that each triangle lies where an independent test of its centroid says, and that the
/// pieces of each input triangle add up to it: inside, outside and on the boundary.
void check_against_box(const Case& c, const Point3& low, const Point3& high) {
    const auto spots = spots_of(c.whole);
    std::vector<Spot> sums(c.whole.state->corners.size());
    for (std::size_t t = 0; t < c.whole.triangles.size(); ++t) {
        const auto [i, j, k] = c.whole.triangles[t];
        Spot centre;
        for (unsigned d = 0; d < 3; ++d) centre[d] = (spots[i][d] + spots[j][d] + spots[k][d]) / 3;
        REQUIRE(c.where[t] == place_in_box(centre, low, high));
        const Spot n = normal_of(spots[i], spots[j], spots[k]);
        for (const std::uint32_t p : c.whole.parents_of[t])
            for (unsigned d = 0; d < 3; ++d) sums[p][d] += abs(n[d]);
    }
    std::size_t kept = 0;
    for (const Where w : c.where) kept += w != Where::outside ? 1U : 0U;
    CHECK(c.cut.arrangement.triangles.size() == kept);
}

} // namespace

TEST_CASE("volume of interest: horizons and a fault in a box have the expected blocks", "[voi]") {
    const std::vector<Surface> model{level(3, -1, -1, 9, 9, "base"), level(5, -1, -1, 9, 9, "top"),
                                     quad({4, -1, -1}, {4, 9, -1}, {4, 9, 9}, {4, -1, 9}, "F1")};
    const auto c = cut(model, box_of({0, 0, 0}, {8, 8, 8}));
    check_consistent(c.cut.arrangement);
    const auto volumes = volumes_of(c.cut.arrangement);
    REQUIRE(volumes.size() == 7); // three layers on each side of the fault
    CHECK(volumes[0] == 512);
    CHECK(c.cut.report.borders.empty());
    for (std::size_t s = 0; s < 3; ++s) {
        CHECK(c.cut.report.surfaces[s].area_inside == Approx(64));
        CHECK(c.cut.report.surfaces[s].area_outside == Approx(36));
        CHECK(c.cut.report.surfaces[s].pieces == 1);
    }
    const auto rounded = round_to_doubles(c.cut.arrangement);
    REQUIRE(rounded);
    CHECK(rounded.value().report.clean);
    CHECK(find_volumes(rounded.value().mesh).value().total == 512);
}

TEST_CASE(
    "volume of interest: surfaces in the boundary, touching it and ending inside are reported",
    "[voi]") {
    const std::vector<Surface> model{
        level(8, 2, 2, 6, 10, "in the top face, and beyond"),
        level(4, 0, 2, 4, 6, "border on a side"), level(6, 3, 3, 5, 5, "inside"),
        quad({8, 8, 0}, {8, 8, 8}, {12, 12, 8}, {12, 12, 0}, "outside, on a vertical edge"),
        level(20, 0, 0, 1, 1, "far away")};
    const auto c = cut(model, box_of({0, 0, 0}, {8, 8, 8}));
    check_consistent(c.cut.arrangement);
    const auto& s = c.cut.report.surfaces;
    CHECK(s[0].area_on_boundary == Approx(24));
    CHECK(s[0].area_outside == Approx(8));
    CHECK(s[0].area_inside == 0);
    CHECK(s[1].area_inside == Approx(16));
    CHECK(s[1].open_length == Approx(12)); // three of its four edges
    CHECK(s[2].open_length == Approx(8));
    CHECK(s[2].open_borders == 1);
    CHECK(s[3].area_outside == Approx(8 * std::sqrt(32)));
    CHECK(s[3].pieces == 0);
    CHECK(s[4].pieces == 0);
    REQUIRE(c.cut.report.borders.size() == 2);
    CHECK(c.cut.report.borders[0].place == Point3{0, 2, 4});
    CHECK(c.cut.report.borders[1].place == Point3{3, 3, 6});
    CHECK(volumes_of(c.cut.arrangement) == std::vector<mpq_class>{512, 512});
    CHECK(round_to_doubles(c.cut.arrangement).value().report.clean);
}

TEST_CASE("volume of interest: surfaces inside the volume do not change", "[voi]") {
    const auto c =
        cut({level(3, 1, 1, 7, 7), octahedron({4, 4, 4}, 2)}, box_of({0, 0, 0}, {8, 8, 8}));
    CHECK(c.cut.arrangement.triangles == c.whole.triangles);
    CHECK(c.cut.arrangement.vertices == c.whole.vertices);
    CHECK(c.cut.arrangement.parents_of == c.whole.parents_of);
    CHECK(c.cut.arrangement.intersection_edges == c.whole.intersection_edges);
}

TEST_CASE("volume of interest: a cavity is outside, bodies that touch are inside", "[voi]") {
    const auto nested = closed_boundary(std::vector{cube(0, 8), cube(2, 6)});
    REQUIRE(nested);
    const auto c = cut({level(4, -1, -1, 9, 9)}, nested.value());
    CHECK(c.cut.report.surfaces[0].area_inside == Approx(48));
    CHECK(c.cut.report.surfaces[0].area_outside == Approx(52));
    const auto edge = closed_boundary(
        std::vector{box({0, 0, 0}, {4, 4, 4}), box({4, 4, 0}, {8, 8, 4})}); // share an edge
    REQUIRE(edge);
    const auto two = cut({level(2, -1, -1, 9, 9)}, edge.value());
    CHECK(two.cut.report.surfaces[0].area_inside == Approx(32));
    CHECK(volumes_of(two.cut.arrangement)[0] == 128);
}

TEST_CASE("volume of interest: closed surfaces of any shape can be boundaries", "[voi]") {
    const std::vector<Surface> bodies{torus({0, 0, 0}, 4, 1.5, 9), octahedron({0, 0, 0}, 5),
                                      torus({0, 0, 0}, 4, 1, 12, 0)};
    for (const Surface& body : bodies) {
        const auto boundary = closed_boundary(std::vector{body});
        REQUIRE(boundary);
        const auto c = cut({level(0, -9, -9, 9, 9, "level"), level(0.5, -9, 0, 9, 9, "half"),
                            quad({0, -9, -9}, {0, 9, -9}, {0, 9, 9}, {0, -9, 9}, "fault")},
                           boundary.value());
        check_consistent(c.cut.arrangement);
        const auto volumes = volumes_of(c.cut.arrangement);
        CHECK(volumes[0] == abs(volume_of(boundary.value())));
        for (std::size_t s = 0; s < 3; ++s) {
            const SurfaceCut& r = c.cut.report.surfaces[s];
            CHECK(r.area_inside + r.area_outside + r.area_on_boundary ==
                  Approx(s == 1 ? 162 : 324));
        }
        CHECK(round_to_doubles(c.cut.arrangement).value().report.clean);
    }
}

TEST_CASE("volume of interest: random triangles in a box, judged by rationals", "[voi]") {
    Random random(11);
    const std::array families{Family::lattice, Family::uniform, Family::decimals};
    for (int round = 0; round < cases(90); ++round) {
        const Family family = families[static_cast<std::size_t>(round) % families.size()];
        const bool lattice = family == Family::lattice;
        const Point3 low = lattice ? Point3{-1, -1, -2} : Point3{-0.4, -0.3, -0.5},
                     high = lattice ? Point3{1, 2, 1} : Point3{0.5, 0.4, 0.3};
        const auto c =
            cut({soup_of(random, family, 8), soup_of(random, family, 4)}, box_of(low, high));
        check_against_box(c, low, high);
        check_consistent(c.cut.arrangement);
        mpq_class box = 1;
        box *= mpq_class(high.x) - low.x;
        box *= mpq_class(high.y) - low.y;
        box *= mpq_class(high.z) - low.z;
        CHECK(volumes_of(c.cut.arrangement)[0] == box);
        const auto rounded = round_to_doubles(c.cut.arrangement);
        REQUIRE(rounded);
        if (!rounded.value().report.clean) continue;
        const Mesh& m = rounded.value().mesh;
        CHECK(check(std::vector{Surface{"", Role::unknown, m.vertices, m.triangles}})
                  .value()
                  .clean());
    }
}

TEST_CASE("volume of interest: the result does not depend on threads, and it can be stopped",
          "[voi]") {
    Random random(2);
    std::vector<Surface> surfaces{soup_of(random, Family::uniform, 60)};
    const auto boundary = box_of({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    surfaces.insert(surfaces.end(), boundary.begin(), boundary.end());
    std::vector<std::uint32_t> ids(boundary.size());
    std::iota(ids.begin(), ids.end(), 1U);
    Run one, four;
    four.threads = 4;
    const auto a = cut_to_volume(arrange(surfaces, {}, one).value(), ids, one),
               b = cut_to_volume(arrange(surfaces, {}, four).value(), ids, four);
    CHECK(a.value().arrangement.triangles == b.value().arrangement.triangles);
    CHECK(a.value().arrangement.vertices == b.value().arrangement.vertices);
    CHECK(a.value().arrangement.intersection_edges == b.value().arrangement.intersection_edges);
    std::stop_source source;
    source.request_stop();
    one.stop = source.get_token();
    CHECK(cut_to_volume(arrange(surfaces).value(), ids, one).error().code ==
          ErrorCode::interrupted);
}

TEST_CASE(
    "volume of interest: hard inputs cut in two halves add up, and round where the whole does",
    "[voi][once]") {
    std::size_t tried = 0, moved = 0;
    for (const Model& model : certified_inputs(400)) {
        Point3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        for (const Surface& s : model.surfaces)
            for (const Point3& p : s.vertices) {
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            }
        const double w = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
        const double middle = low.x + (high.x - low.x) / 2;
        const Point3 least{low.x - w, low.y - w, low.z - w},
            most{high.x + w, high.y + w, high.z + w};
        const auto left = box_boundary(least, {middle, most.y, most.z}),
                   right = box_boundary({middle, least.y, least.z}, most);
        if (!left || !right) continue; // beyond the largest double
        INFO(model.name);
        ++tried;
        const auto a = cut(model.surfaces, left.value()), b = cut(model.surfaces, right.value());
        check_consistent(a.cut.arrangement);
        check_consistent(b.cut.arrangement);
        for (std::size_t s = 0; s < model.surfaces.size(); ++s) {
            const SurfaceCut &l = a.cut.report.surfaces[s], &r = b.cut.report.surfaces[s];
            CHECK(l.area_inside == Approx(r.area_outside).margin(1e-9 * w * w));
            CHECK(l.area_outside == Approx(r.area_inside).margin(1e-9 * w * w));
            CHECK(l.area_on_boundary == Approx(r.area_on_boundary).margin(1e-9 * w * w));
        }
        CHECK(find_volumes(a.cut.arrangement).value().total ==
              Approx(volume_of(left.value()).get_d()));
        const auto whole = round_to_doubles(a.whole), part = round_to_doubles(a.cut.arrangement);
        REQUIRE(whole);
        REQUIRE(part);
        if (!whole.value().report.clean) continue;
        CHECK(part.value().report.clean);
        moved += part.value().report.moved_input_vertices > 0 ? 1U : 0U;
    }
    CHECK(tried > 40);
    CHECK(moved > 0); // rounding had to repeat some arrangements
}
