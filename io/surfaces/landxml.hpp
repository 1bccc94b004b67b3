// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reading surfaces of LandXML 1.0 to 2.0. Reference: landxml.org, LandXML-1.2.xsd.
#pragma once

#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Reads the faces of each Surface of the file; a point is northing, easting, elevation. Faces with i="1" are invisible
/// and passed over, as are breaklines and contours. Units are those of linearUnit. A surface has only the vertices that
/// it uses, in file order; one without a name is called `name`.
/// Errors: bad_syntax, bad_number, bad_index with "source:line"; nothing_to_do if there is no face. Cost: linear.
Result<std::vector<Surface>> read_landxml(std::string_view contents, std::string_view source,
                                          std::string_view name);

} // namespace terrane
