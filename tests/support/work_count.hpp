// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Counts how often costly steps are done, on a model that has work for each of them.
#pragma once

#include <map>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "support/solids.hpp"
#include <terrane/algorithms/mesh/work_hook.hpp>

namespace test_support {

using namespace terrane;

/// Returns a vertical wall between two points, from z = 0 to 8.
inline Surface wall(const std::string& name, double x0, double y0, double x1, double y1) {
    return {name,
            Role::fault,
            {{x0, y0, 0}, {x1, y1, 0}, {x1, y1, 8}, {x0, y0, 8}},
            {{0, 1, 2}, {0, 2, 3}}};
}

/// Returns a box in six sectors. The walls do not meet in one line exactly: the prism between them,
/// block 5, is thinner than the spacing of doubles there, so that rounding loses it.
inline std::vector<Surface> sectors() {
    constexpr double u = 0x1p-50; // from 4 to the next double
    auto surfaces = std::vector<Surface>{box({0, 0, 0}, {8, 8, 8})};
    surfaces.push_back(wall("first", 0, 0, 8, 8));
    surfaces.push_back(wall("second", 0, 8, 8, 0));
    surfaces.push_back(wall("third", 4 + u, -60, 4 - u, 72));
    return surfaces;
}

struct Step {
    std::string name;
    std::vector<Point3> vertices;
    std::vector<Triangle> triangles;

    friend bool operator<(const Step& a, const Step& b) {
        return std::tie(a.name, a.vertices, a.triangles) <
               std::tie(b.name, b.vertices, b.triangles);
    }
};

/// Counts the costly steps while it lives.
class WorkCount {
public:
    WorkCount() {
        steps().clear();
        detail::work_hook = [](std::string_view name, std::span<const Point3> vertices,
                               std::span<const Triangle> triangles) {
            const std::lock_guard lock(mutex());
            ++steps()[{std::string(name),
                       {vertices.begin(), vertices.end()},
                       {triangles.begin(), triangles.end()}}];
        };
    }
    ~WorkCount() { detail::work_hook = nullptr; }
    WorkCount(const WorkCount&) = delete;
    WorkCount& operator=(const WorkCount&) = delete;

    /// Returns the number of meshes on which the step was done; 0 if it was done twice on one of
    /// them.
    [[nodiscard]] static std::size_t meshes_of(const std::string& name) {
        std::size_t meshes = 0;
        for (const auto& [step, count] : steps()) {
            if (step.name != name) continue;
            if (count != 1) return 0;
            ++meshes;
        }
        return meshes;
    }

private:
    static std::map<Step, std::size_t>& steps() {
        static std::map<Step, std::size_t> all;
        return all;
    }
    static std::mutex& mutex() {
        static std::mutex one;
        return one;
    }
};

} // namespace test_support
