// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Surfaces arranged, and rounded to doubles: the input of most stages.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace test_support {

inline terrane::Arrangement arranged(std::span<const terrane::Surface> surfaces) {
    auto a = terrane::arrange(surfaces);
    INFO((a ? std::string() : a.error().message()));
    REQUIRE(a);
    return std::move(a).value();
}

inline terrane::Arrangement arranged(const std::vector<terrane::Surface>& surfaces) {
    return arranged(std::span<const terrane::Surface>(surfaces));
}

inline terrane::RoundedMesh rounded(const terrane::Arrangement& a,
                                    const terrane::RoundingOptions& options = {}) {
    auto r = terrane::round_to_doubles(a, options);
    INFO((r ? std::string() : r.error().message()));
    REQUIRE(r);
    return std::move(r).value();
}

/// Returns the conforming mesh that the surfaces make.
inline terrane::Mesh mesh_of(const std::vector<terrane::Surface>& surfaces) {
    auto r = rounded(arranged(surfaces));
    REQUIRE(r.report.clean);
    return std::move(r.mesh);
}

} // namespace test_support
