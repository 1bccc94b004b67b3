// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests maps and measures of blocks against what geometry says of simple ones.
#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/uncertainty/measures.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

using namespace terrane;

namespace {

/// A pyramid of height 3 over the square [-2, 2]^2 at z = 1, cut out of a box, with its volumes.
struct PyramidInBox {
    Mesh mesh;
    Volumes volumes;
};

PyramidInBox pyramid_in_box() {
    auto surfaces = box_boundary({-4, -4, 0}, {4, 4, 8}).value();
    surfaces.push_back({"pyramid",
                        Role::horizon,
                        {{-2, -2, 1}, {2, -2, 1}, {2, 2, 1}, {-2, 2, 1}, {0, 0, 4}},
                        {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}});
    const auto arrangement = arrange(surfaces);
    REQUIRE(arrangement);
    const auto rounded = round_to_doubles(*arrangement);
    REQUIRE(rounded);
    const auto volumes = find_volumes(rounded->mesh);
    REQUIRE(volumes);
    REQUIRE(volumes->block_count() == 2);
    return {rounded->mesh, *volumes};
}

/// The volume of the pyramid.
std::uint32_t inner_of(const Volumes& volumes) {
    return volumes.measures[1] < volumes.measures[2] ? 1 : 2;
}

} // namespace

TEST_CASE("measures: columns through edges and corners are met once", "[uncertainty]") {
    const auto model = pyramid_in_box();
    const std::uint32_t inner = inner_of(model.volumes), outer = 3 - inner;
    // Centres on whole numbers: the diagonals, the apex, and the corners of the base are hit.
    for (const MapGrid& grid :
         {MapGrid{-3.5, -3.5, 1, 1, 7, 7}, MapGrid{-3.3, -3.9, 0.25, 0.2, 20, 31}}) {
        const auto maps = column_maps(model.mesh, model.volumes, grid);
        const std::size_t cells = grid.columns * grid.rows;
        for (std::size_t row = 0; row < grid.rows; ++row)
            for (std::size_t column = 0; column < grid.columns; ++column) {
                const double x = grid.x + (static_cast<double>(column) + 0.5) * grid.width,
                             y = grid.y + (static_cast<double>(row) + 0.5) * grid.height;
                const double far = std::max(std::fabs(x), std::fabs(y));
                const std::size_t cell = row * grid.columns + column;
                const double thickness = far < 2 ? 3 * (1 - far / 2) : 0;
                CAPTURE(x, y);
                CHECK(maps.thicknesses[inner * cells + cell] == Approx(thickness).margin(1e-12));
                CHECK(maps.thicknesses[outer * cells + cell] == Approx(8 - thickness));
                CHECK(maps.thicknesses[cell] == 0);
                const double height = maps.heights[(model.mesh.surfaces.size() - 1) * cells + cell];
                if (far < 2) CHECK(height == Approx(1 + thickness));
                if (far > 2) CHECK(std::isnan(height));
            }
    }
}

TEST_CASE("measures: volumes above a contact are those of the cut solid", "[uncertainty]") {
    const auto model = pyramid_in_box();
    const std::uint32_t inner = inner_of(model.volumes), outer = 3 - inner;
    const std::vector<double> contacts{-5, 0.5, 1, 2.5, 3.7, 4, 7, 9};
    const auto measures = measure_blocks(model.mesh, model.volumes, contacts);
    CHECK(measures[inner].low == 1);
    CHECK(measures[inner].high == 4);
    CHECK(measures[outer].high == 8);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        // The part of a pyramid above a plane is similar to it.
        const double share = std::clamp((4 - contacts[c]) / 3, 0.0, 1.0);
        const double pyramid = 16 * share * share * share;
        const double box = 64 * std::clamp(8 - contacts[c], 0.0, 8.0);
        CAPTURE(contacts[c]);
        CHECK(measures[inner].above[c].volume == Approx(pyramid).margin(1e-12));
        CHECK(measures[outer].above[c].volume == Approx(box - pyramid).margin(1e-12));
        // So is its section; level faces at the contact, as that of z = 1, bound what is above it.
        const double base = contacts[c] < 1 ? 0 : 16 * share * share;
        const double side = contacts[c] < 0 || contacts[c] >= 8 ? 0 : 64;
        CHECK(measures[inner].above[c].area == Approx(base).margin(1e-12));
        CHECK(measures[outer].above[c].area == Approx(side - base).margin(1e-12));
        if (contacts[c] < 1) CHECK(measures[inner].above[c].area == 0);
        CHECK(measures[inner].above[c].column == std::max(0.0, 4 - contacts[c]));
        CHECK(measures[outer].above[c].column == std::max(0.0, 8 - contacts[c]));
    }
}
