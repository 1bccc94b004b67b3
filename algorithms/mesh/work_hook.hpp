// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <span>
#include <string_view>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::detail {

/// Gets the name of a costly step and the mesh that the step is about.
using WorkHook = void (*)(std::string_view step, std::span<const Point3> vertices,
                          std::span<const Triangle> triangles);

/// A test sets this hook to count how often a mesh is proven conforming or searched for volumes.
/// The steps call it from any thread. It is null otherwise.
inline std::atomic<WorkHook> work_hook{nullptr};

inline void announce_work(std::string_view step, std::span<const Point3> vertices,
                          std::span<const Triangle> triangles) {
    if (const WorkHook hook = work_hook.load()) hook(step, vertices, triangles);
}

} // namespace terrane::detail
