// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests TetGen in a process of its own: time limits, stop requests, threads, output.
#include <terrane/algorithms/tetgen/tetrahedra.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include <terrane/algorithms/tetgen/detail/process.hpp>

#include "support/read.hpp"
#include "support/rounded.hpp"
#include "support/tetgen_cases.hpp"

using namespace terrane;
using namespace terrane::tetgen::detail;
using namespace test_support;
using namespace tetgen_cases;

TEST_CASE("tetrahedra: TetGen is given up when its time is over", "[tetrahedra]") {
    CHECK(must_fail(rectangle(), {.time_limit = 1e-9}).code == ErrorCode::timed_out);
}

TEST_CASE("tetrahedra: where TetGen never ends, the work does", "[tetrahedra]") {
    const Mesh mesh = mesh_of(read_data("regression/009-tetgen-never-ends.obj"));
    const auto made = tetrahedralize(mesh, {.time_limit = 2}, {});
    REQUIRE_FALSE(made); // in all ways TetGen runs out of time or crashes
    CHECK(made.error().sentence.find("TetGen") == 0);
}

TEST_CASE("tetrahedra: a stop request ends the work, before and between steps", "[tetrahedra]") {
    std::stop_source source;
    Run run{.stop = source.get_token()};
    unsigned steps = 0;
    run.progress = [&](std::string_view, double) {
        if (++steps > 1) source.request_stop();
    };
    const Error late = must_fail(cube(), {.box = unit_box, .edge_length = 0.05}, run);
    CHECK(late.code == ErrorCode::interrupted);
    run.progress = {};
    CHECK(must_fail(cube(), {}, run).code == ErrorCode::interrupted);
}

namespace {

/// Returns the processor seconds of all children that have ended.
double seconds_of_children() {
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    return static_cast<double>(used.ru_utime.tv_sec) +
           1e-6 * static_cast<double>(used.ru_utime.tv_usec);
}

} // namespace

TEST_CASE("tetrahedra: a stop request ends TetGen while it runs", "[tetrahedra]") {
    std::stop_source source;
    const double before = seconds_of_children();
    std::jthread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        source.request_stop();
    });
    const Run run{.stop = source.get_token()};
    // Tens of millions of tetrahedra would take minutes.
    const Error error = must_fail(cube(), {.box = unit_box, .edge_length = 0.01}, run);
    CHECK(error.code == ErrorCode::interrupted);
    CHECK(seconds_of_children() - before < 20);
}

TEST_CASE("tetrahedra: calls from several threads do not disturb each other", "[tetrahedra]") {
    const TetrahedralMesh alone = must(uneven_sheet(6), {.edge_length = 0.25});
    std::vector<std::optional<TetrahedralMesh>> made(4);
    {
        std::vector<std::jthread> threads;
        for (auto& slot : made)
            threads.emplace_back([&slot] {
                auto result = tetrahedralize(uneven_sheet(6), {.edge_length = 0.25}, Run{});
                if (result) slot = std::move(result).value();
            });
    }
    for (const auto& one : made) {
        REQUIRE(one.has_value());
        CHECK(one->vertices == alone.vertices);
        CHECK(one->tetrahedra == alone.tetrahedra);
    }
}

TEST_CASE("tetrahedra: other threads may allocate while TetGen is started", "[tetrahedra]") {
    const auto allocate = [](const std::stop_token& stop) {
        for (std::size_t round = 0; !stop.stop_requested(); ++round) {
            std::vector<std::unique_ptr<char[]>> blocks;
            for (std::size_t k = 0; k < 1000; ++k)
                blocks.emplace_back(new char[1 + (k * 3701 + round * 11) % 20'000]);
        }
    };
    const std::array<std::jthread, 2> busy{std::jthread(allocate), std::jthread(allocate)};
    TetgenInput cube_of_points;
    for (unsigned k = 0; k < 8; ++k)
        cube_of_points.points.push_back({k & 1U ? 1.0 : 0, k & 2U ? 1.0 : 0, k & 4U ? 1.0 : 0});
    for (const auto& face : std::array<std::array<std::uint32_t, 4>, 6>{
             {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}})
        cube_of_points.facets.push_back(face);
    cube_of_points.max_volume = 0.001;
    cube_of_points.keep_facets = false;
    cube_of_points.helper = find_tetgen_helper().value();
    for (int k = 0; k < 20; ++k) REQUIRE(run_mesher(cube_of_points, {}));
}

TEST_CASE("tetrahedra: nothing is printed, also where TetGen would", "[tetrahedra]") {
    // Steps of one part in 10^12: TetGen warns of angles and distances.
    MeshBuilder builder;
    const std::uint32_t s = builder.surface("thin");
    builder.quad(s, {0, 0, 0}, {1, 0, 0}, {1, 1, 1e-12}, {0, 1, 0});
    builder.quad(s, {0, 0, 1e-12}, {1, 0, 1e-12}, {1, 1, 2e-12}, {0, 1, 1e-12});
    std::fflush(stdout);
    const int kept = dup(STDOUT_FILENO);
    std::FILE* file = std::tmpfile();
    REQUIRE(file != nullptr);
    dup2(fileno(file), STDOUT_FILENO);
    const Result<TetrahedralMesh> result = tetrahedralize(builder.mesh(), {}, Run{});
    std::fflush(stdout);
    dup2(kept, STDOUT_FILENO);
    close(kept);
    CHECK(std::fseek(file, 0, SEEK_END) == 0);
    CHECK(std::ftell(file) == 0);
    std::fclose(file);
    if (!result) CHECK(result.error().code == ErrorCode::unsupported);
}
