// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Laws of volumes: changes that must not affect them, their number by a formula, the blocks that
// real models state.
#include <terrane/algorithms/volumes/volumes.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include <catch2/catch.hpp>
#include <gmpxx.h>

#include "support/certified_inputs.hpp"
#include "support/exact_numbers.hpp"
#include "support/found_volumes.hpp"
#include "support/paths.hpp"
#include "support/points.hpp"
#include "support/solids.hpp"
#include "support/volume_oracle.hpp"
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/reading.hpp>

using namespace terrane;
using namespace test_support;

namespace {

/// Returns models that have volumes.
std::vector<Model> models() {
    std::vector<Model> all = certified_inputs(200);
    all.push_back({"eight cubes", {}});
    for (unsigned i = 0; i < 8; ++i) {
        const Point3 low{(i & 1U) != 0 ? 0.0 : -1.0, (i & 2U) != 0 ? 0.0 : -1.0,
                         (i & 4U) != 0 ? 0.0 : -1.0};
        all.back().surfaces.push_back(box(low, {low.x + 1, low.y + 1, low.z + 1}));
    }
    all.push_back({"nested", {cube(0, 9), cube(1, 8), cube(2, 3), octahedron({6, 6, 6}, 1.5)}});
    all.push_back({"rings", {torus({0, 0, 0}, 4, 1, 8), torus({4, 0, 0}, 4, 1, 8, 1)}});
    all.push_back({"crossing",
                   {cube(0, 2), cube(1, 3), octahedron({2, 2, 2}, 1.7), level(1.5, -1, -1, 4, 4),
                    quad({1, -1, -1}, {2, -1, 4}, {2, 4, 4}, {1, 4, -1})}});
    return all;
}

/// Reorders surfaces and triangles, rotates and flips triangles, and renumbers vertices.
std::vector<Surface> shuffled(std::vector<Surface> surfaces, std::mt19937_64& random) {
    for (Surface& s : surfaces) {
        std::shuffle(s.triangles.begin(), s.triangles.end(), random);
        std::vector<std::uint32_t> place(s.vertices.size());
        std::iota(place.begin(), place.end(), 0U);
        std::shuffle(place.begin(), place.end(), random);
        std::vector<Point3> vertices(s.vertices.size());
        for (std::size_t v = 0; v < place.size(); ++v) vertices[place[v]] = s.vertices[v];
        s.vertices = vertices;
        for (Triangle& t : s.triangles) {
            for (std::uint32_t& v : t) v = place[v];
            std::rotate(t.begin(), t.begin() + static_cast<int>(random() % 3), t.end());
            if (random() % 2 == 0) std::swap(t[0], t[1]);
        }
    }
    std::shuffle(surfaces.begin(), surfaces.end(), random);
    return surfaces;
}

template <class Move>
std::vector<Surface> moved(std::vector<Surface> surfaces, const Move& move) {
    for (Surface& s : surfaces)
        for (Point3& p : s.vertices) p = move(p);
    return surfaces;
}

std::vector<mpq_class> exact(const Found& found) {
    return test_support::exact_numbers(found.arrangement, found.volumes);
}

/// Returns the pairs of volumes that touch; a pair of equal numbers has something dangling in it.
std::set<std::array<std::uint32_t, 2>> neighbours(const Volumes& volumes) {
    std::set<std::array<std::uint32_t, 2>> pairs;
    for (auto sides : volumes.of_sides) {
        std::sort(sides.begin(), sides.end());
        pairs.insert(sides);
    }
    return pairs;
}

} // namespace

TEST_CASE("volumes: numbers and measures do not depend on the order of the input", "[volumes]") {
    std::mt19937_64 random(5);
    for (const Model& model : models()) {
        INFO(model.name);
        const Found found = find_in(model.surfaces);
        for (int i = 0; i < 2; ++i) {
            const Found other = find_in(shuffled(model.surfaces, random));
            CHECK(other.volumes.measures == found.volumes.measures);
            CHECK(exact(other) == exact(found));
            CHECK(neighbours(other.volumes) == neighbours(found.volumes));
        }
    }
}

TEST_CASE("volumes: scaling by a power of two scales the measures, exactly", "[volumes]") {
    for (const Model& model : models()) {
        INFO(model.name);
        double largest = 0;
        for (const Surface& s : model.surfaces)
            for (const Point3& p : s.vertices)
                largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        if (largest > 0x1p+200 || largest < 0x1p-200) continue;
        const Found found = find_in(model.surfaces);
        const Found other = find_in(moved(model.surfaces, [](const Point3& p) {
            return Point3{8 * p.x, 8 * p.y, 8 * p.z};
        }));
        auto expected = exact(found);
        for (mpq_class& e : expected) e *= 512;
        CHECK(exact(other) == expected);
        CHECK(neighbours(other.volumes) == neighbours(found.volumes));
    }
}

TEST_CASE("volumes: a reflection keeps the measures, and swaps front and back", "[volumes]") {
    for (const Model& model : models()) {
        INFO(model.name);
        const Found found = find_in(model.surfaces);
        const Found mirror = find_in(moved(model.surfaces, [](const Point3& p) {
            return Point3{-p.x, p.y, p.z};
        }));
        auto a = exact(found), b = exact(mirror);
        CHECK(a[0] == b[0]);
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        CHECK(a == b);
    }
    const Found cube_before = find_in({cube(0, 1)});
    const Found cube_after = find_in(moved({cube(0, 1)}, [](const Point3& p) {
        return Point3{-p.x, p.y, p.z};
    }));
    for (std::size_t t = 0; t < cube_before.volumes.of_sides.size(); ++t) {
        CHECK(cube_before.volumes.of_sides[t] == std::array<std::uint32_t, 2>{0, 1});
        CHECK(cube_after.volumes.of_sides[t] == std::array<std::uint32_t, 2>{1, 0});
    }
}

TEST_CASE("volumes: the certified inputs hold for the oracle", "[volumes]") {
    std::mt19937_64 random(3);
    std::size_t blocks = 0;
    for (const Model& model : certified_inputs(300)) {
        INFO(model.name);
        const Found found = find_in(model.surfaces);
        if (found.arrangement.triangles.empty()) continue;
        const VolumeOracle judge(found.arrangement);
        CHECK(found.volumes.block_count() == judge.block_count());
        CHECK(exact(found) == judge.measures(found.volumes));
        CHECK(judge.flaw_on_segment(found.volumes, random).empty());
        blocks += found.volumes.block_count();
    }
    CHECK(blocks > 20);
}

namespace {

/// A plane n x + d = 0 with integer coefficients.
using Plane = std::array<long, 4>;
const long half_width = 1L << 20; ///< of the box

/// Returns the plane over the box and beyond, as a quadrilateral whose corners are doubles on it: z
/// is computed from x and y, since the coefficient of z is 1.
Surface surface_of(const Plane& p) {
    const auto reach = static_cast<double>(2 * half_width);
    const auto at = [&](double x, double y) {
        return Point3{x, y, -(p[0] * x + p[1] * y + static_cast<double>(p[3]))};
    };
    return quad(at(-reach, -reach), at(reach, -reach), at(reach, reach), at(-reach, reach));
}

bool inside(const std::array<mpq_class, 3>& x) {
    return std::all_of(x.begin(), x.end(), [](const mpq_class& c) { return abs(c) < half_width; });
}

/// Tells whether the line in which two planes meet passes through the box, by clipping x = q + t r.
bool line_meets_box(const Plane& a, const Plane& b) {
    // On z = -(a0 x + a1 y + a3) = -(b0 x + b1 y + b3) lies a line in x and y.
    const mpq_class u = a[0] - b[0], v = a[1] - b[1], w = a[3] - b[3];
    if (u == 0 && v == 0) return false;
    std::array<mpq_class, 3> start, step;
    if (v != 0) {
        start = {0, -w / v, 0};
        step = {1, -u / v, 0};
    } else {
        start = {-w / u, 0, 0};
        step = {0, 1, 0};
    }
    start[2] = -(a[0] * start[0] + a[1] * start[1] + a[3]);
    step[2] = -(a[0] * step[0] + a[1] * step[1]);
    mpq_class low, high;
    bool bounded = false;
    for (unsigned k = 0; k < 3; ++k) {
        if (step[k] == 0) {
            if (abs(start[k]) >= half_width) return false;
            continue;
        }
        mpq_class t = (-half_width - start[k]) / step[k], s = (half_width - start[k]) / step[k];
        if (t > s) std::swap(t, s);
        low = bounded ? std::max(low, t) : t;
        high = bounded ? std::min(high, s) : s;
        bounded = true;
    }
    return low < high;
}

bool point_in_box(const Plane& a, const Plane& b, const Plane& c) {
    const mpq_class u = a[0] - b[0], v = a[1] - b[1], w = b[3] - a[3];
    const mpq_class r = a[0] - c[0], s = a[1] - c[1], q = c[3] - a[3];
    const mpq_class d = u * s - v * r;
    if (d == 0) return false;
    const mpq_class x = (w * s - v * q) / d, y = (u * q - w * r) / d;
    return inside({x, y, -(a[0] * x + a[1] * y + a[3])});
}

/// Returns the blocks without a corner outside the box; the planes enclose other blocks beyond it.
std::set<std::uint32_t> blocks_inside(const Found& found, double half) {
    std::set<std::uint32_t> in, out;
    for (std::size_t t = 0; t < found.arrangement.triangles.size(); ++t)
        for (const std::uint32_t block : found.volumes.of_sides[t])
            for (const std::uint32_t v : found.arrangement.triangles[t]) {
                const Point3 p =
                    found.arrangement.state->points.nearest(found.arrangement.vertices[v]);
                in.insert(block);
                if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > half)
                    out.insert(block);
            }
    out.insert(0);
    for (const std::uint32_t block : out) in.erase(block);
    return in;
}

} // namespace

TEST_CASE("volumes: random planes through a box make as many blocks as Euler's formula says",
          "[volumes][once]") {
    Random random(50);
    constexpr int planes = 50;
    std::vector<Plane> all;
    std::vector<Surface> model{box({-double(half_width), -double(half_width), -double(half_width)},
                                   {double(half_width), double(half_width), double(half_width)})};
    for (int i = 0; i < planes; ++i) {
        all.push_back({random_int(random, -5000, 5000), random_int(random, -5000, 5000), 1,
                       random_int(random, -1000000, 1000000)});
        model.push_back(surface_of(all.back()));
    }
    // In general position each plane, each line of two and each point of three inside the box adds
    // a cell.
    std::size_t cells = 1 + all.size();
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            cells += line_meets_box(all[i], all[j]) ? 1 : 0;
            for (std::size_t k = 0; k < j; ++k)
                cells += point_in_box(all[i], all[j], all[k]) ? 1 : 0;
        }
    const Found found = find_in(model);
    const auto blocks = blocks_inside(found, static_cast<double>(half_width));
    CHECK(blocks.size() == cells);
    CHECK(cells > 5000);
    mpq_class sum;
    const auto measures = exact(found);
    for (const std::uint32_t b : blocks) sum += measures[b];
    CHECK(sum == mpq_class(std::ldexp(1.0, 63)));
}

TEST_CASE("volumes: real models have the blocks that they state", "[volumes]") {
    for (const std::string name : {"modelA1", "modelA2", "split_cube"}) {
        INFO(name);
        const auto model = read_model(test_data() + "/ringmesh/" + name + ".ml");
        REQUIRE(model);
        const GocadModel& stated = model.value();
        const Found found = find_in(stated.surfaces);
        CHECK(found.volumes.block_count() + 1 == stated.regions.size());
        if (name == "split_cube") continue; // its signs do not fit its triangles
        // Each triangle of the file is a triangle of the arrangement, so that the sides can be
        // compared.
        REQUIRE(found.arrangement.triangles.size() == found.arrangement.parents_of.values.size());
        std::map<std::uint32_t, std::uint32_t> triangle_of; // by input triangle
        for (std::uint32_t t = 0; t < found.arrangement.triangles.size(); ++t)
            triangle_of[found.arrangement.parents_of[t][0]] = t;
        std::set<std::uint32_t> seen;
        for (const ModelRegion& region : stated.regions) {
            std::set<std::uint32_t> volumes;
            for (const ModelSide& side : region.sides) {
                const ModelPart& part = stated.parts[side.part];
                const std::uint32_t first =
                    found.arrangement.inputs.first[part.surface] + part.first_triangle;
                for (std::uint32_t t = first; t < first + part.triangle_count; ++t)
                    volumes.insert(
                        found.volumes.of_sides[triangle_of.at(t)][side.positive ? 0 : 1]);
            }
            INFO(region.name);
            REQUIRE(volumes.size() == 1);
            CHECK((*volumes.begin() == 0) == (region.name == "Universe"));
            CHECK(seen.insert(*volumes.begin()).second);
        }
    }
}
