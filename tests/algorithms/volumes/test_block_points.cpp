// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/volumes/volumes.hpp>

#include <stop_token>

#include <catch2/catch.hpp>

#include "support/paths.hpp"
#include "support/points.hpp"
#include "support/rounded.hpp"
#include "support/solids.hpp"
#include <terrane/io/files.hpp>

using namespace terrane;
using namespace test_support;

namespace {

struct ModelOfCubes {
    Mesh mesh;
    Volumes volumes;
};

ModelOfCubes model_of(const std::vector<Surface>& surfaces) {
    Mesh mesh = mesh_of(surfaces);
    auto volumes = find_volumes(mesh);
    REQUIRE(volumes);
    return {std::move(mesh), std::move(volumes).value()};
}

/// Returns the number of nested boxes that a point lies strictly inside.
std::size_t level_of(const Point3& p) {
    const auto in = [&](double low, double high) {
        return p.x > low && p.x < high && p.y > low && p.y < high && p.z > low && p.z < high;
    };
    return (in(0, 8) ? 1U : 0U) + (in(1, 4) ? 1U : 0U) + (in(2, 3) ? 1U : 0U);
}

} // namespace

TEST_CASE("block points: one in each of three nested boxes", "[volumes]") {
    const ModelOfCubes m = model_of({cube(0, 8), cube(1, 4), cube(2, 3)});
    const auto points = block_points(m.mesh, m.volumes);
    REQUIRE(points);
    REQUIRE(points.value().size() == 3);
    for (std::uint32_t i = 0; i < 3; ++i) {
        CHECK(points.value()[i].block == i + 1);
        CHECK(level_of(points.value()[i].place) == i + 1);
    }
}

TEST_CASE("volume_around: agrees with boxes, none on a triangle", "[volumes]") {
    const ModelOfCubes m = model_of({cube(0, 8), cube(1, 4), cube(2, 3)});
    Random random(3);
    std::array<int, 4> met{};
    for (int i = 0; i < 500; ++i) {
        const auto number = [&] { return random_int(random, -4, 36) / 4.0 + 0.125; };
        const Point3 p = point_of(number);
        const auto volume = volume_around(p, m.mesh, m.volumes);
        REQUIRE(volume);
        CHECK(*volume == level_of(p));
        ++met[*volume];
    }
    for (const int count : met) CHECK(count > 0);
    CHECK_FALSE(volume_around({0, 3, 5}, m.mesh, m.volumes));
    CHECK_FALSE(volume_around({2, 2, 2}, m.mesh, m.volumes));
    CHECK(volume_around({100, 0, 0}, m.mesh, m.volumes) == 0U);
}

TEST_CASE("block points: dangling sheets part nothing, real models have all", "[volumes]") {
    const ModelOfCubes sheet = model_of({cube(0, 8), level(4, 1, 1, 7, 7)});
    const auto one = block_points(sheet.mesh, sheet.volumes);
    REQUIRE(one);
    CHECK(one.value().size() == 1);
    const auto surfaces = read_surfaces(test_data() + "/ringmesh/modelA2.ml");
    REQUIRE(surfaces);
    const ModelOfCubes real = model_of(surfaces.value());
    const auto points = block_points(real.mesh, real.volumes);
    REQUIRE(points);
    REQUIRE(points.value().size() == 12);
    for (std::uint32_t i = 0; i < 12; ++i) CHECK(points.value()[i].block == i + 1);
}

TEST_CASE("block points: a stop request is heard", "[volumes]") {
    const ModelOfCubes m = model_of({cube(0, 8)});
    std::stop_source source;
    source.request_stop();
    Run run;
    run.stop = source.get_token();
    const auto points = block_points(m.mesh, m.volumes, run);
    REQUIRE_FALSE(points);
    CHECK(points.error().code == ErrorCode::interrupted);
}
