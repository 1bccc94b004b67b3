// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What a project has done to its surfaces before they are arranged: holes filled, then horizons put
// in order.
#pragma once

#include <optional>
#include <string>

#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/session/session.hpp>
#include <terrane/io/project.hpp>

namespace terrane::cli {

struct Preprocessed {
    std::string said;                 ///< what was invented and replaced, for people
    std::string refused;              ///< why nothing can be made of it; empty: all is well
    std::optional<FillWork> filled{}; ///< where the project has "fill"
};

/// Replaces surfaces of `inputs`; their names and places stay. A triangle in which layers coincide
/// is in each of them. `statistics` gets holes and layers. `source`: the project file, for
/// messages.
/// Errors: bad_option with the key, for names that no surface has or two entries share; those of
/// find_border_loops, stack_layers and fill_holes.
Result<Preprocessed> mend(const Project& project, const std::string& source, Inputs& inputs,
                          Session& session, Json& statistics);

} // namespace terrane::cli
