// SPDX-License-Identifier: LGPL-3.0-or-later
//
// build_structure() of structure.hpp for stages that can be stopped.
#pragma once

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/structure/structure.hpp>

namespace terrane {

/// Builds the structure, and looks for a stop request between its steps. Errors: interrupted.
Result<Structure> build_structure(const Mesh& mesh, const Volumes& volumes, const Run& run);

} // namespace terrane
