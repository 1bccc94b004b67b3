// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Models, and sections of them.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/sections/sections.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

#include "support/samples.hpp"
#include "support/solids.hpp"

namespace test_support {

using namespace terrane;

struct SectionModel {
    Mesh mesh;
    Volumes volumes;
};

/// Arranges surfaces within a boundary, or without one, rounds them, and finds their blocks.
inline SectionModel section_model(std::vector<Surface> surfaces, std::vector<Surface> boundary) {
    const auto made = arrange_within(std::move(surfaces), std::move(boundary));
    REQUIRE(message_of(made) == "no error");
    SectionModel model{*made->rounded.mesh, {}};
    const auto volumes = find_volumes(model.mesh);
    REQUIRE(volumes);
    model.volumes = *volumes;
    return model;
}

inline Section cut_along(const SectionModel& model, const Result<SectionSurface>& along) {
    REQUIRE(message_of(along) == "no error");
    const auto section = cut_section(model.mesh, model.volumes, *along);
    REQUIRE(message_of(section) == "no error");
    return *section;
}

/// The area of a ring in the coordinates of the section; counterclockwise: > 0.
inline double shoelace(const Section& section, const std::vector<std::uint32_t>& ring) {
    double sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const auto &a = section.flat[ring[i]], &b = section.flat[ring[(i + 1) % ring.size()]];
        sum += a[0] * b[1] - a[1] * b[0];
    }
    return sum / 2;
}

} // namespace test_support
