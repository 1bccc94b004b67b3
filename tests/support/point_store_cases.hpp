// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Random stores of input and constructed points, each with its exact twin.
#pragma once

#include "support/effort.hpp"
#include "support/oracle.hpp"
#include "support/points.hpp"

#include <terrane/kernel/point_store.hpp>

#include <set>

namespace point_store_cases {

using namespace terrane;
using namespace test_support;
using Kind = Construction::Kind;

inline constexpr std::array axes{Axis::z, Axis::x, Axis::y};

struct Twins {
    PointStore store;
    std::vector<oracle::Point> exact; ///< per point of the store, times 2^-exponent
    int exponent = 0;
};

/// Returns `count` different numbers below `end`, ascending.
inline std::vector<std::uint32_t> pick(Random& random, std::size_t count, std::size_t end) {
    std::set<std::uint32_t> picked;
    while (picked.size() < count)
        picked.insert(static_cast<std::uint32_t>(random_int(random, 0, static_cast<int>(end) - 1)));
    return {picked.begin(), picked.end()};
}

/// Returns a construction of any kind; its lines and planes may share vertices.
inline Construction random_construction(Random& random, std::size_t inputs) {
    Construction how;
    how.kind = std::array{Kind::line_plane, Kind::three_planes,
                          Kind::line_line}[static_cast<std::size_t>(random_int(random, 0, 2))];
    const auto fill = [&](std::size_t first, std::size_t count) {
        const auto v = pick(random, count, inputs);
        std::copy(v.begin(), v.end(), how.v.begin() + static_cast<std::ptrdiff_t>(first));
    };
    if (how.kind == Kind::three_planes) {
        for (const std::size_t first : {0u, 3u, 6u}) fill(first, 3);
    } else {
        fill(0, 2);
        fill(2, how.kind == Kind::line_plane ? 3 : 2);
    }
    if (how.kind == Kind::line_line)
        how.axis = axes[static_cast<std::size_t>(random_int(random, 0, 2))];
    return how;
}

inline Twins twins_of(const std::vector<Point3>& input) {
    Twins t;
    t.store = PointStore(input);
    t.exponent = oracle::lowest_exponent(input);
    t.exact = oracle::points(input);
    return t;
}

/// Appends the construction if it is defined.
inline bool append(Twins& t, const Construction& how) {
    const oracle::Point p = oracle::construct(how, t.exact);
    if (p.w == 0) return false;
    t.exact.push_back(p);
    t.store.append(std::array{how});
    return true;
}

inline Twins random_twins(Random& random, Family family, std::size_t inputs, int tries) {
    Twins t = twins_of(points_of(random, family, inputs));
    for (int i = 0; i < tries; ++i) append(t, random_construction(random, inputs));
    return t;
}

/// Returns any point of the store.
inline PointIndex any_point(Random& random, const Twins& t) {
    return static_cast<PointIndex>(random_int(random, 0, static_cast<int>(t.exact.size()) - 1));
}

} // namespace point_store_cases
