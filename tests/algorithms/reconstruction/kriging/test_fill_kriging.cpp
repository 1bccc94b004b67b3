// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/fill_kriging.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <stop_token>
#include <vector>

#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/loops.hpp"
#include "support/points.hpp"
#include "support/shapes.hpp"
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/reconstruction/kriging/flat_hole.hpp>

using namespace terrane;
using namespace test_support;

namespace {

std::size_t count_holes(const Surface& s) {
    const auto loops = loops_of(s);
    return static_cast<std::size_t>(std::count_if(
        loops.begin(), loops.end(), [](const BorderLoop& l) { return l.kind != LoopKind::outer; }));
}

const BorderLoop& first_hole(const std::vector<BorderLoop>& loops) {
    const auto hole = std::find_if(loops.begin(), loops.end(),
                                   [](const BorderLoop& l) { return l.kind != LoopKind::outer; });
    REQUIRE(hole != loops.end());
    return *hole;
}

Filling filling_of(const Surface& s, const KrigingOptions& options = {}) {
    const auto loops = loops_of(s);
    auto filling = fill_by_kriging(s, first_hole(loops), options);
    INFO((filling ? "filled" : filling.error().message()));
    REQUIRE(filling);
    return std::move(filling).value();
}

/// Computes the root mean square error of interpolated vertices.
template <class Height>
double missed(const Filling& f, const Height& z) {
    double sum = 0;
    const auto border = f.surface.vertices.size() - f.report.interpolated;
    for (auto v = border; v < f.surface.vertices.size(); ++v) {
        const Point3& p = f.surface.vertices[v];
        sum += std::pow(p.z - z(p.x, p.y), 2);
    }
    return std::sqrt(sum / double(std::max<std::size_t>(f.report.interpolated, 1)));
}

void check_joined(const Surface& holed, const Surface& whole) {
    REQUIRE(whole.triangles.size() > holed.triangles.size());
    CHECK(std::equal(holed.vertices.begin(), holed.vertices.end(), whole.vertices.begin()));
    CHECK(std::equal(holed.triangles.begin(), holed.triangles.end(), whole.triangles.begin()));
    const auto report = check(std::span(&whole, 1));
    REQUIRE(report);
    CHECK(report.value().clean());
    CHECK(report.value().non_manifold_edges.empty());
    // The filling has the orientation of the surface: triangles use edges in opposite directions.
    std::map<std::array<std::uint32_t, 2>, int> runs;
    for (const Triangle& t : whole.triangles)
        for (unsigned i = 0; i < 3; ++i) CHECK(++runs[{t[i], t[(i + 1) % 3]}] == 1);
}

constexpr auto wave = [](double x, double y) {
    return 20 * std::sin(x / 45) * std::cos(y / 60) + 0.1 * x;
};

} // namespace

TEST_CASE("fill by kriging: errors on smooth surfaces are far less than the depth of the hole",
          "[kriging]") {
    for (const double radius : {3.5, 6.5}) {
        const Surface s = sheet(40, 36, 10, without_disc(18, 17, radius), wave);
        const Filling f = filling_of(s);
        CHECK(f.exact_border);
        CHECK(f.report.interpolated > 10);
        CHECK(missed(f, wave) < 0.01);
        CHECK(f.report.expected_error < 0.1);
        CHECK(f.report.area == Approx(M_PI * radius * radius * 100).epsilon(0.25));
        check_joined(s, joined(s, f));
        CHECK(count_holes(joined(s, f)) == 0);
    }
}

TEST_CASE("fill by kriging: triangles are as small as the precision of the heights warrants",
          "[kriging][once]") {
    const auto missed_by_triangles = [](const Filling& f) {
        double sum = 0;
        for (const Triangle& t : f.surface.triangles) {
            const auto &a = f.surface.vertices[t[0]], &b = f.surface.vertices[t[1]],
                       &c = f.surface.vertices[t[2]];
            const double z = (a.z + b.z + c.z) / 3;
            sum += std::pow(z - wave((a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3), 2);
        }
        return std::sqrt(sum / double(f.surface.triangles.size()));
    };
    const Surface s = sheet(40, 36, 10, without_disc(18, 17, 5), wave);
    const Filling fine = filling_of(s), given = filling_of(s, {.mesh_size = 10});
    CHECK(fine.report.interpolated > 10 * given.report.interpolated); // a quarter of the size
    CHECK(fine.report.interpolated < 25 * given.report.interpolated);
    CHECK(4 * missed_by_triangles(fine) < missed_by_triangles(given));
    CHECK(fine.report.expected_error < 2 * given.report.expected_error);
    check_joined(s, joined(s, fine));
    // They are not refined where heights are no more precise than large triangles show them, nor
    // beyond the allowed number of vertices.
    Random random(5);
    const auto noisy = [&](double x, double y) {
        return wave(x, y) + std::normal_distribution<double>(0, 1)(random);
    };
    const Surface rough = sheet(40, 36, 10, without_disc(18, 17, 5), noisy);
    CHECK(filling_of(rough).report.interpolated == given.report.interpolated);
    const Surface wide = sheet(190, 190, 10, without_disc(95, 95, 86), wave);
    CHECK(filling_of(wide).report.interpolated < 21'000);
}

TEST_CASE("fill by kriging: a hole in a plane is filled with that plane", "[kriging]") {
    const auto plane = [](double x, double y) { return 0.25 * x - 0.5 * y + 7; };
    const Surface s = sheet(20, 20, 8, without_disc(10, 9, 4), plane);
    const Filling f = filling_of(s);
    CHECK(missed(f, plane) < 1e-10);
    CHECK(f.report.expected_error < 1e-6);
}

TEST_CASE("fill by kriging: the expected error is right for noisy data", "[kriging]") {
    Random random(3);
    double errors = 0, expected = 0;
    constexpr int repeats = 4;
    for (int n = 0; n < repeats; ++n) {
        const auto noisy = [&](double x, double y) {
            return wave(x, y) + std::normal_distribution<double>(0, 1)(random);
        };
        const Surface s = sheet(36, 36, 10, without_disc(18, 17, 5), noisy);
        const Filling f = filling_of(s);
        UNSCOPED_INFO(f.report.model << ": " << missed(f, wave));
        errors += missed(f, wave) / repeats;
        expected += f.report.expected_error / repeats;
    }
    CHECK(errors < 3); // the hole is 20 deep
    CHECK(expected > errors / 4);
    CHECK(expected < errors * 4);
}

TEST_CASE("fill by kriging: four holes are filled one by one, and the result is conforming",
          "[kriging]") {
    const auto keep = [](int i, int j) {
        for (const auto& [x, y, r] :
             {std::array{9.0, 9.0, 3.0}, {30.0, 10.0, 4.5}, {11.0, 30.0, 2.2}, {29.0, 29.0, 5.5}})
            if (std::hypot(i + 0.5 - x, j + 0.5 - y) < r) return false;
        return true;
    };
    const Surface s = sheet(40, 40, 10, keep, wave);
    const auto loops = loops_of(s);
    Surface whole = s;
    int filled = 0;
    for (const BorderLoop& loop : loops) {
        if (loop.kind == LoopKind::outer) continue;
        const auto filling = fill_by_kriging(s, loop);
        REQUIRE(filling);
        whole = joined(whole, filling.value());
        ++filled;
    }
    CHECK(filled == 4);
    check_joined(s, whole);
    CHECK(count_holes(whole) == 0);
}

TEST_CASE("fill by kriging: an island is kept and serves as data", "[kriging]") {
    const auto keep = [](int i, int j) {
        const double r = std::hypot(i + 0.5 - 20, j + 0.5 - 20);
        return r < 3 || r > 8;
    };
    const auto z = [](double x, double y) {
        return 60 * std::exp(-(std::pow(x - 200, 2) + std::pow(y - 200, 2)) / 4000);
    };
    const Surface s = sheet(40, 40, 10, keep, z);
    const auto loops = loops_of(s);
    const auto filling = fill_by_kriging(s, first_hole(loops), {.loops = loops});
    REQUIRE(filling);
    CHECK(missed(filling.value(), z) < 1);
    const Surface whole = joined(s, filling.value());
    check_joined(s, whole);
    const auto after = loops_of(whole);
    CHECK(after.size() == 1); // only the outer border: the island is connected now
    // Without the loops the island is unknown, and the filling covers it.
    const auto blind = fill_by_kriging(s, first_hole(loops));
    REQUIRE(blind);
    CHECK(blind.value().report.area > filling.value().report.area);
}

TEST_CASE("fill by kriging: islands that touch the border in a vertex are met", "[kriging]") {
    const std::array<std::array<int, 2>, 4> sides{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    for (const auto [x, y] : sides)
        for (const int turn : {-1, 1}) {
            // A cell at the border, and one that it has a corner in common with.
            const std::array border{7 + 2 * x, 7 + 2 * y},
                island{border[0] - x - turn * y, border[1] - y + turn * x};
            const auto keep = [&](int i, int j) {
                const std::array cell{i, j};
                return std::max(std::abs(i - 7), std::abs(j - 7)) > 2 || cell == border ||
                       cell == island;
            };
            Surface s = sheet(15, 15, 10, keep, wave);
            // The corner becomes the first vertex of all borders that have it.
            const double at_x = 10 * std::max(border[0], island[0]),
                         at_y = 10 * std::max(border[1], island[1]);
            const auto corner = std::find_if(s.vertices.begin(), s.vertices.end(),
                                             [&](Point3 p) { return p.x == at_x && p.y == at_y; });
            const auto number = static_cast<std::uint32_t>(corner - s.vertices.begin());
            REQUIRE(number < s.vertices.size());
            std::swap(s.vertices[0], s.vertices[number]);
            for (Triangle& t : s.triangles)
                for (auto& v : t)
                    if (v == 0 || v == number) v = number - v;
            const auto loops = loops_of(s);
            REQUIRE(loops.size() == 3);
            const auto filling = fill_by_kriging(s, first_hole(loops), {.loops = loops});
            INFO((filling ? "filled" : filling.error().message()));
            REQUIRE(filling);
            check_joined(s, joined(s, *filling));
        }
}

TEST_CASE("fill by kriging: the effort for a filling is bounded", "[kriging]") {
    const Surface s = sheet(30, 30, 10, without_disc(15, 15, 9), wave);
    const auto loops = loops_of(s);
    for (const double size : {0.0, 1.0, 0.2}) {
        auto hole = FlatHole::of(s, first_hole(loops), loops, 5);
        REQUIRE(hole);
        REQUIRE(hole->triangulate(size, {}));
        std::vector<std::size_t> asked;
        const auto filling = hole->filled(
            [&](std::span<const Point3> places) {
                asked.push_back(places.size());
                // Large sags, small errors: it is refined as far as it may be.
                KnownHeights known{{}, std::vector<double>(places.size(), 1e-3)};
                for (const Point3& p : places) known.heights.push_back(wave(p.x, p.y));
                return known;
            },
            {});
        REQUIRE(filling);
        CHECK(asked[0] <= 20'000);
        if (size == 0.2) CHECK(asked[0] > 8'000);
        CHECK(asked.size() == (size == 0 ? 5 : 1)); // two halvings
        // Both are judged at the ends and the middles of as many edges.
        if (size == 0) CHECK((asked[1] == 3 * 64 && asked[3] == 3 * 64));
    }
}

TEST_CASE("fill by kriging: the front of the filling is that of the surface, up or down",
          "[kriging]") {
    Surface s = sheet(20, 20, 10, without_disc(10, 9, 3), wave);
    for (Triangle& t : s.triangles) std::swap(t[0], t[1]);
    check_joined(s, joined(s, filling_of(s)));
}

TEST_CASE("fill by kriging: random ragged holes are filled", "[kriging]") {
    Random random(21);
    for (int n = 0; n < cases(4); ++n) {
        const auto keep = [&](int i, int j) {
            const double r = std::hypot(i + 0.5 - 12, j + 0.5 - 12);
            return r > 6 || (r > 3 && random_int(random, 0, 3) > 0);
        };
        const Surface s = sheet(24, 24, 10, keep, wave);
        const auto loops = loops_of(s);
        Surface whole = s;
        for (const BorderLoop& loop : loops)
            if (loop.kind != LoopKind::outer) {
                const auto filling = fill_by_kriging(s, loop, {.loops = loops});
                INFO((filling ? "filled" : filling.error().message()));
                REQUIRE(filling);
                whole = joined(whole, filling.value());
            }
        check_joined(s, whole);
    }
}

TEST_CASE("fill by kriging: a fold is refused, with the place", "[kriging]") {
    const auto fold = [](double x, double y) {
        const double t = 2 * M_PI * x / 300;
        return Point3{x - 60 * std::sin(2 * t), y, 50 * std::sin(t)};
    };
    const Surface s = sheet_of(30, 30, 10, without_disc(13, 15, 3), fold);
    const auto loops = loops_of(s);
    const auto filling = fill_by_kriging(s, first_hole(loops));
    REQUIRE(!filling);
    CHECK(filling.error().code == ErrorCode::unsupported);
    CHECK(filling.error().sentence.find("no graph z = f(x, y)") != std::string::npos);
    CHECK(!filling.error().place.empty());
    // A vertical surface has no area seen from above.
    const auto wall = [](double x, double y) { return Point3{x, 0.0, y}; };
    const Surface upright = sheet_of(12, 12, 10, without_disc(6, 6, 2), wall);
    const auto refused = fill_by_kriging(upright, first_hole(loops_of(upright)));
    REQUIRE(!refused);
    CHECK(refused.error().code == ErrorCode::unsupported);
}

TEST_CASE("fill by kriging: data reach as far as the hole is wide, or are enough", "[kriging]") {
    const auto hole_of = [](int n, int radius) {
        const Surface s = sheet(n, n, 10, without_disc(n / 2, n / 2, radius), wave);
        const auto loops = loops_of(s);
        auto hole = FlatHole::of(s, first_hole(loops), loops, 1);
        REQUIRE(hole);
        return std::move(hole).value();
    };
    const FlatHole small = hole_of(60, 6), large = hole_of(190, 36);
    const double few = static_cast<double>(small.near()) / (6 * 6 * M_PI); // per vertex taken out
    CHECK(few > 1.5);
    CHECK(few < 2.5);
    // Farther data are those that an estimate can take.
    CHECK(small.data().size() > 750);
    CHECK(small.data().size() < 950);
    CHECK(large.data().size() > 3800);
    CHECK(large.data().size() < 4600);
    CHECK(large.near() == large.data().size());
}

TEST_CASE("fill by kriging: invalid options are refused, and a stop request is obeyed",
          "[kriging]") {
    const Surface s = sheet(20, 20, 10, without_disc(10, 9, 3), wave);
    const auto loops = loops_of(s);
    const BorderLoop& hole = first_hole(loops);
    CHECK(fill_by_kriging(s, hole, {.rings = 0}).error().code == ErrorCode::bad_option);
    CHECK(fill_by_kriging(s, hole, {.mesh_size = -1}).error().code == ErrorCode::bad_option);
    CHECK(fill_by_kriging(s, hole, {.mesh_size = NAN}).error().code == ErrorCode::bad_option);
    BorderLoop wrong = hole;
    wrong.vertices[0] = 1u << 30;
    CHECK(fill_by_kriging(s, wrong).error().code == ErrorCode::bad_index);
    wrong = hole;
    std::swap(wrong.vertices[0], wrong.vertices[3]);
    CHECK(fill_by_kriging(s, wrong).error().code == ErrorCode::bad_index);
    std::stop_source source;
    source.request_stop();
    CHECK(fill_by_kriging(s, hole, {}, {.stop = source.get_token()}).error().code ==
          ErrorCode::interrupted);
}

TEST_CASE("fill by kriging: the same bytes for any number of threads", "[kriging]") {
    const Surface s = sheet(40, 36, 10, without_disc(18, 17, 9), wave);
    const auto loops = loops_of(s);
    const auto one = fill_by_kriging(s, first_hole(loops), {}, {.threads = 1});
    const auto three = fill_by_kriging(s, first_hole(loops), {}, {.threads = 3});
    REQUIRE(one);
    REQUIRE(three);
    CHECK(one.value().surface.vertices == three.value().surface.vertices);
    CHECK(one.value().surface.triangles == three.value().surface.triangles);
    CHECK(one.value().expected_error == three.value().expected_error);
}
