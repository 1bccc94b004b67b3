// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::fuzz {

/// Ends the process, so that the fuzzer keeps the bytes.
[[noreturn]] inline void fail(const std::string& sentence) {
    std::fprintf(stderr, "FOUND: %s\n", sentence.c_str());
    std::abort();
}

inline void require(bool holds, const char* sentence) {
    if (!holds) fail(sentence);
}

/// Returns an OBJ file from which the same surfaces are read.
inline std::string obj_text(std::span<const Surface> surfaces) {
    std::string text;
    std::size_t first = 1;
    const auto number = [](double d) {
        char digits[40];
        std::snprintf(digits, sizeof digits, " %.17g", d);
        return std::string(digits);
    };
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const Surface& surface = surfaces[s];
        for (const Point3& p : surface.vertices)
            text += "v" + number(p.x) + number(p.y) + number(p.z) + "\n";
        text += "g " + (surface.name.empty() ? "s" + std::to_string(s) : surface.name) + "\n";
        for (const Triangle& t : surface.triangles) {
            text += "f";
            for (const auto v : t) text += " " + std::to_string(first + v);
            text += "\n";
        }
        first += surface.vertices.size();
    }
    return text;
}

} // namespace terrane::fuzz
