// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/bounds_back.hpp>

#include <terrane/algorithms/quality/improve.hpp>

#include <stop_token>

#include <catch2/catch.hpp>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/quality/quality.hpp>

#include "support/improve_cases.hpp"
#include "support/points.hpp"
#include "support/rounded.hpp"
#include "support/shapes.hpp"
#include "support/solids.hpp"

using namespace terrane;
using namespace test_support;
using namespace improve_cases;

TEST_CASE("improve: the original is near the result, and a hole is detected", "[improve]") {
    const Mesh mesh = mesh_of(nine_regions());
    ImproveOptions options;
    options.edge_length = 0.5;
    Improved better = improved(mesh, options);
    const auto back = bounds_back(mesh, better, options);
    REQUIRE(back);
    for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
        CHECK(back.value()[s] <= better.report.bound_of[s]);
        const Surface before = surface_of_mesh(mesh, s), after = surface_of_mesh(better.mesh, s);
        CHECK(back.value()[s] >= sampled_distance(before, after));
    }
    std::stop_source source;
    source.request_stop();
    Run run;
    run.stop = source.get_token();
    const auto stopped = bounds_back(mesh, better, options, run);
    REQUIRE_FALSE(stopped);
    CHECK(stopped.error().code == ErrorCode::interrupted);
    // Without a triangle it is far: the inscribed circle is larger than the bound.
    for (const std::size_t gone : {std::size_t{0}, better.mesh->triangles.size() / 2}) {
        Improved holed = better;
        const std::uint32_t surface = better.mesh->surfaces_of[gone][0];
        const auto keep = [&](auto& list) {
            list.erase(list.begin() + static_cast<std::ptrdiff_t>(gone));
        };
        Mesh rest = better.mesh;
        keep(rest.triangles);
        keep(holed.near_of);
        rest.surfaces_of = {};
        for (std::size_t t = 0; t < better.mesh->triangles.size(); ++t)
            if (t != gone) rest.surfaces_of.push_back(better.mesh->surfaces_of[t]);
        holed.mesh = rest;
        const auto far = bounds_back(mesh, holed, options);
        REQUIRE(far);
        CHECK(far.value()[surface] > better.report.bound_of[surface]);
        CHECK(far.value()[surface] >= sampled_distance(surface_of_mesh(mesh, surface),
                                                       surface_of_mesh(holed.mesh, surface)));
    }
}
