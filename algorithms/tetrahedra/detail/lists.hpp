// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/algorithms/tetrahedra/detail/findings.hpp>

namespace terrane::tetrahedra::detail {

/// Checks that all lists have their lengths, all indices are in range, all coordinates are finite
/// and all triangles have an area; reports unusable_lists. Returns whether the rest can be checked.
bool check_lists(const Subject& subject);

/// Checks the surfaces and the number of blocks; reports wrong_attributes.
void check_attributes(const Subject& subject);

} // namespace terrane::tetrahedra::detail
