// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Values in MSH files: $NodeData and $ElementData, alike in MSH 2.2 and 4.1.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/carry.hpp>

namespace terrane {

/// Tells whether Gmsh has such values: they have 1, 3 or 9 components.
bool fits_msh(const ValueArray& array);

/// How the elements of a file are numbered.
struct MshNumbering {
    std::size_t first = 1;    ///< element of the first triangle
    bool per_surface = false; ///< a triangle is an element for each of its surfaces
};

/// Returns the sections of values per surface, as from carry_values(), on triangles and on their vertices. Integers are
/// written in full, texts as indices. Nodes and elements without a value, and arrays that do not fit, are left out.
std::string to_msh_values(std::size_t vertices, std::span<const Triangle> triangles,
                          const IndexLists<std::uint32_t>& surfaces_of,
                          std::span<const SurfaceValues> values, MshNumbering numbering = {});

} // namespace terrane
