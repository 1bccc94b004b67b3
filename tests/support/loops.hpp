// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Border loops of a surface, and the hole among them.
#pragma once

#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/reconstruction/holes/holes.hpp>

namespace test_support {

inline std::vector<terrane::BorderLoop> loops_of(const terrane::Surface& s) {
    auto loops = terrane::find_border_loops(s);
    REQUIRE(loops);
    return std::move(loops).value();
}

/// Returns the loops that are not outer borders.
inline std::vector<terrane::BorderLoop> holes_of(const terrane::Surface& s) {
    auto loops = loops_of(s);
    std::erase_if(loops,
                  [](const terrane::BorderLoop& l) { return l.kind == terrane::LoopKind::outer; });
    return loops;
}

/// Returns the only hole of the surface.
inline terrane::BorderLoop hole_of(const terrane::Surface& s) {
    const auto holes = holes_of(s);
    REQUIRE(holes.size() == 1);
    return holes[0];
}

} // namespace test_support
