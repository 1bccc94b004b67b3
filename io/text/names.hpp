// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane::detail {

/// How files spell a Role, by its number.
inline constexpr std::array<std::string_view, 4> role_names{"unknown", "horizon", "fault",
                                                            "boundary"};

/// Names that formats without quotes can carry: printable, no blank, no '#', no '\' (each becomes
/// '_'), not empty ("surface"), and all different: a name met again gets _2, _3, ...
[[nodiscard]] std::vector<std::string> plain_names(const std::vector<SurfaceInfo>& surfaces);

/// Names for formats that put them in double quotes: on one line, '"' becomes an apostrophe, not
/// empty, and all different, as above.
[[nodiscard]] std::vector<std::string> quotable_names(const std::vector<SurfaceInfo>& surfaces);

/// Names for Abaqus, which takes upper and lower case for the same: capital letters, digits and '_'
/// only, a letter first, at most 60 characters and the number of a name met again.
[[nodiscard]] std::vector<std::string> label_names(const std::vector<SurfaceInfo>& surfaces);

/// `name` on one line: control characters become blanks.
[[nodiscard]] std::string one_line(std::string_view name);

} // namespace terrane::detail
