// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Arrangements with exact coordinates as text. A file has these lines:
//
//   terrane-exact 1
//   surfaces 2                 how many lines follow
//   horizon 14 top reservoir   role, number of input triangles, name to the end of the line
//   fault 2 F1
//   vertices 8
//   0 1/3 -72057594037927936   x y z, exact: reduced fractions in decimal, "/1" left out
//   ...
//   triangles 8
//   0 1 6 0                    three vertices, then the input triangles that contain it: ascending,
//   1 7 6 3 14                 counted through all surfaces
//   ...
//   intersection_edges 1
//   6 7                        two vertices, the lower first; ascending
//   end
//
// Indices count from 0. Fields are separated by one blank, lines end with \n. The surfaces of a
// triangle are those of its input triangles.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// The contents of the text.
struct ExactText {
    std::vector<SurfaceInfo> surfaces;                ///< with names on one line
    std::vector<std::uint32_t> input_triangles;       ///< per surface: number of input triangles
    std::vector<std::array<std::string, 3>> vertices; ///< x, y, z: "-5/3", "7"
    std::vector<Triangle> triangles;                  ///< indices into vertices
    IndexLists<std::uint32_t> parents_of; ///< per triangle: input triangles, sorted, >= 1
    std::vector<Edge> intersection_edges; ///< sorted, unique

    friend bool operator==(const ExactText&, const ExactText&) = default;
};

/// Returns the exact coordinates and the triangles of an arrangement. Cost: linear in the number of
/// digits; the fractions of 100 000 vertices take a second.
ExactText to_exact(const Arrangement& arrangement, const Run& run = {});
/// Returns the text.
std::string to_text(const ExactText& exact);

/// Reads a text in the format above. Errors: bad_syntax, bad_number (a coordinate that is not a
/// reduced fraction), bad_index; with "source:line".
Result<ExactText> read_exact(std::string_view contents, std::string_view source);

} // namespace terrane
