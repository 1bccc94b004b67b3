// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A target about surfaces consists of two functions, which the fuzzer (entry.cpp) and the minimiser
// call.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

#include "bytes.hpp"

namespace terrane::fuzz {

using fuzzing::Part;
using fuzzing::Points;
using fuzzing::Soup;

/// Returns the mesh that bytes of no literal mesh stand for.
Soup input(Bytes& bytes);

/// Describes how the property is violated; empty if it holds, or does not apply to such surfaces.
std::string flaw(std::span<const Surface> surfaces);

/// Returns the parts as surfaces with the names a, b, ...
inline std::vector<Surface> surfaces_of(const Soup& soup) {
    std::vector<Surface> surfaces;
    for (const Part& part : soup) {
        Surface& s = surfaces.emplace_back();
        s.name = std::string(1, static_cast<char>('a' + (surfaces.size() - 1) % 26));
        for (const fuzzing::Point& p : part.points) s.vertices.push_back({p.x, p.y, p.z});
        s.triangles = part.triangles;
    }
    return surfaces;
}

} // namespace terrane::fuzz
