// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Where blocks repair doubles, the mesh is that of round_to_doubles(), bit by bit. Where they do not,
// rounding had to move the input.
#include "support/files.hpp"
#include "support/in_blocks.hpp"

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/digest.hpp>
#include <terrane/algorithms/distribution/distributed_arrangement.hpp>
#include <terrane/algorithms/distribution/local_supersteps.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/algorithms/volumes/volumes_in_blocks.hpp>

#include <catch2/catch.hpp>

#include <cstdint>
#include <random>

namespace {

using namespace terrane;
using namespace terrane::distribution;
using test_support::arranged;
using test_support::joined;

constexpr Point3 far_away{5e5, 4e6, 0};

/// Random points in a box far from the origin.
class RandomPoints {
public:
    explicit RandomPoints(unsigned seed) : random_(seed) {}

    std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(random_() % count); }
    double share() { return std::uniform_real_distribution<double>(0, 1)(random_); }
    Point3 near(const Point3& p, double size) {
        return {p.x + size * share(), p.y + size * share(), p.z + size * share()};
    }

private:
    std::mt19937 random_;
};

void add_triangle(Surface& s, const std::array<Point3, 3>& corners) {
    const auto first = static_cast<std::uint32_t>(s.vertices.size());
    s.vertices.insert(s.vertices.end(), corners.begin(), corners.end());
    s.triangles.push_back({first, first + 1, first + 2});
}

Surface box_around(const Point3& low, double size) {
    Surface box{"box", Role::boundary, {}, {}};
    for (unsigned k = 0; k < 8; ++k)
        box.vertices.push_back(
            {low.x + size * (k & 1U), low.y + size * (k >> 1U & 1U), low.z + size * (k >> 2U)});
    box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return box;
}

/// Two triangles that cross, so far away that doubles there are as far apart as the soup is wide.
Surface distant() {
    Surface s{"distant", Role::unknown, {}, {}};
    const double d = 1e9;
    add_triangle(s, {Point3{d, d, d}, {1.7 * d, 1.1 * d, 1.2 * d}, {1.1 * d, 1.9 * d, 1.3 * d}});
    add_triangle(s, {Point3{1.1 * d, 1.2 * d, 0.9 * d},
                     {1.5 * d, 1.3 * d, 1.9 * d},
                     {1.2 * d, 1.4 * d, 1.7 * d}});
    return s;
}

/// Triangles, some of them twice, and a box, so small and so far from the origin that some crossings are
/// as near to each other as doubles are.
std::vector<Surface> far_soup(unsigned seed, std::uint32_t count, double size) {
    RandomPoints random(seed);
    std::vector<Surface> surfaces{{"a", Role::unknown, {}, {}}, {"b", Role::unknown, {}, {}}};
    for (Surface& s : surfaces)
        for (std::uint32_t t = 0; t < count; ++t) {
            const Point3 at = random.near(far_away, 6 * size);
            add_triangle(s, {random.near(at, 2 * size), random.near(at, 2 * size),
                             random.near(at, 2 * size)});
            if (t % 4 == 0) s.triangles.push_back(s.triangles.back());
        }
    surfaces.push_back(box_around(random.near(far_away, size), 6 * size));
    return surfaces;
}

/// Crossing waves far from the origin, with heaps of tiny triangles on them.
std::vector<Surface> waves_with_crumbs(unsigned seed, unsigned n, unsigned heaps, double size) {
    RandomPoints random(seed);
    auto surfaces = test_support::waves(n, 0.0123);
    for (Surface& s : surfaces)
        for (Point3& p : s.vertices) p = {p.x + far_away.x, p.y + far_away.y, p.z};
    Surface crumbs{"crumbs", Role::unknown, {}, {}};
    for (unsigned h = 0; h < heaps; ++h) {
        const Surface& on = surfaces[random.below(2)];
        const Triangle& c = on.triangles[random.below(on.triangles.size())];
        const double u = random.share(), v = (1 - u) * random.share(), w = 1 - u - v;
        const Point3 &a = on.vertices[c[0]], &b = on.vertices[c[1]], &d = on.vertices[c[2]];
        const Point3 at{u * a.x + v * b.x + w * d.x - size / 2,
                        u * a.y + v * b.y + w * d.y - size / 2,
                        u * a.z + v * b.z + w * d.z - size / 2};
        for (unsigned k = 0; k < 4; ++k)
            add_triangle(crumbs,
                         {random.near(at, size), random.near(at, size), random.near(at, size)});
    }
    surfaces.push_back(std::move(crumbs));
    return surfaces;
}

struct Expected {
    std::vector<Surface> surfaces;
    Arrangement exact;
    RoundedMesh rounded;

    explicit Expected(std::vector<Surface> all) :
        surfaces(std::move(all)), exact(*arrange(surfaces)), rounded(*round_to_doubles(exact)) {}
};

/// How models were repaired.
struct Seen {
    std::size_t repaired = 0; ///< in blocks
    std::size_t changed = 0;  ///< with other triangles than the exact ones
    std::size_t few = 0;      ///< with less than half of the triangles
    std::size_t left = 0;
};

void check(const Expected& expected, Supersteps& blocks, Seen& seen) {
    const auto& rounding = expected.rounded.report;
    const Mesh& mesh = *expected.rounded.mesh;
    const auto report = arranged(blocks, expected.surfaces);
    CHECK(report.digest == canonical_digest(expected.surfaces, expected.exact));
    if (!report.clean) {
        CHECK((rounding.arranged_again || !rounding.clean));
        CHECK_FALSE(report.repair);
        ++seen.left;
        return;
    }
    REQUIRE(rounding.clean);
    CHECK(report.vertices == mesh.vertices.size());
    CHECK(report.triangles == mesh.triangles.size());
    CHECK(report.intersection_edges == mesh.intersection_edges.size());
    CHECK(report.regions == expected.rounded.regions.size());
    CHECK(report.deviation == Approx(rounding.max_move));
    const Mesh found = joined(blocks, report);
    CHECK(found.vertices == mesh.vertices);
    CHECK(found.triangles == mesh.triangles);
    CHECK(found.surfaces_of == mesh.surfaces_of);
    CHECK(found.regions_of == mesh.regions_of);
    CHECK(found.parents_of == mesh.parents_of);
    if (!report.repair) {
        CHECK(rounding.naive_contacts == 0);
        CHECK(rounding.merged_vertices == 0);
        return;
    }
    ++seen.repaired;
    CHECK(report.repair->contacts == rounding.naive_contacts);
    CHECK(report.repair->rounds == rounding.rounds);
    CHECK(report.repair->surface_deviation == Approx(rounding.surface_deviation));
    CHECK(report.repair->lost_length == Approx(rounding.lost_length));
    if (mesh.triangles.size() != expected.exact.triangles.size()) ++seen.changed;
    if (2 * report.repair->triangles < report.triangles) ++seen.few;
    const auto measures = find_volumes_in_blocks(blocks);
    REQUIRE(measures);
    const auto volumes = find_volumes(mesh);
    REQUIRE(volumes);
    CHECK(*measures == volumes->measures);
}

void check(const Expected& expected, std::size_t count, Seen& seen) {
    const Run run;
    LocalSupersteps blocks({count, {}}, run);
    check(expected, blocks, seen);
}

} // namespace

TEST_CASE("repair in blocks: random soups, in any number of blocks", "[distribution]") {
    Seen seen;
    for (const double size : {1e-7, 3e-8, 1e-8, 5e-9})
        for (unsigned seed = 0; seed < 6; ++seed) {
            CAPTURE(size, seed);
            const Expected expected(far_soup(seed, 60, size));
            for (const std::size_t count : {1, 2, 5}) check(expected, count, seen);
        }
    CHECK(seen.repaired >= 36);
    CHECK(seen.changed >= 9);
    CHECK(seen.left >= 3); // so the test below the limits of the repair is one, too
}

TEST_CASE("repair in blocks: few triangles are gathered where few are in the way",
          "[distribution]") {
    Seen seen;
    for (const double size : {1e-6, 2e-7})
        for (unsigned seed = 0; seed < 5; ++seed) {
            CAPTURE(size, seed);
            const Expected expected(waves_with_crumbs(seed, 30, 20, size));
            for (const std::size_t count : {2, 7}) check(expected, count, seen);
        }
    CHECK(seen.repaired >= 8);
    CHECK(seen.few == seen.repaired);
}

TEST_CASE("repair in blocks: what is far away counts for grids, moves and limits",
          "[distribution]") {
    Seen seen;
    for (unsigned seed = 0; seed < 6; ++seed) {
        CAPTURE(seed);
        auto surfaces = far_soup(seed, seed < 4 ? 60 : 120, 1e-8); // the latter are snapped
        surfaces.push_back(distant());
        const Expected expected(std::move(surfaces));
        for (const std::size_t count : {1, 2}) check(expected, count, seen);
    }
    CHECK(seen.repaired >= 4);
    CHECK(seen.changed >= 1);
}

TEST_CASE("repair in blocks: in files and in threads", "[distribution]") {
    const Expected expected(far_soup(1, 40, 3e-8));
    REQUIRE(expected.rounded.report.naive_contacts > 0);
    Seen seen;
    const test_support::TemporaryFolder folder;
    const Run alone, several{.threads = 2};
    LocalSupersteps in_files({3, folder.path()}, alone), in_threads({3, {}}, several);
    check(expected, in_files, seen);
    check(expected, in_threads, seen);
    CHECK(seen.repaired == 2);
}
