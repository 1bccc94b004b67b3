// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The paper's horizon cut into nine regions, and a call of improve that must succeed.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/quality/improve.hpp>

#include "support/shapes.hpp"

namespace improve_cases {

using namespace terrane;
using namespace test_support;

using Map = std::function<Point3(double, double)>;

inline Improved improved(const Mesh& mesh, const ImproveOptions& options = {},
                         const Run& run = {}) {
    auto better = improve(mesh, options, run);
    INFO((better ? std::string() : better.error().message()));
    REQUIRE(better);
    return std::move(better).value();
}

/// Builds a horizon and four faults that cut it into nine regions, of 1134 triangles (1136 in the
/// paper).
inline std::vector<Surface> nine_regions() {
    const auto horizon = [](double u, double v) {
        return Point3{10 * u, 10 * v, 0.5 * std::sin(6 * u) * std::cos(5 * v)};
    };
    std::vector<Surface> all{unit_grid(17, 20, horizon, "horizon")};
    const auto across = [](double at, double lean) {
        return [=](double u, double v) {
            return Point3{at + 0.4 * std::sin(4 * u) + lean * (v - 0.5), -0.5 + 11 * u, -2 + 4 * v};
        };
    };
    for (const double at : {3.1, 6.65}) {
        all.push_back(unit_grid(8, 2, across(at, 0.8), "fault across"));
        all.push_back(unit_grid(
            8, 2,
            [&](double u, double v) {
                const Point3 p = across(at, -0.6)(u, v);
                return Point3{p.y, p.x, p.z};
            },
            "fault along"));
    }
    return all;
}

} // namespace improve_cases
