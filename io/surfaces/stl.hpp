// SPDX-License-Identifier: LGPL-3.0-or-later
//
// STL, binary and ASCII. Binary STL holds coordinates as float32: 7 decimal digits, which is half
// a metre at UTM northings. Use another format where that matters.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// One Surface per solid that has facets; a nameless solid and a binary file are called `name`.
/// Corners of a solid at exactly the same position become one vertex (0 and -0 are the same);
/// vertices in the order in which they are first met. Normals and attributes are not read.
/// A file is binary if its length is the one that its count of triangles calls for, even where it
/// begins with "solid". ASCII numbers are read as doubles.
/// Errors: bad_syntax, bad_number with "source:line" or "source, byte n"; nothing_to_do without a
/// facet.
Result<std::vector<Surface>> read_stl(std::string_view contents, std::string_view source,
                                      std::string_view name);

/// Binary, every triangle once, coordinates rounded to the nearest float32: triangles may become
/// degenerate or cross. The header says so.
/// Errors: bad_number where a coordinate is beyond the largest float32.
Result<std::string> to_stl(const Mesh& mesh);

/// ASCII, one solid per surface with triangles; a triangle of several surfaces is written in each.
/// Doubles that read back the same; other programs will round them to float32.
std::string to_stl_ascii(const Mesh& mesh);

} // namespace terrane
