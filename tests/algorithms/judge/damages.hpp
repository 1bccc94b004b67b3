// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Damages to good meshes. Each is known by how it is made, and names the property that it breaks.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace test_support {

using terrane::Point3;
using terrane::Surface;
using terrane::Triangle;

/// A damage. It returns nothing where a mesh has no place for it.
struct MeshDamage {
    std::string name;
    std::string breaks; ///< a property
    std::function<std::optional<Surface>(Surface)> make;
};

/// Where a mesh can be damaged: found without the code that judges.
class DamagePlaces {
public:
    explicit DamagePlaces(const Surface& s) : s_(s) {
        for (std::uint32_t t = 0; t < s.triangles.size(); ++t)
            for (unsigned k = 0; k < 3; ++k) {
                const auto [low, high] =
                    std::minmax(s.triangles[t][k], s.triangles[t][(k + 1) % 3]);
                edges[{low, high}].push_back(t);
                around[s.triangles[t][k]].insert(t);
            }
    }

    /// Returns the sine of the angle between the planes of two triangles, roughly.
    [[nodiscard]] double bend(std::uint32_t s, std::uint32_t t) const {
        const Point3 m = normal(s), n = normal(t);
        const Point3 c{m.y * n.z - m.z * n.y, m.z * n.x - m.x * n.z, m.x * n.y - m.y * n.x};
        return std::hypot(c.x, c.y, c.z) / (std::hypot(m.x, m.y, m.z) * std::hypot(n.x, n.y, n.z));
    }
    [[nodiscard]] Point3 normal(std::uint32_t t) const {
        const auto [a, b, c] = s_.triangles[t];
        const Point3 &p = s_.vertices[a], &q = s_.vertices[b], &r = s_.vertices[c];
        const double ux = q.x - p.x, uy = q.y - p.y, uz = q.z - p.z;
        const double vx = r.x - p.x, vy = r.y - p.y, vz = r.z - p.z;
        return {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
    }
    [[nodiscard]] std::uint32_t third(std::uint32_t t, std::uint32_t u, std::uint32_t w) const {
        for (const std::uint32_t v : s_.triangles[t])
            if (v != u && v != w) return v;
        return u;
    }
    /// A vertex where at least three planes meet, so that it can't be left out or moved.
    [[nodiscard]] std::optional<std::uint32_t> corner() const {
        for (const auto& [v, triangles] : around) {
            const std::vector<std::uint32_t> all(triangles.begin(), triangles.end());
            std::size_t planes = 0;
            for (std::size_t i = 0; i < all.size(); ++i) {
                bool is_new = true;
                for (std::size_t j = 0; j < i; ++j) is_new = is_new && bend(all[i], all[j]) > 1e-3;
                planes += is_new;
            }
            if (planes >= 3) return v;
        }
        return std::nullopt;
    }
    /// An edge of two triangles that enclose an angle.
    [[nodiscard]] std::optional<std::array<std::uint32_t, 2>> crease() const {
        for (const auto& [edge, triangles] : edges)
            if (triangles.size() == 2 && bend(triangles[0], triangles[1]) > 1e-3) return edge;
        return std::nullopt;
    }
    /// An edge of more than two triangles.
    [[nodiscard]] std::optional<std::array<std::uint32_t, 2>> junction() const {
        for (const auto& [edge, triangles] : edges)
            if (triangles.size() > 2) return edge;
        return std::nullopt;
    }

    std::map<std::array<std::uint32_t, 2>, std::vector<std::uint32_t>> edges;
    std::map<std::uint32_t, std::set<std::uint32_t>> around; ///< per vertex: its triangles

private:
    const Surface& s_;
};

/// Returns the damages; meshes have an extent of about 10, at most 10^7 from the origin.
std::vector<MeshDamage> all_mesh_damages();

} // namespace test_support
