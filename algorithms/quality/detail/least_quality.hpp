// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Bounds q of the triangles that remeshing may make.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/quality/detail/features.hpp>
#include <terrane/algorithms/quality/detail/working_mesh.hpp>

namespace terrane::quality::detail {

/// No change adds a triangle whose q is below the bound of the input triangle that the replaced
/// one follows.
struct LeastQuality {
    double elsewhere = 0;       ///< bound of the input triangles that are not strict
    double wanted = 0;          ///< bound of the strict ones, and of the result
    std::vector<char> strict{}; ///< per input triangle; empty: none is

    [[nodiscard]] double at(std::uint32_t input_triangle) const {
        return strict.empty() || strict[input_triangle] == 0 ? elsewhere : wanted;
    }
};

/// Lists the triangles whose q is below `q`.
std::vector<std::uint32_t> worse_than(const WorkMesh& mesh, double q);

/// Makes the input triangles strict that share a vertex with the one that a bad triangle follows,
/// and further ones up to some target lengths from the bad triangle.
void make_strict_near(std::span<const std::uint32_t> bad, const WorkMesh& mesh, const Mesh& input,
                      LeastQuality& least);

} // namespace terrane::quality::detail
