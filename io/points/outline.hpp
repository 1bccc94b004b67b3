// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reading outlines in the map: lines with two numbers, a polygon of GeoJSON, or a shapefile.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>

namespace terrane {

/// Reads the corners of one polygon. `source` is the name of the file; .geojson and .json are
/// GeoJSON: a Polygon, or a MultiPolygon, Feature, GeometryCollection or FeatureCollection with
/// exactly one polygon; .shp is a shapefile (shape_outline.hpp). Heights are not read. Any other file has x and y on each line, where #
/// begins a comment and 999 999 999 ends the polygon. The last corner may repeat the first. Errors:
/// bad_syntax, bad_number with "source:line", or with the path to the value, as in
/// "source: features[0].geometry"; unsupported (a polygon with holes, several polygons);
/// nothing_to_do (no polygon, no corner). Cost: linear.
Result<std::vector<std::array<double, 2>>> read_outline(std::string_view contents,
                                                        std::string_view source);

} // namespace terrane
