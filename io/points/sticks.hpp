// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Fault sticks, lines that were drawn down a fault, section by section, and polygons round faults.
#pragma once

#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// Reads one Surface with the role of a fault for each name of a fault, else one called `name`. Each
/// line has a point, in one of these forms; columns are separated by blanks, tabs, commas or
/// semicolons:
/// - INLINE- i j x y z fault stick, or another word that ends with a hyphen in front (Charisma);
/// - x y z fault stick, x y z stick, or fault x y z stick;
/// - x y z, where a line 999 999 999 ends each stick;
/// - the columns that a heading names: x, y and z as for points, fault, and stick.
/// Comments, the end of points and points without a height are those of read_points. A stick is
/// what has one fault and one number; sticks keep the order of the file, as do their points.
///
/// The surface consists of strips of triangles between successive sticks; no point is added.
/// (1) A stick is turned round if that brings its ends nearer to those of the stick before, by the
///     sum of squares of distances.
/// (2) Between two sticks one goes down both from their first points. The next point is that of the
///     stick of which the smaller share of the length lies before it; at equal shares, of the
///     former. It makes a triangle with the last points of both.
/// (3) A stick of at least four points whose last one is at the place of the first is a polygon: its
///     inside is triangulated by fill_closed_line, and it counts neither in (1) nor in (2). The
///     surface then has only the vertices that it uses.
/// A fault with one stick has no surface. Errors: bad_syntax, bad_number with "source:line";
/// nothing_to_do if no fault has two sticks or a polygon; improper_contact, bad_number if a polygon
/// can't be triangulated. Cost: linear, and that of fill_closed_line.
Result<std::vector<Surface>> read_sticks(std::string_view contents, std::string_view source,
                                         std::string_view name, const ReadOptions& options);

} // namespace terrane
