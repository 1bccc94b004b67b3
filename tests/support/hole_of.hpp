// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/reconstruction/holes/holes.hpp>

namespace test_support {

/// The only border of the surface that is no outer one.
inline terrane::BorderLoop hole_of(const terrane::Surface& s) {
    auto loops = terrane::find_border_loops(s);
    REQUIRE(loops);
    std::erase_if(loops.value(),
                  [](const terrane::BorderLoop& l) { return l.kind == terrane::LoopKind::outer; });
    REQUIRE(loops.value().size() == 1);
    return loops.value()[0];
}

} // namespace test_support
