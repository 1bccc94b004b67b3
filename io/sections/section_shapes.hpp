// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Shapefiles of sections, which shapelib writes.
#pragma once

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/sections/section_text.hpp>

namespace terrane {

/// Writes polygons, and after "_lines" lines, as shapefiles with tables: .shp, .shx, .dbf, and .cpg, as names are UTF-8.
/// Fields are BLOCK, BEHIND, UNIT and AREA, and SURFACE and ROLE; texts end after 254 bytes. Coordinates are those of
/// section_geojson(). Errors: unsupported in a build without shapelib.
Result<std::vector<SectionFile>> section_shapes(const Section& section, const SectionNames& names);

} // namespace terrane
