// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Triangles from fuzzer bytes: small integer lattices, so that degeneracy is common, then nudged,
// shifted and scaled at the fuzzer's will.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <fuzzer/FuzzedDataProvider.h>

#include <terrane/algorithms/surface.hpp>

namespace terrane::fuzz {

inline double coordinate(FuzzedDataProvider& data, int range) {
    const double lattice = data.ConsumeIntegralInRange<int>(-range, range);
    switch (data.ConsumeIntegralInRange<int>(0, 7)) {
    case 0:
        return std::nextafter(lattice, HUGE_VAL);
    case 1:
        return std::nextafter(lattice, -HUGE_VAL);
    case 2:
        return lattice / 10;
    default:
        return lattice;
    }
}

/// Surfaces of `least` to `most` triangles in all, which share vertices more often than not.
inline std::vector<Surface> surfaces(FuzzedDataProvider& data, unsigned least, unsigned most) {
    const int range = data.ConsumeIntegralInRange<int>(1, 4);
    const double scale = std::ldexp(1.0, data.ConsumeIntegralInRange<int>(-40, 40));
    const double east = data.ConsumeBool() ? 500000 : 0, north = data.ConsumeBool() ? 4200000 : 0;
    std::vector<Surface> all(data.ConsumeIntegralInRange<std::size_t>(1, 3));
    std::vector<Point3> vertices(data.ConsumeIntegralInRange<std::size_t>(3, 3 * most));
    for (Point3& p : vertices) {
        p = {coordinate(data, range), coordinate(data, range), coordinate(data, range)};
        p = {(p.x + east) * scale, (p.y + north) * scale, p.z * scale};
    }
    for (Surface& s : all) s.vertices = vertices;
    const auto last = static_cast<std::uint32_t>(vertices.size() - 1);
    const auto count = data.ConsumeIntegralInRange<unsigned>(least, most);
    for (unsigned t = 0; t < count; ++t) {
        const auto corner = [&] { return data.ConsumeIntegralInRange<std::uint32_t>(0, last); };
        const Triangle triangle{corner(), corner(), corner()};
        all[data.ConsumeIntegralInRange<std::size_t>(0, all.size() - 1)].triangles.push_back(
            triangle);
    }
    return all;
}

} // namespace terrane::fuzz
