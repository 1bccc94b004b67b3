// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Solids of long thin triangles whose sides run along no axis, as CAD programs make them: the boxes of most pairs
// of triangles overlap.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace thin_solids {

using terrane::Point3;
using terrane::Surface;
using terrane::Triangle;

/// Turns a point, so that the z axis runs along (1, 2, 3), and adds the origin.
inline Point3 tilted(const Point3& p, const Point3& origin) {
    const double a = std::atan2(std::sqrt(5.0), 3.0), b = std::atan2(2.0, 1.0);
    const double x = p.x * std::cos(a) + p.z * std::sin(a),
                 z = p.z * std::cos(a) - p.x * std::sin(a);
    return {origin.x + x * std::cos(b) - p.y * std::sin(b),
            origin.y + x * std::sin(b) + p.y * std::cos(b), origin.z + z};
}

/// Closes a ring of n vertices from `first` on by triangles that run across it.
inline void add_cap(Surface& s, std::uint32_t first, std::uint32_t n, bool up) {
    for (std::uint32_t low = 0, high = n - 1; low + 1 < high;) {
        const bool from_low = low < n - 1 - high + 1;
        const std::uint32_t next = from_low ? low + 1 : high - 1;
        const Triangle t{first + low, first + next, first + high};
        s.triangles.push_back(up ? t : Triangle{t[0], t[2], t[1]});
        (from_low ? low : high) = next;
    }
}

/// Joins rings of n points by strips and closes the two ends: 2 n (rings - 1) + 2 (n - 2) triangles.
inline Surface lofted(std::string name, const std::vector<std::vector<Point3>>& rings,
                      const Point3& origin = {}) {
    Surface s;
    s.name = std::move(name);
    const auto n = static_cast<std::uint32_t>(rings.front().size());
    for (const auto& ring : rings)
        for (const Point3& p : ring) s.vertices.push_back(tilted(p, origin));
    for (std::uint32_t r = 0; r + 1 < rings.size(); ++r)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t j = (i + 1) % n, a = r * n, b = a + n;
            s.triangles.push_back({a + i, a + j, b + j});
            s.triangles.push_back({a + i, b + j, b + i});
        }
    add_cap(s, 0, n, false);
    add_cap(s, static_cast<std::uint32_t>((rings.size() - 1) * n), n, true);
    return s;
}

/// Returns n points round the z axis at a height, at a radius that depends on the angle.
inline std::vector<Point3> ring(std::uint32_t n, double height, double twist,
                                const std::function<double(double)>& radius) {
    std::vector<Point3> points;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n;
        const double r = radius(angle);
        points.push_back({r * std::cos(angle + twist), r * std::sin(angle + twist), height});
    }
    return points;
}

/// A body between a circle and a ring with three lobes that is turned against it: about 4 n triangles.
inline Surface loft(std::uint32_t n, const Point3& origin = {}) {
    return lofted("loft",
                  {ring(n, 0, 0, [](double) { return 1.0; }),
                   ring(n, 6, 0.7, [](double a) { return 1.5 + 0.05 * std::cos(3 * a); })},
                  origin);
}

/// A prism whose profile has nine flat lobes: about 4 n triangles.
inline Surface extrusion(std::uint32_t n, const Point3& origin = {}) {
    const auto profile = [](double a) { return 1 + 0.01 * std::cos(9 * a); };
    return lofted("extrusion", {ring(n, 0, 0, profile), ring(n, 20, 0, profile)}, origin);
}

/// Cones side by side, each of 100 triangles from its own tip to an arc: about n triangles.
inline Surface fans(std::uint32_t n, const Point3& origin = {}) {
    constexpr std::uint32_t blades = 100;
    Surface s;
    s.name = "fans";
    const double width = 20.0 * blades / n; // of a fan
    for (std::uint32_t f = 0; f < n / blades; ++f) {
        const auto tip = static_cast<std::uint32_t>(s.vertices.size());
        s.vertices.push_back(tilted({f * width, 0.0, 10}, origin));
        for (std::uint32_t i = 0; i <= blades; ++i) {
            const double share = static_cast<double>(i) / blades;
            s.vertices.push_back(tilted(
                {(f + 0.9 * (share - 0.5)) * width, 0.4 * width * std::sin(3 * share), 0}, origin));
        }
        for (std::uint32_t i = 1; i <= blades; ++i)
            s.triangles.push_back({tip, tip + i, tip + i + 1});
    }
    return s;
}

/// Returns the flanks of a screw, about n triangles: strips of `across` quads wind round the axis, 24 quads to a turn.
inline Surface thread(std::uint32_t n, const Point3& origin = {}) {
    constexpr std::uint32_t across = 100, per_turn = 24;
    Surface s;
    s.name = "thread";
    const std::uint32_t steps = std::max(1U, n / (2 * across));
    const double pitch = 0.2;
    for (std::uint32_t k = 0; k <= steps; ++k) {
        const double angle = 2 * std::numbers::pi * k / per_turn;
        for (std::uint32_t i = 0; i <= across; ++i) {
            const double share = static_cast<double>(i) / across;
            const double r = 1 + 0.4 * pitch * (1 - std::fabs(2 * share - 1));
            s.vertices.push_back(tilted({r * std::cos(angle), r * std::sin(angle),
                                         pitch * (0.9 * share + angle / (2 * std::numbers::pi))},
                                        origin));
        }
    }
    for (std::uint32_t k = 0; k < steps; ++k)
        for (std::uint32_t i = 0; i < across; ++i) {
            const std::uint32_t a = k * (across + 1) + i, b = a + across + 1;
            s.triangles.push_back({a, a + 1, b + 1});
            s.triangles.push_back({a, b + 1, b});
        }
    return s;
}

/// Mixes the order of the triangles, the same way on each call.
inline void shuffle(Surface& s) {
    std::uint64_t state = 1;
    for (std::size_t i = s.triangles.size(); i-- > 1;) {
        state = state * 6364136223846793005U + 1442695040888963407U;
        std::swap(s.triangles[i], s.triangles[(state >> 33U) % (i + 1)]);
    }
}

/// Returns a solid of about n triangles: "loft", "extrusion", "fans" or "thread".
inline Surface solid(const std::string& name, std::uint32_t n, const Point3& origin = {}) {
    if (name == "loft") return loft(n / 4, origin);
    if (name == "extrusion") return extrusion(n / 4, origin);
    if (name == "fans") return fans(n, origin);
    return thread(n, origin);
}

inline constexpr std::array names{"loft", "extrusion", "fans", "thread"};

} // namespace thin_solids
