// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace test_support {

struct Found {
    terrane::Arrangement arrangement;
    terrane::Volumes volumes;
};

/// Arranges surfaces and finds their volumes.
inline Found find_in(const std::vector<terrane::Surface>& surfaces) {
    auto arrangement = terrane::arrange(surfaces);
    REQUIRE(arrangement);
    auto volumes = terrane::find_volumes(arrangement.value());
    INFO((volumes ? std::string() : volumes.error().message()));
    REQUIRE(volumes);
    return {std::move(arrangement).value(), std::move(volumes).value()};
}

} // namespace test_support
