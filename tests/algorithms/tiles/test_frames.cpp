// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The way back from a frame of decimals in tiles is that of one process, next to input coordinates, too.
#include <terrane/algorithms/tiles/detail/frames.hpp>
#include <terrane/algorithms/tiles/local_supersteps.hpp>
#include <terrane/kernel/numbers.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace {

using namespace terrane;
using namespace terrane::tiles;

/// Moves a number by some doubles up or down.
double nudged(double x, int doubles) {
    for (; doubles > 0; --doubles) x = std::nextafter(x, HUGE_VAL);
    for (; doubles < 0; ++doubles) x = std::nextafter(x, -HUGE_VAL);
    return x;
}

class RandomDecimals {
public:
    explicit RandomDecimals(unsigned seed) : random_(seed) {}

    int between(int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(random_);
    }
    /// A tenth, or a double next to one.
    double coordinate() { return nudged(between(-90, 90) / 10.0, between(-1, 1)); }
    Point3 point() {
        const double x = coordinate(), y = coordinate();
        return {x, y, coordinate()};
    }
    Point3 near(const Point3& p) {
        const double x = nudged(p.x, between(-9, 9)), y = nudged(p.y, between(-2, 2));
        return {x, y, nudged(p.z, between(-1, 1)) + between(0, 1) / 3.0};
    }

private:
    std::mt19937 random_;
};

/// Tiles that know some vertices and constructed points each, in a frame.
void fill(Tile& b, const std::vector<Point3>& inputs, const DecimalFrame& frame, unsigned seed) {
    RandomDecimals random(seed + b.index);
    const auto total = static_cast<std::uint32_t>(inputs.size());
    b.first_vertex = {0, total};
    b.first_triangle = {0, 0};
    b.is_in_frame = true;
    const std::uint32_t start = tiles::detail::home_start(b, total);
    for (std::uint32_t k = 0; k < tiles::detail::home_size(b, total); ++k)
        b.home_given.push_back(inputs[start + k]);
    for (std::uint32_t v = b.index; v < total; v += 1 + b.index) {
        const Point3 place = frame.into(inputs[v]);
        b.used.push_back({v, v, 0, 0, place});
        b.points.push_back({.nearest = random.near(place)});
        b.point_errors.push_back({1e-16, 0, 1e-17});
    }
}

} // namespace

TEST_CASE("frames in tiles: the way back from decimals is that of one process", "[tiles]") {
    std::size_t clamped = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        RandomDecimals random(seed);
        std::vector<Point3> inputs(400);
        for (Point3& p : inputs) p = random.point();
        const std::vector<bool> all(inputs.size(), true);
        const auto whole = DecimalFrame::of(inputs, all, {});
        const auto frame = DecimalFrame::of_chosen(inputs);
        REQUIRE((whole && frame));
        const Run run;
        LocalSupersteps tiles({4, {}}, run);
        REQUIRE(tiles.visit([&](Tile& b) -> Status {
            fill(b, inputs, *frame, seed);
            return Done{};
        }));
        std::vector<Tile> before;
        REQUIRE(tiles.visit([&](Tile& b) -> Status {
            before.push_back(b);
            return Done{};
        }));
        const auto steps = tiles::detail::steps_back(*frame);
        for (const auto& step : {steps.send_points, steps.order_constructed, steps.number_points})
            REQUIRE(tiles.step("number", [&](Tile& b, Inbox& in, Outbox& out) -> Status {
                step(b, in, out);
                return Done{};
            }));
        REQUIRE(tiles.visit([&](Tile& b) -> Status {
            const Tile& old = before[b.index];
            for (std::size_t v = 0; v < b.used.size(); ++v)
                CHECK(b.used[v].at == whole->back(old.used[v].at));
            const UpwardRounding guard;
            for (std::size_t p = 0; p < b.points.size(); ++p) {
                const Point3& place = old.points[p].nearest;
                CHECK(b.points[p].nearest == whole->back(place));
                CHECK(b.points[p].bound == whole->error_of(place, {1e-16, 0, 1e-17}));
                clamped += b.points[p].nearest != frame->back(place) ? 1 : 0;
            }
            return Done{};
        }));
    }
    CHECK(clamped > 100);
}
