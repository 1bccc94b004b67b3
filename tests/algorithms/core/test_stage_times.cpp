// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks what stages tell of their times: paths, nesting, threads.
#include <terrane/algorithms/core/run.hpp>

#include <array>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/sealing/sealing.hpp>

using namespace terrane;

namespace {

/// A square at the height z, and a wall over its middle that ends `gap` above it.
std::array<Surface, 2> square_and_wall(double gap) {
    return {Surface{"square",
                    Role::unknown,
                    {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}},
                    {{0, 1, 2}, {0, 2, 3}}},
            Surface{"wall",
                    Role::unknown,
                    {{2, 1, gap}, {2, 3, gap}, {2, 3, 2}, {2, 1, 2}},
                    {{0, 1, 2}, {0, 2, 3}}}};
}

std::vector<std::string> paths_of(const StageTimes& times) {
    std::vector<std::string> paths;
    for (const auto& [path, time] : times.all()) paths.push_back(path);
    return paths;
}

} // namespace

TEST_CASE("stage times: calls of a stage add up, and the latest one is known", "[times]") {
    StageTimes times;
    CHECK(times.latest("round") == 0);
    times.add("round", 3);
    times.add("round", 0.5);
    CHECK(times.latest("round") == 0.5);
    const auto all = times.all();
    REQUIRE(all.size() == 1);
    CHECK(all.at("round").calls == 2);
    CHECK(all.at("round").total == 3.5);
}

TEST_CASE("stage times: the path of a step begins with its stage", "[times]") {
    StageTimes times;
    Run run;
    run.timing = times.observer();
    {
        StageTimer timer(run, "outer");
        const Run inner = timer.inside();
        StageTimer step(inner, "first");
        const Run innermost = step.inside();
        { const StageTimer deepest(innermost, "deep"); }
        step.next("second");
        CHECK(times.latest("outer") == 0);
    }
    CHECK(paths_of(times) ==
          std::vector<std::string>{"outer", "outer/first", "outer/first/deep", "outer/second"});
    const auto all = times.all();
    CHECK(all.at("outer").latest >= all.at("outer/first").latest + all.at("outer/second").latest);
    CHECK(all.at("outer/first").latest >= all.at("outer/first/deep").latest);
}

TEST_CASE("stage times: a stage that has been stopped is reported once", "[times]") {
    StageTimes times;
    const Run run{.timing = times.observer()};
    {
        StageTimer timer(run, "stage");
        timer.stop();
        timer.stop();
    }
    CHECK(times.all().at("stage").calls == 1);
}

TEST_CASE("stage times: several threads may report at a time", "[times]") {
    StageTimes times;
    const Run run{.timing = times.observer()};
    constexpr unsigned each = 1000;
    {
        std::vector<std::jthread> threads;
        for (unsigned t = 0; t < 4; ++t)
            threads.emplace_back([&] {
                for (unsigned i = 0; i < each; ++i) const StageTimer timer(run, "shared");
            });
    }
    CHECK(times.all().at("shared").calls == 4 * each);
}

TEST_CASE("stage times: stages tell their times, also within other stages", "[times]") {
    StageTimes times;
    const Run run{.timing = times.observer()};
    const auto arrangement = arrange(square_and_wall(-1), {}, run);
    REQUIRE(arrangement);
    REQUIRE(round_to_doubles(*arrangement, {}, run));
    CHECK(paths_of(times) ==
          std::vector<std::string>{"arrange", "arrange/assemble", "arrange/intersect",
                                   "arrange/prepare", "arrange/search", "arrange/stitch",
                                   "arrange/triangulate", "round", "round/regions"});
    double steps = 0;
    for (const auto& [path, time] : times.all())
        if (path.starts_with("arrange/")) steps += time.latest;
    CHECK(times.latest("arrange") >= steps);

    const auto gap = square_and_wall(0.125);
    REQUIRE(seal({gap.begin(), gap.end()}, {.distance = 0.25}, run));
    CHECK(times.latest("seal") >= times.all().at("seal/arrange").total);
    CHECK(times.all().at("arrange").calls == 1);
}
