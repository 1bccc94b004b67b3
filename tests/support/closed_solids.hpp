// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Random closed surfaces on a small lattice, where they share faces, edges and corners more often than not.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "support/points.hpp"
#include "support/solids.hpp"

namespace test_support {

inline Surface turned_over(Surface s) {
    for (Triangle& t : s.triangles) std::swap(t[1], t[2]);
    return s;
}

/// Makes closed surfaces: boxes, tetrahedra, octahedra, rings; some face inwards, some cross themselves.
class SolidMaker {
public:
    explicit SolidMaker(std::uint64_t seed) : random(seed) {}

    Surface solid(std::string name) {
        Surface s = shape();
        if (random_int(random, 0, 3) == 0) { // the same triangles around any points
            std::map<Point3, Point3> moved;
            for (Point3& p : s.vertices) p = moved.try_emplace(p, point()).first->second;
        }
        if (random_int(random, 0, 3) == 0) s = turned_over(std::move(s));
        if (random_int(random, 0, 5) == 0) add(shape(), s);
        s.name = std::move(name);
        return s;
    }
    /// Surfaces called a, b, c, ...
    std::vector<Surface> solids(int count) {
        std::vector<Surface> all;
        for (int i = 0; i < count; ++i)
            all.push_back(solid(std::string(1, static_cast<char>('a' + i))));
        return all;
    }
    Point3 point() {
        return point_of([&] { return double(random_int(random, -3, 3)); });
    }

    Random random;

private:
    static void add(Surface other, Surface& s) {
        const auto first = static_cast<std::uint32_t>(s.vertices.size());
        s.vertices.insert(s.vertices.end(), other.vertices.begin(), other.vertices.end());
        for (const auto& [i, j, k] : other.triangles)
            s.triangles.push_back({first + i, first + j, first + k});
    }
    Surface shape() {
        switch (random_int(random, 0, 4)) {
        case 0:
            return tetrahedron(point(), point(), point(), point());
        case 1:
            return octahedron(point(), random_int(random, 1, 3));
        case 2: {
            Surface ring = torus(point(), 3, 1, 4, random_int(random, 0, 2));
            for (Point3& p : ring.vertices)
                p = {std::nearbyint(p.x), std::nearbyint(p.y), std::nearbyint(p.z)};
            return ring;
        }
        default: {
            const Point3 p = point();
            const auto wide = [&] { return double(random_int(random, 1, 4)); };
            return box(p, {p.x + wide(), p.y + wide(), p.z + wide()});
        }
        }
    }
};

} // namespace test_support
