// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rules for the distance of sealing, as people write them: by the names of surfaces.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/sealing/sealing.hpp>

namespace terrane {

/// Returns the rules that a text stands for: "F1" is a surface, "F1/F2" a pair. A text that is the
/// name or label of a surface as a whole means this, whatever signs are in it; otherwise it is
/// divided at the first '/' with a name on both sides. All surfaces with a name are meant. Errors:
/// bad_option with a suggestion if there is no such surface.
Result<std::vector<SealRule>> seal_rules_for(std::string_view text, double distance,
                                             std::span<const SurfaceInfo> surfaces,
                                             std::span<const std::string> labels);

} // namespace terrane
