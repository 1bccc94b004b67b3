// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/simplification/detail/contacts.hpp>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "support/solids.hpp"
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/simplification/detail/traced_mesh.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

namespace contacts_test {

using namespace terrane;
using namespace terrane::simplification::detail;

namespace {

/// Three sheets with even slopes, nowhere far from each other, in a box, with regular triangles.
TracedMesh near_sheets() {
    std::vector<Surface> surfaces;
    const auto sheet = [](double at, double slope, std::string name) {
        const double low = at - 60 * slope, high = at + 60 * slope;
        return Surface{std::move(name),
                       Role::horizon,
                       {{-10, -10, low}, {110, -10, high}, {110, 90, high}, {-10, 90, low}},
                       {{0, 1, 2}, {0, 2, 3}}};
    };
    surfaces.push_back(sheet(30, 0, "flat"));
    surfaces.push_back(sheet(32, 0, "near"));
    surfaces.push_back(sheet(31, 0.05, "inclined"));
    auto boundary = box_boundary({0, 0, 0}, {100, 80, 60});
    REQUIRE(boundary);
    const auto arranged = arrange_within(std::move(surfaces), std::move(*boundary));
    REQUIRE(arranged);
    REQUIRE(arranged->rounded.conforming);
    ImproveOptions regular;
    regular.edge_length = 6;
    regular.max_deviation = 0.3;
    const auto improved = improve(*arranged->rounded.conforming, regular);
    REQUIRE(improved);
    return traced(*improved->mesh);
}

} // namespace

TEST_CASE("contacts: the same for any number of threads, with all that they say",
          "[simplification]") {
    const TracedMesh mesh = near_sheets();
    const Complex complex(mesh.mesh.vertices, mesh.past, mesh.cells, mesh.mesh.surfaces);
    const CurveNetwork curves = find_curves(complex);
    std::vector<std::uint32_t> all(complex.cells().size());
    std::iota(all.begin(), all.end(), 0U);
    const auto found = [&](unsigned threads) {
        Run run;
        run.threads = threads;
        return find_contacts(complex, curves, 3, all, run);
    };
    const Found alone = found(1);
    CHECK(alone.contacts.size() > 1000);
    for (const unsigned threads : {2U, 3U, 5U, 8U}) {
        const Found others = found(threads);
        CHECK(others.to_divide == alone.to_divide);
        REQUIRE(others.contacts.size() == alone.contacts.size());
        std::size_t differ = 0;
        for (std::size_t i = 0; i < alone.contacts.size(); ++i) {
            const NearPlaces &a = alone.contacts[i], &b = others.contacts[i];
            differ += a.distance != b.distance || a.on_surfaces != b.on_surfaces ||
                      a.from.corners != b.from.corners || a.from.weights != b.from.weights ||
                      a.to.corners != b.to.corners || a.to.weights != b.to.weights;
        }
        CHECK(differ == 0);
    }
}

} // namespace contacts_test
