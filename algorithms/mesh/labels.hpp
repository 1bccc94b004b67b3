// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Names of surfaces: made unique, and found again.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Names and roles of surfaces, in order.
std::vector<SurfaceInfo> infos_of(std::span<const Surface> surfaces);

/// Changes each name by `change`, replaces empty ones by "surface", and makes all different: a name
/// met again gets _2, _3, ...
std::vector<std::string> unique_names(std::span<const SurfaceInfo> surfaces,
                                      const std::function<std::string(std::string_view)>& change);

/// Names by which people tell surfaces apart: each on one line, '"' replaced by an apostrophe, not
/// empty, and all different, as above. Labels do not depend on the surfaces that follow.
std::vector<std::string> unique_labels(std::span<const SurfaceInfo> surfaces);

/// Replaces control characters by blanks.
std::string one_line(std::string_view name);

/// The surfaces that have this name or this label.
std::vector<std::uint32_t> surfaces_called(std::string_view name,
                                           std::span<const SurfaceInfo> surfaces,
                                           std::span<const std::string> labels);

/// Returns a sentence for a name that nothing has: "no surface is called tpo; did you mean top?",
/// or with the names that there are, at most 10.
std::string not_called(std::string_view kind, std::string_view name,
                       std::span<const std::string> labels);

} // namespace terrane
