// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <terrane/io/gocad/gocad.hpp>
#include <terrane/io/surfaces/obj.hpp>
#include <terrane/io/surfaces/off.hpp>
#include <terrane/io/surfaces/ply.hpp>

#include "support/read.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

Mesh joined(const std::vector<Surface>& surfaces) {
    Mesh mesh;
    for (const auto& surface : surfaces) {
        const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
        const auto index = static_cast<std::uint32_t>(mesh.surfaces.size());
        mesh.surfaces.push_back({surface.name, surface.role});
        mesh.vertices.insert(mesh.vertices.end(), surface.vertices.begin(), surface.vertices.end());
        for (const auto& t : surface.triangles) {
            mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
            mesh.surfaces_of.push_back(std::vector<std::uint32_t>{index});
        }
    }
    return mesh;
}

struct Counts {
    std::string_view file;
    std::size_t surfaces, triangles, vertices;
};

} // namespace

TEST_CASE("files of other programs", "[io][files]") {
    const Counts files[] = {
        {"arch-platform/faults.ts", 32, 11912, 7605},
        {"arch-platform/mnt.ts", 1, 10800, 5566},
        {"implicit-benchmark/Fault.ts", 1, 133, 93},
        {"opengeode-geosciencesio/2triangles.ts", 1, 2, 4},
        {"opengeode-geosciencesio/surf2d_multi.ts", 2, 92, 92},
        {"opengeode-geosciencesio/ts-2props.ts", 1, 2, 4},
        {"manifold/Cray_left.obj", 1, 576, 292},
        {"manifold/Havocglass8_left.obj", 1, 164, 84},
        {"arrangements/three_cubes.stl", 1, 36, 24},
        {"arrangements/two_spheres.stl", 1, 1600, 804},
        {"ringmesh/modelA1.ml", 9, 7932, 5118},
        {"ringmesh/modelA2.ml", 6, 16346, 13234},
    };
    for (const auto& [file, surfaces, triangles, vertices] : files) {
        INFO(file);
        const auto mesh = joined(read_data(file));
        CHECK(mesh.surfaces.size() == surfaces);
        CHECK(mesh.triangles.size() == triangles);
        CHECK(mesh.vertices.size() == vertices);
    }
}

TEST_CASE("files of other programs survive every format", "[io][files]") {
    for (const auto* file : {"arch-platform/faults.ts", "ringmesh/modelA1.ml"}) {
        const auto mesh = joined(read_data(file));
        const auto expected = split(mesh);
        for (const auto& result :
             {read_gocad(to_gocad(mesh), "a", "a"), read_obj(to_obj(mesh), "a", "a"),
              read_ply(to_ply(mesh), "a", "a")}) {
            REQUIRE(message_of(result) == "no error");
            REQUIRE(result.value().size() == expected.size());
            for (std::size_t s = 0; s < expected.size(); ++s) {
                CHECK(result.value()[s].name == expected[s].name);
                CHECK(same_bits(result.value()[s].vertices, expected[s].vertices));
                CHECK(result.value()[s].triangles == expected[s].triangles);
            }
        }
        const auto off = read_off(to_off(mesh), "a", "a").value();
        CHECK(same_bits(off[0].vertices, mesh.vertices));
        CHECK(off[0].triangles == mesh.triangles);
    }
}
