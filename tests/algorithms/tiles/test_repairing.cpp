// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Where tiles repair doubles, or move the input, the mesh is that of round_to_doubles(), bit by bit.
#include "support/files.hpp"
#include "support/in_tiles.hpp"
#include "support/paths.hpp"

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/algorithms/tiles/local_supersteps.hpp>
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>
#include <terrane/algorithms/tiles/volumes_in_tiles.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/io/files.hpp>
#include <terrane/kernel/predicates.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <random>
#include <set>

namespace {

using namespace terrane;
using namespace terrane::tiles;
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
    std::size_t repaired = 0; ///< in tiles
    std::size_t changed = 0;  ///< with other triangles than the exact ones
    std::size_t few = 0;      ///< with less than half of the triangles
    std::size_t moved = 0;    ///< after the input was moved
    std::size_t left = 0;     ///< to one process
};

/// Lets one process repair what the tiles have left to it.
void check_left(const Expected& expected, Supersteps& tiles) {
    const auto whole = repair_in_one_process(tiles);
    REQUIRE(whole);
    CHECK(whole->report.clean == expected.rounded.report.clean);
    CHECK(whole->piece.mesh.vertices == expected.rounded.mesh->vertices);
    CHECK(whole->piece.mesh.triangles == expected.rounded.mesh->triangles);
    CHECK(whole->piece.mesh.parents_of == expected.rounded.mesh->parents_of);
}

/// Rounding leaves nothing of these surfaces, and tiles say the same.
void check_refused(const std::vector<Surface>& surfaces, Supersteps& tiles) {
    const auto whole = round_to_doubles(*arrange(surfaces));
    const auto report =
        arrange_in_tiles(tiles, test_support::reader_of(surfaces), {surfaces.size()});
    const Error said = report ? repair_in_one_process(tiles).error() : report.error();
    CHECK_FALSE((report && report->clean));
    CHECK(said.code == ErrorCode::nothing_to_do);
    CHECK(said.message() == whole.error().message());
}

TiledReport check(const Expected& expected, Supersteps& tiles, Seen& seen,
                  std::uint64_t most_gathered = TiledOptions{}.most_gathered) {
    const auto& rounding = expected.rounded.report;
    const Mesh& mesh = *expected.rounded.mesh;
    const auto report = arranged(tiles, expected.surfaces, most_gathered);
    CHECK(report.digest == canonical_digest(expected.surfaces, expected.exact));
    if (!report.clean) {
        CHECK_FALSE(report.repair);
        check_left(expected, tiles);
        ++seen.left;
        return report;
    }
    REQUIRE(rounding.clean);
    CHECK(report.vertices == mesh.vertices.size());
    CHECK(report.triangles == mesh.triangles.size());
    CHECK(report.intersection_edges == mesh.intersection_edges.size());
    CHECK(report.regions == expected.rounded.regions.size());
    if (!report.repair || !report.repair->is_moved)
        CHECK(report.deviation == Approx(rounding.max_move));
    const Mesh found = joined(tiles, report);
    CHECK(found.vertices == mesh.vertices);
    CHECK(found.triangles == mesh.triangles);
    CHECK(found.surfaces_of == mesh.surfaces_of);
    CHECK(found.regions_of == mesh.regions_of);
    CHECK(found.parents_of == mesh.parents_of);
    if (!report.repair) {
        CHECK(rounding.naive_contacts == 0);
        CHECK(rounding.merged_vertices == 0);
        return report;
    }
    ++seen.repaired;
    const bool are_counted = rounding.naive_contacts <= RoundingReport::most_counted;
    if (are_counted) CHECK(report.repair->contacts == rounding.naive_contacts);
    CHECK(report.repair->contacts >= rounding.naive_contacts);
    CHECK(report.repair->rounds == rounding.rounds);
    CHECK(report.repair->surface_deviation == Approx(rounding.surface_deviation));
    if (mesh.triangles.size() != expected.exact.triangles.size()) ++seen.changed;
    if (2 * report.repair->triangles < report.triangles) ++seen.few;
    if (report.repair->is_moved) ++seen.moved;
    const auto in_tiles = find_volumes_in_tiles(tiles);
    REQUIRE(in_tiles);
    const auto volumes = find_volumes(mesh);
    REQUIRE(volumes);
    CHECK(in_tiles->measures == volumes->measures);
    CHECK(in_tiles->total == volumes->total);
    return report;
}

void check(const Expected& expected, std::size_t count, Seen& seen,
           std::uint64_t most_gathered = TiledOptions{}.most_gathered) {
    const Run run;
    LocalSupersteps tiles({count, {}}, run);
    check(expected, tiles, seen, most_gathered);
}

/// Two sheets in one plane, and triangles across them; some are there twice, some nearly, and some have no
/// area. Coordinates are tenths, far from the origin, or the plane is turned: then all is coplanar but for
/// the error of doubles.
std::vector<Surface> sheets_in_a_plane(unsigned seed, bool is_turned) {
    RandomPoints random(seed);
    const auto at = [&](int x, int y, int z) -> Point3 {
        const double u = x / 10.0, v = y / 10.0, w = z / 10.0;
        if (!is_turned) return {far_away.x + u, far_away.y + v, far_away.x + w};
        return {0.8 * u - 0.36 * v + 0.48 * w, 0.8 * v + 0.6 * w, -0.6 * u - 0.48 * v + 0.64 * w};
    };
    const int slope = is_turned ? 0 : 2;
    const auto in_plane = [&](int x, int y) { return at(x, y, slope * x - y * (slope / 2)); };
    std::vector<Surface> surfaces{{"a", Role::unknown, {}, {}}, {"b", Role::unknown, {}, {}}};
    for (const int step : {7, 8}) {
        const int cells = 56 / step, shift = static_cast<int>(random.below(5));
        Surface& s = surfaces[step == 7 ? 0 : 1];
        for (int i = 0; i < cells; ++i)
            for (int k = 0; k < cells; ++k) {
                const int x = step * i + shift, y = step * k;
                add_triangle(s, {in_plane(x, y), in_plane(x + step, y), in_plane(x, y + step)});
                add_triangle(s, {in_plane(x + step, y), in_plane(x + step, y + step),
                                 in_plane(x, y + step)});
                if (random.below(8) == 0) s.triangles.push_back(s.triangles.back());
                if (random.below(8) == 0) { // another one until the input is moved
                    Point3 near = in_plane(x, y);
                    near.z = std::nextafter(near.z, HUGE_VAL);
                    add_triangle(s, {near, in_plane(x + step, y), in_plane(x, y + step)});
                }
            }
    }
    for (unsigned t = 0; t < 6; ++t) {
        const auto any = [&](int low, int high) {
            return low + static_cast<int>(random.below(static_cast<std::size_t>(high - low)));
        };
        add_triangle(surfaces[t % 2], {at(any(0, 56), any(0, 56), any(-60, 0)),
                                       at(any(0, 56), any(0, 56), any(0, 60)),
                                       at(any(0, 56), any(0, 56), any(60, 120))});
        // On a diagonal of space, through the turned plane: in a frame it is no line.
        const auto on_diagonal = [&] {
            const double d = 9 * random.share() - 4.5;
            return Point3{d, d, d};
        };
        add_triangle(surfaces[t % 2], {on_diagonal(), on_diagonal(), on_diagonal()});
    }
    return surfaces;
}

/// Triangles on a lattice of few spacings, far from the origin: the points where they cross are in the same few
/// doubles, as are too many of their parts for a list of pairs.
std::vector<Surface> heap_on_lattice(unsigned seed, std::uint32_t count, const Point3& at,
                                     double spacing, unsigned range) {
    RandomPoints random(seed);
    std::vector<Surface> surfaces{{"a", Role::unknown, {}, {}}, {"b", Role::unknown, {}, {}}};
    const auto next = [&] {
        return Point3{at.x + spacing * random.below(range), at.y + spacing * random.below(range),
                      at.z + spacing * random.below(range)};
    };
    for (std::uint32_t t = 0; t < count; ++t)
        add_triangle(surfaces[t % 2], {next(), next(), next()});
    return surfaces;
}

/// Returns how many pairs of different triangles with area overlap in the nearest doubles.
std::uint64_t overlapping_pairs(const Arrangement& exact) {
    std::vector<Point3> points;
    for (std::uint32_t v = 0; v < exact.vertices.size(); ++v)
        points.push_back(exact.nearest(VertexId{v}));
    std::set<std::array<Point3, 3>> different;
    for (const Triangle& t : exact.triangles) {
        std::array corners{points[t[0]], points[t[1]], points[t[2]]};
        if (collinear(corners[0], corners[1], corners[2])) continue;
        std::sort(corners.begin(), corners.end());
        different.insert(corners);
    }
    std::vector<Box> boxes;
    for (const auto& c : different) boxes.push_back(box_of(c, {0, 1, 2}));
    return (*count_candidate_pairs(boxes, [](const CandidatePair&) { return 0; }))[0];
}

} // namespace

TEST_CASE("repair in tiles: random soups, in any number of tiles", "[tiles]") {
    Seen seen;
    for (const double size : {1e-7, 3e-8, 1e-8, 5e-9})
        for (unsigned seed = 0; seed < 6; ++seed) {
            CAPTURE(size, seed);
            const Expected expected(far_soup(seed, 60, size));
            for (const std::size_t count : {1, 2, 5}) check(expected, count, seen);
        }
    CHECK(seen.repaired >= 36);
    CHECK(seen.changed >= 9);
    CHECK(seen.moved >= 3);
    CHECK(seen.left == 0);
}

TEST_CASE("repair in tiles: the input is moved", "[tiles][once]") {
    for (const bool is_turned : {false, true}) {
        Seen seen;
        for (unsigned seed = 0; seed < 5; ++seed) {
            CAPTURE(is_turned, seed);
            const Expected expected(sheets_in_a_plane(seed, is_turned));
            for (const std::size_t count : {1, 2, 5}) check(expected, count, seen);
        }
        CHECK(seen.moved >= 12);
        CHECK(seen.left == 0);
    }
}

TEST_CASE("repair in tiles: files on which rounding failed before", "[tiles][once]") {
    Seen seen;
    const std::filesystem::path folder(test_support::test_data() + "/regression");
    for (const auto& file : std::filesystem::directory_iterator(folder)) {
        if (file.path().extension() != ".obj") continue;
        CAPTURE(file.path().filename().string());
        const auto surfaces = read_surfaces(file.path());
        REQUIRE(surfaces);
        const Expected expected(*surfaces);
        for (const std::size_t count : {2, 40}) check(expected, count, seen);
    }
    CHECK(seen.repaired > 0);
    CHECK(seen.moved > 0);
    // The first meshes of three may be parted from others; a fourth needs one spacing on all axes.
    CHECK(seen.left == 8);
}

TEST_CASE("repair in tiles: what one process takes last is left to it", "[tiles]") {
    for (const char* file : {"022-hole-at-a-common-side", "023-crossing-parted-by-a-grid"}) {
        CAPTURE(file);
        const auto surfaces =
            read_surfaces(test_support::test_data() + "/regression_slow/" + file + ".obj");
        REQUIRE(surfaces);
        const Expected expected(*surfaces);
        REQUIRE(expected.rounded.report.clean);
        Seen seen;
        for (const std::size_t count : {1, 2, 5}) check(expected, count, seen);
        CHECK(seen.left == 3);
    }
}

TEST_CASE("repair in tiles: attempts that fail leave the input as it was", "[tiles][once]") {
    const auto surfaces = read_surfaces(test_support::test_data() +
                                        "/regression_slow/018-attempts-beyond-repair.obj");
    REQUIRE(surfaces);
    const Expected expected(*surfaces);
    Seen seen;
    check(expected, 3, seen, 1'000'000);
    CHECK(seen.left == 1);
}

TEST_CASE("repair in tiles: what can't be gathered is left to one process as it was read",
          "[tiles]") {
    Seen seen;
    for (unsigned seed = 0; seed < 4; ++seed) {
        const Expected expected(sheets_in_a_plane(seed, seed % 2 == 0));
        for (const std::uint64_t most : {400, 600, 800, 1000, 1200, 1400, 1600, 2000}) {
            CAPTURE(seed, most);
            check(expected, 30, seen, most);
        }
    }
    CHECK(seen.left > 4);
    CHECK(seen.moved > 4);
}

TEST_CASE("repair in tiles: few triangles are gathered where few are in the way", "[tiles]") {
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

TEST_CASE("repair in tiles: what is far away counts for grids, moves and limits", "[tiles]") {
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

TEST_CASE("repair in tiles: in files and in threads", "[tiles]") {
    const Expected expected(far_soup(1, 40, 3e-8));
    REQUIRE(expected.rounded.report.naive_contacts > 0);
    Seen seen;
    const test_support::TemporaryFolder folder;
    const Run alone, several{.threads = 2};
    LocalSupersteps in_files({3, folder.path()}, alone), in_threads({3, {}}, several);
    check(expected, in_files, seen);
    check(expected, in_threads, seen);
    CHECK(seen.repaired == 2);
    for (unsigned seed = 0; seed < 4; ++seed) {
        CAPTURE(seed);
        const Expected moved(sheets_in_a_plane(seed, seed % 2 == 0));
        const test_support::TemporaryFolder other;
        LocalSupersteps files({3, other.path()}, alone), threads({3, {}}, several);
        check(moved, files, seen);
        check(moved, threads, seen);
    }
    CHECK(seen.moved >= 4);
}

TEST_CASE("repair in tiles: what lies in few doubles costs what it costs one process",
          "[tiles][once]") {
    Seen seen;
    std::size_t many = 0, refused = 0;
    for (const std::uint32_t count : {10, 20, 40, 60, 90})
        for (const unsigned range : {4U, 24U}) {
            CAPTURE(count, range);
            const Point3 at = range == 4 ? Point3{1e6, 1e6, 1e6} : far_away;
            const auto heap = heap_on_lattice(count, count, at, 0x1p-30, range);
            if (!round_to_doubles(*arrange(heap))) {
                const Run run;
                LocalSupersteps local({5, {}}, run);
                check_refused(heap, local);
                ++refused;
                continue;
            }
            const Expected expected(heap);
            const std::uint64_t triangles = expected.exact.triangles.size(),
                                pairs = overlapping_pairs(expected.exact);
            many += triangles > 10'000 ? 1 : 0;
            for (const std::size_t tiles : {1, 2, 5, 7}) {
                CAPTURE(tiles, triangles, pairs);
                const Run run;
                LocalSupersteps local({tiles, {}}, run);
                const auto work = check(expected, local, seen).total;
                // Attempts to move the input do the same work again.
                CHECK(work.rounded_pairs <= pairs);
                CHECK(work.near_boxes <= 300 * triangles);
                CHECK(work.memory <= 1000 * triangles);
            }
        }
    CHECK(seen.repaired >= 20);
    CHECK(seen.moved >= 8);
    CHECK(many >= 1);
    CHECK(refused >= 1);
}
