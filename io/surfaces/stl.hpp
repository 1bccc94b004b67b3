// SPDX-License-Identifier: LGPL-3.0-or-later
//
// STL, binary and ASCII. Binary STL stores coordinates as float32, which have 7 decimal digits: the
// resolution is half a metre at UTM northings. Use another format where that matters.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Reads one Surface per solid that has facets; the surfaces of a solid without a name and of a
/// binary file are called `name`. Corners of a solid with equal coordinates become one vertex (0
/// equals -0); vertices are numbered in the order of their first use. Normals and attributes are
/// ignored. A file is binary if its length fits its count of triangles, even if it begins with
/// "solid". Numbers in ASCII are read as doubles.
/// Errors: bad_syntax, bad_number with "source:line" or "source, byte n"; nothing_to_do if there is
/// no facet.
Result<std::vector<Surface>> read_stl(std::string_view contents, std::string_view source,
                                      std::string_view name);

/// Writes binary STL with every triangle once. Coordinates are rounded to the nearest float32, so
/// that triangles may degenerate or cross; the header of the file says so.
/// Errors: bad_number if a coordinate is beyond the largest float32.
Result<std::string> to_stl(const Mesh& mesh);

/// Writes ASCII STL with one solid per surface that has triangles; a triangle of several surfaces
/// is written in each of them. Numbers read back as the same doubles here; other programs will
/// round them to float32.
std::string to_stl_ascii(const Mesh& mesh);

} // namespace terrane
